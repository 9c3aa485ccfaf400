//! Checks of states and fronts read from files, which must obey the same rules as those made here,
//! so that all other code can rely on them.

use super::island::Island;
use super::{FrontMember, Goal, Method, State};
use crate::archive::Archive;
use crate::grammar::MAX_INSTRUCTIONS;
use crate::program::Draft;
use crate::truth::DomainError;

/// The most instructions of a finished formula: a search's has at most [`MAX_INSTRUCTIONS`], and
/// required ranges and the inverses of transforms add a few.
const MAX_FINISHED: usize = 4 * MAX_INSTRUCTIONS;

impl FrontMember {
    /// Checks that a search can have left it.
    pub(crate) fn check(&self) -> Result<(), String> {
        not_negative("cost", self.cost)?;
        for error in self.score.search.iter().chain(&self.score.validation) {
            not_negative("rmse", error.rmse)?;
            not_negative("max", error.max)?;
        }
        for DomainError { rmse, rmse_within, max, max_within } in &self.domain {
            not_negative("rmse", *rmse)?;
            not_negative("rmse_within", *rmse_within)?;
            not_negative("max", *max)?;
            not_negative("max_within", *max_within)?;
        }
        short(&self.program)
    }
}

impl State {
    /// Checks that a search for this goal by this method, for so many inputs and outputs, can have
    /// reached this state: every program is verified, every index exists, every number is finite.
    ///
    /// # Errors
    /// The first violation.
    pub fn check(
        &self,
        goal: &Goal,
        method: &Method,
        inputs: usize,
        outputs: usize,
    ) -> Result<(), String> {
        goal.check(inputs, outputs)?;
        method.check()?;
        if self.islands.len() != method.islands {
            return Err("its number of islands does not match its settings".into());
        }
        self.archive.check(inputs, outputs)?;
        for (number, island) in self.islands.iter().enumerate() {
            island
                .check(&Island::new(number, goal, method), inputs, outputs)
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
            false => Err("the archive is not sorted by rising cost".into()),
        }
    }
}

/// Checks that a draft is a short program of so many inputs and outputs.
pub(super) fn check_draft(draft: &Draft, inputs: usize, outputs: usize) -> Result<(), String> {
    draft.check().map_err(|invalid| invalid.to_string())?;
    if (draft.inputs, draft.outputs.len()) != (inputs, outputs) {
        return Err(format!(
            "a program of {} inputs and {} outputs; it must have {inputs} and {outputs}",
            draft.inputs,
            draft.outputs.len()
        ));
    }
    short(draft)
}

fn short(draft: &Draft) -> Result<(), String> {
    match draft.instrs.len() <= MAX_FINISHED {
        true => Ok(()),
        false => Err(format!(
            "a formula of {} operations; a search writes at most {MAX_FINISHED}",
            draft.instrs.len()
        )),
    }
}

pub(crate) fn not_negative(name: &str, number: f64) -> Result<(), String> {
    match number.is_finite() && number >= 0.0 {
        true => Ok(()),
        false => Err(format!("`{name}` is {number}; it must be finite and not negative")),
    }
}
