//! Full grids, on which separations are tested value by value, however rough the function.

use super::shape::Join;
use crate::dataset::Dataset;

/// The most rounds of a fit by turns, and the relative change of the sum of squares that ends them.
/// By hand: with weights that are products along the axes, two rounds are exact.
const ROUNDS: usize = 200;
const SETTLED: f64 = 1e-9;

/// The most rows of a grid that is compared value by value. By hand, unmeasured.
const MOST_ROWS: usize = 1 << 18;

/// How unequal distances along an axis may be that is mirrored, relative to its extent. By hand:
/// `f32` rounds places.
const UNEVEN: f64 = 1e-5;

/// All rows of a full grid, of one output.
pub(super) struct Table {
    /// The points along each axis.
    axes: Vec<Vec<f64>>,
    /// The output divided by its spread, the last axis varying fastest.
    values: Vec<f64>,
    weights: Vec<f64>,
}

/// What the best function of a form leaves on a grid.
#[derive(Clone, Copy, Debug)]
pub(super) struct Left {
    /// The root of the weighted mean square.
    pub residual: f64,
    /// The share of noise's variance that is in it; the function has taken up the rest.
    pub free: f64,
}

/// The least of that share with which a form says anything. By hand, unmeasured.
const FREE: f64 = 0.25;

impl Table {
    /// Takes a dataset's search split, if its rows are a full grid as it says.
    pub fn of(dataset: &Dataset, output: usize, spread: f64) -> Option<Table> {
        let split = &dataset.search;
        let sizes = &split.grid;
        if sizes.is_empty() || split.rows() > MOST_ROWS {
            return None;
        }
        let mut axes = Vec::new();
        let mut stride = split.rows();
        for (column, &size) in split.columns.iter().zip(sizes) {
            stride /= size;
            let axis: Vec<f64> = (0..size).map(|i| f64::from(column[i * stride])).collect();
            let place = |row: usize| axis[row / stride % size];
            if (0..split.rows()).any(|row| place(row) != f64::from(column[row])) {
                return None;
            }
            axes.push(axis);
        }
        let column = &split.columns[dataset.inputs.len() + output];
        let values = column.iter().map(|&value| f64::from(value) / spread).collect();
        let weights = (0..split.rows()).map(|row| f64::from(split.weight(row))).collect();
        Some(Table { axes, values, weights })
    }

    fn size(&self, axis: usize) -> usize {
        self.axes[axis].len()
    }

    fn stride(&self, axis: usize) -> usize {
        self.axes[axis + 1..].iter().map(Vec::len).product()
    }

    fn index(&self, row: usize, axis: usize) -> usize {
        row / self.stride(axis) % self.size(axis)
    }

    /// Returns, by row, the number of the cell of some axes that it is in, and how many there are.
    fn cells(&self, axes: &[usize]) -> (Vec<usize>, usize) {
        let cell =
            |row| axes.iter().fold(0, |cell, &axis| cell * self.size(axis) + self.index(row, axis));
        let count = axes.iter().map(|&axis| self.size(axis)).product();
        ((0..self.values.len()).map(cell).collect(), count)
    }

    /// Returns what is left by a function for which so many numbers were fitted, none if these are
    /// nearly as many as the rows that count.
    fn left(&self, fitted: usize, error: impl Fn(usize) -> f64) -> Option<Left> {
        let counted = self.weights.iter().filter(|weight| **weight > 0.0).count();
        let free = 1.0 - fitted as f64 / counted as f64;
        let square = |row: usize| self.weights[row] * error(row).powi(2);
        let squares: f64 = (0..self.values.len()).map(square).sum();
        let residual = (squares / self.weights.iter().sum::<f64>()).sqrt();
        Some(Left { residual, free }).filter(|left| left.free >= FREE)
    }

    /// Returns what is left by the best function of some axes alone.
    pub fn of_axes(&self, axes: &[usize]) -> Option<Left> {
        let (cells, count) = self.cells(axes);
        let means = self.means(&cells, count, |row| self.values[row]);
        self.left(count, |row| self.values[row] - means[cells[row]])
    }

    fn means(&self, cells: &[usize], count: usize, value: impl Fn(usize) -> f64) -> Vec<f64> {
        let mut sums = vec![[0.0; 2]; count];
        for (row, &cell) in cells.iter().enumerate() {
            sums[cell][0] += self.weights[row] * value(row);
            sums[cell][1] += self.weights[row];
        }
        sums.iter().map(|[sum, weight]| if *weight > 0.0 { sum / weight } else { 0.0 }).collect()
    }

    /// Returns what is left by the best sum or product of functions, each of some axes. Axes that
    /// are in every part, `shared`, cost their own share of numbers.
    pub fn of_parts(&self, join: Join, parts: &[Vec<usize>]) -> Option<Left> {
        let cells: Vec<(Vec<usize>, usize)> = parts.iter().map(|part| self.cells(part)).collect();
        let shared: Vec<usize> = parts.first()?.clone();
        let shared = shared.into_iter().filter(|axis| parts.iter().all(|part| part.contains(axis)));
        let shared: usize = shared.map(|axis| self.size(axis)).product();
        let numbers: usize = cells.iter().map(|(_, count)| count).sum();
        let fitted = numbers - (parts.len() - 1) * shared;
        let values = match join {
            Join::Sum => self.sum(&cells),
            Join::Product => self.product(&cells),
        };
        self.left(fitted, |row| self.values[row] - values[row])
    }

