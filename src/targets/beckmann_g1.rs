//! Smith's masking of Beckmann facets, whose error function Walter replaces by a
//! rational one.
//!
//! Definition: [`beckmann::g1_of_slope`] over `a = 1 / (α tan θ)`, the variable of
//! Walter et al. ("Microfacet Models for Refraction through Rough Surfaces", 2007,
//! eqs. 26 and 27), up to 1.6, from where on the approximation is 1.

use super::sampling::{SAMPLING, SAMPLING_SEED};
use super::table::{Sample, Table};
use super::{Make, Recipe, Target, points};
use crate::dataset::Axis;
use crate::microfacet::beckmann;

/// The error of Λ for slopes up to 1.6, by the tests of [`beckmann`].
const ERROR: f64 = 1e-12;

pub(super) const TARGET: Target = Target {
    name: "beckmann_g1",
    description: "Smith masking of Beckmann facets, exact, over a = 1 / (alpha tan(theta))",
    columns: "a → g1",
    parameters: &[points("256", 4096), SAMPLING, SAMPLING_SEED],
    make: Make::Table(table),
};

/// Returns the table on a in [0, 1.6].
fn table(recipe: &Recipe) -> Table {
    Table::new(
        recipe,
        vec![Axis { domain: [0.0, 1.6], ..Axis::unit("a") }],
        &[("g1", "1")],
        ERROR,
        |at| Sample { values: [beckmann::g1_of_slope(at[0])], error: ERROR },
    )
}
