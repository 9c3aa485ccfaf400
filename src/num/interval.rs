//! Bounds what a computation can give in `f32`, in `f64`, or exactly.
//!
//! Bounds are rounded outward to `f32`. Both zeros count as one number: an operation that tells
//! them apart (a quotient) is bounded for either. An infinite bound means that the value may be
//! infinite.

/// The numbers between two bounds, inclusive, and perhaps NaN.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    low: f32,
    high: f32,
    may_be_nan: bool,
}

impl Interval {
    /// Every `f32` but NaN.
    pub const LINE: Interval =
        Interval { low: f32::NEG_INFINITY, high: f32::INFINITY, may_be_nan: false };

    /// NaN and nothing else.
    pub const NAN: Interval =
        Interval { low: f32::INFINITY, high: f32::NEG_INFINITY, may_be_nan: true };

    /// The numbers from `low` to `high`.
    ///
    /// # Panics
    /// If `low` exceeds `high` or either is NaN.
    pub fn new(low: f32, high: f32) -> Interval {
        assert!(low <= high, "[{low}, {high}] is no interval");
        Interval { low, high, may_be_nan: false }
    }

    /// The lower bound; `f32::INFINITY` if there is no number.
    pub fn low(self) -> f32 {
        self.low
    }

    /// The upper bound; `f32::NEG_INFINITY` if there is no number.
    pub fn high(self) -> f32 {
        self.high
    }

    /// Returns true if NaN is a possible value.
    pub fn may_be_nan(self) -> bool {
        self.may_be_nan
    }

    /// Returns true if a bound is infinite.
    pub fn may_be_infinite(self) -> bool {
        !self.is_empty() && (self.low == f32::NEG_INFINITY || self.high == f32::INFINITY)
    }

    /// Returns true if it holds no number; it may hold NaN.
    pub fn is_empty(self) -> bool {
        self.low > self.high
    }

    /// Returns true if the value, NaN or a number, is in the interval.
    pub fn contains(self, value: f64) -> bool {
        if value.is_nan() {
            return self.may_be_nan;
        }
        f64::from(self.low) <= value && value <= f64::from(self.high)
    }

    /// Adds NaN if `nan` is true.
    #[must_use]
    pub fn or_nan_if(self, nan: bool) -> Interval {
        Interval { may_be_nan: self.may_be_nan || nan, ..self }
    }

    /// Returns the smallest interval that holds both.
    #[must_use]
    pub fn hull(self, other: Interval) -> Interval {
        Interval {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
            may_be_nan: self.may_be_nan || other.may_be_nan,
        }
    }

    /// Intersects the numbers with another interval's; returns `self` if the intersection is empty.
    #[must_use]
    pub fn narrowed(self, other: Interval) -> Interval {
        let narrow =
            Interval { low: self.low.max(other.low), high: self.high.min(other.high), ..self };
        if narrow.is_empty() { self } else { narrow }
    }

    /// Keeps the numbers within the bounds; any number outside becomes NaN.
    #[must_use]
    pub fn restricted(self, low: f32, high: f32) -> Interval {
        let outside = self.low < low || self.high > high;
        let kept = Interval { low: self.low.max(low), high: self.high.min(high), ..self };
        if kept.is_empty() { Interval::NAN } else { kept.or_nan_if(outside) }
    }

    /// Clamps every number to the bounds.
    #[must_use]
    pub fn clamped(self, low: f32, high: f32) -> Interval {
        Interval { low: self.low.clamp(low, high), high: self.high.clamp(low, high), ..self }
    }

    /// Maps both bounds by an increasing `f`, whose `f32` form errs by at most `ulps`.
    #[must_use]
    pub fn map_increasing(self, f: impl Fn(f64) -> f64, ulps: u32) -> Interval {
        let (low, high) = (f(self.low.into()), f(self.high.into()));
        enclose(low, high).widened(ulps).or_nan_if(self.may_be_nan)
    }

