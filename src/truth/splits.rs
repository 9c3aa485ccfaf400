//! The rows of a function: where it is evaluated for either split.

use super::parallel::in_parallel;
use super::sampling::{self, MOST_AXES, Samples, Sampling, adaptive, jittered, low_discrepancy};
use crate::dataset::{Axis, Spacing, Split, combinations, grid_weights};
use std::sync::atomic::{AtomicUsize, Ordering};

/// A function called with the work units done so far and their total, from any thread.
pub type Progress<'a> = &'a (dyn Fn(usize, usize) + Sync);

/// The values of a function at a point.
#[derive(Clone, Debug)]
pub struct Value {
    /// The outputs.
    pub outputs: Vec<f64>,
    /// The estimated absolute error of each.
    pub error: f64,
}

/// The grids on which a function of a few inputs is sampled. The search split: the cell centres of
/// a regular grid, unweighted, or as the sampling says. The validation split: the nodes of another,
/// denser grid, edges included, weighted by area (trapezoidal, mean 1). The two share no point.
pub struct Grids<'a> {
    /// The inputs, at most [`MOST_AXES`]; the first varies slowest.
    pub axes: &'a [Axis],
    /// The points along each axis of the search grid.
    pub points: usize,
    /// True if the ends of each axis are in the search split, too, so that a maximum there counts;
    /// the domain's corners are then in both splits.
    pub ends: bool,
    /// The intervals along each axis of the validation grid, about.
    pub intervals: usize,
    /// The places of the search split's samples.
    pub sampling: Sampling,
    /// The seed of random ones.
    pub seed: u64,
    /// Called as the work goes on.
    pub progress: Progress<'a>,
}

impl Grids<'_> {
    /// Evaluates a function for the search and the validation split, on all of rayon's threads;
    /// returns the largest estimated error, too.
    ///
    /// # Errors
    /// The first of the function's own, in the order of rows.
    pub fn splits<E: Send>(
        &self,
        function: &(impl Fn(&[f64]) -> Result<Value, E> + Sync),
    ) -> Result<([Split; 2], f64), E> {
        let intervals = intervals_between(self.points, self.intervals);
        let along = |points: &dyn Fn(&Axis) -> Vec<f32>| -> Vec<Vec<f32>> {
            self.axes.iter().map(points).collect()
        };
        let centres = along(&|axis| match self.ends {
            true => with_ends(axis, axis.centres(self.points), self.axes.len() == 1),
            false => axis.centres(self.points),
        });
        let nodes = along(&|axis| axis.nodes(intervals));
        let axes = self.axes.len();
        let splits_of_points = if self.sampling == Sampling::Adaptive { 2 } else { 1 };
        let total = splits_of_points * self.points + intervals + 1;
        let rows = Rows { axes: self.axes, progress: self.progress, done: 0.into(), total };
        let (search, search_error) = match self.sampling {
            Sampling::Regular => rows.on_grid(&centres, function)?,
            Sampling::Jittered => {
                rows.scattered(jittered(self.points, axes, self.seed), self.points, function)?
            }
            Sampling::LowDiscrepancy => {
                let samples = low_discrepancy(0..sampling::count(self.points, axes), axes);
                rows.scattered(samples, self.points, function)?
            }
            Sampling::Adaptive => {
                let (pilot, _) = rows.on_grid(&centres, function)?;
                let samples = adaptive(self.points, axes, &pilot.columns[axes..], self.seed);
                rows.scattered(samples, self.points, function)?
            }
        };
        let (mut validation, validation_error) = rows.on_grid(&nodes, function)?;
        validation.weights = area_weights(self.axes, &nodes);
        Ok(([search, validation], search_error.max(validation_error)))
    }
}

/// As [`Grids::splits`], for functions of more inputs: Sobol's points, in the validation split
/// twice as many and the domain's corners.
pub fn scattered_splits<E: Send>(
    axes: &[Axis],
    count: usize,
    progress: Progress,
    function: &(impl Fn(&[f64]) -> Result<Value, E> + Sync),
) -> Result<([Split; 2], f64), E> {
    let count = count as u64;
    let total = 3 * SLICES;
    let rows = Rows { axes, progress, done: 0.into(), total };
    let samples = low_discrepancy(0..count, axes.len());
    let (search, search_error) = rows.scattered(samples, SLICES, function)?;
    let mut samples = low_discrepancy(count..3 * count, axes.len());
    samples.weights = vec![1.0; samples.points.len()];
    let ends = vec![vec![0.0, 1.0]; axes.len().min(MOST_CORNERED)];
    for mut corner in combinations(&ends) {
        corner.resize(axes.len(), 0.5);
        samples.points.push(corner.into_iter().map(f64::from).collect());
        // As a node of a grid, of which a corner has one of so many quarters.
        samples.weights.push(1.0 / f64::from(1u32 << axes.len().min(MOST_AXES)) as f32);
    }
    let (validation, validation_error) = rows.scattered(samples, 2 * SLICES, function)?;
    Ok(([search, validation], search_error.max(validation_error)))
}

