//! Ground truths to search formulas for: the targets, their parameters, and the generators of their
//! datasets.
//!
//! A [`Recipe`] names a target and its parameters; [`generate`] makes the dataset from it.
//!
//! ```
//! use lgp::targets::{Recipe, generate};
//!
//! let recipe = Recipe::parse("(target: \"smith_g1\", points: 8)")?;
//! let data = generate(&recipe, &|_, _| ())?;
//! assert_eq!((data.inputs.len(), data.search.rows()), (2, 8 * 8));
//! # Ok::<(), lgp::targets::Error>(())
//! ```

pub mod area_light;
pub mod area_norm;
pub mod average_albedo;
pub mod average_fresnel;
pub mod beckmann_g1;
pub mod blackbody;
pub mod coat_albedo;
pub mod conductor;
pub mod dfg;
pub mod dielectric_albedo;
pub mod disney_zh;
mod error;
mod fibres;
pub mod fresnel;
pub mod ggx_d;
pub mod ggx_lobes;
pub mod ggx_response;
pub mod hammon;
mod lobe;
pub mod lobe_plane;
pub mod ltc_ggx;
pub mod ltc_sheen;
mod normals;
mod recipe;
mod sampling;
pub mod sheen_albedo;
pub mod sheen_volume_albedo;
mod simplex;
pub mod smith_g1;
pub mod smith_g2;
pub mod sphere_light;
mod table;
pub mod tone_curve;

pub use error::Error;
pub use recipe::Recipe;

use crate::dataset::Dataset;
use crate::truth::{Progress, Truth};
use table::Table;

/// A ground truth that [`generate`] can make.
#[derive(Debug)]
pub struct Target {
    /// The name in recipes, an identifier.
    pub name: &'static str,
    /// A description of one line.
    pub description: &'static str,
    /// The names of the columns, `inputs → outputs`.
    pub columns: &'static str,
    /// The parameters that a recipe may set.
    pub parameters: &'static [Parameter],
    make: Make,
}

/// The way to a target's data.
#[derive(Clone, Copy, Debug)]
enum Make {
    /// A function that can be evaluated anywhere in its domain.
    Table(fn(&Recipe) -> Table),
    /// Rows that are not spread evenly over the domain of their inputs.
    Rows(fn(&Recipe, Progress) -> Result<Dataset, Error>),
}

const fn points(default: &'static str, most: usize) -> Parameter {
    Parameter {
        name: "points",
        description: "points along each axis of the search grid",
        default,
        choices: Choices::Count { least: 2, most },
    }
}

/// A parameter of a target.
#[derive(Debug)]
pub struct Parameter {
    /// The name in recipes, an identifier.
    pub name: &'static str,
    /// A description of one line.
    pub description: &'static str,
    /// The value if a recipe sets none.
    pub default: &'static str,
    /// The values that it may have.
    pub choices: Choices,
}

/// The values that a parameter may have.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Choices {
    /// One of these words.
    OneOf(&'static [&'static str]),
    /// A whole number.
    Count {
        /// The least.
        least: usize,
        /// The largest.
        most: usize,
    },
}

/// Returns all targets.
pub fn targets() -> &'static [Target] {
    &[
        dfg::TARGET,
        smith_g1::TARGET,
        smith_g2::TARGET,
        beckmann_g1::TARGET,
        fresnel::TARGET,
        ggx_d::TARGET,
        hammon::TARGET,
        area_norm::TARGET,
        area_light::TARGET,
        sphere_light::TARGET,
        disney_zh::TARGET,
        lobe_plane::TARGET,
        dielectric_albedo::TARGET,
        conductor::TARGET,
        blackbody::TARGET,
        tone_curve::TARGET,
        ggx_lobes::TARGET,
        ggx_response::TARGET,
        coat_albedo::TARGET,
        sheen_albedo::TARGET,
        sheen_volume_albedo::TARGET,
        average_albedo::TARGET,
        average_fresnel::TARGET,
        ltc_ggx::TARGET,
        ltc_sheen::TARGET,
    ]
}

/// Makes the dataset that a recipe describes, on all of rayon's threads; their number does not
/// change it. It is named after its target: rename it before saving it under another name.
///
/// # Errors
/// A ground truth whose estimated error is larger than its target allows; a text that is not a
/// claim.
pub fn generate(recipe: &Recipe, progress: Progress) -> Result<Dataset, Error> {
    let mut dataset = match recipe.target().make {
        Make::Table(table) => table(recipe).dataset(progress)?,
        Make::Rows(generate) => generate(recipe, progress)?,
    };
    recipe.claims.iter().try_for_each(|claim| dataset.claim(claim))?;
    Ok(dataset)
}

/// Returns the function that a recipe's dataset samples; none if its rows are not spread evenly over
/// the domain.
pub fn truth(recipe: &Recipe) -> Option<Truth> {
    match recipe.target().make {
        Make::Table(table) => table(recipe).truth().ok(),
        Make::Rows(_) => None,
    }
}
