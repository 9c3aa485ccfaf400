//! Gauss–Kronrod rules: the optimal extension of a Gauss rule by n + 1 points.
//!
//! Kronrod, "Nodes and Weights of Quadrature Formulas", 1965. The new nodes are
//! the roots of Stieltjes' polynomial E of degree n + 1, which is orthogonal to
//! every polynomial of degree ≤ n under the weight Pₙ:
//! `∫ Pₙ(x) E(x) xᵏ dx = 0, k = 0…n`. Written in Legendre polynomials,
//! `E = Pₙ₊₁ + eₙ₋₁ Pₙ₋₁ + eₙ₋₃ Pₙ₋₃ + …`, and tested against P₁, P₃, …, these
//! conditions are triangular, since `∫ Pₙ Pᵢ Pₖ = 0` for i + k < n. Its roots
//! interlace with Gauss' nodes (Szegő, 1935).

use super::Rule;
use super::gauss::{legendre, points};

impl Rule {
    /// The Gauss–Kronrod rule of 2n + 1 points, 1 ≤ n ≤ 30: exact for
    /// polynomials of degree 3n + 1. The coarser rule is Gauss' of n points,
    /// all of them nodes of the finer. Usual are n = 7 and n = 10.
    ///
    /// # Panics
    /// If `n` is out of its range.
    pub fn gauss_kronrod(n: usize) -> Rule {
        assert!((1..=30).contains(&n), "a Gauss–Kronrod rule extends 1 to 30 points, not {n}");
        let gauss = points(n);
        let stieltjes = Stieltjes::new(n);
        let ends = std::iter::once(-1.0).chain(gauss.iter().map(|p| p.0)).chain([1.0]);
        let ends: Vec<f64> = ends.collect();
        let roots = ends.windows(2).map(|pair| stieltjes.root_between(pair[0], pair[1]));
        let mut nodes: Vec<f64> = roots.chain(gauss.iter().map(|p| p.0)).collect();
        nodes.sort_by(f64::total_cmp);
        let fine: Vec<(f64, f64)> =
            (0..nodes.len()).map(|i| (nodes[i], interpolatory_weight(&nodes, i))).collect();
        Rule::new(&fine, &gauss)
    }
}

/// Coefficients of E in Legendre polynomials: degree and factor.
struct Stieltjes(Vec<(usize, f64)>);

impl Stieltjes {
    fn new(n: usize) -> Stieltjes {
        let rule = points(2 * n + 2);
        let triple = |i: usize, k: usize| -> f64 {
            let product = |x: f64| legendre(n, x).0 * legendre(i, x).0 * legendre(k, x).0;
            rule.iter().map(|&(x, weight)| weight * product(x)).sum()
        };
        let mut terms = vec![(n + 1, 1.0)];
        for k in (1..=n).step_by(2) {
            let known: f64 = terms.iter().map(|&(i, factor)| factor * triple(i, k)).sum();
            terms.push((n - k, -known / triple(n - k, k)));
        }
        Stieltjes(terms)
    }

    fn at(&self, x: f64) -> f64 {
        self.0.iter().map(|&(degree, factor)| factor * legendre(degree, x).0).sum()
    }

    fn root_between(&self, mut low: f64, mut high: f64) -> f64 {
        if low == -high {
            return 0.0;
        }
        // The derivative of `legendre` has no value at the ends: bisection.
        let rising = self.at(high) > 0.0;
        loop {
            let middle = 0.5 * (low + high);
            if middle <= low || middle >= high {
                return middle;
            }
            match (self.at(middle) > 0.0) == rising {
                true => high = middle,
                false => low = middle,
            }
        }
    }
}

/// The integral of the polynomial that is 1 at one node and 0 at the others.
fn interpolatory_weight(nodes: &[f64], chosen: usize) -> f64 {
    let lagrange = |x: f64| -> f64 {
        let others = nodes.iter().enumerate().filter(|&(i, _)| i != chosen);
        others.map(|(_, node)| (x - node) / (nodes[chosen] - node)).product()
    };
    points(nodes.len().div_ceil(2)).iter().map(|&(x, weight)| weight * lagrange(x)).sum()
}

#[cfg(test)]
mod tests {
    use super::super::Point;
    use super::super::rule::tests::assert_degree;
    use super::*;

    #[test]
    fn degrees() {
        for n in 1..=30 {
            let rule = Rule::gauss_kronrod(n);
            assert_eq!(rule.points().len(), 2 * n + 1, "{n}");
            assert!(rule.points().iter().all(|p| p.weight > 0.0 && p.node.abs() < 1.0), "{n}");
            assert_degree(&rule, 3 * n + 1);
        }
    }

    #[test]
    fn nodes_and_weights_are_those_of_quadpack() {
        // Piessens et al., QUADPACK, 1983, subroutines qk15 and qk21.
        let at = |n: usize, i: usize| Rule::gauss_kronrod(n).points()[i];
        let expected = [
            (at(7, 14), 0.991_455_371_120_812_6, 0.022_935_322_010_529_22),
            (at(7, 7), 0.0, 0.209_482_141_084_727_83),
            (at(10, 20), 0.995_657_163_025_808_1, 0.011_694_638_867_371_874),
            (at(10, 19), 0.973_906_528_517_171_7, 0.032_558_162_307_964_725),
        ];
        for (Point { node, weight, .. }, expected_node, expected_weight) in expected {
            assert!((node - expected_node).abs() < 1e-15, "{node}");
            assert!((weight - expected_weight).abs() < 1e-15, "{weight}");
        }
    }
}
