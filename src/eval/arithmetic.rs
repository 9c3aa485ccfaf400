//! Evaluation in arithmetics other than `f32`, sample by sample.

use crate::op::{MAX_ARITY, Op};
use crate::program::{Arg, Program};

/// The meaning of the operations on values of one type.
pub trait Arithmetic {
    /// A number of this arithmetic.
    type Value: Copy;

    /// Converts a constant of a program.
    fn constant(&self, value: f32) -> Self::Value;

    /// Applies an operation, ignoring arguments beyond its arity.
    fn apply(&self, op: Op, arguments: [Self::Value; MAX_ARITY]) -> Self::Value;

    /// Evaluates the program's outputs at one sample.
    ///
    /// # Panics
    /// If `inputs` does not hold one value per input column.
    fn evaluate(&self, program: &Program, inputs: &[Self::Value]) -> Vec<Self::Value> {
        self.evaluate_with(program, inputs, |index| self.constant(program.consts[index]))
    }

    /// As [`Arithmetic::evaluate`], with other values for the program's constants, by index.
    ///
    /// # Panics
    /// As [`Arithmetic::evaluate`].
    fn evaluate_with(
        &self,
        program: &Program,
        inputs: &[Self::Value],
        constant: impl Fn(usize) -> Self::Value,
    ) -> Vec<Self::Value> {
        assert_eq!(inputs.len(), program.inputs, "one value for each input");
        let mut results = Vec::with_capacity(program.instrs.len());
        let value = |arg: Arg, results: &[Self::Value]| match arg {
            Arg::Input(i) => inputs[usize::from(i)],
            Arg::Const(i) => constant(usize::from(i)),
            Arg::Result(i) => results[usize::from(i)],
        };
        for instr in &program.instrs {
            let mut arguments = [value(instr.args()[0], &results); MAX_ARITY];
            for (to, &arg) in arguments.iter_mut().zip(instr.args()) {
                *to = value(arg, &results);
            }
            results.push(self.apply(instr.op(), arguments));
        }
        program.outputs.iter().map(|&arg| value(arg, &results)).collect()
    }
}
