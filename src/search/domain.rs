//! The errors of a front's formulas over the whole domain of the function that they approximate.

use super::{Front, FrontMember};
use crate::dataset::Split;
use crate::eval::{Evaluator, OutputError, Samples, Tape};
use crate::fit::Measure;
use crate::truth::{DomainError, Error, Formulas, Mesh};

/// Integrates the errors of formulas over the domain ([`Mesh::domain_errors`]), and notes them. The
/// error bars of the first `deciding` formulas are made small; those of others are what they are.
/// Returns false if `stopped` returned true before there were error bars; they are not noted then.
///
/// # Errors
/// As [`Mesh::domain_errors`].
pub fn integrate(
    members: &mut [&mut FrontMember],
    deciding: usize,
    mesh: &Mesh,
    evaluations: usize,
    stopped: &(dyn Fn() -> bool + Sync),
) -> Result<bool, Error> {
    let inputs = mesh.truth().inputs().len();
    let tapes: Vec<Tape> = members.iter().map(|member| Tape::new(&member.program)).collect();
    let values = |split: &Split| -> Vec<Vec<Vec<f32>>> {
        let samples = Samples::new(split, inputs);
        let mut evaluator = Evaluator::default();
        tapes.iter().map(|tape| evaluator.outputs(tape, &samples)).collect()
    };
    let formulas = Formulas { values: &values, deciding };
    let Some(errors) = mesh.domain_errors(formulas, evaluations, stopped)? else {
        return Ok(false);
    };
    members.iter_mut().zip(errors).for_each(|(member, errors)| member.domain = errors);
    Ok(true)
}

impl FrontMember {
    /// Returns its errors by output: over the whole domain, if they were integrated, as far as they
    /// were; else, and in the other measures, on the search split.
    pub fn errors(&self) -> Vec<OutputError> {
        let search = self.score.search.iter().enumerate();
        let of = |(output, error): (usize, &OutputError)| match self.domain.get(output) {
            Some(domain) => OutputError { rmse: domain.rmse, max: domain.max, ..*error },
            None => *error,
        };
        search.map(of).collect()
    }

    /// Returns [`FrontMember::errors`] over all outputs.
    pub fn error(&self) -> OutputError {
        self.score.joint(&self.errors())
    }

    /// Returns the errors over the whole domain over all outputs, with their error bars; none if
    /// they were not integrated.
    pub fn domain_error(&self) -> Option<DomainError> {
        if self.domain.is_empty() {
            return None;
        }
        let error = self.error();
        // As far off as all outputs can be together.
        let farthest = |(domain, search): (&DomainError, &OutputError)| OutputError {
            rmse: domain.rmse + domain.rmse_within,
            max: domain.max + domain.max_within,
            ..*search
        };
        let farthest: Vec<OutputError> =
            self.domain.iter().zip(&self.score.search).map(farthest).collect();
        let farthest = self.score.joint(&farthest);
        Some(DomainError {
            rmse: error.rmse,
            rmse_within: farthest.rmse - error.rmse,
            max: error.max,
            max_within: farthest.max - error.max,
        })
    }

    /// Returns true if errors in the measure are those over the whole domain.
    pub fn is_integrated(&self, measure: Measure) -> bool {
        !self.domain.is_empty() && matches!(measure, Measure::Rmse | Measure::Max)
    }
}

impl Front {
    /// Returns true if its errors are those over the whole domain.
    pub fn is_integrated(&self) -> bool {
        self.members.iter().any(|member| member.is_integrated(self.measure))
    }
}
