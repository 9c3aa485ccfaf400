//! Smith's masking of GGX facets, which shaders approximate by Schlick's form
//! (Karis, "Real Shading in Unreal Engine 4", 2013) to save the root.
//!
//! Definition: [`ggx::g1`] (Walter et al. 2007, eq. 34), over the width itself.

use super::sampling::{SAMPLING, SAMPLING_SEED};
use super::table::{Sample, Table};
use super::{Make, Recipe, Target, points};
use crate::dataset::Axis;
use crate::microfacet::ggx;

/// Sampled instead of n·v = 0, where g1 is 0 for all α but 0.
const GRAZING: f64 = 0.001;

pub(super) const TARGET: Target = Target {
    name: "smith_g1",
    description: "Smith masking of GGX facets, exact",
    columns: "n_dot_v, alpha → g1",
    parameters: &[points("64", 1024), SAMPLING, SAMPLING_SEED],
    make: Make::Table(table),
};

/// Returns the table on [0, 1]², with n·v = .001 in place of 0.
fn table(recipe: &Recipe) -> Table {
    Table::new(
        recipe,
        vec![Axis { least: Some(GRAZING), ..Axis::unit("n_dot_v") }, Axis::unit("alpha")],
        &[("g1", "1")],
        f64::EPSILON,
        |at| Sample { values: [ggx::g1(at[0], at[1])], error: f64::EPSILON },
    )
}
