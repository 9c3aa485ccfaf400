//! Half and single precision mixed: values that no half holds, instructions that must stay single.

use super::blame::traced;
use super::half::{Mixed, Points, Tried, exact, points, rounded};
use super::variants::Variant;
use crate::num::Interval;
use crate::program::{Arg, Program, use_counts};
use half::f16;

/// The approximate number of points tried, if not all are. Chosen by hand, unmeasured.
pub(super) const POINTS: usize = 8192;

/// The number of points at which a set is tried before all. Chosen by hand, unmeasured.
const FEW: usize = 48;

/// A value that no half holds: it becomes infinite or NaN, or vanishes.
#[allow(missing_docs, reason = "the variants' docs name their fields")]
#[derive(Clone, Debug, PartialEq)]
pub enum Unheld {
    /// A constant `value` that is infinite as a half, or 0 although it is not; `instruction` reads
    /// it, or none if it is an output.
    Constant { value: f32, instruction: Option<usize> },
    /// An end `value` of the domain of an `input` that is infinite as a half.
    Input { input: usize, value: f32 },
    /// An instruction's result, kept or read as a half: the largest `value`, found at `input`.
    Result { instruction: usize, value: f64, input: Vec<f32> },
    /// An output that is finite as `exact`, but not in halves, as `found`, at `input`.
    Output { output: usize, found: f64, exact: f64, input: Vec<f32> },
}

fn overflows(x: f64) -> bool {
    x.is_finite() && f16::from_f64(x).is_infinite()
}

fn is_lost(constant: f32) -> bool {
    overflows(constant.into()) || constant != 0.0 && rounded(constant) == 0.0
}

/// Returns a value that no half holds in a program in half precision except for the instructions
/// `stay_single`: a finite one that is infinite as a half, or a constant that is 0 only as a half.
/// None if none is found.
///
/// # Panics
/// If `domain` does not have one interval for each input.
pub fn unheld(program: &Program, domain: &[Interval], stay_single: &[usize]) -> Option<Unheld> {
    let single: Vec<bool> = (0..program.instrs.len()).map(|i| stay_single.contains(&i)).collect();
    let points = points(domain, POINTS).points;
    let used = used(program);
    let in_halves = || used.iter().copied().filter(|&i| !single[i]);
    let constant = |arg: &Arg| match *arg {
        Arg::Const(i) => Some(program.consts[usize::from(i)]).filter(|&value| is_lost(value)),
        Arg::Input(_) | Arg::Result(_) => None,
    };
    for i in in_halves() {
        if let Some(value) = program.instrs[i].args().iter().find_map(constant) {
            return Some(Unheld::Constant { value, instruction: Some(i) });
        }
    }
    if let Some(value) = program.outputs.iter().find_map(constant) {
        return Some(Unheld::Constant { value, instruction: None });
    }
    let args = used.iter().flat_map(|&i| program.instrs[i].args()).chain(&program.outputs);
    for &arg in args {
        let Arg::Input(input) = arg else { continue };
        let side = domain[usize::from(input)];
        let ends = [side.low(), side.high()].into_iter();
        if let Some(value) = ends.into_iter().find(|&end| overflows(end.into())) {
            return Some(Unheld::Input { input: input.into(), value });
        }
    }
    let worst = largest(program, &points);
    let read = in_halves().flat_map(|i| program.instrs[i].args()).chain(&program.outputs);
    let read: Vec<usize> = read.filter_map(|&arg| result(arg)).collect();
    let must_be_held = |&i: &usize| !single[i] || read.contains(&i);
    for instruction in used.iter().copied().filter(must_be_held) {
        if let Some((value, point)) = worst[instruction].filter(|(value, _)| overflows(*value)) {
            return Some(Unheld::Result { instruction, value, input: points[point].clone() });
        }
    }
    let mixed = Mixed::new(&Variant::fused_or_not(program), &single);
    points.iter().find_map(|point| no_number(&mixed, point, &exact(program, point)))
}

fn no_number(mixed: &Mixed, point: &[f32], exact: &[f64]) -> Option<Unheld> {
    mixed.outputs(point).find_map(|found| {
        let lost = |&o: &usize| exact[o].is_finite() && !found[o].is_finite();
        let output = (0..exact.len()).find(lost)?;
        let (found, exact) = (found[output], exact[output]);
        Some(Unheld::Output { output, found, exact, input: point.to_vec() })
    })
}

fn result(arg: Arg) -> Option<usize> {
    match arg {
        Arg::Result(i) => Some(i.into()),
        Arg::Input(_) | Arg::Const(_) => None,
    }
}

fn used(program: &Program) -> Vec<usize> {
    let mut counts = Vec::new();
    use_counts(program, &mut counts);
    (0..program.instrs.len()).filter(|&i| counts[i] > 0).collect()
}

/// Returns each instruction's largest finite result by magnitude and the index of its point.
fn largest(program: &Program, points: &[Vec<f32>]) -> Vec<Option<(f64, usize)>> {
    let traced = traced(program);
    let mut largest: Vec<Option<(f64, usize)>> = vec![None; program.instrs.len()];
    for (at, point) in points.iter().enumerate() {
        for (known, value) in largest.iter_mut().zip(exact(&traced, point)) {
            let more = known.is_none_or(|(known, _)| value.abs() > known.abs());
            if value.is_finite() && more {
                *known = Some((value, at));
            }
        }
    }
    largest
}

