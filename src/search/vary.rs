//! Variation: changes of a draft's instructions, arguments, constants and outputs.

use crate::grammar::Grammar;
use crate::op::{MAX_ARITY, Op};
use crate::program::{Arg, Draft, Instr, effective_into};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

/// The kinds of change, each with how often it is made relative to the others.
const MOVES: [(Move, u32); 9] = [
    (Move::Operation, 15),
    (Move::Argument, 20),
    (Move::Constant, 8),
    (Move::Insert, 25),
    (Move::Grow, 40),
    (Move::Delete, 12),
    (Move::Graft, 12),
    (Move::TakeOutput, 6),
    (Move::ConstantToValue, 6),
];

#[derive(Clone, Copy)]
enum Move {
    /// Another operation for an instruction.
    Operation,
    /// Another source for an argument or output.
    Argument,
    /// Another value for a constant.
    Constant,
    /// A new instruction between a source and its reader.
    Insert,
    /// A small multiple of a value, or of a product, added to a source: the child begins as good as
    /// its parent, and fitting can only better it.
    Grow,
    /// An instruction replaced by one of its arguments.
    Delete,
    /// A copy of a donor's instructions, read by one argument or output.
    Graft,
    /// An output as the donor has it.
    TakeOutput,
    /// An input or result where a constant was, or the other way round.
    ConstantToValue,
}

/// Makes children of drafts; owns the memory that it needs.
#[derive(Clone, Debug, Default)]
pub(super) struct Variation {
    piece: Draft,
    scratch: Vec<u32>,
}

impl Variation {
    /// Changes `child`, a copy of its parent, by one move or a few.
    pub fn vary(
        &mut self,
        rng: &mut ChaCha8Rng,
        child: &mut Draft,
        donor: &Draft,
        grammar: &Grammar,
    ) {
        loop {
            self.change(rng, child, donor, grammar);
            if rng.random_range(0..100) < 60 {
                return;
            }
        }
    }

    fn change(
        &mut self,
        rng: &mut ChaCha8Rng,
        child: &mut Draft,
        donor: &Draft,
        grammar: &Grammar,
    ) {
        let total: u32 = MOVES.iter().map(|(_, rate)| rate).sum();
        let mut pick = rng.random_range(0..total);
        let chosen = MOVES.iter().find(|(_, rate)| {
            let found = pick < *rate;
            pick = pick.saturating_sub(*rate);
            found
        });
        match chosen.map_or(Move::Insert, |(chosen, _)| *chosen) {
            Move::Operation => change_operation(rng, child, grammar),
            Move::Argument => change_argument(rng, child),
            Move::Constant => change_constant(rng, child),
            Move::Insert => insert(rng, child, grammar),
            Move::Grow => grow(rng, child),
            Move::Delete => delete(rng, child),
            Move::Graft => self.graft(rng, child, donor),
            Move::TakeOutput => self.take_output(rng, child, donor),
            Move::ConstantToValue => exchange_constant(rng, child),
        }
    }

    fn graft(&mut self, rng: &mut ChaCha8Rng, child: &mut Draft, donor: &Draft) {
        if donor.instrs.is_empty() {
            return;
        }
        let root = Arg::Result(rng.random_range(0..donor.instrs.len()) as u16);
        let root = self.copy_in(child, donor, root);
        let edge = pick_edge(rng, child, self.piece.instrs.len());
        *edge_mut(child, edge) = root;
    }

    fn take_output(&mut self, rng: &mut ChaCha8Rng, child: &mut Draft, donor: &Draft) {
        let output = rng.random_range(0..child.outputs.len());
        let value = self.copy_in(child, donor, donor.outputs[output]);
        child.outputs[output] = value;
    }

