//! A specular lobe integrated over a spherical light, to which the models of Pesce and Iwanicki,
//! "Approximate Models for Physically Based Rendering", 2015, §4 (roughness modification, capped,
//! representative point) are fitted.
//!
//! Definition: v = n = r as for [`super::area_norm`]; the light of unit
//! intensity fills the cone of full angle ω about a direction θ from r, with
//! GGX's α = roughness². `lobe` is the mean over the light, its part below the
//! horizon dark, of D(ψ/2) cos ψ, ψ from r, over the peak D(0) = 1/(π α²). For
//! ω = 0 it is D(θ/2) cos θ / D(0), a point light's highlight.
//!
//! Method: the circle at ψ around r lies in the light for azimuths |φ| < Φ,
//! `cos(ω/2) = cos θ cos ψ + sin θ sin ψ cos Φ`, or without cancellation
//! `sin²(Φ/2) = sin((ω/2 + θ - ψ)/2) sin((ω/2 - θ + ψ)/2) / (sin θ sin ψ)`. An integral over ψ
//! remains: from |θ - ω/2| to θ + ω/2, where it ends like square roots, and over whole circles
//! below ω/2 - θ. The double-exponential rule computes it, beyond the lobe's width in the
//! logarithm of ψ.

use super::lobe::ggx;
use super::sampling::{SAMPLING, SAMPLING_SEED};
use super::table::{Sample, Table};
use super::{Make, Recipe, Target, points};
use crate::dataset::Axis;
use crate::quadrature::{Estimate, TanhSinh};
use std::f64::consts::{FRAC_PI_2, PI};

/// The largest estimated error that [`generate`](super::generate) accepts: below the rounding to f32.
pub const ALLOWED_ERROR: f64 = 1e-8;
/// A thousandth of it, for each of the integrals that are added.
const TOLERANCE: f64 = 1e-11;
/// Sampled instead of roughness = 0, where the lobe is a single direction.
const SMOOTHEST: f64 = 0.001;

pub(super) const TARGET: Target = Target {
    name: "area_light",
    description: "GGX lobe integrated over a spherical light, over its peak, v = n = r",
    columns: "omega (full cone angle), roughness, theta (light from r) → lobe",
    parameters: &[points("16", 64), SAMPLING, SAMPLING_SEED],
    make: Make::Table(table),
};

/// Computes `lobe` at `omega` in [0, π), `alpha` in (0, 1] and `theta` in [0, π/2], radians. Make
/// `rule` once for many points.
pub fn integrate(rule: &TanhSinh, omega: f64, alpha: f64, theta: f64) -> Estimate {
    let radiance = |psi: f64| ggx(0.5 * psi, alpha) * psi.cos();
    let radius = 0.5 * omega;
    if radius == 0.0 {
        return Estimate { value: radiance(theta), error: 0.0, evaluations: 1 };
    }
    let solid_angle = 4.0 * PI * (0.5 * radius).sin().powi(2);
    let inner = (theta - radius).abs();
    let outer = theta + radius;
    let ring = |psi: f64, azimuth: f64| 2.0 * azimuth * radiance(psi) * psi.sin() / solid_angle;
    let arc = |inner, outer, width| Arc { inner, outer, width, split: 2.0 * alpha };
    if theta == 0.0 {
        return arc(0.0, radius, radius).integrate(rule, |at| ring(at.psi, PI));
    }
    let inside = (radius - theta).max(0.0);
    let whole = arc(0.0, inside, inside).integrate(rule, |at| ring(at.psi, PI));
    let from_far_side = 2.0 * inside;
    let cut = arc(inner, outer, 2.0 * radius.min(theta)).integrate(rule, |at| {
        let excess = (0.5 * at.to_outer).sin() * (0.5 * (from_far_side + at.from_inner)).sin();
        let sine_squared = (excess / (theta.sin() * at.psi.sin())).clamp(0.0, 1.0);
        ring(at.psi, 2.0 * sine_squared.sqrt().asin())
    });
    Estimate {
        value: whole.value + cut.value,
        error: whole.error + cut.error,
        evaluations: whole.evaluations + cut.evaluations,
    }
}

/// A range of angles ψ, cut off at the horizon.
struct Arc {
    inner: f64,
    outer: f64,
    /// `outer - inner`, which the difference would round away for a small light far from r.
    width: f64,
    /// The angle from which on it is integrated in the logarithm.
    split: f64,
}

/// An angle, and its distances from both ends, which lose no digits.
struct At {
    psi: f64,
    from_inner: f64,
    to_outer: f64,
}

impl Arc {
    fn integrate(&self, rule: &TanhSinh, f: impl Fn(At) -> f64) -> Estimate {
        let &Arc { inner, outer, width, split } = self;
        let end = outer.min(FRAC_PI_2);
        let below_horizon = outer - end;
        let start = inner.max(split);
        if end <= 2.0 * start {
            return rule.integrate(0.0, width - below_horizon, TOLERANCE, |at| {
                let to_outer = below_horizon + at.from_b;
                f(At { psi: inner + at.from_a, from_inner: at.from_a, to_outer })
            });
        }
        let near = rule.integrate(inner, start, TOLERANCE, |at| {
            f(At { psi: at.x, from_inner: at.from_a, to_outer: (outer - start) + at.from_b })
        });
        let far = rule.integrate(0.0, (end / start).ln(), TOLERANCE, |at| {
            let psi = start * at.x.exp();
            let from_inner = (start - inner) + start * at.x.exp_m1();
            let to_outer = below_horizon - end * (-at.from_b).exp_m1();
            psi * f(At { psi, from_inner, to_outer })
        });
        Estimate {
            value: near.value + far.value,
            error: near.error + far.error,
            evaluations: near.evaluations + far.evaluations,
        }
    }
}

/// Returns the table on ω in [0, 1] rad, roughness in [0, 1] and θ in
/// [0, π/2], with roughness = .001 in place of 0.
fn table(recipe: &Recipe) -> Table {
    let rule = TanhSinh::new();
    Table::new(
        recipe,
        vec![
            Axis { unit: "rad".into(), ..Axis::unit("omega") },
            Axis { least: Some(SMOOTHEST), ..Axis::unit("roughness") },
            Axis { unit: "rad".into(), domain: [0.0, FRAC_PI_2], ..Axis::unit("theta") },
        ],
        &[("lobe", "1")],
        ALLOWED_ERROR,
        move |at| {
            let lobe = integrate(&rule, at[0], at[1] * at[1], at[2].min(FRAC_PI_2));
            Sample { values: [lobe.value], error: lobe.error }
        },
    )
}
