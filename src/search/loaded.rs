//! What is read from a run's folder is held to the rules of what is typed: whoever has it can rely on
//! them, wherever the files came from.

use super::island::Island;
use super::{FrontMember, Requirement, Run, Search, Settings};
use crate::archive::Archive;
use crate::dataset::{check_columns, check_name};
use crate::grammar::MAX_INSTRUCTIONS;
use crate::program::Draft;
use std::path::Path;

/// A search's formulas have at most [`MAX_INSTRUCTIONS`]; what is required of outputs and the inverses
/// of transforms add a few.
const MOST_INSTRUCTIONS: usize = 4 * MAX_INSTRUCTIONS;

/// What [`Settings`] may ask for.
pub const MOST_ISLANDS: usize = 256;
pub const MOST_CYCLES: f64 = 1000.0;

impl Run {
    /// Whether a search could have left this: columns as a dataset has them, settings within their
    /// bounds, requirements of columns that there are, finite times.
    ///
    /// # Errors
    /// The first violation found, with the name of its field.
    pub fn check(&self) -> Result<(), String> {
        if self.inputs.is_empty() || self.outputs.is_empty() {
            return Err("`inputs` and `outputs` must name at least one column each".into());
        }
        check_name(&self.name).map_err(|fault| format!("`name` is {:?}: {fault}", self.name))?;
        check_columns(Path::new("columns"), self.inputs.iter().chain(&self.outputs))
            .map_err(|error| error.to_string())?;
        self.settings.check(self.inputs.len(), self.outputs.len())?;
        not_negative("seconds", self.seconds)?;
        let enumerated = self.enumeration.map(|enumeration| enumeration.cost);
        for (name, number) in [
            ("enumeration", enumerated),
            ("exhaustive", self.exhaustive),
            ("budget", self.budget.seconds),
        ] {
            number.map_or(Ok(()), |number| not_negative(name, number))?;
        }
        if let Some(scene) = &self.scene {
            scene.check().map_err(|error| error.to_string())?;
        }
        for source in &self.sources {
            if !source.sources.is_empty() {
                return Err("`sources`: the union of runs lists searches, not unions".into());
            }
            source.check().map_err(|reason| format!("`sources`: {reason}"))?;
            if source.names() != self.names() {
                return Err("`sources`: they have other columns than their union".into());
            }
        }
        Ok(())
    }
}

impl Settings {
    /// Whether a search can be made with these settings for so many inputs and outputs.
    ///
    /// # Errors
    /// The first field that cannot be meant.
    pub fn check(&self, inputs: usize, outputs: usize) -> Result<(), String> {
        within("islands", self.islands, 1, MOST_ISLANDS)?;
        within("candidates", self.candidates, 1, 1_000_000)?;
        within("bucket_size", self.bucket_size, 1, 1000)?;
        within("subset", self.subset, 1, u32::MAX as usize)?;
        if self.migration_interval == 0 {
            return Err("`migration_interval` must be at least 1".into());
        }
        if !(0.0..=MOST_CYCLES).contains(&self.max_cost) {
            let max_cost = self.max_cost;
            return Err(format!("`max_cost` is {max_cost}; it must be 0 to {MOST_CYCLES} cycles"));
        }
        if !(0.0..=1.0).contains(&self.immigrants) {
            return Err(format!("`immigrants` is {}; it must be 0 to 1", self.immigrants));
        }
        if self.transforms.len() > outputs {
            return Err("`transforms` are more than the outputs".into());
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

impl FrontMember {
    /// Whether a search could have left it.
    pub(super) fn check(&self) -> Result<(), String> {
        not_negative("cost", self.cost)?;
        for error in self.score.search.iter().chain(&self.score.validation) {
            not_negative("rmse", error.rmse)?;
            not_negative("max", error.max)?;
        }
        short(&self.program)
    }
}

impl Search {
    /// Whether it could have come about with its settings, for so many inputs and outputs: every
    /// program verified, every place that is indexed there, every number finite.
    pub(super) fn check(&self, inputs: usize, outputs: usize) -> Result<(), String> {
        self.settings.check(inputs, outputs)?;
        if self.islands.len() != self.settings.islands {
            return Err("it has not as many islands as its settings say".into());
        }
        self.archive.check(inputs, outputs)?;
        for (number, island) in self.islands.iter().enumerate() {
            island
                .check(&Island::new(number, &self.settings), inputs, outputs)
                .map_err(|reason| format!("island {number}: {reason}"))?;
        }
        Ok(())
    }
}

impl Archive {
    pub(super) fn check(&self, inputs: usize, outputs: usize) -> Result<(), String> {
        for member in self.members() {
            not_negative("cost", member.cost)?;
            not_negative("loss", member.loss)?;
            check_draft(&member.draft, inputs, outputs)?;
        }
        match self.members().is_sorted_by(|a, b| a.cost <= b.cost) {
            true => Ok(()),
            false => Err("the archive is not by rising cost".into()),
        }
    }
}

/// Whether a draft is a program, short, of so many inputs and outputs.
pub(super) fn check_draft(draft: &Draft, inputs: usize, outputs: usize) -> Result<(), String> {
    draft.check().map_err(|invalid| invalid.to_string())?;
    if (draft.inputs, draft.outputs.len()) != (inputs, outputs) {
        return Err(format!(
            "a program of {} inputs and {} outputs, where there are {inputs} and {outputs}",
            draft.inputs,
            draft.outputs.len()
        ));
    }
    short(draft)
}

fn short(draft: &Draft) -> Result<(), String> {
    match draft.instrs.len() <= MOST_INSTRUCTIONS {
        true => Ok(()),
        false => Err(format!(
            "a formula of {} operations; a search writes at most {MOST_INSTRUCTIONS}",
            draft.instrs.len()
        )),
    }
}

pub(super) fn not_negative(name: &str, number: f64) -> Result<(), String> {
    match number.is_finite() && number >= 0.0 {
        true => Ok(()),
        false => Err(format!("`{name}` is {number}; it must be finite and not negative")),
    }
}

fn within(name: &str, number: usize, least: usize, most: usize) -> Result<(), String> {
    match (least..=most).contains(&number) {
        true => Ok(()),
        false => Err(format!("`{name}` is {number}; it must be {least} to {most}")),
    }
}
