//! Fits of some of a program's constants, each within bounds.

use super::shorten::shorten_free;
use super::{Fitter, Measure, Parameter, Rounds, Stop, minimax_free};
use crate::eval::Samples;
use crate::program::Draft;

/// The end of a fit from one start. Chosen by hand, unmeasured.
const TO_CONVERGENCE: Stop = Stop { max_steps: 500, min_gain: 1e-10 };

/// Fits parameters by least squares, and returns the loss.
pub(crate) fn squares_within(
    fitter: &mut Fitter,
    program: &mut Draft,
    samples: &Samples,
    parameters: &[Parameter],
) -> f64 {
    within(program, parameters, |program, free| {
        fitter.fit_free(program, samples, TO_CONVERGENCE, |index| is_among(free, index))
    })
}

/// Fits parameters so that the largest error is small, and returns that error.
pub(super) fn maximum_within(
    fitter: &mut Fitter,
    program: &mut Draft,
    samples: &Samples,
    parameters: &[Parameter],
) -> f64 {
    within(program, parameters, |program, free| {
        let is_free = |index| is_among(free, index);
        minimax_free(fitter, program, samples, Rounds::TO_CONVERGENCE, is_free)
    })
}

/// Fits parameters from any start: for the least maximum, by least squares first.
pub(super) fn fit_within(
    fitter: &mut Fitter,
    program: &mut Draft,
    samples: &Samples,
    parameters: &[Parameter],
    measure: Measure,
) -> f64 {
    within(program, parameters, |program, free| {
        let is_free = |index| is_among(free, index);
        let loss = fitter.fit_free(program, samples, TO_CONVERGENCE, is_free);
        match measure {
            Measure::Max if loss.is_finite() => {
                minimax_free(fitter, program, samples, Rounds::TO_CONVERGENCE, is_free)
            }
            _ => loss,
        }
    })
}

/// Fits again and again: a parameter that would leave its bounds is held at the one that it meets.
fn within(
    program: &mut Draft,
    parameters: &[Parameter],
    mut fit: impl FnMut(&mut Draft, &[Parameter]) -> f64,
) -> f64 {
    let mut free: Vec<Parameter> = parameters.to_vec();
    loop {
        let loss = fit(program, &free);
        let outside = |parameter: &Parameter| !parameter.contains(program.consts[parameter.index]);
        let Some(place) = free.iter().position(outside) else { return loss };
        let held = free.remove(place);
        program.consts[held.index] = held.nearest(program.consts[held.index].into());
    }
}

/// Removes the parameters' digits below the data's rounding and returns the loss; changes nothing
/// and returns none if a parameter would leave its bounds.
pub(super) fn rounded_within(
    fitter: &mut Fitter,
    program: &mut Draft,
    samples: &Samples,
    parameters: &[Parameter],
) -> Option<f64> {
    let mut short = program.clone();
    let is_free = |index| is_among(parameters, index);
    let loss = shorten_free(fitter, &mut short, samples, 0.0, is_free);
    let mut all = parameters.iter();
    all.all(|parameter| parameter.contains(short.consts[parameter.index])).then(|| {
        program.copy_from(&short);
        loss
    })
}

fn is_among(parameters: &[Parameter], index: usize) -> bool {
    parameters.iter().any(|parameter| parameter.index == index)
}
