//! What no formula can win: errors below the rounding of the data.

use super::Fitter;
use super::minimax::errors;
use crate::eval::{OutputError, Samples, Tape, Values, relative_floor};
use crate::program::{Draft, Program};

/// The error that is rounding, relative to a value: data in `f32` of a law, and the law evaluated in `f32` at
/// inputs rounded to it, differ by a few units of 2⁻²⁴.
const ROUNDING: f64 = 4.0 / (1 << 24) as f64;

/// How errors on some samples compare: of two below the data's rounding neither is the smaller.
#[derive(Debug)]
pub(super) struct Comparison<'a> {
    samples: &'a Samples,
    by_maximum: bool,
    /// By output: the weighted sum of squares, or the largest error, that is rounding.
    rounding: Vec<f64>,
    values: Values,
}

impl<'a> Comparison<'a> {
    /// Of weighted sums of squares.
    pub fn by_squares(samples: &'a Samples) -> Comparison<'a> {
        Comparison::new(samples, false)
    }

    /// Of largest errors.
    pub fn by_maximum(samples: &'a Samples) -> Comparison<'a> {
        Comparison::new(samples, true)
    }

    fn new(samples: &'a Samples, by_maximum: bool) -> Comparison<'a> {
        let squares = |output: usize| {
            let weighed = samples.targets(output).iter().zip(samples.weights(output));
            let floor = relative_floor(samples.targets(output));
            weighed.map(move |(&y, &weight)| f64::from(weight) * rounding_of(y, floor).powi(2))
        };
        let rounding = (0..samples.outputs()).map(|output| match by_maximum {
            true => squares(output).fold(0.0, f64::max).sqrt(),
            false => squares(output).sum(),
        });
        let rounding = rounding.collect();
        Comparison { samples, by_maximum, rounding, values: Values::default() }
    }

    pub fn samples(&self) -> &'a Samples {
        self.samples
    }

    /// A draft's error, that of each output at least its rounding; infinite where an output is not finite.
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

/// The errors that are rounding, of an output with these values.
pub fn rounding_errors(values: &[f32]) -> OutputError {
    let floor = relative_floor(values);
    let largest = values.iter().map(|&y| rounding_of(y, floor)).fold(0.0, f64::max);
    let squares = values.iter().map(|&y| rounding_of(y, floor).powi(2)).sum::<f64>();
    let rmse = (squares / values.len().max(1) as f64).sqrt();
    let (weighted, visible) = (Some(rmse), Some(rmse));
    OutputError { rmse, max: largest, relative: ROUNDING, weighted, visible }
}

/// Of a value, where errors below `floor` are not relative.
fn rounding_of(y: f32, floor: f64) -> f64 {
    ROUNDING * f64::from(y.abs()).max(floor)
}
