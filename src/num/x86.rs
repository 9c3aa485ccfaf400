//! AVX2 and AVX-512 registers.
//!
//! SAFETY, for every `unsafe` here: a value of these types exists only where the caller of
//! [`Lanes::load`] or [`Lanes::broadcast`] has promised the processor's features
//! (AVX2 and FMA; AVX-512 F and DQ), so each method that has one may use them.

use super::Lanes;
use super::lanes::SQRT_HALF;
use std::arch::x86_64::*;
use std::ops::{Add, Div, Mul, Sub};

/// Eight lanes: a 256-bit register of a processor with AVX2 and FMA.
#[derive(Clone, Copy)]
pub struct Avx2(__m256);

/// Sixteen lanes: a 512-bit register of a processor with AVX-512 F and DQ.
#[derive(Clone, Copy)]
pub struct Avx512(__m512);

macro_rules! operators {
    ($register:ident: $($operator:ident $method:ident $intrinsic:ident),*) => {$(
        impl $operator for $register {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                // SAFETY: see the head of this file.
                $register(unsafe { $intrinsic(self.0, other.0) })
            }
        }
    )*};
}
operators!(Avx2: Add add _mm256_add_ps, Sub sub _mm256_sub_ps, Mul mul _mm256_mul_ps, Div div _mm256_div_ps);
operators!(Avx512: Add add _mm512_add_ps, Sub sub _mm512_sub_ps, Mul mul _mm512_mul_ps, Div div _mm512_div_ps);

/// Defines methods by one intrinsic each.
macro_rules! methods {
    (floats $($name:ident($($arg:ident),*) = $body:expr;)*) => {$(
        #[inline(always)]
        fn $name(self $(, $arg: Self)*) -> Self {
            // SAFETY: see the head of this file.
            #[allow(clippy::redundant_closure_call)]
            Self(unsafe { ($body)(self.0 $(, $arg.0)*) })
        }
    )*};
}

impl Lanes for Avx2 {
    const WIDTH: usize = 8;
    type Mask = __m256;

    #[inline(always)]
    unsafe fn load(from: *const f32) -> Self {
        // SAFETY: promised by the caller.
        Avx2(unsafe { _mm256_loadu_ps(from) })
    }
    #[inline(always)]
    unsafe fn broadcast(value: f32) -> Self {
        // SAFETY: promised by the caller.
        Avx2(unsafe { _mm256_set1_ps(value) })
    }
    #[inline(always)]
    unsafe fn store(self, to: *mut f32) {
        // SAFETY: promised by the caller.
        unsafe { _mm256_storeu_ps(to, self.0) }
    }
    #[inline(always)]
    fn splat(self, value: f32) -> Self {
        // SAFETY: see the head of this file.
        Avx2(unsafe { _mm256_set1_ps(value) })
    }
    #[inline(always)]
    fn lt(self, other: Self) -> __m256 {
        // SAFETY: see the head of this file.
        unsafe { _mm256_cmp_ps::<_CMP_LT_OQ>(self.0, other.0) }
    }
    #[inline(always)]
    fn eq(self, other: Self) -> __m256 {
        // SAFETY: see the head of this file.
        unsafe { _mm256_cmp_ps::<_CMP_EQ_OQ>(self.0, other.0) }
    }
    #[inline(always)]
    fn is_nan(self) -> __m256 {
        // SAFETY: see the head of this file.
        unsafe { _mm256_cmp_ps::<_CMP_UNORD_Q>(self.0, self.0) }
    }
    #[inline(always)]
    fn select(mask: __m256, yes: Self, no: Self) -> Self {
        // SAFETY: see the head of this file.
        Avx2(unsafe { _mm256_blendv_ps(no.0, yes.0, mask) })
    }
    #[inline(always)]
    fn shift_left<const N: i32>(self) -> Self {
        // SAFETY: see the head of this file.
        Avx2(unsafe { _mm256_castsi256_ps(_mm256_slli_epi32::<N>(_mm256_castps_si256(self.0))) })
    }
    #[inline(always)]
    fn shift_right<const N: i32>(self) -> Self {
        // SAFETY: see the head of this file.
        Avx2(unsafe { _mm256_castsi256_ps(_mm256_srai_epi32::<N>(_mm256_castps_si256(self.0))) })
    }
    methods! { floats
        fma(b, c) = |a, b, c| _mm256_fmadd_ps(a, b, c);
        sqrt() = |a| _mm256_sqrt_ps(a);
        floor() = |a| _mm256_round_ps::<{ _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC }>(a);
        round() = |a| _mm256_round_ps::<{ _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC }>(a);
        // MAXPS and MINPS give their second operand where the first is not larger (smaller).
        at_least(low) = |a, low| _mm256_max_ps(low, a);
        at_most(high) = |a, high| _mm256_min_ps(high, a);
        bit_and(b) = |a, b| _mm256_and_ps(a, b);
        bit_or(b) = |a, b| _mm256_or_ps(a, b);
        bit_xor(b) = |a, b| _mm256_xor_ps(a, b);
        add_bits(b) = |a, b| _mm256_castsi256_ps(_mm256_add_epi32(_mm256_castps_si256(a), _mm256_castps_si256(b)));
        sub_bits(b) = |a, b| _mm256_castsi256_ps(_mm256_sub_epi32(_mm256_castps_si256(a), _mm256_castps_si256(b)));
        to_int_bits() = |a| _mm256_castsi256_ps(_mm256_cvttps_epi32(a));
        int_to_float() = |a| _mm256_cvtepi32_ps(_mm256_castps_si256(a));
    }
}

