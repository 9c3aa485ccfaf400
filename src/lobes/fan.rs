//! The multi-lobe model.

use super::gaussian::unit_integral;
use super::{SphericalGaussian, direction_at};

/// Spherical Gaussians of one bandwidth side by side in the plane of n and v, with amplitudes that
/// fall from the middle (course notes, §7.6, eq. 10).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fan {
    /// The number of lobes, at least 1.
    pub count: usize,
    /// The angle of the middle from the normal, in radians.
    pub theta: f64,
    /// The angle from the middle to the first and to the last lobe.
    pub spread: f64,
    /// The bandwidth λ of each lobe.
    pub lambda: f64,
    /// The factor of all amplitudes: `norm` in eq. 10.
    pub amplitude: f64,
}

impl Fan {
    /// Returns the lobes, from the one nearest to the normal.
    pub fn lobes(&self) -> Vec<SphericalGaussian> {
        let lobe = |index| {
            let theta = self.theta + self.place(index) * self.spread;
            let amplitude = self.amplitude * self.share(index);
            SphericalGaussian::new(direction_at(theta), self.lambda, amplitude)
        };
        (0..self.count).map(lobe).collect()
    }

    /// Returns the integral over the sphere.
    pub fn integral(&self) -> f64 {
        let shares: f64 = (0..self.count).map(|index| self.share(index)).sum();
        self.amplitude * shares * unit_integral(self.lambda)
    }

    /// Returns the fan with the amplitude that makes the integral that of `integral`.
    pub fn of_integral(self, integral: f64) -> Fan {
        let unit = Fan { amplitude: 1.0, ..self };
        Fan { amplitude: integral / unit.integral(), ..self }
    }

    /// Returns the angle between neighbours.
    pub fn step(&self) -> f64 {
        2.0 * self.spread / (self.count.max(2) - 1) as f64
    }

    /// Where a lobe is between the first, at -1, and the last, at 1.
    fn place(&self, index: usize) -> f64 {
        match self.count {
            0 | 1 => 0.0,
            count => 2.0 * index as f64 / (count - 1) as f64 - 1.0,
        }
    }

    fn share(&self, index: usize) -> f64 {
        let from_middle = (index + 1) as f64 - 0.5 * (self.count + 1) as f64;
        (-self.spread / 3.0 * (from_middle * self.place(index)).powi(2)).exp()
    }
}