    /// Copies what `root` depends on in the donor to the front of `child`; gives the copy.
    fn copy_in(&mut self, child: &mut Draft, donor: &Draft, root: Arg) -> Arg {
        let whole = Draft { outputs: vec![root], ..donor.clone() };
        effective_into(&whole, &mut self.piece, &mut self.scratch);
        let (length, constants) = (self.piece.instrs.len() as u16, child.consts.len() as u16);
        shift_results(child, 0, length);
        let into_child = |arg: Arg| match arg {
            Arg::Const(i) => Arg::Const(i + constants),
            other => other,
        };
        for instr in &mut self.piece.instrs {
            instr.args_mut().iter_mut().for_each(|arg| *arg = into_child(*arg));
        }
        child.instrs.splice(0..0, self.piece.instrs.iter().copied());
        child.consts.extend_from_slice(&self.piece.consts);
        into_child(self.piece.outputs[0])
    }
}

/// A random draft of a few instructions for each output.
pub(super) fn random_draft(
    rng: &mut ChaCha8Rng,
    inputs: usize,
    outputs: usize,
    grammar: &Grammar,
    draft: &mut Draft,
) {
    draft.clear(inputs);
    for _ in 0..outputs {
        for _ in 0..rng.random_range(1..6) {
            push_random(rng, draft, grammar);
        }
        draft.outputs.push(Arg::Result((draft.instrs.len() - 1) as u16));
    }
}

/// An instruction on random earlier values, the latest among them more often than not.
fn push_random(rng: &mut ChaCha8Rng, draft: &mut Draft, grammar: &Grammar) {
    let op = random_operation(rng, grammar);
    let earlier = draft.instrs.len();
    let mut args: [Arg; MAX_ARITY] = std::array::from_fn(|_| random_arg(rng, draft, earlier));
    if earlier > 0 && rng.random_range(0..100) < 60 {
        args[rng.random_range(0..op.arity())] = Arg::Result((earlier - 1) as u16);
    }
    draft.push(op, &args);
}

