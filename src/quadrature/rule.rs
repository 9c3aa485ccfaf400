//! Fixed rules.

use super::Estimate;

/// Nodes nearer than this are the same, computed in two ways by nested rules: tens of ulps.
const SAME_NODE: f64 = 1e-14;

/// A node of a rule on [-1, 1].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// The place, in [-1, 1].
    pub node: f64,
    /// The weight in the rule itself; 0 at nodes of the coarser rule alone.
    pub weight: f64,
    /// The weight in the coarser rule that estimates the error; 0 at nodes that it lacks.
    pub coarse: f64,
}

/// A fixed rule, `∫ f ≈ Σ weight · f(node)`, and a coarser one beside it that
/// reuses every node they share.
#[derive(Clone, Debug)]
pub struct Rule {
    /// Ascending.
    points: Vec<Point>,
}

/// A rule's result in a box.
#[derive(Clone, Copy, Debug)]
pub(super) struct Found {
    pub value: f64,
    pub error: f64,
    /// The axis along which the coarser rule differs most.
    pub worst_axis: usize,
    pub evaluations: usize,
}

impl Rule {
    /// Makes a rule of nodes and weights on [-1, 1], and those of a coarser rule.
    pub(super) fn new(fine: &[(f64, f64)], coarse: &[(f64, f64)]) -> Rule {
        let fine = fine.iter().map(|&(node, weight)| Point { node, weight, coarse: 0.0 });
        let coarse = coarse.iter().map(|&(node, coarse)| Point { node, weight: 0.0, coarse });
        let mut points: Vec<Point> = fine.chain(coarse).collect();
        points.sort_by(|a, b| a.node.total_cmp(&b.node));
        points.dedup_by(|other, kept| {
            let same = (other.node - kept.node).abs() <= SAME_NODE;
            if same {
                kept.weight += other.weight;
                kept.coarse += other.coarse;
            }
            same
        });
        Rule { points }
    }

    /// Returns the nodes of both rules in [-1, 1], ascending; each rule's weights add up to 2.
    pub fn points(&self) -> &[Point] {
        &self.points
    }

    /// Integrates `f` over the box between two corners, by the product of the rule with itself in
    /// `D` variables. The error is the sum, over the axes, of the change by the coarser rule along
    /// that axis alone.
    pub fn integrate<const D: usize>(
        &self,
        low: [f64; D],
        high: [f64; D],
        f: impl Fn([f64; D]) -> f64,
    ) -> Estimate {
        let found = self.apply(low, high, &f);
        Estimate::checked(found.value, found.error, found.evaluations)
    }

    pub(super) fn apply<const D: usize>(
        &self,
        low: [f64; D],
        high: [f64; D],
        f: &impl Fn([f64; D]) -> f64,
    ) -> Found {
        let half: [f64; D] = std::array::from_fn(|axis| 0.5 * (high[axis] - low[axis]));
        let mut sum = 0.0;
        let mut coarse_along = [0.0; D];
        let mut evaluations = 0;
        let mut indices = [0; D];
        loop {
            let points = indices.map(|index| self.points[index]);
            // Nodes of the coarser rule along two axes have no weight in any sum.
            if points.iter().filter(|point| point.weight == 0.0).count() <= 1 {
                let value = f(std::array::from_fn(|axis| {
                    low[axis] + half[axis] * (1.0 + points[axis].node)
                }));
                evaluations += 1;
                sum += points.iter().map(|point| point.weight).product::<f64>() * value;
                for (axis, coarse) in coarse_along.iter_mut().enumerate() {
                    *coarse += weight_coarse_along(axis, &points) * value;
                }
            }
            if !advance(&mut indices, self.points.len()) {
                break;
            }
        }
        let scale: f64 = half.iter().product();
        let errors = coarse_along.map(|coarse| (scale * (sum - coarse)).abs());
        let worst = (0..D).max_by(|&a, &b| errors[a].total_cmp(&errors[b]));
        Found {
            value: scale * sum,
            error: errors.iter().sum(),
            worst_axis: worst.unwrap_or(0),
            evaluations,
        }
    }
}

fn weight_coarse_along(coarse: usize, points: &[Point]) -> f64 {
    let weight = |(axis, point): (usize, &Point)| match axis == coarse {
        true => point.coarse,
        false => point.weight,
    };
    points.iter().enumerate().map(weight).product()
}

