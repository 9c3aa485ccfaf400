//! The least maximum error near a program's constants, by linear programs.

use super::Fitter;
use super::chebyshev::least_maximum;
use super::minimax::{errors, scaled};
use crate::eval::{Samples, Values};
use crate::program::Draft;

/// The first, least and greatest radius of the trust region, relative to each constant. These and
/// the gains that change it: chosen by hand, unmeasured.
const FIRST_RADIUS: f64 = 0.1;
const MIN_RADIUS: f64 = 1e-6;
const MAX_RADIUS: f64 = 2.0;

/// The least share by which a linear program must promise to lower the error, or it is the last.
/// Chosen by hand, unmeasured.
const MIN_GAIN: f64 = 1e-4;

/// The least magnitude that a constant's steps are relative to. Chosen by hand, unmeasured.
const MIN_SCALE: f64 = 1e-2;

/// The errors of all samples and outputs, and their derivatives by the constants in units of scale.
#[derive(Default)]
struct Linearised {
    /// The index and the scale of each constant that matters.
    constants: Vec<(usize, f64)>,
    errors: Vec<f64>,
    slopes: Vec<Vec<f64>>,
}

impl Linearised {
    fn assign(
        &mut self,
        fitter: &mut Fitter,
        draft: &Draft,
        samples: &Samples,
        is_free: impl Fn(usize) -> bool,
        values: &mut Values,
    ) {
        fitter.derivative.assign_free(draft, is_free);
        fitter.tape.prepare(&fitter.derivative.program);
        fitter.evaluator.outputs_into(&fitter.tape, samples, values);
        let entries = &fitter.derivative.jacobian.entries[..samples.outputs()];
        let matters = |constant: &usize| {
            entries.iter().flatten().any(|&(parameter, _)| usize::from(parameter) == *constant)
        };
        let scale = |constant: usize| f64::from(draft.consts[constant].abs()).max(MIN_SCALE);
        self.constants = (0..draft.consts.len())
            .filter(matters)
            .map(|constant| (constant, scale(constant)))
            .collect();
        self.errors.clear();
        for output in 0..samples.outputs() {
            self.errors.extend(scaled(samples, values, output));
        }
        let weighed =
            |output| samples.weights(output).iter().map(|&weight| f64::from(weight).sqrt());
        self.slopes.clear();
        let mut constants = std::mem::take(&mut self.constants);
        constants.retain(|&(constant, scale)| {
            let mut slopes = vec![0.0; self.errors.len()];
            for (output, slopes) in slopes.chunks_mut(samples.rows()).enumerate() {
                let by_this = |entry: &&(u16, u16)| usize::from(entry.0) == constant;
                for &(_, at) in entries[output].iter().filter(by_this) {
                    let derivatives = values.column(usize::from(at)).iter().zip(weighed(output));
                    for (slope, (&derivative, weight)) in slopes.iter_mut().zip(derivatives) {
                        *slope = f64::from(derivative) * weight * scale;
                    }
                }
            }
            // One without a derivative somewhere, as at the end of a root, stays as it is.
            let has_all = slopes.iter().all(|slope| slope.is_finite());
            if has_all {
                self.slopes.push(slopes);
            }
            has_all
        });
        self.constants = constants;
    }

    /// Returns the best step within the trust region, in units of its radius, and the largest error
    /// that the linearisation predicts for it.
    fn step(&self, radius: f64) -> Option<(Vec<f64>, f64)> {
        let mut spread = vec![0.0; self.errors.len()];
        for slope in &self.slopes {
            spread.iter_mut().zip(slope).for_each(|(sum, slope)| *sum += (slope * radius).abs());
        }
        if !spread.iter().all(|spread| spread.is_finite()) {
            return None;
        }
        let sure = self.errors.iter().zip(&spread).map(|(error, spread)| error.abs() - spread);
        // A sample counts only if some step can bring its error up to the one that must remain.
        let sure = sure.fold(0.0, f64::max);
        let rows: Vec<usize> =
            (0..self.errors.len()).filter(|&i| self.errors[i].abs() + spread[i] >= sure).collect();
        let errors: Vec<f64> = rows.iter().map(|&i| self.errors[i]).collect();
        let scaled_down = |slope: &Vec<f64>| rows.iter().map(|&i| slope[i] * radius).collect();
        let slopes: Vec<Vec<f64>> = self.slopes.iter().map(scaled_down).collect();
        least_maximum(&errors, &slopes)
    }
}

/// Moves the constants by the solutions of at most `most` linear programs, and returns the largest
/// error, which is `best` before. Each makes the maximum error of the program, linearised at its
/// constants, least within a trust region (Madsen 1975, "An algorithm for minimax solution of
/// overdetermined systems of non-linear equations").
pub(super) fn by_linear_programs(
    fitter: &mut Fitter,
    draft: &mut Draft,
    samples: &Samples,
    most: u32,
    is_free: impl Fn(usize) -> bool + Copy,
    mut best: f64,
) -> f64 {
    let mut values = Values::default();
    let mut trial = draft.clone();
    let mut radius = FIRST_RADIUS;
    let mut linear = Linearised::default();
    let mut stale = true;
    for _ in 0..most {
        let done = !best.is_finite() || best == 0.0 || radius < MIN_RADIUS;
        if done || fitter.is_cut(samples) {
            break;
        }
        if stale {
            linear.assign(fitter, draft, samples, is_free, &mut values);
        }
        let Some((step, least)) = linear.step(radius) else { break };
        if least > best * (1.0 - MIN_GAIN) {
            break;
        }
        trial.copy_from(draft);
        for (&(constant, scale), step) in linear.constants.iter().zip(step) {
            trial.consts[constant] += (step * radius * scale) as f32;
        }
        let (_, largest) = errors(fitter, &trial, samples, &mut values);
        stale = largest < best;
        let gain = (best - largest) / (best - least);
        if stale {
            best = largest;
            draft.copy_from(&trial);
        }
        let change = match gain {
            gain if gain > 0.75 => 2.0,
            gain if gain > 0.25 => 1.0,
            gain if gain > 0.0 => 0.5,
            _ => 0.25,
        };
        radius = (radius * change).min(MAX_RADIUS);
    }
    best
}
