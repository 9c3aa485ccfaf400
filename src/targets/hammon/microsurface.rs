//! Light on a surface that exists only as mathematics: GGX normals, independent
//! of each other and of height, with Smith's masking.
//!
//! Heights enter through f alone, the fraction of the surface that is lower. A ray from a height f
//! at cosine c from the normal is still free at f' with the probability `(f / f')^Λ(c)`, and
//! `Λ(-c) = -1 - Λ(c)` downwards (Hammon, "PBR Diffuse Lighting for GGX+Smith Microsurfaces",
//! 2017, appendix; Heitz, Hanika, d'Eon, Dachsbacher, "Multiple-Scattering Microfacet BSDFs with
//! the Smith Model", 2016). A facet reflects with Schlick's probability, or else lets light through
//! to a Lambertian interior that absorbs nothing, and out of it again by the lobe of
//! [`sampling::transmitted`].
//!
//! Paths start at the light. At each facet that a path meets, the light that would go from there to
//! each view, unhindered, is added up (next-event estimation): from the interior, and from the
//! facet whose normal is the half-vector.

use crate::microfacet::half_vector::{reflect, reflection_jacobian};
use crate::microfacet::{diffuse, fresnel, ggx, sampling, sine_squared};
use glam::DVec3;
use rand::{Rng, RngExt};

/// Schlick's reflectance at normal incidence: water, as on the slides.
pub const F0: f64 = 0.02;

/// The distribution of the normals of facets that a ray meets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sampler {
    /// By projected area, `<w·m> D(m)`, as Smith's masking implies. Light is conserved and the
    /// result reciprocal.
    Exact,
    /// By `D(m) (n·m)` among the facets that face the ray, as the slides say. A normal that does
    /// not face it is tried again with its azimuth negated, if the ray rises. That mirrors it at
    /// the plane of x, not of the ray, and favours some azimuths; light that a facet reflects to a
    /// view is weighted without that bias. The published constants come from this sampler, with
    /// light in the plane of x. It is not reciprocal.
    Literal,
}

/// A GGX microsurface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Microsurface {
    /// The width, in (0, 1].
    pub alpha: f64,
    /// The distribution of normals that rays meet.
    pub sampler: Sampler,
}

/// A direction above the horizon towards which light is collected.
#[derive(Clone, Copy, Debug)]
pub struct View {
    direction: DVec3,
    lambda: f64,
}

/// The light of one path in the direction of a view, as a BRDF in 1/sr.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Light {
    /// Reflected only.
    pub specular: f64,
    /// Transmitted once, reflected any number of times.
    pub single: f64,
    /// Transmitted twice or more.
    pub multi: f64,
}

impl Light {
    fn after(&mut self, transmissions: u32) -> &mut f64 {
        match transmissions {
            0 => &mut self.specular,
            1 => &mut self.single,
            _ => &mut self.multi,
        }
    }
}

impl Microsurface {
    /// Prepares a view in a direction above the horizon.
    pub fn view(&self, direction: DVec3) -> View {
        View { direction, lambda: ggx::lambda(direction.z, self.alpha) }
    }

    /// Follows one path of the light from direction `l`, above the horizon, until it leaves, and
    /// adds its light towards each view to `light`, which has as many elements. Returns how often
    /// it was transmitted.
    pub fn trace(&self, l: DVec3, views: &[View], rng: &mut impl Rng, light: &mut [Light]) -> u32 {
        let (mut w, mut height, mut transmissions) = (l, 1.0, 0);
        while let Some(met) = self.next_height(height, -w.z, 1.0 - rng.random::<f64>()) {
            height = met;
            let log_height = height.ln();
            let facing = self.facing(w);
            for (view, light) in views.iter().zip(&mut *light) {
                *light.after(transmissions) += self.reflected(w, facing, view, log_height);
            }
            let m = self.normal(w, rng);
            let v_dot_m = w.dot(m).clamp(0.0, 1.0);
            if rng.random::<f64>() < fresnel::schlick(F0, v_dot_m) {
                w = -reflect(w, m);
                continue;
            }
            transmissions += 1;
            for (view, light) in views.iter().zip(&mut *light) {
                *light.after(transmissions) += emitted(m, view, log_height);
            }
            w = -around(m, sampling::transmitted(rng.random()));
        }
        transmissions
    }

