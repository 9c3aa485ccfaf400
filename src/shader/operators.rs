//! The operators of shading languages: arithmetic, comparisons, choices, conversions.

use super::interpreter::Interpreter;
use super::machine::{Extra, Machine, Reason};
use super::value::{Scalar, Value};
use crate::op::Op;
use naga::{BinaryOperator, RelationalFunction, ScalarKind, UnaryOperator};

impl<M: Machine> Interpreter<'_, '_, M> {
    pub fn unary(&mut self, op: UnaryOperator, scalar: Scalar<M>) -> Result<Scalar<M>, Reason> {
        Ok(match (op, scalar.checked()?) {
            (UnaryOperator::Negate, Scalar::Float(a)) => {
                Scalar::Float(self.machine.unary(Op::Neg, a)?)
            }
            (UnaryOperator::Negate, Scalar::Int(a)) => Scalar::Int(a.wrapping_neg()),
            (UnaryOperator::LogicalNot, Scalar::Bool(a)) => Scalar::Bool(self.machine.not(a)),
            (UnaryOperator::BitwiseNot, Scalar::Int(a)) => Scalar::Int(!a),
            (UnaryOperator::BitwiseNot, Scalar::Uint(a)) => Scalar::Uint(!a),
            _ => return Err(format!("{op:?} of this type is not understood")),
        })
    }

    pub fn binary(
        &mut self,
        op: BinaryOperator,
        left: &Value<M>,
        right: &Value<M>,
    ) -> Result<Value<M>, Reason> {
        if op == BinaryOperator::Multiply {
            match (left, right) {
                (Value::Several(columns), Value::Vector(_)) => {
                    return self.matrix_vector(columns, right);
                }
                (Value::Vector(_), Value::Several(columns)) => {
                    let dots = columns.iter().map(|column| self.dot(left, column));
                    return Ok(Value::of_floats(&dots.collect::<Result<Vec<_>, _>>()?));
                }
                (Value::Several(columns), Value::Several(others)) => {
                    let products = others.iter().map(|other| self.matrix_vector(columns, other));
                    return Ok(Value::Several(products.collect::<Result<_, _>>()?));
                }
                _ => {}
            }
        }
        left.zip(right, &mut |a, b| self.combined(op, a, b))
    }

    fn matrix_vector(
        &mut self,
        columns: &[Value<M>],
        vector: &Value<M>,
    ) -> Result<Value<M>, Reason> {
        let mut sum: Option<Value<M>> = None;
        for (column, scalar) in columns.iter().zip(vector.scalars()?.to_vec()) {
            let scaled = column.zip(&Value::Scalar(scalar), &mut |a, b| {
                self.combined(BinaryOperator::Multiply, a, b)
            })?;
            sum = Some(match sum {
                None => scaled,
                Some(sum) => {
                    sum.zip(&scaled, &mut |a, b| self.combined(BinaryOperator::Add, a, b))?
                }
            });
        }
        sum.ok_or_else(|| "the matrix has no columns".into())
    }

