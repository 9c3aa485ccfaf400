//! Single changes of a draft.

use super::draw::{random_arg, random_constant, random_operation, random_value};
use super::edge::{Edge, earlier_than, edge_mut, pick_edge, shift_results};
use crate::grammar::Grammar;
use crate::op::{MAX_ARITY, Op};
use crate::program::{Arg, Draft, Instr};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

pub(super) fn change_operation(rng: &mut ChaCha8Rng, draft: &mut Draft, grammar: &Grammar) {
    if draft.instrs.is_empty() {
        return;
    }
    let i = rng.random_range(0..draft.instrs.len());
    let op = random_operation(rng, grammar);
    let old = draft.instrs[i];
    let args: [Arg; MAX_ARITY] = std::array::from_fn(|place| match old.args().get(place) {
        Some(&arg) => arg,
        None => random_arg(rng, draft, i),
    });
    draft.instrs[i] = Instr::new(op, &args);
    let swap = op.arity() > 1 && !op.commutes() && rng.random_range(0..2) == 0;
    if swap {
        draft.instrs[i].args_mut().swap(0, 1);
    }
}

pub(super) fn change_argument(rng: &mut ChaCha8Rng, draft: &mut Draft) {
    let edge = pick_edge(rng, draft, 0);
    let earlier = earlier_than(draft, edge);
    let arg = random_arg(rng, draft, earlier);
    *edge_mut(draft, edge) = arg;
}

pub(super) fn change_constant(rng: &mut ChaCha8Rng, draft: &mut Draft) {
    if draft.consts.is_empty() {
        return;
    }
    let i = rng.random_range(0..draft.consts.len());
    draft.consts[i] = match rng.random_range(0..3) {
        0 => random_constant(rng),
        1 => -draft.consts[i],
        _ => draft.consts[i] * rng.random_range(-1.5f32..1.5).exp2(),
    };
}

pub(super) fn exchange_constant(rng: &mut ChaCha8Rng, draft: &mut Draft) {
    let edge = pick_edge(rng, draft, 0);
    let earlier = earlier_than(draft, edge);
    let arg = match *edge_mut(draft, edge) {
        Arg::Const(_) => random_value(rng, draft, earlier),
        _ => draft.constant(random_constant(rng)),
    };
    *edge_mut(draft, edge) = arg;
}

pub(super) fn insert(rng: &mut ChaCha8Rng, draft: &mut Draft, grammar: &Grammar) {
    let edge = pick_edge(rng, draft, 0);
    let at = earlier_than(draft, edge);
    let source = *edge_mut(draft, edge);
    let op = random_operation(rng, grammar);
    let mut args: [Arg; MAX_ARITY] = std::array::from_fn(|_| random_arg(rng, draft, at));
    args[rng.random_range(0..op.arity())] = source;
    shift_results(draft, at, 1);
    draft.instrs.insert(at, Instr::new(op, &args));
    let edge = match edge {
        Edge::Argument(i, place) => Edge::Argument(i + 1, place),
        output => output,
    };
    *edge_mut(draft, edge) = Arg::Result(at as u16);
    // Sometimes every later instruction reads the new value in place of the source.
    if let Arg::Result(_) | Arg::Input(_) = source
        && rng.random_range(0..4) == 0
    {
        for instr in &mut draft.instrs[at + 1..] {
            for arg in instr.args_mut().iter_mut().filter(|arg| **arg == source) {
                *arg = Arg::Result(at as u16);
            }
        }
    }
}

pub(super) fn grow(rng: &mut ChaCha8Rng, draft: &mut Draft) {
    let edge = pick_edge(rng, draft, 0);
    let at = earlier_than(draft, edge);
    let source = *edge_mut(draft, edge);
    let small = draft.constant(if rng.random_range(0..2) == 0 { SMALL } else { -SMALL });
    let mut term = random_value(rng, draft, at);
    let mut grown = Vec::with_capacity(3);
    if rng.random_range(0..2) == 0 {
        let factor = match rng.random_range(0..3) {
            0 if !matches!(source, Arg::Const(_)) => source,
            _ => random_value(rng, draft, at),
        };
        grown.push(Instr::new(Op::Mul, &[term, factor]));
        term = Arg::Result(at as u16);
    }
    grown.push(Instr::new(Op::Mul, &[term, small]));
    grown.push(Instr::new(Op::Add, &[source, Arg::Result((at + grown.len() - 1) as u16)]));
    let count = grown.len();
    shift_results(draft, at, count as u16);
    draft.instrs.splice(at..at, grown);
    let edge = match edge {
        Edge::Argument(i, place) => Edge::Argument(i + count, place),
        output => output,
    };
    *edge_mut(draft, edge) = Arg::Result((at + count - 1) as u16);
}

/// The magnitude of a grown term's factor, which hardly changes the values until it is fitted. By
/// hand.
const SMALL: f32 = 1.0 / 256.0;

pub(super) fn delete(rng: &mut ChaCha8Rng, draft: &mut Draft) {
    if draft.instrs.is_empty() {
        return;
    }
    let i = rng.random_range(0..draft.instrs.len());
    let args = draft.instrs[i].args();
    let instead = args[rng.random_range(0..args.len())];
    let redirect = |arg: &mut Arg| {
        if *arg == Arg::Result(i as u16) {
            *arg = instead;
        }
    };
    for instr in &mut draft.instrs[i + 1..] {
        instr.args_mut().iter_mut().for_each(redirect);
    }
    draft.outputs.iter_mut().for_each(redirect);
}
