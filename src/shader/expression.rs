//! Evaluates expressions of a module.

use super::interpreter::{Interpreter, Step};
use super::machine::{Extra, Machine, Reason};
use super::value::{Pointer, Scalar, Value, Vector};
use crate::op::Op;
use naga::{
    AddressSpace, ArraySize, BinaryOperator, Constant, Expression, Handle, Literal, MathFunction,
    RelationalFunction, ScalarKind, Type, TypeInner, UnaryOperator,
};

/// The most bytes of a value. By hand: tables of 64³ numbers are as large.
const LARGEST_TYPE: u32 = 1 << 20;

impl<'a, M: Machine> Interpreter<'a, '_, M> {
    /// Returns the value of an expression of the current call.
    pub fn value(&mut self, handle: Handle<Expression>) -> Step<Value<M>> {
        let Some(value) = &self.frame().values[handle.index()] else {
            return self.expression(handle);
        };
        let value = value.clone();
        if let Value::Several(_) = value {
            self.copy(value.size())?;
        }
        Ok(value)
    }

    pub fn pointer(&mut self, handle: Handle<Expression>) -> Step<Pointer> {
        match self.value(handle)? {
            Value::Pointer(pointer) => Ok(pointer),
            _ => Err("a place is expected".to_owned().into()),
        }
    }

    /// Evaluates an expression of the current call anew.
    pub fn expression(&mut self, handle: Handle<Expression>) -> Step<Value<M>> {
        let function = self.frame().function;
        let span = function.expressions.get_span(handle);
        self.evaluated(&function.expressions[handle]).map_err(|stop| stop.at(span))
    }

    fn evaluated(&mut self, expression: &'a Expression) -> Step<Value<M>> {
        let module = self.module;
        Ok(match *expression {
            Expression::Literal(literal) => Value::Scalar(self.literal(literal)?),
            Expression::Constant(constant) => {
                let value = self.known(constant)?.clone();
                self.copy(value.size())?;
                value
            }
            Expression::Override(handle) => {
                let name = module.overrides[handle].name.as_deref().unwrap_or("a constant");
                match module.overrides[handle].init {
                    Some(init) => self.constant(init)?,
                    None => {
                        return Err(
                            format!("`{name}` has no value: give it one in the file").into()
                        );
                    }
                }
            }
            Expression::ZeroValue(ty) => {
                let zero = self.zero(ty)?;
                self.copy(zero.size())?;
                zero
            }
            Expression::Compose { ty, ref components } => {
                let values = components.iter().map(|&component| self.value(component));
                let values = values.collect::<Step<Vec<_>>>()?;
                self.composed(ty, values)?
            }
            Expression::Access { base, index } => {
                let index = self.value(index)?.scalar()?.integer()?;
                let index =
                    u32::try_from(index).map_err(|_| format!("index {index} is out of bounds"))?;
                self.accessed(base, index)?
            }
            Expression::AccessIndex { base, index } => self.accessed(base, index)?,
            Expression::Splat { size, value } => {
                Value::Vector(Vector::splat(size, self.value(value)?.scalar()?))
            }
            Expression::Swizzle { size, vector, pattern } => {
                let vector = self.value(vector)?;
                let chosen = pattern[..size as usize]
                    .iter()
                    .map(|&c| vector.component(c as usize)?.scalar());
                Value::of(&chosen.collect::<Result<Vec<_>, Reason>>()?)
            }
            Expression::FunctionArgument(index) => self.frame().arguments[index as usize].clone(),
            Expression::GlobalVariable(handle) => {
                Value::Pointer(Pointer { frame: None, variable: handle.index(), path: Vec::new() })
            }
            Expression::LocalVariable(handle) => Value::Pointer(Pointer {
                frame: Some(self.frames.len() - 1),
                variable: handle.index(),
                path: Vec::new(),
            }),
            Expression::Load { pointer } => {
                let pointer = self.pointer(pointer)?;
                self.load(&pointer)?
            }
            Expression::ImageSample { .. }
            | Expression::ImageLoad { .. }
            | Expression::ImageQuery { .. } => {
                let reason = "it reads a texture; a texture can be imported as data (`lgp import`)";
                return Err(reason.to_owned().into());
            }
            Expression::Unary { op, expr } => {
                let value = self.value(expr)?;
                value.map(&mut |scalar| self.unary(op, scalar))?
            }
            Expression::Binary { op, left, right } => {
                let (left, right) = (self.value(left)?, self.value(right)?);
                self.binary(op, &left, &right)?
            }
            Expression::Select { condition, accept, reject } => {
                let condition = self.value(condition)?;
                let (accept, reject) = (self.value(accept)?, self.value(reject)?);
                self.selected(&condition, &accept, &reject)?
            }
            Expression::Derivative { .. } => {
                let reason = "it takes a derivative across pixels, which one sample has not; pass its value as a parameter";
                return Err(reason.to_owned().into());
            }
            Expression::Relational { fun, argument } => {
                let argument = self.value(argument)?;
                self.relational(fun, &argument)?
            }
            Expression::Math { fun, arg, arg1, arg2, arg3 } => {
                let arguments = [Some(arg), arg1, arg2, arg3].into_iter().flatten();
                let arguments = arguments.map(|a| self.value(a)).collect::<Step<Vec<_>>>()?;
                self.math(fun, &arguments)?
            }
            Expression::As { expr, kind, convert } => {
                let value = self.value(expr)?;
                match convert {
                    Some(width) if width > 4 && kind != ScalarKind::Float => {
                        return Err("integers of 64 bits are not understood".to_owned().into());
                    }
                    Some(_) => value.map(&mut |scalar| self.converted(scalar, kind))?,
                    None => value.map(&mut |scalar| self.same_bits(scalar, kind))?,
                }
            }
            Expression::CallResult(_) => {
                return Err("the function returns nothing".to_owned().into());
            }
            Expression::ArrayLength(pointer) => {
                let pointer = self.pointer(pointer)?;
                match self.load(&pointer)? {
                    Value::Several(values) => Value::Scalar(Scalar::Uint(values.len() as u32)),
                    _ => return Err("an array is expected".to_owned().into()),
                }
            }
            _ => {
                let reason = "it depends on other invocations or traces rays; approximate a function of values";
                return Err(reason.to_owned().into());
            }
        })
    }

    /// Evaluates an expression outside functions.
    pub fn constant(&mut self, handle: Handle<Expression>) -> Result<Value<M>, Reason> {
        let module = self.module;
        Ok(match module.global_expressions[handle] {
            Expression::Literal(literal) => Value::Scalar(self.literal(literal)?),
            Expression::Constant(constant) => self.constant(module.constants[constant].init)?,
            Expression::ZeroValue(ty) => self.zero(ty)?,
            Expression::Compose { ty, ref components } => {
                let values = components.iter().map(|&component| self.constant(component));
                let values = values.collect::<Result<Vec<_>, Reason>>()?;
                self.composed(ty, values)?
            }
            Expression::Splat { size, value } => {
                Value::Vector(Vector::splat(size, self.constant(value)?.scalar()?))
            }
            _ => return Err("its initial value is not understood".into()),
        })
    }

    fn literal(&mut self, literal: Literal) -> Result<Scalar<M>, Reason> {
        let float = match literal {
            Literal::F64(value) => value,
            Literal::F32(value) => value.into(),
            Literal::F16(value) => value.into(),
            Literal::AbstractFloat(value) => value,
            Literal::Bool(value) => return Ok(Scalar::Bool(self.machine.boolean(value))),
            Literal::I32(value) => return Ok(Scalar::Int(value)),
            Literal::U32(value) => return Ok(Scalar::Uint(value)),
            Literal::I16(value) => return Ok(Scalar::Int(value.into())),
            Literal::U16(value) => return Ok(Scalar::Uint(value.into())),
            Literal::AbstractInt(value) => {
                let narrow = i32::try_from(value).map_err(|_| format!("{value} is too large"))?;
                return Ok(Scalar::Int(narrow));
            }
            Literal::U64(_) | Literal::I64(_) => {
                return Err("integers of 64 bits are not understood".into());
            }
        };
        Ok(Scalar::Float(self.machine.float(float)))
    }

    /// Returns the value of a type that is zero throughout.
    pub fn zero(&mut self, ty: Handle<Type>) -> Result<Value<M>, Reason> {
        let module = self.module;
        let bytes = module.types[ty].inner.try_size(module.to_ctx());
        if bytes.is_none_or(|bytes| bytes > LARGEST_TYPE) {
            return Err("its type is too large, or has no size".into());
        }
        Ok(match module.types[ty].inner {
            TypeInner::Scalar(kind) | TypeInner::Atomic(kind) => {
                Value::Scalar(Scalar::zero(&mut *self.machine, kind)?)
            }
            TypeInner::Vector { size, scalar } => {
                Value::Vector(Vector::splat(size, Scalar::zero(&mut *self.machine, scalar)?))
            }
            TypeInner::Matrix { columns, rows, scalar } => {
                let column = Vector::splat(rows, Scalar::zero(&mut *self.machine, scalar)?);
                Value::Several(vec![Value::Vector(column); columns as usize])
            }
            TypeInner::Array { base, size: ArraySize::Constant(size), .. } => {
                Value::Several(vec![self.zero(base)?; size.get() as usize])
            }
            TypeInner::Struct { ref members, .. } => {
                let members = members.iter().map(|member| self.zero(member.ty));
                Value::Several(members.collect::<Result<_, _>>()?)
            }
            _ => return Err("its type is not understood".into()),
        })
    }

    fn composed(&mut self, ty: Handle<Type>, values: Vec<Value<M>>) -> Result<Value<M>, Reason> {
        Ok(match self.module.types[ty].inner {
            TypeInner::Vector { .. } => {
                let scalars: Vec<_> = values.iter().flat_map(Value::flattened).collect();
                Value::Vector(Vector::of(&scalars))
            }
            TypeInner::Matrix { rows, .. } if values.iter().all(|v| v.scalar().is_ok()) => {
                let scalars: Vec<_> = values.iter().flat_map(Value::flattened).collect();
                let columns = scalars.chunks(rows as usize).map(|c| Value::Vector(Vector::of(c)));
                Value::Several(columns.collect())
            }
            _ => Value::Several(values),
        })
    }

    /// Returns the value of a constant.
    fn known(&mut self, constant: Handle<Constant>) -> Result<&Value<M>, Reason> {
        if self.constants[constant.index()].is_none() {
            let value = self.constant(self.module.constants[constant].init)?;
            self.copy(value.size())?;
            self.constants[constant.index()] = Some(value);
        }
        self.constants[constant.index()].as_ref().ok_or_else(|| "it has no value".into())
    }

    /// Returns a component of a value, which may be a large table that is not worth a copy.
    fn accessed(&mut self, base: Handle<Expression>, index: u32) -> Step<Value<M>> {
        let at = index as usize;
        let function = self.frame().function;
        match &self.frame().values[base.index()] {
            Some(value @ Value::Several(_)) => return Ok(value.component(at)?),
            Some(_) => {}
            None => {
                if let Expression::Constant(constant) = function.expressions[base] {
                    return Ok(self.known(constant)?.component(at)?);
                }
            }
        }
        Ok(match self.value(base)? {
            Value::Pointer(pointer) => Value::Pointer(pointer.component(index)),
            value => value.component(at)?,
        })
    }

    fn load(&mut self, pointer: &Pointer) -> Step<Value<M>> {
        let mut value = &*self.variable(pointer);
        let mut path = pointer.path.as_slice();
        while let (Value::Several(values), [first, rest @ ..]) = (value, path) {
            let outside = || format!("index {first} is out of bounds");
            (value, path) = (values.get(*first as usize).ok_or_else(outside)?, rest);
        }
        let value = match path {
            [] => value.clone(),
            [last] => value.component(*last as usize)?,
            _ => return Err("it has no components".to_owned().into()),
        };
        self.copy(value.size())?;
        // Of a vector, one component may be all that is used.
        let is_unset = |scalar: &Scalar<M>| matches!(scalar, Scalar::Unset);
        let scalars = value.flattened();
        let is_empty = !scalars.is_empty() && scalars.iter().all(is_unset);
        if pointer.frame.is_none() && is_empty {
            return Err(self.without_value(pointer).into());
        }
        Ok(value)
    }

    /// Says which uniform has no value, and what to do.
    fn without_value(&self, pointer: &Pointer) -> Reason {
        let mut globals = self.module.global_variables.iter();
        let Some((_, global)) = globals.find(|(handle, _)| handle.index() == pointer.variable)
        else {
            let place = pointer.variable - self.module.global_variables.len();
            let name = self.places.get(place).map_or("", String::as_str);
            return format!(
                "`{name}` is read before it is written; give its value, by --set or in the --domain"
            );
        };
        let mut name = global.name.clone().unwrap_or_default();
        let mut ty = global.ty;
        for &index in &pointer.path {
            let TypeInner::Struct { members, .. } = &self.module.types[ty].inner else { break };
            let Some(member) = members.get(index as usize) else { break };
            let member_name = member.name.as_deref().unwrap_or("");
            // The members of a nameless block are written without it.
            name = if name.is_empty() {
                member_name.to_owned()
            } else {
                format!("{name}.{member_name}")
            };
            ty = member.ty;
        }
        let kind = match global.space {
            AddressSpace::Uniform => "a uniform",
            AddressSpace::Storage { .. } => "a buffer",
            _ => "an input of the stage",
        };
        format!(
            "`{name}` is {kind}; fix it, as in --set {name}=1.0, or give it a range in the --domain"
        )
    }

    fn unary(&mut self, op: UnaryOperator, scalar: Scalar<M>) -> Result<Scalar<M>, Reason> {
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

    fn selected(
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

    fn relational(
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

    fn converted(&mut self, scalar: Scalar<M>, kind: ScalarKind) -> Result<Scalar<M>, Reason> {
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
    fn same_bits(&mut self, scalar: Scalar<M>, kind: ScalarKind) -> Result<Scalar<M>, Reason> {
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

/// Returns the operation that a function is, where it is one of the table.
pub(super) fn operation(function: MathFunction) -> Option<Op> {
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
