//! A dataset as a table that can be read anywhere.

use crate::dataset::Dataset;
use serde::Serialize;

/// The grid of a dataset, interpolated linearly; that of the validation split if it is one, since
/// it reaches the domain's edges.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SphereTable {
    /// Points along each input, the first varying slowest.
    grid: Vec<usize>,
    /// By input: the first three places (the first may be closer to the second than others are to
    /// each other), and the last.
    axes: Vec<[f32; 4]>,
    /// The values by output.
    values: Vec<Vec<f32>>,
}

impl SphereTable {
    /// Returns none if neither split is a grid, or its places are not evenly spaced except for the
    /// first.
    pub fn of(dataset: &Dataset) -> Option<SphereTable> {
        let inputs = dataset.inputs.len();
        let splits = [&dataset.validation, &dataset.search];
        let split = splits.into_iter().find(|split| split.grid.len() == inputs)?;
        let mut axes = Vec::new();
        for (axis, column) in split.columns[..inputs].iter().enumerate() {
            let (points, below) =
                (split.grid[axis], split.grid[axis + 1..].iter().product::<usize>());
            let place = |i: usize| column[i * below];
            if points < 4 {
                return None;
            }
            let step = (place(points - 1) - place(1)) / (points - 2) as f32;
            let even =
                |i: usize| (place(i) - (place(1) + step * (i - 1) as f32)).abs() < 0.01 * step;
            if !(1..points).all(even) {
                return None;
            }
            axes.push([place(0), place(1), place(2), place(points - 1)]);
        }
        let values = split.columns[inputs..].to_vec();
        Some(SphereTable { grid: split.grid.clone(), axes, values })
    }

    /// Returns the outputs at rows of inputs.
    pub(super) fn read(&self, inputs: &[Vec<f32>]) -> Vec<Vec<f32>> {
        let rows = inputs.first().map_or(0, Vec::len);
        let mut outputs = vec![Vec::with_capacity(rows); self.values.len()];
        for row in 0..rows {
            let places = inputs.iter().map(|column| column[row]);
            let cells: Vec<(usize, f32)> =
                places.enumerate().map(|(axis, place)| self.cell(axis, place)).collect();
            for (values, output) in self.values.iter().zip(&mut outputs) {
                output.push(self.between(values, &cells));
            }
        }
        outputs
    }

    /// Returns the point below a place, and the fraction of the way to the next.
    fn cell(&self, axis: usize, place: f32) -> (usize, f32) {
        let [first, second, third, last] = self.axes[axis];
        if place < second {
            return (0, ((place - first) / (second - first)).clamp(0.0, 1.0));
        }
        let along = (place.min(last) - second) / (third - second);
        let low = (along.floor() as usize).min(self.grid[axis] - 3);
        (low + 1, (along - low as f32).clamp(0.0, 1.0))
    }

    fn between(&self, values: &[f32], cells: &[(usize, f32)]) -> f32 {
        let mut sum = 0.0;
        for corner in 0..1usize << cells.len() {
            let (mut index, mut weight) = (0, 1.0);
            for (axis, (low, part)) in cells.iter().enumerate() {
                let upper = corner >> axis & 1;
                weight *= if upper == 1 { *part } else { 1.0 - part };
                index = index * self.grid[axis] + low + upper;
            }
            sum += weight * values[index];
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dataset::{Column, Origin, Split};

    #[test]
    fn a_bilinear_function_is_exact_up_to_an_edge_that_was_moved_in() {
        let places = [vec![0.25, 1.0, 2.0, 3.0], vec![0.0, 1.0, 2.0, 3.0, 4.0]];
        let f = |x: f32, y: f32| x + 2.0 * y + 0.5 * x * y;
        let split = Split::on_grid(&places, |p| [f(p[0] as f32, p[1] as f32).into()]);
        let (inputs, splits) =
            (["x", "y"].map(|name| Column::new(name, [0.0, 4.0])), [split.clone(), split]);
        let dataset =
            Dataset::of_splits("f", Origin::default(), inputs.into(), [("z", "1")], splits)
                .unwrap();
        let table = SphereTable::of(&dataset).unwrap();
        let at = [(0.25, 0.0), (0.5, 3.5), (1.5, 0.25), (3.0, 4.0), (2.75, 1.0)];
        let inputs = [at.map(|(x, _)| x).to_vec(), at.map(|(_, y)| y).to_vec()];
        for (value, (x, y)) in table.read(&inputs)[0].iter().zip(at) {
            assert!((value - f(x, y)).abs() < 1e-5, "{value} at {x}, {y}");
        }
        // Beyond the edges the nearest place.
        let beyond = table.read(&[vec![0.0, 9.0], vec![-1.0, 9.0]]);
        assert_eq!(beyond[0], [f(0.25, 0.0), f(3.0, 4.0)]);
    }
}
