//! The isotropic GGX (Trowbridge–Reitz) distribution with Smith's masking and
//! shadowing.
//!
//! Sources: Walter, Marschner, Li, Torrance, "Microfacet Models for Refraction
//! through Rough Surfaces", 2007 (D: eq. 33, G1: eq. 34); Heitz,
//! "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs",
//! 2014 (Λ: eq. 72, separable G2: eq. 98, height-correlated G2: eq. 99).

use super::{Real, sine_squared};

/// Density of microfacet normals per unit solid angle, in 1/sr, such that
/// `∫ D (n·h) dω = 1`. `n_dot_h` in [0, 1], `alpha` in (0, 1].
pub fn distribution<T: Real>(n_dot_h: T, alpha: T) -> T {
    // α² / (π t²) with t = n·h²(α² - 1) + 1, which cancels near n·h = 1, where
    // the lobe is; and α² may underflow where t / α does not.
    let t_over_alpha = alpha * n_dot_h * n_dot_h + sine_squared(n_dot_h) / alpha;
    T::ONE / (T::PI * t_over_alpha * t_over_alpha)
}

/// Smith's Λ, invisible over visible projected area of the microsurface seen
/// from a direction at `cosine` from the normal, in (0, 1]: +∞ at 0.
/// `alpha` in [0, 1].
pub fn lambda<T: Real>(cosine: T, alpha: T) -> T {
    // (sqrt(1 + α² tan²) - 1) / 2, rationalised: that difference cancels for
    // small α tan.
    let root = projected(cosine, alpha);
    alpha * alpha * sine_squared(cosine) / (T::TWO * cosine * (root + cosine))
}

/// Masking: the visible fraction of the microfacets that face a direction at
/// `cosine` in [0, 1] from the normal, `1 / (1 + Λ)`; 0 at the horizon.
/// `alpha` in (0, 1].
pub fn g1<T: Real>(cosine: T, alpha: T) -> T {
    T::TWO * cosine / (cosine + projected(cosine, alpha))
}

/// Masking and shadowing, taken as independent: `G1(v) G1(l)`.
pub fn g2_separable<T: Real>(n_dot_v: T, n_dot_l: T, alpha: T) -> T {
    g1(n_dot_v, alpha) * g1(n_dot_l, alpha)
}

/// Masking and shadowing as products of Schlick's form, `x / (x (1 - k) + k)` with `k = alpha / 2`:
/// the fit to GGX of Karis, "Real Shading in Unreal Engine 4" (SIGGRAPH 2013 course notes, p. 3),
/// without its remapping for analytic lights.
pub fn g2_schlick<T: Real>(n_dot_v: T, n_dot_l: T, alpha: T) -> T {
    let k = alpha / T::TWO;
    let g1 = |cosine: T| cosine / (cosine * (T::ONE - k) + k);
    g1(n_dot_v) * g1(n_dot_l)
}

/// Masking and shadowing, correlated through the height of the microfacet: `1 / (1 + Λ(v) + Λ(l))`;
/// 0 if either cosine is 0. `alpha` in [0, 1].
pub fn g2_correlated<T: Real>(n_dot_v: T, n_dot_l: T, alpha: T) -> T {
    let product = n_dot_v * n_dot_l;
    if product <= T::ZERO {
        return T::ZERO;
    }
    T::TWO * product / sum_of_projected(n_dot_v, n_dot_l, alpha)
}

/// `G2 / (4 n·v n·l)` with the correlated G2, finite at the horizon: the lobe is
/// `D V F`. +∞ where both cosines are 0.
pub fn visibility_correlated<T: Real>(n_dot_v: T, n_dot_l: T, alpha: T) -> T {
    T::HALF / sum_of_projected(n_dot_v, n_dot_l, alpha)
}

fn sum_of_projected<T: Real>(n_dot_v: T, n_dot_l: T, alpha: T) -> T {
    n_dot_l * projected(n_dot_v, alpha) + n_dot_v * projected(n_dot_l, alpha)
}

