//! Random drafts, operations, arguments and constants.

use super::repair::repair;
use crate::grammar::Grammar;
use crate::op::{MAX_ARITY, Op};
use crate::program::{Arg, Draft, Reads, Shape};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

/// Makes `draft` a random one of a shape, with one to five instructions for each output that is no
/// constant.
pub(in crate::search) fn random_draft(
    rng: &mut ChaCha8Rng,
    shape: &Shape,
    grammar: &Grammar,
    draft: &mut Draft,
) {
    draft.clear(shape.inputs);
    for reads in shape.reads() {
        if let Reads::Constant(start) = reads {
            let value = match *start {
                Some(start) => near(rng, start),
                None => random_constant(rng),
            };
            let value = draft.constant(value);
            draft.outputs.push(value);
            continue;
        }
        for _ in 0..rng.random_range(1..6) {
            push_random(rng, draft, grammar);
        }
        draft.outputs.push(Arg::Result((draft.instrs.len() - 1) as u16));
    }
    repair(rng, draft, shape);
}

/// The farthest that a constant whose start is known begins from it: an entry of a matrix. By hand:
/// equal rows, which fits would keep equal, are left at once.
const AWAY: f32 = 0.125;

fn near(rng: &mut ChaCha8Rng, start: f32) -> f32 {
    start + rng.random_range(-AWAY..AWAY)
}

/// Adds an instruction on random values, more often than not with the latest result among them.
fn push_random(rng: &mut ChaCha8Rng, draft: &mut Draft, grammar: &Grammar) {
    let op = random_operation(rng, grammar);
    let earlier = draft.instrs.len();
    let mut args: [Arg; MAX_ARITY] = std::array::from_fn(|_| random_arg(rng, draft, earlier));
    if earlier > 0 && rng.random_range(0..100) < 60 {
        args[rng.random_range(0..op.arity())] = Arg::Result((earlier - 1) as u16);
    }
    draft.push(op, &args);
}

/// Returns an operation of the grammar, by its rates.
pub(super) fn random_operation(rng: &mut ChaCha8Rng, grammar: &Grammar) -> Op {
    let total: f64 = grammar.operations.iter().map(|(_, rate)| rate).sum();
    let mut pick = rng.random::<f64>() * total;
    for &(op, rate) in &grammar.operations {
        pick -= rate;
        if pick <= 0.0 {
            return op;
        }
    }
    grammar.operations[0].0
}

/// Returns an input, one of the `earlier` results, or a new constant.
pub(super) fn random_arg(rng: &mut ChaCha8Rng, draft: &mut Draft, earlier: usize) -> Arg {
    match rng.random_range(0..100) {
        0..45 => random_value(rng, draft, earlier),
        45..72 if earlier > 0 => Arg::Result(rng.random_range(0..earlier) as u16),
        72..100 => draft.constant(random_constant(rng)),
        _ => random_value(rng, draft, earlier),
    }
}

/// Returns an input, or now and then one of the `earlier` results.
pub(super) fn random_value(rng: &mut ChaCha8Rng, draft: &Draft, earlier: usize) -> Arg {
    let values = draft.inputs + earlier / 3;
    match rng.random_range(0..values.max(1)) {
        i if i < draft.inputs => Arg::Input(i as u16),
        _ => Arg::Result(rng.random_range(0..earlier) as u16),
    }
}

/// Returns a constant of either sign, its magnitude from 1/8 to 8 and uniform in the logarithm.
pub(in crate::search) fn random_constant(rng: &mut ChaCha8Rng) -> f32 {
    let magnitude = rng.random_range(-3.0f32..3.0).exp2();
    if rng.random_range(0..100) < 65 { magnitude } else { -magnitude }
}
