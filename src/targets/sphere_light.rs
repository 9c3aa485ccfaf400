//! The specular highlight of a spherical light, seen from any side: what the models of Karis, "Real
//! Shading in Unreal Engine 4", 2013, and of Pesce and Iwanicki, "Approximate Models for Physically
//! Based Rendering", 2015, §4, stand for in a shader. [`super::area_light`] is its part v = n.
//!
//! Definition: a light fills the cone of full angle ω around l, `sin(ω/2)` being its radius over its
//! distance. `lobe` is the mean over that cone, its part below the horizon dark, of
//! `π (α² + sin²(ω/2)/4) D(n·h) G2`: GGX and the height-correlated masking, α = roughness². Divided by
//! `π (4 α² + sin²(ω/2)) n·v`, and times the light's irradiance on a surface that faces it, it is what is
//! reflected with F = 1. That factor makes `lobe` about 1 where v, n and the light are in line, however
//! narrow the lobe and however large the light: D of v = n lets through `1/(1 + tan²(ω/4)/α²)` of its
//! peak (Dupuy, Heitz and Belcour, "A Spherical Cap Preserving Parameterization for Spherical
//! Distributions", 2017: it is a uniform sphere, stretched, and the light a cap of it).
//!
//! Rows: the reflected direction r and l are δ apart, at an azimuth from the plane of v and n. Sobol
//! points choose the size, roughness, n·v, the azimuth and δ, evenly up to where the highlight has faded,
//! `ω/2 + 4 α`, so that rows lie where light is; l is above the horizon.
//!
//! Method: over the angle ψ from r and the azimuth φ around it. The light is an arc of azimuths as
//! for [`super::area_light`], the horizon another; where they meet, one or two arcs remain. The
//! double-exponential rule integrates over each, and over ψ between the angles where an arc begins
//! or ends, and the lobe's widths 2α and, across the plane of incidence, 2α n·v.

use super::lobe::ggx as over_peak;
use super::{Error, Make, Progress, Recipe, Target, points};
use crate::dataset::{Axis, Dataset, Split};
use crate::microfacet::ggx;
use crate::num::low_discrepancy::Sobol;
use crate::quadrature::{Estimate, TanhSinh};
use rayon::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::sync::atomic::{AtomicUsize, Ordering};

/// The largest estimated error that [`generate`](super::generate) accepts.
pub const ALLOWED_ERROR: f64 = 1e-5;
/// For each of the nested integrals, whose errors add up.
const TOLERANCE: f64 = 1e-7;
/// The light's radius over its distance, sin(ω/2): from a lamp far away to one near by.
const SIZE: [f64; 2] = [0.01, 0.48];
/// At .1, alpha is .01.
const ROUGHNESS: [f64; 2] = [0.1, 1.0];
/// Below, G2 of a rough surface leaves nothing to approximate.
const N_DOT_V: [f64; 2] = [0.1, 1.0];
/// The least n·l.
const ABOVE_HORIZON: f64 = 0.05;
/// In units of alpha, beyond the light's rim: a hundredth of the peak.
const FADED: f64 = 4.0;

pub(super) const TARGET: Target = Target {
    name: "sphere_light",
    description: "highlight of a spherical light, D G2 over it, about 1 at its brightest",
    columns: "sin_half_omega, roughness, n_dot_v, n_dot_l, r_dot_l (r = v reflected) → lobe",
    parameters: &[points("4096", 65_536)],
    make: Make::Rows(generate),
};

/// A spherical light and a view of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// The cone's full angle, in radians, in (0, π).
    pub omega: f64,
    /// In (0, 1].
    pub alpha: f64,
    /// In (0, 1].
    pub n_dot_v: f64,
    /// The angle of the cone's axis from the reflected direction, in (0, π/2).
    pub offset: f64,
    /// The axis' azimuth around the reflected direction, in [0, π]; 0 is towards n.
    pub azimuth: f64,
}

