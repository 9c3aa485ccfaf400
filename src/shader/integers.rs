//! Functions of integers.

use super::interpreter::Interpreter;
use super::machine::{Machine, Reason};
use super::value::{Scalar, Value};
use naga::MathFunction;

impl<M: Machine> Interpreter<'_, '_, M> {
    /// Applies a function, if it is one of integers.
    pub fn of_integers(
        &mut self,
        function: MathFunction,
        arguments: &[Value<M>],
    ) -> Result<Option<Value<M>>, Reason> {
        let one = |f: &dyn Fn(u32, bool) -> i64| {
            arguments[0].map(&mut |scalar| {
                let signed = matches!(scalar, Scalar::Int(_));
                Ok(like(scalar, f(scalar.integer()? as u32, signed)))
            })
        };
        let highest = |x: u32| 31 - i64::from(x.leading_zeros());
        Ok(Some(match function {
            MathFunction::Abs => {
                one(&|x, signed| if signed { (x as i32).wrapping_abs().into() } else { x.into() })?
            }
            MathFunction::Sign => one(&|x, _| (x as i32).signum().into())?,
            MathFunction::CountOneBits => one(&|x, _| x.count_ones().into())?,
            MathFunction::CountLeadingZeros => one(&|x, _| x.leading_zeros().into())?,
            MathFunction::CountTrailingZeros => one(&|x, _| x.trailing_zeros().into())?,
            MathFunction::ReverseBits => one(&|x, _| x.reverse_bits().into())?,
            MathFunction::FirstTrailingBit => {
                one(&|x, _| if x == 0 { -1 } else { x.trailing_zeros().into() })?
            }
            MathFunction::FirstLeadingBit => one(&|x, signed| match signed && (x as i32) < 0 {
                true => highest(!x),
                false => highest(x),
            })?,
            MathFunction::Min | MathFunction::Max | MathFunction::Clamp => {
                let least = function == MathFunction::Min;
                let pick = |a: i64, b: i64, least: bool| if least { a.min(b) } else { a.max(b) };
                let first = arguments[0].zip(&arguments[1], &mut |a, b| {
                    Ok(like(a, pick(a.integer()?, b.integer()?, least)))
                })?;
                match arguments.get(2) {
                    Some(high) => {
                        first.zip(high, &mut |a, b| Ok(like(a, a.integer()?.min(b.integer()?))))?
                    }
                    None => first,
                }
            }
            MathFunction::Dot => {
                let mut sum = 0i64;
                for (a, b) in arguments[0].scalars()?.iter().zip(arguments[1].scalars()?) {
                    sum = sum.wrapping_add(a.integer()?.wrapping_mul(b.integer()?));
                }
                Value::Scalar(like(arguments[0].scalars()?[0], sum))
            }
            MathFunction::ExtractBits => {
                let (from, count) = bits(&arguments[1], &arguments[2])?;
                one(&|x, signed| match (count, signed) {
                    (0, _) => 0,
                    (_, true) => (((x << (32 - from - count)) as i32) >> (32 - count)).into(),
                    (_, false) => ((x << (32 - from - count)) >> (32 - count)).into(),
                })?
            }
            MathFunction::InsertBits => {
                let (from, count) = bits(&arguments[2], &arguments[3])?;
                let mask = (((1u64 << count) - 1) << from) as u32;
                arguments[0].zip(&arguments[1], &mut |a, b| {
                    let (old, new) = (a.integer()? as u32, b.integer()? as u32);
                    Ok(like(a, i64::from(old & !mask | (new << from) & mask)))
                })?
            }
            MathFunction::Unpack4x8snorm
            | MathFunction::Unpack4x8unorm
            | MathFunction::Unpack2x16snorm
            | MathFunction::Unpack2x16unorm
            | MathFunction::Unpack2x16float => {
                let packed = arguments[0].scalar()?.integer()? as u32;
                let floats: Vec<_> =
                    unpacked(function, packed).into_iter().map(|v| self.machine.float(v)).collect();
                Value::of_floats(&floats)
            }
            _ => return Ok(None),
        }))
    }
}

/// Makes an integer of the other's type.
fn like<M: Machine>(scalar: Scalar<M>, value: i64) -> Scalar<M> {
    match scalar {
        Scalar::Uint(_) => Scalar::Uint(value as u32),
        _ => Scalar::Int(value as i32),
    }
}

/// Returns an offset and a number of bits that fit into 32.
fn bits<M: Machine>(offset: &Value<M>, count: &Value<M>) -> Result<(u32, u32), Reason> {
    let from = offset.scalar()?.integer()?.clamp(0, 32) as u32;
    let count = count.scalar()?.integer()?.clamp(0, i64::from(32 - from)) as u32;
    // A shift by 32 would not be one.
    Ok(if count == 0 { (0, 0) } else { (from, count) })
}

fn unpacked(function: MathFunction, packed: u32) -> Vec<f64> {
    let [a, b, c, d] = packed.to_le_bytes();
    let halves = [packed as u16, (packed >> 16) as u16];
    let snorm = |value: f64, scale: f64| (value / scale).max(-1.0);
    match function {
        MathFunction::Unpack4x8snorm => {
            [a, b, c, d].map(|byte| snorm((byte as i8).into(), 127.0)).to_vec()
        }
        MathFunction::Unpack4x8unorm => [a, b, c, d].map(|byte| f64::from(byte) / 255.0).to_vec(),
        MathFunction::Unpack2x16snorm => {
            halves.map(|half| snorm((half as i16).into(), 32767.0)).to_vec()
        }
        MathFunction::Unpack2x16unorm => halves.map(|half| f64::from(half) / 65535.0).to_vec(),
        _ => halves.map(|half| half::f16::from_bits(half).into()).to_vec(),
    }
}
