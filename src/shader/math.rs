//! The built-in functions of shading languages. Names and meanings: WGSL, "Numeric built-in
//! functions"; what only GLSL has: GLSL 4.60 specification, §8.

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
}

pub(super) fn wrong_arguments() -> Reason {
    "a function has other arguments than it takes".into()
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

/// Returns the operation that a function is, where it is one of the table.
fn operation(function: MathFunction) -> Option<Op> {
    Some(match function {
        MathFunction::Abs => Op::Abs,
        MathFunction::Min => Op::Min,
        MathFunction::Max => Op::Max,
        MathFunction::Saturate => Op::Saturate,
        MathFunction::Cos => Op::Cos,
        MathFunction::Sin => Op::Sin,
        MathFunction::Tan => Op::Tan,
        MathFunction::Tanh => Op::Tanh,
        MathFunction::Acos => Op::Acos,
        MathFunction::Asin => Op::Asin,
        MathFunction::Atan => Op::Atan,
        MathFunction::Atan2 => Op::Atan2,
        MathFunction::Floor => Op::Floor,
        MathFunction::Fract => Op::Fract,
        MathFunction::Exp => Op::Exp,
        MathFunction::Exp2 => Op::Exp2,
        MathFunction::Log => Op::Log,
        MathFunction::Log2 => Op::Log2,
        MathFunction::Pow => Op::Pow,
        MathFunction::Sign => Op::Sign,
        MathFunction::Fma => Op::Mad,
        MathFunction::Mix => Op::Lerp,
        MathFunction::Step => Op::Step,
        MathFunction::Sqrt => Op::Sqrt,
        MathFunction::InverseSqrt => Op::Rsqrt,
        _ => return None,
    })
}
