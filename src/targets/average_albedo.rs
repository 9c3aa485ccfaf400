//! The average albedo of GGX facets that reflect all light: `2 ∫ E(μ) μ dμ`, the share that a rough
//! metal reflects in one scattering of light from everywhere. Energy compensation divides by what
//! is missing to 1 (Kulla and Conty, "Revisiting Physically Based Shading at Imageworks", 2017).
//!
//! Definition: E is the directional albedo with a reflectance of 1, `scale + bias` of
//! [`dfg`](super::dfg), alpha = roughness².
//!
//! Method: G2 depends on the two cosines alone, and the integral of D over the azimuth between v
//! and l is elementary, since `2 + 2 v·l`, by which `n·h² = (n·v + n·l)² / (2 + 2 v·l)` is divided,
//! is linear in its cosine. Two angles are left, `∫∫ ½ G2 ∫D dφ`; by symmetry θl < θv, so that the
//! ridge of a narrow lobe, θl = θv, lies at the end of the inner double-exponential rule.

use super::dfg::Masking;
use super::sampling::{SAMPLING, SAMPLING_SEED};
use super::table::{Sample, Table};
use super::{Choices, Make, Parameter, Recipe, Target, points};
use crate::dataset::Axis;
use crate::microfacet::ggx;
use crate::quadrature::TanhSinh;
use std::f64::consts::FRAC_PI_2;

/// The largest estimated error that [`generate`](super::generate) accepts: about the rounding to
/// f32.
pub const ALLOWED_ERROR: f64 = 1e-7;
/// A hundredth of it, for each integral: the errors of nested integrals add up.
const TOLERANCE: f64 = 1e-9;
const CORRELATED: &str = "correlated";
const SEPARABLE: &str = "separable";

pub(super) const TARGET: Target = Target {
    name: "average_albedo",
    description: "average albedo of GGX specular with a reflectance of 1",
    columns: "roughness → average",
    parameters: &[
        Parameter {
            name: "masking",
            description: "Smith's G2: height-correlated (engines today) or separable (older)",
            default: CORRELATED,
            choices: Choices::OneOf(&[CORRELATED, SEPARABLE]),
        },
        points("256", 1024),
        SAMPLING,
        SAMPLING_SEED,
    ],
    make: Make::Table(table),
};

/// Computes the average albedo at `alpha` in [0, 1], to about 1e-9, and an estimate of its absolute
/// error; at alpha = 0, its limit. Make `rule` once for many points.
pub fn integrate(rule: &TanhSinh, alpha: f64, masking: Masking) -> [f64; 2] {
    if alpha == 0.0 {
        return [1.0, 0.0];
    }
    let [average, inner] = rule.integrate_all(0.0, FRAC_PI_2, TOLERANCE, |theta_v| {
        let (sine, cosine) = (theta_v.x.sin(), theta_v.from_b.sin());
        let share = rule.integrate(0.0, theta_v.x, TOLERANCE, |theta_l| {
            let (sin_l, n_dot_l) = theta_l.x.sin_cos();
            let g2 = match masking {
                Masking::Correlated => ggx::g2_correlated(cosine, n_dot_l, alpha),
                Masking::Separable => ggx::g2_separable(cosine, n_dot_l, alpha),
                Masking::Schlick => ggx::g2_schlick(cosine, n_dot_l, alpha),
            };
            let angles = [0.5 * theta_l.from_b, 0.5 * (theta_l.x + theta_v.x)];
            density_over_azimuth(angles, alpha) * g2 * sin_l
        });
        [share.value * sine, share.error * sine]
    });
    [average.value, average.error + inner.value]
}

/// D of the half vector integrated over the azimuth between v and l, by half the difference and
/// half the sum of their angles from n.
fn density_over_azimuth(angles: [f64; 2], alpha: f64) -> f64 {
    // D = α²/π (p / (p - (1 - α²) q))² with p = 2 + 2 v·l and q = (n·v + n·l)²; the denominator is
    // between 4 cos² down across and 4 cos² across down, which do not cancel.
    let narrow = (1.0 - alpha) * (1.0 + alpha);
    let terms = angles.map(|angle| {
        let (sine, cosine) = angle.sin_cos();
        (cosine, sine * sine + (alpha * cosine).powi(2))
    });
    let [(near, across), (far, along)] = terms;
    let product = across * along;
    let lifted = narrow * near * far / product.sqrt();
    let slope = narrow * (far * far * across + near * near * along) / product;
    2.0 * alpha * alpha * (1.0 + lifted * (2.0 + 0.5 * slope))
}

/// Returns the table on [0, 1].
fn table(recipe: &Recipe) -> Table {
    let rule = TanhSinh::new();
    let masking = match recipe.get("masking") {
        Some(SEPARABLE) => Masking::Separable,
        _ => Masking::Correlated,
    };
    let axes = vec![Axis::unit("roughness")];
    let table = Table::new(recipe, axes, &[("average", "1")], ALLOWED_ERROR, move |at| {
        let [average, error] = integrate(&rule, at[0] * at[0], masking);
        Sample { values: [average], error }
    });
    table.claiming(ENERGY)
}

/// No more light leaves than arrives.
const ENERGY: &str = "energy: average <= 1";
