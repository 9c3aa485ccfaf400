//! Ground truths to search formulas for: what there is, with which
//! parameters, and how to make the datasets.
//!
//! A [`Recipe`] names a target and its parameters; [`generate`] makes the
//! dataset from it.

pub mod area_light;
pub mod area_norm;
pub mod beckmann_g1;
pub mod dfg;
pub mod disney_zh;
mod error;
pub mod fresnel;
pub mod ggx_d;
pub mod hammon;
mod lobe;
pub mod lobe_plane;
mod recipe;
mod sampling;
mod simplex;
pub mod smith_g1;
pub mod smith_g2;
mod table;

pub use error::Error;
pub use recipe::Recipe;

use crate::dataset::Dataset;

/// A ground truth that [`generate`] can make.
#[derive(Debug)]
pub struct Target {
    pub name: &'static str,
    /// One line.
    pub description: &'static str,
    /// Names of the columns, `inputs → outputs`.
    pub columns: &'static str,
    pub parameters: &'static [Parameter],
    generate: fn(&Recipe, Progress) -> Result<Dataset, Error>,
}

/// Called with the work units done so far and their total, from any thread.
pub type Progress<'a> = &'a (dyn Fn(usize, usize) + Sync);

const fn points(default: &'static str, most: usize) -> Parameter {
    Parameter {
        name: "points",
        description: "points along each axis of the search grid",
        default,
        choices: Choices::Count { least: 2, most },
    }
}

/// What may be chosen about a target.
#[derive(Debug)]
pub struct Parameter {
    pub name: &'static str,
    pub description: &'static str,
    pub default: &'static str,
    pub choices: Choices,
}

/// The values a parameter may have.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Choices {
    OneOf(&'static [&'static str]),
    /// A whole number from `least` to `most`.
    Count {
        least: usize,
        most: usize,
    },
}

/// All targets.
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
        disney_zh::TARGET,
        lobe_plane::TARGET,
    ]
}

/// Makes the dataset a recipe describes, on all of rayon's threads, the same
/// at any number of them. It is named after its target; give it another name
/// before saving it under another one.
///
/// # Errors
/// A ground truth whose estimated error is larger than its target allows; a claim that is none.
pub fn generate(recipe: &Recipe, progress: Progress) -> Result<Dataset, Error> {
    let mut dataset = (recipe.target().generate)(recipe, progress)?;
    recipe.claims.iter().try_for_each(|claim| dataset.claim(claim))?;
    Ok(dataset)
}
