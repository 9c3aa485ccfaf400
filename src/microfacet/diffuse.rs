//! Diffuse lobes, in 1/sr, of an interior that absorbs nothing: multiply by the albedo (Hammon's
//! with [`Hammon::total`]).

use super::{Real, fresnel};

/// Disney's diffuse lobe: `(1 + (F - 1)(1 - n·l)⁵)(1 + (F - 1)(1 - n·v)⁵) / π`,
/// `F = 1/2 + 2 roughness (l·h)²` with `(l·h)² = (1 + l·v)/2` (Burley, "Physically Based Shading at
/// Disney", 2012, §5.3). Cosines in [0, 1], `l_dot_v` in [-1, 1], perceptual `roughness` in [0, 1].
pub fn disney<T: Real>(n_dot_l: T, n_dot_v: T, l_dot_v: T, roughness: T) -> T {
    let beyond = T::of(-0.5) + roughness * (T::of(1.0) + l_dot_v);
    let side = |cosine: T| {
        let rest = T::of(1.0) - cosine;
        let square = rest * rest;
        T::of(1.0) + beyond * (square * square * rest)
    };
    side(n_dot_l) * side(n_dot_v) / T::PI
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
    /// `n_dot_h` in (0, 1], `l_dot_v` in [-1, 1], `alpha` in [0, 1].
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
