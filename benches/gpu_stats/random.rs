//! Random formulas, in which each statement reads the one before it.

use crate::radv::INPUTS;
use lgp::grammar::Grammar;
use lgp::op::Op;
use lgp::program::{Arg, Draft, Names, Program, print};
use lgp::simplify::Simplifier;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// So many formulas of a grammar's operations, as likely as its weights have them; simplified, as
/// those of a search are.
pub fn formulas(grammar: &Grammar, count: usize, seed: u64) -> Vec<String> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let names = Names::new(INPUTS, ["y"]);
    (0..count).map(|_| print(&formula(&mut rng, grammar), &names)).collect()
}

fn formula(rng: &mut ChaCha8Rng, grammar: &Grammar) -> Program {
    let mut draft = Draft { inputs: INPUTS.len(), ..Draft::default() };
    let length = rng.random_range(3..=24u16);
    for i in 0..length {
        let op = operation(rng, grammar);
        let args = arguments(rng, &mut draft, i, op);
        draft.push(op, &args);
    }
    draft.outputs = vec![Arg::Result(length - 1)];
    let mut simple = Draft::default();
    Simplifier::default().simplify(&draft, &mut simple);
    match Program::verify(simple) {
        Ok(program) if program.instrs.len() > 1 && each_result_varies(&program, rng) => program,
        // A constant was folded to infinity, nothing is left, or too little is computed.
        _ => formula(rng, grammar),
    }
}

/// Samples on which results must vary.
const SAMPLES: usize = 200;

/// Whether no result is constant, as in `saturate(−2 − saturate(x))`: compilers know the ranges of
/// clamps and drop all that leads to one, and a search keeps no such formula.
fn each_result_varies(program: &Program, rng: &mut ChaCha8Rng) -> bool {
    let mut draft = program.clone().into_draft();
    draft.outputs = (0..draft.instrs.len()).map(|i| Arg::Result(i as u16)).collect();
    let every_result = Program::verify(draft).expect("the same instructions");
    let mut bounds = vec![(f32::INFINITY, f32::NEG_INFINITY); program.instrs.len()];
    for _ in 0..SAMPLES {
        let inputs = INPUTS.map(|_| rng.random_range(-4.0..4.0f32));
        for ((low, high), value) in bounds.iter_mut().zip(every_result.evaluate(&inputs)) {
            // NaN is neither.
            (*low, *high) = (low.min(value), high.max(value));
        }
    }
    bounds.iter().all(|(low, high)| low < high)
}

fn operation(rng: &mut ChaCha8Rng, grammar: &Grammar) -> Op {
    let total: f64 = grammar.operations.iter().map(|(_, weight)| weight).sum();
    let mut at = rng.random_range(0.0..total);
    let found = grammar.operations.iter().find(|(_, weight)| {
        at -= weight;
        at < 0.0
    });
    found.map_or(Op::Add, |(op, _)| *op)
}

/// The result before, and others that differ from it and from each other: `x − x` is no work.
fn arguments(rng: &mut ChaCha8Rng, draft: &mut Draft, i: u16, op: Op) -> Vec<Arg> {
    let place = rng.random_range(0..op.arity());
    let mut args: Vec<Arg> = Vec::new();
    while args.len() < op.arity() {
        // One argument at least is no constant.
        let constants = args.iter().filter(|arg| matches!(arg, Arg::Const(_))).count();
        let arg = match rng.random_range(0..10) {
            _ if args.len() == place && i > 0 => Arg::Result(i - 1),
            0..2 if constants + 1 < op.arity() => {
                let value: f32 = rng.random_range(-3.0..3.0);
                draft.constant((value * 1e4).round() / 1e4)
            }
            2..6 if i > 1 => Arg::Result(rng.random_range(0..i - 1)),
            _ => Arg::Input(rng.random_range(0..INPUTS.len() as u16)),
        };
        if !args.contains(&arg) {
            args.push(arg);
        }
    }
    args
}
