//! The shape of drafts that fill an outer form in: what each output may read.

use super::{Arg, Draft};

/// The number of inputs, and what each output may read.
#[derive(Clone, Debug, PartialEq)]
pub struct Shape {
    /// The number of inputs.
    pub inputs: usize,
    reads: Vec<Reads>,
}

/// What an output may read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reads {
    /// Every input.
    All,
    /// The inputs of this set, a bit each.
    Only(u64),
    /// None: it is a constant, which starts at this value if one is known.
    Constant(Option<f32>),
}

impl Shape {
    /// The most inputs of a shape in which some outputs may read only some of them.
    pub const MAX_INPUTS: usize = 64;

    /// Returns the shape in which every output may read every input.
    pub fn open(inputs: usize, outputs: usize) -> Shape {
        Shape { inputs, reads: vec![Reads::All; outputs] }
    }

    /// Returns a shape of outputs that may read this; the constants are last.
    ///
    /// # Panics
    /// If constants are not last, or there are more than [`Shape::MAX_INPUTS`] inputs.
    pub fn new(inputs: usize, reads: Vec<Reads>) -> Shape {
        assert!(inputs <= Shape::MAX_INPUTS, "a bit for each input");
        let is_constant = |reads: &Reads| matches!(reads, Reads::Constant(_));
        assert!(reads.is_sorted_by_key(is_constant), "constants are last");
        Shape { inputs, reads }
    }

    /// Returns the number of outputs.
    pub fn outputs(&self) -> usize {
        self.reads.len()
    }

    /// Returns what each output may read.
    pub fn reads(&self) -> &[Reads] {
        &self.reads
    }

    /// Returns the number of outputs that are not constants, which come first.
    pub fn formulas(&self) -> usize {
        self.reads.iter().take_while(|reads| !matches!(reads, Reads::Constant(_))).count()
    }

    /// Returns true if every output may read every input.
    pub fn is_open(&self) -> bool {
        self.reads.iter().all(|reads| *reads == Reads::All)
    }

    /// Returns true if an output may read an input.
    pub fn may_read(&self, output: usize, input: usize) -> bool {
        match self.reads[output] {
            Reads::All => true,
            Reads::Only(inputs) => inputs >> input & 1 == 1,
            Reads::Constant(_) => false,
        }
    }

    /// Returns the first output of a draft that reads what it must not.
    pub fn violation(&self, draft: &Draft) -> Option<usize> {
        if self.is_open() {
            return None;
        }
        let read = inputs_read(draft);
        let of = |arg: Arg| match arg {
            Arg::Input(i) => 1 << i,
            Arg::Result(i) => read[usize::from(i)],
            Arg::Const(_) => 0u64,
        };
        let violates = |(reads, &output): (&Reads, &Arg)| match reads {
            Reads::All => false,
            Reads::Only(inputs) => of(output) & !inputs != 0,
            Reads::Constant(_) => !matches!(output, Arg::Const(_)),
        };
        self.reads.iter().zip(&draft.outputs).position(violates)
    }
}

/// Returns the inputs that each instruction depends on, a bit each.
fn inputs_read(draft: &Draft) -> Vec<u64> {
    let mut read: Vec<u64> = Vec::with_capacity(draft.instrs.len());
    for instr in &draft.instrs {
        let of = |arg: &Arg| match *arg {
            Arg::Input(i) => 1 << i,
            Arg::Result(i) => read[usize::from(i)],
            Arg::Const(_) => 0,
        };
        read.push(instr.args().iter().map(of).fold(0, |all, one| all | one));
    }
    read
}
