//! The parameters of targets that say where the search split is sampled ([`Sampling`]).

use super::{Choices, Parameter, Recipe};
use crate::truth::Sampling;

const REGULAR: &str = "regular";
const JITTERED: &str = "jittered";
const LOW_DISCREPANCY: &str = "low_discrepancy";
const ADAPTIVE: &str = "adaptive";

pub(super) const SAMPLING: Parameter = Parameter {
    name: "sampling",
    description: "where the search split samples; adaptive: where the gradient is large, weighted",
    default: REGULAR,
    choices: Choices::OneOf(&[REGULAR, JITTERED, LOW_DISCREPANCY, ADAPTIVE]),
};

pub(super) const SAMPLING_SEED: Parameter = Parameter {
    name: "sampling_seed",
    description: "seed of random samples (jittered, adaptive)",
    default: "0",
    choices: Choices::Count { least: 0, most: u32::MAX as usize },
};

/// Returns the recipe's sampling; regular if the target has no such parameter.
pub(super) fn sampling_of(recipe: &Recipe) -> Sampling {
    match recipe.get(SAMPLING.name) {
        Some(JITTERED) => Sampling::Jittered,
        Some(LOW_DISCREPANCY) => Sampling::LowDiscrepancy,
        Some(ADAPTIVE) => Sampling::Adaptive,
        _ => Sampling::Regular,
    }
}
