//! Lowers instructions as a compiler does: some become others, some merge into their readers, or
//! into a modifier of their argument.

use super::CostScratch;
use super::chip::{Merges, Saturates};
use crate::op::Op;
use crate::program::{Arg, Draft, use_counts};

/// The lowered form of an instruction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Lowered {
    /// Nothing: an intron, a part of each of its readers, or a modifier.
    Merged,
    /// The instructions of an operation.
    As(Op),
    /// A number of products.
    Products(u32),
    /// A minimum or maximum of three, or a clamp between constants.
    Three,
    /// An inverse, unless another quotient has computed it, and a product, unless a sum absorbs it.
    Quotient { inverse: Option<Op>, product: bool },
}

/// Finds the form of each instruction, and leaves the uses and the forms in `scratch`.
pub(super) fn find_forms(draft: &Draft, merges: &Merges, scratch: &mut CostScratch) {
    use_counts(draft, &mut scratch.uses);
    absorb_products(draft, merges, scratch);
    scratch.inverses.clear();
    scratch.forms.clear();
    for i in 0..draft.instrs.len() {
        let form =
            if scratch.uses[i] > 0 { form(draft, i, merges, scratch) } else { Lowered::Merged };
        scratch.forms.push(form);
    }
}

fn form(draft: &Draft, i: usize, merges: &Merges, scratch: &mut CostScratch) -> Lowered {
    let instr = &draft.instrs[i];
    let args = instr.args();
    let absorbed = scratch.is_absorbed(i);
    // Its value is not finite, or it would have been folded.
    if args.iter().all(|&arg| is_any_constant(arg)) {
        return Lowered::Merged;
    }
    match instr.op() {
        Op::Neg | Op::Abs if !is_output(draft, i) => Lowered::Merged,
        Op::Neg if takes_sign(draft, args[0], &scratch.uses) => Lowered::Merged,
        Op::Saturate if saturates_free(draft, args[0], merges, &scratch.uses) => Lowered::Merged,
        Op::Mul if absorbed => Lowered::Merged,
        Op::Mul if merges.scaled_results && scales_a_sum(draft, args, scratch) => Lowered::Merged,
        Op::Sqrt | Op::Rsqrt if scratch.divides[i] == scratch.uses[i] => Lowered::Merged,
        Op::Rcp => quotient(inverse(draft, args[0], scratch), false),
        Op::Div => match (args[0], args[1]) {
            (_, Arg::Const(_)) if absorbed => Lowered::Merged,
            (_, Arg::Const(_)) => Lowered::As(Op::Mul),
            (x, y) if is_constant(draft, x, 1.0) => quotient(inverse(draft, y, scratch), false),
            (_, y) => quotient(inverse(draft, y, scratch), !absorbed),
        },
        Op::Pow => power(draft, args),
        Op::Lerp if is_any_constant(args[0]) && is_any_constant(args[1]) => Lowered::As(Op::Mad),
        op @ (Op::Min | Op::Max) if merges.min3.is_some() => extremum(draft, op, args, scratch),
        op => Lowered::As(op),
    }
}

/// Returns the operation that computes the inverse of a value; none if it is known already. The
/// inverse of a root that is only divided by is the other root.
fn inverse(draft: &Draft, of: Arg, scratch: &mut CostScratch) -> Option<Op> {
    let of = unsigned(draft, of);
    if scratch.inverses.contains(&of) {
        return None;
    }
    scratch.inverses.push(of);
    let Arg::Result(i) = of else { return Some(Op::Rcp) };
    let i = usize::from(i);
    match (scratch.forms[i], draft.instrs[i].op()) {
        (Lowered::Merged, Op::Sqrt) => Some(Op::Rsqrt),
        (Lowered::Merged, Op::Rsqrt) => Some(Op::Sqrt),
        _ => Some(Op::Rcp),
    }
}

/// Returns an argument without its sign.
fn unsigned(draft: &Draft, arg: Arg) -> Arg {
    match arg {
        Arg::Result(i) if draft.instrs[usize::from(i)].op() == Op::Neg => {
            draft.instrs[usize::from(i)].args()[0]
        }
        _ => arg,
    }
}

fn quotient(inverse: Option<Op>, product: bool) -> Lowered {
    match (inverse, product) {
        (None, false) => Lowered::Merged,
        _ => Lowered::Quotient { inverse, product },
    }
}

/// Lowers powers that need no logarithm; of whole exponents only 2 and 4 are expanded.
fn power(draft: &Draft, args: &[Arg]) -> Lowered {
    let constant = |arg: Arg| match arg {
        Arg::Const(c) => Some(draft.consts[usize::from(c)]),
        _ => None,
    };
    match (constant(args[0]), constant(args[1])) {
        (_, Some(2.0)) => Lowered::Products(1),
        (_, Some(4.0)) => Lowered::Products(2),
        (_, Some(0.5)) => Lowered::As(Op::Sqrt),
        (_, Some(-0.5)) => Lowered::As(Op::Rsqrt),
        // exp2(y log₂ c) with the logarithm known: as many instructions as e^y.
        (Some(_), _) => Lowered::As(Op::Exp),
        _ => Lowered::As(Op::Pow),
    }
}

