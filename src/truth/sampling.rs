//! Samples the domain of the search split, as points of the unit cube.
//!
//! | [`Sampling`], `--set sampling=` | points | weights |
//! |---|---|---|
//! | `regular` | cell centres of a grid | none |
//! | `jittered` | one random point in each cell of the grid | none |
//! | `low_discrepancy` | Sobol's sequence | none |
//! | `adaptive` | more where the outputs' gradient is large | one over the density |
//!
//! Pesce and Iwanicki, "Approximate Models for Physically Based Rendering",
//! 2015, §3.1 and figure 21.

use crate::num::low_discrepancy::{MAX_DIMENSIONS, Sobol, jittered_grid};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::ops::Range;

/// The most inputs of a function that is sampled: Sobol's directions go no further.
pub const MOST_AXES: usize = MAX_DIMENSIONS;
/// The most inputs of a jittered grid, each of which takes a random number: the targets so sampled
/// have three.
const MOST_JITTERED: usize = 4;
/// The part of the adaptive samples that is spread evenly: no weight exceeds its inverse. By hand,
/// unmeasured.
const EVEN_PART: f64 = 0.25;

/// The places of the search split's samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sampling {
    /// The centres of a grid's cells.
    Regular,
    /// One random point in each cell of a grid.
    Jittered,
    /// Sobol's sequence.
    LowDiscrepancy,
    /// More where the outputs' gradient is large, weighted by one over the density.
    Adaptive,
}

/// Points of the unit cube, and their weights, empty if equal.
pub(super) struct Samples {
    pub points: Vec<Vec<f64>>,
    pub weights: Vec<f32>,
}

pub(super) fn jittered(cells: usize, axes: usize, seed: u64) -> Samples {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let along: [u64; MOST_JITTERED] =
        std::array::from_fn(|axis| if axis < axes { cells as u64 } else { 1 });
    let point = |index| jittered_grid(along, index, &mut rng)[..axes].to_vec();
    Samples { points: (0..count(cells, axes)).map(point).collect(), weights: Vec::new() }
}

/// Returns Sobol's points of these indices in the middle of their intervals, so that none is at an
/// edge.
pub(super) fn low_discrepancy(indices: Range<u64>, axes: usize) -> Samples {
    let sobol = Sobol::<MOST_AXES>::new();
    let half_interval = 0.5 / indices.end.next_power_of_two() as f64;
    let point = |index| sobol.point(index)[..axes].iter().map(|x| x + half_interval).collect();
    Samples { points: indices.map(point).collect(), weights: Vec::new() }
}

/// Distributes as many points as cells over the cells by the gradient of `outputs`, given at the
/// centres of a regular grid, the last axis varying fastest. Each output counts relative to its
/// range. A point weighs one over its density, so that weighted means over the points have the mean
/// over the domain as their expectation.
pub(super) fn adaptive(cells: usize, axes: usize, outputs: &[Vec<f32>], seed: u64) -> Samples {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let steepness = steepness(cells, axes, outputs);
    let count = steepness.len();
    let mean = steepness.iter().sum::<f64>() / count as f64;
    let density = |cell: usize| match mean > 0.0 {
        true => EVEN_PART + (1.0 - EVEN_PART) * steepness[cell] / mean,
        false => 1.0,
    };
    // Systematic sampling: a cell gets the equal steps through the summed densities that fall into
    // it.
    let (mut points, mut weights) = (Vec::with_capacity(count), Vec::with_capacity(count));
    let (mut sum, offset) = (0.0, rng.random::<f64>());
    for cell in 0..count {
        sum += density(cell);
        while (points.len() as f64) + offset < sum && points.len() < count {
            points.push(inside(cell, cells, axes, &mut rng));
            weights.push((1.0 / density(cell)) as f32);
        }
    }
    Samples { points, weights }
}

/// Returns the number of cells of a grid.
pub(super) fn count(cells: usize, axes: usize) -> u64 {
    (cells as u64).pow(axes as u32)
}

