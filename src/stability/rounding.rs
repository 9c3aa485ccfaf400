//! Bounds each operation's error, as the operation table states it. Special cases are matched by
//! name, without a wildcard, so that no new operation gets a bound that nobody looked up.

use crate::eval::{Arithmetic, Bounds};
use crate::num::{Interval, enclose};
use crate::op::{Accuracy, Op};
use serde::{Deserialize, Serialize};

/// The arithmetic that a verdict is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Rounding {
    /// The interpreter's: IEEE single precision, elementary functions within their stated errors.
    Exact,
    /// Any that WGSL and Vulkan allow (sections "Floating Point Accuracy" of the WGSL specification
    /// and "Precision and Operation of SPIR-V Instructions" of Vulkan's): rounding in either
    /// direction, division within 2.5 ulp, exp2 within 3 + 2|x| ulp, …, denormals flushed, products
    /// and sums fused or not. A clamp of NaN may give a number. Beyond ±π, where the specifications
    /// promise nothing, sin and cos may give anything; atan2 at the origin, any value in its range.
    Gpu,
}

/// An error bound: a part relative to the result plus an absolute one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Error {
    pub relative: f64,
    pub absolute: f64,
}

/// The largest unit in the last place, relative to the number.
const ULP: f64 = f32::EPSILON as f64;

/// Just above the unit in the last place of denormals, 2⁻¹⁴⁹.
const LEAST: f64 = 1.5e-45;

/// The magnitude below which results may be flushed to zero.
const MIN_NORMAL: f32 = f32::MIN_POSITIVE;

/// Just below 2¹²⁶: the reciprocal of a larger number may be flushed to zero.
pub(super) const HUGE: f32 = 8.5e37;

impl Error {
    const NONE: Error = Error { relative: 0.0, absolute: 0.0 };

    fn ulps(ulps: f64) -> Error {
        // A little more, since the unit is that of the rounded result.
        Error { relative: ulps * ULP * 1.0001, absolute: ulps * LEAST }
    }

    pub fn of(self, magnitude: f64) -> f64 {
        self.relative * magnitude + self.absolute
    }
}

impl Rounding {
    fn accuracy(self, op: Op) -> Accuracy {
        match self {
            Rounding::Exact => op.accuracy(),
            Rounding::Gpu => op.gpu_accuracy(),
        }
    }

    /// Returns the error of one operation; those composed of others have none of their own.
    pub(super) fn error(self, op: Op, [a, ..]: [Interval; 4]) -> Error {
        let Accuracy::Within(tolerance) = self.accuracy(op) else { return Error::NONE };
        let error = Error::ulps(tolerance.ulps_up_to(a.abs().high().into()));
        let absolute = error.absolute + tolerance.absolute_between(a.low(), a.high());
        let flushed = match self {
            Rounding::Exact => 0.0,
            Rounding::Gpu => f64::from(MIN_NORMAL),
        };
        Error { absolute: absolute + flushed, ..error }
    }

    /// Returns true if some accuracy is promised of an operation throughout an argument's interval.
    pub(super) fn promises(self, op: Op, argument: Interval) -> bool {
        argument.abs().high() <= self.accuracy(op).up_to()
    }

    /// Returns the bounds of one operation's results, given those of its arguments.
    pub(super) fn bounds(self, op: Op, arguments: [Interval; 4]) -> Interval {
        let exact = Bounds.apply(op, arguments);
        if self == Rounding::Exact {
            return exact;
        }
        let [a, b, ..] = arguments;
        let nan = exact.may_be_nan();
        if nan && matches!(op, Op::Min | Op::Max) {
            let either = |x: Interval, y: Interval, bounds: Interval| match x.may_be_nan() {
                true => bounds.hull(y),
                false => bounds,
            };
            return either(a, b, either(b, a, exact)).or_nan_if(true);
        }
        if nan && op == Op::Saturate {
            return Interval::new(0.0, 1.0).or_nan_if(true);
        }
        if exact.is_empty() {
            return exact;
        }
        let widened = spread(exact, self.error(op, arguments));
        let zero = Interval::new(0.0, 0.0);
        let bounds = match op {
            Op::Sin | Op::Cos if !self.promises(op, a) => Interval::LINE.or_nan_if(true),
            Op::Exp2 | Op::Exp | Op::Sqrt => widened.clamped(0.0, f32::INFINITY),
            Op::Fract => widened.clamped(0.0, 1.0),
            Op::Div if b.abs().high() >= HUGE => widened.hull(zero).or_nan_if(a.may_be_infinite()),
            Op::Rcp if a.abs().high() >= HUGE => widened.hull(zero),
            // sinh/cosh may be ∞/∞.
            Op::Tanh => widened.or_nan_if(a.abs().high() > 88.0),
            Op::Add | Op::Sub | Op::Mul | Op::Mad | Op::Div | Op::Rcp | Op::Rsqrt => widened,
            Op::Neg | Op::Abs | Op::Min | Op::Max | Op::Saturate => widened,
            Op::Step | Op::Select | Op::Floor | Op::Sign => widened,
            Op::Log2 | Op::Log | Op::Pow | Op::Lerp => widened,
            Op::Sin | Op::Cos | Op::Tan | Op::Asin | Op::Acos | Op::Atan | Op::Atan2 => widened,
        };
        flushed(bounds).or_nan_if(nan)
    }
}

fn spread(bounds: Interval, error: Error) -> Interval {
    let (low, high) = (f64::from(bounds.low()), f64::from(bounds.high()));
    let error =
        |x: f64| if x.is_finite() && error != Error::NONE { error.of(x.abs()) } else { 0.0 };
    enclose(low - error(low), high + error(high)).or_nan_if(bounds.may_be_nan())
}

/// Adds zero to an interval that holds denormals, as these may be flushed.
pub(super) fn flushed(bounds: Interval) -> Interval {
    let denormal = bounds.low() < MIN_NORMAL && bounds.high() > -MIN_NORMAL;
    if denormal && !bounds.is_empty() { bounds.hull(Interval::new(0.0, 0.0)) } else { bounds }
}
