//! The canonical structural hash of a program.

use super::{Arg, Draft};
use crate::op::Op;

/// The part of constants in a hash.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Constants {
    /// A constant counts, its value does not: programs that fitting makes equal have equal hashes.
    Ignored,
    /// The bits of constants count.
    Exact,
}

/// Hashes what the outputs compute. Introns, the order of independent instructions, whether a
/// result is shared or computed twice, and the order of operands that commute leave it unchanged.
/// `scratch` holds a hash for each instruction.
pub fn structural_hash(draft: &Draft, constants: Constants, scratch: &mut Vec<u64>) -> u64 {
    scratch.clear();
    for instr in &draft.instrs {
        let mut args = [0; crate::op::MAX_ARITY];
        for (to, &arg) in args.iter_mut().zip(instr.args()) {
            *to = arg_hash(draft, arg, constants, scratch);
        }
        if instr.op().commutes() && args[0] > args[1] {
            args.swap(0, 1);
        }
        scratch.push(instr_hash(instr.op(), &args[..instr.args().len()]));
    }
    draft
        .outputs
        .iter()
        .fold(0x0175, |hash, &output| mix(hash ^ arg_hash(draft, output, constants, scratch)))
}

fn instr_hash(op: Op, args: &[u64]) -> u64 {
    args.iter().fold(mix(0x1000 + op as u64), |hash, arg| mix(hash.rotate_left(17) ^ arg))
}

fn arg_hash(draft: &Draft, arg: Arg, constants: Constants, results: &[u64]) -> u64 {
    match (arg, constants) {
        (Arg::Input(i), _) => mix(0x2000 + u64::from(i)),
        (Arg::Const(_), Constants::Ignored) => mix(0x3000),
        (Arg::Const(i), Constants::Exact) => {
            mix((0x4000 << 32) + u64::from(draft.consts[usize::from(i)].to_bits()))
        }
        (Arg::Result(i), _) => results[usize::from(i)],
    }
}

/// The finaliser of SplitMix64 (Steele, Lea & Flood 2014).
fn mix(x: u64) -> u64 {
    let x = x.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}
