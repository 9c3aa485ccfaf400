//! A program's loss as a function of its parameters.

use super::minimax::scaled;
use super::{Fitter, Measure, Parameter};
use crate::eval::{ErrorSums, Evaluator, Samples, Tape, Values};
use crate::program::Program;
use rayon::prelude::*;

/// The loss as a function of the parameters' values.
pub(super) struct Objective<'a> {
    parameters: &'a [Parameter],
    measure: Measure,
    scratches: Vec<Scratch>,
    /// The number of values of outputs that were computed.
    pub sampled: u64,
}

/// What one thread evaluates with.
struct Scratch {
    evaluator: Evaluator,
    tape: Tape,
    constants: Vec<f32>,
    sums: ErrorSums,
    values: Values,
}

/// The number of samples from which on points are evaluated in parallel: fewer take no longer than
/// waking a thread. By hand, unmeasured.
const MANY_SAMPLES: usize = 1024;

impl<'a> Objective<'a> {
    /// Prepares a verified program, borrowing the fitter's evaluator.
    pub fn new(
        fitter: &mut Fitter,
        program: &Program,
        samples: &Samples,
        parameters: &'a [Parameter],
        measure: Measure,
    ) -> Objective<'a> {
        let tape = Tape::new(program);
        let threads = if samples.rows() < MANY_SAMPLES { 1 } else { rayon::current_num_threads() };
        let scratches = (0..threads).map(|thread| Scratch {
            evaluator: match thread {
                0 => std::mem::take(&mut fitter.evaluator),
                _ => fitter.evaluator.clone(),
            },
            tape: tape.clone(),
            constants: program.consts.clone(),
            sums: ErrorSums::default(),
            values: Values::default(),
        });
        Objective { parameters, measure, scratches: scratches.collect(), sampled: 0 }
    }

    /// Gives the evaluator back.
    pub fn release(mut self, fitter: &mut Fitter) {
        fitter.evaluator = self.scratches.swap_remove(0).evaluator;
    }

    /// Evaluates points, one after the other in one slice; a value above its limit is not exact.
    fn evaluate(&mut self, samples: &Samples, points: &[f64], limits: &[f64], values: &mut [f64]) {
        let (parameters, measure) = (self.parameters, self.measure);
        self.sampled += (values.len() * samples.rows()) as u64;
        let share = values.len().div_ceil(self.scratches.len()).max(1);
        let work = |(place, (scratch, values)): (usize, (&mut Scratch, &mut [f64]))| {
            for (nth, value) in values.iter_mut().enumerate() {
                let individual = place * share + nth;
                let point = &points[individual * parameters.len()..][..parameters.len()];
                scratch.set(parameters, point);
                *value = scratch.loss(samples, measure, limits[individual]);
            }
        };
        if self.scratches.len() == 1 {
            work((0, (&mut self.scratches[0], values)));
        } else {
            let shares = self.scratches.par_iter_mut().zip(values.par_chunks_mut(share));
            shares.enumerate().for_each(work);
        }
    }

    /// Returns the loss on some samples, as a population calls it.
    pub fn on<'b>(
        &'b mut self,
        samples: &'b Samples,
    ) -> impl FnMut(&[f64], &[f64], &mut [f64]) + use<'a, 'b> {
        move |points, limits, values| self.evaluate(samples, points, limits, values)
    }

    /// Evaluates one point.
    pub fn loss(&mut self, samples: &Samples, point: &[f64]) -> f64 {
        self.sampled += samples.rows() as u64;
        let scratch = &mut self.scratches[0];
        scratch.set(self.parameters, point);
        scratch.loss(samples, self.measure, f64::INFINITY)
    }
}

impl Scratch {
    fn set(&mut self, parameters: &[Parameter], point: &[f64]) {
        for (parameter, value) in parameters.iter().zip(point) {
            self.constants[parameter.index] = parameter.nearest(*value);
        }
        self.tape.set_constants(&self.constants);
    }

    /// Returns the weighted sum of squares or the largest error; infinite if an output is not
    /// finite.
    fn loss(&mut self, samples: &Samples, measure: Measure, limit: f64) -> f64 {
        let loss = match measure {
            Measure::Max => self.largest(samples),
            _ => {
                self.evaluator.loss_into(&self.tape, samples, limit, &mut self.sums);
                self.sums.total()
            }
        };
        if loss.is_nan() { f64::INFINITY } else { loss }
    }

    fn largest(&mut self, samples: &Samples) -> f64 {
        self.evaluator.outputs_into(&self.tape, samples, &mut self.values);
        let mut largest = 0.0f64;
        for output in 0..samples.outputs() {
            for error in scaled(samples, &self.values, output) {
                if !error.is_finite() {
                    return f64::INFINITY;
                }
                largest = largest.max(error.abs());
            }
        }
        largest
    }
}
