//! Evaluation on boxes of inputs: bounds of all values that `f32` and `f64` evaluation can give.

// A new operation must not get bounds by default.
#![deny(clippy::wildcard_enum_match_arm)]

use super::Arithmetic;
use crate::num::{Interval, enclose};
use crate::op::{MAX_ARITY, Op};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Interval arithmetic, operation by operation: sound, but not tight, since it does not know that
/// two arguments depend on each other.
#[derive(Clone, Copy, Debug, Default)]
pub struct Bounds;

impl Arithmetic for Bounds {
    type Value = Interval;

    fn constant(&self, value: f32) -> Interval {
        Interval::new(value, value)
    }

    fn apply(&self, op: Op, arguments: [Interval; MAX_ARITY]) -> Interval {
        let compares = matches!(op, Op::Step | Op::Select);
        if !compares && arguments[..op.arity()].iter().any(|a| a.is_empty()) {
            return Interval::NAN;
        }
        let [a, b, c, d] = arguments;
        // The interpreter's own error, beyond the rounding that all bounds allow for.
        let steps = op.accuracy().steps();
        match op {
            Op::Add => a.plus(b),
            Op::Sub => a.plus(b.negated()),
            Op::Mul => a.times(b),
            Op::Div => a.over(b),
            Op::Neg => a.negated(),
            Op::Abs => a.abs(),
            Op::Min => minimum(a, b),
            Op::Max => minimum(a.negated(), b.negated()).negated(),
            Op::Saturate => a.clamped(0.0, 1.0),
            Op::Mad => a.times_plus(b, c),
            Op::Rcp => reciprocal(a),
            Op::Sqrt => square_root(a),
            Op::Rsqrt => reciprocal(square_root(a)),
            Op::Exp2 => exp2(a),
            Op::Log2 => log2(a),
            Op::Exp => at_least_zero(a.map_increasing(f64::exp, steps)),
            Op::Log => positive(a, |a| a.map_increasing(f64::ln, steps)),
            Op::Pow => exp2(b.times(log2(a))).or_nan_if(a.may_be_nan()),
            Op::Sin => wave(op, a, f64::sin, FRAC_PI_2),
            Op::Cos => wave(op, a, f64::cos, 0.0),
            Op::Tan => tangent(a),
            Op::Asin => unit(a, |a| a.map_increasing(f64::asin, steps)),
            Op::Acos => unit(a, |a| a.negated().map_increasing(|x| (-x).acos(), steps)),
            Op::Atan => a.map_increasing(f64::atan, steps),
            Op::Atan2 => angle(a, b),
            Op::Tanh => a.map_increasing(f64::tanh, steps).clamped(-1.0, 1.0),
            Op::Lerp => c.times_plus(b.plus(a.negated()), a),
            Op::Step => step(a, b),
            Op::Select => select(a, b, c, d),
            Op::Floor => a.map_increasing(f64::floor, 0),
            Op::Fract => fract(a),
            Op::Sign => a.map_increasing(|x| if x == 0.0 { x } else { x.signum() }, 0),
        }
    }
}

/// Applies `f` to the part of an argument that is in its domain, if there is any.
fn within(a: Interval, f: impl Fn(Interval) -> Interval) -> Interval {
    if a.is_empty() { a } else { f(a) }
}

fn positive(a: Interval, f: impl Fn(Interval) -> Interval) -> Interval {
    within(a.restricted(0.0, f32::INFINITY), f)
}

fn unit(a: Interval, f: impl Fn(Interval) -> Interval) -> Interval {
    within(a.restricted(-1.0, 1.0), f)
}

fn at_least_zero(a: Interval) -> Interval {
    a.clamped(0.0, f32::INFINITY)
}

fn minimum(a: Interval, b: Interval) -> Interval {
    let bounds = Interval::new(a.low().min(b.low()), a.high().min(b.high()));
    bounds.or_nan_if(a.may_be_nan() || b.may_be_nan())
}

