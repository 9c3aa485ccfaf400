//! What is minimised.

use crate::dataset::Split;
use crate::eval::{OutputError, RELATIVE_FLOOR, Samples};
use serde::{Deserialize, Serialize};
use std::fmt;
use std::str::FromStr;

/// The error that a search or a fit makes small.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Measure {
    /// Root mean square over the samples.
    #[default]
    Rmse,
    /// The largest absolute error ([`crate::fit::minimax`]).
    Max,
    /// Root mean square, the samples weighted as the dataset says.
    Weighted,
    /// Root mean square of the errors relative to the value; values below a thousandth of an output's
    /// largest count as that.
    Relative,
    /// As weighted, of what exceeds the errors that nobody sees.
    Visible,
}

impl Measure {
    pub const ALL: [Measure; 5] =
        [Measure::Rmse, Measure::Max, Measure::Weighted, Measure::Relative, Measure::Visible];

    /// What is made small where nothing else is asked for: weights that the data have are meant.
    pub fn usual(split: &Split) -> Measure {
        match (split.free.is_empty(), split.weights.is_empty()) {
            (false, _) => Measure::Visible,
            (true, false) => Measure::Weighted,
            (true, true) => Measure::Rmse,
        }
    }

    /// Samples of some rows of a split, weighted so that what is to be made small is
    /// their weighted sum of squares.
    ///
    /// # Panics
    /// As [`Samples::of_rows`].
    pub fn samples(self, split: &Split, inputs: usize, rows: &[u32]) -> Samples {
        let mut samples = Samples::of_rows(split, inputs, rows);
        for output in 0..samples.outputs() {
            let weights: Vec<f32> = match self {
                Measure::Weighted => continue,
                Measure::Visible => {
                    if let Some(free) = split.free.get(output) {
                        let free: Vec<f32> = rows.iter().map(|&row| free[row as usize]).collect();
                        samples.set_free(output, &free);
                    }
                    continue;
                }
                Measure::Rmse | Measure::Max => vec![1.0; samples.rows()],
                Measure::Relative => {
                    relative(samples.targets(output), &split.columns[inputs + output])
                }
            };
            samples.set_weights(output, &weights);
        }
        samples
    }

    /// [`Measure::samples`] of all rows.
    pub fn all_samples(self, split: &Split, inputs: usize) -> Samples {
        let rows: Vec<u32> = (0..split.rows() as u32).collect();
        self.samples(split, inputs, &rows)
    }
}

/// `1 / y²`, floored by the largest value of the whole column.
fn relative(targets: &[f32], column: &[f32]) -> Vec<f32> {
    let largest = column.iter().fold(f32::MIN_POSITIVE, |largest, y| largest.max(y.abs()));
    let weight = |y: &f32| (y.abs().max(RELATIVE_FLOOR as f32 * largest)).powi(-2);
    targets.iter().map(weight).collect()
}

impl OutputError {
    /// The error in some measure. On the validation split RMSE is weighted as the dataset says already.
    pub fn of(&self, measure: Measure) -> f64 {
        match measure {
            Measure::Rmse | Measure::Weighted => self.rmse,
            Measure::Max => self.max,
            Measure::Relative => self.relative,
            Measure::Visible => self.visible.unwrap_or(self.rmse),
        }
    }
}

impl fmt::Display for Measure {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(match self {
            Measure::Rmse => "rmse",
            Measure::Max => "max",
            Measure::Weighted => "weighted",
            Measure::Relative => "relative",
            Measure::Visible => "visible",
        })
    }
}

impl FromStr for Measure {
    type Err = String;

    fn from_str(text: &str) -> Result<Measure, String> {
        Measure::ALL.into_iter().find(|measure| measure.to_string() == text).ok_or_else(|| {
            let known: Vec<String> = Measure::ALL.iter().map(Measure::to_string).collect();
            format!("an error measure is one of {}", known.join(", "))
        })
    }
}