/// The work units of scattered samples. By hand: a step of progress.
const SLICES: usize = 64;
/// The inputs whose ends are combined to corners: 1024 of them. By hand.
const MOST_CORNERED: usize = 10;

/// Adds an axis's ends to points along it; where rows are few, also points ever nearer to the ends,
/// by halves: there is what roots and logarithms have between the last centre and the end.
fn with_ends(axis: &Axis, centres: Vec<f32>, closely: bool) -> Vec<f32> {
    let steps = (1..25).map(|step| 0.5_f64.powi(step));
    let near: Vec<f64> = steps.filter(|u| closely && *u < 0.5 / centres.len() as f64).collect();
    let low = near.iter().rev().map(|&u| axis.at(u));
    let high = near.iter().map(|&u| axis.at(1.0 - u));
    let ends = [axis.at(0.0), axis.at(1.0)];
    let mut points: Vec<f32> =
        ends[..1].iter().copied().chain(low).chain(centres).chain(high).chain([ends[1]]).collect();
    // Near an end of 1 there are fewer numbers than halves.
    points.dedup();
    points
}

/// Evaluates a function at many points.
struct Rows<'a> {
    axes: &'a [Axis],
    progress: Progress<'a>,
    done: AtomicUsize,
    total: usize,
}

impl Rows<'_> {
    /// Evaluates the function on a full grid.
    fn on_grid<E: Send>(
        &self,
        along: &[Vec<f32>],
        function: &(impl Fn(&[f64]) -> Result<Value, E> + Sync),
    ) -> Result<(Split, f64), E> {
        let (mut split, error) = self.at(&combinations(along), along[0].len(), function)?;
        split.grid = along.iter().map(Vec::len).collect();
        Ok((split, error))
    }

    /// Evaluates the function at points of the unit cube.
    fn scattered<E: Send>(
        &self,
        samples: Samples,
        slices: usize,
        function: &(impl Fn(&[f64]) -> Result<Value, E> + Sync),
    ) -> Result<(Split, f64), E> {
        let at = |point: &Vec<f64>| -> Vec<f32> {
            self.axes.iter().zip(point).map(|(axis, &u)| axis.at(u)).collect()
        };
        let points: Vec<Vec<f32>> = samples.points.iter().map(at).collect();
        let (mut split, error) = self.at(&points, slices, function)?;
        split.weights = samples.weights;
        Ok((split, error))
    }

    /// Evaluates the function at points, in slices of equal size.
    fn at<E: Send>(
        &self,
        points: &[Vec<f32>],
        slices: usize,
        function: &(impl Fn(&[f64]) -> Result<Value, E> + Sync),
    ) -> Result<(Split, f64), E> {
        let at = |point: &Vec<f32>| {
            let point: Vec<f64> = point.iter().copied().map(f64::from).collect();
            function(&point)
        };
        let slices: Vec<&[Vec<f32>]> = points.chunks(points.len().div_ceil(slices)).collect();
        let evaluated = in_parallel(&slices, |slice| {
            let values = slice.iter().map(at).collect::<Result<Vec<Value>, E>>();
            self.one_more();
            values
        });
        let values = evaluated?.concat();
        let outputs = values.first().map_or(0, |value| value.outputs.len());
        let mut columns = vec![Vec::with_capacity(points.len()); self.axes.len() + outputs];
        let mut largest_error = 0.0_f64;
        for (point, value) in points.iter().zip(values) {
            largest_error = largest_error.max(value.error);
            let row = point.iter().copied().chain(value.outputs.iter().map(|&value| value as f32));
            columns.iter_mut().zip(row).for_each(|(column, value)| column.push(value));
        }
        Ok((Split { columns, ..Split::default() }, largest_error))
    }

    fn one_more(&self) {
        let done = self.done.fetch_add(1, Ordering::Relaxed) + 1;
        (self.progress)(done, self.total);
    }
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

fn area_weights(axes: &[Axis], along: &[Vec<f32>]) -> Vec<f32> {
    let lengths = axes.iter().zip(along).map(|(axis, nodes)| lengths(axis, nodes));
    grid_weights(&lengths.collect::<Vec<_>>())
}

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
        let nodes: Vec<_> = axes.iter().map(|axis| axis.nodes(100)).collect();
        let weights = area_weights(&axes, &nodes);
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
