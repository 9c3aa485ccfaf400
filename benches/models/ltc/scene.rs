//! A floor and two spheres of one roughness under a rectangle and a sphere of radiance 1, from three
//! heights. With f0 = .5 a mirror shows the lights white, and nothing is brighter, so nothing clips.

use glam::{DMat3, DVec2, DVec3};
use lgp::microfacet::{fresnel, ggx};
use lgp::num::low_discrepancy::hammersley;
use std::f64::consts::TAU;

pub const ROUGHNESSES: [f64; 12] = [0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0];
/// Heights of the eye.
pub const HEIGHTS: [f64; 3] = [0.25, 1.2, 4.5];
/// Pixels of a picture each way.
pub const SIZE: usize = 128;
pub const F0: f64 = 0.5;
/// Directions from each of the lights and from the lobe, squared.
const SAMPLES: usize = 24;
/// Corners of the outline of a sphere, placed as in `ltc.hlsl`: the narrowest lobes see them.
const OUTLINE: usize = 24;

/// m11, m13, m31, m33, magnitude, fresnel.
pub type Entries = [f64; 6];

/// What an eye sees in a pixel.
#[derive(Clone, Copy)]
pub struct Surface {
    pub at: DVec3,
    pub normal: DVec3,
    pub view: DVec3,
}

const SPHERES: [(DVec3, f64); 2] =
    [(DVec3::new(-1.3, 0.6, 0.6), 0.6), (DVec3::new(1.0, -0.6, 0.4), 0.4)];
pub const LAMP: (DVec3, f64) = (DVec3::new(2.0, 1.6, 1.1), 0.4);
pub const CORNERS: [DVec3; 4] = [
    DVec3::new(-1.6, 3.0, 0.3),
    DVec3::new(0.8, 3.0, 0.3),
    DVec3::new(0.8, 2.6, 1.9),
    DVec3::new(-1.6, 2.6, 1.9),
];

fn hit_sphere(from: DVec3, along: DVec3, (centre, radius): (DVec3, f64)) -> Option<f64> {
    let to = centre - from;
    let nearest = to.dot(along);
    let square = nearest * nearest - to.length_squared() + radius * radius;
    (square > 0.0).then(|| nearest - square.sqrt()).filter(|distance| *distance > 1e-6)
}

fn hit_rectangle(from: DVec3, along: DVec3) -> Option<f64> {
    let [u, v] = [CORNERS[1] - CORNERS[0], CORNERS[3] - CORNERS[0]];
    let normal = u.cross(v);
    let distance = (CORNERS[0] - from).dot(normal) / along.dot(normal);
    let at = from + distance * along - CORNERS[0];
    let inside = |axis: DVec3| (0.0..=1.0).contains(&(at.dot(axis) / axis.length_squared()));
    (distance > 1e-6 && inside(u) && inside(v)).then_some(distance)
}

/// The surface in each pixel; none where the sky or a light is.
pub fn picture(height: f64) -> Vec<Option<Surface>> {
    (0..SIZE * SIZE).map(|pixel| seen(height, pixel)).collect()
}

fn seen(height: f64, pixel: usize) -> Option<Surface> {
    let eye = DVec3::new(0.3, -5.0, height);
    let forward = (DVec3::new(0.0, 0.6, 0.5) - eye).normalize();
    let right = forward.cross(DVec3::Z).normalize();
    let up = right.cross(forward);
    let place = |at: usize| (at as f64 + 0.5) / SIZE as f64 - 0.5;
    let (x, y) = (place(pixel % SIZE), -place(pixel / SIZE));
    let along = (forward + 0.85 * (x * right + y * up)).normalize();
    let floor = -eye.z / along.z;
    let mut found = (f64::INFINITY, DVec3::ZERO);
    if floor > 0.0 && floor < 14.0 {
        found = (floor, DVec3::Z);
    }
    for sphere in SPHERES {
        if let Some(distance) = hit_sphere(eye, along, sphere).filter(|d| *d < found.0) {
            found = (distance, (eye + distance * along - sphere.0) / sphere.1);
        }
    }
    let lights = [hit_sphere(eye, along, LAMP), hit_rectangle(eye, along)];
    let hidden = lights.into_iter().flatten().any(|distance| distance < found.0);
    let (distance, normal) = found;
    let surface = Surface { at: eye + distance * along, normal, view: -along };
    (distance.is_finite() && !hidden).then_some(surface)
}

impl Surface {
    pub fn n_dot_v(&self) -> f64 {
        self.normal.dot(self.view).clamp(1e-3, 1.0)
    }

    /// Directions to the frame of the normal and v.
    fn to_frame(self) -> DMat3 {
        let across = self.view - self.normal * self.normal.dot(self.view);
        let x = across.try_normalize().unwrap_or_else(|| self.normal.any_orthonormal_vector());
        DMat3::from_cols(x, self.normal.cross(x), self.normal).transpose()
    }

