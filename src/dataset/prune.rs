//! Prunes rows where a function is flat (Pesce and Iwanicki, "Approximate Models for Physically
//! Based Rendering", 2015, §5.2): the rows that stay take over the weights of those removed.

use super::{Dataset, Split};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

impl Dataset {
    /// Prunes the search split: boxes of the input space in which no output varies by more than
    /// `share` of its range keep one row each, with the weight of all the box's. The row is drawn
    /// in proportion to the weights, so that weighted sums over the rows, such as the squared error
    /// of any formula, keep their expectation. The validation split stays.
    ///
    /// Boxes are halved at the median of the input with the widest spread (relative to that of all
    /// rows) until they are flat or hold one row. The same `seed` gives the same rows. `share` is
    /// at least 0; at 0 only rows of equal outputs are pruned.
    pub fn prune_flat_regions(&mut self, share: f64, seed: u64) {
        let spreads = self.search.columns.iter().map(|column| spread(column.iter().copied()));
        let spreads: Vec<f64> = spreads.collect();
        let pruning = Pruning { split: &self.search, inputs: self.inputs.len(), spreads, share };
        let mut kept = Vec::new();
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        pruning.keep((0..self.search.rows()).collect(), &mut rng, &mut kept);
        kept.sort_by_key(|&(row, _)| row);
        if kept.len() == self.search.rows() {
            return;
        }
        let of = |column: &Vec<f32>| kept.iter().map(|&(row, _)| column[row]).collect();
        self.search = Split {
            columns: self.search.columns.iter().map(of).collect(),
            weights: kept.iter().map(|&(_, weight)| weight as f32).collect(),
            dead_zone: self.search.dead_zone.iter().map(of).collect(),
            standard_errors: self.search.standard_errors.iter().map(of).collect(),
            grid: Vec::new(),
        };
    }
}

struct Pruning<'a> {
    split: &'a Split,
    inputs: usize,
    /// The range of each column over all rows.
    spreads: Vec<f64>,
    share: f64,
}

impl Pruning<'_> {
    /// Adds the rows that a box keeps, and their weights.
    fn keep(&self, mut rows: Vec<usize>, rng: &mut ChaCha8Rng, kept: &mut Vec<(usize, f64)>) {
        let weight = |row: usize| f64::from(self.split.weight(row));
        let relative = |column: usize| {
            let all = self.spreads[column];
            let here = spread(rows.iter().map(|&row| self.split.columns[column][row]));
            if all > 0.0 { here / all } else { 0.0 }
        };
        let flat = (self.inputs..self.split.columns.len()).all(|c| relative(c) <= self.share);
        let widest = (0..self.inputs).max_by(|&a, &b| relative(a).total_cmp(&relative(b)));
        // Rows of equal inputs cannot be separated.
        let axis = widest.filter(|&axis| !flat && relative(axis) > 0.0);
        match axis {
            Some(axis) => {
                let column = &self.split.columns[axis];
                rows.sort_by(|&a, &b| column[a].total_cmp(&column[b]).then(a.cmp(&b)));
                let middle = column[rows[rows.len() / 2]];
                let mut at = rows.partition_point(|&row| column[row] < middle);
                if at == 0 {
                    at = rows.partition_point(|&row| column[row] <= middle);
                }
                let upper = rows.split_off(at);
                self.keep(rows, rng, kept);
                self.keep(upper, rng, kept);
            }
            None if flat => {
                let total: f64 = rows.iter().map(|&row| weight(row)).sum();
                kept.push((drawn(&rows, weight, total, rng), total));
            }
            None => kept.extend(rows.iter().map(|&row| (row, weight(row)))),
        }
    }
}

/// Draws one of the rows, in proportion to its weight.
fn drawn(rows: &[usize], weight: impl Fn(usize) -> f64, total: f64, rng: &mut ChaCha8Rng) -> usize {
    let mut left = rng.random::<f64>() * total;
    let chosen = rows.iter().copied().find(|&row| {
        left -= weight(row);
        left < 0.0
    });
    chosen.unwrap_or(rows[rows.len() - 1])
}

fn spread(values: impl Iterator<Item = f32>) -> f64 {
    let [low, high] = super::range(values);
    high - low
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dataset::{Axis, Origin};

    /// A step with a flat left half, on 32 by 32 points.
    fn ramp() -> Dataset {
        let axes = [Axis::unit("x"), Axis::unit("y")];
        let places = axes.each_ref().map(|axis| axis.centres(32));
        let split = Split::on_grid(&places, |p| [(2.0 * p[0] - 1.0).max(0.0) * (1.0 + p[1])]);
        let (inputs, splits) = (axes.each_ref().map(Axis::column), [split.clone(), split]);
        Dataset::of_splits("ramp", Origin::default(), inputs.into(), [("z", "1")], splits).unwrap()
    }

    #[test]
    fn flat_regions_lose_rows_and_no_weight() {
        let mut pruned = ramp();
        pruned.prune_flat_regions(0.02, 1);
        pruned.validate().unwrap();
        let rows = pruned.search.rows();
        let left = pruned.search.columns[0].iter().filter(|&&x| x < 0.5).count();
        assert!((256..600).contains(&rows), "{rows}");
        // All of the left half is one box of the tree, or a few.
        assert!(left <= 8, "{left}");
        let total: f32 = pruned.search.weights.iter().sum();
        assert_eq!(total, 1024.0);
        assert_eq!(pruned.validation, ramp().validation);
    }

    #[test]
    fn nothing_is_lost_where_nothing_is_flat() {
        let mut steep = ramp();
        for row in 0..1024 {
            steep.search.columns[2][row] = row as f32;
        }
        let before = steep.clone();
        steep.prune_flat_regions(0.0, 1);
        assert_eq!(steep, before);
    }

    #[test]
    fn errors_keep_their_expectation() {
        // The squared error of z = x, over all rows and over those kept, 300 times.
        let error = |split: &Split| -> f64 {
            let square =
                |row: usize| f64::from(split.columns[2][row] - split.columns[0][row]).powi(2);
            (0..split.rows()).map(|row| f64::from(split.weight(row)) * square(row)).sum()
        };
        let exact = error(&ramp().search);
        let errors: Vec<f64> = (0..300)
            .map(|seed| {
                let mut pruned = ramp();
                pruned.prune_flat_regions(0.1, seed);
                error(&pruned.search)
            })
            .collect();
        let mean = errors.iter().sum::<f64>() / 300.0;
        let variance = errors.iter().map(|e| (e - mean).powi(2)).sum::<f64>() / (299.0 * 300.0);
        assert!((mean - exact).abs() < 3.5 * variance.sqrt(), "{mean} {exact} {variance:e}");
        assert!(variance > 0.0);
    }

    #[test]
    fn rows_that_no_input_tells_apart_all_stay() {
        let mut noisy = ramp();
        noisy.search.columns[0].fill(0.5);
        noisy.search.columns[1].fill(0.5);
        noisy.prune_flat_regions(0.01, 1);
        assert_eq!(noisy.search.rows(), 1024);
    }
}
