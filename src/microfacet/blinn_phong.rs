//! The Blinn–Phong distribution, normalised as a microfacet distribution.
//!
//! Source: Walter, Marschner, Li, Torrance, "Microfacet Models for Refraction
//! through Rough Surfaces", 2007, eq. 30, whose masking is Beckmann's of the
//! same width.

use super::Real;

/// The exponent of the lobe that is as wide as a Beckmann lobe: `2 / α² - 2`. `alpha` in (0, 1].
pub fn exponent<T: Real>(alpha: T) -> T {
    T::TWO / (alpha * alpha) - T::TWO
}

/// Density of microfacet normals per unit solid angle, in 1/sr, such that
/// `∫ D (n·h) dω = 1`: `(e + 2) / 2π (n·h)^e`. `n_dot_h` in [0, 1], `exponent`
/// ≥ 0.
pub fn distribution<T: Real>(n_dot_h: T, exponent: T) -> T {
    if exponent <= T::ZERO {
        return T::ONE / T::PI;
    }
    // ln(n·h) from its small complement.
    let power = (exponent * (n_dot_h - T::ONE).ln_1p()).exp();
    (exponent + T::TWO) / (T::TWO * T::PI) * power
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits() {
        assert_eq!(distribution(0.0, 10.0), 0.0);
        assert_eq!(distribution(0.0, exponent(1.0)), std::f64::consts::FRAC_1_PI);
        assert_eq!(exponent(0.125_f64), 126.0);
        let narrow = distribution(1.0_f32 - f32::EPSILON, exponent(1e-3));
        let exact = 1e6 / std::f64::consts::PI * (1.0 - f64::from(f32::EPSILON)).powf(2e6 - 2.0);
        assert!((f64::from(narrow) / exact - 1.0).abs() < 1e-5, "{narrow} {exact}");
    }
}
