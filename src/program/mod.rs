//! Programs: short strings of instructions, read as a directed acyclic graph.
//!
//! An instruction ([`Instr`]) is an operation and its arguments, each an input column, a
//! constant, or the result of an **earlier** instruction (Pesce & Iwanicki 2015, §5.2).
//! A [`Draft`] is any such string; a [`Program`] is a draft that was verified, and can therefore be
//! evaluated, costed and emitted without failing.
//!
//! ```
//! use lgp::program::{Names, parse, print};
//!
//! let names = Names::new(["x"], ["y"]);
//! let program = parse("y = 1 + x*x", &names)?;
//! assert_eq!(program.evaluate(&[3.0]), [10.0]);
//! assert_eq!(print(&program, &names), "y = 1 + x^2");
//! # Ok::<(), lgp::program::ParseError>(())
//! ```

mod effective;
mod exact;
mod hash;
mod outer;
mod rewrite;
mod shape;
pub(crate) mod spelling;
mod template;
mod text;

pub use effective::{effective, effective_into, use_counts};
pub use exact::ExactProgram;
pub use hash::{Constants, structural_hash};
pub use outer::Outer;
pub use shape::{Reads, Shape};
pub use template::{Hole, Template};
pub use text::{
    ALWAYS_ASKED, Claim, FreeConstant, MAX_FORMULA, Names, ParseError, Parsed, Scope,
    format_constant, parse, parse_open, parse_template, print, print_expression, shortest,
};
pub(crate) use text::{parse_expression, place, plain, pointed};

use crate::op::{MAX_ARITY, Op};
use serde::{Deserialize, Serialize};
use std::ops::Deref;

/// The source of an argument or an output.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub enum Arg {
    /// The input column of this index.
    Input(u16),
    /// The result of the instruction of this index.
    Result(u16),
    /// The entry of the constant table of this index.
    Const(u16),
}

/// An operation and its arguments.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct Instr {
    op: Op,
    args: [Arg; MAX_ARITY],
}

impl Instr {
    /// Makes an instruction of `op` on the first `op.arity()` of `args`.
    ///
    /// # Panics
    /// If `args` has fewer entries than the operation takes.
    #[inline]
    pub fn new(op: Op, args: &[Arg]) -> Instr {
        let mut all = [Arg::Input(0); MAX_ARITY];
        all[..op.arity()].copy_from_slice(&args[..op.arity()]);
        Instr { op, args: all }
    }

    /// Returns the operation.
    #[inline]
    pub fn op(&self) -> Op {
        self.op
    }

    /// Returns the arguments, as many as the operation takes.
    #[inline]
    pub fn args(&self) -> &[Arg] {
        &self.args[..self.op.arity()]
    }

    /// Returns the arguments for changing; [`Program::verify`] checks what they refer to.
    #[inline]
    pub fn args_mut(&mut self) -> &mut [Arg] {
        &mut self.args[..self.op.arity()]
    }
}

/// A program that is not yet verified.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
pub struct Draft {
    /// The number of input columns.
    pub inputs: usize,
    /// The instructions; each may read the results of earlier ones.
    pub instrs: Vec<Instr>,
    /// The constant table.
    pub consts: Vec<f32>,
    /// One entry per output.
    pub outputs: Vec<Arg>,
}

/// The reason why a draft is not a program.
#[allow(missing_docs, reason = "each message names its fields")]
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Invalid {
    #[error("{place} reads input {index}, but there are only {inputs} inputs")]
    NoSuchInput { place: Place, index: u16, inputs: usize },
    #[error("{place} reads constant {index}, but the table holds {constants}")]
    NoSuchConstant { place: Place, index: u16, constants: usize },
    #[error("{place} reads the result of instruction {index}, which does not come before it")]
    NotEarlier { place: Place, index: u16 },
    #[error("constant {index} is {value}; a constant must be finite")]
    NotFinite { index: usize, value: f32 },
    #[error("a program needs at least one output")]
    NoOutput,
    #[error("{count} {what}; a program has at most {}", u16::MAX)]
    TooMany { count: usize, what: &'static str },
}

/// The place of an argument in a draft.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// In the instruction of this index.
    Instruction(usize),
    /// The output of this index.
    Output(usize),
}

impl std::fmt::Display for Place {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Place::Instruction(i) => write!(f, "instruction {i}"),
            Place::Output(i) => write!(f, "output {i}"),
        }
    }
}

impl Draft {
    /// Adds an instruction and returns its result.
    pub fn push(&mut self, op: Op, args: &[Arg]) -> Arg {
        self.instrs.push(Instr::new(op, args));
        Arg::Result((self.instrs.len() - 1) as u16)
    }

