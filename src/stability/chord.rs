//! Approximates functions of one argument on an interval by straight lines with an error.

use super::form::{AffineForm, Terms};
use crate::eval::{Arithmetic, Bounds, Double};
use crate::num::Interval;
use crate::op::Op;
use std::f64::consts::{LN_2, LOG2_E};

/// A function that is convex or concave on an interval, and its derivative.
struct Curve<'a> {
    value: &'a dyn Fn(f64) -> f64,
    slope: &'a dyn Fn(f64) -> f64,
    /// The point where the slope has a given value; an approximation will do.
    where_slope: &'a dyn Fn(f64) -> f64,
    convex: bool,
}

/// Returns `f(x)` for the values `x` of a form within `bounds`; none where no close line is known.
pub(super) fn image(
    op: Op,
    x: &AffineForm,
    bounds: Interval,
    terms: &mut Terms,
) -> Option<AffineForm> {
    let (low, high) = (f64::from(bounds.low()), f64::from(bounds.high()));
    match op {
        Op::Rcp if low > 0.0 || high < 0.0 => {
            let sign = low.signum();
            let curve = Curve {
                value: &|x| 1.0 / x,
                slope: &|x| -1.0 / (x * x),
                where_slope: &|p| sign * (-1.0 / p).sqrt(),
                convex: sign > 0.0,
            };
            curve.image(x, low, high, terms)
        }
        Op::Sqrt => {
            let curve = Curve {
                value: &f64::sqrt,
                slope: &|x| 0.5 / x.sqrt(),
                where_slope: &|p| 0.25 / (p * p),
                convex: false,
            };
            curve.image(x, low.max(0.0), high, terms)
        }
        Op::Exp2 => {
            let curve = Curve {
                value: &f64::exp2,
                slope: &|x| LN_2 * x.exp2(),
                where_slope: &|p| (p * LOG2_E).log2(),
                convex: true,
            };
            curve.image(x, low, high, terms)
        }
        Op::Exp => {
            let curve =
                Curve { value: &f64::exp, slope: &f64::exp, where_slope: &f64::ln, convex: true };
            curve.image(x, low, high, terms)
        }
        Op::Log2 if low > 0.0 => {
            let curve = Curve {
                value: &f64::log2,
                slope: &|x| LOG2_E / x,
                where_slope: &|p| LOG2_E / p,
                convex: false,
            };
            curve.image(x, low, high, terms)
        }
        Op::Log if low > 0.0 => {
            let curve = Curve {
                value: &f64::ln,
                slope: &|x| 1.0 / x,
                where_slope: &|p| 1.0 / p,
                convex: false,
            };
            curve.image(x, low, high, terms)
        }
        Op::Sin | Op::Cos | Op::Tan | Op::Asin | Op::Acos | Op::Atan | Op::Tanh => {
            let derivative = derivative(op, bounds)?;
            by_derivative(op, derivative, x, bounds, terms)
        }
        // Unbounded there.
        Op::Rcp | Op::Log2 | Op::Log => None,
        // Of two arguments, or no curve: the enclosure has its own forms for these, or none.
        Op::Add | Op::Sub | Op::Mul | Op::Div | Op::Neg | Op::Mad | Op::Lerp | Op::Pow => None,
        Op::Abs | Op::Min | Op::Max | Op::Saturate | Op::Rsqrt | Op::Atan2 => None,
        Op::Step | Op::Select | Op::Floor | Op::Fract | Op::Sign => None,
    }
}

/// Returns `x²`.
pub(super) fn square(x: &AffineForm, bounds: Interval, terms: &mut Terms) -> AffineForm {
    let (low, high) = (f64::from(bounds.low()), f64::from(bounds.high()));
    let middle = low / 2.0 + high / 2.0;
    let magnitude = low.abs().max(high.abs()).powi(2);
    x.mapped(low + high, [-middle * middle, -low * high], magnitude, terms)
}

/// Returns `|x|`.
pub(super) fn absolute(x: &AffineForm, bounds: Interval, terms: &mut Terms) -> AffineForm {
    let (low, high) = (f64::from(bounds.low()), f64::from(bounds.high()));
    if low >= 0.0 {
        return *x;
    }
    if high <= 0.0 {
        return x.negated(terms);
    }
    let chord = (high + low) / (high - low);
    x.mapped(chord, [0.0, -low * (1.0 + chord)], high - low, terms)
}

