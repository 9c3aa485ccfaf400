//! The same formula as other compilers write it.

use super::points;
use crate::dataset::Split;
use crate::eval::{Evaluator, Samples, Tape};
use crate::num::Interval;
use crate::op::Op;
use crate::program::{Arg, Draft, Program};
use serde::Serialize;

/// What a compiler may do.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Liberty {
    /// Each `mad` as a product and a sum, both rounded.
    Unfused,
    /// Each product that is added to something as a `mad`.
    Fused,
    /// A quotient as a product with the reciprocal, a root as the reciprocal of `rsqrt`.
    Reciprocal,
    /// `(a + b) + c` as `a + (b + c)`, and products alike.
    Reassociated,
}

const LIBERTIES: [Liberty; 4] =
    [Liberty::Unfused, Liberty::Fused, Liberty::Reciprocal, Liberty::Reassociated];

/// The largest difference that a liberty makes.
#[derive(Clone, Debug, PartialEq)]
pub struct Spread {
    pub liberty: Liberty,
    pub output: usize,
    pub input: Vec<f32>,
    /// As written, and as rewritten.
    pub values: [f32; 2],
}

impl Spread {
    /// Infinite where one of the values is no number.
    pub fn size(&self) -> f64 {
        let [a, b] = self.values.map(f64::from);
        match (a - b).abs() {
            _ if a == b || a.is_nan() && b.is_nan() => 0.0,
            size if size.is_nan() => f64::INFINITY,
            size => size,
        }
    }
}

const POINTS: usize = 4096;

/// What each liberty can change at most, as far as points spread over the domain show it.
///
/// # Panics
/// If `domain` has not one interval for each input.
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

/// A program as a compiler may write it.
pub(super) struct Variant {
    pub program: Program,
    /// For each of its instructions, the one of the program as written that it is of.
    pub origin: Vec<usize>,
}

impl Variant {
    /// As written.
    pub fn plain(program: &Program) -> Variant {
        Variant { program: program.clone(), origin: (0..program.instrs.len()).collect() }
    }

    /// As written, and each `mad` as a product and a sum, where there is one.
    pub fn fused_or_not(program: &Program) -> Vec<Variant> {
        let mut variants = vec![Variant::plain(program)];
        if program.instrs.iter().any(|instr| instr.op() == Op::Mad) {
            variants.push(Variant::of(program, Liberty::Unfused));
        }
        variants
    }

    fn of(program: &Program, liberty: Liberty) -> Variant {
        let (draft, origin) = rewritten(program, liberty);
        // Only more instructions than a program can hold are refused.
        match Program::verify(draft) {
            Ok(program) => Variant { program, origin },
            Err(_) => Variant::plain(program),
        }
    }
}

fn rewritten(program: &Program, liberty: Liberty) -> (Draft, Vec<usize>) {
    let mut origin = Vec::with_capacity(program.instrs.len());
    let mut draft =
        Draft { inputs: program.inputs, consts: program.consts.clone(), ..Draft::default() };
    let one = draft.constant(1.0);
    let mut moved: Vec<Arg> = Vec::with_capacity(program.instrs.len());
    let now = |arg: Arg, moved: &[Arg]| match arg {
        Arg::Result(i) => moved[usize::from(i)],
        other => other,
    };
    for (i, instr) in program.instrs.iter().enumerate() {
        let args: Vec<Arg> = instr.args().iter().map(|&arg| now(arg, &moved)).collect();
        let inner = |arg: Arg, op: Op, draft: &Draft| match arg {
            Arg::Result(i) if draft.instrs[usize::from(i)].op() == op => {
                let args = draft.instrs[usize::from(i)].args();
                Some((args[0], args[1]))
            }
            _ => None,
        };
        moved.push(match (liberty, instr.op()) {
            (Liberty::Unfused, Op::Mad) => {
                let product = draft.push(Op::Mul, &args[..2]);
                draft.push(Op::Add, &[product, args[2]])
            }
            (Liberty::Fused, Op::Add) => {
                let left = inner(args[0], Op::Mul, &draft).map(|product| (product, args[1]));
                let right = || inner(args[1], Op::Mul, &draft).map(|product| (product, args[0]));
                match left.or_else(right) {
                    Some(((a, b), rest)) => draft.push(Op::Mad, &[a, b, rest]),
                    None => draft.push(Op::Add, &args),
                }
            }
            (Liberty::Fused, Op::Sub) => match inner(args[0], Op::Mul, &draft) {
                Some((a, b)) => {
                    let rest = draft.push(Op::Neg, &args[1..2]);
                    draft.push(Op::Mad, &[a, b, rest])
                }
                None => match inner(args[1], Op::Mul, &draft) {
                    Some((a, b)) => {
                        let minus = draft.push(Op::Neg, &[a]);
                        draft.push(Op::Mad, &[minus, b, args[0]])
                    }
                    None => draft.push(Op::Sub, &args),
                },
            },
            (Liberty::Reciprocal, Op::Div) => {
                let reciprocal = draft.push(Op::Rcp, &args[1..2]);
                draft.push(Op::Mul, &[args[0], reciprocal])
            }
            (Liberty::Reciprocal, Op::Sqrt) => {
                let reciprocal = draft.push(Op::Rsqrt, &args);
                draft.push(Op::Div, &[one, reciprocal])
            }
            (Liberty::Reassociated, op @ (Op::Add | Op::Mul)) => match inner(args[0], op, &draft) {
                Some((a, b)) => {
                    let rest = draft.push(op, &[b, args[1]]);
                    draft.push(op, &[a, rest])
                }
                None => draft.push(op, &args),
            },
            (_, op) => draft.push(op, &args),
        });
        origin.resize(draft.instrs.len(), i);
    }
    draft.outputs = program.outputs.iter().map(|&arg| now(arg, &moved)).collect();
    (draft, origin)
}