/// Merges a minimum of a minimum that nothing else reads into one of three; likewise a clamp.
fn extremum(draft: &Draft, op: Op, args: &[Arg], scratch: &mut CostScratch) -> Lowered {
    for (arg, other) in [(args[0], args[1]), (args[1], args[0])] {
        let Arg::Result(j) = arg else { continue };
        let j = usize::from(j);
        let inner = draft.instrs[j].op();
        let clamps = || {
            let opposite = if op == Op::Min { Op::Max } else { Op::Min };
            let bounded = draft.instrs[j].args().iter().any(|&a| is_any_constant(a));
            inner == opposite && is_any_constant(other) && bounded
        };
        if scratch.uses[j] == 1
            && scratch.forms[j] == Lowered::As(inner)
            && (inner == op || clamps())
        {
            scratch.forms[j] = Lowered::Merged;
            return Lowered::Three;
        }
    }
    Lowered::As(op)
}

/// Counts how many sums absorb each product (a quotient is one, with an inverse), and how often
/// each result is divided by. A sum absorbs one product, perhaps negated.
fn absorb_products(draft: &Draft, merges: &Merges, scratch: &mut CostScratch) {
    let CostScratch { uses, absorbed, divides, .. } = scratch;
    for counts in [&mut *absorbed, divides] {
        counts.clear();
        counts.resize(draft.instrs.len(), 0);
    }
    for (i, instr) in draft.instrs.iter().enumerate() {
        if uses[i] == 0 {
            continue;
        }
        match (instr.op(), instr.args()) {
            (Op::Add | Op::Sub, args) => {
                let products = args.iter().filter_map(|&arg| product(draft, arg, merges, uses));
                if let Some(product) = products.min_by_key(|&product| uses[product]) {
                    absorbed[product] += 1;
                }
            }
            (Op::Rcp, [Arg::Result(j)]) | (Op::Div, [_, Arg::Result(j)]) => {
                divides[usize::from(*j)] += 1;
            }
            _ => {}
        }
    }
}

/// Returns the index of the product that `arg` is, perhaps negated.
fn product(draft: &Draft, arg: Arg, merges: &Merges, uses: &[u32]) -> Option<usize> {
    let Arg::Result(i) = arg else { return None };
    let i = usize::from(i);
    let instr = &draft.instrs[i];
    match instr.op() {
        Op::Mul => Some(i),
        Op::Div if is_any_constant(instr.args()[1]) => Some(i),
        Op::Div if merges.quotients && !is_constant(draft, instr.args()[0], 1.0) => Some(i),
        Op::Neg if uses[i] == 1 => product(draft, instr.args()[0], merges, uses),
        _ => None,
    }
}

fn is_any_constant(arg: Arg) -> bool {
    matches!(arg, Arg::Const(_))
}

fn is_constant(draft: &Draft, arg: Arg, value: f32) -> bool {
    matches!(arg, Arg::Const(c) if draft.consts[usize::from(c)] == value)
}

fn is_output(draft: &Draft, i: usize) -> bool {
    draft.outputs.contains(&Arg::Result(i as u16))
}

fn is_arithmetic(op: Op) -> bool {
    matches!(op, Op::Add | Op::Sub | Op::Mul | Op::Div | Op::Mad)
}

fn is_root(draft: &Draft, arg: Arg) -> bool {
    matches!(arg, Arg::Result(i) if matches!(draft.instrs[usize::from(i)].op(), Op::Sqrt | Op::Rsqrt))
}

/// Returns true if the sign of `arg` can move into the arguments of its instruction, which nothing
/// else reads.
fn takes_sign(draft: &Draft, arg: Arg, uses: &[u32]) -> bool {
    let Arg::Result(i) = arg else { return false };
    let instr = draft.instrs[usize::from(i)];
    let inverts_no_root = instr.op() == Op::Rcp && !is_root(draft, instr.args()[0]);
    uses[usize::from(i)] == 1 && (is_arithmetic(instr.op()) || inverts_no_root)
}

/// Returns true if `arg` is the result of an instruction that nothing else reads, so that a clamp
/// of it to [0, 1] is part of the instruction.
fn saturates_free(draft: &Draft, arg: Arg, merges: &Merges, uses: &[u32]) -> bool {
    let Arg::Result(i) = arg else { return false };
    let instr = &draft.instrs[usize::from(i)];
    uses[usize::from(i)] == 1
        && match (instr.op(), merges.saturates) {
            (Op::Neg, _) => takes_sign(draft, instr.args()[0], uses),
            (Op::Abs, _) => false,
            (_, Saturates::Every) => true,
            (op, Saturates::Arithmetic) => is_arithmetic(op) || op == Op::Lerp,
        }
}

/// Returns true if a product is that of 2, 4 or ½ and an arithmetic result that nothing else reads.
fn scales_a_sum(draft: &Draft, args: &[Arg], scratch: &CostScratch) -> bool {
    [(args[0], args[1]), (args[1], args[0])].into_iter().any(|(arg, factor)| {
        let Arg::Result(i) = arg else { return false };
        let i = usize::from(i);
        let arithmetic = matches!(scratch.forms[i], Lowered::As(op) if is_arithmetic(op));
        let factors = [2.0, 4.0, 0.5];
        arithmetic
            && scratch.uses[i] == 1
            && factors.iter().any(|&value| is_constant(draft, factor, value))
    })
}
