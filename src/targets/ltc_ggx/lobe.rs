//! The two lobes that are compared, and how far they are apart.

use crate::microfacet::ggx;
use crate::quadrature::Rule;
use crate::targets::normals::reflected_azimuths;
use glam::{DMat3, DVec3};
use std::f64::consts::{FRAC_PI_2, PI};

/// GGX times the cosine of the light, without Fresnel, seen from v in the plane of x and z.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reflection {
    v: DVec3,
    alpha: f64,
}

impl Reflection {
    pub fn new(n_dot_v: f64, alpha: f64) -> Reflection {
        let sine = ((1.0 - n_dot_v) * (1.0 + n_dot_v)).sqrt();
        Reflection { v: DVec3::new(sine, 0.0, n_dot_v), alpha }
    }

    /// The lobe towards l, per steradian, and the density at which v, mirrored about normals of the
    /// distribution, is l.
    pub fn at(&self, l: DVec3) -> [f64; 2] {
        let h = self.v + l;
        // Opposite to v, where normals face at a right angle: a point.
        if h.z == 0.0 {
            return [0.0; 2];
        }
        // D by the slopes of h, which do not cancel where the lobe is narrow: times |h|⁴.
        let square = self.alpha * self.alpha;
        let ellipse = h.z * h.z + (h.x * h.x + h.y * h.y) / square;
        let length = h.length_squared();
        let d = length * length / (PI * square * ellipse * ellipse);
        // D (n·h) / (4 v·h), where v·h = |v + l| / 2. Light far below the horizon comes from the
        // backs of facets.
        let density = 0.5 * d * h.z.abs() / length;
        if l.z <= 0.0 {
            return [0.0, density];
        }
        let cosine = l.z.min(1.0);
        [d * cosine * ggx::visibility_correlated(self.v.z, cosine, self.alpha), density]
    }
}

/// A cosine lobe, `max(z, 0)/π`, whose directions are transformed by a matrix.
#[derive(Clone, Copy, Debug)]
pub(super) struct Transformed {
    inverse: DMat3,
    /// The determinant of `inverse`, over π.
    scale: f64,
}

impl Transformed {
    /// The lobe of an inverse matrix, of [m11, m13, m31, m33]; none if the matrix mirrors.
    pub fn of_inverse([m11, m13, m31, m33]: [f64; 4]) -> Option<Transformed> {
        let determinant = m11 * m33 - m13 * m31;
        let columns = [DVec3::new(m11, 0.0, m31), DVec3::Y, DVec3::new(m13, 0.0, m33)];
        let inverse = DMat3::from_cols(columns[0], columns[1], columns[2]);
        (determinant > 0.0).then_some(Transformed { inverse, scale: determinant / PI })
    }

    /// The inverse matrix times l.
    pub fn back(&self, l: DVec3) -> DVec3 {
        self.inverse * l
    }

    /// The lobe towards l, per steradian: its integral over the sphere is 1 (Heitz et al. 2016, eq.
    /// 1, with `|M w| = 1/|M⁻¹ l|`).
    pub fn at(&self, l: DVec3) -> f64 {
        let w = self.back(l);
        let square = w.length_squared();
        self.scale * w.z.max(0.0) / (square * square)
    }
}

/// A direction of light and what is known there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Light {
    pub direction: DVec3,
    /// Of GGX.
    pub value: f64,
    /// An integral over the sphere is the sum of these times its integrand.
    pub weight: f64,
}

/// Where directions are drawn from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Techniques {
    /// From either lobe.
    Both,
    /// From the transformed cosine: for integrands that end where it does. They jump there.
    Cosine,
}

/// A rule of integration over the directions of light: on rings about the axes of the lobes, in
/// azimuths of one half, since all is symmetric.
#[derive(Clone, Debug)]
pub(super) struct Sphere {
    /// Places and weights on [0, 1].
    rings: Vec<[f64; 2]>,
    azimuths: Vec<[f64; 2]>,
}

impl Sphere {
    /// Makes a rule with Gauss–Legendre points, as many rings as azimuths.
    pub fn new(points: usize) -> Sphere {
        let on_unit = |points: usize| {
            let rule = Rule::gauss_legendre(points);
            let used = rule.points().iter().filter(|point| point.weight > 0.0);
            used.map(|point| [0.5 * (1.0 + point.node), 0.5 * point.weight]).collect()
        };
        Sphere { rings: on_unit(points), azimuths: on_unit(points.div_ceil(2)) }
    }

    /// Returns the rings' u, drawn as t²(3 - 2t), and weights. The lobes are of the roots of u and
    /// of 1 - u, which are smooth in t.
    fn rings(&self) -> impl Iterator<Item = [f64; 2]> {
        let drawn = |[t, weight]: [f64; 2]| [t * t * (3.0 - 2.0 * t), 6.0 * t * (1.0 - t) * weight];
        self.rings.iter().copied().map(drawn)
    }

    /// Returns cosine, sine and weight of azimuths, half of them up to the horizon's `limit`, half
    /// of them beyond; beyond a right angle if the horizon does not cut the ring.
    fn azimuths(&self, limit: f64) -> impl Iterator<Item = [f64; 3]> {
        let limit = if limit > 0.0 && limit < PI { limit } else { FRAC_PI_2 };
        self.azimuths.iter().flat_map(move |&[t, weight]| {
            let halves = [(limit * t, limit), (PI - (PI - limit) * t, PI - limit)];
            halves.map(|(phi, range)| [phi.cos(), phi.sin(), weight * range / PI])
        })
    }

    /// Draws directions, weighted by the balance heuristic (Veach, "Robust Monte Carlo Methods for
    /// Light Transport Simulation", 1997, §9.2.2).
    pub fn lights(
        &self,
        seen: &Reflection,
        cosine: &Transformed,
        techniques: Techniques,
    ) -> Vec<Light> {
        let both = techniques == Techniques::Both;
        let matrix = cosine.inverse.inverse();
        let mut lights = Vec::with_capacity(4 * self.rings.len() * self.azimuths.len());
        let mut add = |direction: DVec3, weight: f64| {
            let [value, density] = seen.at(direction);
            let density = cosine.at(direction) + if both { density } else { 0.0 };
            if density > 0.0 {
                lights.push(Light { direction, value, weight: weight / density });
            }
        };
        for [u, ring] in self.rings() {
            if both {
                // Walter et al. 2007, eq. 35.
                let slope = seen.alpha * (u / (1.0 - u)).sqrt();
                let z = 1.0 / (1.0 + slope * slope).sqrt();
                let limit = reflected_azimuths([seen.v.z, seen.v.x], [z, slope * z]);
                for [cosine, sine, weight] in self.azimuths(limit) {
                    let h = DVec3::new(slope * cosine, slope * sine, 1.0) * z;
                    add((2.0 * seen.v.dot(h) * h - seen.v).normalize(), ring * weight);
                }
            }
            let (radius, z) = (u.sqrt(), (1.0 - u).sqrt());
            let horizon = -matrix.z_axis.z * z / (matrix.x_axis.z * radius);
            let limit = if horizon.abs() < 1.0 { horizon.acos() } else { PI };
            for [cosine, sine, weight] in self.azimuths(limit) {
                let w = DVec3::new(radius * cosine, radius * sine, z);
                add((matrix * w).normalize(), ring * weight);
            }
        }
        lights
    }
}
