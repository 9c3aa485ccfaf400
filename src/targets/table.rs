//! Makes the dataset of a function of a few inputs.

use super::sampling::{SAMPLING_SEED, sampling_of};
use super::{Error, Progress, Recipe};
use crate::dataset::{Axis, Dataset};
use crate::truth::{self, Grids, Truth, Value};
use std::sync::Arc;

/// A target as a function of a few inputs.
#[derive(Clone)]
pub(super) struct Table {
    recipe: Recipe,
    /// The inputs; the first varies slowest.
    axes: Vec<Axis>,
    /// The outputs' names and units.
    outputs: &'static [(&'static str, &'static str)],
    /// The largest accepted estimated error.
    allowed_error: f64,
    claims: Vec<&'static str>,
    function: Function,
}

type Function = Arc<dyn Fn(&[f64]) -> Value + Send + Sync>;

/// The values at a point, and the estimated absolute error of each.
pub(super) struct Sample<const N: usize> {
    pub values: [f64; N],
    pub error: f64,
}

impl Table {
    /// Makes a table of the recipe's target. An estimated error above the allowed one fails the
    /// generation.
    pub fn new<const N: usize>(
        recipe: &Recipe,
        axes: Vec<Axis>,
        outputs: &'static [(&'static str, &'static str); N],
        allowed_error: f64,
        sample: impl Fn(&[f64]) -> Sample<N> + Send + Sync + 'static,
    ) -> Table {
        let function = move |point: &[f64]| {
            let Sample { values, error } = sample(point);
            Value { outputs: values.to_vec(), error }
        };
        Table {
            recipe: recipe.clone(),
            axes,
            outputs,
            allowed_error,
            claims: Vec::new(),
            function: Arc::new(function),
        }
    }

    /// Adds what must hold of every formula.
    pub fn claiming(self, claim: &'static str) -> Table {
        Table { claims: [self.claims, vec![claim]].concat(), ..self }
    }

    /// Makes the dataset as [`Grids`] says, the search split sampled as the recipe says.
    ///
    /// # Errors
    /// An estimated error above the allowed one.
    pub fn dataset(&self, progress: Progress) -> Result<Dataset, Error> {
        let grids = Grids {
            axes: &self.axes,
            points: self.recipe.count("points"),
            intervals: match self.axes.len() {
                1 => 1000,
                2 => 100,
                _ => 21,
            },
            ends: false,
            sampling: sampling_of(&self.recipe),
            seed: self.recipe.count(SAMPLING_SEED.name) as u64,
            progress,
        };
        let (splits, error) = grids.splits(&|point: &[f64]| -> Result<Value, Error> {
            let value = (self.function)(point);
            self.check_accuracy(point, value.error)?;
            Ok(value)
        })?;
        let error = power_of_ten_above(error);
        let origin = format!("estimated error below {error:.0e} before rounding to f32");
        let mut dataset = Dataset::of_splits(
            self.recipe.target().name,
            self.recipe.origin(origin),
            self.axes.iter().map(Axis::column).collect(),
            self.outputs.iter().copied(),
            splits,
        )?;
        self.claims.iter().try_for_each(|claim| dataset.claim(claim))?;
        Ok(dataset)
    }

    /// Returns the function, whose values have an estimated error of at most the allowed one.
    ///
    /// # Errors
    /// As [`Truth::new`].
    pub fn truth(&self) -> Result<Truth, truth::Error> {
        let table = self.clone();
        let function = move |point: &[f64]| {
            let value = (table.function)(point);
            let checked = table.check_accuracy(point, value.error);
            checked.map(|()| value.outputs).map_err(|error| error.to_string())
        };
        Truth::new(
            self.recipe.target().name.to_owned(),
            self.axes.clone(),
            self.outputs.iter().map(|(name, _)| (*name).to_owned()).collect(),
            self.recipe.origin(String::new()),
            Arc::new(function),
        )
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
