//! All drafts that are one instruction larger than another.

use super::edge::{Edge, earlier_than, edge_mut, shift_results};
use crate::grammar::Grammar;
use crate::op::MAX_ARITY;
use crate::program::{Arg, Draft, Instr};

/// Returns the number of drafts that [`insertions`] visits.
pub(in crate::search) fn insertion_count(draft: &Draft, grammar: &Grammar) -> usize {
    let count = |edge: Edge| -> usize {
        let sources = draft.inputs + earlier_than(draft, edge) + 1;
        let choices = |arity: usize| arity.saturating_mul(sources.saturating_pow(arity as u32 - 1));
        grammar.operations.iter().map(|(op, _)| choices(op.arity())).fold(0, usize::saturating_add)
    };
    edges(draft).map(count).fold(0, usize::saturating_add)
}

fn edges(draft: &Draft) -> impl Iterator<Item = Edge> {
    let arguments = draft.instrs.iter().enumerate();
    arguments
        .flat_map(|(i, instr)| (0..instr.args().len()).map(move |place| Edge::Argument(i, place)))
        .chain((0..draft.outputs.len()).map(Edge::Output))
}

/// Visits every draft that one more instruction makes of this one: any operation of the grammar, at
/// any edge, with inputs, earlier results or new constants as its other arguments. Not all differ
/// in structure.
pub(in crate::search) fn insertions(
    draft: &Draft,
    grammar: &Grammar,
    visit: &mut dyn FnMut(&Draft),
) {
    for edge in edges(draft) {
        let at = earlier_than(draft, edge);
        let mut grown = draft.clone();
        let source = *edge_mut(&mut grown, edge);
        shift_results(&mut grown, at, 1);
        *edge_mut(&mut grown, edge) = Arg::Result(at as u16);
        let constants = grown.consts.len();
        // A constant for each argument that may read one, all different.
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
