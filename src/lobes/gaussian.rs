//! The spherical Gaussian.

use super::{Lobe, upright_frame};
use glam::{DMat3, DVec3};
use std::f64::consts::{PI, TAU};

/// `c exp(-λ (1 - ω·a))` with axis a, bandwidth λ and amplitude c (Wang et al., "All-Frequency
/// Rendering of Dynamic, Spatially-Varying Reflectance", 2009; course notes, §7.2).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SphericalGaussian {
    frame: DMat3,
    lambda: f64,
    amplitude: f64,
    /// The density at the axis.
    peak_density: f64,
}

impl SphericalGaussian {
    /// Makes one of a unit vector `axis` and `lambda` ≥ 0, which is in 1/sr where the lobe is
    /// narrow. λ = 0 is a constant.
    pub fn new(axis: DVec3, lambda: f64, amplitude: f64) -> SphericalGaussian {
        let frame = upright_frame(axis);
        SphericalGaussian { frame, lambda, amplitude, peak_density: 1.0 / unit_integral(lambda) }
    }

    /// Returns a.
    pub fn axis(&self) -> DVec3 {
        self.frame.z_axis
    }

    /// Returns λ.
    pub fn lambda(&self) -> f64 {
        self.lambda
    }

    /// Returns c.
    pub fn amplitude(&self) -> f64 {
        self.amplitude
    }

    /// Returns the integral over the sphere, `2π c (1 - exp(-2λ)) / λ`.
    pub fn integral(&self) -> f64 {
        self.amplitude * unit_integral(self.lambda)
    }

    /// Returns the density at the axis.
    pub(super) fn peak_density(&self) -> f64 {
        self.peak_density
    }

    /// Returns a direction of the lobe's own frame, its axis being z, in that of the surface.
    pub(super) fn turned(&self, local: DVec3) -> DVec3 {
        self.frame * local
    }

    /// Returns the value over that at the axis.
    pub(super) fn shape(&self, direction: DVec3) -> f64 {
        (-self.lambda * (1.0 - direction.dot(self.frame.z_axis))).exp()
    }
}

/// `2π (1 - exp(-2λ)) / λ`, whose limit at λ = 0 is the sphere's 4π.
pub fn unit_integral(lambda: f64) -> f64 {
    if lambda == 0.0 { 4.0 * PI } else { -TAU * (-2.0 * lambda).exp_m1() / lambda }
}

/// Draws in proportion to the lobe (course notes, §7.6): `1 - cos θ = -ln(1 - ξ (1 - exp(-2λ))) /
/// λ`.
impl Lobe for SphericalGaussian {
    fn value(&self, direction: DVec3) -> f64 {
        self.amplitude * self.shape(direction)
    }

    fn density(&self, direction: DVec3) -> f64 {
        self.peak_density * self.shape(direction)
    }

    fn value_and_density(&self, direction: DVec3) -> [f64; 2] {
        let shape = self.shape(direction);
        [self.amplitude * shape, self.peak_density * shape]
    }

    fn sample(&self, [u, w]: [f64; 2]) -> DVec3 {
        let depth = depth_at(self.lambda, w);
        let (sin, cos) = (TAU * u).sin_cos();
        let sine = (depth * (2.0 - depth)).sqrt();
        self.frame * DVec3::new(sine * cos, sine * sin, 1.0 - depth)
    }
}

/// Returns 1 - cos θ, which keeps the digits of narrow lobes, at the share `w` of the lobe.
pub(super) fn depth_at(lambda: f64, w: f64) -> f64 {
    match lambda {
        0.0 => 2.0 * w,
        _ => (-(w * (-2.0 * lambda).exp_m1()).ln_1p() / lambda).min(2.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quadrature::{Rule, change};

    #[test]
    fn the_integral_is_that_of_the_values() {
        for lambda in [0.0, 1e-12, 0.3, 4.0, 40.0] {
            let lobe = SphericalGaussian::new(DVec3::Z, lambda, 0.7);
            let values = change::over(change::sphere, |direction| lobe.value(direction));
            let found = Rule::gauss_legendre(60).integrate([0.0; 2], [1.0; 2], values).value;
            assert!((found / lobe.integral() - 1.0).abs() < 1e-12, "{lambda}: {found}");
        }
    }

    #[test]
    fn the_ends_of_lambda_are_stable() {
        // 1/λ - exp(-2λ)/λ = 2 - 2λ + … to first order.
        let small = unit_integral(1e-9);
        assert!((small / TAU - (2.0 - 2e-9)).abs() < 1e-15, "{small}");
        assert!((unit_integral(1e-300) / (4.0 * PI) - 1.0).abs() < 1e-15);
        assert!((unit_integral(1e12) / (TAU * 1e-12) - 1.0).abs() < 1e-15);
        for lambda in [0.0, 1e-300, 1e-9, 1.0, 1e9, 1e15] {
            let lobe = SphericalGaussian::new(DVec3::new(0.6, 0.0, 0.8), lambda, 1.0);
            for w in [0.0, 0.5, 1.0 - f64::EPSILON / 2.0] {
                let drawn = lobe.sample([0.3, w]);
                assert!((drawn.length() - 1.0).abs() < 1e-12, "{lambda} {w}: {drawn}");
                assert!(lobe.density(drawn) > 0.0, "{lambda} {w}");
            }
        }
        // Uniform on the sphere, where λ vanishes.
        let [even, nearly] = [0.0, 1e-12]
            .map(|lambda| SphericalGaussian::new(DVec3::Z, lambda, 1.0).sample([0.2, 0.3]));
        assert!((even - nearly).length() < 1e-11);
    }
}