/// Marks the instructions that no bound allows in halves: those with a constant, an argument or a
/// result that no half holds.
fn lost_in_halves(program: &Program, points: &[Vec<f32>]) -> Vec<bool> {
    let largest = largest(program, points);
    let too_large = |i: usize| largest[i].is_some_and(|(value, _)| overflows(value));
    let lost = |(i, instr): (usize, &crate::program::Instr)| {
        let argument = |&arg: &Arg| match arg {
            Arg::Const(i) => is_lost(program.consts[usize::from(i)]),
            Arg::Result(i) => too_large(i.into()),
            Arg::Input(_) => false,
        };
        too_large(i) || instr.args().iter().any(argument)
    };
    program.instrs.iter().enumerate().map(lost).collect()
}

/// Returns the largest absolute error found over the domain, and the extent of the trial, of a
/// program in half precision except for the instructions `stay_single`. The error is infinite if an
/// output is finite in `f64` only.
///
/// # Panics
/// If `domain` does not have one interval for each input.
pub fn half_loss(program: &Program, domain: &[Interval], stay_single: &[usize]) -> (f64, Tried) {
    let trials = Trials::new(program, domain);
    let single: Vec<bool> = (0..program.instrs.len()).map(|i| stay_single.contains(&i)).collect();
    (trials.worst(&single, trials.everywhere()), trials.tried)
}

/// Returns the instructions that must stay in single precision for the absolute error to be at most
/// `bound` at all points tried: the smallest set found, by adding the instruction that helps most
/// until that is enough, then removing those not needed. None if not even all instructions are
/// enough. Instructions with values that no half holds stay single whatever the bound.
///
/// # Panics
/// If `domain` does not have one interval for each input.
pub fn must_stay_single(program: &Program, domain: &[Interval], bound: f64) -> Option<Vec<usize>> {
    let mut trials = Trials::new(program, domain);
    let used = used(program);
    let lost = lost_in_halves(program, &trials.points);
    let mut single = lost.clone();
    while !trials.are_within(&single, bound) {
        let mut best: Option<(f64, usize)> = None;
        for &i in used.iter().filter(|&&i| !lost[i]) {
            if single[i] {
                continue;
            }
            single[i] = true;
            let error = trials.worst(&single, trials.hard.iter().copied());
            single[i] = false;
            if best.is_none_or(|(known, _)| error < known) {
                best = Some((error, i));
            }
        }
        single[best?.1] = true;
    }
    for &i in used.iter().filter(|&&i| !lost[i]) {
        if single[i] {
            single[i] = false;
            single[i] = !trials.are_within(&single, bound);
        }
    }
    Some(used.into_iter().filter(|&i| single[i]).collect())
}

/// A program's values at the points at which sets of instructions are tried.
struct Trials {
    variants: Vec<Variant>,
    points: Vec<Vec<f32>>,
    exact: Vec<Vec<f64>>,
    tried: Tried,
    /// The indices of the points that decided so far, the latest first.
    hard: Vec<usize>,
}

impl Trials {
    fn new(program: &Program, domain: &[Interval]) -> Trials {
        let found: Points = points(domain, POINTS);
        let tried = found.tried();
        let exact = found.points.iter().map(|point| exact(program, point)).collect();
        let variants = Variant::fused_or_not(program);
        let mut trials = Trials { variants, points: found.points, exact, tried, hard: Vec::new() };
        let mixed = trials.mixed(&[]);
        let errors: Vec<f64> =
            trials.everywhere().map(|i| mixed.error(&trials.points[i], &trials.exact[i])).collect();
        let mut hard: Vec<usize> = trials.everywhere().collect();
        hard.sort_by(|&a, &b| errors[b].total_cmp(&errors[a]));
        hard.truncate(FEW);
        trials.hard = hard;
        trials
    }

    fn everywhere(&self) -> std::ops::Range<usize> {
        0..self.points.len()
    }

    fn mixed(&self, single: &[bool]) -> Mixed {
        Mixed::new(&self.variants, single)
    }

    fn worst(&self, single: &[bool], points: impl Iterator<Item = usize>) -> f64 {
        let mixed = self.mixed(single);
        points.map(|i| mixed.error(&self.points[i], &self.exact[i])).fold(0.0, f64::max)
    }

    /// Returns true if no point's error exceeds the bound; a point that does is hard from now on.
    fn are_within(&mut self, single: &[bool], bound: f64) -> bool {
        let mixed = self.mixed(single);
        let exceeds = |&i: &usize| mixed.error(&self.points[i], &self.exact[i]) > bound;
        if self.hard.iter().any(exceeds) {
            return false;
        }
        match self.everywhere().find(exceeds) {
            Some(point) => {
                self.hard.insert(0, point);
                self.hard.truncate(2 * FEW);
                false
            }
            None => true,
        }
    }
}
