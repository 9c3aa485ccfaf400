//! Values of shaders.

use super::machine::{Machine, Reason};
use naga::{Scalar as Kind, ScalarKind, VectorSize};

/// A number or a truth value.
#[derive(Debug)]
pub(super) enum Scalar<M: Machine> {
    Float(M::Float),
    Bool(M::Bool),
    Int(i32),
    Uint(u32),
    /// An integer that depends on what is unknown; whoever reads it must stop.
    Unknown,
    /// Nothing yet: an `out` parameter before it is written.
    Unset,
}

// Derived, they would ask for a machine that can be copied.
impl<M: Machine> Clone for Scalar<M> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<M: Machine> Copy for Scalar<M> {}

/// A value of any type. A matrix is its columns.
#[derive(Debug)]
pub(super) enum Value<M: Machine> {
    Scalar(Scalar<M>),
    Vector(Vector<M>),
    Several(Vec<Value<M>>),
    Pointer(Pointer),
}

impl<M: Machine> Clone for Value<M> {
    fn clone(&self) -> Self {
        match self {
            Value::Scalar(scalar) => Value::Scalar(*scalar),
            Value::Vector(vector) => Value::Vector(*vector),
            Value::Several(values) => Value::Several(values.clone()),
            Value::Pointer(pointer) => Value::Pointer(pointer.clone()),
        }
    }
}

/// Two to four scalars.
#[derive(Debug)]
pub(super) struct Vector<M: Machine> {
    all: [Scalar<M>; 4],
    length: u8,
}

impl<M: Machine> Clone for Vector<M> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<M: Machine> Copy for Vector<M> {}

impl<M: Machine> Vector<M> {
    pub fn of(scalars: &[Scalar<M>]) -> Vector<M> {
        let mut all = [Scalar::Unset; 4];
        let length = scalars.len().min(4);
        all[..length].copy_from_slice(&scalars[..length]);
        Vector { all, length: length as u8 }
    }

    pub fn splat(size: VectorSize, scalar: Scalar<M>) -> Vector<M> {
        Vector { all: [scalar; 4], length: size as u8 }
    }

    pub fn scalars(&self) -> &[Scalar<M>] {
        &self.all[..usize::from(self.length)]
    }

    pub fn scalars_mut(&mut self) -> &mut [Scalar<M>] {
        &mut self.all[..usize::from(self.length)]
    }
}

/// A place in a variable.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Pointer {
    /// The frame whose local it is; none for a global.
    pub frame: Option<usize>,
    /// The index of the variable there.
    pub variable: usize,
    /// The indices of the component, from outside to inside.
    pub path: Vec<u32>,
}

impl Pointer {
    pub fn component(&self, index: u32) -> Pointer {
        let mut path = self.path.clone();
        path.push(index);
        Pointer { path, ..*self }
    }
}

const UNKNOWN: &str = "an integer depends on the inputs";
const UNSET: &str = "it has no value yet; give it one, by --set or in the --domain";

impl<M: Machine> Scalar<M> {
    pub fn float(self) -> Result<M::Float, Reason> {
        match self {
            Scalar::Float(value) => Ok(value),
            Scalar::Unset => Err(UNSET.into()),
            _ => Err("a float is expected".into()),
        }
    }

    pub fn boolean(self) -> Result<M::Bool, Reason> {
        match self {
            Scalar::Bool(value) => Ok(value),
            Scalar::Unset => Err(UNSET.into()),
            _ => Err("a truth value is expected".into()),
        }
    }

    /// Returns the value of an integer.
    pub fn integer(self) -> Result<i64, Reason> {
        match self {
            Scalar::Int(value) => Ok(value.into()),
            Scalar::Uint(value) => Ok(value.into()),
            Scalar::Unknown => Err(UNKNOWN.into()),
            Scalar::Unset => Err(UNSET.into()),
            Scalar::Float(_) | Scalar::Bool(_) => Err("an integer is expected".into()),
        }
    }

    /// Refuses what cannot be computed with.
    pub fn checked(self) -> Result<Self, Reason> {
        match self {
            Scalar::Unknown => Err(UNKNOWN.into()),
            Scalar::Unset => Err(UNSET.into()),
            scalar => Ok(scalar),
        }
    }

    pub fn zero(machine: &mut M, kind: Kind) -> Result<Scalar<M>, Reason> {
        match kind.kind {
            ScalarKind::Float | ScalarKind::AbstractFloat => Ok(Scalar::Float(machine.float(0.0))),
            ScalarKind::Bool => Ok(Scalar::Bool(machine.boolean(false))),
            ScalarKind::Sint | ScalarKind::AbstractInt if kind.width <= 4 => Ok(Scalar::Int(0)),
            ScalarKind::Uint if kind.width <= 4 => Ok(Scalar::Uint(0)),
            _ => Err("integers of 64 bits are not understood".into()),
        }
    }
}

impl<M: Machine> Value<M> {
    pub fn scalar(&self) -> Result<Scalar<M>, Reason> {
        match self {
            Value::Scalar(scalar) => Ok(*scalar),
            _ => Err("a scalar is expected".into()),
        }
    }

