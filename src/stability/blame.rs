//! Which operation loses the digits.

use crate::eval::{Arithmetic, Double};
use crate::op::{Family, MAX_ARITY, Op};
use crate::program::{Arg, Draft, Program};
use serde::Serialize;

/// How digits are lost.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Cause {
    /// A small difference of large numbers.
    Cancellation,
    /// A value beyond the largest finite number.
    Overflow,
    /// A value below the least normal number.
    Underflow,
    /// No value: 0/0, the root of a negative number, ∞ − ∞.
    Undefined,
    /// An argument is off by little, and the function steep.
    Condition,
    /// No more than each operation adds.
    Rounding,
}

/// The operation whose arguments were still good.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Blame {
    /// The instruction; none where an input or constant is to blame.
    pub instruction: Option<usize>,
    /// The cause.
    pub cause: Cause,
    /// By how much the operation multiplies a relative error of an argument.
    pub condition: f64,
}

/// The program with every instruction's result as an output, before its own.
pub(super) fn traced(program: &Program) -> Program {
    let mut draft: Draft = program.clone().into_draft();
    let own = std::mem::take(&mut draft.outputs);
    draft.outputs = (0..draft.instrs.len()).map(|i| Arg::Result(i as u16)).collect();
    draft.outputs.extend(own);
    Program::verify(draft).expect("its own results")
}

/// Values of all instructions in low precision, and exactly.
pub(super) struct Evaluation<'a> {
    pub program: &'a Program,
    pub inputs: &'a [f32],
    pub found: &'a [f64],
    pub exact: &'a [f64],
    /// The least number with all digits.
    pub least: f64,
}

/// What an argument inherits of a result's error is to blame if it is this share of it.
const INHERITED: f64 = 0.25;

impl Evaluation<'_> {
    fn exact(&self, arg: Arg) -> f64 {
        match arg {
            Arg::Input(i) => self.inputs[usize::from(i)].into(),
            Arg::Const(i) => self.program.consts[usize::from(i)].into(),
            Arg::Result(i) => self.exact[usize::from(i)],
        }
    }

    /// Infinite of NaN, wherever it is: what is made of it is NaN, too.
    fn error(&self, arg: Arg) -> f64 {
        match arg {
            Arg::Result(i) if self.found[usize::from(i)].is_nan() => f64::INFINITY,
            Arg::Result(i) => relative(self.found[usize::from(i)], self.exact[usize::from(i)]),
            Arg::Input(_) | Arg::Const(_) => 0.0,
        }
    }

    /// Follows the error of an output up to where it arose.
    pub fn blame(&self, output: Arg) -> Blame {
        let mut arg = output;
        loop {
            let Arg::Result(i) = arg else {
                return Blame { instruction: None, cause: Cause::Rounding, condition: 1.0 };
            };
            let i = usize::from(i);
            let instr = &self.program.instrs[i];
            let here = self.error(arg);
            let inherits = |&&from: &&Arg| {
                // No more than all can be lost, whatever a division makes of it.
                self.error(from).min(1.0) >= here.min(1.0) * INHERITED && here > 0.0
            };
            let worst = instr
                .args()
                .iter()
                .filter(inherits)
                .max_by(|&&a, &&b| self.error(a).total_cmp(&self.error(b)));
            match worst {
                Some(&from) => arg = from,
                None => return self.cause(i),
            }
        }
    }

    fn cause(&self, i: usize) -> Blame {
        let instr = &self.program.instrs[i];
        let (found, exact) = (self.found[i], self.exact[i]);
        let mut arguments = [0.0; MAX_ARITY];
        for (to, &arg) in arguments.iter_mut().zip(instr.args()) {
            *to = self.exact(arg);
        }
        let condition = condition(instr.op(), arguments, exact);
        let sums = is_a_sum(instr.op());
        let cause = match () {
            () if found.is_nan() || exact.is_nan() => Cause::Undefined,
            () if found.is_infinite() && exact.is_infinite() => Cause::Undefined,
            () if found.is_infinite() => Cause::Overflow,
            () if found.abs() < self.least && found != exact && !sums => Cause::Underflow,
            () if condition > 8.0 && sums => Cause::Cancellation,
            () if condition > 8.0 => Cause::Condition,
            () => Cause::Rounding,
        };
        Blame { instruction: Some(i), cause, condition }
    }
}

/// The relative error; infinite where one is a number and the other not.
pub(super) fn relative(found: f64, exact: f64) -> f64 {
    if found == exact || found.is_nan() && exact.is_nan() {
        return 0.0;
    }
    let error = (found - exact).abs() / exact.abs();
    if error.is_nan() { f64::INFINITY } else { error }
}

/// The largest relative change of a result, over that of an argument, by differences.
fn condition(op: Op, arguments: [f64; MAX_ARITY], result: f64) -> f64 {
    const STEP: f64 = 1e-7;
    let mut worst = 0.0f64;
    for k in 0..op.arity() {
        let mut moved = arguments;
        moved[k] *= 1.0 + STEP;
        let change = (Double.apply(op, moved) - result).abs() / (STEP * result.abs());
        worst = worst.max(if change.is_nan() { 0.0 } else { change });
    }
    worst
}

/// Whether terms may cancel in it.
fn is_a_sum(op: Op) -> bool {
    match op.family() {
        Family::Arithmetic => !matches!(op, Op::Neg | Op::Mul),
        Family::Choice => op == Op::Fract,
        Family::Quotient | Family::Root | Family::Exponential | Family::Trigonometric => false,
    }
}