/// Draws a point of a cell.
fn inside(cell: usize, cells: usize, axes: usize, rng: &mut ChaCha8Rng) -> Vec<f64> {
    let index = |axis: usize| cell / cells.pow((axes - 1 - axis) as u32) % cells;
    (0..axes).map(|axis| (index(axis) as f64 + rng.random::<f64>()) / cells as f64).collect()
}

/// Returns the length of each cell's gradient, by differences between its neighbours.
fn steepness(cells: usize, axes: usize, outputs: &[Vec<f32>]) -> Vec<f64> {
    let mut squares = vec![0.0; outputs.first().map_or(0, Vec::len)];
    for output in outputs {
        let value = |cell: usize| f64::from(output[cell]);
        let [low, high] = output
            .iter()
            .fold([f64::MAX, f64::MIN], |[a, b], &v| [a.min(v.into()), b.max(v.into())]);
        let range = if high > low { high - low } else { 1.0 };
        for axis in 0..axes {
            let stride = cells.pow((axes - 1 - axis) as u32);
            for (cell, square) in squares.iter_mut().enumerate() {
                let index = cell / stride % cells;
                let before = if index > 0 { cell - stride } else { cell };
                let after = if index + 1 < cells { cell + stride } else { cell };
                let steps = ((after - before) / stride).max(1) as f64;
                let slope = (value(after) - value(before)) / (range * steps);
                *square += slope * slope;
            }
        }
    }
    squares.into_iter().map(f64::sqrt).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// x⁸ at the centres of 32 by 32 cells.
    fn steep() -> Vec<f32> {
        let x = |cell: usize| ((cell / 32) as f32 + 0.5) / 32.0;
        (0..1024).map(|cell| x(cell).powi(8)).collect()
    }

    #[test]
    fn adaptive_samples_are_dense_where_the_gradient_is_large() {
        let samples = adaptive(32, 2, &[steep()], 1);
        assert_eq!((samples.points.len(), samples.weights.len()), (1024, 1024));
        let beyond = samples.points.iter().filter(|p| p[0] > 0.75).count();
        // Of x⁸'s rise 90 % is beyond 3/4.
        let expected = 1024.0 * (0.25 * 0.25 + 0.75 * (1.0 - 0.75_f64.powi(8)));
        assert!((beyond as f64 - expected).abs() < 30.0, "{beyond} {expected}");
        assert!(samples.weights.iter().all(|&weight| weight <= 4.0));
    }

    #[test]
    fn adaptive_weights_keep_integrals_unbiased() {
        // ∫ (x⁸ - y)² = 1/17 - 1/9 + 1/3.
        let exact = 1.0 / 17.0 - 1.0 / 9.0 + 1.0 / 3.0;
        let estimates: Vec<f64> = (0..200)
            .map(|seed| {
                let samples = adaptive(32, 2, &[steep()], seed);
                let term = |(p, &w): (&Vec<f64>, &f32)| {
                    f64::from(w) * (p[0].powi(8) - p[1]).powi(2) / 1024.0
                };
                samples.points.iter().zip(&samples.weights).map(term).sum()
            })
            .collect();
        let mean = estimates.iter().sum::<f64>() / 200.0;
        let variance = estimates.iter().map(|e| (e - mean).powi(2)).sum::<f64>() / (199.0 * 200.0);
        assert!((mean - exact).abs() < 3.5 * variance.sqrt(), "{mean} {exact} {variance:e}");
    }

    #[test]
    fn constants_are_sampled_evenly() {
        let samples = adaptive(8, 2, &[vec![3.0; 64]], 1);
        assert_eq!(samples.weights, vec![1.0; 64]);
    }

    #[test]
    fn all_points_are_inside() {
        for samples in [jittered(5, 3, 1), low_discrepancy(0..125, 3), low_discrepancy(0..8, 1)] {
            assert!(samples.points.iter().flatten().all(|&x| x > 0.0 && x < 1.0));
        }
        assert_eq!(jittered(5, 3, 1).points.len(), 125);
        assert_ne!(jittered(5, 3, 1).points, jittered(5, 3, 2).points);
    }
}