/// `cosine * sqrt(1 + α² tan²)`, finite at the horizon.
fn projected<T: Real>(cosine: T, alpha: T) -> T {
    (cosine * cosine + alpha * alpha * sine_squared(cosine)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quadrature::TanhSinh;
    use std::f64::consts::PI;

    const ALPHAS: [f64; 6] = [1e-6, 1e-3, 0.03, 0.25, 0.7, 1.0];
    const COSINES: [f64; 6] = [1e-5, 0.01, 0.3, 0.71, 0.999, 1.0];

    #[test]
    fn distribution_is_normalised() {
        let rule = TanhSinh::new();
        for alpha in ALPHAS {
            // 2π ∫ D cosθ sinθ dθ with tanθ = α t, which spreads the lobe.
            let integrand = |tangent: f64| {
                let cosine = 1.0 / (1.0 + (alpha * tangent).powi(2)).sqrt();
                2.0 * PI * distribution(cosine, alpha) * cosine.powi(4) * alpha * alpha * tangent
            };
            let near = rule.integrate(0.0, 1.0, 1e-10, |p| integrand(p.x)).value;
            let far = rule.integrate(0.0, 1.0, 1e-10, |p| integrand(1.0 / p.x) / (p.x * p.x));
            let total = near + far.value;
            // One ulp of the cosine is 1e-16 of α²/2.
            let tolerance = 1e-9 + 1e-15 / (alpha * alpha);
            assert!((total - 1.0).abs() < tolerance, "alpha = {alpha}: {total}");
        }
    }

    #[test]
    fn distribution_peaks_at_its_known_height() {
        for alpha in ALPHAS {
            let expected = 1.0 / (PI * alpha * alpha);
            assert!((distribution(1.0, alpha) / expected - 1.0).abs() < 1e-15);
        }
    }

    #[test]
    fn masking_agrees_with_lambda() {
        for alpha in ALPHAS {
            for v in COSINES {
                assert!((g1(v, alpha) * (1.0 + lambda(v, alpha)) - 1.0).abs() < 1e-14);
                for l in COSINES {
                    let sum = 1.0 + lambda(v, alpha) + lambda(l, alpha);
                    assert!((g2_correlated(v, l, alpha) * sum - 1.0).abs() < 1e-14);
                    assert_eq!(g2_correlated(v, l, alpha), g2_correlated(l, v, alpha));
                    assert!(g2_separable(v, l, alpha) <= g2_correlated(v, l, alpha) + 1e-15);
                    let area = 4.0 * v * l;
                    let correlated = visibility_correlated(v, l, alpha) * area;
                    assert!((correlated / g2_correlated(v, l, alpha) - 1.0).abs() < 1e-14);
                }
            }
        }
    }

    #[test]
    fn lambda_does_not_cancel() {
        // α² tan² / 4 to first order, where the textbook form gives 0.
        let tangent_squared = (1.0 - 0.25) / 0.25;
        let expected = 1e-18 * tangent_squared / 4.0;
        assert!((lambda(0.5, 1e-9) / expected - 1.0).abs() < 1e-14);
        assert_eq!(lambda(1.0, 0.5), 0.0);
        assert_eq!(lambda(0.0, 0.5), f64::INFINITY);
    }

    #[test]
    fn limits() {
        assert_eq!(g2_correlated(0.0, 0.0, 0.5), 0.0);
        assert_eq!(g2_correlated(0.3, 0.6, 0.0), 1.0);
        assert_eq!(g1(0.0, 0.5), 0.0);
    }

    #[test]
    fn microfacets_visible_add_up_to_the_projected_area() {
        // ∫ G1(v) <v·h> D dω = n·v (Heitz 2014, eq. 14).
        let rule = TanhSinh::new();
        let (n_dot_v, alpha): (f64, f64) = (0.4, 0.5);
        let sin_v = (1.0 - n_dot_v * n_dot_v).sqrt();
        let ring = |cos_h: f64| {
            let sin_h = ((1.0 - cos_h) * (1.0 + cos_h)).sqrt();
            let middle = n_dot_v * cos_h;
            let horizon = (-middle / (sin_v * sin_h)).clamp(-1.0, 1.0).acos();
            let v_dot_h = middle * horizon + sin_v * sin_h * horizon.sin();
            2.0 * v_dot_h * distribution(cos_h, alpha)
        };
        // Rings below sin_v are cut by the horizon of v.
        let below = rule.integrate(0.0, sin_v, 1e-11, |p| ring(p.x)).value;
        let above = rule.integrate(sin_v, 1.0, 1e-11, |p| ring(p.x)).value;
        let visible = g1(n_dot_v, alpha) * (below + above);
        assert!((visible - n_dot_v).abs() < 1e-9, "{visible}");
    }
}
