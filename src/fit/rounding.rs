//! Errors that no formula is to blame for: the data's rounding and standard errors.

use super::minimax::errors;
use super::{Fitter, Measure};
use crate::dataset::Split;
use crate::eval::{OutputError, Samples, Tape, Values, relative_floor};
use crate::program::{Draft, Program};

/// The error that counts as rounding, relative to a value: a law's data in `f32`, and the law
/// evaluated in `f32` at rounded inputs, differ by a few units of 2⁻²⁴.
const ROUNDING: f64 = 4.0 / (1 << 24) as f64;

/// A comparison of errors on samples: of two below the data's rounding, neither is the smaller.
#[derive(Debug)]
pub(super) struct Comparison<'a> {
    samples: &'a Samples,
    by_maximum: bool,
    /// By output, the weighted sum of squares or the largest error that counts as rounding or is
    /// within standard errors.
    rounding: Vec<f64>,
    values: Values,
}

impl<'a> Comparison<'a> {
    /// Makes a comparison of what a measure makes small.
    pub fn by(measure: Measure, samples: &'a Samples) -> Comparison<'a> {
        Comparison::new(samples, measure == Measure::Max)
    }

    /// Makes a comparison of weighted sums of squares.
    pub(crate) fn by_squares(samples: &'a Samples) -> Comparison<'a> {
        Comparison::new(samples, false)
    }

    /// Makes a comparison of largest errors.
    pub fn by_maximum(samples: &'a Samples) -> Comparison<'a> {
        Comparison::new(samples, true)
    }

    fn new(samples: &'a Samples, by_maximum: bool) -> Comparison<'a> {
        let rounding = (0..samples.outputs()).map(|output| {
            let targets = samples.targets(output);
            let uncertainty = Uncertainty {
                targets,
                floor: relative_floor(targets),
                standard_errors: samples.standard_errors(output),
            };
            let weights = samples.weights(output);
            match by_maximum {
                true => uncertainty.largest(|row| f64::from(weights[row]).sqrt()),
                false => uncertainty.sum_of_squares(|row| weights[row].into()),
            }
        });
        let rounding = rounding.collect();
        Comparison { samples, by_maximum, rounding, values: Values::default() }
    }

    pub fn samples(&self) -> &'a Samples {
        self.samples
    }

    /// Returns true if an error is no more than the rounding of all outputs.
    pub fn is_rounding(&self, error: f64) -> bool {
        match self.by_maximum {
            true => error <= self.rounding.iter().copied().fold(0.0, f64::max),
            false => error <= self.rounding.iter().sum(),
        }
    }

    /// Returns a draft's error, with that of each output raised to its rounding; infinite if an
    /// output is not finite.
    pub fn error(&mut self, fitter: &mut Fitter, draft: &Draft) -> f64 {
        if self.by_maximum {
            let (_, largest) = errors(fitter, draft, self.samples, &mut self.values);
            return self.rounding.iter().copied().fold(largest, f64::max);
        }
        let Ok(program) = Program::verify(draft.clone()) else { return f64::INFINITY };
        let loss = fitter.evaluator.loss(&Tape::new(&program), self.samples, f64::INFINITY);
        if !loss.total().is_finite() {
            return f64::INFINITY;
        }
        loss.sum_of_squares.iter().zip(&self.rounding).map(|(loss, least)| loss.max(*least)).sum()
    }
}

/// The errors of an output's values that no formula is to blame for.
struct Uncertainty<'a> {
    targets: &'a [f32],
    /// The least magnitude that rounding is relative to.
    floor: f64,
    standard_errors: Option<&'a [f32]>,
}

impl Uncertainty<'_> {
    fn rounding(&self, row: usize) -> f64 {
        ROUNDING * self.magnitude(row)
    }

    fn magnitude(&self, row: usize) -> f64 {
        f64::from(self.targets[row].abs()).max(self.floor)
    }

    fn standard_error(&self, row: usize) -> f64 {
        self.standard_errors.map_or(0.0, |errors| errors[row].into())
    }

    /// Returns a weighted sum of squared errors that the very law hardly exceeds: its mean, by
    /// rounding and standard errors, plus two of its standard deviations.
    fn sum_of_squares(&self, weight: impl Fn(usize) -> f64) -> f64 {
        let rows = || 0..self.targets.len();
        let variance = |row: usize| weight(row) * self.standard_error(row).powi(2);
        let mean = |row| (weight(row) * self.rounding(row).powi(2)).max(variance(row));
        let spread = (2.0 * rows().map(|row| variance(row).powi(2)).sum::<f64>()).sqrt();
        rows().map(mean).sum::<f64>() + 2.0 * spread
    }

    /// Returns a largest scaled error that the very law hardly exceeds: the largest of n normal
    /// errors is about √(2 ln n) standard errors.
    fn largest(&self, scale: impl Fn(usize) -> f64) -> f64 {
        let times = (2.0 * (self.targets.len() as f64).ln()).sqrt();
        let error = |row| self.rounding(row).max(times * self.standard_error(row)) * scale(row);
        (0..self.targets.len()).map(error).fold(0.0, f64::max)
    }
}

/// Returns the errors of an output on a split that no formula is to blame for: those of rounding,
/// and the standard errors of its values.
pub fn rounding_errors(split: &Split, inputs: usize, output: usize) -> OutputError {
    let targets = &split.columns[inputs + output];
    let uncertainty = Uncertainty {
        targets,
        floor: relative_floor(targets),
        standard_errors: split.standard_errors.get(output).map(Vec::as_slice),
    };
    let rows = targets.len().max(1) as f64;
    let weights = (0..targets.len()).map(|row| f64::from(split.weight(row))).sum::<f64>();
    let root = |weight: &dyn Fn(usize) -> f64, total: f64| {
        (uncertainty.sum_of_squares(weight) / total).sqrt()
    };
    let weighted = root(&|row| split.weight(row).into(), weights);
    OutputError {
        rmse: root(&|_| 1.0, rows),
        max: uncertainty.largest(|_| 1.0),
        relative: root(&|row| uncertainty.magnitude(row).powi(-2), rows),
        weighted: Some(weighted),
        visible: Some(weighted),
    }
}