fn random_operation(rng: &mut ChaCha8Rng, grammar: &Grammar) -> Op {
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

/// An input, an earlier result, or a new constant.
fn random_arg(rng: &mut ChaCha8Rng, draft: &mut Draft, earlier: usize) -> Arg {
    match rng.random_range(0..100) {
        0..45 => random_value(rng, draft, earlier),
        45..72 if earlier > 0 => Arg::Result(rng.random_range(0..earlier) as u16),
        72..100 => draft.constant(random_constant(rng)),
        _ => random_value(rng, draft, earlier),
    }
}

/// An input, or an earlier result where there is no input.
fn random_value(rng: &mut ChaCha8Rng, draft: &Draft, earlier: usize) -> Arg {
    let values = draft.inputs + earlier / 3;
    match rng.random_range(0..values.max(1)) {
        i if i < draft.inputs => Arg::Input(i as u16),
        _ => Arg::Result(rng.random_range(0..earlier) as u16),
    }
}

/// Of either sign, its magnitude between 1/8 and 8, uniform in the logarithm.
pub(super) fn random_constant(rng: &mut ChaCha8Rng) -> f32 {
    let magnitude = rng.random_range(-3.0f32..3.0).exp2();
    if rng.random_range(0..100) < 65 { magnitude } else { -magnitude }
}

/// Somewhere that a value is read: an argument, or an output.
#[derive(Clone, Copy)]
enum Edge {
    Argument(usize, usize),
    Output(usize),
}

/// A random edge of the instructions from `first` on, or of the outputs.
fn pick_edge(rng: &mut ChaCha8Rng, draft: &Draft, first: usize) -> Edge {
    let arguments: usize = draft.instrs[first..].iter().map(|instr| instr.args().len()).sum();
    let mut pick = rng.random_range(0..arguments + draft.outputs.len());
    for (i, instr) in draft.instrs.iter().enumerate().skip(first) {
        if pick < instr.args().len() {
            return Edge::Argument(i, pick);
        }
        pick -= instr.args().len();
    }
    Edge::Output(pick)
}

fn edge_mut(draft: &mut Draft, edge: Edge) -> &mut Arg {
    match edge {
        Edge::Argument(i, place) => &mut draft.instrs[i].args_mut()[place],
        Edge::Output(o) => &mut draft.outputs[o],
    }
}

/// The instructions before the reader.
fn earlier_than(draft: &Draft, edge: Edge) -> usize {
    match edge {
        Edge::Argument(i, _) => i,
        Edge::Output(_) => draft.instrs.len(),
    }
}

/// Renumbers results from `first` on, `by` instructions later.
fn shift_results(draft: &mut Draft, first: usize, by: u16) {
    let shift = |arg: &mut Arg| {
        if let Arg::Result(i) = arg
            && usize::from(*i) >= first
        {
            *i += by;
        }
    };
    for instr in &mut draft.instrs[first..] {
        instr.args_mut().iter_mut().for_each(shift);
    }
    draft.outputs.iter_mut().for_each(shift);
}

fn change_operation(rng: &mut ChaCha8Rng, draft: &mut Draft, grammar: &Grammar) {
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

fn change_argument(rng: &mut ChaCha8Rng, draft: &mut Draft) {
    let edge = pick_edge(rng, draft, 0);
    let earlier = earlier_than(draft, edge);
    let arg = random_arg(rng, draft, earlier);
    *edge_mut(draft, edge) = arg;
}

fn change_constant(rng: &mut ChaCha8Rng, draft: &mut Draft) {
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

fn exchange_constant(rng: &mut ChaCha8Rng, draft: &mut Draft) {
    let edge = pick_edge(rng, draft, 0);
    let earlier = earlier_than(draft, edge);
    let arg = match *edge_mut(draft, edge) {
        Arg::Const(_) => random_value(rng, draft, earlier),
        _ => draft.constant(random_constant(rng)),
    };
    *edge_mut(draft, edge) = arg;
}

/// Every draft that one more instruction makes of this one: any operation of the grammar, at any edge,
/// its other arguments inputs, earlier results, or new constants. Not all differ in structure.
pub(super) fn insertions(draft: &Draft, grammar: &Grammar, visit: &mut dyn FnMut(&Draft)) {
    let arguments = draft.instrs.iter().enumerate();
    let edges = arguments
        .flat_map(|(i, instr)| (0..instr.args().len()).map(move |place| Edge::Argument(i, place)))
        .chain((0..draft.outputs.len()).map(Edge::Output));
    for edge in edges {
        let at = earlier_than(draft, edge);
        let mut grown = draft.clone();
        let source = *edge_mut(&mut grown, edge);
        shift_results(&mut grown, at, 1);
        *edge_mut(&mut grown, edge) = Arg::Result(at as u16);
        let constants = grown.consts.len();
        // As many new constants as an instruction can read, each one apart.
        grown.consts.extend((0..MAX_ARITY).map(|i| 0.75 + (constants + i) as f32));
        for &(op, _) in &grammar.operations {
            for place in 0..op.arity() {
                let sources = |other: usize| -> Vec<Arg> {
                    if other == place {
                        return vec![source];
                    }
                    let inputs = (0..draft.inputs as u16).map(Arg::Input);
                    let results = (0..at as u16).map(Arg::Result);
                    inputs.chain(results).chain([Arg::Const((constants + other) as u16)]).collect()
                };
                let mut choices = vec![vec![]];
                for other in 0..op.arity() {
                    choices = choices
                        .iter()
                        .flat_map(|chosen: &Vec<Arg>| {
                            let more = |arg| chosen.iter().copied().chain([arg]).collect();
                            sources(other).into_iter().map(more)
                        })
                        .collect();
                }
                for args in choices {
                    grown.instrs.insert(at, Instr::new(op, &args));
                    visit(&grown);
                    grown.instrs.remove(at);
                }
            }
        }
    }
}

fn insert(rng: &mut ChaCha8Rng, draft: &mut Draft, grammar: &Grammar) {
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
    // Every reader of the source may read the new value instead.
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

fn grow(rng: &mut ChaCha8Rng, draft: &mut Draft) {
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

/// What [`Move::Grow`] begins with.
const SMALL: f32 = 1.0 / 256.0;

fn delete(rng: &mut ChaCha8Rng, draft: &mut Draft) {
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
