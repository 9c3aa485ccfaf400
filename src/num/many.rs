//! Several registers used as one.

use super::Lanes;
use std::ops::{Add, Div, Mul, Sub};

/// An array of `N` expressions that differ in the index alone.
///
/// `array::from_fn` would not do: its closure is not always inlined, and by itself it is compiled
/// without the register's instructions.
macro_rules! array_of {
    ($i:ident => $element:expr) => {{
        let $i = 0;
        let mut array = [$element; N];
        for $i in 1..N {
            array[$i] = $element;
        }
        array
    }};
}

/// `N` registers side by side, as one register of `N` times the width.
#[derive(Clone, Copy)]
pub struct Many<L, const N: usize>([L; N]);

macro_rules! operators_by_register {
    ($($operator:ident $method:ident),*) => {$(
        impl<L: Lanes, const N: usize> $operator for Many<L, N> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Many(array_of!(i => self.0[i].$method(other.0[i])))
            }
        }
    )*};
}
operators_by_register!(Add add, Sub sub, Mul mul, Div div);

macro_rules! by_register {
    (unary $($name:ident),*) => {$(
        #[inline(always)]
        fn $name(self) -> Self {
            Many(array_of!(i => self.0[i].$name()))
        }
    )*};
    (binary $($name:ident),*) => {$(
        #[inline(always)]
        fn $name(self, other: Self) -> Self {
            Many(array_of!(i => self.0[i].$name(other.0[i])))
        }
    )*};
}

impl<L: Lanes, const N: usize> Lanes for Many<L, N> {
    const WIDTH: usize = N * L::WIDTH;
    type Mask = [L::Mask; N];

    #[inline(always)]
    unsafe fn load(from: *const f32) -> Self {
        // SAFETY: the caller promises N * L::WIDTH readable values.
        Many(array_of!(i => unsafe { L::load(from.add(i * L::WIDTH)) }))
    }
    #[inline(always)]
    unsafe fn broadcast(value: f32) -> Self {
        // SAFETY: the caller promises that the processor has L.
        Many([unsafe { L::broadcast(value) }; N])
    }
    #[inline(always)]
    unsafe fn store(self, to: *mut f32) {
        for (i, register) in self.0.into_iter().enumerate() {
            // SAFETY: the caller promises N * L::WIDTH writable values.
            unsafe { register.store(to.add(i * L::WIDTH)) }
        }
    }
    #[inline(always)]
    fn splat(self, value: f32) -> Self {
        Many([self.0[0].splat(value); N])
    }
    #[inline(always)]
    fn fma(self, factor: Self, addend: Self) -> Self {
        Many(array_of!(i => self.0[i].fma(factor.0[i], addend.0[i])))
    }
    #[inline(always)]
    fn lt(self, other: Self) -> Self::Mask {
        array_of!(i => self.0[i].lt(other.0[i]))
    }
    #[inline(always)]
    fn eq(self, other: Self) -> Self::Mask {
        array_of!(i => self.0[i].eq(other.0[i]))
    }
    #[inline(always)]
    fn is_nan(self) -> Self::Mask {
        array_of!(i => self.0[i].is_nan())
    }
    #[inline(always)]
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self {
        Many(array_of!(i => L::select(mask[i], yes.0[i], no.0[i])))
    }
    #[inline(always)]
    fn shift_left<const S: i32>(self) -> Self {
        Many(array_of!(i => self.0[i].shift_left::<S>()))
    }
    #[inline(always)]
    fn shift_right<const S: i32>(self) -> Self {
        Many(array_of!(i => self.0[i].shift_right::<S>()))
    }
    #[inline(always)]
    fn exponent_and_mantissa(self) -> (Self, Self) {
        let parts = array_of!(i => self.0[i].exponent_and_mantissa());
        (Many(array_of!(i => parts[i].0)), Many(array_of!(i => parts[i].1)))
    }
    by_register!(unary sqrt, floor, round, to_int_bits, int_to_float);
    by_register!(binary at_least, at_most, bit_and, bit_or, bit_xor, add_bits, sub_bits, minimum, maximum,
        scale_by_power_of_two, logarithm_special_cases);
}
