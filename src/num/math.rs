//! Elementary functions over [`Lanes`], with the same bits at every width.
//!
//! Each is branch-free: an argument reduction, a polynomial (near-minimax in the relative error of
//! the result, its coefficients rounded to `f32` one after the other and the rest refitted), and
//! special cases by selection. The stated errors are measured against `f64` over all 2³² arguments
//! (or, for two arguments, a dense sample). Bounds and proofs rely on `op::Op::accuracy`, which is
//! never less than what was measured.

use super::Lanes;
use std::f32::consts::{FRAC_PI_2, LN_2, LOG2_E, PI};

/// `Σ cᵢ xⁱ`, by Horner's rule with fused steps.
#[inline(always)]
fn polynomial<L: Lanes, const N: usize>(x: L, coefficients: [f32; N]) -> L {
    let mut sum = x.splat(coefficients[N - 1]);
    for c in coefficients[..N - 1].iter().rev() {
        sum = sum.fma(x, x.splat(*c));
    }
    sum
}

/// `2^x`, within 1 ulp for every argument (denormal results: 1 ulp of the smallest denormal).
#[inline(always)]
pub fn exp2<L: Lanes>(x: L) -> L {
    let x = x.at_least(x.splat(-151.0)).at_most(x.splat(129.0));
    let n = x.round();
    let f = x - n;
    let p = polynomial(f, [LN_2, 0.24022648, 0.055503596, 0.009618499, 0.001339097, 0.0001532931]);
    f.fma(p, f.splat(1.0)).scale_by_power_of_two(n)
}

/// `e^x`, within 1.02 ulp for every argument.
#[inline(always)]
pub fn exp<L: Lanes>(x: L) -> L {
    const LN_2_HIGH: f32 = 0.693_359_4;
    const LN_2_LOW: f32 = -2.121_944_4e-4;
    let x = x.at_least(x.splat(-105.0)).at_most(x.splat(90.0));
    let n = (x * x.splat(LOG2_E)).round();
    let f = n.fma(n.splat(-LN_2_HIGH), x);
    let f = n.fma(n.splat(-LN_2_LOW), f);
    let p = polynomial(f, [0.49999994, 0.16666521, 0.041668262, 0.00836867, 0.0013821024]);
    ((f * f).fma(p, f) + f.splat(1.0)).scale_by_power_of_two(n)
}

/// `(ln(1 + f) − f) / f²` for `1 + f` in [√½, √2].
#[inline(always)]
fn log1p_tail<L: Lanes>(f: L) -> L {
    polynomial(
        f,
        [
            -0.49999988,
            0.33333322,
            -0.25001547,
            0.20002457,
            -0.16610748,
            0.14171056,
            -0.13216278,
            0.1296948,
            -0.07772205,
        ],
    )
}

/// `log₂ x`, within 2 ulp for every argument; −∞ at ±0, NaN below.
#[inline(always)]
pub fn log2<L: Lanes>(x: L) -> L {
    const LOG2_E_LOW: f32 = 1.925_963e-8;
    let (e, m) = x.exponent_and_mantissa();
    let f = m - x.splat(1.0);
    // ln(1+f) = f + tail, and each part times log₂e, whose first product is taken exactly.
    let tail = f * f * log1p_tail(f);
    let high = f * f.splat(LOG2_E);
    let low = f.fma(f.splat(LOG2_E), high.neg());
    let low = f.fma(f.splat(LOG2_E_LOW), low);
    let low = tail.fma(f.splat(LOG2_E), low);
    x.logarithm_special_cases(e + (high + low))
}

/// `ln x`, within 2 ulp for every argument; −∞ at ±0, NaN below.
#[inline(always)]
pub fn log<L: Lanes>(x: L) -> L {
    let (e, m) = x.exponent_and_mantissa();
    let f = m - x.splat(1.0);
    let tail = f * f * log1p_tail(f);
    x.logarithm_special_cases(e.fma(x.splat(LN_2), f + tail))
}

/// `exp2(y · log2(x))`: all that shading languages define. NaN for `x < 0` and at `pow(0, 0)`.
#[inline(always)]
pub fn pow<L: Lanes>(x: L, y: L) -> L {
    exp2(y * log2(x))
}

