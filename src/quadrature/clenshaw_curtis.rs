//! Rules on the extrema and the zeros of Chebyshev polynomials.
//!
//! With x = cos θ the integral is `∫ f(cos θ) sin θ dθ`, and a cosine series of
//! f integrates term by term. The weights follow from the discrete cosine
//! transform that finds the series from n values (Waldvogel, "Fast Construction
//! of the Fejér and Clenshaw–Curtis Quadrature Rules", 2006, eqs. 2.2–2.4).

use super::Rule;
use std::f64::consts::PI;

impl Rule {
    /// The Clenshaw–Curtis rule on cos(kπ/n), k = 0…n, for an even n: ends
    /// included, exact for polynomials of degree n + 1. The coarser rule takes
    /// every other node where n/2 is even, and otherwise is Fejér's second,
    /// without the ends.
    ///
    /// # Panics
    /// If `n` is odd or 0.
    pub fn clenshaw_curtis(n: usize) -> Rule {
        assert!(n > 0 && n.is_multiple_of(2), "Clenshaw–Curtis needs an even number of intervals");
        let coarse = if n.is_multiple_of(4) { extrema(n / 2) } else { inner_extrema(n) };
        Rule::new(&extrema(n), &coarse)
    }

    /// Fejér's first rule, on the n zeros of the Chebyshev polynomial, no ends:
    /// exact for polynomials of degree n - 1, or n for an odd n. The coarser
    /// rule has n/3 points, which are among them, or half of them.
    ///
    /// # Panics
    /// If `n` is 0.
    pub fn fejer_first(n: usize) -> Rule {
        assert!(n > 0, "a rule needs a point");
        let coarser = if n.is_multiple_of(3) { n / 3 } else { n.div_ceil(2) };
        Rule::new(&zeros(n), &zeros(coarser))
    }

    /// Fejér's second rule, Clenshaw–Curtis' nodes without the ends, n of
    /// them: exact for polynomials of degree n - 1, or n for an odd n. For an
    /// odd n the coarser rule takes every other node.
    ///
    /// # Panics
    /// If `n` is 0.
    pub fn fejer_second(n: usize) -> Rule {
        assert!(n > 0, "a rule needs a point");
        let coarser = if n % 2 == 1 && n > 1 { n / 2 } else { n.div_ceil(2) };
        Rule::new(&inner_extrema(n + 1), &inner_extrema(coarser + 1))
    }
}

/// `cos` of `parts / whole` of a half turn, exact in the middle.
fn node(parts: usize, whole: usize) -> f64 {
    (0.5 * PI * (whole as f64 - 2.0 * parts as f64) / whole as f64).sin()
}

fn extrema(n: usize) -> Vec<(f64, f64)> {
    let weight = |k: usize| {
        let theta = PI * k as f64 / n as f64;
        let term = |j: usize| {
            let last = if 2 * j == n { 1.0 } else { 2.0 };
            last * (2.0 * j as f64 * theta).cos() / (4.0 * (j * j) as f64 - 1.0)
        };
        let ends = if k == 0 || k == n { 1.0 } else { 2.0 };
        ends / n as f64 * (1.0 - (1..=n / 2).map(term).sum::<f64>())
    };
    (0..=n).map(|k| (node(k, n), weight(k))).collect()
}

fn inner_extrema(n: usize) -> Vec<(f64, f64)> {
    let weight = |k: usize| {
        let theta = PI * k as f64 / n as f64;
        let term = |j: usize| ((2 * j - 1) as f64 * theta).sin() / (2 * j - 1) as f64;
        4.0 * theta.sin() / n as f64 * (1..=n / 2).map(term).sum::<f64>()
    };
    (1..n).map(|k| (node(k, n), weight(k))).collect()
}

fn zeros(n: usize) -> Vec<(f64, f64)> {
    let weight = |k: usize| {
        let theta = PI * (2 * k + 1) as f64 / (2 * n) as f64;
        let term = |j: usize| (2.0 * j as f64 * theta).cos() / (4.0 * (j * j) as f64 - 1.0);
        2.0 / n as f64 * (1.0 - 2.0 * (1..=n / 2).map(term).sum::<f64>())
    };
    (0..n).map(|k| (node(2 * k + 1, 2 * n), weight(k))).collect()
}

#[cfg(test)]
mod tests {
    use super::super::rule::tests::assert_degree;
    use super::*;

    #[test]
    fn degrees() {
        for n in 1..24 {
            let odd = n - 1 + n % 2;
            assert_degree(&Rule::fejer_first(n), odd);
            assert_degree(&Rule::fejer_second(n), odd);
            if n % 2 == 0 {
                assert_degree(&Rule::clenshaw_curtis(n), n + 1);
            }
        }
    }

    #[test]
    fn small_rules_are_known() {
        // Clenshaw–Curtis on three nodes is Simpson's rule, on five 1/15, 8/15, 4/5.
        let weights = |rule: Rule| rule.points().iter().map(|p| p.weight).collect::<Vec<_>>();
        let five = [1.0 / 15.0, 8.0 / 15.0, 0.8, 8.0 / 15.0, 1.0 / 15.0];
        for (found, expected) in weights(Rule::clenshaw_curtis(4)).iter().zip(five) {
            assert!((found - expected).abs() < 1e-15, "{found}");
        }
        let simpson = weights(Rule::simpson(2));
        let three = weights(Rule::clenshaw_curtis(2));
        assert!(three.iter().zip(simpson).all(|(a, b)| (a - b).abs() < 1e-15));
    }

    #[test]
    fn nested_nodes_are_evaluated_once() {
        assert_eq!(Rule::clenshaw_curtis(64).points().len(), 65);
        assert_eq!(Rule::clenshaw_curtis(6).points().len(), 7);
        assert_eq!(Rule::fejer_first(81).points().len(), 81);
        assert_eq!(Rule::fejer_second(63).points().len(), 63);
    }

    #[test]
    fn converges_geometrically() {
        for n in [8, 16, 32, 64] {
            let pole = |[x]: [f64; 1]| 1.0 / (1.0 + 4.0 * x * x);
            for rule in [Rule::clenshaw_curtis(n), Rule::fejer_first(n), Rule::fejer_second(n - 1)]
            {
                let found = rule.integrate([-1.0], [1.0], pole);
                let error = (found.value - 2.0_f64.atan()).abs();
                // The poles ±i/2 are on the ellipse of sum (1 + √5)/2.
                let bound = 20.0 * 1.618_f64.powi(-(n as i32));
                assert!(error < bound + 1e-14, "{n}: {error:e}");
                assert!(error <= found.error + 1e-15, "{n}: {error:e} > {:e}", found.error);
            }
        }
    }
}
