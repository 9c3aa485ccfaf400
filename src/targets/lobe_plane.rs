//! Finds the lobe, perpendicular to a plane at distance 1, that looks on the plane like one from
//! elsewhere: the roughness correction of parallax-corrected cube maps (Pesce and Iwanicki,
//! "Approximate Models for Physically Based Rendering", 2015, §8).
//!
//! Definition: the lobe `K(θ; r) = D(θ/2) cos θ` over its peak, D being GGX with α = r², 0 below
//! its own horizon. Seen from distance 1 straight above, it draws `K(atan ρ; r)` at ρ on the plane.
//! The roughness r' ≤ 1, a scale s and an offset o are fitted by least squares, over the disc ρ <
//! `reach`, to what another lobe draws; r' is the output, s and o are given on request.
//! - over distance d: the other lobe is perpendicular, too, at distance d, and draws
//!   `K(atan(ρ/d); r)`.
//! - over angle ψ: the other lobe starts at height 1 and hits the plane at ψ from its normal, in
//!   the disc's centre; the fitted lobe may shift along the line through there and the foot of the
//!   plane's normal, within the disc: `shift` is 0 at the foot and 1 where the lobe hits.
//!
//! For narrow lobes r' = r √d, and r' = r / cos^(3/4) ψ: a spot of width α is wider by 1/cos ψ
//! across and by 1/cos² ψ along the line, and α' follows the geometric mean.
//!
//! Method: s and o are linear and follow from means over the disc; r' (and the shift) by a scan and
//! then a simplex. The disc is integrated by Gauss–Legendre in t, ρ = w sinh t, w the spot's width,
//! and over the azimuth by midpoints.

use super::sampling::{SAMPLING, SAMPLING_SEED};
use super::simplex;
use super::table::{Sample, Table};
use super::{Choices, Make, Parameter, Recipe, Target, points};
use crate::dataset::{Axis, Spacing};
use crate::quadrature::Rule;
use std::f64::consts::{FRAC_PI_3, PI};

/// The largest estimated error that [`generate`](super::generate) accepts: the fit is of a model to a model.
pub const ALLOWED_ERROR: f64 = 1e-5;
const ROUGHNESS: &str = "roughness";
const ALL: &str = "all";
const DISTANCE: &str = "distance";
const ANGLE: &str = "angle";
/// Sampled instead of roughness = 0, where the lobe is a single direction.
const SMOOTHEST: f64 = 0.001;

pub(super) const TARGET: Target = Target {
    name: "lobe_plane",
    description: "roughness of a perpendicular lobe at distance 1 that looks alike on a plane",
    columns: "roughness, distance or angle → fitted_roughness",
    parameters: &[
        Parameter {
            name: "over",
            description: "what is fitted: a lobe from another distance, or at an angle (rad)",
            default: DISTANCE,
            choices: Choices::OneOf(&[DISTANCE, ANGLE]),
        },
        Parameter {
            name: "reach",
            description: "radius of the disc on the plane that is fitted",
            default: "2",
            choices: Choices::OneOf(&["2", "4"]),
        },
        Parameter {
            name: "outputs",
            description: "the roughness, or all that is fitted: scale and offset, too, or shift",
            default: ROUGHNESS,
            choices: Choices::OneOf(&[ROUGHNESS, ALL]),
        },
        points("64", 1024),
        SAMPLING,
        SAMPLING_SEED,
    ],
    make: Make::Table(table),
};

/// A fitted lobe, and its error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fit {
    /// The fitted roughness, in (0, 1].
    pub roughness: f64,
    /// What the fitted lobe is multiplied by.
    pub scale: f64,
    /// What is added to it.
    pub offset: f64,
    /// Where on the plane it lies: 0 at the foot of the plane's normal, 1 where the other lobe hits;
    /// 1 for perpendicular ones.
    pub shift: f64,
    /// The difference of the roughness from the result of a coarser rule.
    pub error: f64,
}

impl Fit {
    fn of(lines: [Line; 2], shift: f64) -> Fit {
        let [fine, coarse] = lines;
        let Line { roughness, scale, offset, .. } = fine;
        Fit { roughness, scale, offset, shift, error: (roughness - coarse.roughness).abs() }
    }
}