impl Lanes for Avx512 {
    const WIDTH: usize = 16;
    type Mask = __mmask16;

    #[inline(always)]
    unsafe fn load(from: *const f32) -> Self {
        // SAFETY: promised by the caller.
        Avx512(unsafe { _mm512_loadu_ps(from) })
    }
    #[inline(always)]
    unsafe fn broadcast(value: f32) -> Self {
        // SAFETY: promised by the caller.
        Avx512(unsafe { _mm512_set1_ps(value) })
    }
    #[inline(always)]
    unsafe fn store(self, to: *mut f32) {
        // SAFETY: promised by the caller.
        unsafe { _mm512_storeu_ps(to, self.0) }
    }
    #[inline(always)]
    fn splat(self, value: f32) -> Self {
        // SAFETY: see the head of this file.
        Avx512(unsafe { _mm512_set1_ps(value) })
    }
    #[inline(always)]
    fn lt(self, other: Self) -> __mmask16 {
        // SAFETY: see the head of this file.
        unsafe { _mm512_cmp_ps_mask::<_CMP_LT_OQ>(self.0, other.0) }
    }
    #[inline(always)]
    fn eq(self, other: Self) -> __mmask16 {
        // SAFETY: see the head of this file.
        unsafe { _mm512_cmp_ps_mask::<_CMP_EQ_OQ>(self.0, other.0) }
    }
    #[inline(always)]
    fn is_nan(self) -> __mmask16 {
        // SAFETY: see the head of this file.
        unsafe { _mm512_cmp_ps_mask::<_CMP_UNORD_Q>(self.0, self.0) }
    }
    #[inline(always)]
    fn select(mask: __mmask16, yes: Self, no: Self) -> Self {
        // SAFETY: see the head of this file.
        Avx512(unsafe { _mm512_mask_blend_ps(mask, no.0, yes.0) })
    }
    #[inline(always)]
    fn shift_left<const N: i32>(self) -> Self {
        // SAFETY: see the head of this file. The shift is `N as u32`, which a constant
        // expression of a generic cannot say; the count form has the same effect.
        Avx512(unsafe {
            _mm512_castsi512_ps(_mm512_sll_epi32(_mm512_castps_si512(self.0), _mm_cvtsi32_si128(N)))
        })
    }
    #[inline(always)]
    fn shift_right<const N: i32>(self) -> Self {
        // SAFETY: as for `shift_left`.
        Avx512(unsafe {
            _mm512_castsi512_ps(_mm512_sra_epi32(_mm512_castps_si512(self.0), _mm_cvtsi32_si128(N)))
        })
    }
    #[inline(always)]
    fn exponent_and_mantissa(self) -> (Self, Self) {
        // SAFETY: see the head of this file.
        unsafe {
            let e = _mm512_getexp_ps(self.0);
            let m = _mm512_getmant_ps::<_MM_MANT_NORM_1_2, _MM_MANT_SIGN_SRC>(self.0);
            let upper = _mm512_set1_ps(f32::from_bits(SQRT_HALF + (1 << 23)));
            let is_upper = _mm512_cmp_ps_mask::<_CMP_GE_OQ>(m, upper);
            let e = _mm512_mask_add_ps(e, is_upper, e, _mm512_set1_ps(1.0));
            let m = _mm512_mask_mul_ps(m, is_upper, m, _mm512_set1_ps(0.5));
            (Avx512(e), Avx512(m))
        }
    }
    methods! { floats
        fma(b, c) = |a, b, c| _mm512_fmadd_ps(a, b, c);
        sqrt() = |a| _mm512_sqrt_ps(a);
        floor() = |a| _mm512_roundscale_ps::<{ _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC }>(a);
        round() = |a| _mm512_roundscale_ps::<{ _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC }>(a);
        at_least(low) = |a, low| _mm512_max_ps(low, a);
        at_most(high) = |a, high| _mm512_min_ps(high, a);
        bit_and(b) = |a, b| _mm512_and_ps(a, b);
        bit_or(b) = |a, b| _mm512_or_ps(a, b);
        bit_xor(b) = |a, b| _mm512_xor_ps(a, b);
        add_bits(b) = |a, b| _mm512_castsi512_ps(_mm512_add_epi32(_mm512_castps_si512(a), _mm512_castps_si512(b)));
        sub_bits(b) = |a, b| _mm512_castsi512_ps(_mm512_sub_epi32(_mm512_castps_si512(a), _mm512_castps_si512(b)));
        to_int_bits() = |a| _mm512_castsi512_ps(_mm512_cvttps_epi32(a));
        int_to_float() = |a| _mm512_cvtepi32_ps(_mm512_castps_si512(a));
        scale_by_power_of_two(n) = |a, n| _mm512_scalef_ps(a, n);
        logarithm_special_cases(result) = |a, result| {
            // A digit for each class of value (quiet NaN first): keep the result, NaN, −∞ or +∞.
            _mm512_fixupimm_ps::<0>(result, a, _mm512_set1_epi32(0x0353_0422))
        };
        // VRANGEPS orders −0 < +0 but drops a quiet NaN of one side, so the sum restores it.
        minimum(b) = |a, b| {
            let nan = _mm512_cmp_ps_mask::<_CMP_UNORD_Q>(a, b);
            _mm512_mask_add_ps(_mm512_range_ps::<0b0100>(a, b), nan, a, b)
        };
        maximum(b) = |a, b| {
            let nan = _mm512_cmp_ps_mask::<_CMP_UNORD_Q>(a, b);
            _mm512_mask_add_ps(_mm512_range_ps::<0b0101>(a, b), nan, a, b)
        };
    }
}
