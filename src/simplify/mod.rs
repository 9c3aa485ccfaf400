//! Algebra on programs: what any shader compiler would do, and what fitting would make equal.
//!
//! A candidate is rebuilt instruction by instruction; each new one is first looked for among those
//! that exist (so equal subexpressions are shared), and rewritten where a rule applies.
//! Constants are taken as free: `(x + c₁) + c₂` becomes `x + c₃`. Rounding may change,
//! so whoever needs the value evaluates the result; nothing is promised bit for bit.

mod rescale;
mod rules;
mod tidy;

pub use rescale::{InputScale, Placement, rescaled};
pub use tidy::tidy;

use crate::op::{MAX_ARITY, Op};
use crate::program::{Arg, Draft, Instr, effective_into, use_counts};

/// Simplifies drafts; owns the memory that it needs.
#[derive(Clone, Debug, Default)]
pub struct Simplifier {
    draft: Draft,
    /// The new argument for each instruction of the source.
    moved: Vec<Arg>,
    /// How often each instruction of the source is read.
    uses: Vec<u32>,
    /// Whether each new instruction is read once only, in the end.
    read_once: Vec<bool>,
    scratch: Vec<u32>,
}

impl Simplifier {
    /// Writes a simpler form of `source`'s effective code to `target`.
    pub fn simplify(&mut self, source: &Draft, target: &mut Draft) {
        use_counts(source, &mut self.uses);
        self.moved.clear();
        self.read_once.clear();
        self.draft.clear(source.inputs);
        self.draft.consts.extend_from_slice(&source.consts);
        for (i, instr) in source.instrs.iter().enumerate() {
            if self.uses[i] == 0 {
                self.moved.push(Arg::Input(0));
                continue;
            }
            let mut args = [Arg::Input(0); MAX_ARITY];
            for (to, &arg) in args.iter_mut().zip(instr.args()) {
                *to = self.moved_arg(arg);
            }
            let arg = self.build(instr.op(), &args[..instr.args().len()]);
            if let Arg::Result(new) = arg {
                self.read_once[usize::from(new)] &= self.uses[i] == 1;
            }
            self.moved.push(arg);
        }
        for &output in &source.outputs {
            let output = self.moved_arg(output);
            self.draft.outputs.push(output);
        }
        effective_into(&self.draft, target, &mut self.scratch);
    }

    fn moved_arg(&self, arg: Arg) -> Arg {
        match arg {
            Arg::Result(i) => self.moved[usize::from(i)],
            other => other,
        }
    }

    /// The result of `op` on `args`: rewritten by a rule, or shared, or new.
    fn build(&mut self, op: Op, args: &[Arg]) -> Arg {
        if let Some(folded) = self.fold(op, args) {
            return folded;
        }
        if let Some(rewritten) = self.rewrite(op, args) {
            return rewritten;
        }
        let mut instr = Instr::new(op, args);
        if op.commutes() && instr.args()[0] > instr.args()[1] {
            instr.args_mut().swap(0, 1);
        }
        match self.draft.instrs.iter().position(|known| *known == instr) {
            Some(known) => {
                self.read_once[known] = false;
                Arg::Result(known as u16)
            }
            None => {
                self.draft.instrs.push(instr);
                self.read_once.push(true);
                Arg::Result((self.draft.instrs.len() - 1) as u16)
            }
        }
    }

    /// The value of an operation on constants, where it is finite.
    fn fold(&mut self, op: Op, args: &[Arg]) -> Option<Arg> {
        let mut values = [0.0; MAX_ARITY];
        for (to, &arg) in values.iter_mut().zip(args) {
            *to = self.constant(arg)?;
        }
        let value = op.apply(values);
        value.is_finite().then(|| self.draft.constant(value))
    }

    fn constant(&self, arg: Arg) -> Option<f32> {
        match arg {
            Arg::Const(i) => Some(self.draft.consts[usize::from(i)]),
            _ => None,
        }
    }

    fn definition(&self, arg: Arg) -> Option<Instr> {
        match arg {
            Arg::Result(i) => Some(self.draft.instrs[usize::from(i)]),
            _ => None,
        }
    }

    /// The arguments of `arg`'s instruction, if that is an `op`.
    fn operands(&self, arg: Arg, op: Op) -> Option<(Arg, Arg)> {
        let instr = self.definition(arg).filter(|instr| instr.op() == op)?;
        let args = instr.args();
        Some((args[0], *args.get(1).unwrap_or(&args[0])))
    }

    fn is_read_once(&self, arg: Arg) -> bool {
        matches!(arg, Arg::Result(i) if self.read_once[usize::from(i)])
    }
}
