//! Makes the dataset of a function of a few inputs.

use super::sampling::{SAMPLING_SEED, Samples, Sampling, adaptive, jittered, low_discrepancy};
use super::{Error, Progress, Recipe};
use crate::dataset::{Axis, Dataset, Spacing, Split, combinations, grid_weights};
use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Returns the length each node stands for (trapezoidal rule), scaled to mean 1.
fn lengths(axis: &Axis, nodes: &[f32]) -> Vec<f64> {
    let last = nodes.len().saturating_sub(1);
    // A coordinate whose differences are the axis's lengths.
    let node = |index: usize| match axis.spacing {
        Spacing::Linear => f64::from(nodes[index]),
        Spacing::Logarithmic => f64::from(nodes[index]).ln(),
    };
    let lengths: Vec<f64> = (0..nodes.len())
        .map(|i| 0.5 * (node((i + 1).min(last)) - node(i.saturating_sub(1))))
        .collect();
    let mean = lengths.iter().sum::<f64>() / lengths.len() as f64;
    lengths.iter().map(|length| length / mean).collect()
}

/// Returns about as many intervals as asked for, whose ends meet no centre of `points` cells: k/100
/// cannot meet those of 4m cells, nor k/n with n odd any, whose denominators are even.
fn intervals_between(points: usize, about: usize) -> usize {
    match about {
        100 if points.is_multiple_of(4) => 100,
        odd if odd % 2 == 1 => odd,
        even => even + 1,
    }
}

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
    /// Makes the dataset: search split at the cell centres of a regular grid, unweighted, or as the
    /// recipe's sampling says; validation split at the nodes of another, denser grid, edges
    /// included, weighted by area (trapezoidal, mean 1). The two grids share no point.
    ///
    /// # Errors
    /// An estimated error above the allowed one.
    pub(super) fn dataset<const N: usize>(
        &self,
        progress: Progress,
        sample: impl Fn(&[f64]) -> Sample<N> + Sync,
    ) -> Result<Dataset, Error> {
        let about = match self.axes.len() {
            1 => 1000,
            2 => 100,
            _ => 21,
        };
        let intervals = intervals_between(self.points, about);
        let along = |points: &dyn Fn(&Axis) -> Vec<f32>| -> Vec<Vec<f32>> {
            self.axes.iter().map(points).collect()
        };
        let centres = along(&|axis| axis.centres(self.points));
        let nodes = along(&|axis| axis.nodes(intervals));
        let sampling = Sampling::of(self.recipe);
        let splits_of_points = if sampling == Sampling::Adaptive { 2 } else { 1 };
        let total = splits_of_points * self.points + intervals + 1;
        let tick = Tick { progress, done: AtomicUsize::new(0), total };
        let (search, search_error) = match sampling {
            Sampling::Regular => self.grid(&centres, &sample, &tick)?,
            Sampling::Jittered => {
                let samples = jittered(self.points, self.axes.len(), self.sampling_seed());
                self.scattered(samples, &sample, &tick)?
            }
            Sampling::LowDiscrepancy => {
                self.scattered(low_discrepancy(self.points, self.axes.len()), &sample, &tick)?
            }
            Sampling::Adaptive => {
                let (pilot, _) = self.grid(&centres, &sample, &tick)?;
                let outputs = &pilot.columns[self.axes.len()..];
                let samples = adaptive(self.points, self.axes.len(), outputs, self.sampling_seed());
                self.scattered(samples, &sample, &tick)?
            }
        };
        let (mut validation, validation_error) = self.grid(&nodes, &sample, &tick)?;
        validation.weights = self.area_weights(&nodes);
        let error = power_of_ten_above(search_error.max(validation_error));
        let origin = format!("estimated error below {error:.0e} before rounding to f32");
        Ok(Dataset::of_splits(
            self.recipe.target().name,
            self.recipe.origin(origin),
            self.axes.iter().map(Axis::column).collect(),
            self.outputs.iter().copied(),
            [search, validation],
        )?)
    }

    fn sampling_seed(&self) -> u64 {
        self.recipe.count(SAMPLING_SEED.name) as u64
    }

    /// Evaluates the function on a full grid; returns the largest estimated error, too.
    fn grid<const N: usize>(
        &self,
        along: &[Vec<f32>],
        sample: &(impl Fn(&[f64]) -> Sample<N> + Sync),
        tick: &Tick,
    ) -> Result<(Split, f64), Error> {
        let (mut split, error) = self.split(&combinations(along), along[0].len(), sample, tick)?;
        split.grid = along.iter().map(Vec::len).collect();
        Ok((split, error))
    }

    /// Evaluates the function at points of the unit cube.
    fn scattered<const N: usize>(
        &self,
        samples: Samples,
        sample: &(impl Fn(&[f64]) -> Sample<N> + Sync),
        tick: &Tick,
    ) -> Result<(Split, f64), Error> {
        let at = |point: &Vec<f64>| -> Vec<f32> {
            self.axes.iter().zip(point).map(|(axis, &u)| axis.at(u)).collect()
        };
        let points: Vec<Vec<f32>> = samples.points.iter().map(at).collect();
        let (mut split, error) = self.split(&points, self.points, sample, tick)?;
        split.weights = samples.weights;
        Ok((split, error))
    }

    /// Evaluates the function at points, in slices of equal size.
    fn split<const N: usize>(
        &self,
        points: &[Vec<f32>],
        slices: usize,
        sample: &(impl Fn(&[f64]) -> Sample<N> + Sync),
        tick: &Tick,
    ) -> Result<(Split, f64), Error> {
        let at = |point: &Vec<f32>| {
            let point: Vec<f64> = point.iter().copied().map(f64::from).collect();
            sample(&point)
        };
        let slices: Vec<Vec<Sample<N>>> = points
            .par_chunks(points.len().div_ceil(slices))
            .map(|slice| {
                let slice = slice.iter().map(at).collect();
                tick.one_more();
                slice
            })
            .collect();
        let mut columns = vec![Vec::with_capacity(points.len()); self.axes.len() + N];
        let mut largest_error = 0.0_f64;
        for (point, sample) in points.iter().zip(slices.iter().flatten()) {
            self.check_accuracy(point, sample.error)?;
            largest_error = largest_error.max(sample.error);
            let row = point.iter().copied().chain(sample.values.map(|value| value as f32));
            columns.iter_mut().zip(row).for_each(|(column, value)| column.push(value));
        }
        Ok((Split { columns, ..Split::default() }, largest_error))
    }

    fn area_weights(&self, along: &[Vec<f32>]) -> Vec<f32> {
        let lengths = self.axes.iter().zip(along).map(|(axis, nodes)| lengths(axis, nodes));
        grid_weights(&lengths.collect::<Vec<_>>())
    }

    fn check_accuracy(&self, point: &[f32], error: f64) -> Result<(), Error> {
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

struct Tick<'a> {
    progress: Progress<'a>,
    done: AtomicUsize,
    total: usize,
}

