//! The trait of registers of `f32` lanes, and the register of one lane.

use std::ops::{Add, Div, Mul, Sub};

/// The bits of √½, rounded down.
pub(super) const SQRT_HALF: u32 = 0x3f35_04f3;

/// A register of `f32` lanes with IEEE-754 arithmetic, round to nearest even.
///
/// Every method acts lane by lane, and gives each lane the bits that the same method of `f32`
/// gives. Masks come from comparisons and go into [`select`](Self::select).
///
/// Only [`load`](Self::load) and [`broadcast`](Self::broadcast) make a value from nothing. Their
/// callers promise that the processor has the register; hence every other method is safe.
pub trait Lanes:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    /// Lanes in the register.
    const WIDTH: usize;
    /// One truth value per lane.
    type Mask: Copy;

    /// Reads `WIDTH` consecutive values.
    ///
    /// # Safety
    /// The processor has this register, and `from` is readable for `WIDTH` values.
    unsafe fn load(from: *const f32) -> Self;
    /// `value` in every lane.
    ///
    /// # Safety
    /// The processor has this register.
    unsafe fn broadcast(value: f32) -> Self;
    /// Writes `WIDTH` consecutive values.
    ///
    /// # Safety
    /// `to` is writable for `WIDTH` values.
    unsafe fn store(self, to: *mut f32);

    /// `value` in every lane.
    fn splat(self, value: f32) -> Self;
    /// `self * factor + addend`, rounded once.
    fn fma(self, factor: Self, addend: Self) -> Self;
    /// The square root, rounded once.
    fn sqrt(self) -> Self;
    /// The largest integer not above.
    fn floor(self) -> Self;
    /// The nearest integer, halves to even.
    fn round(self) -> Self;

    /// `self < other`; false where either is NaN.
    fn lt(self, other: Self) -> Self::Mask;
    /// `self == other`; false where either is NaN.
    fn eq(self, other: Self) -> Self::Mask;
    /// True where it is NaN.
    fn is_nan(self) -> Self::Mask;
    /// `yes` where `mask` holds, else `no`.
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;
    /// `low` where `low > self`, else `self` (NaN too).
    fn at_least(self, low: Self) -> Self;
    /// `high` where `high < self`, else `self` (NaN too).
    fn at_most(self, high: Self) -> Self;

    /// Bitwise and.
    fn bit_and(self, other: Self) -> Self;
    /// Bitwise or.
    fn bit_or(self, other: Self) -> Self;
    /// Bitwise exclusive or.
    fn bit_xor(self, other: Self) -> Self;
    /// The bits as integers, added modulo 2³².
    fn add_bits(self, other: Self) -> Self;
    /// The bits as integers, subtracted modulo 2³².
    fn sub_bits(self, other: Self) -> Self;
    /// Shifts the bits left, zeros in.
    fn shift_left<const N: i32>(self) -> Self;
    /// Shifts the bits right as a signed integer, sign bits in.
    fn shift_right<const N: i32>(self) -> Self;
    /// Converts the value, which must lie within ±2³⁰, to a signed integer, and returns its bits.
    fn to_int_bits(self) -> Self;
    /// Converts the bits as a signed integer to the nearest float.
    fn int_to_float(self) -> Self;

    /// The value with these bits, in every lane.
    #[inline(always)]
    fn bits(self, bits: u32) -> Self {
        self.splat(f32::from_bits(bits))
    }
    /// `−self`, by the sign bit.
    #[inline(always)]
    fn neg(self) -> Self {
        self.bit_xor(self.bits(0x8000_0000))
    }
    /// `|self|`, by the sign bit.
    #[inline(always)]
    fn abs(self) -> Self {
        self.bit_and(self.bits(0x7fff_ffff))
    }
    /// `self · 2ⁿ`, rounded once, for `self` within [½, 2] and an integral `n` within [−252, 254]:
    /// in two steps, so that the result may be denormal or infinite. NaN where either is NaN.
    #[inline(always)]
    fn scale_by_power_of_two(self, n: Self) -> Self {
        let n = n.to_int_bits();
        let half = n.shift_right::<1>();
        let rest = n.sub_bits(half);
        let bias = n.bits(127);
        let powers =
            (half.add_bits(bias).shift_left::<23>(), rest.add_bits(bias).shift_left::<23>());
        self * powers.0 * powers.1
    }
    /// Splits a positive finite value into `(e, m)` with `self = 2^e · m` and `m` in [√½, √2).
    #[inline(always)]
    fn exponent_and_mantissa(self) -> (Self, Self) {
        let denormal = self.lt(self.splat(f32::MIN_POSITIVE));
        let scaled = Self::select(denormal, self * self.splat(8_388_608.0), self);
        let offset = Self::select(denormal, self.splat(-23.0), self.splat(0.0));
        let e = scaled.sub_bits(self.bits(SQRT_HALF)).shift_right::<23>();
        (e.int_to_float() + offset, scaled.sub_bits(e.shift_left::<23>()))
    }
    /// Replaces `result` by −∞ where `self` is ±0, +∞ where it is +∞, and NaN where it is negative
    /// or NaN.
    #[inline(always)]
    fn logarithm_special_cases(self, result: Self) -> Self {
        let zero = self.splat(0.0);
        let infinity = self.splat(f32::INFINITY);
        let result = Self::select(self.eq(infinity), infinity, result);
        let result = Self::select(self.eq(zero), infinity.neg(), result);
        let result = Self::select(self.lt(zero), self.splat(f32::NAN), result);
        Self::select(self.is_nan(), self, result)
    }
    /// IEEE-754 2019 `minimum`: NaN if either is NaN, and −0 < +0.
    #[inline(always)]
    fn minimum(self, other: Self) -> Self {
        let smaller = other.at_most(self);
        let smaller = Self::select(self.eq(other), self.bit_or(other), smaller);
        Self::select(self.is_nan(), self, smaller)
    }
    /// IEEE-754 2019 `maximum`: NaN if either is NaN, and −0 < +0.
    #[inline(always)]
    fn maximum(self, other: Self) -> Self {
        let larger = other.at_least(self);
        let larger = Self::select(self.eq(other), self.bit_and(other), larger);
        Self::select(self.is_nan(), self, larger)
    }
}

