//! The numbers that shaders are interpreted in.

use crate::eval::{Arithmetic, Double};
use crate::op::{MAX_ARITY, Op};
use std::fmt::Debug;
use std::marker::PhantomData;

/// Functions of shading languages that no operation is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Extra {
    Sinh,
    Cosh,
    Asinh,
    Acosh,
    Atanh,
    /// To the nearest whole number, halves to the even one.
    Round,
    /// Of a division truncated to a whole number, with the sign of the dividend.
    Remainder,
}

/// A reason to stop that concerns values; the interpreter adds the place.
pub(super) type Reason = String;

/// Floats and truth values as an interpreter needs them.
pub(super) trait Machine {
    type Float: Copy + Debug;
    type Bool: Copy + Debug;

    /// True if values may be unknown, so that conditions may be undecided.
    const SYMBOLIC: bool;

    fn float(&mut self, value: f64) -> Self::Float;
    fn boolean(&mut self, value: bool) -> Self::Bool;
    /// Returns the number that a float is, if it is known.
    fn known(&self, value: Self::Float) -> Option<f64>;
    /// Returns the truth value that a condition has, if it is known.
    fn decided(&self, condition: Self::Bool) -> Option<bool>;
    fn apply(&mut self, op: Op, args: [Self::Float; MAX_ARITY]) -> Result<Self::Float, Reason>;
    fn extra(
        &mut self,
        function: Extra,
        a: Self::Float,
        b: Self::Float,
    ) -> Result<Self::Float, Reason>;
    fn less(&mut self, a: Self::Float, b: Self::Float) -> Self::Bool;
    fn equal(&mut self, a: Self::Float, b: Self::Float) -> Self::Bool;
    fn not(&mut self, a: Self::Bool) -> Self::Bool;
    fn and(&mut self, a: Self::Bool, b: Self::Bool) -> Self::Bool;
    fn or(&mut self, a: Self::Bool, b: Self::Bool) -> Self::Bool;
    /// Returns `yes` where the condition holds, else `no`.
    fn choose(
        &mut self,
        condition: Self::Bool,
        yes: Self::Float,
        no: Self::Float,
    ) -> Result<Self::Float, Reason>;

    fn unary(&mut self, op: Op, a: Self::Float) -> Result<Self::Float, Reason> {
        self.apply(op, [a; MAX_ARITY])
    }

    fn binary(&mut self, op: Op, a: Self::Float, b: Self::Float) -> Result<Self::Float, Reason> {
        self.apply(op, [a, b, b, b])
    }
}

/// Numbers of one precision, all of them known.
#[derive(Clone, Copy, Debug)]
pub(super) struct Concrete<T>(PhantomData<T>);

/// Double precision: what the shader means.
pub(super) type Exact = Concrete<f64>;
/// Single precision, as the interpreter of formulas computes.
pub(super) type Single = Concrete<f32>;

impl<T> Default for Concrete<T> {
    fn default() -> Self {
        Concrete(PhantomData)
    }
}

/// A precision.
pub(super) trait Number: Copy + Debug + PartialOrd {
    fn of(value: f64) -> Self;
    fn value(self) -> f64;
    fn apply(op: Op, args: [Self; MAX_ARITY]) -> Self;
}

impl Number for f64 {
    fn of(value: f64) -> f64 {
        value
    }

    fn value(self) -> f64 {
        self
    }

    fn apply(op: Op, args: [f64; MAX_ARITY]) -> f64 {
        Double.apply(op, args)
    }
}

impl Number for f32 {
    fn of(value: f64) -> f32 {
        value as f32
    }

    fn value(self) -> f64 {
        self.into()
    }

    fn apply(op: Op, args: [f32; MAX_ARITY]) -> f32 {
        op.apply(args)
    }
}

impl<T: Number> Machine for Concrete<T> {
    type Float = T;
    type Bool = bool;

    const SYMBOLIC: bool = false;

    fn float(&mut self, value: f64) -> T {
        T::of(value)
    }

    fn boolean(&mut self, value: bool) -> bool {
        value
    }

    fn known(&self, value: T) -> Option<f64> {
        Some(value.value())
    }

    fn decided(&self, condition: bool) -> Option<bool> {
        Some(condition)
    }

    fn apply(&mut self, op: Op, args: [T; MAX_ARITY]) -> Result<T, Reason> {
        Ok(T::apply(op, args))
    }

    fn extra(&mut self, function: Extra, a: T, b: T) -> Result<T, Reason> {
        let (a, b) = (a.value(), b.value());
        Ok(T::of(match function {
            Extra::Sinh => libm::sinh(a),
            Extra::Cosh => libm::cosh(a),
            Extra::Asinh => libm::asinh(a),
            Extra::Acosh => libm::acosh(a),
            Extra::Atanh => libm::atanh(a),
            Extra::Round => a.round_ties_even(),
            Extra::Remainder => a % b,
        }))
    }

    fn less(&mut self, a: T, b: T) -> bool {
        a < b
    }

    fn equal(&mut self, a: T, b: T) -> bool {
        a == b
    }

    fn not(&mut self, a: bool) -> bool {
        !a
    }

    fn and(&mut self, a: bool, b: bool) -> bool {
        a && b
    }

    fn or(&mut self, a: bool, b: bool) -> bool {
        a || b
    }

    fn choose(&mut self, condition: bool, yes: T, no: T) -> Result<T, Reason> {
        Ok(if condition { yes } else { no })
    }
}
