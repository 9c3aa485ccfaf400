//! The edges of a draft's graph, from values to their readers.

use crate::program::{Arg, Draft};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

/// An edge, by its reader.
#[derive(Clone, Copy)]
pub(super) enum Edge {
    /// The instruction of the first index, its argument of the second.
    Argument(usize, usize),
    /// The output of this index.
    Output(usize),
}

/// Returns a random edge to an instruction from `first` on or to an output.
pub(super) fn pick_edge(rng: &mut ChaCha8Rng, draft: &Draft, first: usize) -> Edge {
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

pub(super) fn edge_mut(draft: &mut Draft, edge: Edge) -> &mut Arg {
    match edge {
        Edge::Argument(i, place) => &mut draft.instrs[i].args_mut()[place],
        Edge::Output(o) => &mut draft.outputs[o],
    }
}

/// Returns the number of instructions before the reader, whose results it may read.
pub(super) fn earlier_than(draft: &Draft, edge: Edge) -> usize {
    match edge {
        Edge::Argument(i, _) => i,
        Edge::Output(_) => draft.instrs.len(),
    }
}

/// Renumbers the results from `first` on, for `by` instructions that will be inserted there.
pub(super) fn shift_results(draft: &mut Draft, first: usize, by: u16) {
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
