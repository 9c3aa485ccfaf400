//! Bounds of real numbers in `f64`, rounded outward, and tight where an operation is exact: `1 − x`
//! of an `x` up to 1 is never negative.

use super::directed::{
    loosely_below, product_below, quotient_below, root_above, root_below, sum_below,
};

/// The real numbers between two bounds, inclusive. An infinite bound is no bound. The value may
/// also be undefined: the root of a negative number, say.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    low: f64,
    high: f64,
    may_be_undefined: bool,
}

impl Span {
    /// Any real number.
    pub const ALL: Span =
        Span { low: f64::NEG_INFINITY, high: f64::INFINITY, may_be_undefined: false };

    /// Zero alone.
    pub const ZERO: Span = Span { low: 0.0, high: 0.0, may_be_undefined: false };

    /// One alone.
    pub const ONE: Span = Span { low: 1.0, high: 1.0, may_be_undefined: false };

    /// Returns the numbers from `low` to `high`; all, if a bound is NaN or they are out of order.
    pub fn new(low: f64, high: f64) -> Span {
        if low <= high { Span { low, high, may_be_undefined: false } } else { Span::ALL }
    }

    /// Returns one number alone; all, if it is NaN or infinite.
    pub fn point(x: f64) -> Span {
        if x.is_finite() { Span::new(x, x) } else { Span::ALL }
    }

    /// The lower bound.
    pub fn low(self) -> f64 {
        self.low
    }

    /// The upper bound.
    pub fn high(self) -> f64 {
        self.high
    }

    /// Returns true if the value may be undefined.
    pub fn may_be_undefined(self) -> bool {
        self.may_be_undefined
    }

    /// Returns true if both bounds are finite.
    pub fn is_bounded(self) -> bool {
        self.low.is_finite() && self.high.is_finite()
    }

    /// Returns the difference of the bounds; infinite if there are not both.
    pub fn width(self) -> f64 {
        if self.is_bounded() { (self.high - self.low).next_up() } else { f64::INFINITY }
    }

    /// Returns the number halfway between the bounds, if these are finite.
    pub fn middle(self) -> f64 {
        (self.low / 2.0 + self.high / 2.0).clamp(self.low, self.high)
    }

    /// Returns the largest absolute value.
    pub fn most(self) -> f64 {
        self.high.max(-self.low)
    }

    /// Returns the least absolute value.
    pub fn least(self) -> f64 {
        self.low.max(-self.high).max(0.0)
    }

    /// Returns true if the number is between the bounds.
    pub fn contains(self, x: f64) -> bool {
        self.low <= x && x <= self.high
    }

    /// Marks the value as perhaps undefined if `undefined` is true.
    #[must_use]
    pub fn or_undefined_if(self, undefined: bool) -> Span {
        Span { may_be_undefined: self.may_be_undefined || undefined, ..self }
    }

    /// Returns the smallest span that holds both.
    #[must_use]
    pub fn hull(self, other: Span) -> Span {
        Span::new(self.low.min(other.low), self.high.max(other.high)).marked([self, other])
    }

    /// Returns what is in both; the first, if nothing is.
    #[must_use]
    pub fn narrowed(self, other: Span) -> Span {
        let (low, high) = (self.low.max(other.low), self.high.min(other.high));
        if low <= high { Span { low, high, ..self } } else { self }
    }

    /// Clamps every number to the bounds.
    #[must_use]
    pub fn clamped(self, low: f64, high: f64) -> Span {
        Span { low: self.low.clamp(low, high), high: self.high.clamp(low, high), ..self }
    }

    /// Keeps the numbers within the bounds; any number outside becomes undefined.
    #[must_use]
    pub fn restricted(self, low: f64, high: f64) -> Span {
        let outside = self.low < low || self.high > high;
        if self.high < low || self.low > high {
            return Span::ALL.or_undefined_if(true);
        }
        self.clamped(low, high).or_undefined_if(outside)
    }

    /// Returns `−self`.
    #[must_use]
    pub fn negated(self) -> Span {
        Span { low: -self.high, high: -self.low, ..self }
    }

    /// Returns `|self|`.
    #[must_use]
    pub fn abs(self) -> Span {
        Span { low: self.least(), high: self.most(), ..self }
    }

    /// Returns the smaller of two values.
    #[must_use]
    pub fn minimum(self, other: Span) -> Span {
        Span::new(self.low.min(other.low), self.high.min(other.high)).marked([self, other])
    }

    /// Returns `self + other`.
    #[must_use]
    pub fn plus(self, other: Span) -> Span {
        let low = sum_below(self.low, other.low);
        let high = -sum_below(-self.high, -other.high);
        Span::new(low, high).marked([self, other])
    }

    /// Returns `self − other`.
    #[must_use]
    pub fn minus(self, other: Span) -> Span {
        self.plus(other.negated())
    }

    /// Returns `self · other`; zero alone times anything is zero alone.
    #[must_use]
    pub fn times(self, other: Span) -> Span {
        let [a, b] = [self, other];
        let is_zero = |x: Span| x.low == 0.0 && x.high == 0.0;
        if is_zero(a) || is_zero(b) {
            return Span::ZERO.marked([a, b]);
        }
        let least = |[a_low, a_high]: [f64; 2]| {
            let corners = [
                product_below(a_low, b.low),
                product_below(a_low, b.high),
                product_below(a_high, b.low),
                product_below(a_high, b.high),
            ];
            corners.into_iter().fold(f64::INFINITY, f64::min)
        };
        let span = if a.low >= 0.0 && b.low >= 0.0 {
            Span::new(product_below(a.low, b.low), -product_below(-a.high, b.high))
        } else {
            Span::new(least([a.low, a.high]), -least([-a.high, -a.low]))
        };
        span.marked([a, b])
    }

