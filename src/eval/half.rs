//! Evaluation in half precision, as in a shader on `half`.

use super::Arithmetic;
use crate::op::{MAX_ARITY, Op};
use half::f16;

/// IEEE-754 half precision, rounded after every operation; elementary functions are rounded from
/// those of `f32`.
#[derive(Clone, Copy, Debug, Default)]
pub struct Half {
    /// True if denormal constants, arguments and results become zeros of their sign.
    pub flush_to_zero: bool,
}

impl Half {
    fn flushed(self, value: f16) -> f16 {
        if self.flush_to_zero && !value.is_normal() && value.is_finite() {
            f16::from_bits(value.to_bits() & 0x8000)
        } else {
            value
        }
    }
}

impl Arithmetic for Half {
    type Value = f16;

    fn constant(&self, value: f32) -> f16 {
        self.flushed(f16::from_f32(value))
    }

    fn apply(&self, op: Op, arguments: [f16; MAX_ARITY]) -> f16 {
        let arguments = arguments.map(|argument| f32::from(self.flushed(argument)));
        let [a, b, c, _] = arguments;
        // For + − × ÷ √, rounding to `f32` and then to `f16` equals rounding once, since `f16` has
        // less than half the digits. Three arguments need `f64`.
        let mad = |a: f32, b: f32, c: f32| f64::from(a) * f64::from(b) + f64::from(c);
        self.flushed(match op {
            Op::Mad => f16::from_f64(mad(a, b, c)),
            Op::Lerp => f16::from_f64(mad(c, f16::from_f32(b - a).into(), a)),
            _ => f16::from_f32(op.apply(arguments)),
        })
    }
}
