//! A formula as compilers may rewrite it.

use super::points;
use crate::dataset::Split;
use crate::eval::{Evaluator, Samples, Tape};
use crate::num::Interval;
use crate::op::Op;
use crate::program::{Arg, Draft, Instr, Invalid, Program};
use serde::Serialize;

/// A rewrite that a compiler may make.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Liberty {
    /// Each `mad` as a product and a sum, both rounded.
    Unfused,
    /// Each sum or difference with a product as a `mad`.
    Fused,
    /// A quotient as a product with the reciprocal, a root as the reciprocal of `rsqrt`.
    Reciprocal,
    /// `(a + b) + c` as `a + (b + c)`, and products alike.
    Reassociated,
}

const LIBERTIES: [Liberty; 4] =
    [Liberty::Unfused, Liberty::Fused, Liberty::Reciprocal, Liberty::Reassociated];

/// The largest difference found that a liberty makes to an output.
#[derive(Clone, Debug, PartialEq)]
pub struct Spread {
    /// The liberty.
    pub liberty: Liberty,
    /// The index of the output.
    pub output: usize,
    /// The input where it differs most.
    pub input: Vec<f32>,
    /// The values as written and as rewritten.
    pub values: [f32; 2],
}

impl Spread {
    /// Returns the absolute difference: 0 if both values are NaN, infinite if only one is.
    pub fn size(&self) -> f64 {
        let [a, b] = self.values.map(f64::from);
        match (a - b).abs() {
            _ if a == b || a.is_nan() && b.is_nan() => 0.0,
            size if size.is_nan() => f64::INFINITY,
            size => size,
        }
    }
}

/// The approximate number of points tried. Chosen by hand, unmeasured.
const POINTS: usize = 4096;

/// Returns the largest difference that each liberty makes at points spread over the domain.
///
/// # Panics
/// If `domain` does not have one interval for each input.
pub fn spreads(program: &Program, domain: &[Interval]) -> Vec<Spread> {
    let points = points::all(&points::axes(domain, POINTS, 24));
    let columns = (0..domain.len()).map(|i| points.iter().map(|point| point[i]).collect());
    let split = Split { columns: columns.collect(), ..Split::default() };
    if domain.is_empty() {
        return Vec::new();
    }
    let samples = Samples::new(&split, domain.len());
    let mut evaluator = Evaluator::default();
    let mut values = |program: &Program| evaluator.outputs(&Tape::new(program), &samples);
    let written = values(program);
    let spread = |liberty: Liberty| {
        let other = values(&Variant::of(program, liberty).program);
        let mut worst: Option<Spread> = None;
        for (output, (a, b)) in written.iter().zip(&other).enumerate() {
            for (row, (&a, &b)) in a.iter().zip(b).enumerate() {
                let input = Vec::new();
                let mut spread = Spread { liberty, output, input, values: [a, b] };
                if worst.as_ref().is_none_or(|known| spread.size() > known.size()) {
                    spread.input.clone_from(&points[row]);
                    worst = Some(spread);
                }
            }
        }
        worst
    };
    LIBERTIES.into_iter().filter_map(spread).collect()
}

/// A program as a compiler may rewrite it.
pub(super) struct Variant {
    pub program: Program,
    /// For each of its instructions, the index of its origin in the program as written.
    pub origin: Vec<usize>,
}

impl Variant {
    /// Returns the program as written.
    pub fn plain(program: &Program) -> Variant {
        Variant { program: program.clone(), origin: (0..program.instrs.len()).collect() }
    }

    /// Returns the program as written and, if it has a `mad`, with each as a product and a sum.
    pub fn fused_or_not(program: &Program) -> Vec<Variant> {
        let mut variants = vec![Variant::plain(program)];
        if program.instrs.iter().any(|instr| instr.op() == Op::Mad) {
            variants.push(Variant::of(program, Liberty::Unfused));
        }
        variants
    }

    fn of(program: &Program, liberty: Liberty) -> Variant {
        let (draft, origin) = rewritten(program, liberty);
        match Program::verify(draft) {
            Ok(program) => Variant { program, origin },
            Err(invalid) => {
                debug_assert!(matches!(invalid, Invalid::TooMany { .. }), "{invalid}");
                Variant::plain(program)
            }
        }
    }
}

fn rewritten(program: &Program, liberty: Liberty) -> (Draft, Vec<usize>) {
    let mut origin = Vec::with_capacity(program.instrs.len());
    let draft = program.rewritten(|draft, i, instr| {
        let result = match liberty {
            Liberty::Unfused => draft.push_unfused(instr),
            Liberty::Fused => fused(draft, instr),
            Liberty::Reciprocal => by_reciprocal(draft, instr),
            Liberty::Reassociated => reassociated(draft, instr),
        };
        origin.resize(draft.instrs.len(), i);
        result
    });
    (draft, origin)
}

/// Returns the first two arguments of `arg`'s instruction, if that is an `op`.
fn inner(draft: &Draft, arg: Arg, op: Op) -> Option<[Arg; 2]> {
    let Arg::Result(i) = arg else { return None };
    let instr = draft.instrs[usize::from(i)];
    (instr.op() == op).then(|| [instr.args()[0], instr.args()[1]])
}

/// Writes a sum or difference with a product as a `mad`.
fn fused(draft: &mut Draft, instr: Instr) -> Arg {
    let (op, args) = (instr.op(), instr.args());
    if !matches!(op, Op::Add | Op::Sub) {
        return draft.push_instr(instr);
    }
    let negated = |draft: &mut Draft, arg: Arg| match op == Op::Sub {
        true => draft.push(Op::Neg, &[arg]),
        false => arg,
    };
    if let Some([a, b]) = inner(draft, args[0], Op::Mul) {
        let rest = negated(draft, args[1]);
        return draft.push(Op::Mad, &[a, b, rest]);
    }
    if let Some([a, b]) = inner(draft, args[1], Op::Mul) {
        let a = negated(draft, a);
        return draft.push(Op::Mad, &[a, b, args[0]]);
    }
    draft.push_instr(instr)
}

fn by_reciprocal(draft: &mut Draft, instr: Instr) -> Arg {
    let (op, args) = (instr.op(), instr.args());
    if op == Op::Div {
        let reciprocal = draft.push(Op::Rcp, &args[1..]);
        return draft.push(Op::Mul, &[args[0], reciprocal]);
    }
    if op == Op::Sqrt {
        let one = draft.constant(1.0);
        let reciprocal = draft.push(Op::Rsqrt, args);
        return draft.push(Op::Div, &[one, reciprocal]);
    }
    draft.push_instr(instr)
}

fn reassociated(draft: &mut Draft, instr: Instr) -> Arg {
    let (op, args) = (instr.op(), instr.args());
    let takes_part = matches!(op, Op::Add | Op::Mul);
    let product = takes_part.then(|| inner(draft, args[0], op)).flatten();
    let Some([a, b]) = product else { return draft.push_instr(instr) };
    let rest = draft.push(op, &[b, args[1]]);
    draft.push(op, &[a, rest])
}