/// `x − n·π/2` in [−π/4, π/4], and the bits of `n`.
#[inline(always)]
fn quadrant<L: Lanes>(x: L) -> (L, L) {
    // π/2 in three parts of 24 bits; each product is exact within its fused step.
    const PARTS: [f32; 3] = [1.570_796_4, -4.371_139e-8, -1.715_124_8e-15];
    let limit = x.splat(1e7);
    let n = (x * x.splat(std::f32::consts::FRAC_2_PI)).at_least(limit.neg()).at_most(limit).round();
    let r = n.fma(x.splat(-PARTS[0]), x);
    let r = n.fma(x.splat(-PARTS[1]), r);
    let r = n.fma(x.splat(-PARTS[2]), r);
    (r, n.to_int_bits())
}

/// Sine and cosine of `r` in [−π/4, π/4].
#[inline(always)]
fn sin_cos_reduced<L: Lanes>(r: L) -> (L, L) {
    let r2 = r * r;
    let s = polynomial(r2, [-0.16666655, 0.008332192, -0.00019518788]);
    let c = polynomial(r2, [0.041666646, -0.0013887301, 2.4430661e-5]);
    let sin = (r2 * r).fma(s, r);
    let cos = (r2 * r2).fma(c, r2.fma(r.splat(-0.5), r.splat(1.0)));
    (sin, cos)
}

/// `sin(x + q·π/2)`.
#[inline(always)]
fn sin_shifted<L: Lanes>(x: L, q: u32) -> L {
    let (r, n) = quadrant(x);
    let (sin, cos) = sin_cos_reduced(r);
    let n = n.add_bits(x.bits(q));
    let odd = n.bit_and(x.bits(1)).int_to_float().eq(x.splat(1.0));
    let sign = n.bit_and(x.bits(2)).shift_left::<30>();
    let result = L::select(odd, cos, sin).bit_xor(sign);
    // From 2²³ quadrants on, `n` does not fit and `r` has no meaning.
    let huge = x.splat(1e7).lt(x.abs());
    L::select(huge, x * x.splat(0.0), result)
}

/// `sin x` (radians), within 2 ulp for |x| ≤ 10⁴; 0 beyond |x| = 10⁷, NaN at ±∞.
#[inline(always)]
pub fn sin<L: Lanes>(x: L) -> L {
    sin_shifted(x, 0)
}

/// `cos x` (radians), within 2 ulp for |x| ≤ 10⁴; 0 beyond |x| = 10⁷, NaN at ±∞.
#[inline(always)]
pub fn cos<L: Lanes>(x: L) -> L {
    sin_shifted(x, 1)
}

/// `tan x` (radians) as sin x / cos x, within 4 ulp for |x| ≤ 10⁴.
#[inline(always)]
pub fn tan<L: Lanes>(x: L) -> L {
    sin(x) / cos(x)
}

/// `asin a − a` for `a` in [0, ½].
#[inline(always)]
fn asin_tail<L: Lanes>(a: L) -> L {
    let a2 = a * a;
    let p = polynomial(a2, [0.16666754, 0.07495252, 0.04547604, 0.024152093, 0.042211797]);
    a * a2 * p
}

/// The parts of `asin |x|` that both arc functions need: the mask |x| > ½, then `a` and `asin a −
/// a`, where `a` is |x| or √((1−|x|)/2).
#[inline(always)]
fn asin_reduced<L: Lanes>(x: L) -> (L::Mask, L, L) {
    let a = x.abs();
    let outer = x.splat(0.5).lt(a);
    let half_chord = a.fma(a.splat(-0.5), a.splat(0.5)).sqrt();
    let a = L::select(outer, half_chord, a);
    (outer, a, asin_tail(a))
}

/// `asin x`, within 3 ulp on [−1, 1]; NaN outside.
#[inline(always)]
pub fn asin<L: Lanes>(x: L) -> L {
    let (outer, a, tail) = asin_reduced(x);
    let sum = a + tail;
    let folded = sum.fma(x.splat(-2.0), x.splat(FRAC_PI_2));
    let sign = x.bit_and(x.bits(0x8000_0000));
    L::select(outer, folded, sum).bit_xor(sign)
}

/// `acos x`, within 3 ulp on [−1, 1]; NaN outside.
#[inline(always)]
pub fn acos<L: Lanes>(x: L) -> L {
    let (outer, a, tail) = asin_reduced(x);
    let negative = x.lt(x.splat(0.0));
    let sum = a + tail;
    let signed = L::select(negative, sum.neg(), sum);
    let inner = x.splat(FRAC_PI_2) - signed;
    let twice = sum + sum;
    let far = L::select(negative, x.splat(PI) - twice, twice);
    L::select(outer, far, inner)
}