    /// Moves the bounds outward by errors of `ulps` units in the last place, whatever their
    /// binades.
    #[must_use]
    pub fn widened(self, ulps: u32) -> Interval {
        // Just below a power of two a unit is half as large, and `f64` functions err, too.
        let steps = if ulps == 0 { 0 } else { 2 * ulps + 1 };
        let (mut low, mut high) = (self.low, self.high);
        for _ in 0..steps {
            (low, high) = (low.next_down(), high.next_up());
        }
        Interval { low, high, ..self }
    }

    /// `−self`
    #[must_use]
    pub fn negated(self) -> Interval {
        Interval { low: -self.high, high: -self.low, ..self }
    }

    /// `|self|`
    #[must_use]
    pub fn abs(self) -> Interval {
        if self.low >= 0.0 {
            self
        } else if self.high <= 0.0 {
            self.negated()
        } else {
            Interval { low: 0.0, high: self.high.max(-self.low), ..self }
        }
    }

    /// `self + other`
    #[must_use]
    pub fn plus(self, other: Interval) -> Interval {
        self.as_product().plus(other)
    }

    /// `self · other`
    #[must_use]
    pub fn times(self, other: Interval) -> Interval {
        let product = self.product(other);
        enclose(product.low, product.high).or_nan_if(product.may_be_nan)
    }

    /// `self · factor + addend`, rounded once
    #[must_use]
    pub fn times_plus(self, factor: Interval, addend: Interval) -> Interval {
        self.product(factor).plus(addend)
    }

    /// `self / divisor`; any number if the divisor may be zero
    #[must_use]
    pub fn over(self, divisor: Interval) -> Interval {
        let both_infinite = self.may_be_infinite() && divisor.may_be_infinite();
        let nan = self.may_be_nan || divisor.may_be_nan || both_infinite;
        if divisor.contains(0.0) {
            return Interval::LINE.or_nan_if(nan || self.contains(0.0));
        }
        let mut bounds = Interval::NAN;
        for a in [self.low, self.high] {
            for b in [divisor.low, divisor.high] {
                let (a, b) = (f64::from(a), f64::from(b));
                let quotient = a / b;
                if !quotient.is_nan() {
                    let rest = (-quotient).mul_add(b, a) * b.signum();
                    let corner =
                        enclose(beside(quotient, rest.min(0.0)), beside(quotient, rest.max(0.0)));
                    bounds = Interval { may_be_nan: false, ..bounds.hull(corner) };
                }
            }
        }
        bounds.or_nan_if(nan)
    }

    fn as_product(self) -> Product {
        Product { low: self.low.into(), high: self.high.into(), may_be_nan: self.may_be_nan }
    }

    fn product(self, other: Interval) -> Product {
        let undefined = |a: Interval, b: Interval| a.contains(0.0) && b.may_be_infinite();
        let nan = undefined(self, other) || undefined(other, self);
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for a in [self.low, self.high] {
            for b in [other.low, other.high] {
                let product = f64::from(a) * f64::from(b);
                // Zero times a number that may be arbitrarily large.
                let product = if product.is_nan() { 0.0 } else { product };
                (low, high) = (low.min(product), high.max(product));
            }
        }
        Product { low, high, may_be_nan: nan || self.may_be_nan || other.may_be_nan }
    }
}

/// Bounds of exact products of `f32`s.
struct Product {
    low: f64,
    high: f64,
    may_be_nan: bool,
}

impl Product {
    fn plus(self, other: Interval) -> Interval {
        let (low, high) = (f64::from(other.low), f64::from(other.high));
        let opposite = |a: f64, b: f64| a == f64::INFINITY && b == f64::NEG_INFINITY;
        let nan = opposite(self.high, low) || opposite(high, self.low);
        let (below, _) = sum(self.low, low);
        let (_, above) = sum(self.high, high);
        enclose(below, above).or_nan_if(nan || self.may_be_nan || other.may_be_nan)
    }
}