impl Tick<'_> {
    fn one_more(&self) {
        let done = self.done.fetch_add(1, Ordering::Relaxed) + 1;
        (self.progress)(done, self.total);
    }
}

fn power_of_ten_above(value: f64) -> f64 {
    10.0_f64.powf(value.max(1e-16).log10().ceil())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn distance() -> Axis {
        Axis { domain: [0.25, 4.0], spacing: Spacing::Logarithmic, ..Axis::unit("distance") }
    }

    #[test]
    fn nodes_are_never_cell_centres() {
        let axis = Axis::unit("x");
        for points in 1..=1024 {
            let centres = axis.centres(points);
            for about in [20, 21, 100] {
                let nodes = axis.nodes(intervals_between(points, about));
                assert!(centres.iter().all(|centre| !nodes.contains(centre)), "{points}");
                assert_eq!([nodes[0], nodes[nodes.len() - 1]], [0.0, 1.0]);
            }
        }
    }

    #[test]
    fn edges_weigh_half_and_corners_a_quarter() {
        let axes = [Axis::unit("x"), distance()];
        let recipe = Recipe::new("dfg").unwrap();
        let table =
            Table { recipe: &recipe, axes: &axes, outputs: &[], points: 64, allowed_error: 0.0 };
        let nodes: Vec<_> = axes.iter().map(|axis| axis.nodes(100)).collect();
        let weights = table.area_weights(&nodes);
        let inside = f64::from(weights[50 * 101 + 50]);
        assert!((f64::from(weights[50]) / inside - 0.5).abs() < 1e-6);
        assert!((f64::from(weights[0]) / inside - 0.25).abs() < 1e-6);
        let mean = weights.iter().copied().map(f64::from).sum::<f64>() / weights.len() as f64;
        assert!((mean - 1.0).abs() < 1e-7);
    }

    #[test]
    fn logarithmic_axes_have_equal_ratios() {
        let nodes = distance().nodes(4);
        assert_eq!(nodes, [0.25, 0.5, 1.0, 2.0, 4.0]);
    }
}
