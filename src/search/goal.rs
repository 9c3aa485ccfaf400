//! What is asked of formulas: which error is made small, what every formula must be, what it may cost.

use super::{Requirement, Transform};
use crate::fit::Measure;
use serde::{Deserialize, Serialize};

/// The most cycles that [`Goal::max_cost`] may be.
pub const MOST_CYCLES: f64 = 1000.0;

/// What is asked of formulas.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Goal {
    /// What is made small.
    pub measure: Measure,
    /// What every formula must be.
    pub requirements: Vec<Requirement>,
    /// By output: the function of it that is searched for; where there are fewer, the output itself.
    pub transforms: Vec<Option<Transform>>,
    /// Cycles that a formula may cost at most.
    pub max_cost: f64,
}

impl Default for Goal {
    /// The least RMSE at up to 40 cycles.
    fn default() -> Goal {
        Goal {
            measure: Measure::Rmse,
            requirements: Vec::new(),
            transforms: Vec::new(),
            max_cost: 40.0,
        }
    }
}

impl Goal {
    /// Whether this can be asked of formulas of so many inputs and outputs.
    ///
    /// # Errors
    /// The first field that cannot be meant.
    pub fn check(&self, inputs: usize, outputs: usize) -> Result<(), String> {
        if !(0.0..=MOST_CYCLES).contains(&self.max_cost) {
            let max_cost = self.max_cost;
            return Err(format!("`max_cost` is {max_cost}; it must be 0 to {MOST_CYCLES} cycles"));
        }
        if self.transforms.len() > outputs {
            return Err("`transforms` are more than the outputs".into());
        }
        let ends = self.requirements.iter().any(|one| matches!(one, Requirement::Ends { .. }));
        if ends && self.measure == Measure::Relative {
            let reason = "`requirements`: ends=… goes with rmse, max or weighted, not relative";
            return Err(reason.into());
        }
        self.requirements.iter().try_for_each(|one| one.check(inputs, outputs))
    }
}

impl Requirement {
    fn check(&self, inputs: usize, outputs: usize) -> Result<(), String> {
        let exists = |what: &str, index: u16, count: usize| match usize::from(index) < count {
            true => Ok(()),
            false => Err(format!("`requirements` name {what} {index}, but there are {count}")),
        };
        let of = |output: Option<u16>| output.map_or(Ok(()), |o| exists("output", o, outputs));
        match *self {
            Requirement::Range { output, low, high } => match low < high {
                true => of(output),
                false => Err(format!("`requirements`: {low}..{high} is no range")),
            },
            Requirement::Monotone { output, input, .. } | Requirement::Ends { output, input } => {
                of(output)?;
                exists("input", input, inputs)
            }
            Requirement::Input(input) => exists("input", input, inputs),
            Requirement::Half { error } if error.is_nan() || error <= 0.0 => {
                Err(format!("`requirements`: {error} is no error of halves"))
            }
            Requirement::Half { .. } | Requirement::Operation(_) | Requirement::Finite => Ok(()),
        }
    }
}
