//! The "Charlie" distribution of cloth: normals of fibres that stand up, densest at the horizon.
//!
//! Source: Estevez and Kulla, "Production Friendly Microfacet Sheen BRDF", 2017 (D: §2, Λ: §3,
//! softening: §4). Their roughness is `alpha`; glTF, Filament and three.js square a perceptual one
//! (KHR_materials_sheen).

use super::Real;

/// Density of microfacet normals per unit solid angle, in 1/sr, such that `∫ D (n·h) dω = 1`:
/// `(2 + 1/α) sin^(1/α) θ / 2π`. `n_dot_h` in [0, 1], `alpha` in (0, 1].
pub fn distribution<T: Real>(n_dot_h: T, alpha: T) -> T {
    let inverse = T::ONE / alpha;
    // ln sin² from the small cosine of a lobe at the horizon.
    let power = (T::HALF * inverse * (-(n_dot_h * n_dot_h)).ln_1p()).exp();
    (T::TWO + inverse) / (T::TWO * T::PI) * power
}

/// The published fit of Smith's Λ; it is continued above a cosine of ½ by symmetry of its logarithm
/// about that point. Finite at the horizon. `cosine` in [0, 1], `alpha` in (0, 1].
pub fn lambda<T: Real>(cosine: T, alpha: T) -> T {
    let middle = T::HALF;
    if cosine < middle {
        return log_lambda(cosine, alpha).exp();
    }
    (T::TWO * log_lambda(middle, alpha) - log_lambda(T::ONE - cosine, alpha)).exp()
}

/// [`lambda`] of the light's direction with the published, unphysical softening of the terminator:
/// `Λ^(1 + 2 (1 - n·l)^8)`.
pub fn lambda_softened<T: Real>(n_dot_l: T, alpha: T) -> T {
    let fourth = (T::ONE - n_dot_l).squared().squared();
    lambda(n_dot_l, alpha).powf(T::ONE + T::TWO * fourth.squared())
}

/// `1 / (4 (n·l + n·v - n·l n·v))` in place of `G / (4 n·l n·v)`: Neubelt and Pettineo, "Crafting a
/// Next-gen Material Pipeline for The Order: 1886", 2013. +∞ where both cosines are 0.
pub fn visibility_neubelt<T: Real>(n_dot_v: T, n_dot_l: T) -> T {
    T::ONE / (T::of(4.0) * (n_dot_l + n_dot_v - n_dot_l * n_dot_v))
}

/// `a / (1 + b x^c) + d x + e`, its coefficients between those of alpha = 1 and of alpha = 0.
fn log_lambda<T: Real>(x: T, alpha: T) -> T {
    let narrow = (T::ONE - alpha).squared();
    let mix = |wide: f64, tight: f64| T::of(wide) + (T::of(tight) - T::of(wide)) * narrow;
    let (a, b, c) = (mix(21.5473, 25.3245), mix(3.82987, 3.32435), mix(0.19823, 0.16801));
    let (d, e) = (mix(-1.97760, -1.27393), mix(-4.32054, -4.85967));
    a / (T::ONE + b * x.powf(c)) + d * x + e
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quadrature::TanhSinh;
    use std::f64::consts::PI;

    const ALPHAS: [f64; 5] = [1e-5, 1e-3, 0.05, 0.3, 1.0];

    #[test]
    fn distribution_is_normalised() {
        let rule = TanhSinh::new();
        for alpha in ALPHAS {
            let weight = |c: f64| 2.0 * PI * distribution(c, alpha) * c;
            let total = rule.integrate(0.0, 1.0, 1e-11, |at| weight(at.x));
            assert!((total.value - 1.0).abs() < 1e-9, "alpha = {alpha}: {total:?}");
        }
        assert_eq!(distribution(1.0, 0.5), 0.0);
        assert!((distribution(0.0, 0.5) - 2.0 / PI).abs() < 1e-15);
    }

    #[test]
    fn lambda_is_smooth_in_the_middle_and_finite_at_the_horizon() {
        for alpha in ALPHAS {
            let step = 1e-6;
            let [below, at, above] = [0.5 - step, 0.5, 0.5 + step].map(|c| lambda(c, alpha));
            assert!(((above - at) / (at - below) - 1.0).abs() < 1e-4, "{below} {at} {above}");
            assert!(lambda(0.0, alpha).is_finite() && lambda(1.0, alpha) < 1e-7);
            assert!(lambda_softened(0.0_f32, alpha as f32).is_finite());
            assert_eq!(lambda_softened(1.0, alpha), lambda(1.0, alpha));
        }
    }

    #[test]
    fn visibility_of_neubelt_has_no_pole_at_one_horizon() {
        assert_eq!(visibility_neubelt(0.0, 0.5), 0.5);
        assert_eq!(visibility_neubelt(1.0, 0.3), 0.25);
    }
}
