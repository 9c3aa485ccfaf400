//! The search for the largest error, by branch and bound.

use super::bound::{ErrorBound, ErrorLimits};
use super::distance::{Distance, Estimate, Sampled};
use crate::num::Interval;
use crate::program::{Arg, Draft, Program, effective};
use crate::stability::{Stopped, points};
use std::cmp::Ordering;
use std::collections::{BinaryHeap, HashSet};

/// A box, and the largest error that may occur in it.
struct Part {
    domain: Vec<Interval>,
    /// The share of the whole domain's volume.
    volume: f64,
    estimate: Estimate,
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
        let most = self.estimate.most.total_cmp(&other.estimate.most);
        most.then(self.volume.total_cmp(&other.volume))
    }
}

/// Bounds `|formula − truth|` of one output wherever each input is any `f32` of its interval: the
/// formula as rounding evaluates it, the truth in real numbers, its constants replaced by
/// `truth_constants`.
///
/// # Panics
/// If the programs have not the same number of inputs, `domain` has not one interval with finite
/// bounds for each, `truth_constants` has not one number for each constant of the truth, or either
/// program has no such output.
pub fn largest_error(
    formula: &Program,
    (truth, truth_constants): (&Program, &[f64]),
    output: usize,
    domain: &[Interval],
    limits: &ErrorLimits,
) -> ErrorBound {
    largest_error_until(formula, (truth, truth_constants), output, domain, limits, &|| false)
}

/// Bounds the error as [`largest_error`] does, less closely once `stopped` returns true.
///
/// # Panics
/// As [`largest_error`] does.
pub fn largest_error_until(
    formula: &Program,
    (truth, truth_constants): (&Program, &[f64]),
    output: usize,
    domain: &[Interval],
    limits: &ErrorLimits,
    stopped: Stopped,
) -> ErrorBound {
    assert_eq!(formula.inputs, truth.inputs, "programs of the same inputs");
    assert_eq!(domain.len(), formula.inputs, "one interval for each input");
    assert_eq!(truth_constants.len(), truth.consts.len(), "one number for each constant");
    let formula = only(formula, output);
    let (truth, kept) = with_constants(truth, output);
    let truth_constants: Vec<f64> = kept.iter().map(|&i| truth_constants[i]).collect();
    let domain = read_sides([&formula, &truth], domain);
    let distance = Distance::new(&formula, (&truth, &truth_constants), 0, limits.rounding);
    Search::new(distance, domain, limits).run(stopped)
}

/// Returns the program of one of the outputs.
fn only(program: &Program, output: usize) -> Program {
    let mut draft = program.clone().into_draft();
    draft.outputs = vec![draft.outputs[output]];
    effective(&Program::verify(draft).expect("an output of a program is a program"))
}

/// Returns the program of one of the outputs, and which constants of the original its own are.
fn with_constants(program: &Program, output: usize) -> (Program, Vec<usize>) {
    // Numbered constants show where each goes.
    let numbered = Draft {
        consts: (0..program.consts.len()).map(|i| i as f32).collect(),
        ..program.clone().into_draft()
    };
    let program = only(&Program::verify(numbered).expect("numbers are finite"), output);
    let kept = program.consts.iter().map(|&number| number as usize).collect();
    (program, kept)
}

/// Returns the domain, with a point for the side of each input that neither program reads.
fn read_sides(programs: [&Program; 2], domain: &[Interval]) -> Vec<Interval> {
    let args = |program: &Program| -> Vec<Arg> {
        let instrs = program.instrs.iter().flat_map(|instr| instr.args());
        instrs.chain(&program.outputs).copied().collect()
    };
    let read: HashSet<Arg> = programs.into_iter().flat_map(args).collect();
    let side = |(i, side): (usize, &Interval)| match read.contains(&Arg::Input(i as u16)) {
        true => *side,
        false => Interval::new(side.low(), side.low()),
    };
    domain.iter().enumerate().map(side).collect()
}

/// The neighbours tried on either side of the largest error, to meet its worst rounding. Chosen by
/// hand, unmeasured.
const NEIGHBOURS: usize = 1000;

/// A search under way.
struct Search<'a> {
    distance: Distance<'a>,
    whole: Vec<Interval>,
    limits: &'a ErrorLimits,
    parts: BinaryHeap<Part>,
    /// Single inputs, which no split divides: the largest bound among them, its volume being zero.
    last: Option<Part>,
    best: Option<(Sampled, Vec<f32>)>,
    reach: f64,
    gap: Option<Vec<f32>>,
    gaps: usize,
    boxes: usize,
}

