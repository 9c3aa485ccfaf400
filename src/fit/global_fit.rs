//! The global fit of a program's constants.

use super::differential_evolution::End;
use super::global::{Agreement, GlobalSettings};
use super::round::{Found, Search};
use super::within::rounded_within;
use super::{Fitter, Measure, Parameter, Range, RangeError};
use crate::eval::Samples;
use crate::program::Draft;

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
    /// Why the differential evolution of the best round ended.
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
    let ranges = ranges_around(program, parameters)?;
    let mut search = Search::new(fitter, program, samples, parameters, measure, &ranges, settings);
    let started = search.started(program);
    let mut best: Option<Found> = None;
    let mut agreement = Agreement::default();
    for round in 0..u64::from(settings.rounds.max(1)) {
        let found = search.round(round, program)?;
        let is_cut = search.evaluations >= settings.max_evaluations || found.end == End::Deadline;
        let agreeing = agreement.add(found.loss, found.first_loss);
        if best.as_ref().is_none_or(|best| found.loss < best.loss) {
            best = Some(found);
        }
        if agreeing >= settings.agreeing || is_cut {
            break;
        }
    }
    let (evaluations, sampled) = (search.evaluations, search.sampled);
    let best = best.expect("at least one round");
    let mut fit =
        GlobalFit { loss: started, evaluations, sampled, end: best.end, finish: Finish::Start };
    if best.loss < started {
        program.copy_from(&best.program);
        (fit.loss, fit.finish) = (best.loss, best.finish);
    }
    if measure != Measure::Max && fit.loss.is_finite() {
        fit.loss = rounded_within(fitter, program, samples, parameters).unwrap_or(fit.loss);
    }
    Ok(fit)
}

/// Returns the ranges that are searched, and moves the constants to the bounds that they exceed.
fn ranges_around(program: &mut Draft, parameters: &[Parameter]) -> Result<Vec<Range>, RangeError> {
    let mut ranges = Vec::with_capacity(parameters.len());
    for parameter in parameters {
        let start = &mut program.consts[parameter.index];
        ranges.push(parameter.range(*start)?);
        *start = parameter.nearest((*start).into());
    }
    Ok(ranges)
}
