//! The interpreter's inner loops: one operation over a chunk of samples at a time
//! (Pesce & Iwanicki 2015, §5.2), generic over the register.

use super::samples::{Block, Samples};
use super::tape::{Operand, Step, Tape};
use super::{BLOCK, CHUNK};
use crate::num::{Lanes, math};
use crate::op::{Op, operations};
use std::marker::PhantomData;

/// Blocks in a chunk.
pub(super) const CHUNK_BLOCKS: usize = CHUNK / BLOCK;

/// Where a value of a chunk is read: consecutive blocks, or one block again and again.
#[derive(Clone, Copy)]
pub(super) struct Source {
    at: *const f32,
    constant: bool,
}

impl Source {
    /// Reads block `i`.
    ///
    /// # Safety
    /// `i` lies within the chunk that the source was resolved for, and the processor has `L`.
    #[inline(always)]
    pub(super) unsafe fn block<L: Lanes>(self, i: usize) -> L {
        let offset = if self.constant { 0 } else { i * BLOCK };
        // SAFETY: promised by the caller.
        unsafe { L::load(self.at.add(offset)) }
    }
}

/// The values of one chunk of samples: columns and constants where they are, results in slots.
pub(super) struct Chunk<'a> {
    pub(super) tape: &'a Tape,
    pub(super) samples: &'a Samples,
    slots: *mut Block,
    /// The slots are this chunk's alone; kernels may read and write the same one.
    _slots: PhantomData<&'a mut [Block]>,
    first_block: usize,
    /// At most [`CHUNK_BLOCKS`].
    pub(super) blocks: usize,
}

impl<'a> Chunk<'a> {
    /// # Panics
    /// If the samples lack a column that the tape reads, or `slots` is too short for the tape.
    pub(super) fn new(
        tape: &'a Tape,
        samples: &'a Samples,
        slots: &'a mut [Block],
        first_block: usize,
    ) -> Chunk<'a> {
        assert_eq!(tape.inputs, samples.inputs(), "the samples have the program's inputs");
        assert!(slots.len() >= tape.slots * CHUNK_BLOCKS, "slots for every live result");
        let blocks = CHUNK_BLOCKS.min(samples.blocks() - first_block);
        let slots = slots.as_mut_ptr();
        Chunk { tape, samples, slots, _slots: PhantomData, first_block, blocks }
    }

    /// Where an operand of the tape is read in this chunk.
    #[inline(always)]
    pub(super) fn source(&self, operand: Operand) -> Source {
        match operand {
            Operand::Column(i) => self.rows_of(self.samples.column(usize::from(i))),
            Operand::Const(i) => {
                Source { at: self.tape.consts[usize::from(i)].0.as_ptr(), constant: true }
            }
            Operand::Slot(i) => Source { at: self.slot(i), constant: false },
        }
    }

    /// Where a whole column is read in this chunk.
    #[inline(always)]
    pub(super) fn rows_of(&self, column: &[Block]) -> Source {
        Source { at: column[self.first_block..].as_ptr().cast(), constant: false }
    }

    #[inline(always)]
    fn slot(&self, slot: u16) -> *mut f32 {
        debug_assert!(usize::from(slot) < self.tape.slots);
        // SAFETY: `new` checked that the slots hold CHUNK_BLOCKS blocks for each of the tape's.
        unsafe { self.slots.add(usize::from(slot) * CHUNK_BLOCKS).cast() }
    }

    /// Carries out every step of the tape on this chunk.
    ///
    /// # Safety
    /// The processor has `L`, whose width is [`BLOCK`].
    #[inline(always)]
    pub(super) unsafe fn run<L: Lanes>(&self) {
        for step in &self.tape.steps {
            // SAFETY: the tape's operands exist (`source` checks columns and constants, `slot`
            // slots), and each gives `self.blocks` blocks.
            unsafe { self.step::<L>(step) }
        }
    }
}

/// One loop for each choice of which of the arguments are constant, those being read once.
macro_rules! kernel {
    ($from:ident, $to:ident, $blocks:ident, ($a:ident) $meaning:expr) => {
        for i in 0..$blocks {
            let $a = $from[0].block::<L>(i);
            $meaning.store($to.add(i * BLOCK));
        }
    };
    ($from:ident, $to:ident, $blocks:ident, ($a:ident, $b:ident) $meaning:expr) => {
        match ($from[0].constant, $from[1].constant) {
            (false, true) => {
                let $b = L::load($from[1].at);
                for i in 0..$blocks {
                    let $a = L::load($from[0].at.add(i * BLOCK));
                    $meaning.store($to.add(i * BLOCK));
                }
            }
            (true, false) => {
                let $a = L::load($from[0].at);
                for i in 0..$blocks {
                    let $b = L::load($from[1].at.add(i * BLOCK));
                    $meaning.store($to.add(i * BLOCK));
                }
            }
            (false, false) => {
                for i in 0..$blocks {
                    let $a = L::load($from[0].at.add(i * BLOCK));
                    let $b = L::load($from[1].at.add(i * BLOCK));
                    $meaning.store($to.add(i * BLOCK));
                }
            }
            (true, true) => {
                let $a = L::load($from[0].at);
                let $b = L::load($from[1].at);
                let value = $meaning;
                for i in 0..$blocks {
                    value.store($to.add(i * BLOCK));
                }
            }
        }
    };
    ($from:ident, $to:ident, $blocks:ident, ($($arg:ident),*) $meaning:expr) => {
        for i in 0..$blocks {
            let mut from = $from.iter();
            $(let $arg = from.next().expect("four sources").block::<L>(i);)*
            $meaning.store($to.add(i * BLOCK));
        }
    };
}

macro_rules! define_kernels {
    ($($(#[$doc:meta])* $op:ident $name:literal ($($arg:ident),*) [$($property:ident)*] $hazard:ident = $meaning:expr;)*) => {
        impl Chunk<'_> {
            /// # Safety
            /// The processor has `L`, whose width is [`BLOCK`], and the step is one of the tape's.
            #[inline(always)]
            unsafe fn step<L: Lanes>(&self, step: &Step) {
                let [a, b, c, d] = step.from;
                let from = [self.source(a), self.source(b), self.source(c), self.source(d)];
                let to = self.slot(step.to);
                let blocks = self.blocks;
                // SAFETY: every source and the slot hold `blocks` blocks.
                unsafe {
                    match step.op {
                        $(Op::$op => kernel!(from, to, blocks, ($($arg),*) $meaning),)*
                    }
                }
            }
        }
    };
}
operations!(define_kernels);
