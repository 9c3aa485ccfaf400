//! A program prepared for the kernels: effective instructions whose results are in slots, each
//! reused after its last read.

use super::BLOCK;
use super::samples::Block;
use crate::op::{MAX_ARITY, Op};
use crate::program::{Arg, Program, use_counts};

/// A kind of memory that kernels read or write.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub(super) enum Area {
    /// The samples' input columns.
    Columns,
    /// The tape's constants, a block per constant.
    Consts,
    /// The results that only other steps read.
    Slots,
    /// The results that are outputs: slots as well, but the caller may keep them.
    Outputs,
}

/// A place that a kernel reads or writes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Operand {
    pub area: Area,
    pub index: u16,
}

#[derive(Clone, Copy, Debug)]
pub(super) struct Step {
    pub op: Op,
    pub to: Operand,
    /// The arguments' places; beyond the arity, the first one's again.
    pub from: [Operand; MAX_ARITY],
}

/// A program prepared for the kernels.
#[derive(Clone, Debug, Default)]
pub struct Tape {
    pub(super) inputs: usize,
    pub(super) steps: Vec<Step>,
    /// The constants, each in all lanes of a block.
    pub(super) consts: Vec<Block>,
    pub(super) outputs: Vec<Operand>,
    pub(super) slots: usize,
    remaining_reads: Vec<u32>,
    place_of: Vec<Operand>,
    vacant: Vec<u16>,
}

impl Tape {
    /// Prepares a program.
    pub fn new(program: &Program) -> Tape {
        let mut tape = Tape::default();
        tape.prepare(program);
        tape
    }

    /// Prepares another program in place of this one, reusing the allocations.
    pub fn prepare(&mut self, program: &Program) {
        self.inputs = program.inputs;
        self.steps.clear();
        self.slots = 0;
        self.vacant.clear();
        self.outputs.clear();
        self.place_of.clear();
        self.place_of.resize(program.instrs.len(), Operand { area: Area::Slots, index: 0 });
        for (o, &output) in program.outputs.iter().enumerate() {
            if let Arg::Result(i) = output {
                self.place_of[usize::from(i)] = Operand { area: Area::Outputs, index: o as u16 };
            }
        }
        use_counts(program, &mut self.remaining_reads);
        self.fill_constants(&program.consts);
        for (i, instr) in program.instrs.iter().enumerate() {
            if self.remaining_reads[i] == 0 {
                continue;
            }
            let mut from = [self.operand(instr.args()[0]); MAX_ARITY];
            for (to, &arg) in from.iter_mut().zip(instr.args()) {
                *to = self.operand(arg);
            }
            for &arg in instr.args() {
                self.release(arg);
            }
            if self.place_of[i].area == Area::Slots {
                let slot = self.vacant.pop().unwrap_or_else(|| {
                    self.slots += 1;
                    (self.slots - 1) as u16
                });
                self.place_of[i].index = slot;
            }
            self.steps.push(Step { op: instr.op(), to: self.place_of[i], from });
        }
        for &output in &program.outputs {
            let operand = self.operand(output);
            self.outputs.push(operand);
        }
    }

    /// Replaces the constants of the prepared program.
    ///
    /// # Panics
    /// If there are not as many as before.
    pub fn set_constants(&mut self, consts: &[f32]) {
        assert_eq!(consts.len(), self.consts.len(), "one value for each constant");
        self.fill_constants(consts);
    }

    fn fill_constants(&mut self, consts: &[f32]) {
        self.consts.clear();
        self.consts.extend(consts.iter().map(|&c| Block([c; BLOCK])));
    }

    fn operand(&self, arg: Arg) -> Operand {
        match arg {
            Arg::Input(index) => Operand { area: Area::Columns, index },
            Arg::Const(index) => Operand { area: Area::Consts, index },
            Arg::Result(i) => self.place_of[usize::from(i)],
        }
    }

    /// Counts one read of a result and frees its slot after the last. An output counts as a read
    /// that never comes, so its slot stays.
    fn release(&mut self, arg: Arg) {
        if let Arg::Result(i) = arg {
            let reads = &mut self.remaining_reads[usize::from(i)];
            *reads -= 1;
            if *reads == 0 {
                self.vacant.push(self.place_of[usize::from(i)].index);
            }
        }
    }
}
