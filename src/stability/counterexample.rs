//! Searches for counterexamples: inputs at which claims fail.

use super::{Property, points};
use crate::num::Interval;
use crate::program::Program;

/// The approximate number of inputs tried, on a grid over the domain with its corners and edges.
/// Chosen by hand, unmeasured.
const GRID: f64 = 4096.0;

/// The most rounds of steps from a failure found to a worse one. Chosen by hand, unmeasured.
const CLIMBS: usize = 60;

/// Returns for each claim an input that refutes it, if one is found, and the output there: the
/// worst nearby, and a number rather than NaN where a number fails, too.
pub(super) fn search(
    program: &Program,
    domain: &[Interval],
    claims: &[Property],
    slack: f64,
) -> Vec<Option<(Vec<f32>, f32)>> {
    let sides = domain.iter().filter(|side| side.low() < side.high()).count().max(1);
    let per_side = (GRID.powf(1.0 / sides as f64) as usize).clamp(2, 1025);
    let axes: Vec<Vec<f32>> = domain.iter().map(|&side| axis(side, per_side)).collect();
    let mut worst: Vec<Option<(f64, Vec<f32>)>> = vec![None; claims.len()];
    points::each(&axes, |input| {
        let values = program.evaluate(input);
        for (claim, worst) in claims.iter().zip(&mut worst) {
            let rank = rank(claim, values[claim.output], slack);
            if rank > worst.as_ref().map_or(0.0, |(known, _)| *known) {
                *worst = Some((rank, input.to_vec()));
            }
        }
    });
    let finished = claims.iter().zip(worst).map(|(claim, worst)| {
        let (rank, input) = worst?;
        let input = climbed(program, domain, claim, slack, per_side, (rank, input));
        let value = program.evaluate(&input)[claim.output];
        Some((input, value))
    });
    finished.collect()
}

/// Ranks a value, more being worse. Every number that fails is worse than NaN, since it says more.
fn rank(claim: &Property, value: f32, slack: f64) -> f64 {
    let excess = claim.excess(value, slack);
    if value.is_nan() { f64::MIN_POSITIVE } else { excess }
}

fn axis(side: Interval, count: usize) -> Vec<f32> {
    let (low, high) = (f64::from(side.low()), f64::from(side.high()));
    if low == high {
        return vec![side.low()];
    }
    let at = |i: usize| low + (high - low) * (i as f64 / (count - 1) as f64);
    (0..count).map(|i| (at(i) as f32).clamp(side.low(), side.high())).collect()
}

/// Climbs from a failure to a worse one, coordinate by coordinate, with steps that shrink.
fn climbed(
    program: &Program,
    domain: &[Interval],
    claim: &Property,
    slack: f64,
    per_side: usize,
    (mut known, mut input): (f64, Vec<f32>),
) -> Vec<f32> {
    let mut share = 1.0 / (per_side - 1).max(1) as f32;
    for _ in 0..CLIMBS {
        let mut better = false;
        for i in 0..input.len() {
            for sign in [-1.0, 1.0] {
                let (before, side) = (input[i], domain[i]);
                let step = sign * share * (side.high() - side.low());
                input[i] = (before + step).clamp(side.low(), side.high());
                let rank = rank(claim, program.evaluate(&input)[claim.output], slack);
                if rank > known && rank.is_finite() {
                    (known, better) = (rank, true);
                } else {
                    input[i] = before;
                }
            }
        }
        if !better {
            share /= 2.0;
        }
    }
    input
}
