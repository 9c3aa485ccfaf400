//! The least maximum error.

use super::shorten::{MOST_DIGITS, rounded};
use super::{Fitter, Stop};
use crate::eval::{Samples, Tape, Values};
use crate::program::{Draft, Program};

/// When reweighting ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rounds {
    pub most: u32,
    /// Rounds without a gain.
    pub patience: u32,
    /// Between two reweightings.
    pub steps: Stop,
}

impl Rounds {
    /// Until nothing is gained.
    pub const TO_CONVERGENCE: Rounds =
        Rounds { most: 120, patience: 12, steps: Stop { max_steps: 6, min_gain: 1e-5 } };
}

/// Fits every constant so that the largest absolute error over all samples and outputs is small, from
/// the constants that it has, and gives that error: least squares, in which samples gain
/// weight by their error, round by round (Lawson 1961, "Contributions to the theory of linear least
/// maximum approximation"). Never worse than what it starts from. The samples' weights are
/// neither used nor kept.
///
/// # Panics
/// As [`Fitter::fit`].
pub fn minimax(
    fitter: &mut Fitter,
    program: &mut Draft,
    samples: &mut Samples,
    rounds: Rounds,
) -> f64 {
    minimax_free(fitter, program, samples, rounds, |_| true)
}

/// [`minimax`] of those constants that are free, by index; the others keep their values.
pub fn minimax_free(
    fitter: &mut Fitter,
    program: &mut Draft,
    samples: &mut Samples,
    rounds: Rounds,
    is_free: impl Fn(usize) -> bool + Copy,
) -> f64 {
    let mut weights = vec![vec![1.0f32; samples.rows()]; samples.outputs()];
    let mut values = Values::default();
    let mut trial = program.clone();
    let (mut mean, mut best) = errors(fitter, &trial, samples, &mut values);
    let mut idle = 0;
    for _ in 0..rounds.most {
        if !mean.is_finite() || idle == rounds.patience || program.consts.is_empty() {
            break;
        }
        for (output, weights) in weights.iter_mut().enumerate() {
            let pairs = values.column(output).iter().zip(samples.targets(output));
            for (weight, (f, y)) in weights.iter_mut().zip(pairs) {
                *weight *= (f - y).abs() / mean as f32 + LEAST_GROWTH;
            }
        }
        normalise(&mut weights);
        for (output, weights) in weights.iter().enumerate() {
            samples.set_weights(output, weights);
        }
        fitter.fit_free(&mut trial, samples, rounds.steps, is_free);
        let largest;
        (mean, largest) = errors(fitter, &trial, samples, &mut values);
        idle += 1;
        if largest < best {
            if largest < best * (1.0 - ENOUGH) {
                idle = 0;
            }
            best = largest;
            program.copy_from(&trial);
        }
    }
    best
}

/// So that a sample that happens to be met exactly can come back.
const LEAST_GROWTH: f32 = 0.05;

/// A gain smaller than this share is none.
const ENOUGH: f64 = 1e-3;

/// Rounds constants one after the other, each to the fewest decimal digits with which the largest
/// error stays within `(1 + allowance)` of what it was. Gives that error.
///
/// # Panics
/// As [`Fitter::fit`].
pub fn shorten_minimax(
    fitter: &mut Fitter,
    program: &mut Draft,
    samples: &Samples,
    allowance: f64,
) -> f64 {
    let mut values = Values::default();
    let mut largest = errors(fitter, program, samples, &mut values).1;
    let limit = largest * (1.0 + allowance);
    for constant in 0..program.consts.len() {
        let exact = program.consts[constant];
        for digits in 1..=MOST_DIGITS {
            program.consts[constant] = rounded(exact, digits);
            let error = errors(fitter, program, samples, &mut values).1;
            if error <= limit {
                largest = error;
                break;
            }
            program.consts[constant] = exact;
        }
    }
    largest
}

/// To a mean of 1, with a floor that keeps every sample in sight.
fn normalise(weights: &mut [Vec<f32>]) {
    const FLOOR: f64 = 1e-6;
    let count: usize = weights.iter().map(Vec::len).sum();
    let total: f64 = weights.iter().flatten().map(|&w| f64::from(w)).sum();
    let mean = total / count as f64;
    let floored = |w: f32| (f64::from(w) / mean).max(FLOOR) as f32;
    weights.iter_mut().flatten().for_each(|w| *w = floored(*w));
}

/// The mean and the largest absolute error; both infinite if any output is not finite.
fn errors(
    fitter: &mut Fitter,
    program: &Draft,
    samples: &Samples,
    values: &mut Values,
) -> (f64, f64) {
    let Ok(program) = Program::verify(program.clone()) else {
        return (f64::INFINITY, f64::INFINITY);
    };
    fitter.evaluator.outputs_into(&Tape::new(&program), samples, values);
    let (mut sum, mut largest) = (0.0, 0.0f64);
    for output in 0..samples.outputs() {
        for (f, y) in values.column(output).iter().zip(samples.targets(output)) {
            let error = f64::from((f - y).abs());
            if !error.is_finite() {
                return (f64::INFINITY, f64::INFINITY);
            }
            sum += error;
            largest = largest.max(error);
        }
    }
    (sum / (samples.rows() * samples.outputs()) as f64, largest)
}
