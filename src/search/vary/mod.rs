//! Variation: changes of a draft's instructions, arguments, constants and outputs.

mod change;
mod draw;
mod edge;
mod insertions;
mod rates;
mod repair;

pub(super) use draw::{random_constant, random_draft};
pub(super) use insertions::{insertion_count, insertions};
pub(super) use rates::Rates;

use crate::grammar::Grammar;
use crate::program::{Arg, Draft, Shape, effective_into};
use change::{
    change_argument, change_constant, change_operation, delete, exchange_constant, grow, insert,
};
use edge::{edge_mut, pick_edge, shift_results};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use repair::repair;

/// The kinds of change, each with its relative rate as long as nothing is known of its success.
/// Chosen by hand, unmeasured.
const MOVES: [(Move, f64); 9] = [
    (Move::Operation, 15.0),
    (Move::Argument, 20.0),
    (Move::Constant, 8.0),
    (Move::Insert, 25.0),
    (Move::Grow, 40.0),
    (Move::Delete, 12.0),
    (Move::Graft, 12.0),
    (Move::TakeOutput, 6.0),
    (Move::ExchangeConstant, 6.0),
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
    /// A small multiple of a value or product, added to a source: the child starts about as good as
    /// its parent, and fitting improves on that.
    Grow,
    /// An instruction replaced by one of its arguments.
    Delete,
    /// A copy of a donor's instructions, read by one argument or output.
    Graft,
    /// A copy of the donor's instructions for an output, in place of the child's.
    TakeOutput,
    /// An input or result in place of a constant, or vice versa.
    ExchangeConstant,
}

/// The variation of drafts, with the memory that it needs.
#[derive(Clone, Debug, Default)]
pub(super) struct Variation {
    piece: Draft,
    scratch: Vec<u32>,
    weights: [f64; MOVES.len()],
}

impl Variation {
    /// Sets the rates of the changes from now on.
    pub fn follow(&mut self, rates: &Rates) {
        self.weights = rates.weights();
    }

    /// Changes `child`, a copy of its parent, by one or a few moves, and keeps its shape. Returns
    /// their kinds, each as the bit of its index in [`MOVES`].
    pub fn vary(
        &mut self,
        rng: &mut ChaCha8Rng,
        child: &mut Draft,
        donor: &Draft,
        grammar: &Grammar,
        shape: &Shape,
    ) -> u16 {
        // Outputs that are constants stay so, and no move sees them.
        let constants = child.outputs.split_off(shape.formulas());
        let made_by = match child.outputs.is_empty() {
            true => {
                change_constant(rng, child);
                0
            }
            false => self.moves(rng, child, donor, grammar),
        };
        child.outputs.extend(constants);
        repair(rng, child, shape);
        made_by
    }

    fn moves(
        &mut self,
        rng: &mut ChaCha8Rng,
        child: &mut Draft,
        donor: &Draft,
        grammar: &Grammar,
    ) -> u16 {
        let mut made_by = 0;
        loop {
            let kind = self.pick(rng);
            self.change(rng, child, donor, grammar, MOVES[kind].0);
            made_by |= 1 << kind;
            if rng.random_range(0..100) < 60 {
                return made_by;
            }
        }
    }

    fn pick(&self, rng: &mut ChaCha8Rng) -> usize {
        let mut pick = rng.random::<f64>() * self.weights.iter().sum::<f64>();
        let passes = |weight: &f64| {
            pick -= weight;
            pick < 0.0
        };
        self.weights.iter().position(passes).unwrap_or(MOVES.len() - 1)
    }

    fn change(
        &mut self,
        rng: &mut ChaCha8Rng,
        child: &mut Draft,
        donor: &Draft,
        grammar: &Grammar,
        kind: Move,
    ) {
        match kind {
            Move::Operation => change_operation(rng, child, grammar),
            Move::Argument => change_argument(rng, child),
            Move::Constant => change_constant(rng, child),
            Move::Insert => insert(rng, child, grammar),
            Move::Grow => grow(rng, child),
            Move::Delete => delete(rng, child),
            Move::Graft => self.graft(rng, child, donor),
            Move::TakeOutput => self.take_output(rng, child, donor),
            Move::ExchangeConstant => exchange_constant(rng, child),
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

    /// Copies `root` and all that it depends on from the donor to the front of `child`. Returns the
    /// copy of `root`.
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
