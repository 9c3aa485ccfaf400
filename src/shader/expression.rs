//! Evaluates expressions of a module.

use super::interpreter::{Interpreter, Step};
use super::machine::{Machine, Reason};
use super::value::{Pointer, Scalar, Value, Vector};
use naga::{
    AddressSpace, ArraySize, Constant, Expression, Handle, Literal, ScalarKind, Type, TypeInner,
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
}