/// A lobe's roughness, and what is left at the best scale and offset.
#[derive(Clone, Copy)]
struct Line {
    roughness: f64,
    scale: f64,
    offset: f64,
    residual: f64,
}

/// Fits a perpendicular lobe of `roughness` in (0, 1] at a `distance` > 0, over the disc of radius
/// `reach`.
pub fn fit_distance(roughness: f64, distance: f64, reach: f64) -> Fit {
    let alpha = roughness * roughness;
    let fit = |points| {
        let drawn = |[x, _]: [f64; 2]| kernel(alpha, (x / distance).powi(2));
        let disc = Disc::new(alpha * distance, reach, [points, 1], drawn);
        let from = disc.best_start(roughness * distance.sqrt());
        let [fitted] = simplex::minimum([from], 0.05, |[fitted]| disc.line(fitted, 0.0).residual);
        disc.line(fitted, 0.0)
    };
    Fit::of([80, 60].map(fit), 1.0)
}

/// Fits a lobe of `roughness` in (0, 1] from height 1 at `angle` in [0, π/2) from the plane's
/// normal, over the disc of radius `reach`.
pub fn fit_angle(roughness: f64, angle: f64, reach: f64) -> Fit {
    let alpha = roughness * roughness;
    let (sin, cos) = angle.sin_cos();
    // The coordinate along the lobe's axis, and the square of that across, from its origin.
    let drawn = |[x, y]: [f64; 2]| {
        let along = 1.0 / cos + x * sin;
        let across_squared = (x * cos).powi(2) + y * y;
        match along > 0.0 {
            true => kernel(alpha, across_squared / (along * along)),
            false => 0.0,
        }
    };
    let fit = |[points, azimuths]: [usize; 2]| {
        let disc = Disc::new(alpha / cos, reach, [points, azimuths], drawn);
        let from = disc.best_start(roughness / cos.powf(0.75));
        let at = |shift: f64| (shift * alpha / cos).clamp(-reach, reach);
        let [fitted, shift] = simplex::minimum([from, 0.0], 0.05, |[fitted, shift]| {
            disc.line(fitted, at(shift)).residual
        });
        (disc.line(fitted, at(shift)), at(shift))
    };
    let [fine, coarse] = [[40, 16], [30, 12]].map(fit);
    // At a right angle there is no line to shift along.
    let shift = if sin > 0.0 { 1.0 + fine.1 * cos / sin } else { 1.0 };
    Fit::of([fine.0, coarse.0], shift)
}

/// A point of the disc, and the lobe's value there.
struct Spot {
    x: f64,
    y_squared: f64,
    area: f64,
    drawn: f64,
}

struct Disc {
    spots: Vec<Spot>,
    area: f64,
    mean: f64,
}

impl Disc {
    /// Places nodes that resolve `width`, along the radius and, by symmetry over half a turn,
    /// around.
    fn new(
        width: f64,
        reach: f64,
        [points, azimuths]: [usize; 2],
        drawn: impl Fn([f64; 2]) -> f64,
    ) -> Disc {
        let end = (reach / width).asinh();
        let radii = Rule::gauss_legendre(points);
        let turns = Rule::midpoint(azimuths);
        let mut spots = Vec::new();
        for radius in radii.points().iter().filter(|p| p.weight > 0.0) {
            let t = 0.5 * end * (1.0 + radius.node);
            let rho = width * t.sinh();
            let ring = 2.0 * PI * rho * width * t.cosh() * 0.5 * end * radius.weight;
            for turn in turns.points().iter().filter(|p| p.weight > 0.0) {
                // One azimuth: all that is drawn is round, and x is ρ.
                let phi = if azimuths == 1 { 0.0 } else { 0.5 * PI * (1.0 + turn.node) };
                let [x, y] = [rho * phi.cos(), rho * phi.sin()];
                let area = ring * 0.5 * turn.weight;
                spots.push(Spot { x, y_squared: y * y, area, drawn: drawn([x, y]) });
            }
        }
        let area = spots.iter().map(|spot| spot.area).sum();
        let mean = spots.iter().map(|spot| spot.area * spot.drawn).sum::<f64>() / area;
        Disc { spots, area, mean }
    }

