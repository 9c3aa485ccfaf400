//! The anisotropic spherical Gaussian.

use super::Lobe;
use glam::{DMat3, DVec3};
use std::f64::consts::{PI, TAU};

/// Where the lobe's exponential falls below this, it is not sampled. By hand: the square of what is
/// left out, which only other distributions sample, is 1e-8 of that at the axis.
const THRESHOLD: f64 = 1e-4;

/// `c max(0, ω·z) exp(-λ (ω·x)² - μ (ω·y)²)` in an orthonormal frame x, y, z (Xu et al.,
/// "Anisotropic Spherical Gaussians", 2013; course notes, §7.4).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AnisotropicGaussian {
    /// x, y and z.
    pub frame: DMat3,
    /// λ ≥ 0, the bandwidth along x.
    pub lambda: f64,
    /// μ ≥ 0, the bandwidth along y.
    pub mu: f64,
    /// c.
    pub amplitude: f64,
}

impl AnisotropicGaussian {
    /// Returns the half-axes, up to 1, of the ellipse on the disc below the lobe that is sampled.
    fn ellipse(&self) -> [f64; 2] {
        let reach = -THRESHOLD.ln();
        [self.lambda, self.mu].map(|bandwidth| (reach / bandwidth).sqrt().min(1.0))
    }
}

/// Draws evenly from an ellipse on the disc below the lobe, lifted to the sphere: density
/// `ω·z / (π sx sy)` with its half-axes sx and sy (course notes, eq. 9). There is no such direction
/// where the lobe is small.
impl Lobe for AnisotropicGaussian {
    fn value(&self, direction: DVec3) -> f64 {
        let local = self.frame.transpose() * direction;
        let exponent = self.lambda * local.x * local.x + self.mu * local.y * local.y;
        self.amplitude * local.z.max(0.0) * (-exponent).exp()
    }

    fn density(&self, direction: DVec3) -> f64 {
        let local = self.frame.transpose() * direction;
        let [x, y] = self.ellipse();
        match (local.x / x).powi(2) + (local.y / y).powi(2) < 1.0 {
            true => local.z.max(0.0) / (PI * x * y),
            false => 0.0,
        }
    }

    fn sample(&self, [u, w]: [f64; 2]) -> DVec3 {
        let [x, y] = self.ellipse();
        let (sin, cos) = (TAU * u).sin_cos();
        let (x, y) = (x * w.sqrt() * cos, y * w.sqrt() * sin);
        self.frame * DVec3::new(x, y, (1.0 - x * x - y * y).max(0.0).sqrt())
    }
}
