//! Proofs and refutations by branch and bound over a box.

use super::{Enclosure, Rounding, counterexample};
use crate::num::Interval;
use crate::program::{Arg, Program};
use serde::{Deserialize, Serialize};
use std::cmp::Ordering;
use std::collections::{BinaryHeap, HashSet};

/// The bound that is claimed of an output for every input of the domain. NaN meets no bound.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Bound {
    /// Neither infinite nor NaN.
    Finite,
    /// At least this.
    AtLeast(f64),
    /// At most this.
    AtMost(f64),
}

/// A bound on one output of a program. To bound anything else (a sum of outputs), make it an output
/// first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Property {
    /// The index of the output.
    pub output: usize,
    /// The bound on its values.
    pub bound: Bound,
}

/// The outcome of a claim.
#[derive(Clone, Debug, PartialEq)]
pub enum Status {
    /// The claim holds for every input.
    Proved,
    /// The claim fails for an input in the interpreter's arithmetic, as it may on every GPU.
    Refuted {
        /// The counterexample.
        input: Vec<f32>,
        /// The interpreter's output there.
        value: f32,
    },
    /// The claim is neither proved nor refuted.
    Open {
        /// The share of the domain where it is not proved.
        volume: f64,
    },
}

/// The arithmetic, tolerance and effort of a proof.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// The arithmetic that the proof is about.
    pub rounding: Rounding,
    /// The absolute amount by which a value may violate a bound.
    pub slack: f64,
    /// The part of the slack that a proof may not use, since later use of the value rounds again.
    pub margin: f64,
    /// The most boxes to examine.
    pub boxes: usize,
}

/// A check, made between pieces of work of some microseconds, whether time is up.
pub type Stopped<'a> = &'a (dyn Fn() -> bool + Sync);

impl Limits {
    /// Returns limits with a slack of 1e-5, since `exp2(0)` may be a few ulp above 1 on a GPU, no
    /// margin, and as many boxes as take some tens of milliseconds.
    pub fn new(rounding: Rounding) -> Limits {
        Limits { rounding, slack: 1e-5, margin: 0.0, boxes: 20_000 }
    }
}

impl Property {
    /// Returns the property that an output keeps to a bound.
    pub fn of(output: usize, bound: Bound) -> Property {
        Property { output, bound }
    }

    /// Returns by how much a value fails, less the slack: infinite for NaN, at most 0 if it holds.
    pub fn excess(&self, value: f32, slack: f64) -> f64 {
        let x = f64::from(value);
        match self.bound {
            _ if x.is_nan() => f64::INFINITY,
            Bound::Finite => {
                if x.is_finite() {
                    -1.0
                } else {
                    f64::INFINITY
                }
            }
            Bound::AtLeast(low) => low - slack - x,
            Bound::AtMost(high) => x - high - slack,
        }
    }

    fn holds(&self, bounds: Interval, slack: f64) -> bool {
        let numbers = !bounds.may_be_nan();
        numbers
            && match self.bound {
                Bound::Finite => !bounds.may_be_infinite(),
                Bound::AtLeast(low) => f64::from(bounds.low()) >= low - slack,
                Bound::AtMost(high) => f64::from(bounds.high()) <= high + slack,
            }
    }
}

/// A part of the domain in which some claims are undecided.
struct Part {
    domain: Vec<Interval>,
    /// The share of the whole domain's volume.
    volume: f64,
    /// The undecided claims, a bit each.
    undecided: u64,
}

impl PartialEq for Part {
    fn eq(&self, other: &Part) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}