    /// Returns `self²`.
    #[must_use]
    pub fn squared(self) -> Span {
        self.abs().times(self.abs())
    }

    /// Returns `1 / self`: without bound, and perhaps undefined, if it may be zero.
    #[must_use]
    pub fn reciprocal(self) -> Span {
        if self.high < 0.0 || (self.high == 0.0 && self.low < 0.0) {
            return self.negated().reciprocal().negated();
        }
        if self.low < 0.0 || self.high == 0.0 {
            return Span::ALL.or_undefined_if(true);
        }
        let below = |x: f64| quotient_below(1.0, x);
        let high = match self.low {
            0.0 => f64::INFINITY,
            low => -quotient_below(-1.0, low),
        };
        Span::new(below(self.high), high).or_undefined_if(self.low == 0.0 || self.may_be_undefined)
    }

    /// Returns `self / divisor`: without bound, and perhaps undefined, if that may be zero.
    #[must_use]
    pub fn over(self, divisor: Span) -> Span {
        if divisor.contains(0.0) {
            return self.times(divisor.reciprocal());
        }
        if divisor.high < 0.0 {
            return self.negated().over(divisor.negated());
        }
        // Of a positive divisor: the nearer end is the farther quotient.
        let end = |x: f64, [near, far]: [f64; 2]| if x < 0.0 { near } else { far };
        let ends = [divisor.low, divisor.high];
        let low = quotient_below(self.low, end(self.low, ends));
        let high = -quotient_below(-self.high, end(-self.high, ends));
        Span::new(low, high).marked([self, divisor])
    }

    /// Returns the square root, undefined of what may be negative.
    #[must_use]
    pub fn root(self) -> Span {
        let of = self.restricted(0.0, f64::INFINITY);
        if of.low < 0.0 {
            return of;
        }
        Span { low: root_below(of.low), high: root_above(of.high), ..of }
    }

    /// Maps both bounds by an increasing function of the platform. Where its result is zero, it
    /// must be exactly so.
    #[must_use]
    pub fn increasing(self, f: impl Fn(f64) -> f64) -> Span {
        Span::new(loosely_below(f(self.low)), -loosely_below(-f(self.high))).marked([self])
    }

    /// Maps both bounds by a decreasing function of the platform, as [`Span::increasing`] does.
    #[must_use]
    pub fn decreasing(self, f: impl Fn(f64) -> f64) -> Span {
        Span::new(loosely_below(f(self.high)), -loosely_below(-f(self.low))).marked([self])
    }

    fn marked<const N: usize>(self, of: [Span; N]) -> Span {
        self.or_undefined_if(of.iter().any(|span| span.may_be_undefined))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_results_stay_exact_and_others_move_outward() {
        let unit = Span::new(0.0, 1.0);
        assert_eq!(Span::ONE.minus(unit), unit);
        assert_eq!(unit.squared(), unit);
        assert_eq!(unit.root(), unit);
        assert_eq!(Span::new(1.0, 4.0).over(Span::new(-4.0, -2.0)), Span::new(-2.0, -0.25));
        let third = Span::ONE.over(Span::point(3.0));
        assert!(third.low() < third.high() && third.low().next_up() == third.high());
        let sum = Span::point(0.1).plus(Span::point(0.2));
        assert!(sum.low() < sum.high() && sum.low().next_up() == sum.high());
        let root = Span::point(2.0).root();
        assert!(root.low() < root.high() && root.low().next_up() == root.high());
        assert!(Span::point(1.0).increasing(f64::exp).contains(std::f64::consts::E));
    }

    #[test]
    fn what_is_not_a_number_is_any_number() {
        let above = Span::new(1.0, f64::INFINITY);
        assert_eq!(above.minus(above), Span::ALL);
        assert_eq!(above.times(Span::ZERO), Span::ZERO);
        assert_eq!(above.reciprocal(), Span::new(0.0, 1.0));
        assert!(Span::new(0.0, 2.0).reciprocal().may_be_undefined());
        assert_eq!(Span::new(0.0, 2.0).reciprocal().high(), f64::INFINITY);
        assert!(Span::new(-1.0, 1.0).reciprocal().low() == f64::NEG_INFINITY);
        assert!(Span::new(-1.0, 4.0).root().may_be_undefined());
        assert!(Span::new(-3.0, -2.0).root().may_be_undefined());
        let huge = Span::point(f64::MAX);
        assert_eq!(huge.plus(huge), Span::new(f64::MAX, f64::INFINITY));
        assert_eq!(huge.times(huge), Span::new(f64::MAX, f64::INFINITY));
    }

    /// Signs and magnitudes that reach each branch of a quotient.
    #[test]
    fn quotients_and_products_hold_those_of_their_members() {
        let ends = [-3.7, -1.0, -1e-3, 0.0, 1e-3, 0.3, 1.0, 7.1];
        let mut spans = Vec::new();
        for (i, &low) in ends.iter().enumerate() {
            spans.extend(ends[i..].iter().map(|&high| Span::new(low, high)));
        }
        let members =
            |span: Span| [0.0, 0.3, 0.9, 1.0].map(|t| span.low + t * (span.high - span.low));
        for &a in &spans {
            for &b in &spans {
                for x in members(a) {
                    for y in members(b) {
                        let (x, y) = (x.clamp(a.low, a.high), y.clamp(b.low, b.high));
                        assert!(a.times(b).contains(x * y), "{x} · {y} in {a:?} · {b:?}");
                        assert!(
                            y == 0.0 || a.over(b).contains(x / y),
                            "{x} / {y} in {a:?} / {b:?}"
                        );
                    }
                }
            }
        }
    }
}
