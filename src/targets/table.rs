//! Makes the dataset of a function of a few inputs.

use super::sampling::{SAMPLING_SEED, sampling_of};
use super::{Error, Progress, Recipe};
use crate::dataset::{Axis, Dataset};
use crate::truth::{Grids, Value};

/// A target as a table.
pub(super) struct Table<'a> {
    pub recipe: &'a Recipe,
    /// The inputs; the first varies slowest.
    pub axes: &'a [Axis],
    /// The outputs' names and units.
    pub outputs: &'a [(&'static str, &'static str)],
    /// The points along each axis of the search grid.
    pub points: usize,
    /// The largest accepted estimated error.
    pub allowed_error: f64,
}

/// The values at a point, and the estimated absolute error of each.
pub(super) struct Sample<const N: usize> {
    pub values: [f64; N],
    pub error: f64,
}

impl Table<'_> {
    /// Makes the dataset as [`Grids`] says, the search split sampled as the recipe says.
    ///
    /// # Errors
    /// An estimated error above the allowed one.
    pub(super) fn dataset<const N: usize>(
        &self,
        progress: Progress,
        sample: impl Fn(&[f64]) -> Sample<N> + Sync,
    ) -> Result<Dataset, Error> {
        let grids = Grids {
            axes: self.axes,
            points: self.points,
            intervals: match self.axes.len() {
                1 => 1000,
                2 => 100,
                _ => 21,
            },
            ends: false,
            sampling: sampling_of(self.recipe),
            seed: self.recipe.count(SAMPLING_SEED.name) as u64,
            progress,
        };
        let (splits, error) = grids.splits(&|point: &[f64]| -> Result<Value, Error> {
            let Sample { values, error } = sample(point);
            self.check_accuracy(point, error)?;
            Ok(Value { outputs: values.to_vec(), error })
        })?;
        let error = power_of_ten_above(error);
        let origin = format!("estimated error below {error:.0e} before rounding to f32");
        Ok(Dataset::of_splits(
            self.recipe.target().name,
            self.recipe.origin(origin),
            self.axes.iter().map(Axis::column).collect(),
            self.outputs.iter().copied(),
            splits,
        )?)
    }

    fn check_accuracy(&self, point: &[f64], error: f64) -> Result<(), Error> {
        // An error of NaN is refused, too.
        if error <= self.allowed_error {
            return Ok(());
        }
        let place = self.axes.iter().zip(point).map(|(axis, at)| format!("{} = {at}", axis.name));
        Err(Error::Accuracy {
            target: self.recipe.target().name.into(),
            point: place.collect::<Vec<_>>().join(", "),
            error,
            allowed: self.allowed_error,
        })
    }
}

fn power_of_ten_above(value: f64) -> f64 {
    10.0_f64.powf(value.max(1e-16).log10().ceil())
}
