//! What any compiler does to a program, and no more.

use super::Simplifier;
use crate::op::Op;
use crate::program::{Arg, Draft, Instr, Program};

/// The program as compilers run it: effective code, constants folded, nothing that does nothing, nothing
/// twice. The order of operands stays.
pub fn folded(program: &Program) -> Program {
    let mut target = Draft::default();
    Simplifier::default().fold_constants(program, &mut target);
    Program::verify(target).unwrap_or_else(|_| program.clone())
}

impl Simplifier {
    /// [`folded`], of drafts.
    pub fn fold_constants(&mut self, source: &Draft, target: &mut Draft) {
        self.only_folds = true;
        self.settle(source, target);
    }

    /// Whether folding would surely do nothing to a draft but leave out introns: a quick look, for costing
    /// candidates that are simplified already.
    pub fn is_folded(draft: &Draft) -> bool {
        let each = draft.instrs.iter().enumerate();
        each.clone().all(|(i, instr)| {
            !may_do_nothing(draft, instr)
                && !draft.instrs[..i].iter().any(|other| is_same(draft, instr, other))
        })
    }

    /// The number in the constant table; in folded programs each once.
    pub(super) fn number(&mut self, value: f32) -> Arg {
        let known = || self.draft.consts.iter().position(|c| c.to_bits() == value.to_bits());
        match self.only_folds.then(known).flatten() {
            Some(known) => Arg::Const(known as u16),
            None => self.draft.constant(value),
        }
    }

    /// The place of an instruction that gives the same.
    pub(super) fn known(&self, instr: &Instr) -> Option<usize> {
        let mut swapped = *instr;
        if instr.op().commutes() {
            swapped.args_mut().swap(0, 1);
        }
        self.draft.instrs.iter().position(|known| known == instr || *known == swapped)
    }
}

/// Whether an operation may be one of those that folding leaves out; not all are, as `1/0` is not.
fn may_do_nothing(draft: &Draft, instr: &Instr) -> bool {
    let args = instr.args();
    let constant = |arg: &Arg| match arg {
        Arg::Const(i) => Some(draft.consts[usize::from(*i)]),
        _ => None,
    };
    let is_zero = |arg: &Arg| constant(arg) == Some(0.0);
    let is_trivial = |arg: &Arg| matches!(constant(arg), Some(0.0 | 1.0 | -1.0));
    let inner = |arg: Arg| match arg {
        Arg::Result(i) => Some(draft.instrs[usize::from(i)].op()),
        _ => None,
    };
    if args.iter().all(|arg| constant(arg).is_some()) {
        return true;
    }
    match instr.op() {
        Op::Add => args.iter().any(is_zero),
        Op::Sub => is_same_arg(draft, args[0], args[1]) || args.iter().any(is_zero),
        Op::Mul => args.iter().any(is_trivial),
        Op::Div => is_zero(&args[0]) || is_trivial(&args[1]),
        Op::Mad => args[..2].iter().any(is_trivial) || is_zero(&args[2]),
        Op::Pow => is_trivial(&args[1]),
        Op::Min | Op::Max => is_same_arg(draft, args[0], args[1]),
        Op::Lerp => is_same_arg(draft, args[0], args[1]) || is_zero(&args[2]),
        Op::Select => {
            is_same_arg(draft, args[2], args[3]) || args[..2].iter().all(|a| constant(a).is_some())
        }
        op @ (Op::Neg | Op::Abs | Op::Saturate | Op::Floor | Op::Sign) => {
            inner(args[0]) == Some(op)
        }
        _ => false,
    }
}

/// Whether two arguments are one value by what they are; constants by what they hold.
fn is_same_arg(draft: &Draft, a: Arg, b: Arg) -> bool {
    match (a, b) {
        (Arg::Const(a), Arg::Const(b)) => {
            draft.consts[usize::from(a)].to_bits() == draft.consts[usize::from(b)].to_bits()
        }
        _ => a == b,
    }
}

fn is_same(draft: &Draft, instr: &Instr, other: &Instr) -> bool {
    let (a, b) = (instr.args(), other.args());
    if instr.op() != other.op() {
        return false;
    }
    let alike = |from: usize| (from..a.len()).all(|i| is_same_arg(draft, a[i], b[i]));
    let swapped = instr.op().commutes()
        && is_same_arg(draft, a[0], b[1])
        && is_same_arg(draft, a[1], b[0])
        && alike(2);
    alike(0) || swapped
}