impl Place {
    /// Computes `lobe`. Make `rule` once for many places.
    pub fn integrate(&self, rule: &TanhSinh) -> Estimate {
        let radius = 0.5 * self.omega;
        let solid_angle = 4.0 * PI * (0.5 * radius).sin().powi(2);
        let brightness = 1.0 + (0.5 * radius.sin() / self.alpha).powi(2);
        let (inner, outer) = ((self.offset - radius).abs(), self.offset + radius);
        let covered = if self.offset < radius { 0.0 } else { inner };
        let from_view = FRAC_PI_2 - self.n_dot_v.acos();
        let mut ends = vec![covered, outer];
        let marks = [inner, from_view, 2.0 * self.alpha, 2.0 * self.alpha * self.n_dot_v];
        ends.extend(marks.into_iter().filter(|mark| (covered..outer).contains(mark)));
        ends.sort_by(f64::total_cmp);
        let mut total = Estimate { value: 0.0, error: 0.0, evaluations: 0 };
        for pair in ends.windows(2).filter(|pair| pair[0] < pair[1]) {
            let ring = |psi: f64| {
                let [value, error] = self.ring(rule, psi, TOLERANCE / brightness);
                [value, error].map(|of| brightness * of * psi.sin() / solid_angle)
            };
            let [value, inner_error] = match pair[0] > 0.0 && pair[1] > 2.0 * pair[0] {
                false => rule.integrate_all(pair[0], pair[1], TOLERANCE, |at| ring(at.x)),
                true => rule.integrate_all(pair[0].ln(), pair[1].ln(), TOLERANCE, |at| {
                    let psi = at.x.exp();
                    ring(psi).map(|value| psi * value)
                }),
            };
            total.value += value.value;
            total.error += value.error + inner_error.value.abs();
            total.evaluations += value.evaluations;
        }
        total
    }

    /// Integrates over the azimuths of the circle at `psi` around r that are in the light and above
    /// the horizon; returns an estimate of the error, too.
    fn ring(&self, rule: &TanhSinh, psi: f64, tolerance: f64) -> [f64; 2] {
        let light = self.lit(psi);
        let n_dot_r = self.n_dot_v;
        let sine = (1.0 - n_dot_r * n_dot_r).max(0.0).sqrt();
        let (across, along) = (psi.sin() * sine, psi.cos() * n_dot_r);
        let up = if along >= across { PI } else { (-along / across).clamp(-1.0, 1.0).acos() };
        let mut sum = [0.0; 2];
        for turn in [-TAU, 0.0, TAU] {
            let from = (self.azimuth - light).max(turn - up);
            let to = (self.azimuth + light).min(turn + up);
            if from < to {
                let arc = rule.integrate(from, to, tolerance, |at| self.light(psi, at.x));
                sum[0] += arc.value;
                sum[1] += arc.error;
            }
        }
        sum
    }

    /// Half the arc of azimuths at `psi` that the light covers.
    fn lit(&self, psi: f64) -> f64 {
        let radius = 0.5 * self.omega;
        if psi <= radius - self.offset {
            return PI;
        }
        let excess =
            (0.5 * (radius + self.offset - psi)).sin() * (0.5 * (radius - self.offset + psi)).sin();
        let sine_squared = excess / (self.offset.sin() * psi.sin());
        2.0 * sine_squared.clamp(0.0, 1.0).sqrt().asin()
    }

    /// D over its peak, times G2, of light from the direction at ψ and φ around r.
    fn light(&self, psi: f64, phi: f64) -> f64 {
        let cosine = self.n_dot_v;
        let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
        let n_dot_l = psi.cos() * cosine + psi.sin() * phi.cos() * sine;
        if n_dot_l <= 0.0 {
            return 0.0;
        }
        // l + v, without the cancellation of r's part along the surface.
        let along = 2.0 * sine * (0.5 * psi).sin().powi(2) + psi.sin() * phi.cos() * cosine;
        let across = psi.sin() * phi.sin();
        let tilt = along.hypot(across).atan2(n_dot_l + cosine);
        over_peak(tilt, self.alpha) * ggx::g2_correlated(cosine, n_dot_l.min(1.0), self.alpha)
    }
}

