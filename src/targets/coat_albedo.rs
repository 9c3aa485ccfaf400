//! The directional albedo of a clear coat: the share of the light that it reflects, and that the
//! layer below does not get.
//!
//! Definition: as [`dfg`](super::dfg), correlated Smith masking and alpha = roughness², with the
//! exact reflectance of an index of 1.5 (4 % at normal incidence: glTF's KHR_materials_clearcoat)
//! in place of Schlick's. Light scatters once.

use super::dfg::{Masking, reflected};
use super::sampling::{SAMPLING, SAMPLING_SEED};
use super::table::{Sample, Table};
use super::{Make, Recipe, Target, points};
use crate::dataset::Axis;
use crate::microfacet::fresnel;
use crate::quadrature::TanhSinh;

/// The largest estimated error that [`generate`](super::generate) accepts: about the rounding to
/// f32.
pub const ALLOWED_ERROR: f64 = 1e-7;
/// A tenth of it, for each integral: the errors of nested integrals add up.
const TOLERANCE: f64 = 1e-8;
/// That of polyurethane, which glTF's coat has.
const INDEX: f64 = 1.5;
/// Sampled instead of n·v = 0, where W is undefined.
const GRAZING: f64 = 0.001;

pub(super) const TARGET: Target = Target {
    name: "coat_albedo",
    description: "directional albedo of a clear coat of index 1.5, rough by GGX",
    columns: "roughness, n_dot_v → albedo",
    parameters: &[points("64", 1024), SAMPLING, SAMPLING_SEED],
    make: Make::Table(table),
};

/// Computes the albedo at `alpha` in [0, 1] and `n_dot_v` in (0, 1], to about 1e-8, and an estimate
/// of its absolute error; at alpha = 0, the reflectance. Make `rule` once for many points.
pub fn integrate(rule: &TanhSinh, alpha: f64, n_dot_v: f64) -> [f64; 2] {
    if alpha == 0.0 {
        return [fresnel::dielectric(INDEX, n_dot_v), 0.0];
    }
    let shares = |v_dot_h| [fresnel::dielectric(INDEX, v_dot_h), 0.0];
    let ([albedo, _, error], _) =
        reflected(rule, TOLERANCE, n_dot_v, alpha, Masking::Correlated, &shares);
    [albedo, error]
}

/// Returns the table on [0, 1]², with n·v = .001 in place of 0.
fn table(recipe: &Recipe) -> Table {
    let rule = TanhSinh::new();
    let axes =
        vec![Axis::unit("roughness"), Axis { least: Some(GRAZING), ..Axis::unit("n_dot_v") }];
    let table = Table::new(recipe, axes, &[("albedo", "1")], ALLOWED_ERROR, move |at| {
        let [albedo, error] = integrate(&rule, at[0] * at[0], at[1]);
        Sample { values: [albedo], error }
    });
    table.claiming(ENERGY)
}

/// No more light leaves than arrives.
const ENERGY: &str = "energy: albedo <= 1";
