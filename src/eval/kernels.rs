//! The interpreter's inner loops: one operation over a chunk of samples at a time (Pesce &
//! Iwanicki 2015, §5.2), generic over the register.

use super::samples::{Block, Samples};
use super::tape::{Area, Operand, Step, Tape};
use super::{BLOCK, CHUNK};
use crate::num::{Lanes, math};
use crate::op::{Op, operations};
use std::marker::PhantomData;

/// The number of blocks in a chunk.
pub(super) const CHUNK_BLOCKS: usize = CHUNK / BLOCK;

/// The place of a value in a chunk: consecutive blocks, or one block read again and again.
#[derive(Clone, Copy)]
pub(super) struct Source {
    at: *const f32,
    /// The stride between blocks, in values: [`BLOCK`], or 0 for a constant.
    step: usize,
}

impl Source {
    /// Reads block `i`.
    ///
    /// # Safety
    /// `i` lies within the chunk that the source was resolved for, and the processor has `L`.
    #[inline(always)]
    pub(super) unsafe fn block<L: Lanes>(self, i: usize) -> L {
        // SAFETY: promised by the caller.
        unsafe { L::load(self.at.add(i * self.step)) }
    }
}

/// The memory of one [`Area`] in a chunk.
#[derive(Clone, Copy)]
struct Layout {
    first: *mut Block,
    /// The stride between columns, constants or slots, in blocks.
    stride: usize,
    /// As in [`Source`].
    step: usize,
}

/// The values of one chunk of samples: columns and constants in place, results in slots.
pub(super) struct Chunk<'a> {
    pub(super) tape: &'a Tape,
    pub(super) samples: &'a Samples,
    /// The areas' memory, indexed by [`Area`].
    places: [Layout; 4],
    /// The slots and outputs belong to this chunk alone; a kernel may read and write the same one.
    _slots: PhantomData<&'a mut [Block]>,
    first_block: usize,
    /// At most [`CHUNK_BLOCKS`].
    pub(super) blocks: usize,
}

impl<'a> Chunk<'a> {
    /// Makes a chunk whose outputs follow its slots.
    ///
    /// # Panics
    /// If the samples lack a column that the tape reads, or `slots` is too short for the tape.
    pub(super) fn new(
        tape: &'a Tape,
        samples: &'a Samples,
        slots: &'a mut [Block],
        first_block: usize,
    ) -> Chunk<'a> {
        let (slots, outputs) = slots.split_at_mut(tape.slots * CHUNK_BLOCKS);
        assert!(outputs.len() >= tape.outputs.len() * CHUNK_BLOCKS, "a slot for every output");
        let outputs = Layout { first: outputs.as_mut_ptr(), stride: CHUNK_BLOCKS, step: BLOCK };
        Chunk::with_outputs(tape, samples, slots, outputs, first_block)
    }

    /// Makes a chunk whose outputs are written to their rows of whole columns.
    ///
    /// # Panics
    /// As [`Chunk::new`], or if `columns` is too short.
    pub(super) fn into_columns(
        tape: &'a Tape,
        samples: &'a Samples,
        slots: &'a mut [Block],
        columns: &'a mut [Block],
        first_block: usize,
    ) -> Chunk<'a> {
        let stride = samples.blocks();
        assert!(columns.len() >= tape.outputs.len() * stride, "a column for every output");
        let first = columns[first_block..].as_mut_ptr();
        let outputs = Layout { first, stride, step: BLOCK };
        Chunk::with_outputs(tape, samples, slots, outputs, first_block)
    }

    fn with_outputs(
        tape: &'a Tape,
        samples: &'a Samples,
        slots: &'a mut [Block],
        outputs: Layout,
        first_block: usize,
    ) -> Chunk<'a> {
        assert_eq!(tape.inputs, samples.inputs(), "the samples have the program's inputs");
        assert!(slots.len() >= tape.slots * CHUNK_BLOCKS, "slots for every live result");
        let blocks = CHUNK_BLOCKS.min(samples.blocks() - first_block);
        let columns = &samples.columns()[first_block..];
        let columns =
            Layout { first: columns.as_ptr().cast_mut(), stride: samples.blocks(), step: BLOCK };
        let consts = Layout { first: tape.consts.as_ptr().cast_mut(), stride: 1, step: 0 };
        let slots = Layout { first: slots.as_mut_ptr(), stride: CHUNK_BLOCKS, step: BLOCK };
        let places = [columns, consts, slots, outputs];
        Chunk { tape, samples, places, _slots: PhantomData, first_block, blocks }
    }

    /// Returns the place of a tape's operand in this chunk.
    #[inline(always)]
    pub(super) fn source(&self, operand: Operand) -> Source {
        let place = self.places[operand.area as usize];
        Source { at: self.address(operand), step: place.step }
    }

    /// Returns the place of this chunk's rows in a whole column.
    #[inline(always)]
    pub(super) fn rows_of(&self, column: &[Block]) -> Source {
        Source { at: column[self.first_block..].as_ptr().cast(), step: BLOCK }
    }

    #[inline(always)]
    fn address(&self, operand: Operand) -> *mut f32 {
        let place = self.places[operand.area as usize];
        // SAFETY: the operand is the tape's own, and `with_outputs` and its callers checked that
        // each area is as large as the tape needs.
        unsafe { place.first.add(usize::from(operand.index) * place.stride).cast() }
    }

    /// Runs every step of the tape on this chunk.
    ///
    /// # Safety
    /// The processor has `L`, whose width is [`BLOCK`].
    #[inline(always)]
    pub(super) unsafe fn run<L: Lanes>(&self) {
        for step in &self.tape.steps {
            // SAFETY: the step is one of the tape's.
            unsafe { self.step::<L>(step) }
        }
    }

    /// Copies the outputs that no step writes: columns, constants, and a result's second place.
    ///
    /// # Safety
    /// As [`Chunk::run`].
    #[inline(always)]
    pub(super) unsafe fn copy_outputs<L: Lanes>(&self) {
        for (o, &output) in self.tape.outputs.iter().enumerate() {
            let own = Operand { area: Area::Outputs, index: o as u16 };
            if output == own {
                continue;
            }
            let (from, to) = (self.source(output), self.address(own));
            for i in 0..self.blocks {
                // SAFETY: every operand holds `blocks` blocks.
                unsafe { from.block::<L>(i).store(to.add(i * BLOCK)) };
            }
        }
    }
}

macro_rules! define_kernels {
    ($($(#[$doc:meta])* $op:ident $name:literal ($($arg:ident),*) [$($property:ident)*] $family:ident $accuracy:tt = $meaning:expr;)*) => {
        impl Chunk<'_> {
            /// # Safety
            /// The processor has `L`, whose width is [`BLOCK`], and the step is one of the tape's.
            #[inline(always)]
            unsafe fn step<L: Lanes>(&self, step: &Step) {
                let to = self.address(step.to);
                match step.op {
                    $(Op::$op => {
                        let mut from = step.from.iter();
                        $(let $arg = self.source(*from.next().expect("four operands"));)*
                        for i in 0..self.blocks {
                            // SAFETY: every operand holds `blocks` blocks.
                            unsafe {
                                $(let $arg = $arg.block::<L>(i);)*
                                $meaning.store(to.add(i * BLOCK));
                            }
                        }
                    })*
                }
            }
        }
    };
}
operations!(define_kernels);
