//! The rows that are looked at, of one output.

use crate::dataset::{Dataset, Split};

/// The most rows that smooth fits are made to, all outputs together, by the number of inputs. By
/// hand: six inputs, with 105 forms of pairs, take 5 to 10 seconds of one core.
const MOST_ROWS: [usize; 4] = [32768, 16384, 8192, 4096];
/// The least of them. By hand: four for each of 256 terms.
const LEAST_ROWS: usize = 1024;

/// The parts that rows are dealt into, for cross-validation. By hand: the usual number.
pub(super) const FOLDS: usize = 5;

/// Rows in a random order that is always the same, so that the first of them are a sample, and
/// those of one fold another.
pub(super) struct Rows {
    pub inputs: Vec<Vec<f64>>,
    /// The output, divided by its spread.
    pub output: Vec<f64>,
    /// Weights of a mean of one.
    pub weights: Vec<f64>,
    /// The standard deviation of the output over all rows, weighted.
    pub spread: f64,
    /// The mean of the output, divided by the spread.
    pub mean: f64,
    /// The root mean square of the standard errors and of what `f32` rounds away, divided by the
    /// spread.
    pub noise: f64,
    /// Whether standard errors are stated.
    pub errors_stated: bool,
}

impl Rows {
    /// Takes the rows of a dataset's output that count, up to a number of them; none if the output
    /// is constant there.
    pub fn of(dataset: &Dataset, output: usize) -> Option<Rows> {
        let split = &dataset.search;
        let values = &split.columns[dataset.inputs.len() + output];
        let mut order: Vec<usize> =
            (0..split.rows()).filter(|&row| split.weight(row) > 0.0).collect();
        let [mean, spread] = moments(split, values, &order);
        if spread <= f64::from(f32::EPSILON) * mean.abs() {
            return None;
        }
        order.sort_by_key(|&row| scattered(row as u64));
        order.truncate(most_rows(dataset));
        let weight = |&row: &usize| f64::from(split.weight(row));
        let total: f64 = order.iter().map(weight).sum();
        let scale = order.len() as f64 / total;
        let picked = |column: &Vec<f32>, unit: f64| -> Vec<f64> {
            order.iter().map(|&row| f64::from(column[row]) / unit).collect()
        };
        let rows = Rows {
            inputs: split.columns[..dataset.inputs.len()].iter().map(|c| picked(c, 1.0)).collect(),
            output: picked(values, spread),
            weights: order.iter().map(|row| scale * weight(row)).collect(),
            spread,
            mean: mean / spread,
            noise: noise(split, values, output, &order) / spread,
            errors_stated: !split.standard_errors.is_empty(),
        };
        Some(rows)
    }

    pub fn len(&self) -> usize {
        self.output.len()
    }

    /// Returns the smallest and the largest value of an input.
    pub fn range(&self, input: usize) -> [f64; 2] {
        range(&self.inputs[input])
    }

    /// Returns whether an input has one value only.
    pub fn is_constant(&self, input: usize) -> bool {
        let [low, high] = self.range(input);
        low >= high
    }
}

/// Returns how many rows are fitted to.
pub(super) fn most_rows(dataset: &Dataset) -> usize {
    let most = MOST_ROWS[dataset.inputs.len().min(MOST_ROWS.len()) - 1];
    (most / dataset.outputs.len()).max(LEAST_ROWS)
}

/// Returns the smallest and the largest of values.
pub(super) fn range(values: &[f64]) -> [f64; 2] {
    let start = [f64::INFINITY, f64::NEG_INFINITY];
    values.iter().fold(start, |[low, high], &value| [low.min(value), high.max(value)])
}

fn moments(split: &Split, values: &[f32], rows: &[usize]) -> [f64; 2] {
    let mean_of = |value: &dyn Fn(f64) -> f64| {
        let weight = |row: usize| f64::from(split.weight(row));
        let total: f64 = rows.iter().map(|&row| weight(row)).sum();
        let sum: f64 = rows.iter().map(|&row| weight(row) * value(f64::from(values[row]))).sum();
        sum / total
    };
    let mean = mean_of(&|value| value);
    [mean, mean_of(&|value| (value - mean).powi(2)).sqrt()]
}

fn noise(split: &Split, values: &[f32], output: usize, rows: &[usize]) -> f64 {
    let weight = |row: usize| f64::from(split.weight(row));
    let stated = split.standard_errors.get(output);
    let variance = |row: usize| {
        let rounding = f64::from(values[row]) * f64::from(f32::EPSILON) / 2.0;
        let error = stated.map_or(0.0, |errors| f64::from(errors[row]));
        rounding * rounding / 3.0 + error * error
    };
    let total: f64 = rows.iter().map(|&row| weight(row)).sum();
    (rows.iter().map(|&row| weight(row) * variance(row)).sum::<f64>() / total).sqrt()
}

/// Mixes a number's bits (Steele et al. 2014, SplitMix64): neighbours end up far apart.
fn scattered(row: u64) -> u64 {
    let mut mixed = row.wrapping_add(0x9e37_79b9_7f4a_7c15);
    mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    mixed ^ (mixed >> 31)
}
