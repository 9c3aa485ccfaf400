//! Least-squares fits of polynomials, judged on rows that they were not fitted to.

use super::design::{BLOCK, Design};
use super::linear::{Cholesky, dot};
use super::rows::{FOLDS, Rows};

/// The squared error, relative to the least, and in squared spreads, up to which fewer terms are
/// preferred. By hand: of noise of a tenth of the spread, this hides half a per cent.
pub(super) const AS_GOOD: [f64; 2] = [1.002, 1e-12];

/// A fit, and its errors on rows that it was not fitted to, in spreads of the output.
#[derive(Clone, Debug)]
pub(super) struct Fit {
    pub degree: usize,
    pub terms: usize,
    /// Of the fit to all rows, for each term of the design up to the degree.
    pub coefficients: Vec<f64>,
    /// Of the first rows, each from a fit without its fold.
    pub errors: Vec<f64>,
    /// The root of their weighted mean square.
    pub residual: f64,
}

/// The root of the weighted mean square of the first rows' errors.
pub(super) fn root_mean_square(errors: &[f64], weights: &[f64]) -> f64 {
    let squares: f64 =
        errors.iter().zip(weights).map(|(error, weight)| weight * error * error).sum();
    (squares / weights[..errors.len()].iter().sum::<f64>()).sqrt()
}

/// The sums that a least-squares fit needs: `XᵀWX`, `XᵀWy`, `yᵀWy`.
#[derive(Clone)]
pub(super) struct Sums {
    pub matrix: Vec<f64>,
    pub vector: Vec<f64>,
    square: f64,
}

impl Sums {
    /// Adds up some rows; `scale` multiplies all terms of a row.
    pub fn of(
        design: &Design,
        rows: &[usize],
        [targets, weights]: [&[f64]; 2],
        scale: Option<&[f64]>,
    ) -> Sums {
        let terms = design.terms.len();
        let mut sums =
            Sums { matrix: vec![0.0; terms * terms], vector: vec![0.0; terms], square: 0.0 };
        let mut values = Vec::new();
        let mut weighted = [0.0; BLOCK];
        for block in rows.chunks(BLOCK) {
            design.fill(block, &mut values);
            if let Some(scale) = scale {
                for values in values.chunks_exact_mut(BLOCK) {
                    values.iter_mut().zip(block).for_each(|(value, &row)| *value *= scale[row]);
                }
            }
            let mut target = [0.0; BLOCK];
            target.iter_mut().zip(block).for_each(|(target, &row)| *target = targets[row]);
            for (i, own) in values.chunks_exact(BLOCK).enumerate() {
                for (at, &row) in block.iter().enumerate() {
                    weighted[at] = own[at] * weights[row];
                }
                weighted[block.len()..].fill(0.0);
                sums.vector[i] += dot(&weighted, &target);
                let (fours, rest) = sums.matrix[i * terms..][..=i].as_chunks_mut::<4>();
                let (others, last) = values[..(i + 1) * BLOCK].as_chunks::<{ 4 * BLOCK }>();
                fours
                    .iter_mut()
                    .zip(others)
                    .for_each(|(sums, others)| four(sums, &weighted, others));
                for (sum, other) in rest.iter_mut().zip(last.chunks_exact(BLOCK)) {
                    *sum += dot(&weighted, other);
                }
            }
            sums.square +=
                block.iter().map(|&row| weights[row] * targets[row].powi(2)).sum::<f64>();
        }
        sums
    }

    pub fn add(&mut self, other: &Sums, sign: f64) {
        let pairs = self.matrix.iter_mut().zip(&other.matrix);
        pairs.chain(self.vector.iter_mut().zip(&other.vector)).for_each(|(a, b)| *a += sign * b);
        self.square += sign * other.square;
    }

    /// Returns the sum of squares that coefficients leave.
    fn left(&self, coefficients: &[f64]) -> f64 {
        let terms = self.vector.len();
        let mut left = self.square;
        for (i, coefficient) in coefficients.iter().enumerate() {
            let row = &self.matrix[i * terms..];
            let off = dot(&row[..i], &coefficients[..i]);
            left += coefficient * (2.0 * off + row[i] * coefficient - 2.0 * self.vector[i]);
        }
        left.max(0.0)
    }
}

/// Adds the products of a block with four others, which takes half the loads of one by one.
fn four(sums: &mut [f64; 4], own: &[f64; BLOCK], others: &[f64; 4 * BLOCK]) {
    let mut lanes = [[0.0; 4]; 4];
    for at in (0..BLOCK).step_by(4) {
        for (other, lanes) in lanes.iter_mut().enumerate() {
            for lane in 0..4 {
                lanes[lane] += own[at + lane] * others[other * BLOCK + at + lane];
            }
        }
    }
    sums.iter_mut().zip(lanes).for_each(|(sum, lanes)| *sum += lanes.iter().sum::<f64>());
}

/// Returns the rows of each fold among the first.
pub(super) fn folds(count: usize) -> Vec<Vec<usize>> {
    (0..FOLDS).map(|fold| (fold..count).step_by(FOLDS).collect()).collect()
}

/// Fits a design to the first rows, with the degree that does best on rows left out.
pub(super) fn fit(rows: &Rows, design: &Design) -> Fit {
    let count = design.rows;
    // A function that is odd has no constant term that could take up the mean.
    let mean = if design.factor.is_some() { 0.0 } else { rows.mean };
    let targets: Vec<f64> = rows.output[..count].iter().map(|value| value - mean).collect();
    let folds = folds(count);
    let of = |rows_of: &Vec<usize>| Sums::of(design, rows_of, [&targets, &rows.weights], None);
    let parts: Vec<Sums> = folds.iter().map(of).collect();
    let mut all = parts[0].clone();
    parts[1..].iter().for_each(|part| all.add(part, 1.0));

    let size = design.terms.len();
    let solved: Vec<Vec<Vec<f64>>> = parts
        .iter()
        .map(|part| {
            let mut others = all.clone();
            others.add(part, -1.0);
            let factor = Cholesky::new(&others.matrix, size);
            let z = factor.forward(&others.vector);
            design.ends.iter().map(|&end| factor.back(&z, end)).collect()
        })
        .collect();
    let left = |degree: usize| -> f64 {
        parts.iter().zip(&solved).map(|(part, solved)| part.left(&solved[degree])).sum()
    };
    let lefts: Vec<f64> = (0..design.ends.len()).map(left).collect();
    let least = lefts.iter().copied().fold(f64::INFINITY, f64::min);
    let enough = AS_GOOD[0] * least + AS_GOOD[1] * rows.weights[..count].iter().sum::<f64>();
    let degree = lefts.iter().position(|&left| left <= enough).unwrap_or(0);

    let mut errors = vec![0.0; count];
    let mut values = Vec::new();
    for (fold, solved) in folds.iter().zip(&solved) {
        for block in fold.chunks(BLOCK) {
            design.fill(block, &mut values);
            for (at, &row) in block.iter().enumerate() {
                let terms = solved[degree].iter().zip(values.iter().skip(at).step_by(BLOCK));
                errors[row] = targets[row] - terms.map(|(c, value)| c * value).sum::<f64>();
            }
        }
    }
    let whole = Cholesky::new(&all.matrix, size);
    let mut coefficients = whole.back(&whole.forward(&all.vector), design.ends[degree]);
    coefficients[0] += mean;
    let residual = root_mean_square(&errors, &rows.weights);
    Fit { degree, terms: design.ends[degree], coefficients, errors, residual }
}
