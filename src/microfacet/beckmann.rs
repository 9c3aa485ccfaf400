//! The isotropic Beckmann distribution, whose slopes are Gaussian, with Smith's
//! masking and shadowing.
//!
//! Sources: Walter, Marschner, Li, Torrance, "Microfacet Models for Refraction
//! through Rough Surfaces", 2007 (D: eq. 25, rational G1: eq. 27); Heitz,
//! "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs",
//! 2014 (Λ: eq. 66).

use super::{Real, sine_squared};

/// The slope from which on a continued fraction gives Λ: the closed form cancels.
const FAR: f64 = 2.0;
/// Enough terms for f64's precision from [`FAR`] on; the tests compare with the integral.
const TERMS: u32 = 60;

/// Density of microfacet normals per unit solid angle, in 1/sr, such that
/// `∫ D (n·h) dω = 1`. `n_dot_h` in [0, 1], `alpha` in (0, 1].
pub fn distribution<T: Real>(n_dot_h: T, alpha: T) -> T {
    let cosine_squared = n_dot_h * n_dot_h;
    if cosine_squared <= T::ZERO {
        return T::ZERO;
    }
    let slope_squared = sine_squared(n_dot_h) / cosine_squared;
    let density = (-(slope_squared / alpha / alpha)).exp() / cosine_squared / cosine_squared;
    density / (T::PI * alpha * alpha)
}

/// Smith's Λ, invisible over visible projected area of the microsurface seen
/// from a direction at `cosine` from the normal, in (0, 1]: +∞ at 0.
/// `alpha` in (0, 1].
pub fn lambda<T: Real>(cosine: T, alpha: T) -> T {
    lambda_of_slope(slope(cosine, alpha))
}

/// Masking, `1 / (1 + Λ)`; 0 at the horizon.
pub fn g1<T: Real>(cosine: T, alpha: T) -> T {
    g1_of_slope(slope(cosine, alpha))
}

/// [`g1`] as a function of [`slope`] alone.
pub fn g1_of_slope<T: Real>(slope: T) -> T {
    T::ONE / (T::ONE + lambda_of_slope(slope))
}

/// Masking and shadowing, taken as independent: `G1(v) G1(l)`.
pub fn g2_separable<T: Real>(n_dot_v: T, n_dot_l: T, alpha: T) -> T {
    g1(n_dot_v, alpha) * g1(n_dot_l, alpha)
}

/// Masking and shadowing, correlated through the height of the microfacet: `1 / (1 + Λ(v) + Λ(l))`;
/// 0 if either cosine is 0.
pub fn g2_correlated<T: Real>(n_dot_v: T, n_dot_l: T, alpha: T) -> T {
    T::ONE / (T::ONE + lambda(n_dot_v, alpha) + lambda(n_dot_l, alpha))
}

/// Walter's rational approximation of [`g1`] (eq. 27), 1 from a slope of 1.6 on.
pub fn g1_rational<T: Real>(cosine: T, alpha: T) -> T {
    let c = slope(cosine, alpha);
    if c >= T::of(1.6) {
        return T::ONE;
    }
    c * (T::of(3.535) + T::of(2.181) * c) / (T::ONE + c * (T::of(2.276) + T::of(2.577) * c))
}

/// The slope of a direction over the width of the slopes, `1 / (α tan)`; Walter's a.
pub fn slope<T: Real>(cosine: T, alpha: T) -> T {
    cosine / (alpha * sine_squared(cosine).sqrt())
}

fn lambda_of_slope<T: Real>(c: T) -> T {
    let root_pi = T::PI.sqrt();
    let gauss = (-c * c).exp();
    if c < T::of(FAR) {
        return T::HALF * (gauss / (c * root_pi) - c.erfc());
    }
    // erfc(c) = exp(-c²)/√π / (c + K), K = (1/2)/(c + (2/2)/(c + (3/2)/(c + …)))
    // (Abramowitz & Stegun 7.1.14): the difference is K.
    let fraction =
        (1..=TERMS).rev().fold(T::ZERO, |tail, term| T::of(0.5 * f64::from(term)) / (c + tail));
    T::HALF * gauss / root_pi * (fraction / (c + fraction)) / c
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quadrature::TanhSinh;

    /// Λ by its definition (Heitz 2014, eq. 63):
    /// `1/c ∫ (q - c) exp(-q²)/√π dq` from c to ∞.
    fn integral(c: f64) -> f64 {
        let integrand = |q: f64| q * (-(c + q).powi(2)).exp() / std::f64::consts::PI.sqrt() / c;
        // Relative to the value, of which nothing is left 7 further on.
        let scale = (-c * c).exp();
        TanhSinh::new().integrate(0.0, 7.0, 1e-15 * scale, |p| integrand(p.x)).value
    }

    #[test]
    fn lambda_is_the_integral_that_defines_it() {
        for c in [0.01, 0.3, 1.0, 1.6, 1.99, 2.0, 2.01, 3.0, 5.0, 9.0, 20.0] {
            let found = lambda_of_slope(c);
            assert!((found / integral(c) - 1.0).abs() < 2e-13, "{c}: {found} {}", integral(c));
            let single = f64::from(lambda_of_slope(c as f32));
            let exact = lambda_of_slope(f64::from(c as f32));
            // exp(-c²) of a rounded c² loses c² ulps.
            let allowed = 1e-5 + 2e-7 * c * c;
            assert!(c > 9.0 || (single / exact - 1.0).abs() < allowed, "{c}: {single} {exact}");
        }
    }

    #[test]
    fn limits() {
        assert_eq!(lambda(0.0, 0.5), f64::INFINITY);
        assert_eq!(lambda(1.0, 0.5), 0.0);
        assert_eq!(g2_correlated(0.0, 0.3, 0.5), 0.0);
        assert_eq!(g1_rational(1.0, 0.5), 1.0);
        assert_eq!(distribution(0.0, 0.5), 0.0);
    }
}
