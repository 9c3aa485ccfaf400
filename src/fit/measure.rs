//! The error measures that searches and fits make small.

use crate::dataset::Split;
use crate::eval::{OutputError, Samples, relative_floor};
use serde::{Deserialize, Serialize};
use std::fmt;
use std::str::FromStr;

/// The error that a search or a fit makes small.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Measure {
    /// The root mean square over the samples.
    #[default]
    Rmse,
    /// The largest absolute error ([`crate::fit::minimax`]).
    Max,
    /// The root mean square with the dataset's weights.
    Weighted,
    /// The root mean square of the errors relative to the value; a value below a thousandth of the
    /// output's largest counts as that thousandth.
    Relative,
    /// As `Weighted`, of the parts of errors beyond the dead zone.
    Visible,
}

impl Measure {
    /// Every measure.
    pub const ALL: [Measure; 5] =
        [Measure::Rmse, Measure::Max, Measure::Weighted, Measure::Relative, Measure::Visible];

    /// Returns the default measure of a split: one that uses the dead zones or weights that it has.
    pub fn usual(split: &Split) -> Measure {
        match (split.dead_zone.is_empty(), split.weights.is_empty()) {
            (false, _) => Measure::Visible,
            (true, false) => Measure::Weighted,
            (true, true) => Measure::Rmse,
        }
    }

    /// Lays out some rows of a split, weighted for this measure: the root of the weighted sum of
    /// squares over [`Samples::total_weight`] is the error that [`OutputError::of`] gives over all
    /// outputs (for [`Measure::Max`], the RMSE). `units` has one entry per output
    /// ([`crate::dataset::output_units`]), in which its errors count; relative errors have none.
    ///
    /// # Panics
    /// As [`Samples::of_rows`].
    pub fn samples(self, split: &Split, inputs: usize, rows: &[u32], units: &[f64]) -> Samples {
        let mut samples = Samples::of_rows(split, inputs, rows);
        let count = (samples.rows() * samples.outputs()) as f64;
        let total = match self {
            Measure::Weighted | Measure::Visible => samples.total_weight(),
            Measure::Rmse | Measure::Max | Measure::Relative => count,
        };
        for (output, unit) in units.iter().enumerate().take(samples.outputs()) {
            let by_unit = (1.0 / unit.clamp(MIN_UNIT, 1.0 / MIN_UNIT).powi(2)) as f32;
            let given = samples.weights(output).iter();
            let weights: Vec<f32> = match self {
                Measure::Weighted | Measure::Visible => given.map(|w| w * by_unit).collect(),
                Measure::Rmse | Measure::Max => vec![by_unit; samples.rows()],
                Measure::Relative => {
                    relative(samples.targets(output), &split.columns[inputs + output])
                }
            };
            samples.set_weights(output, &weights);
            if let (Measure::Visible, Some(dead_zone)) = (self, split.dead_zone.get(output)) {
                let dead_zone: Vec<f32> = rows.iter().map(|&row| dead_zone[row as usize]).collect();
                samples.set_dead_zone(output, &dead_zone);
            }
        }
        samples.set_total_weight(total);
        samples
    }

    /// As [`Measure::samples`], with all rows.
    pub fn all_samples(self, split: &Split, inputs: usize, units: &[f64]) -> Samples {
        let rows: Vec<u32> = (0..split.rows() as u32).collect();
        self.samples(split, inputs, &rows, units)
    }
}

/// The smallest unit, and the inverse of the largest, such that `1 / unit²` stays within `f32`.
const MIN_UNIT: f64 = 1.0 / (1u64 << 60) as f64;

/// Returns the weights `1 / y²`, with `|y|` at least the [`relative_floor`] of the whole column.
fn relative(targets: &[f32], column: &[f32]) -> Vec<f32> {
    let floor = relative_floor(column);
    targets.iter().map(|y| f64::from(y.abs()).max(floor).powi(-2) as f32).collect()
}

impl OutputError {
    /// Returns the error in a measure: the very quantity that a search or a fit by it makes small.
    pub fn of(&self, measure: Measure) -> f64 {
        let weighted = self.weighted.unwrap_or(self.rmse);
        match measure {
            Measure::Rmse => self.rmse,
            Measure::Max => self.max,
            Measure::Weighted => weighted,
            Measure::Relative => self.relative,
            Measure::Visible => self.visible.unwrap_or(weighted),
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
