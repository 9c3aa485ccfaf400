//! The double-exponential rule.

use super::Estimate;
use std::f64::consts::{FRAC_PI_2, PI};

/// The number of step sizes: the first, its half, its quarter, … By hand: 2⁻⁹ leaves thousands of
/// nodes.
const LEVELS: usize = 10;
/// The t beyond which weights fall below the smallest positive f64.
const REACH: f64 = 6.1;
/// The least t at which a sum is cut off. By hand.
const LEAST_REACH: f64 = 2.0;
/// The first level whose agreement with the one before is trusted: earlier ones may agree by
/// chance. By hand.
const LEAST_LEVEL: usize = 3;

/// A place of evaluation, with the distances from both ends, which stay accurate where `x` itself
/// rounds to an end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Abscissa {
    /// The place, in [a, b].
    pub x: f64,
    /// x - a, positive.
    pub from_a: f64,
    /// b - x, positive.
    pub from_b: f64,
}

#[derive(Clone, Copy, Debug)]
struct Node {
    t: f64,
    /// 1 - |tanh(π/2 sinh t)|.
    complement: f64,
    weight: f64,
}

/// The double-exponential rule of Takahasi and Mori (1974): the trapezoidal rule after x = tanh(π/2
/// sinh t). It converges exponentially for integrands that are analytic inside the interval,
/// whatever integrable or nearby singularity they have at its ends.
#[derive(Clone, Debug)]
pub struct TanhSinh {
    /// The nodes with t > 0 that each level adds, ascending in t.
    levels: Vec<Vec<Node>>,
}

impl Default for TanhSinh {
    fn default() -> TanhSinh {
        TanhSinh::new()
    }
}

impl TanhSinh {
    /// Computes the nodes. Make one and use it for many integrals.
    pub fn new() -> TanhSinh {
        TanhSinh { levels: (0..LEVELS).map(new_nodes).collect() }
    }

    /// Integrates `f` over the finite interval [a, b], a ≤ b: halves the step until two results
    /// differ by no more than `tolerance` (absolute), at most nine times. An estimate whose `error`
    /// exceeds the tolerance has not converged. A value of `f` that is not finite makes the result
    /// NaN and its error infinite, except near the end of the interval, where `x` may round to a
    /// singularity: there it ends the sum.
    pub fn integrate(
        &self,
        a: f64,
        b: f64,
        tolerance: f64,
        f: impl Fn(Abscissa) -> f64,
    ) -> Estimate {
        let [estimate] = self.integrate_all(a, b, tolerance, |abscissa| [f(abscissa)]);
        estimate
    }

    /// Integrates `N` functions at once, refining until all have converged.
    pub fn integrate_all<const N: usize>(
        &self,
        a: f64,
        b: f64,
        tolerance: f64,
        f: impl Fn(Abscissa) -> [f64; N],
    ) -> [Estimate; N] {
        let half = 0.5 * (b - a);
        let middle = Abscissa { x: a + half, from_a: half, from_b: half };
        let mut sum = Sum { values: f(middle).map(|v| v * FRAC_PI_2), evaluations: 1 };
        let mut estimates = [Estimate { value: 0.0, error: f64::INFINITY, evaluations: 0 }; N];
        for (level, nodes) in self.levels.iter().enumerate() {
            let step = half * 0.5_f64.powi(level as i32);
            // By hand: thousands of such terms stay below the tolerance.
            let negligible = 1e-4 * tolerance / step.max(f64::MIN_POSITIVE);
            let left = |node: &Node| near_a(a, b, half * node.complement);
            let right = |node: &Node| near_b(a, b, half * node.complement);
            sum.add_side(nodes, negligible, |node| f(left(node)));
            sum.add_side(nodes, negligible, |node| f(right(node)));
            for (estimate, total) in estimates.iter_mut().zip(sum.values) {
                let value = step * total;
                let error = (value - estimate.value).abs();
                let error = if error.is_finite() { error } else { f64::INFINITY };
                *estimate = Estimate { value, error, evaluations: sum.evaluations };
            }
            let converged = estimates.iter().all(|estimate| estimate.error <= tolerance);
            let broken = estimates.iter().any(|estimate| !estimate.value.is_finite());
            if broken || converged && level >= LEAST_LEVEL {
                break;
            }
        }
        estimates
    }
}

struct Sum<const N: usize> {
    values: [f64; N],
    evaluations: usize,
}