    fn combined(
        &mut self,
        op: BinaryOperator,
        a: Scalar<M>,
        b: Scalar<M>,
    ) -> Result<Scalar<M>, Reason> {
        match (a.checked()?, b.checked()?) {
            (Scalar::Float(a), Scalar::Float(b)) => self.combined_floats(op, a, b),
            (Scalar::Bool(a), Scalar::Bool(b)) => {
                let machine = &mut *self.machine;
                let equal = |machine: &mut M| {
                    let (not_a, not_b) = (machine.not(a), machine.not(b));
                    let (both, neither) = (machine.and(a, b), machine.and(not_a, not_b));
                    machine.or(both, neither)
                };
                Ok(Scalar::Bool(match op {
                    BinaryOperator::And | BinaryOperator::LogicalAnd => machine.and(a, b),
                    BinaryOperator::InclusiveOr | BinaryOperator::LogicalOr => machine.or(a, b),
                    BinaryOperator::Equal => equal(machine),
                    BinaryOperator::NotEqual | BinaryOperator::ExclusiveOr => {
                        let equal = equal(machine);
                        machine.not(equal)
                    }
                    _ => return Err(format!("{op:?} of truth values is not understood")),
                }))
            }
            (a, b) => {
                let whole = |value: i64| match a {
                    Scalar::Uint(_) => Scalar::Uint(value as u32),
                    _ => Scalar::Int(value as i32),
                };
                let is_signed = matches!(a, Scalar::Int(_));
                let (a, b) = (a.integer()?, b.integer()?);
                let truth = |machine: &mut M, value| Scalar::Bool(machine.boolean(value));
                let machine = &mut *self.machine;
                Ok(match op {
                    BinaryOperator::Add => whole(a.wrapping_add(b)),
                    BinaryOperator::Subtract => whole(a.wrapping_sub(b)),
                    BinaryOperator::Multiply => whole(a.wrapping_mul(b)),
                    // As WGSL defines them where b is 0.
                    BinaryOperator::Divide => whole(if b == 0 { a } else { a / b }),
                    BinaryOperator::Modulo => whole(if b == 0 { 0 } else { a % b }),
                    BinaryOperator::And => whole(a & b),
                    BinaryOperator::InclusiveOr => whole(a | b),
                    BinaryOperator::ExclusiveOr => whole(a ^ b),
                    BinaryOperator::ShiftLeft => whole(a << (b & 31)),
                    BinaryOperator::ShiftRight if is_signed => whole(a >> (b & 31)),
                    BinaryOperator::ShiftRight => whole((a as u32 >> (b & 31)).into()),
                    BinaryOperator::Equal => truth(machine, a == b),
                    BinaryOperator::NotEqual => truth(machine, a != b),
                    BinaryOperator::Less => truth(machine, a < b),
                    BinaryOperator::LessEqual => truth(machine, a <= b),
                    BinaryOperator::Greater => truth(machine, a > b),
                    BinaryOperator::GreaterEqual => truth(machine, a >= b),
                    BinaryOperator::LogicalAnd | BinaryOperator::LogicalOr => {
                        return Err(format!("{op:?} of integers is not understood"));
                    }
                })
            }
        }
    }

    fn combined_floats(
        &mut self,
        op: BinaryOperator,
        a: M::Float,
        b: M::Float,
    ) -> Result<Scalar<M>, Reason> {
        let machine = &mut *self.machine;
        let truth = match op {
            BinaryOperator::Add => return Ok(Scalar::Float(machine.binary(Op::Add, a, b)?)),
            BinaryOperator::Subtract => return Ok(Scalar::Float(machine.binary(Op::Sub, a, b)?)),
            BinaryOperator::Multiply => return Ok(Scalar::Float(machine.binary(Op::Mul, a, b)?)),
            BinaryOperator::Divide => return Ok(Scalar::Float(machine.binary(Op::Div, a, b)?)),
            BinaryOperator::Modulo => {
                return Ok(Scalar::Float(machine.extra(Extra::Remainder, a, b)?));
            }
            BinaryOperator::Equal => machine.equal(a, b),
            BinaryOperator::NotEqual => {
                let equal = machine.equal(a, b);
                machine.not(equal)
            }
            BinaryOperator::Less => machine.less(a, b),
            BinaryOperator::Greater => machine.less(b, a),
            BinaryOperator::LessEqual => {
                let (less, equal) = (machine.less(a, b), machine.equal(a, b));
                machine.or(less, equal)
            }
            BinaryOperator::GreaterEqual => {
                let (more, equal) = (machine.less(b, a), machine.equal(a, b));
                machine.or(more, equal)
            }
            _ => return Err(format!("{op:?} of floats is not understood")),
        };
        Ok(Scalar::Bool(truth))
    }

    pub fn selected(
        &mut self,
        condition: &Value<M>,
        accept: &Value<M>,
        reject: &Value<M>,
    ) -> Result<Value<M>, Reason> {
        let choose = |machine: &mut M, condition: Scalar<M>, yes: &Value<M>, no: &Value<M>| {
            let condition = condition.boolean()?;
            match machine.decided(condition) {
                Some(true) => Ok(yes.clone()),
                Some(false) => Ok(no.clone()),
                None => super::paths::either(machine, condition, yes, no),
            }
        };
        match condition {
            Value::Vector(conditions) => {
                let chosen = conditions.scalars().iter().enumerate().map(|(i, &condition)| {
                    let (yes, no) = (accept.component(i)?, reject.component(i)?);
                    choose(&mut *self.machine, condition, &yes, &no)?.scalar()
                });
                Ok(Value::of(&chosen.collect::<Result<Vec<_>, Reason>>()?))
            }
            one => choose(&mut *self.machine, one.scalar()?, accept, reject),
        }
    }

