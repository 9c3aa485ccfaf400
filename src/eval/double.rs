//! Evaluation in double precision: the formula's meaning without the rounding of `f32`.

use super::Arithmetic;
use crate::op::{MAX_ARITY, Op};
use crate::program::Program;

/// IEEE-754 double precision, with the elementary functions of `libm`, the same on all platforms.
#[derive(Clone, Copy, Debug, Default)]
pub struct Double;

impl Double {
    /// Evaluates a program as [`Arithmetic::evaluate`] does, but with constants in double precision,
    /// one for each of the program's ([`Parsed::exact`](crate::program::Parsed::exact)).
    ///
    /// # Panics
    /// If `inputs` or `constants` has another length than the program's.
    pub fn evaluate_exact(&self, program: &Program, constants: &[f64], inputs: &[f64]) -> Vec<f64> {
        assert_eq!(constants.len(), program.consts.len(), "one value for each constant");
        self.evaluate_with(program, inputs, |index| constants[index])
    }
}

impl Arithmetic for Double {
    type Value = f64;

    fn constant(&self, value: f32) -> f64 {
        f64::from(value)
    }

    fn apply(&self, op: Op, [a, b, c, d]: [f64; MAX_ARITY]) -> f64 {
        match op {
            Op::Add => a + b,
            Op::Sub => a - b,
            Op::Mul => a * b,
            Op::Div => a / b,
            Op::Neg => -a,
            Op::Abs => a.abs(),
            Op::Min => minimum(a, b),
            Op::Max => -minimum(-a, -b),
            Op::Saturate => minimum(-minimum(-a, -0.0), 1.0),
            Op::Mad => a.mul_add(b, c),
            Op::Rcp => 1.0 / a,
            Op::Sqrt => a.sqrt(),
            Op::Rsqrt => 1.0 / a.sqrt(),
            Op::Exp2 => libm::exp2(a),
            Op::Log2 => libm::log2(a),
            Op::Exp => libm::exp(a),
            Op::Log => libm::log(a),
            Op::Pow => libm::exp2(b * libm::log2(a)),
            Op::Sin => libm::sin(a),
            Op::Cos => libm::cos(a),
            Op::Tan => libm::tan(a),
            Op::Asin => libm::asin(a),
            Op::Acos => libm::acos(a),
            Op::Atan => libm::atan(a),
            Op::Atan2 => libm::atan2(a, b),
            Op::Tanh => libm::tanh(a),
            Op::Lerp => c.mul_add(b - a, a),
            Op::Step => f64::from(u8::from(b >= a)),
            Op::Select => {
                if a < b {
                    c
                } else {
                    d
                }
            }
            Op::Floor => a.floor(),
            Op::Fract => a - a.floor(),
            Op::Sign => {
                if a == 0.0 {
                    a
                } else {
                    a.signum()
                }
            }
        }
    }
}

/// Returns the smaller; NaN if either is NaN, and −0 < +0.
fn minimum(a: f64, b: f64) -> f64 {
    match a.partial_cmp(&b) {
        None => f64::NAN,
        Some(std::cmp::Ordering::Less) => a,
        Some(std::cmp::Ordering::Greater) => b,
        Some(std::cmp::Ordering::Equal) => f64::from_bits(a.to_bits() | b.to_bits()),
    }
}
