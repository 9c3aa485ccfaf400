//! Errors of a program on samples, summed chunk by chunk.

use super::isa::by_isa;
use super::kernels::{CHUNK_BLOCKS, Chunk};
use super::{BLOCK, Evaluator, Samples, Tape, run};
use crate::num::Lanes;

/// Errors against the samples' targets, by output.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ErrorSums {
    /// `Σ w (f − y)²`, of each error only the part beyond the dead zone; summed in `f32` within a
    /// lane of a chunk, in `f64` beyond. Not finite if any value of the output is not.
    pub sum_of_squares: Vec<f64>,
    /// `max |f − y|`, unweighted; NaN if any value of the output is.
    pub max_error: Vec<f32>,
    /// True if samples are missing, since the total exceeded the bound or became NaN before them.
    pub abandoned: bool,
}

impl ErrorSums {
    /// Returns the sum of squares over all outputs.
    pub fn total(&self) -> f64 {
        self.sum_of_squares.iter().sum()
    }
}

impl Evaluator {
    /// Returns the errors of a program's outputs against the samples' targets, in order. Stops
    /// after the chunk in which the total exceeds `bound` or becomes NaN.
    ///
    /// # Panics
    /// If the samples and the program differ in the number of inputs or outputs.
    pub fn loss(&mut self, tape: &Tape, samples: &Samples, bound: f64) -> ErrorSums {
        let mut loss = ErrorSums::default();
        self.loss_into(tape, samples, bound, &mut loss);
        loss
    }

    /// As [`Evaluator::loss`], but without an allocation.
    pub fn loss_into(&mut self, tape: &Tape, samples: &Samples, bound: f64, loss: &mut ErrorSums) {
        assert_eq!(tape.outputs.len(), samples.outputs(), "a target for each output");
        self.reserve(tape);
        loss.sum_of_squares.clear();
        loss.sum_of_squares.resize(tape.outputs.len(), 0.0);
        loss.max_error.clear();
        loss.max_error.resize(tape.outputs.len(), 0.0);
        loss.abandoned = false;
        for first in (0..samples.blocks()).step_by(CHUNK_BLOCKS) {
            let chunk = Chunk::new(tape, samples, &mut self.slots, first);
            run(self.isa, &chunk);
            accumulate(self.isa, &chunk, loss);
            let total = loss.total();
            if total > bound || total.is_nan() {
                loss.abandoned = first + CHUNK_BLOCKS < samples.blocks();
                return;
            }
        }
    }
}

by_isa! {
    /// Adds the errors of a chunk whose tape has run.
    fn accumulate(chunk: &Chunk, loss: &mut ErrorSums) -> () = accumulate_in
}

/// # Safety
/// The processor has `L`, whose width is [`BLOCK`].
#[inline(always)]
unsafe fn accumulate_in<L: Lanes>(chunk: &Chunk, loss: &mut ErrorSums) {
    for (o, &output) in chunk.tape.outputs.iter().enumerate() {
        let weights = chunk.rows_of(chunk.samples.weight(o));
        let values = chunk.source(output);
        let targets = chunk.rows_of(chunk.samples.target(o));
        let dead_zone = chunk.samples.dead_zone(o).map(|dead_zone| chunk.rows_of(dead_zone));
        // SAFETY: promised by the caller; block `i` lies within the chunk.
        unsafe {
            let mut squares = L::broadcast(0.0);
            let mut largest = L::broadcast(0.0);
            for i in 0..chunk.blocks {
                let difference = values.block::<L>(i) - targets.block::<L>(i);
                largest = largest.maximum(difference.abs());
                let counted = match dead_zone {
                    Some(dead_zone) => beyond(difference, dead_zone.block::<L>(i)),
                    None => difference,
                };
                let weighted = weights.block::<L>(i) * counted;
                squares = weighted.fma(counted, squares);
            }
            loss.sum_of_squares[o] += sum(squares);
            loss.max_error[o] = Lanes::maximum(loss.max_error[o], max(largest));
        }
    }
}

/// Returns the part of an error beyond the dead zone.
///
/// # Safety
/// The processor has `L`.
#[inline(always)]
pub(super) unsafe fn beyond<L: Lanes>(error: L, dead_zone: L) -> L {
    // SAFETY: promised by the caller.
    unsafe { error - error.minimum(dead_zone).maximum(L::broadcast(0.0) - dead_zone) }
}

/// Returns the lanes as an array.
///
/// # Safety
/// `L`'s width is [`BLOCK`].
#[inline(always)]
unsafe fn lanes<L: Lanes>(register: L) -> [f32; BLOCK] {
    let mut lanes = [0.0; BLOCK];
    // SAFETY: promised by the caller.
    unsafe { register.store(lanes.as_mut_ptr()) };
    lanes
}

/// Returns the sum of the lanes in `f64`, by a tree of halves, the same for every register: its
/// additions wait less for each other than a chain's.
///
/// # Safety
/// `L`'s width is [`BLOCK`].
#[inline(always)]
pub(super) unsafe fn sum<L: Lanes>(register: L) -> f64 {
    // SAFETY: promised by the caller.
    let lanes = unsafe { lanes(register) };
    let mut halves = [0.0f64; BLOCK / 2];
    for i in 0..BLOCK / 2 {
        halves[i] = f64::from(lanes[i]) + f64::from(lanes[i + BLOCK / 2]);
    }
    let quarters = [
        halves[0] + halves[4],
        halves[1] + halves[5],
        halves[2] + halves[6],
        halves[3] + halves[7],
    ];
    (quarters[0] + quarters[2]) + (quarters[1] + quarters[3])
}

/// Returns the largest lane; NaN if any lane is NaN.
///
/// # Safety
/// `L`'s width is [`BLOCK`].
#[inline(always)]
unsafe fn max<L: Lanes>(register: L) -> f32 {
    // SAFETY: promised by the caller.
    unsafe { lanes(register) }.into_iter().fold(0.0, Lanes::maximum)
}
