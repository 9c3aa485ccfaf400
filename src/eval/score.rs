//! The errors that are reported of a program.

use super::{Evaluator, Samples, Tape};
use crate::dataset::{Dataset, Split, joint_unit, output_units};
use crate::program::Program;
use serde::{Deserialize, Serialize};

/// The errors of one output, in its own unit.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct OutputError {
    /// The root mean square over the samples, without the user's weights.
    pub rmse: f64,
    /// The largest absolute error, unweighted.
    pub max: f64,
    /// The root mean square of the errors relative to the value; a value below a thousandth of the
    /// output's largest on the search split counts as that thousandth.
    pub relative: f64,
    /// The root mean square with the user's weights; none if there are no such weights.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub weighted: Option<f64>,
    /// As `weighted`, of the parts of errors beyond the dead zone; none if there is no dead zone.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub visible: Option<f64>,
}

/// A program's errors on a dataset, by output; infinite if any value is not finite.
///
/// If the search split has weights, those of both splits are the user's, and only
/// [`OutputError::weighted`] and [`OutputError::visible`] use them. If it has none, weights of the
/// validation split are the samples' shares of the domain, and every mean uses them.
///
/// ```
/// use lgp::dataset::{Dataset, axis};
/// use lgp::eval::{Evaluator, Score};
/// use lgp::program::{Names, parse};
///
/// let data = Dataset::sampled([axis("x", 0.0..=1.0)], ["y"], |[x]| [2.0 * x])?;
/// let program = parse("y = 2*x + 0.5", &Names::new(["x"], ["y"]))?;
/// let score = Score::of(&program, &data, &mut Evaluator::default());
/// assert!((score.joint_validation().max - 0.5).abs() < 1e-6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Score {
    /// The errors on the search split, by output.
    pub search: Vec<OutputError>,
    /// The errors on the validation split, by output.
    pub validation: Vec<OutputError>,
    /// The outputs' units ([`output_units`]).
    pub units: Vec<f64>,
}

impl Score {
    /// Scores a program whose outputs are the dataset's, in order.
    ///
    /// # Panics
    /// If the program and the dataset differ in the number of inputs or outputs.
    pub fn of(program: &Program, dataset: &Dataset, evaluator: &mut Evaluator) -> Score {
        let tape = Tape::new(program);
        let inputs = dataset.inputs.len();
        Score::of_values(dataset, |split| evaluator.outputs(&tape, &Samples::new(split, inputs)))
    }

    /// Scores values computed elsewhere: `outputs` returns those of a split, by output.
    ///
    /// # Panics
    /// If `outputs` returns another number of outputs than the dataset has.
    pub fn of_values(dataset: &Dataset, mut outputs: impl FnMut(&Split) -> Vec<Vec<f32>>) -> Score {
        let inputs = dataset.inputs.len();
        let is_weighted = !dataset.search.weights.is_empty();
        let mut errors = |split: &Split| {
            let values = outputs(split);
            assert_eq!(values.len(), dataset.outputs.len(), "the dataset's outputs");
            let of = |(output, values): (usize, &Vec<f32>)| {
                let column = inputs + output;
                let sampled = Sampled {
                    targets: &split.columns[column],
                    floor: relative_floor(&dataset.search.columns[column]),
                    dead_zone: split.dead_zone.get(output).map(Vec::as_slice),
                    split,
                    is_weighted,
                };
                sampled.error(values)
            };
            values.iter().enumerate().map(of).collect()
        };
        let (search, validation) = (errors(&dataset.search), errors(&dataset.validation));
        Score { search, validation, units: output_units(&dataset.outputs) }
    }

    /// Returns the errors over all outputs on the search split.
    pub fn joint_search(&self) -> OutputError {
        joint(&self.search, &self.units)
    }

    /// Returns the errors over all outputs on the validation split.
    pub fn joint_validation(&self) -> OutputError {
        joint(&self.validation, &self.units)
    }

    /// Returns errors by output, as this has them, over all outputs.
    pub fn joint(&self, errors: &[OutputError]) -> OutputError {
        joint(errors, &self.units)
    }

