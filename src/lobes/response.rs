//! What is approximated: the response of a GGX surface to light.

use crate::microfacet::half_vector::reflect;
use crate::microfacet::{ggx, sampling};
use crate::num::low_discrepancy::halton;
use glam::DVec3;

/// The points of [`Response::integral`]: within 1e-5 of the reference values.
const INTEGRAL_POINTS: usize = 256 * 243;

/// `D G2 / (4 n·l n·v) · n·l` as a function of l: a GGX BRDF without Fresnel's term, with the
/// height-correlated G2, times the cosine (course notes, §7.1). n is z; v is in the plane of x and
/// z at x ≤ 0, so that the lobe is across the normal from it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Response {
    v: DVec3,
    alpha: f64,
}

impl Response {
    /// Makes one of `n_dot_v` in (0, 1] and `alpha` in (0, 1].
    pub fn new(n_dot_v: f64, alpha: f64) -> Response {
        let sine = ((1.0 - n_dot_v) * (1.0 + n_dot_v)).sqrt();
        Response { v: DVec3::new(-sine, 0.0, n_dot_v), alpha }
    }

    /// Returns n·v.
    pub fn n_dot_v(&self) -> f64 {
        self.v.z
    }

    /// Returns the width of the distribution of normals.
    pub fn alpha(&self) -> f64 {
        self.alpha
    }

    /// Returns the response to light from `l`, in 1/sr; 0 below the horizon.
    pub fn value(&self, l: DVec3) -> f64 {
        self.value_and_density(l)[0]
    }

    /// Returns the density of [`Response::sample`] per unit solid angle, `D n·h / (4 v·h)`.
    pub fn density(&self, l: DVec3) -> f64 {
        self.value_and_density(l)[1]
    }

    /// Returns [`Response::value`] and [`Response::density`].
    pub fn value_and_density(&self, l: DVec3) -> [f64; 2] {
        let sum = l + self.v;
        if sum.z <= 0.0 {
            return [0.0; 2];
        }
        let length = sum.length();
        let n_dot_h = (sum.z / length).min(1.0);
        let distribution = ggx::distribution(n_dot_h, self.alpha);
        let value = match l.z > 0.0 {
            true => distribution * ggx::visibility_correlated(self.v.z, l.z, self.alpha) * l.z,
            false => 0.0,
        };
        // v·h is half of the sum's length.
        [value, distribution * n_dot_h / (2.0 * length)]
    }

    /// Draws a normal of GGX and reflects v about it. None where v is behind the normal: as many
    /// points fewer are drawn.
    pub fn sample(&self, point: [f64; 2]) -> Option<DVec3> {
        let h = sampling::ggx(point, self.alpha);
        (self.v.dot(h) > 0.0).then(|| reflect(self.v, h))
    }

    /// Returns the integral of the response over l, the directional albedo at F = 1.
    pub fn integral(&self) -> f64 {
        // Visible normals leave the weight G2 / G1, which is at most 1.
        let masking = ggx::g1(self.v.z, self.alpha);
        let weight = |point: [f64; 2]| {
            let l = reflect(self.v, sampling::visible_ggx(point, self.v, self.alpha));
            ggx::g2_correlated(self.v.z, l.z.clamp(0.0, 1.0), self.alpha) / masking
        };
        half_turn(INTEGRAL_POINTS).into_iter().map(weight).sum::<f64>() / INTEGRAL_POINTS as f64
    }
}

/// Returns Halton points on half a turn of azimuth: what is symmetric about the plane of n and v
/// needs no other. They are moved so that each mean is a half, as that of random points: the
/// sequence's own is lower, which a peak at 0 would show.
pub(super) fn half_turn(count: usize) -> Vec<[f64; 2]> {
    let mut points: Vec<[f64; 2]> = (0..count as u64).map(halton).collect();
    for axis in 0..2 {
        let mean = points.iter().map(|point| point[axis]).sum::<f64>() / count as f64;
        for point in &mut points {
            point[axis] = (point[axis] + 0.5 - mean).min(1.0 - f64::EPSILON);
        }
    }
    points.iter().map(|[u, w]| [0.5 * u, *w]).collect()
}
