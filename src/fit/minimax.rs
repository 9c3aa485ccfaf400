//! Fits that make the largest error small.

use super::linear_programs::by_linear_programs;
use super::rounding::Comparison;
use super::shorten::{MAX_DIGITS, rounded};
use super::{Fitter, Stop};
use crate::eval::{Samples, Tape, Values};
use crate::program::{Draft, Program};

/// The effort of a fit for the least maximum error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rounds {
    /// The most times that samples are weighted anew.
    pub most: u32,
    /// The end of the least-squares fit after each.
    pub steps: Stop,
    /// The most linear programs solved after that.
    pub linear_programs: u32,
    /// The error to be beaten; a fit that stays far above it is given up.
    pub wanted: f64,
}

impl Rounds {
    /// Rounds until next to nothing is gained. Chosen by hand, unmeasured.
    pub const TO_CONVERGENCE: Rounds = Rounds {
        most: 8,
        steps: Stop { max_steps: 3, min_gain: 1e-4 },
        linear_programs: 40,
        wanted: f64::INFINITY,
    };
}

/// Fits every constant, starting from its value, so that the largest absolute error over all
/// samples and outputs is small. Returns that error, which is never larger than before. Errors are
/// multiplied by the square roots of their samples' weights.
///
/// First come least-squares fits between which samples gain weight by their errors (Lawson 1961,
/// "Contributions to the theory of linear least maximum approximation"), then linear programs.
///
/// # Panics
/// As [`Fitter::fit`].
pub fn minimax(fitter: &mut Fitter, draft: &mut Draft, samples: &Samples, rounds: Rounds) -> f64 {
    minimax_free(fitter, draft, samples, rounds, |_| true)
}

/// As [`minimax`], but fits only the constants whose index is free.
pub fn minimax_free(
    fitter: &mut Fitter,
    draft: &mut Draft,
    samples: &Samples,
    rounds: Rounds,
    is_free: impl Fn(usize) -> bool + Copy,
) -> f64 {
    let mut best = by_weights(fitter, draft, samples, rounds, is_free);
    if best <= rounds.wanted * NEAR {
        best = by_linear_programs(fitter, draft, samples, rounds.linear_programs, is_free, best);
    }
    best
}

fn by_weights(
    fitter: &mut Fitter,
    draft: &mut Draft,
    samples: &Samples,
    rounds: Rounds,
    is_free: impl Fn(usize) -> bool + Copy,
) -> f64 {
    let given = |output| samples.weights(output).to_vec();
    let mut weights: Vec<Vec<f32>> = (0..samples.outputs()).map(given).collect();
    let mut weighted = samples.clone();
    let mut values = Values::default();
    let mut trial = draft.clone();
    let (mut mean, mut best) = errors(fitter, &trial, samples, &mut values);
    for _ in 0..rounds.most {
        let hopeless = best > rounds.wanted * FAR || !mean.is_finite();
        if hopeless || fitter.is_cut(samples) || best == 0.0 || draft.consts.is_empty() {
            break;
        }
        for (output, weights) in weights.iter_mut().enumerate() {
            for (weight, error) in weights.iter_mut().zip(scaled(samples, &values, output)) {
                *weight *= (error.abs() / mean) as f32 + MIN_GROWTH;
            }
        }
        normalise(&mut weights);
        for (output, weights) in weights.iter().enumerate() {
            weighted.set_weights(output, weights);
        }
        fitter.fit_free(&mut trial, &weighted, rounds.steps, is_free);
        let largest;
        (mean, largest) = errors(fitter, &trial, samples, &mut values);
        if largest < best {
            best = largest;
            draft.copy_from(&trial);
        }
    }
    best
}

/// The multiples of the wanted error from beyond which it is hardly ever reached: by reweighting
/// (`FAR`), by linear programs (`NEAR`).
const FAR: f64 = 3.0;
const NEAR: f64 = 1.3;

/// The least growth of a weight, so that a sample met exactly by chance can come back. Chosen by
/// hand, unmeasured.
const MIN_GROWTH: f32 = 0.05;

/// Rounds the constants one after the other, each to 0 or to the fewest decimal digits with which
/// the largest error stays within `(1 + allowance)` times what it was, or below the data's own
/// rounding. Returns the largest error.
///
/// # Panics
/// As [`Fitter::fit`].
pub fn shorten_minimax(
    fitter: &mut Fitter,
    draft: &mut Draft,
    samples: &Samples,
    allowance: f64,
) -> f64 {
    shorten_minimax_free(fitter, draft, samples, allowance, |_| true)
}

/// As [`shorten_minimax`], but rounds only the constants whose index is free.
pub(crate) fn shorten_minimax_free(
    fitter: &mut Fitter,
    draft: &mut Draft,
    samples: &Samples,
    allowance: f64,
    is_free: impl Fn(usize) -> bool,
) -> f64 {
    let mut comparison = Comparison::by_maximum(samples);
    let limit = comparison.error(fitter, draft) * (1.0 + allowance);
    for constant in (0..draft.consts.len()).filter(|&constant| is_free(constant)) {
        let exact = draft.consts[constant];
        for digits in 0..=MAX_DIGITS {
            if fitter.is_cut(samples) {
                return errors(fitter, draft, samples, &mut Values::default()).1;
            }
            draft.consts[constant] = rounded(exact, digits);
            if comparison.error(fitter, draft) <= limit {
                break;
            }
            draft.consts[constant] = exact;
        }
    }
    errors(fitter, draft, samples, &mut Values::default()).1
}

/// Scales weights to a mean of 1, with a floor that keeps every sample in sight.
fn normalise(weights: &mut [Vec<f32>]) {
    const FLOOR: f64 = 1e-6;
    let count: usize = weights.iter().map(Vec::len).sum();
    let total: f64 = weights.iter().flatten().map(|&w| f64::from(w)).sum();
    let mean = total / count as f64;
    let floored = |w: f32| (f64::from(w) / mean).max(FLOOR) as f32;
    weights.iter_mut().flatten().for_each(|w| *w = floored(*w));
}

/// Returns the mean and the largest absolute error; both infinite if any output is not finite.
pub(super) fn errors(
    fitter: &mut Fitter,
    draft: &Draft,
    samples: &Samples,
    values: &mut Values,
) -> (f64, f64) {
    let Ok(program) = Program::verify(draft.clone()) else {
        return (f64::INFINITY, f64::INFINITY);
    };
    fitter.evaluator.outputs_into(&Tape::new(&program), samples, values);
    let (mut sum, mut largest) = (0.0, 0.0f64);
    for output in 0..samples.outputs() {
        for error in scaled(samples, values, output) {
            if !error.is_finite() {
                return (f64::INFINITY, f64::INFINITY);
            }
            sum += error.abs();
            largest = largest.max(error.abs());
        }
    }
    (sum / (samples.rows() * samples.outputs()) as f64, largest)
}

/// Returns an output's errors, times the square roots of the weights.
pub(super) fn scaled(
    samples: &Samples,
    values: &Values,
    output: usize,
) -> impl Iterator<Item = f64> {
    let pairs = values.column(output).iter().zip(samples.targets(output));
    let weighed = pairs.zip(samples.weights(output));
    weighed.map(|((f, y), weight)| f64::from(f - y) * f64::from(*weight).sqrt())
}
