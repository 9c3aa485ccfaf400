//! Idle operations, which never act on a scene's inputs: a minimum whose second argument is always
//! the greater, a saturation of a value that stays between 0 and 1.

use crate::dataset::{Dataset, Split};
use crate::eval::{Evaluator, Samples, Tape};
use crate::num::{Interval, enclose};
use crate::op::Op;
use crate::program::{Arg, Program, effective};
use crate::stability::{Bound, Limits, Property, Rounding, Status, prove};
use serde::{Deserialize, Serialize};

/// The evidence that an operation never acts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Evidence {
    /// A proof for the whole domain of the inputs.
    #[serde(rename = "proved")]
    Proved,
    /// Every sample of both splits.
    #[serde(rename = "sampled")]
    Sampled,
}

/// An operation that never acts, with the program without it.
pub(super) struct Idle {
    pub op: Op,
    pub evidence: Evidence,
    pub program: Program,
}

/// The value that an operation always has if a difference stays within a range.
struct Case {
    /// The first argument, minus the second if there is one.
    difference: (Arg, Option<Arg>),
    within: [f32; 2],
    becomes: Value,
}

#[derive(Clone, Copy)]
enum Value {
    Arg(Arg),
    Constant(f32),
}

const NOT_NEGATIVE: [f32; 2] = [0.0, f32::MAX];
const NOT_POSITIVE: [f32; 2] = [f32::MIN, 0.0];
const POSITIVE: [f32; 2] = [f32::MIN_POSITIVE, f32::MAX];
const NEGATIVE: [f32; 2] = [f32::MIN, -f32::MIN_POSITIVE];

fn cases(op: Op, args: &[Arg]) -> Vec<Case> {
    use Value::{Arg as Is, Constant};
    let alone = |within, becomes| Case { difference: (args[0], None), within, becomes };
    let less = |within, becomes| Case { difference: (args[1], Some(args[0])), within, becomes };
    match op {
        Op::Abs => vec![alone(NOT_NEGATIVE, Is(args[0]))],
        Op::Saturate => vec![
            alone([0.0, 1.0], Is(args[0])),
            alone([1.0, f32::MAX], Constant(1.0)),
            alone(NOT_POSITIVE, Constant(0.0)),
        ],
        Op::Min => vec![less(NOT_NEGATIVE, Is(args[0])), less(NOT_POSITIVE, Is(args[1]))],
        Op::Max => vec![less(NOT_NEGATIVE, Is(args[1])), less(NOT_POSITIVE, Is(args[0]))],
        Op::Step => vec![less(NOT_NEGATIVE, Constant(1.0)), less(NEGATIVE, Constant(0.0))],
        Op::Select => vec![less(POSITIVE, Is(args[2])), less(NOT_POSITIVE, Is(args[3]))],
        _ => Vec::new(),
    }
}

/// Returns the amount by which an operation may act and still count as idle, since it only rounds
/// then; 0 for one that chooses between two values. Chosen by hand, unmeasured.
fn slack(op: Op) -> f32 {
    if matches!(op, Op::Step | Op::Select) { 0.0 } else { 1e-6 }
}

/// Returns the first operation that never acts on the dataset's samples, if any, and whether that
/// is proved for the domain of its inputs.
pub(super) fn first_idle(program: &Program, dataset: &Dataset) -> Option<Idle> {
    let domain: Vec<Interval> =
        dataset.inputs.iter().map(|input| enclose(input.domain[0], input.domain[1])).collect();
    for (i, instr) in program.instrs.iter().enumerate() {
        for case in cases(instr.op(), instr.args()) {
            let Some(difference) = case.difference_of(program) else { continue };
            let slack = slack(instr.op());
            let holds = |split: &Split| holds_on(&difference, split, case.within, slack);
            if !(holds(&dataset.search) && holds(&dataset.validation)) {
                continue;
            }
            // A guard against division by zero may act by less than the slack: a proof has none.
            let evidence = match holds_over(&difference, &domain, case.within) {
                true => Evidence::Proved,
                false => Evidence::Sampled,
            };
            let left = without(program, i, case.becomes)?;
            if evidence == Evidence::Sampled && loses_finiteness(program, &left, &domain) {
                continue;
            }
            return Some(Idle { op: instr.op(), evidence, program: left });
        }
    }
    None
}

impl Case {
    /// Returns a program of the difference alone.
    fn difference_of(&self, program: &Program) -> Option<Program> {
        let mut draft = program.clone().into_draft();
        let output = match self.difference {
            (first, None) => first,
            (first, Some(second)) => draft.push(Op::Sub, &[first, second]),
        };
        draft.outputs = vec![output];
        Some(effective(&Program::verify(draft).ok()?))
    }
}

