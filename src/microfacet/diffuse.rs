//! Diffuse lobes, in 1/sr, of a surface that absorbs nothing: multiply by the
//! albedo (Hammon's with [`Hammon::total`]).
//!
//! `l_dot_v` is in [-1, 1], `l_dot_h` in [0, 1].

use super::{Real, fresnel};

/// Lambert's lobe: `1 / π`.
pub fn lambert<T: Real>() -> T {
    T::ONE / T::PI
}

/// Disney's lobe (Burley, "Physically-Based Shading at Disney", 2012, §5.3), with the perceptual
/// `roughness` in [0, 1]. It does not conserve energy: its albedo exceeds 1 at grazing angles on
/// rough surfaces.
pub fn disney<T: Real>(n_dot_l: T, n_dot_v: T, l_dot_h: T, roughness: T) -> T {
    let at_grazing = T::HALF + T::TWO * roughness * l_dot_h * l_dot_h;
    let factor = |cosine| T::ONE + (at_grazing - T::ONE) * fresnel::schlick_weight(cosine);
    factor(n_dot_l) * factor(n_dot_v) / T::PI
}

/// Oren and Nayar's qualitative model ("Generalization of Lambert's Reflectance
/// Model", 1994, eq. 30); `sigma` ≥ 0 is the standard deviation of the facets'
/// angle, in radians. Its albedo exceeds 1 by up to 1.5 % at grazing (at grazing
/// it is A + B/2).
pub fn oren_nayar<T: Real>(n_dot_l: T, n_dot_v: T, l_dot_v: T, sigma: T) -> T {
    let variance = sigma * sigma;
    let a = T::ONE - T::HALF * variance / (variance + T::of(0.33));
    let b = T::of(0.45) * variance / (variance + T::of(0.09));
    // cos Δφ sin α tan β, β the smaller angle from n.
    let azimuthal = (l_dot_v - n_dot_l * n_dot_v).max(T::ZERO);
    let larger = n_dot_l.max(n_dot_v);
    let term = if larger > T::ZERO { azimuthal / larger } else { T::ZERO };
    (a + b * term) / T::PI
}

/// The normalisation `21 / (20π)` of `k ∫ (1 - (1 - n·l)^5) (n·l) dω = 1`.
pub fn transmission_norm<T: Real>() -> T {
    T::of(1.05) / T::PI
}

/// The lobe of a flat Lambertian interior under an interface with Schlick's reflectance, which
/// light passes twice: `21/(20π) (1 - F0) (1 - (1 - n·l)^5) (1 - (1 - n·v)^5)`. Its albedo is the
/// interface's transmittance (Hammon, "PBR Diffuse Lighting for GGX+Smith Microsurfaces", 2017;
/// Shirley et al., "A Practitioners' Assessment of Light Reflection Models", 1997).
pub fn under_interface<T: Real>(n_dot_l: T, n_dot_v: T, f0: T) -> T {
    let both = fresnel::schlick_transmission(n_dot_l) * fresnel::schlick_transmission(n_dot_v);
    transmission_norm::<T>() * (T::ONE - f0) * both
}

/// Hammon's fit to path-traced GGX microsurfaces ("PBR Diffuse Lighting for GGX+Smith
/// Microsurfaces", 2017), in 1/sr.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hammon<T> {
    /// Light that was transmitted once.
    pub single: T,
    /// Light that was transmitted more often.
    pub multi: T,
}

impl<T: Real> Hammon<T> {
    /// The fit as printed: the smooth part lacks the factor 1 - F0 of [`under_interface`].
    /// `n_dot_h` in (0, 1], `alpha` in [0, 1].
    pub fn new(n_dot_l: T, n_dot_v: T, n_dot_h: T, l_dot_v: T, alpha: T) -> Hammon<T> {
        let facing = T::HALF + T::HALF * l_dot_v;
        let rough = facing * (T::of(0.9) - T::of(0.4) * facing) * ((T::HALF + n_dot_h) / n_dot_h);
        let smooth = T::of(1.05)
            * fresnel::schlick_transmission(n_dot_l)
            * fresnel::schlick_transmission(n_dot_v);
        let single = (smooth + alpha * (rough - smooth)) / T::PI;
        Hammon { single, multi: T::of(0.1159) * alpha }
    }

    /// The lobe for an albedo: `albedo (single + albedo multi)`.
    pub fn total(self, albedo: T) -> T {
        albedo * (self.single + albedo * self.multi)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_1_PI;

    #[test]
    fn smooth_surfaces_are_lambertian() {
        assert_eq!(oren_nayar(0.3, 0.8, 0.5, 0.0), FRAC_1_PI);
        assert_eq!(lambert::<f64>(), FRAC_1_PI);
        assert_eq!(disney(1.0, 1.0, 1.0, 0.7), FRAC_1_PI);
        let at_grazing = oren_nayar(0.0, 0.0, 1.0, 0.5) / FRAC_1_PI;
        assert!((at_grazing - (1.0 - 0.125 / 0.58)).abs() < 1e-15);
    }

    #[test]
    fn hammon_at_the_slides_values() {
        // reference page: alpha = 1, both at 5° on the same side.
        let cosine = 5.0_f64.to_radians().cos();
        let lobe = Hammon::new(cosine, cosine, cosine, 1.0, 1.0);
        assert!((lobe.single - 0.23904).abs() < 5e-6, "{lobe:?}");
        assert_eq!(lobe.multi, 0.1159);
        assert!((lobe.total(0.5) - 0.5 * (lobe.single + 0.5 * 0.1159)).abs() < 1e-16);
    }
}