    /// The outlines of the lights, seen from here. Lights shine to both sides.
    fn outlines(&self) -> [Vec<DVec3>; 2] {
        let to = LAMP.0 - self.at;
        let axis = to.normalize();
        let aside = if axis.z.abs() < 0.9 { DVec3::Z } else { DVec3::X };
        let x = axis.cross(aside).normalize();
        let y = axis.cross(x);
        let sine = LAMP.1 / to.length();
        // The polygon of the outline's area.
        let corner = TAU / OUTLINE as f64;
        let tangent = sine / (1.0 - sine * sine).sqrt() * (corner / corner.sin()).sqrt();
        let lamp = (0..OUTLINE).map(|at| {
            let (sine, cosine) = (corner * at as f64).sin_cos();
            axis + tangent * (cosine * x + sine * y)
        });
        [CORNERS.map(|corner| corner - self.at).to_vec(), lamp.collect()]
    }

    /// The light towards the eye, by transformed cosines.
    pub fn shade(&self, entries: Entries) -> f64 {
        let [m11, m13, m31, m33, magnitude, fresnel] = entries;
        let inverse =
            DMat3::from_cols(DVec3::new(m11, 0.0, m31), DVec3::Y, DVec3::new(m13, 0.0, m33))
                * self.to_frame();
        let form: f64 = self.outlines().iter().map(|outline| cosine_of(outline, &inverse)).sum();
        (F0 * (magnitude - fresnel) + fresnel) * form
    }

    /// The same of GGX, by samples of the lights and of the lobe.
    pub fn truth(&self, roughness: f64) -> f64 {
        let alpha = roughness * roughness;
        let to_frame = self.to_frame();
        let v = DVec3::new((1.0 - self.n_dot_v().powi(2)).sqrt(), 0.0, self.n_dot_v());
        let lobe = |l: DVec3| {
            let h = (l + v).normalize();
            if l.z <= 0.0 || h.z <= 0.0 {
                return [0.0; 2];
            }
            let d = ggx::distribution(h.z.min(1.0), alpha);
            let f = F0 + (1.0 - F0) * fresnel::schlick_weight(v.dot(h).min(1.0));
            let visible = ggx::visibility_correlated(v.z, l.z.min(1.0), alpha);
            [d * visible * l.z * f, 0.25 * d * h.z / v.dot(h)]
        };
        let lamp = LAMP.0 - self.at;
        let cap = 1.0 - (1.0 - (LAMP.1 / lamp.length()).powi(2)).sqrt();
        let [u, w] = [CORNERS[1] - CORNERS[0], CORNERS[3] - CORNERS[0]];
        let area = u.cross(w);
        // Densities of the two lights towards a direction, 0 where they are not.
        let densities = |direction: DVec3| {
            let in_lamp = direction.dot(lamp.normalize()) > 1.0 - cap;
            let rectangle = hit_rectangle(self.at, direction)
                .map_or(0.0, |distance| distance * distance / direction.dot(area).abs());
            [if in_lamp { 1.0 / (TAU * cap) } else { 0.0 }, rectangle]
        };
        let mut sum = 0.0;
        let mut add = |direction: DVec3| {
            let [value, density] = lobe(to_frame * direction);
            let of = densities(direction);
            let lights = of.iter().filter(|density| **density > 0.0).count() as f64;
            let total = density + of[0] + of[1];
            if value > 0.0 && lights > 0.0 {
                sum += lights * value / total;
            }
        };
        for index in 0..SAMPLES * SAMPLES {
            let [a, b] = hammersley::<2>(index as u64, (SAMPLES * SAMPLES) as u64);
            add((CORNERS[0] + a * u + b * w - self.at).normalize());
            let axis = lamp.normalize();
            let x = axis.any_orthonormal_vector();
            let cosine = 1.0 - a * cap;
            let spread = DVec2::from_angle(TAU * b) * (1.0 - cosine * cosine).sqrt();
            add(cosine * axis + spread.x * x + spread.y * axis.cross(x));
            let slope = DVec2::from_angle(TAU * b) * alpha * (a / (1.0 - a)).sqrt();
            let h = DVec3::new(slope.x, slope.y, 1.0).normalize();
            add(to_frame.transpose() * (2.0 * v.dot(h) * h - v));
        }
        sum / (SAMPLES * SAMPLES) as f64
    }
}

/// The integral of the cosine, over π, over a polygon that a matrix transforms, clipped at the
/// horizon: Lambert's formula as in Heitz et al. 2016, eq. 11.
fn cosine_of(outline: &[DVec3], inverse: &DMat3) -> f64 {
    let corners: Vec<DVec3> = outline.iter().map(|corner| *inverse * *corner).collect();
    let mut above: Vec<DVec3> = Vec::with_capacity(corners.len() + 1);
    for (index, &corner) in corners.iter().enumerate() {
        let next = corners[(index + 1) % corners.len()];
        if corner.z > 0.0 {
            above.push(corner.normalize());
        }
        if (corner.z > 0.0) != (next.z > 0.0) {
            let share = corner.z / (corner.z - next.z);
            above.push((corner + share * (next - corner)).with_z(0.0).normalize());
        }
    }
    let edge = |index: usize| {
        let (from, to) = (above[index], above[(index + 1) % above.len()]);
        let normal = from.cross(to);
        let sine = normal.length();
        if sine > 0.0 { normal.z / sine * sine.atan2(from.dot(to)) } else { 0.0 }
    };
    ((0..above.len()).map(edge).sum::<f64>() / TAU).abs()
}
