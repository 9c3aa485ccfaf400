//! The built-in functions of shading languages. Names and meanings: WGSL, "Numeric built-in
//! functions"; what only GLSL has: GLSL 4.60 specification, §8.

use super::expression::operation;
use super::interpreter::Interpreter;
use super::machine::{Extra, Machine, Reason};
use super::value::{Scalar, Value};
use crate::op::{MAX_ARITY, Op};
use naga::{BinaryOperator, MathFunction};

impl<M: Machine> Interpreter<'_, '_, M> {
    pub fn math(
        &mut self,
        function: MathFunction,
        arguments: &[Value<M>],
    ) -> Result<Value<M>, Reason> {
        let of_integers =
            arguments[0].scalars().is_ok_and(|all| !matches!(all[0], Scalar::Float(_)));
        if of_integers && let Some(value) = self.of_integers(function, arguments)? {
            return Ok(value);
        }
        if let Some(op) = operation(function) {
            return self.componentwise(arguments, &mut |machine, floats| {
                let mut args = [floats[0]; MAX_ARITY];
                args[..floats.len()].copy_from_slice(floats);
                machine.apply(op, args)
            });
        }
        match function {
            MathFunction::Dot => Ok(Value::of_floats(&[self.dot(&arguments[0], &arguments[1])?])),
            MathFunction::Cross => self.cross(&arguments[0], &arguments[1]),
            MathFunction::Length => Ok(Value::of_floats(&[self.length(&arguments[0])?])),
            MathFunction::Distance => {
                let difference =
                    self.binary(BinaryOperator::Subtract, &arguments[0], &arguments[1])?;
                Ok(Value::of_floats(&[self.length(&difference)?]))
            }
            MathFunction::Normalize => {
                let square = self.dot(&arguments[0], &arguments[0])?;
                let inverse = self.machine.unary(Op::Rsqrt, square)?;
                self.scaled(&arguments[0], inverse)
            }
            MathFunction::FaceForward => {
                let [n, i, reference] = arguments else { return Err(wrong_arguments()) };
                let dot = self.dot(reference, i)?;
                let zero = self.machine.float(0.0);
                let is_facing = self.machine.less(dot, zero);
                let against = n.map(&mut |scalar| {
                    Ok(Scalar::Float(self.machine.unary(Op::Neg, scalar.float()?)?))
                })?;
                super::paths::either(&mut *self.machine, is_facing, n, &against)
            }
            MathFunction::Reflect => {
                let [i, n] = arguments else { return Err(wrong_arguments()) };
                let dot = self.dot(n, i)?;
                let twice = self.machine.binary(Op::Add, dot, dot)?;
                let along = self.scaled(n, twice)?;
                self.binary(BinaryOperator::Subtract, i, &along)
            }
            MathFunction::Refract => self.refract(arguments),
            MathFunction::Outer => {
                let (left, right) = (&arguments[0], arguments[1].floats()?);
                let columns = right.into_iter().map(|scalar| self.scaled(left, scalar));
                Ok(Value::Several(columns.collect::<Result<_, _>>()?))
            }
            MathFunction::Transpose | MathFunction::Determinant | MathFunction::Inverse => {
                self.of_matrix(function, &arguments[0])
            }
            MathFunction::Modf | MathFunction::Frexp => self.taken_apart(function, &arguments[0]),
            MathFunction::Ldexp => {
                let power = arguments[1].map(&mut |scalar| {
                    let exponent = scalar.integer()?.clamp(-2000, 2000) as i32;
                    Ok(Scalar::Float(self.machine.float(2f64.powi(exponent))))
                })?;
                self.binary(BinaryOperator::Multiply, &arguments[0], &power)
            }
            MathFunction::QuantizeToF16 => {
                self.componentwise(arguments, &mut |machine, x| match machine.known(x[0]) {
                    Some(value) => Ok(machine.float(half::f16::from_f64(value).into())),
                    None => Err("halves of what depends on inputs are not understood".into()),
                })
            }
            _ => self.componentwise(arguments, &mut |machine, x| composed(machine, function, x)),
        }
    }

    /// Applies a function of floats to each component; scalars go with all components.
    fn componentwise(
        &mut self,
        arguments: &[Value<M>],
        f: &mut impl FnMut(&mut M, &[M::Float]) -> Result<M::Float, Reason>,
    ) -> Result<Value<M>, Reason> {
        let columns: Vec<_> =
            arguments.iter().map(Value::floats).collect::<Result<Vec<_>, Reason>>()?;
        let length = columns.iter().map(Vec::len).max().unwrap_or(0);
        let rows = (0..length).map(|i| {
            let row: Vec<_> = columns.iter().map(|c| *c.get(i).unwrap_or(&c[0])).collect();
            f(&mut *self.machine, &row)
        });
        let floats: Vec<_> = rows.collect::<Result<_, _>>()?;
        Ok(Value::of_floats(&floats))
    }

