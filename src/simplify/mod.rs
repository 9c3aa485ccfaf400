//! Algebra on programs, at two levels. No other module simplifies formulas.
//!
//! **Folding** ([`folded`]) is what any shader compiler does, since shaders are compiled without
//! strict IEEE-754: operations on constants alone are computed, operations that do nothing are
//! dropped (`x + 0`, `1*x`, `x/1`, `x - x`, `0*x`, `pow(x, 1)`), and repeated ones are computed
//! once. Finite values keep their bits, except for the sign of a zero and the rounding of a power;
//! where `x` is infinite or NaN, `x - x` and `0*x` are 0 all the same. Cycles are therefore those
//! of the folded code ([`crate::cost`]), and a formula that is scored, shown or emitted is folded
//! first: its errors are those of the text shown. Proofs ([`crate::stability`]) are of formulas as
//! their authors wrote them.
//!
//! **Simplification** ([`Simplifier::simplify`]) also merges what fitting would make equal. A
//! candidate is rebuilt instruction by instruction; each new one is first looked for among those
//! that exist (so equal subexpressions are shared), and rewritten while a rule applies. Constants
//! are taken as free: `(x + c₁) + c₂` becomes `x + c₃`. Rounding may change: callers that need the
//! value evaluate the result. A simplified program has no operation that does nothing, none on
//! constants alone unless its value is not finite (`1/0`), and is its own simplification.
//!
//! ```
//! use lgp::program::{Draft, Names, Program, parse, print};
//! use lgp::simplify::Simplifier;
//!
//! let names = Names::new(["x"], ["y"]);
//! let formula = parse("y = exp2(log2(x)) + 1 + 2", &names)?;
//! let mut simple = Draft::default();
//! Simplifier::default().simplify(&formula, &mut simple);
//! assert_eq!(print(&Program::verify(simple)?, &names), "y = x + 3");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod fold;
mod identities;
mod ratios;
mod rescale;
mod rules;
mod tidy;

pub use fold::{folded, folded_draft};
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
    /// The new argument for each constant of the source.
    numbers: Vec<Arg>,
    /// How often each instruction of the source is read.
    uses: Vec<u32>,
    /// For each new instruction, true if it is read only once in the end.
    read_once: Vec<bool>,
    /// For each new instruction, true if it is an output.
    is_output: Vec<bool>,
    scratch: Vec<u32>,
    /// True if only folding is done.
    only_folds: bool,
    /// True if equal constants are merged; otherwise they can be fitted apart.
    merges_constants: bool,
    /// True if anything but introns was removed or rewritten.
    changed: bool,
    previous: Draft,
    shared: Draft,
}

/// The most passes over a program; hardly any needs more than three.
const MAX_PASSES: usize = 12;

impl Simplifier {
    /// Writes a simpler form of `source`'s effective code to `target`.
    pub fn simplify(&mut self, source: &Draft, target: &mut Draft) {
        self.merges_constants = false;
        self.only_folds = false;
        if !fold::has_twice(source) {
            return self.settle(source, target);
        }
        // Sharing repeated code first shows which results are read once.
        let mut shared = std::mem::take(&mut self.shared);
        self.only_folds = true;
        self.settle(source, &mut shared);
        self.only_folds = false;
        self.settle(&shared, target);
        self.shared = shared;
    }

    /// Repeats passes until nothing changes.
    fn settle(&mut self, source: &Draft, target: &mut Draft) {
        self.pass(source, target);
        let mut previous = std::mem::take(&mut self.previous);
        for _ in 1..MAX_PASSES {
            if !self.changed {
                break;
            }
            previous.copy_from(target);
            self.pass(&previous, target);
        }
        self.previous = previous;
    }

    /// Passes over the instructions once, in order.
    fn pass(&mut self, source: &Draft, target: &mut Draft) {
        self.changed = false;
        use_counts(source, &mut self.uses);
        self.moved.clear();
        self.read_once.clear();
        self.is_output.clear();
        self.draft.clear(source.inputs);
        self.numbers.clear();
        for &value in &source.consts {
            let number = self.number(value);
            self.numbers.push(number);
        }
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
                self.is_output[usize::from(new)] |= source.outputs.contains(&Arg::Result(i as u16));
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
            Arg::Const(i) => self.numbers[usize::from(i)],
            Arg::Input(_) => arg,
        }
    }

    /// Returns the result of `op` on `args`: rewritten by a rule, or shared, or new.
    fn build(&mut self, op: Op, args: &[Arg]) -> Arg {
        if let Some(rewritten) = self.rewritten(op, args) {
            self.changed = true;
            return rewritten;
        }
        let mut instr = Instr::new(op, args);
        if !self.only_folds && op.commutes() && instr.args()[0] > instr.args()[1] {
            instr.args_mut().swap(0, 1);
        }
        match self.known(&instr) {
            Some(known) => {
                self.changed = true;
                self.read_once[known] = false;
                Arg::Result(known as u16)
            }
            None => {
                self.draft.instrs.push(instr);
                self.read_once.push(true);
                self.is_output.push(false);
                Arg::Result((self.draft.instrs.len() - 1) as u16)
            }
        }
    }

    fn rewritten(&mut self, op: Op, args: &[Arg]) -> Option<Arg> {
        if let Some(known) = self.fold(op, args).or_else(|| self.identity(op, args)) {
            return Some(known);
        }
        if self.only_folds { None } else { self.rewrite(op, args) }
    }

    /// Computes an operation on constants, if its value is finite.
    fn fold(&mut self, op: Op, args: &[Arg]) -> Option<Arg> {
        let mut values = [0.0; MAX_ARITY];
        for (to, &arg) in values.iter_mut().zip(args) {
            *to = self.constant(arg)?;
        }
        let value = op.apply(values);
        value.is_finite().then(|| self.number(value))
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

    /// Returns the first two arguments of `arg`'s instruction, if that is an `op`.
    fn operands(&self, arg: Arg, op: Op) -> Option<(Arg, Arg)> {
        let instr = self.definition(arg).filter(|instr| instr.op() == op)?;
        let args = instr.args();
        Some((args[0], *args.get(1).unwrap_or(&args[0])))
    }

    /// Returns the value that `arg` negates, unless that sign costs something, being an output's.
    fn negated(&self, arg: Arg) -> Option<Arg> {
        let (inner, _) = self.operands(arg, Op::Neg)?;
        matches!(arg, Arg::Result(i) if !self.is_output[usize::from(i)]).then_some(inner)
    }

    fn is_read_once(&self, arg: Arg) -> bool {
        matches!(arg, Arg::Result(i) if self.read_once[usize::from(i)])
    }
}
