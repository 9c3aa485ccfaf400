//! Adaptive subdivision of boxes.

use super::Estimate;
use super::rule::{Found, Rule};
use crate::num::CompensatedSum;
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// Adaptive subdivision: boxes where the rule and its coarser one differ are
/// halved along the axis on which they differ most. Each box is integrated
/// once with nodes that both rules share (Pesce and Iwanicki, "Approximate
/// Models for Physically Based Rendering", 2015, §3.1.1).
#[derive(Clone, Copy, Debug)]
pub struct Adaptive<'a> {
    rule: &'a Rule,
    tolerance: f64,
    most_evaluations: usize,
}

#[derive(Clone, Copy)]
struct Tile<const D: usize> {
    low: [f64; D],
    high: [f64; D],
    found: Found,
}

impl<'a> Adaptive<'a> {
    /// Integrates until the estimated error is no more than `tolerance` (absolute), or, leaving a
    /// larger error, for a million evaluations (by hand).
    pub fn new(rule: &'a Rule, tolerance: f64) -> Adaptive<'a> {
        Adaptive { rule, tolerance, most_evaluations: 1_000_000 }
    }

    /// Sets another limit of evaluations; one more halving may exceed it.
    pub fn most_evaluations(self, most_evaluations: usize) -> Adaptive<'a> {
        Adaptive { most_evaluations, ..self }
    }

    /// Halves the first box whose error is above its share of the tolerance, by recursion. This
    /// needs no memory, but spends evaluations where others would have gained more.
    pub fn local<const D: usize>(
        &self,
        low: [f64; D],
        high: [f64; D],
        f: impl Fn([f64; D]) -> f64,
    ) -> Estimate {
        let whole = self.tile(low, high, &f);
        let mut total = Total { evaluations: whole.found.evaluations, ..Total::default() };
        self.refine(whole, self.tolerance, &mut total, &f);
        Estimate::checked(total.value.value(), total.error.value(), total.evaluations)
    }

    fn refine<const D: usize>(
        &self,
        tile: Tile<D>,
        share: f64,
        total: &mut Total,
        f: &impl Fn([f64; D]) -> f64,
    ) {
        let done = tile.found.error <= share || !tile.found.error.is_finite();
        let halves = tile.halves().filter(|_| !done && total.evaluations < self.most_evaluations);
        let Some(halves) = halves else {
            total.value += tile.found.value;
            total.error += tile.found.error;
            return;
        };
        for [low, high] in halves {
            let half = self.tile(low, high, f);
            total.evaluations += half.found.evaluations;
            self.refine(half, 0.5 * share, total, f);
        }
    }

    /// Halves the box with the largest error, kept on a heap, until the errors add up to no more
    /// than the tolerance.
    pub fn global<const D: usize>(
        &self,
        low: [f64; D],
        high: [f64; D],
        f: impl Fn([f64; D]) -> f64,
    ) -> Estimate {
        let whole = self.tile(low, high, &f);
        let mut evaluations = whole.found.evaluations;
        let mut error = whole.found.error;
        let mut open = BinaryHeap::from([whole]);
        // Too small to be halved.
        let mut closed: Vec<Tile<D>> = Vec::new();
        // Also false if the error is NaN.
        while error > self.tolerance && error < f64::INFINITY && evaluations < self.most_evaluations
        {
            let Some(worst) = open.pop() else { break };
            let Some(halves) = worst.halves() else {
                closed.push(worst);
                continue;
            };
            error -= worst.found.error;
            for [low, high] in halves {
                let half = self.tile(low, high, &f);
                evaluations += half.found.evaluations;
                error += half.found.error;
                open.push(half);
            }
        }
        let tiles = || open.iter().chain(&closed);
        let value: CompensatedSum = tiles().map(|tile| tile.found.value).collect();
        let error: CompensatedSum = tiles().map(|tile| tile.found.error).collect();
        Estimate::checked(value.value(), error.value(), evaluations)
    }

    fn tile<const D: usize>(
        &self,
        low: [f64; D],
        high: [f64; D],
        f: &impl Fn([f64; D]) -> f64,
    ) -> Tile<D> {
        Tile { low, high, found: self.rule.apply(low, high, f) }
    }
}

#[derive(Default)]
struct Total {
    value: CompensatedSum,
    error: CompensatedSum,
    evaluations: usize,
}

impl<const D: usize> Tile<D> {
    /// Returns the corners of both halves, or none if no number lies between.
    fn halves(&self) -> Option<[[[f64; D]; 2]; 2]> {
        let axis = self.found.worst_axis;
        let (low, high) = (self.low[axis], self.high[axis]);
        let middle = low + 0.5 * (high - low);
        if middle == low || middle == high {
            return None;
        }
        let (mut first_end, mut second_start) = (self.high, self.low);
        first_end[axis] = middle;
        second_start[axis] = middle;
        Some([[self.low, first_end], [second_start, self.high]])
    }
}

impl<const D: usize> Ord for Tile<D> {
    fn cmp(&self, other: &Self) -> Ordering {
        self.found.error.total_cmp(&other.found.error)
    }
}

