//! Makes drafts of drafts.

use super::{Arg, Draft, Instr, Invalid, Program};
use crate::op::Op;

impl Draft {
    /// Rebuilds the draft instruction by instruction. `make` is given the new draft so far, the old
    /// instruction's index, and the instruction with its new arguments; it adds what it likes and
    /// returns the value that replaces the result. Inputs and constants keep their indices.
    pub fn rewritten(&self, mut make: impl FnMut(&mut Draft, usize, Instr) -> Arg) -> Draft {
        let mut new = Draft {
            inputs: self.inputs,
            instrs: Vec::with_capacity(self.instrs.len()),
            consts: self.consts.clone(),
            outputs: Vec::with_capacity(self.outputs.len()),
        };
        let mut moved: Vec<Arg> = Vec::with_capacity(self.instrs.len());
        let now = |arg: Arg, moved: &[Arg]| match arg {
            Arg::Result(i) => moved[usize::from(i)],
            Arg::Input(_) | Arg::Const(_) => arg,
        };
        for (i, &instr) in self.instrs.iter().enumerate() {
            let mut instr = instr;
            instr.args_mut().iter_mut().for_each(|arg| *arg = now(*arg, &moved));
            moved.push(make(&mut new, i, instr));
        }
        new.outputs.extend(self.outputs.iter().map(|&output| now(output, &moved)));
        new
    }

    /// Appends another draft's instructions and constants, its inputs being values of this one;
    /// returns its outputs' values here.
    ///
    /// # Panics
    /// If `inputs` has fewer entries than `other` has inputs.
    pub fn append(&mut self, other: &Draft, inputs: &[Arg]) -> Vec<Arg> {
        let (first, constants) = (self.instrs.len() as u16, self.consts.len() as u16);
        self.consts.extend_from_slice(&other.consts);
        let moved = |arg: Arg| match arg {
            Arg::Input(i) => inputs[usize::from(i)],
            Arg::Const(i) => Arg::Const(i + constants),
            Arg::Result(i) => Arg::Result(i + first),
        };
        for &instr in &other.instrs {
            let mut instr = instr;
            instr.args_mut().iter_mut().for_each(|arg| *arg = moved(*arg));
            self.instrs.push(instr);
        }
        other.outputs.iter().map(|&output| moved(output)).collect()
    }

    /// Gives each read of a constant a constant of its own, so that each can be fitted apart.
    pub fn unshare_constants(&mut self) {
        let known = std::mem::take(&mut self.consts);
        let Draft { instrs, consts, outputs, .. } = self;
        for arg in instrs.iter_mut().flat_map(|instr| instr.args_mut()).chain(outputs) {
            if let Arg::Const(i) = arg {
                consts.push(known[usize::from(*i)]);
                *i = (consts.len() - 1) as u16;
            }
        }
    }

    /// Adds an instruction and returns its result.
    pub fn push_instr(&mut self, instr: Instr) -> Arg {
        self.push(instr.op(), instr.args())
    }

    /// Adds an instruction, a `mad` as a product and a sum, and returns the result.
    pub(crate) fn push_unfused(&mut self, instr: Instr) -> Arg {
        if instr.op() != Op::Mad {
            return self.push_instr(instr);
        }
        let product = self.push(Op::Mul, &instr.args()[..2]);
        self.push(Op::Add, &[product, instr.args()[2]])
    }
}

impl Program {
    /// Returns the program with each `mad` as a product and a sum, both rounded, for languages
    /// without one.
    pub fn unfused(&self) -> Program {
        self.or_longer(self.rewritten(|draft, _, instr| draft.push_unfused(instr)))
    }

    /// Returns the program that a rewriting made of this one, or this one if there are more
    /// instructions or constants than a program can hold; the rewriting must not fail otherwise.
    pub(crate) fn or_longer(&self, rewritten: Draft) -> Program {
        Program::verify(rewritten).unwrap_or_else(|invalid| {
            debug_assert!(matches!(invalid, Invalid::TooMany { .. }), "{invalid}");
            self.clone()
        })
    }
}
