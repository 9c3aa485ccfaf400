//! The normalisation of the representative point of a spherical light.
//!
//! A light whose cone of directions has the full angle ω is replaced by one of its points, nearer
//! to the reflected direction r. This keeps the highlight's shape and makes it too bright; the
//! normalisation restores its energy (Karis, "Real Shading in Unreal Engine 4", 2013; Pesce and
//! Iwanicki, "Approximate Models for Physically Based Rendering", 2015, §4).
//!
//! Definition: v = n = r, light in direction θ from r, R = tan(ω/2),
//! q = R / sin θ. The point moves the fraction f towards r: f = min(1, q) in
//! Karis' hard form, and in the paper's the soft minimum of eq. 1 with s = -3,
//! f = (1 + q⁻³)^(-1/3). Then θ' = atan2(sin θ (1 - f), cos θ) and
//! `norm = ∫ D(θ/2) cos θ dΩ / ∫ D(θ'/2) cos θ dΩ` over the hemisphere, D being
//! GGX. It is 1 for ω = 0, falls with ω, and tends to 0 like α^1.5 (hard: α²).
//!
//! The paper fits `1/(a + b tan(ω/2)/α^c)`, prints a = .962406, b = .375892 and
//! c = .962406, the value of a again: a misprint. Least squares on norm over
//! α = (i + .5)/16, i = 0…15, and ω = .025 k, k = 1…30, give a = .9610,
//! b = .3755, c = 1.484.

use super::lobe::{ggx, integrate_angle};
use super::sampling::{SAMPLING, SAMPLING_SEED};
use super::table::{Sample, Table};
use super::{Choices, Make, Parameter, Recipe, Target, points};
use crate::dataset::Axis;
use crate::quadrature::TanhSinh;

/// The largest estimated error that [`generate`](super::generate) accepts: below the rounding to f32.
pub const ALLOWED_ERROR: f64 = 1e-8;
const SMOOTHED: &str = "smoothed";
const HARD: &str = "hard";
const OMEGA: &str = "omega";
const TAN_HALF_OMEGA: &str = "tan_half_omega";
/// Sampled instead of alpha = 0, where norm is 0 except at ω = 0.
const NARROWEST: f64 = 0.001;

pub(super) const TARGET: Target = Target {
    name: "area_norm",
    description: "normalisation of the representative point of a spherical light, v = n = r",
    columns: "omega (full cone angle), alpha → norm",
    parameters: &[
        Parameter {
            name: "point",
            description: "representative point: smoothed (2015 paper) or hard (Karis 2013)",
            default: SMOOTHED,
            choices: Choices::OneOf(&[SMOOTHED, HARD]),
        },
        Parameter {
            name: "size",
            description: "the light's size: angle, or tan(omega/2) = radius / distance",
            default: OMEGA,
            choices: Choices::OneOf(&[OMEGA, TAN_HALF_OMEGA]),
        },
        points("64", 1024),
        SAMPLING,
        SAMPLING_SEED,
    ],
    make: Make::Table(table),
};

/// The point of the light that stands for it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RepresentativePoint {
    /// By the soft minimum of the 2015 paper.
    Smoothed,
    /// By the minimum, as Karis has it.
    Hard,
}

impl RepresentativePoint {
    /// Returns 1 - f, the rest of the way to r, for q = R / sin θ.
    fn rest(self, q: f64) -> f64 {
        match self {
            RepresentativePoint::Smoothed => -(-q.powi(-3).ln_1p() / 3.0).exp_m1().min(0.0),
            RepresentativePoint::Hard => (1.0 - q).max(0.0),
        }
    }
}

/// A normalisation, and its error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Norm {
    /// The normalisation, dimensionless.
    pub value: f64,
    /// An estimate of its absolute error.
    pub error: f64,
}

/// Computes the normalisation at R = `tan_half_omega` ≥ 0 and `alpha` in (0, 1]. Make `rule` once
/// for many points.
pub fn integrate(
    rule: &TanhSinh,
    tan_half_omega: f64,
    alpha: f64,
    point: RepresentativePoint,
) -> Norm {
    let lobe = |theta: f64, seen: f64| ggx(0.5 * seen, alpha) * theta.cos() * theta.sin();
    let one_point = integrate_angle(rule, &[2.0 * alpha], |theta| lobe(theta, theta));
    let edge = tan_half_omega.min(1.0).asin();
    // Where the highlight's plateau ends: θ' = 2α, θ' being about θ⁴/(3 R³).
    let plateau = (6.0 * alpha * tan_half_omega.powi(3)).powf(0.25);
    let scales = [2.0 * alpha, edge, plateau, edge + 2.0 * alpha];
    let moved = integrate_angle(rule, &scales, |theta| {
        let (sin, cos) = theta.sin_cos();
        let rest = point.rest(tan_half_omega / sin);
        lobe(theta, (sin * rest).atan2(cos))
    });
    let value = one_point.value / moved.value;
    Norm { value, error: (one_point.error + value * moved.error) / moved.value }
}

/// Returns the table on ω in [0, 1] rad or R in [0, 0.5], and alpha in [0, 1],
/// with alpha = .001 in place of 0.
fn table(recipe: &Recipe) -> Table {
    let rule = TanhSinh::new();
    let point = match recipe.get("point") {
        Some(HARD) => RepresentativePoint::Hard,
        _ => RepresentativePoint::Smoothed,
    };
    let by_tangent = recipe.get("size") == Some(TAN_HALF_OMEGA);
    let size = match by_tangent {
        true => Axis { domain: [0.0, 0.5], ..Axis::unit(TAN_HALF_OMEGA) },
        false => Axis { unit: "rad".into(), ..Axis::unit(OMEGA) },
    };
    Table::new(
        recipe,
        vec![size, Axis { least: Some(NARROWEST), ..Axis::unit("alpha") }],
        &[("norm", "1")],
        ALLOWED_ERROR,
        move |at| {
            let tan_half_omega = if by_tangent { at[0] } else { (0.5 * at[0]).tan() };
            let norm = integrate(&rule, tan_half_omega, at[1], point);
            Sample { values: [norm.value], error: norm.error }
        },
    )
}
