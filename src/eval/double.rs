//! Evaluation in double precision: the formula's meaning without the rounding of `f32`.

use super::Arithmetic;
use crate::op::{MAX_ARITY, Op};

/// IEEE-754 double precision, with the platform's elementary functions.
#[derive(Clone, Copy, Debug, Default)]
pub struct Double;

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
            Op::Exp2 => a.exp2(),
            Op::Log2 => a.log2(),
            Op::Exp => a.exp(),
            Op::Log => a.ln(),
            Op::Pow => (b * a.log2()).exp2(),
            Op::Sin => a.sin(),
            Op::Cos => a.cos(),
            Op::Tan => a.tan(),
            Op::Asin => a.asin(),
            Op::Acos => a.acos(),
            Op::Atan => a.atan(),
            Op::Atan2 => a.atan2(b),
            Op::Tanh => a.tanh(),
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
