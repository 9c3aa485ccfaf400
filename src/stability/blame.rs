//! Finds the operation that loses the digits.

use crate::eval::{Arithmetic, Double};
use crate::op::{Family, MAX_ARITY, Op};
use crate::program::{Arg, Draft, Program};
use serde::Serialize;

/// The way in which digits are lost.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Cause {
    /// A small difference of large numbers.
    Cancellation,
    /// A result beyond the largest finite number.
    Overflow,
    /// A result below the least normal number.
    Underflow,
    /// An undefined result: 0/0, the root of a negative number, ∞ − ∞.
    Undefined,
    /// A small error of an argument, where the function is steep.
    Condition,
    /// The rounding that every operation adds.
    Rounding,
}

/// The operation where an error arose: its arguments were still accurate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Blame {
    /// The index of the instruction; none if an input or constant is to blame.
    pub instruction: Option<usize>,
    /// The cause.
    pub cause: Cause,
    /// The factor by which the operation multiplies a relative error of an argument.
    pub condition: f64,
}

/// Returns the program with every instruction's result as an output, before its own outputs.
pub(super) fn traced(program: &Program) -> Program {
    let mut draft: Draft = program.clone().into_draft();
    let own = std::mem::take(&mut draft.outputs);
    draft.outputs = (0..draft.instrs.len()).map(|i| Arg::Result(i as u16)).collect();
    draft.outputs.extend(own);
    Program::verify(draft).expect("its own results")
}

/// The results of all instructions of a [`traced`] program at one point, in low precision and in
/// `f64`.
pub(super) struct Evaluation<'a> {
    pub program: &'a Program,
    pub inputs: &'a [f32],
    pub found: &'a [f64],
    pub exact: &'a [f64],
    /// The least normal number of the low precision.
    pub least: f64,
}

/// The least ratio of an argument's error to the result's for which the argument is to blame.
/// Chosen by hand, unmeasured.
const INHERITED: f64 = 0.25;

impl Evaluation<'_> {
    fn exact(&self, arg: Arg) -> f64 {
        match arg {
            Arg::Input(i) => self.inputs[usize::from(i)].into(),
            Arg::Const(i) => self.program.consts[usize::from(i)].into(),
            Arg::Result(i) => self.exact[usize::from(i)],
        }
    }

    /// Returns an argument's relative error; infinite where NaN was found, even if the exact value
    /// is NaN, since NaN propagates.
    fn error(&self, arg: Arg) -> f64 {
        match arg {
            Arg::Result(i) if self.found[usize::from(i)].is_nan() => f64::INFINITY,
            Arg::Result(i) => relative(self.found[usize::from(i)], self.exact[usize::from(i)]),
            Arg::Input(_) | Arg::Const(_) => 0.0,
        }
    }

    /// Follows the error of an output back to where it arose.
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
                // The loss of all digits counts as 1, whatever error a division makes of it.
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

/// Returns the relative error; infinite where only one of the two is a number.
pub(super) fn relative(found: f64, exact: f64) -> f64 {
    if found == exact || found.is_nan() && exact.is_nan() {
        return 0.0;
    }
    let error = (found - exact).abs() / exact.abs();
    if error.is_nan() { f64::INFINITY } else { error }
}

/// Returns the largest ratio of the result's relative change to an argument's, by differences.
fn condition(op: Op, arguments: [f64; MAX_ARITY], result: f64) -> f64 {
    // Chosen by hand, unmeasured.
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

/// Returns true if terms may cancel in the operation.
fn is_a_sum(op: Op) -> bool {
    match op.family() {
        Family::Arithmetic => !matches!(op, Op::Neg | Op::Mul),
        Family::Choice => op == Op::Fract,
        Family::Quotient | Family::Root | Family::Exponential | Family::Trigonometric => false,
    }
}
