//! Smith's masking and shadowing of GGX facets, which shaders approximate by the
//! product of two Schlick forms or, correlated, by Hammon's linear interpolation.
//!
//! Definition: [`ggx::g2_correlated`] and [`ggx::g2_separable`] (Heitz, 2014, eqs.
//! 98 and 99), over the width itself.

use super::sampling::{SAMPLING, SAMPLING_SEED};
use super::table::{Sample, Table};
use super::{Choices, Make, Parameter, Recipe, Target, points};
use crate::dataset::Axis;
use crate::microfacet::ggx;

/// Sampled instead of a cosine of 0, where g2 is 0 for all α but 0.
const GRAZING: f64 = 0.001;
const CORRELATED: &str = "correlated";
const SEPARABLE: &str = "separable";

pub(super) const TARGET: Target = Target {
    name: "smith_g2",
    description: "Smith masking and shadowing of GGX facets, exact",
    columns: "n_dot_l, n_dot_v, alpha → g2",
    parameters: &[
        Parameter {
            name: "masking",
            description: "height-correlated or separable",
            default: CORRELATED,
            choices: Choices::OneOf(&[CORRELATED, SEPARABLE]),
        },
        points("16", 64),
        SAMPLING,
        SAMPLING_SEED,
    ],
    make: Make::Table(table),
};

/// Returns the table on [0, 1]³, with cosines of .001 in place of 0.
fn table(recipe: &Recipe) -> Table {
    let g2 = match recipe.get("masking") {
        Some(SEPARABLE) => ggx::g2_separable,
        _ => ggx::g2_correlated,
    };
    let cosine = |name| Axis { least: Some(GRAZING), ..Axis::unit(name) };
    Table::new(
        recipe,
        vec![cosine("n_dot_l"), cosine("n_dot_v"), Axis::unit("alpha")],
        &[("g2", "1")],
        f64::EPSILON,
        move |at| Sample { values: [g2(at[0], at[1], at[2])], error: f64::EPSILON },
    )
}
