//! The global fit of a program's constants.

use super::differential_evolution::End;
use super::global::GlobalSettings;
use super::objective::Objective;
use super::population::Population;
use super::rows::GrowingRows;
use super::within::{maximum_within, rounded_within, squares_within};
use super::{Fitter, Measure, Parameter, Range, RangeError};
use crate::eval::Samples;
use crate::program::{Draft, Program};

/// What a global fit came to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GlobalFit {
    /// The loss: the weighted sum of squares, or for [`Measure::Max`] the largest error. Not
    /// finite if the model was finite on all samples nowhere.
    pub loss: f64,
    /// The number of evaluations of the loss, on all samples or some; the steps of
    /// Levenberg–Marquardt and of the least maximum are not counted.
    pub evaluations: u64,
    /// The number of samples in all these evaluations.
    pub sampled: u64,
    /// Why the differential evolution ended.
    pub end: End,
    /// What found the constants last.
    pub finish: Finish,
}

/// What found a global fit's constants last.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Finish {
    /// Nothing: none were better than the program's own.
    Start,
    /// Differential evolution: no local search was better.
    Evolution,
    /// Levenberg–Marquardt, or for [`Measure::Max`] [`crate::fit::minimax`], from there.
    Derivatives,
    /// Nelder–Mead, from there.
    Simplex,
}

/// Fits the parameters of effective code globally, all other constants keeping their values: by
/// differential evolution within the parameters' ranges ([`Parameter::range`]), then by
/// Levenberg–Marquardt or, for [`Measure::Max`], by the least maximum. Where derivatives gain
/// nothing, or a parameter has none (as in a `step`), by Nelder–Mead. The program's constants stay,
/// clamped to their bounds, if none are found that are better.
///
/// The first generations see some of the samples, every ten generations twice as many, until all
/// are seen (course notes §3.2.1, "Noise and Cooperation"). All individuals are then evaluated
/// anew, so that no two values compared are of different samples, and the last always of all.
///
/// A parameter that the local search takes out of its bounds is held at the one that it meets;
/// where a bound is infinite, it may leave the range. Except for [`Measure::Max`], digits below the
/// data's own rounding are removed.
///
/// The result is the same at any number of threads. Up to a thousand samples all is done on the
/// calling thread: many such fits may run side by side, each fitter reusing its memory.
///
/// Returns an error if a parameter has no range.
///
/// # Panics
/// As [`Fitter::fit`]; if a parameter is not in the constant table.
pub fn fit_globally(
    fitter: &mut Fitter,
    program: &mut Draft,
    samples: &Samples,
    parameters: &[Parameter],
    measure: Measure,
    settings: &GlobalSettings,
) -> Result<GlobalFit, RangeError> {
    let mut ranges: Vec<Range> = Vec::with_capacity(parameters.len());
    for parameter in parameters {
        let [low, high] = parameter.bounds;
        let start = &mut program.consts[parameter.index];
        ranges.push(parameter.range(*start)?);
        *start = start.clamp(low, high);
    }
    let mut population = Population::new(&settings.evolution, &ranges, settings.seed)?;
    let verified = Program::verify(program.clone()).expect("effective code is a program");
    let mut objective = Objective::new(fitter, &verified, samples, parameters, measure);
    let start = point_of(program, parameters);
    let started = objective.loss(samples, &start);
    let rows = GrowingRows::new(samples, settings.first_rows, settings.seed);
    let end = rows.evolve(&mut population, &mut objective, &fitter.deadline);
    let mut evaluations = population.evaluations + 1;
    let mut found = Found {
        program: with_constants(program, parameters, &population.best_point()),
        loss: population.best_value(),
        finish: Finish::Evolution,
    };
    let mut sampled = objective.sampled;
    objective.release(fitter);
    let has_gained = found.descend(fitter, samples, parameters, measure);
    if !has_gained || lacks_a_derivative(fitter, &found.program, parameters) {
        let mut objective = Objective::new(fitter, &verified, samples, parameters, measure);
        let point = point_of(&found.program, parameters);
        let position = ranges.iter().zip(&point).map(|(range, value)| range.position(*value));
        let position: Vec<f64> = position.collect();
        let minimum =
            settings.refine(&population, &position, &mut |point| objective.loss(samples, point));
        evaluations += minimum.evaluations;
        sampled += objective.sampled;
        objective.release(fitter);
        let trial = with_constants(program, parameters, &minimum.at);
        found.offer(trial, minimum.value, Finish::Simplex);
    }
    let mut fit = GlobalFit { loss: started, evaluations, sampled, end, finish: Finish::Start };
    if found.loss < started {
        program.copy_from(&found.program);
        (fit.loss, fit.finish) = (found.loss, found.finish);
    }
    if measure != Measure::Max && fit.loss.is_finite() {
        fit.loss = rounded_within(fitter, program, samples, parameters).unwrap_or(fit.loss);
    }
    Ok(fit)
}

/// The best constants so far, but for the program's own.
struct Found {
    program: Draft,
    loss: f64,
    finish: Finish,
}

impl Found {
    fn offer(&mut self, program: Draft, loss: f64, finish: Finish) -> bool {
        let is_better = loss < self.loss;
        if is_better {
            *self = Found { program, loss, finish };
        }
        is_better
    }

    /// Follows derivatives down. Returns true if they led anywhere.
    fn descend(
        &mut self,
        fitter: &mut Fitter,
        samples: &Samples,
        parameters: &[Parameter],
        measure: Measure,
    ) -> bool {
        let mut trial = self.program.clone();
        let loss = match measure {
            Measure::Max => maximum_within(fitter, &mut trial, samples, parameters),
            _ => squares_within(fitter, &mut trial, samples, parameters),
        };
        self.offer(trial, loss, Finish::Derivatives)
    }
}

fn point_of(program: &Draft, parameters: &[Parameter]) -> Vec<f64> {
    parameters.iter().map(|parameter| program.consts[parameter.index].into()).collect()
}

fn with_constants(program: &Draft, parameters: &[Parameter], point: &[f64]) -> Draft {
    let mut program = program.clone();
    for (parameter, value) in parameters.iter().zip(point) {
        program.consts[parameter.index] = parameter.nearest(*value);
    }
    program
}

/// Returns true if the outputs have no derivative by a parameter, whatever its value.
fn lacks_a_derivative(fitter: &mut Fitter, program: &Draft, parameters: &[Parameter]) -> bool {
    fitter.derivative.assign(program);
    let has_one = |parameter: &Parameter| {
        let mut entries = fitter.derivative.jacobian.entries.iter().flatten();
        entries.any(|&(index, _)| usize::from(index) == parameter.index)
    };
    !parameters.iter().all(has_one)
}