    pub fn dot(&mut self, a: &Value<M>, b: &Value<M>) -> Result<M::Float, Reason> {
        let (a, b) = (a.floats()?, b.floats()?);
        let mut sum = None;
        for (&a, &b) in a.iter().zip(&b) {
            sum = Some(match sum {
                None => self.machine.binary(Op::Mul, a, b)?,
                // Fused, as GPUs do; exact sums of products differ by the rounding.
                Some(sum) => self.machine.apply(Op::Mad, [a, b, sum, sum])?,
            });
        }
        sum.ok_or_else(wrong_arguments)
    }

    fn length(&mut self, value: &Value<M>) -> Result<M::Float, Reason> {
        if let Value::Scalar(scalar) = value {
            return self.machine.unary(Op::Abs, scalar.float()?);
        }
        let square = self.dot(value, value)?;
        self.machine.unary(Op::Sqrt, square)
    }

    fn scaled(&mut self, value: &Value<M>, by: M::Float) -> Result<Value<M>, Reason> {
        self.binary(BinaryOperator::Multiply, value, &Value::Scalar(Scalar::Float(by)))
    }

    fn cross(&mut self, a: &Value<M>, b: &Value<M>) -> Result<Value<M>, Reason> {
        let (a, b) = (a.floats()?, b.floats()?);
        let mut component = |i: usize, j: usize| {
            let product = self.machine.binary(Op::Mul, a[j], b[i])?;
            let against = self.machine.unary(Op::Neg, product)?;
            self.machine.apply(Op::Mad, [a[i], b[j], against, against])
        };
        match (a.len(), b.len()) {
            (3, 3) => Ok(Value::of_floats(&[component(1, 2)?, component(2, 0)?, component(0, 1)?])),
            _ => Err(wrong_arguments()),
        }
    }

    /// GLSL 4.60, §8.5.
    fn refract(&mut self, arguments: &[Value<M>]) -> Result<Value<M>, Reason> {
        let [i, n, eta] = arguments else { return Err(wrong_arguments()) };
        let eta = eta.float()?;
        let dot = self.dot(n, i)?;
        let machine = &mut *self.machine;
        let (one, zero) = (machine.float(1.0), machine.float(0.0));
        let square = machine.binary(Op::Mul, dot, dot)?;
        let sine = machine.binary(Op::Sub, one, square)?;
        let eta_square = machine.binary(Op::Mul, eta, eta)?;
        let bent = machine.binary(Op::Mul, eta_square, sine)?;
        let k = machine.binary(Op::Sub, one, bent)?;
        let is_total = machine.less(k, zero);
        let positive = machine.binary(Op::Max, k, zero)?;
        let root = machine.unary(Op::Sqrt, positive)?;
        let along = machine.apply(Op::Mad, [eta, dot, root, root])?;
        let (incident, normal) = (self.scaled(i, eta)?, self.scaled(n, along)?);
        let through = self.binary(BinaryOperator::Subtract, &incident, &normal)?;
        let nothing = self.scaled(i, zero)?;
        super::paths::either(&mut *self.machine, is_total, &nothing, &through)
    }

    fn of_matrix(&mut self, function: MathFunction, matrix: &Value<M>) -> Result<Value<M>, Reason> {
        let Value::Several(columns) = matrix else { return Err(wrong_arguments()) };
        let columns: Vec<Vec<M::Float>> =
            columns.iter().map(Value::floats).collect::<Result<_, _>>()?;
        match function {
            MathFunction::Transpose => {
                let row = |i: usize| {
                    let row: Vec<_> = columns.iter().map(|column| column[i]).collect();
                    Value::of_floats(&row)
                };
                Ok(Value::Several((0..columns[0].len()).map(row).collect()))
            }
            MathFunction::Determinant => {
                Ok(Value::of_floats(&[determinant(&mut *self.machine, &columns)?]))
            }
            _ => {
                let determinant = determinant(&mut *self.machine, &columns)?;
                let inverse = self.machine.unary(Op::Rcp, determinant)?;
                let size = columns.len();
                let mut adjugate = Vec::with_capacity(size);
                for i in 0..size {
                    let mut column = Vec::with_capacity(size);
                    for j in 0..size {
                        let cofactor = cofactor(&mut *self.machine, &columns, j, i)?;
                        column.push(self.machine.binary(Op::Mul, cofactor, inverse)?);
                    }
                    adjugate.push(Value::of_floats(&column));
                }
                Ok(Value::Several(adjugate))
            }
        }
    }

