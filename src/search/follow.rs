//! Other samples for a search under way, and the errors by which they are chosen.

use super::island::refitted;
use super::{Problem, Search, SetupError};
use crate::archive::{Archive, Member};
use crate::dataset::{Dataset, Split, output_units};
use crate::deadline::Deadline;
use crate::eval::{Evaluator, Samples, Tape, relative_floor};
use crate::fit::{Fitter, Measure};
use crate::program::Program;
use rayon::prelude::*;
use std::sync::Arc;

impl Search {
    /// Goes on with these rows in place of what formulas were fitted to and judged on before, as
    /// [`Problem::sampled_on`] has them. What was found keeps its losses until
    /// [`Search::judge_anew`].
    ///
    /// # Errors
    /// Rows that are no split of the dataset.
    pub fn sample_on(&mut self, rows: Split) -> Result<(), SetupError> {
        self.problem = Arc::new(self.problem.sampled_on(rows)?);
        self.race = Arc::new(self.problem.race(self.method.subset));
        self.state.islands.iter_mut().for_each(|island| island.race_on(&self.race));
        Ok(())
    }

    /// Fits all formulas of the archive and the populations again, judges them anew, and forgets
    /// which structures were tried in vain. Those that the deadline leaves no time for keep their
    /// losses.
    pub fn judge_anew(&mut self, deadline: &Deadline) {
        let problem = &*self.problem;
        self.state.islands.par_iter_mut().for_each(|island| island.judge_anew(problem, deadline));
        let archived = std::mem::take(&mut self.state.archive);
        let members = archived.members().par_iter().map(|member| {
            let mut fitter = Fitter::until(&deadline.moment_alone());
            if deadline.is_past() {
                Some(member.clone())
            } else {
                refitted(member, problem, &mut fitter)
            }
        });
        let members: Vec<Option<Member>> = members.collect();
        let mut archive = Archive::default();
        for member in members.into_iter().flatten() {
            archive.offer(member);
        }
        self.state.islands.iter_mut().for_each(|island| island.archive.clone_from(&archive));
        self.state.archive = archive;
    }

    /// Returns the square of each formula's error at each row, which is over the dataset's columns;
    /// formulas are those of the archive. Errors are in the outputs' units, or relative, as the
    /// measure has them: for the maximum error the largest of the outputs', else the sum.
    pub fn squares(&self, rows: &Split) -> Vec<Vec<f64>> {
        let problem = &*self.problem;
        let samples = Samples::new(rows, problem.dataset.inputs.len());
        let members = self.archive().members().par_iter();
        let of = |member: &Member| {
            let program = Program::verify(problem.formula_of(&member.draft)).ok()?;
            let values = Evaluator::default().outputs(&Tape::new(&program), &samples);
            Some(squares(&problem.dataset, problem.goal.measure, rows, &values))
        };
        members.filter_map(of).collect()
    }
}

fn squares(dataset: &Dataset, measure: Measure, rows: &Split, values: &[Vec<f32>]) -> Vec<f64> {
    let (inputs, units) = (dataset.inputs.len(), output_units(&dataset.outputs));
    let mut squares = vec![0.0; rows.rows()];
    for (output, values) in values.iter().enumerate() {
        let floor = relative_floor(&dataset.search.columns[inputs + output]);
        for ((square, &f), &y) in squares.iter_mut().zip(values).zip(&rows.columns[inputs + output])
        {
            let unit = match measure {
                Measure::Relative => f64::from(y).abs().max(floor),
                _ => units[output],
            };
            let error = ((f64::from(f) - f64::from(y)) / unit).powi(2);
            *square = if measure == Measure::Max { error.max(*square) } else { error + *square };
        }
    }
    squares
}

impl Problem {
    /// Returns true if the mean over the rows that formulas are fitted to is the measure: nobody
    /// gave weights of his own, so that other rows can be in their place.
    pub fn may_be_sampled_elsewhere(&self) -> bool {
        matches!(self.goal.measure, Measure::Rmse | Measure::Max | Measure::Relative)
            && self.dataset.search.standard_errors.is_empty()
    }
}