/// Bounds an exact sum to at most one unit in the last place (Knuth's two-sum); returns the whole
/// line where the sum is NaN.
fn sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    if sum.is_nan() {
        return (f64::NEG_INFINITY, f64::INFINITY);
    }
    let other = sum - a;
    let error = (a - (sum - other)) + (b - other);
    (beside(sum, error.min(0.0)), beside(sum, error.max(0.0)))
}

/// Returns the neighbour of `x` towards the sign of `error`, or `x` where that is zero or NaN.
fn beside(x: f64, error: f64) -> f64 {
    match error.partial_cmp(&0.0) {
        Some(std::cmp::Ordering::Less) => x.next_down(),
        Some(std::cmp::Ordering::Greater) => x.next_up(),
        _ => x,
    }
}

/// Returns the smallest interval of `f32` bounds around two `f64` bounds.
pub fn enclose(low: f64, high: f64) -> Interval {
    let (mut below, mut above) = (low as f32, high as f32);
    if f64::from(below) > low {
        below = below.next_down();
    }
    if f64::from(above) < high {
        above = above.next_up();
    }
    Interval { low: below, high: above, may_be_nan: false }
}

/// Returns the `f32`s between two numbers, or the nearest one if there is none between.
///
/// # Panics
/// If either is NaN, or `low` exceeds `high`.
pub fn inside(low: f64, high: f64) -> Interval {
    assert!(low <= high, "[{low}, {high}] is no interval");
    let (mut first, mut last) = (low as f32, high as f32);
    if f64::from(first) < low {
        first = first.next_up();
    }
    if f64::from(last) > high {
        last = last.next_down();
    }
    if first <= last {
        return Interval::new(first, last);
    }
    let nearest = ((low / 2.0 + high / 2.0) as f32).clamp(f32::MIN, f32::MAX);
    Interval::new(nearest, nearest)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bounds_are_exact_where_they_can_be_and_outward_where_not() {
        let interval = Interval::new(1.0, 2.0);
        assert_eq!(interval.plus(interval), Interval::new(2.0, 4.0));
        assert_eq!(interval.times(interval.negated()), Interval::new(-4.0, -1.0));
        let third = Interval::new(1.0, 1.0).over(Interval::new(3.0, 3.0));
        assert!(third.low() < third.high() && third.low().next_up() == third.high());
        let tiny = Interval::new(1.0, 1.0).plus(Interval::new(1e-45, 1e-45));
        assert_eq!((tiny.low(), tiny.high()), (1.0, 1.0f32.next_up()));
    }

    #[test]
    fn what_is_inside_is_never_an_ulp_outside() {
        for (low, high) in [(0.1, 0.7), (0.3, 0.9), (-0.7, -0.1), (-1.0, 1.0), (0.0, 1e-46)] {
            let sides = inside(low, high);
            assert!(f64::from(sides.low()) >= low && f64::from(sides.high()) <= high, "{sides:?}");
            assert!(f64::from(sides.low().next_down()) < low);
            assert!(f64::from(sides.high().next_up()) > high);
        }
        assert_eq!(inside(0.1, 0.1), Interval::new(0.1, 0.1));
    }

    #[test]
    fn what_has_no_value_says_so() {
        let zero = Interval::new(0.0, 0.0);
        assert!(zero.over(zero).may_be_nan() && zero.over(zero).may_be_infinite());
        let unit = Interval::new(0.0, 1.0);
        assert!(!Interval::new(1.0, 1.0).over(unit).may_be_nan());
        assert!(Interval::LINE.plus(Interval::LINE).may_be_nan());
        assert!(Interval::LINE.times(unit).may_be_nan());
        assert_eq!(Interval::new(-3.0, -2.0).restricted(0.0, 1.0), Interval::NAN);
        assert!(Interval::NAN.is_empty() && Interval::NAN.contains(f64::NAN));
    }
}