/// `atan t` for `t` in [0, 1].
#[inline(always)]
fn atan_reduced<L: Lanes>(t: L) -> L {
    let t2 = t * t;
    let p = polynomial(
        t2,
        [
            -0.33333167,
            0.19994147,
            -0.14214285,
            0.10679223,
            -0.07581154,
            0.04356009,
            -0.016585084,
            0.002975537,
        ],
    );
    (t * t2).fma(p, t)
}

/// `atan x`, within 3 ulp for every argument.
#[inline(always)]
pub fn atan<L: Lanes>(x: L) -> L {
    let one = x.splat(1.0);
    let a = x.abs();
    let outer = one.lt(a);
    let t = atan_reduced(L::select(outer, one / a, a));
    let folded = L::select(outer, x.splat(FRAC_PI_2) - t, t);
    folded.bit_or(x.bit_and(x.bits(0x8000_0000)))
}

/// The angle of the point (x, y) in [−π, π], within 4 ulp; ±0 or ±π where both are zero.
#[inline(always)]
pub fn atan2<L: Lanes>(y: L, x: L) -> L {
    let zero = x.splat(0.0);
    let one = x.splat(1.0);
    let (ax, ay) = (x.abs(), y.abs());
    let steep = ax.lt(ay);
    let small = L::select(steep, ax, ay);
    let large = L::select(steep, ay, ax);
    let ratio = small / large;
    let ratio = L::select(large.eq(zero), zero, ratio);
    let infinity = x.splat(f32::INFINITY);
    let ratio = L::select(small.eq(infinity), one, ratio);
    let t = atan_reduced(ratio);
    let t = L::select(steep, x.splat(FRAC_PI_2) - t, t);
    let sign = x.bits(0x8000_0000);
    let left = x.bit_and(sign).shift_right::<31>().int_to_float().lt(zero);
    let t = L::select(left, x.splat(PI) - t, t);
    let result = t.bit_or(y.bit_and(sign));
    L::select(x.is_nan(), x, L::select(y.is_nan(), y, result))
}

/// `tanh x`, within 3 ulp for every argument.
#[inline(always)]
pub fn tanh<L: Lanes>(x: L) -> L {
    let one = x.splat(1.0);
    let a = x.abs();
    let a2 = a * a;
    let p = polynomial(a2, [-0.333333, 0.1333194, -0.053785075, 0.020799961, -0.0058995434]);
    let near = (a * a2).fma(p, a);
    let far = one - x.splat(2.0) / (exp(a + a) + one);
    let result = L::select(a.lt(x.splat(0.6)), near, far);
    result.bit_or(x.bit_and(x.bits(0x8000_0000)))
}

/// `1/x`, correctly rounded.
#[inline(always)]
pub fn rcp<L: Lanes>(x: L) -> L {
    x.splat(1.0) / x
}

/// `1/√x`, each step correctly rounded: within 1.5 ulp; ∞ at +0, NaN below zero.
#[inline(always)]
pub fn rsqrt<L: Lanes>(x: L) -> L {
    x.splat(1.0) / x.sqrt()
}

/// `x − ⌊x⌋`.
#[inline(always)]
pub fn fract<L: Lanes>(x: L) -> L {
    x - x.floor()
}

/// −1, ±0 or 1; NaN at NaN.
#[inline(always)]
pub fn sign<L: Lanes>(x: L) -> L {
    let zero = x.splat(0.0);
    let one = x.splat(1.0);
    let result = L::select(zero.lt(x), one, x);
    L::select(x.lt(zero), one.neg(), result)
}

/// 1 where `x ≥ edge`, else 0 (also where either is NaN).
#[inline(always)]
pub fn step<L: Lanes>(edge: L, x: L) -> L {
    let one = x.splat(1.0);
    let zero = x.splat(0.0);
    L::select(edge.lt(x), one, L::select(edge.eq(x), one, zero))
}

/// `min(max(x, 0), 1)`; NaN at NaN.
#[inline(always)]
pub fn saturate<L: Lanes>(x: L) -> L {
    x.maximum(x.splat(0.0)).minimum(x.splat(1.0))
}

/// `a + t (b − a)`, the sum fused with the product.
#[inline(always)]
pub fn lerp<L: Lanes>(a: L, b: L, t: L) -> L {
    t.fma(b - a, a)
}