fn reciprocal(a: Interval) -> Interval {
    within(a, |a| Interval::new(1.0, 1.0).over(a))
}

fn square_root(a: Interval) -> Interval {
    positive(a, |a| at_least_zero(a.map_increasing(f64::sqrt, Op::Sqrt.accuracy().steps())))
}

fn exp2(a: Interval) -> Interval {
    within(a, |a| at_least_zero(a.map_increasing(f64::exp2, Op::Exp2.accuracy().steps())))
}

fn log2(a: Interval) -> Interval {
    positive(a, |a| a.map_increasing(f64::log2, Op::Log2.accuracy().steps()))
}

/// Bounds `f`, a sine shifted to have a maximum at `crest`.
fn wave(op: Op, a: Interval, f: impl Fn(f64) -> f64, crest: f64) -> Interval {
    let nan = a.may_be_nan() || a.may_be_infinite();
    if a.abs().high() > op.accuracy().up_to() {
        // For large arguments the quadrant is off by one at most, and then zero.
        return Interval::new(-1.01, 1.01).or_nan_if(nan);
    }
    let (low, high) = (f64::from(a.low()), f64::from(a.high()));
    let passes = |at: f64| ((low - at) / TAU - 1e-9).ceil() <= (high - at) / TAU + 1e-9;
    let above = if passes(crest) { 1.0 } else { f(low).max(f(high)) };
    let below = if passes(crest + PI) { -1.0 } else { f(low).min(f(high)) };
    enclose(below, above).widened(op.accuracy().steps()).or_nan_if(nan)
}

fn tangent(a: Interval) -> Interval {
    let accuracy = Op::Tan.accuracy();
    let far = a.abs().high() > accuracy.up_to();
    let branch = |x: f32| ((f64::from(x) + FRAC_PI_2) / PI).floor();
    if far || branch(a.low()) != branch(a.high()) {
        return Interval::LINE.or_nan_if(far || a.may_be_nan());
    }
    a.map_increasing(f64::tan, accuracy.steps())
}

/// Bounds the angle over a box: the extremes are at corners, unless the branch cut crosses the box.
fn angle(y: Interval, x: Interval) -> Interval {
    let nan = y.may_be_nan() || x.may_be_nan();
    if y.contains(0.0) && x.low() <= 0.0 {
        return enclose(-PI, PI).widened(Op::Atan2.accuracy().steps()).or_nan_if(nan);
    }
    let corners =
        [(y.low(), x.low()), (y.low(), x.high()), (y.high(), x.low()), (y.high(), x.high())];
    let angles = corners.map(|(y, x)| f64::from(y).atan2(x.into()));
    let low = angles.into_iter().fold(f64::INFINITY, f64::min);
    let high = angles.into_iter().fold(f64::NEG_INFINITY, f64::max);
    enclose(low, high).widened(Op::Atan2.accuracy().steps()).or_nan_if(nan)
}

fn step(edge: Interval, x: Interval) -> Interval {
    let nan = edge.may_be_nan() || x.may_be_nan();
    let never = nan || edge.is_empty() || x.is_empty() || x.low() < edge.high();
    let ever = x.high() >= edge.low();
    Interval::new(if never { 0.0 } else { 1.0 }, if ever { 1.0 } else { 0.0 })
}

fn select(a: Interval, b: Interval, yes: Interval, no: Interval) -> Interval {
    let nan = a.may_be_nan() || b.may_be_nan();
    let may_hold = a.low() < b.high() && !a.is_empty() && !b.is_empty();
    let may_fail = nan || a.high() >= b.low();
    match (may_hold, may_fail) {
        (true, false) => yes,
        (false, _) => no,
        (true, true) => yes.hull(no),
    }
}

fn fract(a: Interval) -> Interval {
    let nan = a.may_be_nan() || a.may_be_infinite();
    let whole = a.low().floor();
    if nan || whole != a.high().floor() {
        return Interval::new(0.0, 1.0).or_nan_if(nan);
    }
    a.plus(Interval::new(-whole, -whole))
}