    /// Returns the height at which a ray from `height` with direction cosine `cosine` meets the
    /// surface, if its chance of getting further is `survival` in (0, 1]; `None` if it leaves.
    fn next_height(&self, height: f64, cosine: f64, survival: f64) -> Option<f64> {
        let root = self.root(cosine);
        if cosine <= 0.0 {
            // 1 / (1 + Λ(|c|)).
            return Some(height * survival.powf(-2.0 * cosine / (root - cosine)));
        }
        // 1 / Λ(c), rationalised.
        let spread = self.alpha * self.alpha * sine_squared(cosine);
        let reached = height * survival.powf(-2.0 * cosine * (root + cosine) / spread);
        (reached < 1.0).then_some(reached)
    }

    /// `sqrt(c² + α² (1 - c²))`.
    fn root(&self, cosine: f64) -> f64 {
        (cosine * cosine + self.alpha * self.alpha * sine_squared(cosine)).sqrt()
    }

    /// Returns the facets that face w, above the horizon or below: their projected area `∫ <w·m> D
    /// dm`, or the part `∫ D (n·m) dm` of the macrosurface that they cover.
    fn facing(&self, w: DVec3) -> f64 {
        let root = self.root(w.z);
        let sum = match w.z < 0.0 {
            // root + w.z without its cancellation.
            true => self.alpha * self.alpha * sine_squared(w.z) / (root - w.z),
            false => root + w.z,
        };
        match self.sampler {
            Sampler::Exact => 0.5 * sum,
            Sampler::Literal => 0.5 * sum / root,
        }
    }

    /// Draws a normal that faces w.
    fn normal(&self, w: DVec3, rng: &mut impl Rng) -> DVec3 {
        match self.sampler {
            Sampler::Exact => sampling::visible_ggx(rng.random(), w, self.alpha),
            Sampler::Literal => self.literal_normal(w, rng),
        }
    }

    fn literal_normal(&self, w: DVec3, rng: &mut impl Rng) -> DVec3 {
        // A rising ray meets only facets steeper than itself.
        let rises = w.z < 0.0;
        let least = if rises { (w.z / self.root(w.z)).powi(2) } else { 0.0 };
        loop {
            let [u, x]: [f64; 2] = rng.random();
            let m = sampling::ggx([u, least + x * (1.0 - least)], self.alpha);
            let mirrored = DVec3::new(m.x, -m.y, m.z);
            if w.dot(m) > 0.0 {
                return m;
            }
            if rises && w.dot(mirrored) > 0.0 {
                return mirrored;
            }
        }
    }

    /// Returns the light that facets reflect from w to a view.
    fn reflected(&self, w: DVec3, facing: f64, view: &View, log_height: f64) -> f64 {
        let sum = w + view.direction;
        if sum.z <= 0.0 {
            return 0.0;
        }
        let h = sum.normalize();
        let w_dot_h = w.dot(h).min(1.0);
        if w_dot_h <= 0.0 {
            return 0.0;
        }
        let weight = match self.sampler {
            Sampler::Exact => w_dot_h,
            Sampler::Literal => h.z,
        };
        let density = ggx::distribution(h.z.min(1.0), self.alpha) * weight / facing;
        let lobe = density * reflection_jacobian(w_dot_h) * fresnel::schlick(F0, w_dot_h);
        lobe * view.escape(log_height)
    }
}

impl View {
    /// Returns the probability of reaching the view from a height, over n·v.
    fn escape(&self, log_height: f64) -> f64 {
        (self.lambda * log_height).exp() / self.direction.z
    }
}

/// Returns the light that leaves the interior behind a facet towards a view.
fn emitted(m: DVec3, view: &View, log_height: f64) -> f64 {
    let cosine = m.dot(view.direction);
    if cosine <= 0.0 {
        return 0.0;
    }
    let lobe = diffuse::transmission_norm::<f64>() * fresnel::schlick_transmission(cosine.min(1.0));
    lobe * cosine * view.escape(log_height)
}

/// Rotates a direction from the frame of a normal.
fn around(m: DVec3, local: DVec3) -> DVec3 {
    let (a, b) = m.any_orthonormal_pair();
    (local.x * a + local.y * b + local.z * m).normalize()
}
