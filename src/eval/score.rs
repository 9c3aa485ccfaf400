//! The errors that are quoted.

use super::{Evaluator, Samples, Tape};
use crate::dataset::Dataset;
use crate::program::Program;
use serde::{Deserialize, Serialize};

/// Errors of one output, in its own unit.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct OutputError {
    pub rmse: f64,
    pub max: f64,
    /// Root mean square of the errors relative to the value; values below a thousandth of the output's
    /// largest count as that.
    pub relative: f64,
    /// Root mean square of what exceeds the errors that nobody sees; none where all errors count.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub visible: Option<f64>,
}

/// A program's errors on a dataset. What is not finite is infinite.
#[derive(Clone, Debug, PartialEq)]
pub struct Score {
    /// On the search split, unweighted, by output.
    pub search: Vec<OutputError>,
    /// On the validation split, weighted, by output.
    pub validation: Vec<OutputError>,
}

impl Score {
    /// Scores a program whose outputs are the dataset's, in order.
    ///
    /// # Panics
    /// If the numbers of inputs or outputs differ.
    pub fn of(program: &Program, dataset: &Dataset, evaluator: &mut Evaluator) -> Score {
        assert_eq!(program.outputs.len(), dataset.outputs.len(), "the dataset's outputs");
        let tape = Tape::new(program);
        let inputs = dataset.inputs.len();
        let mut errors = |split: &crate::dataset::Split, weight: &dyn Fn(usize) -> f64| {
            let samples = Samples::new(split, inputs);
            let values = evaluator.outputs(&tape, &samples);
            let targets = &split.columns[inputs..];
            let free = (0..values.len()).map(|o| split.free.get(o).map(Vec::as_slice));
            let pairs = values.iter().zip(targets).zip(free);
            pairs.map(|((f, y), free)| output_error(f, y, free, weight)).collect()
        };
        Score {
            search: errors(&dataset.search, &|_| 1.0),
            validation: errors(&dataset.validation, &|row| {
                f64::from(dataset.validation.weight(row))
            }),
        }
    }

    /// Whether the program is finite on every sample.
    pub fn is_finite(&self) -> bool {
        self.search.iter().chain(&self.validation).all(|e| e.rmse.is_finite() && e.max.is_finite())
    }
}

/// The root mean square of the outputs' RMSEs, and the largest of their maxima.
pub fn joint(errors: &[OutputError]) -> OutputError {
    let root_mean = |part: fn(&OutputError) -> f64| {
        (errors.iter().map(|e| part(e).powi(2)).sum::<f64>() / errors.len() as f64).sqrt()
    };
    OutputError {
        rmse: root_mean(|e| e.rmse),
        max: errors.iter().map(|e| e.max).fold(0.0, f64::max),
        relative: root_mean(|e| e.relative),
        visible: errors
            .iter()
            .all(|e| e.visible.is_some())
            .then(|| root_mean(|e| e.visible.unwrap_or(0.0))),
    }
}

/// The share of an output's largest value below which errors are no longer relative.
pub const RELATIVE_FLOOR: f64 = 1e-3;

fn output_error(
    values: &[f32],
    targets: &[f32],
    free: Option<&[f32]>,
    weight: &dyn Fn(usize) -> f64,
) -> OutputError {
    let largest = targets.iter().fold(f32::MIN_POSITIVE, |largest, y| largest.max(y.abs()));
    let floor = RELATIVE_FLOOR * f64::from(largest);
    let (mut squares, mut relative, mut visible) = (0.0, 0.0, 0.0);
    let (mut weights, mut max) = (0.0, 0.0f64);
    for (row, (&f, &y)) in values.iter().zip(targets).enumerate() {
        if !f.is_finite() {
            let infinite = f64::INFINITY;
            let visible = free.map(|_| infinite);
            return OutputError { rmse: infinite, max: infinite, relative: infinite, visible };
        }
        let difference = f64::from(f) - f64::from(y);
        squares += weight(row) * difference.powi(2);
        relative += weight(row) * (difference / f64::from(y).abs().max(floor)).powi(2);
        let hidden = free.map_or(0.0, |free| f64::from(free[row]));
        visible += weight(row) * (difference.abs() - hidden).max(0.0).powi(2);
        weights += weight(row);
        max = max.max(difference.abs());
    }
    let root_mean = |sum: f64| (sum / weights).sqrt();
    OutputError {
        rmse: root_mean(squares),
        max,
        relative: root_mean(relative),
        visible: free.map(|_| root_mean(visible)),
    }
}