    /// Fits scale and offset of a lobe with the logarithm of its roughness and its place on the x
    /// axis; the residual is the sum of squares.
    fn line(&self, log_roughness: f64, shift: f64) -> Line {
        let roughness = log_roughness.min(0.0).exp();
        let alpha = roughness * roughness;
        let fitted = |spot: &Spot| kernel(alpha, (spot.x - shift).powi(2) + spot.y_squared);
        let values: Vec<f64> = self.spots.iter().map(fitted).collect();
        let pairs = || self.spots.iter().zip(&values);
        let mean = pairs().map(|(spot, value)| spot.area * value).sum::<f64>() / self.area;
        let [mut covariance, mut variance] = [0.0; 2];
        for (spot, value) in pairs() {
            let from_mean = value - mean;
            covariance += spot.area * from_mean * (spot.drawn - self.mean);
            variance += spot.area * from_mean * from_mean;
        }
        let scale = covariance / variance;
        let residual = |(spot, value): (&Spot, &f64)| {
            let rest = spot.drawn - self.mean - scale * (value - mean);
            spot.area * rest * rest
        };
        let offset = self.mean - scale * mean;
        Line { roughness, scale, offset, residual: pairs().map(residual).sum() }
    }

    /// Returns the logarithm of the best roughness near that of the law, up to 1.
    fn best_start(&self, law: f64) -> f64 {
        let candidate = |k: i32| (law.ln() + 0.1 * f64::from(k)).min(0.0);
        let misfits = (-10..=10).map(|k| (self.line(candidate(k), 0.0).residual, candidate(k)));
        misfits.min_by(|a, b| a.0.total_cmp(&b.0)).map_or(0.0, |best| best.1)
    }
}

/// `K` at ρ² on the plane below.
fn kernel(alpha: f64, rho_squared: f64) -> f64 {
    let cosine = 1.0 / (1.0 + rho_squared).sqrt();
    let cos_half_squared = 0.5 * (1.0 + cosine);
    let sin_half_squared = 0.5 * rho_squared * cosine * cosine / (1.0 + cosine);
    cosine / (cos_half_squared + sin_half_squared / (alpha * alpha)).powi(2)
}

/// Returns the table on roughness in [0, 1], .001 in place of 0, and distance
/// in [1/4, 4], equidistant in its logarithm, or angle in [0, π/3].
fn table(recipe: &Recipe) -> Table {
    let reach = if recipe.get("reach") == Some("4") { 4.0 } else { 2.0 };
    let by_angle = recipe.get("over") == Some(ANGLE);
    let other = match by_angle {
        true => Axis { unit: "rad".into(), domain: [0.0, FRAC_PI_3], ..Axis::unit(ANGLE) },
        false => {
            Axis { domain: [0.25, 4.0], spacing: Spacing::Logarithmic, ..Axis::unit(DISTANCE) }
        }
    };
    let axes = vec![Axis { least: Some(SMOOTHEST), ..Axis::unit("roughness") }, other];
    let fit = move |at: &[f64]| match by_angle {
        true => fit_angle(at[0], at[1], reach),
        false => fit_distance(at[0], at[1], reach),
    };
    match (recipe.get("outputs") == Some(ALL), by_angle) {
        (false, _) => outputs(recipe, axes, const { &[FITTED] }, fit, |fit| [fit.roughness]),
        (true, true) => {
            let columns = const { &[FITTED, ("shift", "1")] };
            outputs(recipe, axes, columns, fit, |fit| [fit.roughness, fit.shift])
        }
        (true, false) => {
            let columns = const { &[FITTED, ("scale", "1"), ("offset", "1")] };
            outputs(recipe, axes, columns, fit, |fit| [fit.roughness, fit.scale, fit.offset])
        }
    }
}

const FITTED: (&str, &str) = ("fitted_roughness", "1");

/// Returns the table of some of what is fitted.
fn outputs<const N: usize>(
    recipe: &Recipe,
    axes: Vec<Axis>,
    columns: &'static [(&'static str, &'static str); N],
    fit: impl Fn(&[f64]) -> Fit + Send + Sync + 'static,
    values: fn(Fit) -> [f64; N],
) -> Table {
    Table::new(recipe, axes, columns, ALLOWED_ERROR, move |at| {
        let fit = fit(at);
        Sample { values: values(fit), error: fit.error }
    })
}