    fn sum(&self, parts: &[(Vec<usize>, usize)]) -> Vec<f64> {
        let mut whole = vec![0.0; self.values.len()];
        let mut fitted: Vec<Vec<f64>> = parts.iter().map(|(_, count)| vec![0.0; *count]).collect();
        self.by_turns(&mut whole, |whole| {
            for ((cells, count), own) in parts.iter().zip(&mut fitted) {
                let rest = |row: usize| self.values[row] - whole[row] + own[cells[row]];
                let found = self.means(cells, *count, rest);
                let changed = whole.iter_mut().zip(cells);
                changed.for_each(|(whole, &cell)| *whole += found[cell] - own[cell]);
                *own = found;
            }
        });
        whole
    }

    fn product(&self, parts: &[(Vec<usize>, usize)]) -> Vec<f64> {
        // Slices through the largest value, not means: these are zero where factors change sign.
        let mut fitted: Vec<Vec<f64>> = parts.iter().map(|part| self.slice(part)).collect();
        let mut whole = vec![0.0; self.values.len()];
        self.by_turns(&mut whole, |whole| {
            for own in 0..parts.len() {
                let (cells, count) = &parts[own];
                let others = |row: usize| -> f64 {
                    let factors = parts.iter().zip(&fitted).enumerate();
                    let factors = factors.filter(|(at, _)| *at != own);
                    factors.map(|(_, ((cells, _), values))| values[cells[row]]).product()
                };
                let mut sums = vec![[0.0; 2]; *count];
                for (row, &cell) in cells.iter().enumerate() {
                    let (other, weight) = (others(row), self.weights[row]);
                    sums[cell][0] += weight * other * self.values[row];
                    sums[cell][1] += weight * other * other;
                }
                let best =
                    |[sum, square]: &[f64; 2]| if *square > 0.0 { sum / square } else { 0.0 };
                let found: Vec<f64> = sums.iter().map(best).collect();
                for (row, whole) in whole.iter_mut().enumerate() {
                    *whole = others(row) * found[cells[row]];
                }
                fitted[own] = found;
            }
        });
        whole
    }

    /// Returns the values along a part where the others are at their largest.
    fn slice(&self, (cells, count): &(Vec<usize>, usize)) -> Vec<f64> {
        let size = |row: usize| self.weights[row].min(1.0) * self.values[row].abs();
        let rows = 0..self.values.len();
        let largest = rows.max_by(|&a, &b| size(a).total_cmp(&size(b))).unwrap_or(0);
        let mut slice = vec![0.0; *count];
        let axes = 0..self.axes.len();
        let distance = |row: usize| -> usize {
            axes.clone().filter(|&axis| self.index(row, axis) != self.index(largest, axis)).count()
        };
        let mut nearest = vec![usize::MAX; *count];
        for (row, &cell) in cells.iter().enumerate() {
            let distance = distance(row);
            if distance < nearest[cell] && self.weights[row] > 0.0 {
                (nearest[cell], slice[cell]) = (distance, self.values[row]);
            }
        }
        slice
    }

    fn by_turns(&self, whole: &mut [f64], mut round: impl FnMut(&mut [f64])) {
        let mut last = f64::INFINITY;
        for _ in 0..ROUNDS {
            round(whole);
            let left = |(row, value): (usize, &f64)| {
                self.weights[row] * (self.values[row] - value).powi(2)
            };
            let left: f64 = whole.iter().enumerate().map(left).sum();
            if left >= last * (1.0 - SETTLED) {
                break;
            }
            last = left;
        }
    }

    /// Returns what is left by the best function in which two axes may be exchanged; none if their
    /// points differ.
    pub fn symmetric(&self, a: usize, b: usize) -> Option<Left> {
        if self.axes[a] != self.axes[b] {
            return None;
        }
        let (of_a, of_b) = (self.stride(a), self.stride(b));
        let exchanged = |row: usize| {
            let (at_a, at_b) = (self.index(row, a), self.index(row, b));
            row - at_a * of_a - at_b * of_b + at_b * of_a + at_a * of_b
        };
        self.paired(exchanged, 1.0)
    }

    /// Returns what is left by the best function that is even (`sign` 1) or odd (`sign` -1) about
    /// a centre of an axis; none if its points are not each other's mirror images.
    pub fn mirrored(&self, axis: usize, centre: f64, sign: f64) -> Option<Left> {
        let places = &self.axes[axis];
        let extent = (places.last()? - places.first()?).abs();
        let images = places.iter().zip(places.iter().rev());
        let mut images = images.map(|(place, image)| (place + image - 2.0 * centre).abs());
        if images.any(|apart| apart > UNEVEN * extent) {
            return None;
        }
        let stride = self.stride(axis);
        let image = |row: usize| {
            let at = self.index(row, axis);
            row - at * stride + (self.size(axis) - 1 - at) * stride
        };
        self.paired(image, sign)
    }

    /// Returns what a function leaves that has the same value in each two rows, but for the sign.
    fn paired(&self, other: impl Fn(usize) -> usize, sign: f64) -> Option<Left> {
        let rows = self.values.len();
        let alone = (0..rows).filter(|&row| other(row) == row).count();
        self.left((rows - alone) / 2 + alone, |row| {
            let image = other(row);
            let [own, its] = [row, image].map(|at| self.weights[at]);
            let total = own + its;
            let best = own * self.values[row] + its * sign * self.values[image];
            if total > 0.0 { self.values[row] - best / total } else { 0.0 }
        })
    }
}
