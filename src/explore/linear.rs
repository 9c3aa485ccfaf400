//! Dense symmetric linear algebra: one factorisation serves all leading blocks of a matrix.

/// The smallest pivot, relative to the diagonal, of a term that still says something of its own.
/// By hand: normal equations lose half of the 52 bits, and what is left is mostly rounding.
const MIN_PIVOT: f64 = 1e-11;

/// The factor `L` of a matrix `L·Lᵀ`. Since the factor of a leading block is the leading block of
/// the factor, it solves for any number of the first unknowns.
pub(crate) struct Cholesky {
    size: usize,
    lower: Vec<f64>,
    /// Unknowns that depend on those before them, and are zero in solutions.
    dropped: Vec<bool>,
}

impl Cholesky {
    /// Factorises a row-major matrix, of which only the lower triangle is read.
    pub fn new(matrix: &[f64], size: usize) -> Cholesky {
        let mut lower = matrix.to_vec();
        let mut dropped = vec![false; size];
        for i in 0..size {
            for j in 0..=i {
                let (before, row) = lower.split_at_mut(i * size);
                let known =
                    if j == i { row[..j].to_vec() } else { before[j * size..][..j].to_vec() };
                let sum = row[j] - dot(&row[..j], &known);
                if j < i {
                    let pivot = before[j * size + j];
                    row[j] = if dropped[j] { 0.0 } else { sum / pivot };
                } else if sum > MIN_PIVOT * matrix[i * size + i] {
                    row[j] = sum.sqrt();
                } else {
                    dropped[i] = true;
                    row[j] = 1.0;
                }
            }
        }
        Cholesky { size, lower, dropped }
    }

    /// Solves `L·z = b`. The first entries of `z` are those of the leading blocks.
    pub fn forward(&self, b: &[f64]) -> Vec<f64> {
        let mut z = Vec::with_capacity(self.size);
        for (i, row) in self.lower.chunks_exact(self.size).enumerate() {
            let rest = b[i] - dot(&row[..i], &z);
            z.push(if self.dropped[i] { 0.0 } else { rest / row[i] });
        }
        z
    }

    /// Solves `Lᵀ·x = z` for the first `unknowns`.
    pub fn back(&self, z: &[f64], unknowns: usize) -> Vec<f64> {
        let mut x = z[..unknowns].to_vec();
        for i in (0..unknowns).rev() {
            let row = &self.lower[i * self.size..];
            x[i] = if self.dropped[i] { 0.0 } else { x[i] / row[i] };
            let known = x[i];
            x[..i].iter_mut().zip(row).for_each(|(x, entry)| *x -= entry * known);
        }
        x
    }
}

/// Sums products in eight lanes: a single sum would be added up one by one.
pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut lanes = [0.0; 8];
    let (a, a_rest) = a.as_chunks::<8>();
    let (b, b_rest) = b.as_chunks::<8>();
    for (a, b) in a.iter().zip(b) {
        for lane in 0..8 {
            lanes[lane] += a[lane] * b[lane];
        }
    }
    let rest: f64 = a_rest.iter().zip(b_rest).map(|(a, b)| a * b).sum();
    lanes.iter().sum::<f64>() + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn leading_blocks_are_solved_by_one_factorisation() {
        let matrix = [4.0, 0.0, 0.0, 2.0, 5.0, 0.0, 2.0, 3.0, 6.0];
        let cholesky = Cholesky::new(&matrix, 3);
        let z = cholesky.forward(&[8.0, 13.0, 20.0]);
        let close = |found: Vec<f64>, expected: &[f64]| {
            found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12)
        };
        let all = cholesky.back(&z, 3);
        for (row, b) in [([4.0, 2.0, 2.0], 8.0), ([2.0, 5.0, 3.0], 13.0), ([2.0, 3.0, 6.0], 20.0)] {
            assert!((dot(&row, &all) - b).abs() < 1e-12);
        }
        assert!(close(cholesky.back(&z, 2), &[14.0 / 16.0, 36.0 / 16.0]));
        assert!(close(cholesky.back(&z, 1), &[2.0]));
    }

    #[test]
    fn what_depends_on_others_is_left_out() {
        let cholesky = Cholesky::new(&[1.0, 0.0, 1.0, 1.0], 2);
        assert_eq!(cholesky.back(&cholesky.forward(&[3.0, 3.0]), 2), [3.0, 0.0]);
    }
}