impl Lanes for f32 {
    const WIDTH: usize = 1;
    type Mask = bool;

    #[inline(always)]
    unsafe fn load(from: *const f32) -> Self {
        // SAFETY: the caller promises a readable value.
        unsafe { from.read() }
    }
    #[inline(always)]
    unsafe fn broadcast(value: f32) -> Self {
        value
    }
    #[inline(always)]
    unsafe fn store(self, to: *mut f32) {
        // SAFETY: the caller promises a writable value.
        unsafe { to.write(self) }
    }
    #[inline(always)]
    fn splat(self, value: f32) -> Self {
        value
    }
    #[inline(always)]
    fn fma(self, factor: Self, addend: Self) -> Self {
        self.mul_add(factor, addend)
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        f32::sqrt(self)
    }
    #[inline(always)]
    fn floor(self) -> Self {
        f32::floor(self)
    }
    #[inline(always)]
    fn round(self) -> Self {
        self.round_ties_even()
    }
    #[inline(always)]
    fn lt(self, other: Self) -> bool {
        self < other
    }
    #[inline(always)]
    fn eq(self, other: Self) -> bool {
        self == other
    }
    #[inline(always)]
    fn is_nan(self) -> bool {
        f32::is_nan(self)
    }
    #[inline(always)]
    fn select(mask: bool, yes: Self, no: Self) -> Self {
        if mask { yes } else { no }
    }
    #[inline(always)]
    fn at_least(self, low: Self) -> Self {
        if low > self { low } else { self }
    }
    #[inline(always)]
    fn at_most(self, high: Self) -> Self {
        if high < self { high } else { self }
    }
    #[inline(always)]
    fn bit_and(self, other: Self) -> Self {
        f32::from_bits(self.to_bits() & other.to_bits())
    }
    #[inline(always)]
    fn bit_or(self, other: Self) -> Self {
        f32::from_bits(self.to_bits() | other.to_bits())
    }
    #[inline(always)]
    fn bit_xor(self, other: Self) -> Self {
        f32::from_bits(self.to_bits() ^ other.to_bits())
    }
    #[inline(always)]
    fn add_bits(self, other: Self) -> Self {
        f32::from_bits(self.to_bits().wrapping_add(other.to_bits()))
    }
    #[inline(always)]
    fn sub_bits(self, other: Self) -> Self {
        f32::from_bits(self.to_bits().wrapping_sub(other.to_bits()))
    }
    #[inline(always)]
    fn shift_left<const N: i32>(self) -> Self {
        f32::from_bits(self.to_bits() << N)
    }
    #[inline(always)]
    fn shift_right<const N: i32>(self) -> Self {
        f32::from_bits((self.to_bits() as i32 >> N) as u32)
    }
    #[inline(always)]
    fn to_int_bits(self) -> Self {
        f32::from_bits(self as i32 as u32)
    }
    #[inline(always)]
    fn int_to_float(self) -> Self {
        self.to_bits() as i32 as f32
    }
}