    /// Adds a constant and returns it.
    pub fn constant(&mut self, value: f32) -> Arg {
        self.consts.push(value);
        Arg::Const((self.consts.len() - 1) as u16)
    }

    /// Copies `other`, keeping the allocations.
    pub fn copy_from(&mut self, other: &Draft) {
        self.inputs = other.inputs;
        self.instrs.clone_from(&other.instrs);
        self.consts.clone_from(&other.consts);
        self.outputs.clone_from(&other.outputs);
    }

    /// Empties the draft, keeping the allocations, and sets the number of inputs.
    pub fn clear(&mut self, inputs: usize) {
        self.inputs = inputs;
        self.instrs.clear();
        self.consts.clear();
        self.outputs.clear();
    }

    fn check_arg(&self, arg: Arg, place: Place, earlier: usize) -> Result<(), Invalid> {
        match arg {
            Arg::Input(index) if usize::from(index) >= self.inputs => {
                Err(Invalid::NoSuchInput { place, index, inputs: self.inputs })
            }
            Arg::Const(index) if usize::from(index) >= self.consts.len() => {
                Err(Invalid::NoSuchConstant { place, index, constants: self.consts.len() })
            }
            Arg::Result(index) if usize::from(index) >= earlier => {
                Err(Invalid::NotEarlier { place, index })
            }
            _ => Ok(()),
        }
    }

    /// Checks that the draft is a program.
    ///
    /// # Errors
    /// [`Invalid`]: the first reason why it is not.
    pub fn check(&self) -> Result<(), Invalid> {
        let counts = [
            (self.inputs, "inputs"),
            (self.consts.len(), "constants"),
            (self.instrs.len(), "instructions"),
        ];
        if let Some((count, what)) = counts.into_iter().find(|c| c.0 > usize::from(u16::MAX)) {
            return Err(Invalid::TooMany { count, what });
        }
        if self.outputs.is_empty() {
            return Err(Invalid::NoOutput);
        }
        for (i, instr) in self.instrs.iter().enumerate() {
            for &arg in instr.args() {
                self.check_arg(arg, Place::Instruction(i), i)?;
            }
        }
        for (i, &arg) in self.outputs.iter().enumerate() {
            self.check_arg(arg, Place::Output(i), self.instrs.len())?;
        }
        match self.consts.iter().position(|c| !c.is_finite()) {
            Some(index) => Err(Invalid::NotFinite { index, value: self.consts[index] }),
            None => Ok(()),
        }
    }
}

/// A verified draft: every argument refers to an input, a constant or an earlier result that
/// exists, every constant is finite, and there is at least one output.
#[derive(Clone, Debug, PartialEq)]
pub struct Program(Draft);

impl Program {
    /// Checks a draft and makes it a program.
    ///
    /// # Errors
    /// As [`Draft::check`].
    pub fn verify(draft: Draft) -> Result<Program, Invalid> {
        draft.check()?;
        Ok(Program(draft))
    }

    /// Returns the draft, for changing and verifying again.
    pub fn into_draft(self) -> Draft {
        self.0
    }

    /// Replaces this program by a copy of `draft`, reusing the allocations.
    ///
    /// # Errors
    /// As [`Draft::check`]; the program is then unchanged.
    pub fn assign(&mut self, draft: &Draft) -> Result<(), Invalid> {
        draft.check()?;
        self.0.copy_from(draft);
        Ok(())
    }

    /// Evaluates the outputs at one sample, by the scalar reference semantics.
    ///
    /// # Panics
    /// If `inputs` has not one value for each input column.
    pub fn evaluate(&self, inputs: &[f32]) -> Vec<f32> {
        assert_eq!(inputs.len(), self.inputs, "one value for each input");
        let mut results = Vec::with_capacity(self.instrs.len());
        let value = |arg: Arg, results: &[f32]| match arg {
            Arg::Input(i) => inputs[usize::from(i)],
            Arg::Const(i) => self.consts[usize::from(i)],
            Arg::Result(i) => results[usize::from(i)],
        };
        for instr in &self.instrs {
            let mut args = [0.0; MAX_ARITY];
            for (to, &arg) in args.iter_mut().zip(instr.args()) {
                *to = value(arg, &results);
            }
            results.push(instr.op().apply(args));
        }
        self.outputs.iter().map(|&arg| value(arg, &results)).collect()
    }
}

impl Deref for Program {
    type Target = Draft;
    fn deref(&self) -> &Draft {
        &self.0
    }
}
