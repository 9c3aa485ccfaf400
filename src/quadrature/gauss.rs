//! Gauss–Legendre rules.

use super::Rule;
use std::f64::consts::PI;

impl Rule {
    /// The Gauss–Legendre rule of `n` points: exact for polynomials of degree
    /// 2n - 1, best for integrands that are smooth up to the ends. The coarser
    /// rule is that of n / 2 points, rounded up.
    ///
    /// # Panics
    /// If `n` is 0.
    pub fn gauss_legendre(n: usize) -> Rule {
        assert!(n > 0, "a rule needs a point");
        Rule::new(&points(n), &points(n.div_ceil(2)))
    }
}

/// Returns the nodes in (-1, 1), ascending, and their weights, which add up to 2.
pub(super) fn points(n: usize) -> Vec<(f64, f64)> {
    let mut points: Vec<(f64, f64)> = (0..n.div_ceil(2)).map(|i| point(n, i)).collect();
    let mirrored: Vec<_> = points.iter().take(n / 2).rev().map(|&(x, w)| (-x, w)).collect();
    points.extend(mirrored);
    points
}

/// Computes the i-th root of the Legendre polynomial of degree n from the left, in the left half,
/// by Newton's method from Tricomi's approximation (Abramowitz & Stegun 22.16.6).
fn point(n: usize, i: usize) -> (f64, f64) {
    if 2 * i + 1 == n {
        let (_, slope) = legendre(n, 0.0);
        return (0.0, 2.0 / (slope * slope));
    }
    let degree = n as f64;
    let shrink = 1.0 - (degree - 1.0) / (8.0 * degree * degree * degree);
    let mut x = -shrink * (PI * (4.0 * i as f64 + 3.0) / (4.0 * degree + 2.0)).cos();
    for _ in 0..20 {
        let (value, slope) = legendre(n, x);
        let step = value / slope;
        x -= step;
        if step.abs() <= f64::EPSILON {
            break;
        }
    }
    let (_, slope) = legendre(n, x);
    (x, 2.0 / ((1.0 - x) * (1.0 + x) * slope * slope))
}

/// Value and derivative of the Legendre polynomial of degree n at |x| < 1, by
/// Bonnet's recurrence.
pub(super) fn legendre(n: usize, x: f64) -> (f64, f64) {
    let (mut before, mut value) = (0.0, 1.0);
    for k in 0..n {
        let k = k as f64;
        let next = ((2.0 * k + 1.0) * x * value - k * before) / (k + 1.0);
        before = std::mem::replace(&mut value, next);
    }
    (value, n as f64 * (before - x * value) / ((1.0 - x) * (1.0 + x)))
}

#[cfg(test)]
mod tests {
    use super::super::rule::tests::assert_degree;
    use super::*;

    #[test]
    fn degrees() {
        (1..40).for_each(|n| assert_degree(&Rule::gauss_legendre(n), 2 * n - 1));
    }

    #[test]
    fn nodes_are_those_of_the_tables() {
        // Abramowitz & Stegun, table 25.4.
        let (node, weight) = points(3)[2];
        assert!((node - 0.6_f64.sqrt()).abs() < 1e-16);
        assert!((weight - 5.0 / 9.0).abs() < 1e-15);
        let (node, weight) = points(96)[95];
        assert!((node - 0.999_689_503_883_230_7).abs() < 1e-15, "{node}");
        assert!((weight - 0.000_796_792_065_552_012_4).abs() < 1e-15, "{weight}");
    }

    #[test]
    fn many_points_stay_accurate_and_ascending() {
        assert!(points(1000).windows(2).all(|pair| pair[0].0 < pair[1].0));
        let estimate = Rule::gauss_legendre(1000).integrate([0.0], [10.0], |[x]| (7.0 * x).cos());
        assert!((estimate.value - 70.0_f64.sin() / 7.0).abs() < 1e-13);
        assert!(estimate.error < 1e-12);
        assert_eq!(estimate.evaluations, 1500);
    }

    #[test]
    fn error_estimate_covers_the_error() {
        for n in 2..20 {
            let estimate = Rule::gauss_legendre(n).integrate([0.0], [1.0], |[x]| 1.0 / (0.1 + x));
            let error = (estimate.value - 11.0_f64.ln()).abs();
            assert!(error <= estimate.error + 1e-15, "n = {n}: {error} > {}", estimate.error);
        }
    }
}
