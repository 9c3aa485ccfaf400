//! Fits of some of a program's constants, each within bounds.

use super::shorten::shorten_free;
use super::{Fitter, Measure, Range, RangeError, Rounds, Scale, Stop, minimax_free};
use crate::eval::Samples;
use crate::program::Draft;

/// A constant to be fitted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameter {
    /// The index in the constant table.
    pub index: usize,
    /// The least and the greatest value; infinite if unbounded.
    pub bounds: [f32; 2],
    /// The scale on which starts are drawn and a global fit searches. A logarithmic one needs two
    /// positive, finite bounds.
    pub scale: Scale,
}

/// A bound that a fitted parameter lies on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Bound {
    /// The least value allowed.
    Lower,
    /// The greatest value allowed.
    Upper,
}

/// How far a parameter is searched globally where a bound is infinite: this many times its start or
/// its other bound, whichever is further from 0, or this far if both are 0. By hand, unmeasured.
const REACH: f32 = 10.0;

impl Parameter {
    /// Makes an unbounded parameter, on a linear scale.
    pub fn unbounded(index: usize) -> Parameter {
        let bounds = [f32::NEG_INFINITY, f32::INFINITY];
        Parameter { index, bounds, scale: Scale::Linear }
    }

    /// Returns the bound on which a value lies, if on any.
    pub fn bound(&self, value: f32) -> Option<Bound> {
        let [low, high] = self.bounds;
        match () {
            () if value == low => Some(Bound::Lower),
            () if value == high => Some(Bound::Upper),
            () => None,
        }
    }

    /// Returns the range that a global fit searches: the bounds, or, where one is infinite, ten
    /// times the start or the other bound, whichever is further from 0, of either sign; ten, if
    /// both are 0.
    ///
    /// Returns an error if the bounds are out of order, or not positive on a logarithmic scale.
    pub fn range(&self, start: f32) -> Result<Range, RangeError> {
        let given = self.bounds.map(f64::from);
        let [low, high] = self.bounds;
        Range::new(given[0], given[1], self.scale)?;
        let finite = self.bounds.into_iter().chain([start]).filter(|value| value.is_finite());
        let furthest = finite.map(f32::abs).fold(0.0, f32::max);
        let reach = if furthest == 0.0 { REACH } else { (REACH * furthest).min(f32::MAX) };
        let low = if low.is_finite() { low } else { -reach };
        let high = if high.is_finite() { high } else { reach };
        Range::new(low.into(), high.into(), self.scale)
    }

    /// Returns the nearest value within bounds.
    pub(super) fn nearest(&self, value: f64) -> f32 {
        let [low, high] = self.bounds;
        (value as f32).clamp(low, high)
    }

    fn contains(&self, value: f32) -> bool {
        let [low, high] = self.bounds;
        (low..=high).contains(&value)
    }
}

/// The end of a fit from one start. Chosen by hand, unmeasured.
const TO_CONVERGENCE: Stop = Stop { max_steps: 500, min_gain: 1e-10 };

/// Fits parameters by least squares, and returns the loss.
pub(super) fn squares_within(
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
