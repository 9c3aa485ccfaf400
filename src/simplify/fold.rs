//! Folds programs: what any compiler does, and no more.

use super::Simplifier;
use crate::op::Op;
use crate::program::{Arg, Draft, Instr, Program};

/// Returns the program as compilers run it: effective code, constants folded, no operation that
/// does nothing, none done twice. The order of operands stays.
pub fn folded(program: &Program) -> Program {
    // Folding makes only finite constants, and keeps every output.
    Program::verify(folded_draft(program)).expect("what is folded is a program")
}

/// [`folded`], for drafts.
pub fn folded_draft(draft: &Draft) -> Draft {
    let mut simplifier =
        Simplifier { only_folds: true, merges_constants: true, ..Simplifier::default() };
    let mut target = Draft::default();
    simplifier.settle(draft, &mut target);
    target
}

impl Simplifier {
    /// [`folded_draft`], except that equal constants stay apart, since they may be fitted apart.
    pub fn fold_constants(&mut self, source: &Draft, target: &mut Draft) {
        self.only_folds = true;
        self.merges_constants = false;
        self.settle(source, target);
    }

    /// Returns true if folding would surely remove nothing but introns: a quick look, for costing
    /// candidates that are simplified already.
    pub fn is_folded(draft: &Draft) -> bool {
        let mut each = draft.instrs.iter().enumerate();
        each.all(|(i, instr)| {
            !may_do_nothing(draft, instr)
                && !draft.instrs[..i].iter().any(|other| is_same(instr, other))
        })
    }

    /// Returns the entry of a number in the constant table; in folded programs each number has one
    /// entry.
    pub(super) fn number(&mut self, value: f32) -> Arg {
        let known = || self.draft.consts.iter().position(|c| c.to_bits() == value.to_bits());
        match self.merges_constants.then(known).flatten() {
            Some(known) => Arg::Const(known as u16),
            None => self.draft.constant(value),
        }
    }

    /// Returns the index of an instruction with the same result.
    pub(super) fn known(&self, instr: &Instr) -> Option<usize> {
        let mut swapped = *instr;
        if instr.op().commutes() {
            swapped.args_mut().swap(0, 1);
        }
        self.draft.instrs.iter().position(|known| known == instr || *known == swapped)
    }
}

/// Returns true if an instruction occurs twice, with the same constants.
pub(super) fn has_twice(draft: &Draft) -> bool {
    let mut each = draft.instrs.iter().enumerate();
    each.any(|(i, instr)| draft.instrs[..i].contains(instr))
}

/// Returns true if folding may remove an instruction; it need not, as `1/0` shows.
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
        Op::Sub => args[0] == args[1] || args.iter().any(is_zero),
        Op::Mul => args.iter().any(is_trivial),
        Op::Div => is_zero(&args[0]) || is_trivial(&args[1]),
        Op::Mad => args[..2].iter().any(is_trivial) || is_zero(&args[2]),
        Op::Pow => is_trivial(&args[1]),
        Op::Min | Op::Max => args[0] == args[1],
        Op::Lerp => args[0] == args[1] || is_zero(&args[2]),
        Op::Select => args[2] == args[3] || args[..2].iter().all(|a| constant(a).is_some()),
        op @ (Op::Neg | Op::Abs | Op::Saturate | Op::Floor | Op::Sign) => {
            inner(args[0]) == Some(op)
        }
        _ => false,
    }
}

fn is_same(instr: &Instr, other: &Instr) -> bool {
    let (a, b) = (instr.args(), other.args());
    let swapped = instr.op().commutes() && instr.op() == other.op();
    instr == other || swapped && a[0] == b[1] && a[1] == b[0] && a[2..] == b[2..]
}
