//! The reasons why a function cannot be a truth.

use super::MOST_AXES;
use crate::{dataset, program};

/// The reason why a function cannot be a truth.
#[allow(missing_docs, reason = "each message names its fields")]
#[derive(Debug, thiserror::Error)]
pub enum Error {
    #[error(transparent)]
    Formula(#[from] program::ParseError),
    #[error("--domain {0}")]
    Domain(String),
    #[error("the function has no input: nothing is left to approximate")]
    NoInputs,
    #[error("{inputs} inputs; at most {MOST_AXES} can be sampled: fix some of them")]
    TooManyInputs { inputs: usize },
    #[error("{output} is {value} at {point}; choose a --domain where it is finite")]
    NotFinite { output: String, value: f64, point: String },
    #[error("at {point}: {reason}")]
    Evaluation { point: String, reason: String },
    #[error("{points} points for {inputs} inputs; give from 2 to {most} in all")]
    Points { points: usize, inputs: usize, most: usize },
    #[error(transparent)]
    Dataset(#[from] dataset::Error),
}