impl<'a> Search<'a> {
    fn new(distance: Distance<'a>, whole: Vec<Interval>, limits: &'a ErrorLimits) -> Search<'a> {
        Search {
            distance,
            whole,
            limits,
            parts: BinaryHeap::new(),
            last: None,
            best: None,
            reach: 0.0,
            gap: None,
            gaps: 0,
            boxes: 0,
        }
    }

    fn run(mut self, stopped: Stopped) -> ErrorBound {
        let axes = points::axes(&self.whole, 2048, 14);
        let mut inputs = points::all(&axes);
        inputs.push(self.whole.iter().map(|&side| middle(side)).collect());
        for input in &inputs {
            let sampled = self.distance.at(input);
            self.meet(sampled, input);
        }
        self.add(self.whole.clone(), 1.0);
        while let Some(part) = self.parts.pop() {
            let most = part.estimate.most;
            let enough = most <= self.goal();
            if enough
                || self.seen() == f64::INFINITY
                || self.boxes >= self.limits.boxes
                || stopped()
            {
                self.parts.push(part);
                break;
            }
            let input: Vec<f32> = part.domain.iter().map(|&side| middle(side)).collect();
            let sampled = self.distance.reach_at(&input);
            self.meet(sampled, &input);
            match self.split(&part) {
                Some(halves) => {
                    halves.into_iter().for_each(|half| self.add(half, part.volume / 2.0));
                }
                None if part.estimate.of_no_value => {
                    self.gap = Some(input);
                    self.gaps += 1;
                }
                None if self.last.as_ref().is_none_or(|last| *last < part) => {
                    self.last = Some(Part { volume: 0.0, ..part });
                }
                None => {}
            }
        }
        self.look_beside();
        self.finished()
    }

    fn seen(&self) -> f64 {
        self.best.as_ref().map_or(0.0, |(best, _)| best.error)
    }

    fn goal(&self) -> f64 {
        self.limits.ratio * self.seen().max(self.reach)
    }

    fn meet(&mut self, sampled: Option<Sampled>, input: &[f32]) {
        let Some(sampled) = sampled else { return };
        self.reach = self.reach.max(sampled.reach);
        if self.best.as_ref().is_none_or(|(best, _)| sampled.error > best.error) {
            self.best = Some((sampled, input.to_vec()));
        }
    }

    fn add(&mut self, domain: Vec<Interval>, volume: f64) {
        self.boxes += 1;
        let estimate = self.distance.over(&domain);
        self.parts.push(Part { domain, volume, estimate });
    }

    /// Halves a part across the side that adds most to its bound; returns none for a point.
    fn split(&self, part: &Part) -> Option<[Vec<Interval>; 2]> {
        let width = |side: Interval| f64::from(side.high()) - f64::from(side.low());
        let by_side = &part.estimate.by_side;
        let unbounded = by_side.iter().any(|by| by.is_infinite());
        let total: f64 = by_side.iter().sum();
        let importance = |i: usize| {
            let relative = width(part.domain[i]) / width(self.whole[i]).max(f64::MIN_POSITIVE);
            let share = match unbounded {
                true => f64::from(u8::from(by_side[i].is_infinite())) * relative,
                false if total > 0.0 => by_side[i] / total,
                false => 0.0,
            };
            share + 0.05 * relative
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
            domain
        }))
    }

    /// Looks at the inputs next to the worst one: there the error is about as large, and rounding
    /// differs.
    fn look_beside(&mut self) {
        let Some((_, center)) = self.best.clone() else { return };
        for i in 0..center.len() {
            let side = self.whole[i];
            for step in [f32::next_up, f32::next_down] {
                let mut input = center.clone();
                for _ in 0..NEIGHBOURS {
                    input[i] = step(input[i]);
                    if !side.contains(input[i].into()) {
                        break;
                    }
                    let sampled = self.distance.at(&input);
                    self.meet(sampled, &input);
                }
            }
        }
    }

    fn finished(self) -> ErrorBound {
        let goal = self.goal();
        let largest = self.parts.iter().chain(&self.last).max();
        let (proved, worst) = match largest {
            Some(part) => {
                (part.estimate.most, part.domain.iter().map(|&side| middle(side)).collect())
            }
            None => (f64::INFINITY, Vec::new()),
        };
        let open = self.parts.iter().filter(|part| part.estimate.most > goal);
        let volume = open.map(|part| part.volume).fold(0.0, |sum, volume| sum + volume);
        let (best, at) = match self.best {
            Some((best, at)) => (best, at),
            None => (Sampled { value: f32::NAN, error: 0.0, reach: 0.0 }, Vec::new()),
        };
        ErrorBound {
            proved: proved.max(best.error),
            seen: best.error,
            at,
            value: best.value,
            reach: self.reach,
            volume,
            worst,
            gap: self.gap,
            gaps: self.gaps,
            boxes: self.boxes,
        }
    }
}

fn middle(side: Interval) -> f32 {
    (side.low() / 2.0 + side.high() / 2.0).clamp(side.low(), side.high())
}
