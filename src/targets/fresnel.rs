//! Unpolarised reflectance of dielectrics, which shaders approximate by Schlick's
//! polynomial.
//!
//! Definition: [`fresnel::cook_torrance`] ("A Reflectance Model for Computer
//! Graphics", 1982, eq. 18), over the reflectance at normal incidence from that
//! of water (η = 1.33) to above that of diamond (η = 2.42).

use super::sampling::{SAMPLING, SAMPLING_SEED};
use super::table::{Sample, Table};
use super::{Make, Recipe, Target, points};
use crate::dataset::Axis;
use crate::microfacet::fresnel;

/// The rounding of a few operations.
const ERROR: f64 = 1e-14;

pub(super) const TARGET: Target = Target {
    name: "fresnel",
    description: "Fresnel reflectance of dielectrics, exact, unpolarised",
    columns: "v_dot_h, f0 → reflectance",
    parameters: &[points("64", 1024), SAMPLING, SAMPLING_SEED],
    make: Make::Table(table),
};

/// Returns the table on v·h in [0, 1] and f0 in [.02, .18].
fn table(recipe: &Recipe) -> Table {
    Table::new(
        recipe,
        vec![Axis::unit("v_dot_h"), Axis { domain: [0.02, 0.18], ..Axis::unit("f0") }],
        &[("reflectance", "1")],
        ERROR,
        |at| Sample { values: [fresnel::cook_torrance(at[1], at[0])], error: ERROR },
    )
}
