//! Checks of states and fronts read from files, which must obey the same rules as those made here,
//! so that all other code can rely on them.

use super::island::Island;
use super::{FrontMember, Goal, MAX_CYCLES, Method, State};
use crate::archive::Archive;
use crate::grammar::MAX_INSTRUCTIONS;
use crate::program::{Draft, Shape};
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
    /// Checks that a search for this goal by this method, of drafts of this shape, can have reached
    /// this state: every program is verified, every index exists, every number is finite.
    ///
    /// # Errors
    /// The first violation.
    pub fn check(&self, goal: &Goal, method: &Method, shape: &Shape) -> Result<(), String> {
        method.check()?;
        if !(0.0..=MAX_CYCLES * MAX_CYCLES).contains(&self.floor) {
            return Err(format!("its template costs {} cycles", self.floor));
        }
        if goal.template.is_none() && self.floor != 0.0 {
            return Err("it has a template, but its goal has none".into());
        }
        if self.islands.len() != method.islands {
            return Err("its number of islands does not match its settings".into());
        }
        self.archive.check(shape)?;
        for (number, island) in self.islands.iter().enumerate() {
            island
                .check(&Island::new(number, goal, self.floor, method), shape)
                .map_err(|reason| format!("island {number}: {reason}"))?;
        }
        Ok(())
    }
}

impl Archive {
    pub(super) fn check(&self, shape: &Shape) -> Result<(), String> {
        for member in self.members() {
            not_negative("cost", member.cost)?;
            not_negative("loss", member.loss)?;
            check_draft(&member.draft, shape)?;
        }
        match self.members().is_sorted_by(|a, b| a.cost <= b.cost) {
            true => Ok(()),
            false => Err("the archive is not sorted by rising cost".into()),
        }
    }
}

/// Checks that a draft is a short program of a shape.
pub(super) fn check_draft(draft: &Draft, shape: &Shape) -> Result<(), String> {
    let (inputs, outputs) = (shape.inputs, shape.outputs());
    draft.check().map_err(|invalid| invalid.to_string())?;
    if (draft.inputs, draft.outputs.len()) != (inputs, outputs) {
        return Err(format!(
            "a program of {} inputs and {} outputs; it must have {inputs} and {outputs}",
            draft.inputs,
            draft.outputs.len()
        ));
    }
    if let Some(output) = shape.violation(draft) {
        return Err(format!("hole {output} reads what it must not"));
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