/// Returns the larger of the two.
pub(super) fn maximum(a: &AffineForm, b: &AffineForm, terms: &mut Terms) -> AffineForm {
    let difference = a.minus(b, terms).bounds();
    let (low, high) = (f64::from(difference.low()), f64::from(difference.high()));
    if low >= 0.0 {
        return *a;
    }
    if high <= 0.0 {
        return *b;
    }
    // b + max(a − b, 0): the chord of the maximum is above it, farthest at the kink.
    let chord = high / (high - low);
    let rest = b.mapped(1.0 - chord, [0.0; 2], 0.0, terms);
    a.mapped(chord, [0.0, -chord * low], high - low, terms).plus(&rest, terms)
}

/// Returns the smaller of the two.
pub(super) fn minimum(a: &AffineForm, b: &AffineForm, terms: &mut Terms) -> AffineForm {
    let [a, b] = [a, b].map(|form| form.negated(terms));
    maximum(&a, &b, terms).negated(terms)
}

impl Curve<'_> {
    /// Returns the line of least error: parallel to the chord, halfway to the tangent.
    fn image(&self, x: &AffineForm, low: f64, high: f64, terms: &mut Terms) -> Option<AffineForm> {
        let (first, last) = ((self.value)(low), (self.value)(high));
        let chord = match high - low {
            width if width > 1e-30 => (last - first) / width,
            _ => (self.slope)(low),
        };
        if !(first.is_finite() && last.is_finite() && chord.is_finite()) {
            return None;
        }
        // Any tangent bounds the function, one that touches it within the interval closely.
        let touch = (self.where_slope)(chord);
        let touch = if touch.is_nan() { low / 2.0 + high / 2.0 } else { touch.clamp(low, high) };
        let (value, slope) = ((self.value)(touch), (self.slope)(touch));
        if !slope.is_finite() {
            return None;
        }
        let above_line = |x: f64, value: f64| value - chord * x;
        let ends = [above_line(low, first), above_line(high, last)];
        let tangent = [low, high].map(|x| above_line(x, value + slope * (x - touch)));
        let least = |values: [f64; 2]| values[0].min(values[1]);
        let most = |values: [f64; 2]| values[0].max(values[1]);
        let (below, above) = match self.convex {
            true => (least(tangent), most(ends)),
            false => (least(ends), most(tangent)),
        };
        let reach = low.abs().max(high.abs());
        let magnitude = first.abs().max(last.abs()) + (chord.abs() + slope.abs()) * reach;
        Some(x.mapped(chord, [below.min(above), above.max(below)], magnitude, terms))
    }
}

/// Bounds the derivative of a function neither convex nor concave everywhere; none for others.
fn derivative(op: Op, x: Interval) -> Option<Interval> {
    let of = |op: Op, x: Interval| Bounds.apply(op, [x; 4]);
    let one = Interval::new(1.0, 1.0);
    let square = |x: Interval| of(Op::Abs, x).times(of(Op::Abs, x));
    match op {
        Op::Sin => Some(of(Op::Cos, x)),
        Op::Cos => Some(of(Op::Sin, x).negated()),
        Op::Tan => Some(one.plus(square(of(Op::Tan, x)))),
        Op::Atan => Some(one.over(one.plus(square(x)))),
        Op::Tanh => Some(one.plus(square(of(Op::Tanh, x)).negated())),
        Op::Asin => Some(of(Op::Rsqrt, one.plus(square(x).negated()))),
        Op::Acos => Some(of(Op::Rsqrt, one.plus(square(x).negated())).negated()),
        Op::Rcp | Op::Sqrt | Op::Rsqrt | Op::Exp2 | Op::Exp | Op::Log2 | Op::Log => None,
        Op::Add | Op::Sub | Op::Mul | Op::Div | Op::Neg | Op::Mad | Op::Lerp | Op::Pow => None,
        Op::Abs | Op::Min | Op::Max | Op::Saturate | Op::Atan2 => None,
        Op::Step | Op::Select | Op::Floor | Op::Fract | Op::Sign => None,
    }
}

/// Returns the line through the middle whose slope is the middle of the derivative's bounds.
fn by_derivative(
    op: Op,
    derivative: Interval,
    x: &AffineForm,
    bounds: Interval,
    terms: &mut Terms,
) -> Option<AffineForm> {
    let line = AffineForm::around(derivative).filter(|_| !derivative.may_be_nan())?;
    let (low, high) = (f64::from(bounds.low()), f64::from(bounds.high()));
    let middle = low / 2.0 + high / 2.0;
    let value = Double.apply(op, [middle; 4]);
    let slope = f64::from(derivative.low()) / 2.0 + f64::from(derivative.high()) / 2.0;
    let error = line.radius() * (high / 2.0 - low / 2.0);
    let offset = value - slope * middle;
    let magnitude = value.abs() + slope.abs() * middle.abs() + error;
    Some(x.mapped(slope, [offset - error, offset + error], magnitude, terms))
}
