//! Histograms: the frequencies of inputs' values.

use super::Error;
use serde::{Deserialize, Serialize};

/// Counts, or any weights, in equal bins of one or more inputs.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Histogram {
    /// The names of its inputs, at least one.
    pub inputs: Vec<String>,
    /// The range of each input that is divided into bins, and beyond which nothing occurs; empty
    /// for the part of their domains that the scene leaves.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub over: Vec<[f64; 2]>,
    /// The number of bins along each input; it may be left out for a single input.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub bins: Vec<usize>,
    /// The count of each bin, the first input varying slowest; finite, not negative, not all zero.
    pub counts: Vec<f64>,
}

impl Histogram {
    /// Returns the number of bins along each input.
    pub fn bins(&self) -> Vec<usize> {
        match (self.bins.is_empty(), self.inputs.len()) {
            (true, 1) => vec![self.counts.len()],
            _ => self.bins.clone(),
        }
    }

    /// Checks all that can be checked without a dataset.
    pub(super) fn check(&self, scene: &str) -> Result<(), Error> {
        let refuse = |problem: String| {
            let inputs = self.inputs.join(", ");
            Err(Error::Histogram { scene: scene.to_owned(), inputs, problem })
        };
        let (inputs, bins) = (self.inputs.len(), self.bins());
        if inputs == 0 {
            return refuse("it has no inputs; name at least one".into());
        }
        if bins.len() != inputs {
            return refuse(format!("it has {inputs} inputs, but bins along {}", bins.len()));
        }
        let product = bins.iter().try_fold(1usize, |product, &n| product.checked_mul(n));
        if product != Some(self.counts.len()) || self.counts.is_empty() {
            return refuse(format!(
                "it has {} counts, but bins along its inputs are {bins:?}; give one count a bin",
                self.counts.len()
            ));
        }
        if let Some(count) = self.counts.iter().find(|count| !(count.is_finite() && **count >= 0.0))
        {
            return refuse(format!("a count is {count}; counts are finite and not negative"));
        }
        if self.counts.iter().all(|&count| count == 0.0) {
            return refuse("all counts are zero; give at least one bin a positive count".into());
        }
        if !self.over.is_empty() && self.over.len() != inputs {
            let over = self.over.len();
            return refuse(format!("it has {inputs} inputs, but `over` has {over} ranges"));
        }
        Ok(())
    }
}

/// A histogram read over columns, each with its range.
#[derive(Clone, Debug)]
pub(super) struct Density {
    axes: Vec<Axis>,
    counts: Vec<f64>,
}

#[derive(Clone, Debug)]
struct Axis {
    column: usize,
    over: [f64; 2],
    bins: usize,
}

impl Density {
    /// Makes the density of a histogram whose inputs are in these columns and divided over these
    /// ranges.
    pub fn new(histogram: &Histogram, columns: &[usize], over: &[[f64; 2]]) -> Density {
        let axes = columns.iter().zip(over).zip(histogram.bins());
        let axes = axes.map(|((&column, &over), bins)| Axis { column, over, bins });
        Density { axes: axes.collect(), counts: histogram.counts.clone() }
    }

    /// Returns the count of the bin that a row lies in; 0 beyond the bins.
    pub fn of(&self, columns: &[Vec<f32>], row: usize) -> f64 {
        let mut bin = 0;
        for axis in &self.axes {
            match axis.bin(columns[axis.column][row]) {
                Some(along) => bin = bin * axis.bins + along,
                None => return 0.0,
            }
        }
        self.counts[bin]
    }
}

impl Axis {
    fn bin(&self, value: f32) -> Option<usize> {
        bin(value, self.over, self.bins)
    }
}

/// Returns the bin of a value among equal bins over a range, which is closed and rounded to `f32`.
pub(super) fn bin(value: f32, [low, high]: [f64; 2], bins: usize) -> Option<usize> {
    if !(low as f32..=high as f32).contains(&value) {
        return None;
    }
    let along = (f64::from(value) - low) / (high - low) * bins as f64;
    Some((along.max(0.0) as usize).min(bins - 1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bins_are_half_open_and_the_last_is_closed() {
        let bins = [-0.1, 0.0, 0.24, 0.25, 0.99, 1.0, 1.1].map(|x| bin(x, [0.0, 1.0], 4));
        assert_eq!(bins, [None, Some(0), Some(0), Some(1), Some(3), Some(3), None]);
    }

    #[test]
    fn the_first_input_varies_slowest() {
        let histogram = Histogram {
            inputs: vec!["a".into(), "b".into()],
            bins: vec![2, 3],
            counts: vec![1.0, 2.0, 3.0, 4.0, 5.0, 6.0],
            ..Histogram::default()
        };
        let density = Density::new(&histogram, &[1, 0], &[[0.0, 1.0], [0.0, 3.0]]);
        let columns = [vec![0.5, 2.5, 1.5, 4.0], vec![0.1, 0.1, 0.9, 0.5]];
        let found: Vec<f64> = (0..4).map(|row| density.of(&columns, row)).collect();
        assert_eq!(found, [1.0, 3.0, 5.0, 0.0]);
    }
}