impl<const D: usize> PartialOrd for Tile<D> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl<const D: usize> PartialEq for Tile<D> {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl<const D: usize> Eq for Tile<D> {}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::Cell;
    use std::f64::consts::PI;

    type Case = (&'static str, fn(f64) -> f64, f64);

    const CASES: [Case; 5] = [
        ("1/(1e-6 + x)", |x| 1.0 / (1e-6 + x), 13.815_511_557_963_774),
        ("sqrt x", f64::sqrt, 2.0 / 3.0),
        ("step at 0.3", |x| if x < 0.3 { 1.0 } else { 0.0 }, 0.3),
        ("cos 30x", |x| (30.0 * x).cos(), -0.032_934_387_469_762_06),
        ("peak", |x| 1e-3 / ((x - 0.3) * (x - 0.3) + 1e-6), 3.136_830_762_145_301_3),
    ];

    fn rules() -> [(&'static str, Rule); 4] {
        [
            ("gauss_kronrod", Rule::gauss_kronrod(7)),
            ("clenshaw_curtis", Rule::clenshaw_curtis(16)),
            ("fejer_second", Rule::fejer_second(15)),
            ("simpson", Rule::simpson(8)),
        ]
    }

    #[test]
    fn known_integrals_of_one_variable() {
        for (name, f, expected) in CASES {
            for (rule_name, rule) in &rules() {
                let adaptive = Adaptive::new(rule, 1e-8);
                let local = adaptive.local([0.0], [1.0], |[x]| f(x));
                let global = adaptive.global([0.0], [1.0], |[x]| f(x));
                for found in [local, global] {
                    let error = (found.value - expected).abs();
                    assert!(error <= 1e-8, "{name}, {rule_name}: {found:?}, {error:e}");
                    assert!(found.error <= 1e-8, "{name}, {rule_name}: {found:?}");
                }
                assert!(global.evaluations <= local.evaluations, "{name}, {rule_name}");
            }
        }
    }

    #[test]
    fn known_integrals_of_two_variables() {
        let rule = Rule::gauss_kronrod(7);
        let adaptive = Adaptive::new(&rule, 1e-6);
        type Integrand = fn([f64; 2]) -> f64;
        // ∫∫ 1/(1 - xy) = π²/6 is singular at a corner; along a ridge it is
        // √π/10 erf 10 - (1 - e⁻¹⁰⁰)/100.
        let cases: [(Integrand, f64); 2] = [
            (|[x, y]| 1.0 / (1.0 - x * y), PI * PI / 6.0),
            (|[x, y]| (-100.0 * (x - y) * (x - y)).exp(), 0.1 * PI.sqrt() - 0.01),
        ];
        for (f, expected) in cases {
            let local = adaptive.local([0.0; 2], [1.0; 2], f);
            let global = adaptive.global([0.0; 2], [1.0; 2], f);
            for found in [local, global] {
                let error = (found.value - expected).abs();
                assert!(error <= 1e-6 && found.error <= 1e-6, "{found:?}, {error:e}");
            }
            assert!(global.evaluations <= local.evaluations);
        }
    }

    #[test]
    fn evaluations_are_counted_and_limited() {
        let rule = Rule::gauss_kronrod(7);
        let count = Cell::new(0);
        let noise = |[x]: [f64; 1]| {
            count.set(count.get() + 1);
            (1e6 * x).sin().signum()
        };
        let adaptive = Adaptive::new(&rule, 1e-12).most_evaluations(1000);
        let global = adaptive.global([0.0], [1.0], noise);
        assert_eq!(global.evaluations, count.replace(0));
        assert!((1000..1030).contains(&global.evaluations) && global.error > 1e-12);
        let local = adaptive.local([0.0], [1.0], noise);
        assert_eq!(local.evaluations, count.get());
        assert!((1000..2000).contains(&local.evaluations) && local.error > 1e-12, "{local:?}");
    }

    #[test]
    fn one_box_is_enough_for_a_polynomial() {
        let rule = Rule::gauss_kronrod(7);
        let adaptive = Adaptive::new(&rule, 1e-12);
        let found = adaptive.global([0.0, -1.0], [2.0, 1.0], |[x, y]| x * x * (1.0 + y * y));
        assert_eq!(found.evaluations, 15 * 15);
        assert!((found.value - 64.0 / 9.0).abs() < 1e-13);
    }

    #[test]
    fn ends_where_nothing_can_be_halved_or_is_no_number() {
        let rule = Rule::gauss_kronrod(7);
        let adaptive = Adaptive::new(&rule, 1e-9);
        for pole in [|[x]: [f64; 1]| 1.0 / x, |_| f64::NAN, |_| f64::INFINITY] {
            for found in [adaptive.local([-1.0], [1.0], pole), adaptive.global([-1.0], [1.0], pole)]
            {
                assert_eq!(found.error, f64::INFINITY, "{found:?}");
            }
        }
        assert_eq!(adaptive.global([1.0], [1.0], |[x]| x).value, 0.0);
    }
}