    pub fn relational(
        &mut self,
        function: RelationalFunction,
        argument: &Value<M>,
    ) -> Result<Value<M>, Reason> {
        let machine = &mut *self.machine;
        let is_all = function == RelationalFunction::All;
        match function {
            RelationalFunction::All | RelationalFunction::Any => {
                let mut sum = machine.boolean(is_all);
                for scalar in argument.scalars()? {
                    let truth = scalar.boolean()?;
                    sum = if is_all { machine.and(sum, truth) } else { machine.or(sum, truth) };
                }
                Ok(Value::Scalar(Scalar::Bool(sum)))
            }
            RelationalFunction::IsNan => argument.map(&mut |scalar| {
                let value = scalar.float()?;
                let itself = machine.equal(value, value);
                Ok(Scalar::Bool(machine.not(itself)))
            }),
            RelationalFunction::IsInf => argument.map(&mut |scalar| {
                let size = machine.unary(Op::Abs, scalar.float()?)?;
                let infinite = machine.float(f64::INFINITY);
                Ok(Scalar::Bool(machine.equal(size, infinite)))
            }),
        }
    }

    pub fn converted(&mut self, scalar: Scalar<M>, kind: ScalarKind) -> Result<Scalar<M>, Reason> {
        let machine = &mut *self.machine;
        Ok(match (scalar.checked()?, kind) {
            (scalar @ Scalar::Float(_), ScalarKind::Float)
            | (scalar @ Scalar::Int(_), ScalarKind::Sint)
            | (scalar @ Scalar::Uint(_), ScalarKind::Uint)
            | (scalar @ Scalar::Bool(_), ScalarKind::Bool) => scalar,
            (Scalar::Bool(value), ScalarKind::Float) => {
                let (one, zero) = (machine.float(1.0), machine.float(0.0));
                Scalar::Float(machine.choose(value, one, zero)?)
            }
            (Scalar::Bool(value), ScalarKind::Sint | ScalarKind::Uint) => {
                match machine.decided(value) {
                    None => Scalar::Unknown,
                    Some(value) if kind == ScalarKind::Sint => Scalar::Int(value.into()),
                    Some(value) => Scalar::Uint(value.into()),
                }
            }
            (Scalar::Float(value), ScalarKind::Bool) => {
                let zero = machine.float(0.0);
                let is_zero = machine.equal(value, zero);
                Scalar::Bool(machine.not(is_zero))
            }
            // `as` saturates, as WGSL does.
            (Scalar::Float(value), ScalarKind::Sint) => match machine.known(value) {
                Some(value) => Scalar::Int(value as i32),
                None => Scalar::Unknown,
            },
            (Scalar::Float(value), ScalarKind::Uint) => match machine.known(value) {
                Some(value) => Scalar::Uint(value as u32),
                None => Scalar::Unknown,
            },
            (whole, ScalarKind::Float) => Scalar::Float(machine.float(whole.integer()? as f64)),
            (whole, ScalarKind::Bool) => Scalar::Bool(machine.boolean(whole.integer()? != 0)),
            (whole, ScalarKind::Sint) => Scalar::Int(whole.integer()? as i32),
            (whole, ScalarKind::Uint) => Scalar::Uint(whole.integer()? as u32),
            _ => return Err("this conversion is not understood".into()),
        })
    }

    /// Reinterprets the bits of 32-bit numbers.
    pub fn same_bits(&mut self, scalar: Scalar<M>, kind: ScalarKind) -> Result<Scalar<M>, Reason> {
        let machine = &mut *self.machine;
        let bits = match scalar.checked()? {
            Scalar::Float(value) => match (machine.known(value), kind) {
                (_, ScalarKind::Float) => return Ok(scalar),
                (Some(value), _) => (value as f32).to_bits(),
                (None, _) => return Ok(Scalar::Unknown),
            },
            whole => whole.integer()? as u32,
        };
        Ok(match kind {
            ScalarKind::Float => Scalar::Float(machine.float(f32::from_bits(bits).into())),
            ScalarKind::Sint => Scalar::Int(bits as i32),
            ScalarKind::Uint => Scalar::Uint(bits),
            _ => return Err("this conversion is not understood".into()),
        })
    }
}