    /// Splits numbers: into fraction and whole part, or into significand and exponent.
    fn taken_apart(&mut self, function: MathFunction, x: &Value<M>) -> Result<Value<M>, Reason> {
        if function == MathFunction::Modf {
            let whole = self.componentwise(std::slice::from_ref(x), &mut |machine, x| {
                composed(machine, MathFunction::Trunc, x)
            })?;
            let fraction = self.binary(BinaryOperator::Subtract, x, &whole)?;
            return Ok(Value::Several(vec![fraction, whole]));
        }
        let mut exponents = Vec::new();
        let significand = x.map(&mut |scalar| {
            let known = self.machine.known(scalar.float()?);
            let value = known.ok_or("the exponent of what depends on inputs is not understood")?;
            let (significand, exponent) = libm::frexp(value);
            exponents.push(Scalar::Int(exponent));
            Ok(Scalar::Float(self.machine.float(significand)))
        })?;
        Ok(Value::Several(vec![significand, Value::of(&exponents)]))
    }

    fn of_integers(
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

fn wrong_arguments() -> Reason {
    "a function has other arguments than it takes".into()
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

/// Functions of floats that are made of operations.
fn composed<M: Machine>(
    machine: &mut M,
    function: MathFunction,
    x: &[M::Float],
) -> Result<M::Float, Reason> {
    match function {
        MathFunction::Clamp => {
            let low = machine.binary(Op::Max, x[0], x[1])?;
            machine.binary(Op::Min, low, x[2])
        }
        MathFunction::Ceil => {
            let against = machine.unary(Op::Neg, x[0])?;
            let floor = machine.unary(Op::Floor, against)?;
            machine.unary(Op::Neg, floor)
        }
        MathFunction::Trunc => {
            let size = machine.unary(Op::Abs, x[0])?;
            let whole = machine.unary(Op::Floor, size)?;
            let against = machine.unary(Op::Neg, whole)?;
            let zero = machine.float(0.0);
            let is_negative = machine.less(x[0], zero);
            machine.choose(is_negative, against, whole)
        }
        MathFunction::Radians | MathFunction::Degrees => {
            let half_turn = std::f64::consts::PI / 180.0;
            let factor =
                if function == MathFunction::Radians { half_turn } else { 1.0 / half_turn };
            let factor = machine.float(factor);
            machine.binary(Op::Mul, x[0], factor)
        }
        // t²(3 − 2t) of t from 0 to 1 between the edges.
        MathFunction::SmoothStep => {
            let (low, high, at) = (x[0], x[1], x[2]);
            let (from, width) =
                (machine.binary(Op::Sub, at, low)?, machine.binary(Op::Sub, high, low)?);
            let quotient = machine.binary(Op::Div, from, width)?;
            let t = machine.unary(Op::Saturate, quotient)?;
            let (square, minus_two, three) =
                (machine.binary(Op::Mul, t, t)?, machine.float(-2.0), machine.float(3.0));
            let rest = machine.apply(Op::Mad, [minus_two, t, three, three])?;
            machine.binary(Op::Mul, square, rest)
        }
        MathFunction::Sinh => machine.extra(Extra::Sinh, x[0], x[0]),
        MathFunction::Cosh => machine.extra(Extra::Cosh, x[0], x[0]),
        MathFunction::Asinh => machine.extra(Extra::Asinh, x[0], x[0]),
        MathFunction::Acosh => machine.extra(Extra::Acosh, x[0], x[0]),
        MathFunction::Atanh => machine.extra(Extra::Atanh, x[0], x[0]),
        MathFunction::Round => machine.extra(Extra::Round, x[0], x[0]),
        other => Err(format!("the function {other:?} is not understood")),
    }
}

/// Expands by the first column.
fn determinant<M: Machine>(machine: &mut M, columns: &[Vec<M::Float>]) -> Result<M::Float, Reason> {
    if columns.len() == 1 {
        return Ok(columns[0][0]);
    }
    let mut sum = None;
    for row in 0..columns.len() {
        let cofactor = cofactor(machine, columns, 0, row)?;
        sum = Some(match sum {
            None => machine.binary(Op::Mul, columns[0][row], cofactor)?,
            Some(sum) => machine.apply(Op::Mad, [columns[0][row], cofactor, sum, sum])?,
        });
    }
    sum.ok_or_else(wrong_arguments)
}

fn cofactor<M: Machine>(
    machine: &mut M,
    columns: &[Vec<M::Float>],
    column: usize,
    row: usize,
) -> Result<M::Float, Reason> {
    let others = columns.iter().enumerate().filter(|(index, _)| *index != column);
    let minor: Vec<Vec<M::Float>> = others
        .map(|(_, c)| {
            let rest = c.iter().enumerate().filter(|(index, _)| *index != row);
            rest.map(|(_, &value)| value).collect()
        })
        .collect();
    if minor.is_empty() {
        return Ok(machine.float(1.0));
    }
    let value = determinant(machine, &minor)?;
    match (row + column).is_multiple_of(2) {
        true => Ok(value),
        false => machine.unary(Op::Neg, value),
    }
}