    /// Returns true if the program is finite on every sample.
    pub fn is_finite(&self) -> bool {
        self.search.iter().chain(&self.validation).all(|e| e.rmse.is_finite() && e.max.is_finite())
    }
}

/// Returns the root mean square of the outputs' RMSEs and the largest of their maxima. If units
/// differ, each output's errors count in its unit, or one would hide all others.
fn joint(errors: &[OutputError], units: &[f64]) -> OutputError {
    let joint = joint_unit(units);
    let alike = units.iter().all(|unit| *unit == joint);
    let unit = |output: usize| if alike { 1.0 } else { units[output] };
    let root_mean = |squares: f64| (squares / errors.len() as f64).sqrt();
    let mean = |part: &dyn Fn(&OutputError) -> f64| {
        root_mean(errors.iter().enumerate().map(|(o, e)| (part(e) / unit(o)).powi(2)).sum())
    };
    let mean_of_some = |part: fn(&OutputError) -> Option<f64>| {
        let known = errors.iter().all(|error| part(error).is_some());
        known.then(|| mean(&|error| part(error).unwrap_or(0.0)))
    };
    OutputError {
        rmse: mean(&|error| error.rmse),
        max: errors.iter().enumerate().map(|(o, e)| e.max / unit(o)).fold(0.0, f64::max),
        relative: root_mean(errors.iter().map(|error| error.relative.powi(2)).sum()),
        weighted: mean_of_some(|error| error.weighted),
        visible: mean_of_some(|error| error.visible),
    }
}

/// The share of an output's largest value below which errors are relative to that share instead.
/// Chosen by hand, unmeasured.
const RELATIVE_FLOOR: f64 = 1e-3;

/// Returns the least magnitude that errors are taken relative to, given an output's values on the
/// search split.
pub fn relative_floor(targets: &[f32]) -> f64 {
    let largest = targets.iter().fold(f32::MIN_POSITIVE, |largest, y| largest.max(y.abs()));
    RELATIVE_FLOOR * f64::from(largest)
}

/// An output's targets on a split.
struct Sampled<'a> {
    targets: &'a [f32],
    floor: f64,
    dead_zone: Option<&'a [f32]>,
    split: &'a Split,
    /// True if the split's weights are the user's.
    is_weighted: bool,
}

impl Sampled<'_> {
    fn error(&self, values: &[f32]) -> OutputError {
        let (mut plain, mut relative) = (Mean::default(), Mean::default());
        let (mut weighted, mut visible) = (Mean::default(), Mean::default());
        let mut max = 0.0f64;
        for (row, (&f, &y)) in values.iter().zip(self.targets).enumerate() {
            let error = if f.is_finite() { f64::from(f) - f64::from(y) } else { f64::INFINITY };
            let weight = f64::from(self.split.weight(row));
            let share = if self.is_weighted { 1.0 } else { weight };
            let dead_zone = self.dead_zone.map_or(0.0, |dead_zone| f64::from(dead_zone[row]));
            plain.add(share, error);
            relative.add(share, error / f64::from(y).abs().max(self.floor));
            weighted.add(weight, error);
            visible.add(weight, (error.abs() - dead_zone).max(0.0));
            max = max.max(error.abs());
        }
        OutputError {
            rmse: plain.root(),
            max,
            relative: relative.root(),
            weighted: self.is_weighted.then(|| weighted.root()),
            visible: self.dead_zone.map(|_| visible.root()),
        }
    }
}

/// A weighted mean of squares.
#[derive(Default)]
struct Mean {
    squares: f64,
    weights: f64,
    is_infinite: bool,
}

impl Mean {
    fn add(&mut self, weight: f64, value: f64) {
        // A sample of weight zero counts here, too.
        self.is_infinite |= value.is_infinite();
        self.squares += weight * value.powi(2);
        self.weights += weight;
    }

    fn root(&self) -> f64 {
        if self.is_infinite { f64::INFINITY } else { (self.squares / self.weights).sqrt() }
    }
}