impl<const N: usize> Sum<N> {
    /// Adds the new nodes on one side of the middle, from the middle outwards.
    fn add_side(&mut self, nodes: &[Node], negligible: f64, f: impl Fn(&Node) -> [f64; N]) {
        let mut negligible_before = false;
        for node in nodes {
            let terms = f(node).map(|value| value * node.weight);
            self.evaluations += 1;
            let in_tail = node.t > LEAST_REACH;
            if in_tail && terms.iter().any(|term| !term.is_finite()) {
                return;
            }
            for (sum, term) in self.values.iter_mut().zip(terms) {
                *sum += term;
            }
            // The weights fall doubly exponentially: the rest of the tail is about as large as its
            // first term. One small term may be a root of the integrand.
            let small = terms.iter().all(|term| term.abs() <= negligible);
            if in_tail && small && negligible_before {
                return;
            }
            negligible_before = small;
        }
    }
}

fn near_a(a: f64, b: f64, distance: f64) -> Abscissa {
    Abscissa { x: a + distance, from_a: distance, from_b: (b - a) - distance }
}

fn near_b(a: f64, b: f64, distance: f64) -> Abscissa {
    Abscissa { x: b - distance, from_a: (b - a) - distance, from_b: distance }
}

fn new_nodes(level: usize) -> Vec<Node> {
    let step = 0.5_f64.powi(level as i32);
    let stride = if level == 0 { 1 } else { 2 };
    (1..)
        .step_by(stride)
        .map(|k| f64::from(k) * step)
        .take_while(|&t| t <= REACH)
        .map(node)
        .filter(|node| node.weight > 0.0)
        .collect()
}

fn node(t: f64) -> Node {
    let complement = 2.0 / (1.0 + (PI * t.sinh()).exp());
    let weight = FRAC_PI_2 * t.cosh() * complement * (2.0 - complement);
    Node { t, complement, weight }
}

#[cfg(test)]
mod tests {
    use super::{Abscissa, TanhSinh};
    use std::f64::consts::PI;

    /// Name, interval, integrand, integral.
    type Case = (&'static str, [f64; 2], fn(Abscissa) -> f64, f64);

    const CASES: [Case; 9] = [
        ("1", [-3.0, 5.0], |_| 1.0, 8.0),
        ("x^2 e^x", [0.0, 1.0], |p| p.x * p.x * p.x.exp(), std::f64::consts::E - 2.0),
        ("1/sqrt x", [0.0, 1.0], |p| 1.0 / p.from_a.sqrt(), 2.0),
        ("1/sqrt(1-x^2)", [-1.0, 1.0], |p| 1.0 / (p.from_a * p.from_b).sqrt(), PI),
        ("ln x", [0.0, 1.0], |p| p.x.ln(), -1.0),
        ("ln x / sqrt x", [0.0, 1.0], |p| p.x.ln() / p.x.sqrt(), -4.0),
        ("sqrt(2 - x)", [1.0, 2.0], |p| p.from_b.sqrt(), 2.0 / 3.0),
        ("1/(1e-6 + x)", [0.0, 1.0], |p| 1.0 / (1e-6 + p.x), 13.815_511_557_963_774),
        ("cos 30x", [0.0, 1.0], |p| (30.0 * p.x).cos(), -0.032_934_387_469_762_06),
    ];

    #[test]
    fn known_integrals() {
        let rule = TanhSinh::new();
        for (name, [a, b], f, expected) in CASES {
            let estimate = rule.integrate(a, b, 1e-11, f);
            let error = (estimate.value - expected).abs();
            assert!(error < 1e-12, "{name}: {estimate:?}, error {error:e}");
            assert!(estimate.error <= 1e-11, "{name}: {estimate:?}");
            assert!(estimate.evaluations < 1000, "{name}: {estimate:?}");
        }
    }

    #[test]
    fn a_loose_tolerance_is_kept_with_fewer_evaluations() {
        let rule = TanhSinh::new();
        for (name, [a, b], f, expected) in CASES {
            let [loose, tight] = [1e-4, 1e-11].map(|tolerance| rule.integrate(a, b, tolerance, f));
            assert!((loose.value - expected).abs() < 1e-4, "{name}: {loose:?}");
            assert!(loose.evaluations < tight.evaluations, "{name}");
        }
    }

    #[test]
    fn empty_interval_and_several_integrands() {
        let rule = TanhSinh::new();
        assert_eq!(rule.integrate(2.0, 2.0, 1e-9, |p| p.x).value, 0.0);
        let [one, square] = rule.integrate_all(0.0, 2.0, 1e-12, |p| [1.0, p.x * p.x]);
        assert!((one.value - 2.0).abs() < 1e-14 && (square.value - 8.0 / 3.0).abs() < 1e-14);
    }

    #[test]
    fn says_when_it_has_not_converged() {
        let rule = TanhSinh::new();
        let noise = rule.integrate(0.0, 1.0, 1e-12, |p| (1e6 * p.x).sin().signum());
        assert!(noise.error > 1e-12);
        let pole = rule.integrate(-1.0, 1.0, 1e-9, |p| 1.0 / p.x);
        assert!(pole.error.is_infinite(), "{pole:?}");
    }
}