    pub fn float(&self) -> Result<M::Float, Reason> {
        self.scalar()?.float()
    }

    /// Returns the scalars of a scalar or a vector.
    pub fn scalars(&self) -> Result<&[Scalar<M>], Reason> {
        match self {
            Value::Scalar(scalar) => Ok(std::slice::from_ref(scalar)),
            Value::Vector(vector) => Ok(vector.scalars()),
            Value::Several(_) | Value::Pointer(_) => Err("a scalar or a vector is expected".into()),
        }
    }

    pub fn floats(&self) -> Result<Vec<M::Float>, Reason> {
        self.scalars()?.iter().map(|scalar| scalar.float()).collect()
    }

    /// Makes a vector, or a scalar of one.
    pub fn of(scalars: &[Scalar<M>]) -> Value<M> {
        match scalars {
            [one] => Value::Scalar(*one),
            several => Value::Vector(Vector::of(several)),
        }
    }

    pub fn of_floats(floats: &[M::Float]) -> Value<M> {
        let scalars: Vec<_> = floats.iter().map(|&float| Scalar::Float(float)).collect();
        Value::of(&scalars)
    }

    /// Makes a value of the same shape of each scalar.
    pub fn map(
        &self,
        f: &mut impl FnMut(Scalar<M>) -> Result<Scalar<M>, Reason>,
    ) -> Result<Value<M>, Reason> {
        Ok(match self {
            Value::Scalar(scalar) => Value::Scalar(f(*scalar)?),
            Value::Vector(vector) => {
                let mut vector = *vector;
                for scalar in vector.scalars_mut() {
                    *scalar = f(*scalar)?;
                }
                Value::Vector(vector)
            }
            Value::Several(values) => {
                let values = values.iter().map(|value| value.map(f));
                Value::Several(values.collect::<Result<_, _>>()?)
            }
            Value::Pointer(_) => return Err("a value is expected, not a place".into()),
        })
    }

    /// Combines two values scalar by scalar; a scalar goes with each of the other's.
    pub fn zip(
        &self,
        other: &Value<M>,
        f: &mut impl FnMut(Scalar<M>, Scalar<M>) -> Result<Scalar<M>, Reason>,
    ) -> Result<Value<M>, Reason> {
        Ok(match (self, other) {
            (Value::Scalar(a), Value::Scalar(b)) => Value::Scalar(f(*a, *b)?),
            (Value::Scalar(a), other) => other.map(&mut |b| f(*a, b))?,
            (one, Value::Scalar(b)) => one.map(&mut |a| f(a, *b))?,
            (Value::Vector(a), Value::Vector(b)) => {
                let mut result = *a;
                for (scalar, &b) in result.scalars_mut().iter_mut().zip(b.scalars()) {
                    *scalar = f(*scalar, b)?;
                }
                Value::Vector(result)
            }
            (Value::Several(a), Value::Several(b)) if a.len() == b.len() => {
                let pairs = a.iter().zip(b).map(|(a, b)| a.zip(b, f));
                Value::Several(pairs.collect::<Result<_, _>>()?)
            }
            (Value::Pointer(a), Value::Pointer(b)) if a == b => Value::Pointer(a.clone()),
            _ => return Err("values of different types meet".into()),
        })
    }

    /// Returns a component of a vector, matrix, array or structure.
    pub fn component(&self, index: usize) -> Result<Value<M>, Reason> {
        let found = match self {
            Value::Vector(vector) => vector.scalars().get(index).map(|&s| Value::Scalar(s)),
            Value::Several(values) => values.get(index).cloned(),
            Value::Scalar(_) | Value::Pointer(_) => None,
        };
        found.ok_or_else(|| format!("index {index} is out of bounds"))
    }

    /// Replaces the component at a path.
    pub fn store(&mut self, path: &[u32], value: Value<M>) -> Result<(), Reason> {
        let Some((&first, rest)) = path.split_first() else {
            *self = value;
            return Ok(());
        };
        let index = first as usize;
        match self {
            Value::Vector(vector) => {
                let to = vector.scalars_mut().get_mut(index);
                *to.ok_or_else(|| format!("index {index} is out of bounds"))? = value.scalar()?;
                Ok(())
            }
            Value::Several(values) => {
                let to = values.get_mut(index);
                to.ok_or_else(|| format!("index {index} is out of bounds"))?.store(rest, value)
            }
            Value::Scalar(_) | Value::Pointer(_) => Err("it has no components".into()),
        }
    }

    /// Returns the number of its scalars.
    pub fn size(&self) -> usize {
        match self {
            Value::Scalar(_) | Value::Pointer(_) => 1,
            Value::Vector(_) => 4,
            Value::Several(values) => values.iter().map(Value::size).sum(),
        }
    }

    /// Returns all scalars, in order.
    pub fn flattened(&self) -> Vec<Scalar<M>> {
        match self {
            Value::Scalar(scalar) => vec![*scalar],
            Value::Vector(vector) => vector.scalars().to_vec(),
            Value::Several(values) => values.iter().flat_map(Value::flattened).collect(),
            Value::Pointer(_) => Vec::new(),
        }
    }
}