/// Returns true if a program's output stays in a range, within `slack`, on all rows of a split.
fn holds_on(program: &Program, split: &Split, [low, high]: [f32; 2], slack: f32) -> bool {
    let samples = Samples::new(split, program.inputs);
    let values = Evaluator::default().outputs(&Tape::new(program), &samples);
    values[0].iter().all(|value| (low - slack..=high + slack).contains(value))
}

/// The most boxes of a proof. Chosen by hand, unmeasured.
const BOXES: usize = 4096;

/// Returns true if it is proved, for the interpreter's arithmetic, that a program's output stays in
/// a range over the whole domain.
fn holds_over(program: &Program, domain: &[Interval], [low, high]: [f32; 2]) -> bool {
    let bounds = [Bound::AtLeast(low.into()), Bound::AtMost(high.into())];
    let claims = bounds.map(|bound| Property::of(0, bound));
    let limits = Limits { slack: 0.0, boxes: BOXES, ..Limits::new(Rounding::Exact) };
    prove(program, domain, &claims, &limits).iter().all(|status| *status == Status::Proved)
}

/// Returns true if an output is refuted to be finite after a change but not before.
fn loses_finiteness(before: &Program, after: &Program, domain: &[Interval]) -> bool {
    let limits = Limits { boxes: BOXES, ..Limits::new(Rounding::Exact) };
    (0..before.outputs.len()).any(|output| {
        let claim = [Property::of(output, Bound::Finite)];
        let is_refuted = |program: &Program| {
            matches!(prove(program, domain, &claim, &limits)[0], Status::Refuted { .. })
        };
        is_refuted(after) && !is_refuted(before)
    })
}

/// Replaces an instruction's result by a value.
fn without(program: &Program, at: usize, value: Value) -> Option<Program> {
    let draft = program.rewritten(|new, i, instr| match value {
        // Arguments come earlier, so they keep their indices.
        Value::Arg(arg) if i == at => arg,
        Value::Constant(constant) if i == at => new.constant(constant),
        Value::Arg(_) | Value::Constant(_) => new.push_instr(instr),
    });
    Some(effective(&Program::verify(draft).ok()?))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dataset::axis;
    use crate::program::{Names, parse, print};

    fn line() -> Dataset {
        let line = Dataset::sampled([axis("x", 0.0..=1.0)], ["y"], |x| x).unwrap();
        Dataset { validation: line.search.clone(), ..line }
    }

    #[test]
    fn of_every_operation_of_pieces_it_is_known_when_it_does_not_act() {
        let args = [0, 1, 2, 3].map(Arg::Input);
        for &op in Op::ALL {
            // Roundings to whole numbers, signs and angles act nearly everywhere.
            let always_acts = matches!(op, Op::Floor | Op::Fract | Op::Sign | Op::Atan2);
            let may_be_idle = op.is_piecewise() && !always_acts;
            assert_eq!(may_be_idle, !cases(op, &args).is_empty(), "{op}");
        }
    }

    #[test]
    fn what_never_acts_is_found_and_said_how() {
        use Evidence::{Proved, Sampled};
        let names = Names::new(["x"], ["y"]);
        for (text, left) in [
            ("y = saturate(x)", Some((Proved, "y = x"))),
            ("y = min(x, 2 - x)", Some((Proved, "y = x"))),
            // One box is not enough for the proof: x(1 − x) is at most 1/4.
            ("y = saturate(x*(1 - x) + 0.5)", Some((Proved, "y = x*(1 - x) + 0.5"))),
            ("y = select(x < 3, x*x, 1)", Some((Proved, "y = x^2"))),
            ("y = step(-1, x)", Some((Proved, "y = 1"))),
            ("y = saturate(x + 1)", Some((Proved, "y = 1"))),
            // It acts beyond the samples, which do not reach the ends.
            ("y = max(x, 0.001)", Some((Sampled, "y = x"))),
            ("y = max(x, 0.3)", None),
            // A guard that hardly acts is still needed.
            ("y = 1/max(x, 0.0000001)", None),
            ("y = sqrt(max(x - 0.0000001, 0))", None),
            ("y = saturate(2*x)", None),
        ] {
            let found = first_idle(&parse(text, &names).unwrap(), &line());
            let found = found.map(|idle| (idle.evidence, print(&idle.program, &names)));
            assert_eq!(found, left.map(|(e, t)| (e, t.to_owned())), "{text}");
        }
    }
}
