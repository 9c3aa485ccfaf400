//! The normal equations of a least-squares fit, accumulated chunk by chunk.

use super::isa::by_isa;
use super::kernels::{CHUNK_BLOCKS, Chunk, Source};
use super::loss::{beyond, sum};
use super::{Evaluator, Samples, Tape, run};
use crate::num::Lanes;

/// The layout of a tape's outputs: the first `outputs` are values, each further one the derivative
/// of a value by a parameter. Derivatives that are not listed are zero.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Jacobian {
    /// The number of the tape's outputs that are values.
    pub outputs: usize,
    /// The number of parameters: the program's constants.
    pub parameters: usize,
    /// For each value, pairs of a parameter and the tape's output that is the derivative by it.
    /// Empty lists may follow, kept for their allocations.
    pub entries: Vec<Vec<(u16, u16)>>,
}

/// `JᵀWJ`, `JᵀWr` and `rᵀWr` with `r = f − y`, over all values.
#[derive(Clone, Debug, Default)]
pub struct NormalEquations {
    /// `JᵀWJ`: row-major, only the lower triangle filled.
    pub matrix: Vec<f64>,
    /// `JᵀWr`: one entry per parameter.
    pub gradient: Vec<f64>,
    /// `rᵀWr`: over all outputs.
    pub sum_of_squares: f64,
}

impl NormalEquations {
    fn clear(&mut self, parameters: usize) {
        self.matrix.clear();
        self.matrix.resize(parameters * parameters, 0.0);
        self.gradient.clear();
        self.gradient.resize(parameters, 0.0);
        self.sum_of_squares = 0.0;
    }
}

impl Evaluator {
    /// Computes the normal equations of the tape's values against the samples' targets. Sums are
    /// `f32` within a lane of a chunk, `f64` beyond.
    ///
    /// # Panics
    /// If the samples' inputs or outputs differ in number from the tape's inputs or values.
    pub fn normal_equations(
        &mut self,
        tape: &Tape,
        jacobian: &Jacobian,
        samples: &Samples,
        equations: &mut NormalEquations,
    ) {
        assert_eq!(jacobian.outputs, samples.outputs(), "a target for each value");
        self.reserve(tape);
        equations.clear(jacobian.parameters);
        for first in (0..samples.blocks()).step_by(CHUNK_BLOCKS) {
            let chunk = Chunk::new(tape, samples, &mut self.slots, first);
            run(self.isa, &chunk);
            accumulate(self.isa, &chunk, jacobian, equations);
        }
    }
}

by_isa! {
    /// Adds the products of a chunk whose tape has run.
    fn accumulate(chunk: &Chunk, jacobian: &Jacobian, equations: &mut NormalEquations) -> () = accumulate_in
}

/// # Safety
/// The processor has `L`, whose width is the block's.
#[inline(always)]
unsafe fn accumulate_in<L: Lanes>(
    chunk: &Chunk,
    jacobian: &Jacobian,
    equations: &mut NormalEquations,
) {
    let output = |index: u16| chunk.source(chunk.tape.outputs[usize::from(index)]);
    for (o, entries) in jacobian.entries[..jacobian.outputs].iter().enumerate() {
        let weights = chunk.rows_of(chunk.samples.weight(o));
        let residual = Residual {
            values: output(o as u16),
            targets: chunk.rows_of(chunk.samples.target(o)),
            dead_zone: chunk.samples.dead_zone(o).map(|dead_zone| chunk.rows_of(dead_zone)),
        };
        // SAFETY: promised by the caller; every source holds the chunk's blocks.
        unsafe {
            equations.sum_of_squares += residual.squares::<L>(weights, chunk.blocks);
            for (place, &(row, derivative)) in entries.iter().enumerate() {
                let left = output(derivative);
                equations.gradient[usize::from(row)] +=
                    residual.product::<L>(weights, left, chunk.blocks);
                for pair in entries[..=place].chunks(4) {
                    let mut right = [left; 4];
                    for (to, &(_, derivative)) in right.iter_mut().zip(pair) {
                        *to = output(derivative);
                    }
                    let products = products::<L>(weights, left, right, chunk.blocks);
                    for (&(column, _), product) in pair.iter().zip(products) {
                        let (low, high) = (row.min(column), row.max(column));
                        let at = usize::from(high) * jacobian.parameters + usize::from(low);
                        equations.matrix[at] += product;
                    }
                }
            }
        }
    }
}

/// `f − y` of one value in a chunk, or the part beyond the dead zone. (The equations' matrix still
/// counts every sample: it belongs to the least squares towards the nearest values without an
/// error, whose solution is never worse.)
struct Residual {
    values: Source,
    targets: Source,
    dead_zone: Option<Source>,
}

impl Residual {
    /// # Safety
    /// As [`accumulate_in`]; the sources hold `blocks` blocks.
    #[inline(always)]
    unsafe fn block<L: Lanes>(&self, i: usize) -> L {
        // SAFETY: promised by the caller.
        unsafe {
            let error = self.values.block::<L>(i) - self.targets.block::<L>(i);
            match self.dead_zone {
                Some(dead_zone) => beyond(error, dead_zone.block::<L>(i)),
                None => error,
            }
        }
    }

    /// `Σ w r²`
    ///
    /// # Safety
    /// As [`accumulate_in`]; the sources hold `blocks` blocks.
    #[inline(always)]
    unsafe fn squares<L: Lanes>(&self, weights: Source, blocks: usize) -> f64 {
        // SAFETY: promised by the caller.
        unsafe {
            let mut total = L::broadcast(0.0);
            for i in 0..blocks {
                let r = self.block::<L>(i);
                total = (weights.block::<L>(i) * r).fma(r, total);
            }
            sum(total)
        }
    }

    /// `Σ w r d`
    ///
    /// # Safety
    /// As [`accumulate_in`]; the sources hold `blocks` blocks.
    #[inline(always)]
    unsafe fn product<L: Lanes>(&self, weights: Source, derivative: Source, blocks: usize) -> f64 {
        // SAFETY: promised by the caller.
        unsafe {
            let mut total = L::broadcast(0.0);
            for i in 0..blocks {
                let r = self.block::<L>(i);
                total = (weights.block::<L>(i) * r).fma(derivative.block::<L>(i), total);
            }
            sum(total)
        }
    }
}

/// Returns `Σ w d e` for one derivative `d` and four others `e`.
///
/// # Safety
/// As [`accumulate_in`]; the sources hold `blocks` blocks.
#[inline(always)]
unsafe fn products<L: Lanes>(
    weights: Source,
    left: Source,
    right: [Source; 4],
    blocks: usize,
) -> [f64; 4] {
    // SAFETY: promised by the caller.
    unsafe {
        let mut totals = [L::broadcast(0.0); 4];
        for i in 0..blocks {
            let weighted = weights.block::<L>(i) * left.block::<L>(i);
            for (total, right) in totals.iter_mut().zip(right) {
                *total = weighted.fma(right.block::<L>(i), *total);
            }
        }
        // Not `map`, whose closure would be compiled without the register's instructions.
        [sum(totals[0]), sum(totals[1]), sum(totals[2]), sum(totals[3])]
    }
}