/// Makes the dataset: `points` Sobol points for the search split, twice as many for validation.
///
/// # Errors
/// An estimated error above [`ALLOWED_ERROR`].
pub fn generate(recipe: &Recipe, progress: Progress) -> Result<Dataset, Error> {
    let points = recipe.count("points");
    let sobol = Sobol::<5>::new();
    // Some points are below the horizon; the first is the origin.
    let places: Vec<[f32; 5]> =
        (1..).filter_map(|index| columns_at(sobol.point(index))).take(3 * points).collect();
    let rule = TanhSinh::new();
    let done = AtomicUsize::new(0);
    let lobes: Vec<Estimate> = places
        .par_iter()
        .map(|place| {
            let lobe = Place::of(place).integrate(&rule);
            progress(done.fetch_add(1, Ordering::Relaxed) + 1, places.len());
            lobe
        })
        .collect();
    for (place, lobe) in places.iter().zip(&lobes) {
        if lobe.error.is_nan() || lobe.error > ALLOWED_ERROR {
            return Err(Error::Accuracy {
                target: TARGET.name.into(),
                point: format!("{:?}", Place::of(place)),
                error: lobe.error,
                allowed: ALLOWED_ERROR,
            });
        }
    }
    let split = |rows: std::ops::Range<usize>| {
        let column = |index: usize| places[rows.clone()].iter().map(|at| at[index]).collect();
        let mut columns: Vec<Vec<f32>> = (0..5).map(column).collect();
        columns.push(lobes[rows.clone()].iter().map(|lobe| lobe.value as f32).collect());
        Split { columns, ..Split::default() }
    };
    let axis = |name: &'static str, domain: [f64; 2]| Axis { domain, ..Axis::unit(name) }.column();
    Ok(Dataset::of_splits(
        TARGET.name,
        recipe.origin(format!("estimated error below {ALLOWED_ERROR:.0e} before rounding to f32")),
        vec![
            axis("sin_half_omega", SIZE),
            axis("roughness", ROUGHNESS),
            axis("n_dot_v", N_DOT_V),
            axis("n_dot_l", [ABOVE_HORIZON, 1.0]),
            Axis::unit("r_dot_l").column(),
        ],
        [("lobe", "1")],
        [split(0..points), split(points..3 * points)],
    )?)
}

/// The dataset's inputs at a point of the unit cube; none where the light's centre is too low.
fn columns_at(point: [f64; 5]) -> Option<[f32; 5]> {
    let between = |[least, most]: [f64; 2], at: f64| least + at * (most - least);
    let size = between(SIZE, point[0]);
    let roughness = between(ROUGHNESS, point[1]);
    let n_dot_v = between(N_DOT_V, point[2]);
    let faded = size.asin() + FADED * roughness * roughness;
    let offset = point[3] * faded.min(FRAC_PI_2);
    let azimuth = PI * point[4];
    let sine = (1.0 - n_dot_v * n_dot_v).sqrt();
    let n_dot_l = offset.cos() * n_dot_v + offset.sin() * azimuth.cos() * sine;
    let columns = [size, roughness, n_dot_v, n_dot_l, offset.cos()];
    (n_dot_l > ABOVE_HORIZON && offset > 0.0).then_some(columns.map(|value| value as f32))
}

impl Place {
    /// The place of a dataset's inputs, as they are rounded.
    pub fn of(columns: &[f32; 5]) -> Place {
        let [sin_half_omega, roughness, n_dot_v, n_dot_l, r_dot_l] = columns.map(f64::from);
        // Where rounding leaves no angle, l is r.
        let offset = r_dot_l.min(1.0).acos().max(1e-9);
        let sine = (1.0 - n_dot_v * n_dot_v).max(0.0).sqrt();
        let towards_n = (n_dot_l - r_dot_l * n_dot_v) / (sine * offset.sin());
        let azimuth = if towards_n.is_nan() { 0.0 } else { towards_n.clamp(-1.0, 1.0).acos() };
        Place {
            omega: 2.0 * sin_half_omega.asin(),
            alpha: roughness * roughness,
            n_dot_v,
            offset,
            azimuth,
        }
    }
}
