//! Effective code: the instructions that an output depends on.

use super::{Arg, Draft, Program};

/// Counts how often effective code and outputs read each instruction's result; 0 for introns.
pub fn use_counts(draft: &Draft, counts: &mut Vec<u32>) {
    counts.clear();
    counts.resize(draft.instrs.len(), 0);
    for &output in &draft.outputs {
        if let Arg::Result(i) = output {
            counts[usize::from(i)] += 1;
        }
    }
    for i in (0..draft.instrs.len()).rev() {
        if counts[i] == 0 {
            continue;
        }
        for &arg in draft.instrs[i].args() {
            if let Arg::Result(j) = arg {
                counts[usize::from(j)] += 1;
            }
        }
    }
}

/// Returns the program without its introns and unused constants; it evaluates bit for bit as
/// `program`.
pub fn effective(program: &Program) -> Program {
    let mut draft = Draft::default();
    effective_into(program, &mut draft, &mut Vec::new());
    Program(draft)
}

/// Writes the [`effective`] code to `target`, with `scratch`; nothing is allocated once both are
/// large enough.
pub fn effective_into(source: &Draft, target: &mut Draft, scratch: &mut Vec<u32>) {
    use_counts(source, scratch);
    let instructions = source.instrs.len();
    scratch.resize(instructions + source.consts.len(), UNUSED);
    target.clear(source.inputs);
    // A kept instruction's count becomes its new index; the constants' indices follow.
    for (i, instr) in source.instrs.iter().enumerate() {
        if scratch[i] == 0 {
            continue;
        }
        let mut instr = *instr;
        for arg in instr.args_mut() {
            *arg = moved(*arg, source, target, scratch);
        }
        scratch[i] = target.instrs.len() as u32;
        target.instrs.push(instr);
    }
    for &output in &source.outputs {
        let output = moved(output, source, target, scratch);
        target.outputs.push(output);
    }
}

/// Marks a constant that no effective instruction has read yet.
const UNUSED: u32 = u32::MAX;

/// Renumbers an argument; a constant is added when first met.
fn moved(arg: Arg, source: &Draft, target: &mut Draft, new_index: &mut [u32]) -> Arg {
    match arg {
        Arg::Input(_) => arg,
        Arg::Result(i) => Arg::Result(new_index[usize::from(i)] as u16),
        Arg::Const(i) => {
            let entry = &mut new_index[source.instrs.len() + usize::from(i)];
            if *entry == UNUSED {
                *entry = target.consts.len() as u32;
                target.consts.push(source.consts[usize::from(i)]);
            }
            Arg::Const(*entry as u16)
        }
    }
}