impl Eq for Part {}
impl PartialOrd for Part {
    fn partial_cmp(&self, other: &Part) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
impl Ord for Part {
    fn cmp(&self, other: &Part) -> Ordering {
        self.volume.total_cmp(&other.volume)
    }
}

/// Decides claims on a program wherever each input is any `f32` of its interval.
///
/// # Panics
/// If `domain` does not have one interval with finite bounds for each input, there are more than 64
/// claims, or one is on an output that the program does not have.
pub fn prove(
    program: &Program,
    domain: &[Interval],
    claims: &[Property],
    limits: &Limits,
) -> Vec<Status> {
    prove_until(program, domain, claims, limits, &|| false)
}

/// Decides claims as [`prove`] does, but leaves open what is undecided once `stopped` returns true.
/// What is decided before that is the same.
///
/// # Panics
/// As [`prove`] does.
pub(crate) fn prove_until(
    program: &Program,
    domain: &[Interval],
    claims: &[Property],
    limits: &Limits,
    stopped: Stopped,
) -> Vec<Status> {
    assert!(claims.len() <= 64, "at most 64 claims at a time");
    assert_eq!(domain.len(), program.inputs, "one interval for each input");
    let domain = &read_sides(program, domain);
    let mut refuted = counterexample::search(program, domain, claims, limits.slack);
    let mut enclosure = Enclosure::new(limits.rounding);
    let mut open = vec![0.0; claims.len()];
    let mut left = (0..claims.len()).filter(|&i| refuted[i].is_none()).fold(0, |s, i| s | 1 << i);
    let mut parts =
        BinaryHeap::from([Part { domain: domain.to_vec(), volume: 1.0, undecided: left }]);
    let mut going = true;
    for looked_at in 0.. {
        let Some(mut part) = parts.pop() else { break };
        part.undecided &= left;
        going &= looked_at < limits.boxes && !stopped();
        if going && part.undecided != 0 {
            enclosure.evaluate(program, &part.domain);
            for (i, claim) in marked(claims, part.undecided) {
                let bounds = enclosure.bounds(program, program.outputs[claim.output]);
                if claim.holds(bounds, limits.slack - limits.margin) {
                    part.undecided &= !(1 << i);
                }
            }
        }
        if going && part.undecided != 0 {
            let input: Vec<f32> = part.domain.iter().map(|&side| middle(side)).collect();
            let values = program.evaluate(&input);
            for (i, claim) in marked(claims, part.undecided) {
                if claim.excess(values[claim.output], limits.slack) > 0.0 {
                    refuted[i] = Some((input.clone(), values[claim.output]));
                    left &= !(1 << i);
                }
            }
            part.undecided &= left;
            if let Some(halves) = split(program, &enclosure, claims, &part, domain) {
                parts.extend(halves);
                continue;
            }
        }
        marked(claims, part.undecided).for_each(|(i, _)| open[i] += part.volume);
    }
    let status = |(found, volume): (Option<(Vec<f32>, f32)>, f64)| match found {
        Some((input, value)) => Status::Refuted { input, value },
        None if volume > 0.0 => Status::Open { volume },
        None => Status::Proved,
    };
    refuted.into_iter().zip(open).map(status).collect()
}

/// Returns the domain, with a point for the side of each input that the program does not read.
fn read_sides(program: &Program, domain: &[Interval]) -> Vec<Interval> {
    let args = program.instrs.iter().flat_map(|instr| instr.args()).chain(&program.outputs);
    let read: HashSet<Arg> = args.copied().collect();
    let side = |(i, side): (usize, &Interval)| match read.contains(&Arg::Input(i as u16)) {
        true => *side,
        false => Interval::new(side.low(), side.low()),
    };
    domain.iter().enumerate().map(side).collect()
}

/// Returns the claims whose bits are set, with their indices.
fn marked(claims: &[Property], bits: u64) -> impl Iterator<Item = (usize, &Property)> {
    claims.iter().enumerate().filter(move |(i, _)| bits >> i & 1 == 1)
}

fn middle(side: Interval) -> f32 {
    (side.low() / 2.0 + side.high() / 2.0).clamp(side.low(), side.high())
}

/// Halves a part across the side that seems to matter most; returns none for a point.
fn split(
    program: &Program,
    enclosure: &Enclosure,
    claims: &[Property],
    part: &Part,
    whole: &[Interval],
) -> Option<[Part; 2]> {
    let width = |side: Interval| f64::from(side.high()) - f64::from(side.low());
    let slopes: Vec<f64> = (0..part.domain.len())
        .map(|side| {
            let slope =
                |claim: &Property| enclosure.slope(program, program.outputs[claim.output], side);
            marked(claims, part.undecided).map(|(_, claim)| slope(claim)).sum()
        })
        .collect();
    let total: f64 = slopes.iter().sum();
    let importance = |i: usize| {
        let relative = width(part.domain[i]) / width(whole[i]).max(f64::MIN_POSITIVE);
        relative * (0.2 + if total > 0.0 { slopes[i] / total } else { 0.0 })
    };
    let divisible =
        (0..part.domain.len()).filter(|&i| part.domain[i].low() < part.domain[i].high());
    let side = divisible.max_by(|&a, &b| importance(a).total_cmp(&importance(b)))?;
    let (low, high) = (part.domain[side].low(), part.domain[side].high());
    let cut = middle(part.domain[side]);
    // Two neighbouring numbers go to one half each; otherwise the cut belongs to both halves.
    let sides = match low.next_up() == high {
        true => [Interval::new(low, low), Interval::new(high, high)],
        false => [Interval::new(low, cut), Interval::new(cut, high)],
    };
    Some(sides.map(|half| {
        let mut domain = part.domain.clone();
        domain[side] = half;
        Part { domain, volume: part.volume / 2.0, undecided: part.undecided }
    }))
}
