//! What each operation's result may be off by. Each operation is named wherever its error is decided: a
//! new one must not get a bound that nobody looked up.

#![deny(clippy::wildcard_enum_match_arm)]

use crate::eval::{Arithmetic, Bounds};
use crate::num::{Interval, enclose};
use crate::op::Op;
use serde::{Deserialize, Serialize};

/// Whose arithmetic a verdict is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Rounding {
    /// The interpreter's: IEEE single precision, elementary functions within their stated errors.
    Exact,
    /// Any that WGSL and Vulkan allow ("Floating Point Accuracy" of the WGSL specification,
    /// "Precision and Operation of SPIR-V Instructions" of Vulkan's): either direction of rounding,
    /// division within 2.5 ulp, exp2 within 3 + 2|x|, …, denormals flushed, products and sums fused
    /// or not. A clamp of NaN may give a number. Of sin and cos beyond ±π, for which the specifications
    /// promise nothing, nothing is assumed; of atan2 at the origin only the function's range.
    Gpu,
}

/// An error: relative to the result, plus absolute.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Error {
    pub relative: f64,
    pub absolute: f64,
}

/// A unit in the last place, relative to the number (at most), and of denormals.
const ULP: f64 = f32::EPSILON as f64;
const LEAST: f64 = 1.5e-45;

/// Below it results may be flushed to zero.
const LEAST_NORMAL: f32 = f32::MIN_POSITIVE;

/// Up to where sin and cos are accurate on GPUs.
const HALF_TURN: f32 = std::f32::consts::PI;

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
    /// Of one operation; those that are made of others have no error of their own.
    pub(super) fn error(self, op: Op, [a, b, ..]: [Interval; 4]) -> Error {
        match self {
            Rounding::Exact => Rounding::stated(op),
            Rounding::Gpu => Rounding::allowed(op, [a, b]),
        }
    }

    /// That of the interpreter.
    fn stated(op: Op) -> Error {
        match op {
            Op::Neg | Op::Abs | Op::Min | Op::Max | Op::Saturate => Error::NONE,
            Op::Step | Op::Select | Op::Floor | Op::Sign => Error::NONE,
            Op::Pow | Op::Lerp => Error::NONE,
            Op::Add | Op::Sub | Op::Mul | Op::Div | Op::Mad => Error::ulps(0.5),
            Op::Rcp | Op::Sqrt | Op::Fract => Error::ulps(0.5),
            Op::Exp2 => Error::ulps(1.0),
            Op::Rsqrt => Error::ulps(1.5),
            Op::Exp | Op::Log2 | Op::Log | Op::Sin | Op::Cos => Error::ulps(2.0),
            Op::Asin | Op::Acos | Op::Atan | Op::Tanh => Error::ulps(3.0),
            Op::Tan | Op::Atan2 => Error::ulps(4.0),
        }
    }

    fn allowed(op: Op, [a, _]: [Interval; 2]) -> Error {
        let reach = f64::from(a.abs().high());
        let error = match op {
            Op::Neg | Op::Abs | Op::Min | Op::Max | Op::Saturate => return Error::NONE,
            Op::Step | Op::Select | Op::Floor | Op::Sign => return Error::NONE,
            // Made of others, and looked at in their steps.
            Op::Pow | Op::Lerp | Op::Tan => return Error::NONE,
            Op::Add | Op::Sub | Op::Mul | Op::Mad | Op::Fract => Error::ulps(1.0),
            Op::Div | Op::Rcp => Error::ulps(2.5),
            Op::Rsqrt => Error::ulps(2.0),
            // 1/inverseSqrt(x)
            Op::Sqrt => Error::ulps(4.6),
            Op::Exp2 | Op::Exp => Error::ulps(3.0 + 2.0 * reach.min(200.0)),
            Op::Log2 | Op::Log if a.low() > 2.0 || a.high() < 0.5 => Error::ulps(3.0),
            Op::Log2 | Op::Log => {
                Error { absolute: f64::powi(2.0, -21) + 3.0 * LEAST, ..Error::ulps(3.0) }
            }
            Op::Sin | Op::Cos => Error { relative: 0.0, absolute: f64::powi(2.0, -11) },
            Op::Atan | Op::Atan2 => Error::ulps(4096.0),
            // By way of atan2(x, sqrt(1 − x²)), whose root may be off by 2.5e-4 near x = 1; with
            // 4096 ulp of an angle up to π/2, and up to π.
            Op::Asin => Error { relative: 0.0, absolute: 1.1e-3 },
            Op::Acos => Error { relative: 0.0, absolute: 1.8e-3 },
            // By way of sinh(x)/cosh(x): four exponentials and a quotient.
            Op::Tanh => Error { absolute: 1e-5, ..Error::ulps(13.0 + 4.0 * reach.min(89.0)) },
        };
        Error { absolute: error.absolute + f64::from(LEAST_NORMAL), ..error }
    }

    /// Bounds of one operation's results, given those of its arguments.
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
            Op::Sin | Op::Cos if !promised(a) => Interval::LINE.or_nan_if(true),
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

/// Whether the specifications promise any accuracy of sin and cos there.
pub(super) fn promised(angle: Interval) -> bool {
    angle.abs().high() <= HALF_TURN
}

fn spread(bounds: Interval, error: Error) -> Interval {
    let (low, high) = (f64::from(bounds.low()), f64::from(bounds.high()));
    let error =
        |x: f64| if x.is_finite() && error != Error::NONE { error.of(x.abs()) } else { 0.0 };
    enclose(low - error(low), high + error(high)).or_nan_if(bounds.may_be_nan())
}

/// With zero, if it holds denormals.
pub(super) fn flushed(bounds: Interval) -> Interval {
    let denormal = bounds.low() < LEAST_NORMAL && bounds.high() > -LEAST_NORMAL;
    if denormal && !bounds.is_empty() { bounds.hull(Interval::new(0.0, 0.0)) } else { bounds }
}
