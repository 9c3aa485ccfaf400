//! What a program costs on a GPU: cycles of its effective code.
//!
//! Shared results are paid once, a product that only sums read is fused with them, and modifiers
//! of arguments and results are free, as compilers have it.

mod profile;

pub use profile::Profile;

use crate::op::Op;
use crate::program::{Arg, Draft, use_counts};

/// Scratch memory of [`Profile::cycles`].
#[derive(Clone, Debug, Default)]
pub struct CostScratch {
    uses: Vec<u32>,
    fused: Vec<bool>,
    absorbed: Vec<u32>,
    reciprocals: Vec<Arg>,
}

impl Profile {
    /// The cycles of a draft's effective code.
    pub fn cycles(&self, draft: &Draft, scratch: &mut CostScratch) -> f64 {
        use_counts(draft, &mut scratch.uses);
        scratch.reciprocals.clear();
        fuse_products(draft, scratch);
        let mut cycles = 0.0;
        for i in 0..draft.instrs.len() {
            if scratch.uses[i] > 0 {
                cycles += self.instruction(draft, i, scratch);
            }
        }
        cycles
    }

    fn instruction(&self, draft: &Draft, i: usize, scratch: &mut CostScratch) -> f64 {
        let instr = &draft.instrs[i];
        let args = instr.args();
        match instr.op() {
            Op::Neg | Op::Abs if !is_output(draft, i) => 0.0,
            Op::Neg if is_arithmetic_read_once(draft, args[0], &scratch.uses) => 0.0,
            Op::Saturate if modifies_a_result(draft, args[0], &scratch.uses) => 0.0,
            Op::Mul if scratch.fused[i] => 0.0,
            Op::Rcp => self.reciprocal(args[0], scratch),
            Op::Div => {
                let product = if scratch.fused[i] { 0.0 } else { self.of(Op::Mul) };
                match (args[0], args[1]) {
                    (_, Arg::Const(_)) => product,
                    (numerator, y) if is_one(draft, numerator) => self.reciprocal(y, scratch),
                    (_, y) => product + self.reciprocal(y, scratch),
                }
            }
            op => self.of(op),
        }
    }

    /// The reciprocal of a value, which any number of quotients share.
    fn reciprocal(&self, of: Arg, scratch: &mut CostScratch) -> f64 {
        if scratch.reciprocals.contains(&of) {
            return 0.0;
        }
        scratch.reciprocals.push(of);
        self.of(Op::Rcp)
    }
}

/// Marks each product (a quotient is one, with a reciprocal) that sums absorb: each of its
/// readers is a sum, and absorbs it. A sum absorbs one product, perhaps negated.
fn fuse_products(draft: &Draft, scratch: &mut CostScratch) {
    let CostScratch { uses, fused, absorbed, .. } = scratch;
    absorbed.clear();
    absorbed.resize(draft.instrs.len(), 0);
    for (i, instr) in draft.instrs.iter().enumerate() {
        if uses[i] == 0 || !matches!(instr.op(), Op::Add | Op::Sub) {
            continue;
        }
        let products = instr.args().iter().filter_map(|&arg| product(draft, arg, uses));
        if let Some(product) = products.min_by_key(|&product| uses[product]) {
            absorbed[product] += 1;
        }
    }
    fused.clear();
    fused.extend((0..draft.instrs.len()).map(|i| uses[i] > 0 && absorbed[i] == uses[i]));
}

/// The product that `arg` is, perhaps negated.
fn product(draft: &Draft, arg: Arg, uses: &[u32]) -> Option<usize> {
    let Arg::Result(i) = arg else { return None };
    let i = usize::from(i);
    let instr = &draft.instrs[i];
    match instr.op() {
        Op::Mul => Some(i),
        Op::Div if !is_one(draft, instr.args()[0]) => Some(i),
        Op::Neg if uses[i] == 1 => product(draft, instr.args()[0], uses),
        _ => None,
    }
}

fn is_one(draft: &Draft, arg: Arg) -> bool {
    matches!(arg, Arg::Const(c) if draft.consts[usize::from(c)] == 1.0)
}

fn is_output(draft: &Draft, i: usize) -> bool {
    draft.outputs.contains(&Arg::Result(i as u16))
}

/// Whether the sign of `arg` can move into the arguments of its instruction.
fn is_arithmetic_read_once(draft: &Draft, arg: Arg, uses: &[u32]) -> bool {
    let Arg::Result(i) = arg else { return false };
    let arithmetic = [Op::Add, Op::Sub, Op::Mul, Op::Div, Op::Mad];
    uses[usize::from(i)] == 1 && arithmetic.contains(&draft.instrs[usize::from(i)].op())
}

/// Whether `arg` is the result of an instruction that nothing else reads, so that a clamp of it is
/// part of the instruction.
fn modifies_a_result(draft: &Draft, arg: Arg, uses: &[u32]) -> bool {
    let Arg::Result(i) = arg else { return false };
    let instr = &draft.instrs[usize::from(i)];
    uses[usize::from(i)] == 1
        && match instr.op() {
            Op::Neg => is_arithmetic_read_once(draft, instr.args()[0], uses),
            Op::Abs => false,
            _ => true,
        }
}
