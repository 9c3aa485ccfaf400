//! Unpolarised reflectance of dielectrics, which shaders approximate by Schlick's
//! polynomial.
//!
//! Definition: [`fresnel::cook_torrance`] ("A Reflectance Model for Computer
//! Graphics", 1982, eq. 18), over the reflectance at normal incidence from that
//! of water (η = 1.33) to above that of diamond (η = 2.42).

use super::sampling::{SAMPLING, SAMPLING_SEED};
use super::table::{Sample, Table};
use super::{Error, Progress, Recipe, Target, points};
use crate::dataset::{Axis, Dataset};
use crate::microfacet::fresnel;

/// The rounding of a few operations.
const ERROR: f64 = 1e-14;

pub(super) const TARGET: Target = Target {
    name: "fresnel",
    description: "Fresnel reflectance of dielectrics, exact, unpolarised",
    columns: "v_dot_h, f0 → reflectance",
    parameters: &[points("64", 1024), SAMPLING, SAMPLING_SEED],
    generate,
};

/// Makes the dataset on v·h in [0, 1] and f0 in [.02, .18].
///
/// # Errors
/// None that a recipe can cause.
pub fn generate(recipe: &Recipe, progress: Progress) -> Result<Dataset, Error> {
    let table = Table {
        recipe,
        axes: &[Axis::unit("v_dot_h"), Axis { domain: [0.02, 0.18], ..Axis::unit("f0") }],
        outputs: &[("reflectance", "1")],
        points: recipe.count("points"),
        allowed_error: ERROR,
    };
    table.dataset(progress, |at| Sample {
        values: [fresnel::cook_torrance(at[1], at[0])],
        error: ERROR,
    })
}