/// Advances the indices, the last varying fastest; false if none is left below `count`.
fn advance(indices: &mut [usize], count: usize) -> bool {
    for index in indices.iter_mut().rev() {
        *index += 1;
        if *index < count {
            return true;
        }
        *index = 0;
    }
    false
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use std::f64::consts::PI;

    /// Returns true if the rule integrates every polynomial of the degree exactly and, where it is
    /// low, no more.
    pub fn assert_degree(rule: &Rule, degree: usize) {
        let error = |power: usize| {
            let expected = if power.is_multiple_of(2) { 2.0 / (power as f64 + 1.0) } else { 0.0 };
            (rule.integrate([-1.0], [1.0], |[x]| x.powi(power as i32)).value - expected).abs()
        };
        for power in 0..=degree {
            assert!(error(power) < 2e-14, "x^{power}: {:e}", error(power));
        }
        if degree < 12 {
            // A symmetric rule is exact for odd powers.
            let next = (degree + 2) & !1;
            assert!(error(next) > 1e-9, "x^{next} is exact, too");
        }
        let [fine, coarse] = [|p: &Point| p.weight, |p: &Point| p.coarse]
            .map(|weight| rule.points().iter().map(weight).sum::<f64>());
        assert!((fine - 2.0).abs() < 1e-13 && (coarse - 2.0).abs() < 1e-13, "{fine} {coarse}");
    }

    fn rules() -> [(&'static str, Rule); 9] {
        [
            ("midpoint", Rule::midpoint(27)),
            ("trapezoid", Rule::trapezoid(16)),
            ("simpson", Rule::simpson(16)),
            ("gauss_legendre", Rule::gauss_legendre(8)),
            ("gauss_kronrod", Rule::gauss_kronrod(7)),
            ("clenshaw_curtis", Rule::clenshaw_curtis(16)),
            ("fejer_first", Rule::fejer_first(15)),
            ("fejer_second", Rule::fejer_second(15)),
            ("even midpoint", Rule::midpoint(10)),
        ]
    }

    #[test]
    fn products_integrate_products() {
        for (name, rule) in rules() {
            let f = |[x, y, z]: [f64; 3]| x.cos() * y.exp() * (1.0 + z);
            let product = rule.integrate([0.0; 3], [1.0, 2.0, 0.5], f);
            let along = [
                rule.integrate([0.0], [1.0], |[x]| x.cos()).value,
                rule.integrate([0.0], [2.0], |[y]| y.exp()).value,
                rule.integrate([0.0], [0.5], |[z]| 1.0 + z).value,
            ];
            assert!((product.value - along.iter().product::<f64>()).abs() < 1e-12, "{name}");
            let exact = 1.0_f64.sin() * (2.0_f64.exp() - 1.0) * 0.625;
            let error = (product.value - exact).abs();
            assert!(error <= product.error + 1e-13, "{name}: {error:e} > {:e}", product.error);
        }
    }

    #[test]
    fn limits_may_be_swapped_or_meet() {
        for (name, rule) in rules() {
            let there = rule.integrate([0.0], [2.0], |[x]| x.exp()).value;
            let back = rule.integrate([2.0], [0.0], |[x]| x.exp()).value;
            assert!((there + back).abs() < 1e-13, "{name}");
            assert_eq!(rule.integrate([1.0, 0.0], [1.0, 3.0], |[x, y]| x + y).value, 0.0);
        }
    }

    #[test]
    fn what_is_no_number_has_an_infinite_error() {
        for (name, rule) in rules() {
            let broken = rule.integrate([0.0], [1.0], |[x]| if x > 0.5 { f64::NAN } else { x });
            assert!(broken.value.is_nan() && broken.error == f64::INFINITY, "{name}");
        }
    }

    #[test]
    fn the_midpoint_rule_is_exact_over_a_period() {
        // 2π times the modified Bessel function I0(1) (Abramowitz & Stegun, table 9.8).
        let found = Rule::midpoint(18).integrate([0.0], [2.0 * PI], |[x]| x.cos().exp());
        assert!((found.value - 2.0 * PI * 1.266_065_877_752_008_4).abs() < 1e-13, "{found:?}");
    }
}
