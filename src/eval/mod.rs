//! Evaluation of programs on many samples.
//!
//! A [`Tape`] is a program prepared for the kernels, [`Samples`] a table laid out for them.
//! An [`Evaluator`] owns the scratch memory and runs tapes on samples, chunk by chunk, in the
//! widest registers that the processor has. The bits are the same at every width, and those of
//! [`Program::evaluate`](crate::program::Program::evaluate). No operation is "protected": values
//! that are not finite are reported as such.
//!
//! An [`Arithmetic`] evaluates programs sample by sample in other numbers: [`Double`], [`Half`],
//! and [`Bounds`], intervals on boxes of inputs.
//!
//! ```
//! use lgp::dataset::Split;
//! use lgp::eval::{Evaluator, Samples, Tape};
//! use lgp::program::{Names, parse};
//!
//! let names = Names::new(["x"], ["y"]);
//! let tape = Tape::new(&parse("y = 2*x", &names)?);
//! let split = Split { columns: vec![vec![1.0, 2.0], vec![2.0, 5.0]], ..Split::default() };
//! let samples = Samples::new(&split, 1);
//! let loss = Evaluator::default().loss(&tape, &samples, f64::INFINITY);
//! assert_eq!(loss.sum_of_squares, [1.0]);
//! # Ok::<(), lgp::program::ParseError>(())
//! ```

mod arithmetic;
mod bounds;
mod double;
mod gauss_newton;
mod half;
mod isa;
mod kernels;
mod loss;
mod samples;
mod score;
mod tape;
mod values;

pub use self::half::Half;
pub use arithmetic::Arithmetic;
pub use bounds::Bounds;
pub use double::Double;
pub use gauss_newton::{Jacobian, NormalEquations};
pub use isa::Isa;
pub use loss::ErrorSums;
pub use samples::Samples;
pub use score::{OutputError, Score, relative_floor};
pub use tape::Tape;
pub use values::Values;

use crate::num::Lanes;
use isa::by_isa;
use kernels::{CHUNK_BLOCKS, Chunk};
use samples::Block;

/// The number of lanes that kernels handle at once, whatever the register. Reductions keep as many
/// partial sums, so that they, too, have the same bits at every width.
pub const BLOCK: usize = 16;

/// The number of samples in a chunk: a program's slots and columns of this length fit the
/// first-level cache, and the overhead of a step is small beside them (measured in `results/eval`).
pub const CHUNK: usize = 1024;

/// An interpreter of tapes, with the scratch memory that they need.
#[derive(Clone, Debug)]
pub struct Evaluator {
    isa: Isa,
    slots: Vec<Block>,
}

impl Default for Evaluator {
    fn default() -> Evaluator {
        Evaluator::new(Isa::best())
    }
}

impl Evaluator {
    /// Makes an evaluator that uses an instruction set.
    pub fn new(isa: Isa) -> Evaluator {
        Evaluator { isa, slots: Vec::new() }
    }

    /// Returns the values of each output, a vector of `samples.rows()` per output.
    ///
    /// # Panics
    /// If the samples and the program differ in the number of inputs.
    pub fn outputs(&mut self, tape: &Tape, samples: &Samples) -> Vec<Vec<f32>> {
        let mut values = Values::default();
        self.outputs_into(tape, samples, &mut values);
        (0..tape.outputs.len()).map(|o| values.column(o).to_vec()).collect()
    }

    /// As [`Evaluator::outputs`], but without an allocation once `values` is large enough.
    pub fn outputs_into(&mut self, tape: &Tape, samples: &Samples, values: &mut Values) {
        self.reserve(tape);
        values.lay_out(samples, tape.outputs.len());
        for first in (0..samples.blocks()).step_by(CHUNK_BLOCKS) {
            let columns = &mut values.blocks;
            let chunk = Chunk::into_columns(tape, samples, &mut self.slots, columns, first);
            run(self.isa, &chunk);
            copy_outputs(self.isa, &chunk);
        }
    }

    fn reserve(&mut self, tape: &Tape) {
        let blocks = (tape.slots + tape.outputs.len()) * CHUNK_BLOCKS;
        if self.slots.len() < blocks {
            self.slots.resize(blocks, Block([0.0; BLOCK]));
        }
    }
}

by_isa! {
    /// Runs every step of a chunk's tape.
    fn run(chunk: &Chunk) -> () = run_in
}

/// # Safety
/// The processor has `L`, whose width is [`BLOCK`].
#[inline(always)]
unsafe fn run_in<L: Lanes>(chunk: &Chunk) {
    // SAFETY: promised by the caller.
    unsafe { chunk.run::<L>() }
}

by_isa! {
    /// Copies the outputs that no step writes to their places: columns, constants, and results
    /// that are an output twice.
    fn copy_outputs(chunk: &Chunk) -> () = copy_outputs_in
}

/// # Safety
/// The processor has `L`, whose width is [`BLOCK`].
#[inline(always)]
unsafe fn copy_outputs_in<L: Lanes>(chunk: &Chunk) {
    // SAFETY: promised by the caller.
    unsafe { chunk.copy_outputs::<L>() }
}
