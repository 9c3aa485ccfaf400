//! Least squares by Levenberg–Marquardt (Marquardt 1963, with his scaling by the diagonal).

use super::Differentiated;
use crate::deadline::Deadline;
use crate::eval::{Evaluator, NormalEquations, Samples, Tape};
use crate::program::Draft;

/// The end of a fit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stop {
    /// The most steps that are accepted.
    pub max_steps: u32,
    /// The least gain: a step that lowers the sum of squares by a smaller share is the last.
    pub min_gain: f64,
}

/// A fitter of constants, with the scratch memory that it needs.
#[derive(Clone, Debug, Default)]
pub struct Fitter {
    /// The evaluator that runs the programs.
    pub evaluator: Evaluator,
    /// The deadline at which fits to many samples stop, with the constants found by then.
    pub deadline: Deadline,
    pub(super) derivative: Differentiated,
    pub(super) tape: Tape,
    current: NormalEquations,
    trial: NormalEquations,
    constants: Vec<f32>,
    trial_constants: Vec<f32>,
    factor: Vec<f64>,
    step: Vec<f64>,
    damping: f64,
}

/// The damping beyond which no step is tried. This, the first damping and the factors that change
/// it: chosen by hand, unmeasured.
const MAX_DAMPING: f64 = 1e8;

/// The least number of samples whose fit heeds the deadline. Chosen by hand, unmeasured.
const MANY_SAMPLES: usize = 1024;

impl Fitter {
    /// Makes a fitter whose fits to many samples stop at a deadline.
    pub fn until(deadline: &Deadline) -> Fitter {
        Fitter { deadline: deadline.clone(), ..Fitter::default() }
    }

    /// Fits every constant of effective code to the samples by least squares, starting from its
    /// value. Returns the weighted sum of squared errors over all outputs.
    ///
    /// The constants stay as they are if outputs are not finite on the samples; so does the sum then,
    /// and a constant by which a derivative is not finite, as that of a root at its end.
    ///
    /// # Panics
    /// If the samples and the program differ in the number of inputs or outputs.
    pub fn fit(&mut self, draft: &mut Draft, samples: &Samples, stop: Stop) -> f64 {
        self.fit_free(draft, samples, stop, |_| true)
    }

    /// As [`Fitter::fit`], but fits only the constants whose index is free.
    pub fn fit_free(
        &mut self,
        draft: &mut Draft,
        samples: &Samples,
        stop: Stop,
        is_free: impl Fn(usize) -> bool,
    ) -> f64 {
        self.derivative.assign_free(draft, is_free);
        self.tape.prepare(&self.derivative.program);
        self.constants.clone_from(&self.derivative.program.consts);
        self.damping = 1e-3;
        let jacobian = &self.derivative.jacobian;
        self.evaluator.normal_equations(&self.tape, jacobian, samples, &mut self.current);
        hold_what_has_no_derivative(&mut self.current);
        self.go_on(draft, samples, stop)
    }

    /// Continues the last [`Fitter::fit`], which must have had the same program and samples.
    pub fn go_on(&mut self, draft: &mut Draft, samples: &Samples, stop: Stop) -> f64 {
        if draft.consts.is_empty() || !is_finite(&self.current) {
            return self.current.sum_of_squares;
        }
        for _ in 0..stop.max_steps {
            if self.is_cut(samples) {
                break;
            }
            match self.step(draft.consts.len(), samples) {
                Some(gain) if gain >= stop.min_gain => {}
                _ => break,
            }
        }
        let fitted = &self.constants[..draft.consts.len()];
        draft.consts.copy_from_slice(fitted);
        self.current.sum_of_squares
    }

    /// Returns true if the deadline is past and there are many samples: a fit to few takes hardly
    /// longer than reading the clock.
    pub(super) fn is_cut(&self, samples: &Samples) -> bool {
        samples.rows() >= MANY_SAMPLES && self.deadline.is_past()
    }

    /// Takes one step, with as much damping as it needs. Returns the share by which it lowers the
    /// sum of squares; none if no step lowers it.
    fn step(&mut self, parameters: usize, samples: &Samples) -> Option<f64> {
        while self.damping < MAX_DAMPING {
            if self.solve(parameters, self.damping) && self.move_constants(parameters) {
                self.tape.set_constants(&self.trial_constants);
                let jacobian = &self.derivative.jacobian;
                self.evaluator.normal_equations(&self.tape, jacobian, samples, &mut self.trial);
                hold_what_has_no_derivative(&mut self.trial);
                let (old, new) = (self.current.sum_of_squares, self.trial.sum_of_squares);
                if is_finite(&self.trial) && new < old {
                    std::mem::swap(&mut self.current, &mut self.trial);
                    std::mem::swap(&mut self.constants, &mut self.trial_constants);
                    self.damping = (self.damping * 0.1).max(1e-9);
                    return Some((old - new) / old);
                }
            }
            if self.is_cut(samples) {
                return None;
            }
            self.damping *= 8.0;
        }
        None
    }

    /// Applies the solved step. Returns true if the constants change and stay finite.
    fn move_constants(&mut self, parameters: usize) -> bool {
        self.trial_constants.clone_from(&self.constants);
        for (constant, step) in self.trial_constants.iter_mut().zip(&self.step[..parameters]) {
            *constant = (f64::from(*constant) - step) as f32;
        }
        let finite = self.trial_constants.iter().all(|c| c.is_finite());
        finite && self.trial_constants != self.constants
    }

    /// Solves `(JᵀWJ + damping · diag JᵀWJ) step = JᵀWr` by Cholesky factorisation. Returns false
    /// if the matrix is not positive definite in `f64`.
    fn solve(&mut self, n: usize, damping: f64) -> bool {
        let matrix = &self.current.matrix;
        let largest = (0..n).map(|i| matrix[i * n + i]).fold(0.0, f64::max);
        self.factor.clear();
        self.factor.resize(n * n, 0.0);
        let l = &mut self.factor;
        for i in 0..n {
            for j in 0..=i {
                let mut sum = matrix[i * n + j];
                if i == j {
                    // A constant without influence must neither move nor make the matrix singular.
                    sum += damping * sum.max(largest * 1e-12);
                }
                for k in 0..j {
                    sum -= l[i * n + k] * l[j * n + k];
                }
                if i == j {
                    if sum.is_nan() || sum <= 0.0 {
                        return false;
                    }
                    l[i * n + i] = sum.sqrt();
                } else {
                    l[i * n + j] = sum / l[j * n + j];
                }
            }
        }
        self.step.clone_from(&self.current.gradient);
        let x = &mut self.step;
        for i in 0..n {
            for k in 0..i {
                x[i] -= l[i * n + k] * x[k];
            }
            x[i] /= l[i * n + i];
        }
        for i in (0..n).rev() {
            for k in i + 1..n {
                x[i] -= l[k * n + i] * x[k];
            }
            x[i] /= l[i * n + i];
        }
        true
    }
}

/// Takes constants out of the equations by which a derivative is not finite: they then do not move.
fn hold_what_has_no_derivative(equations: &mut NormalEquations) {
    if is_finite(equations) || !equations.sum_of_squares.is_finite() {
        return;
    }
    let NormalEquations { gradient, matrix, .. } = equations;
    let n = gradient.len();
    for held in 0..n {
        if gradient[held].is_finite() && matrix[held * n + held].is_finite() {
            continue;
        }
        gradient[held] = 0.0;
        for other in 0..n {
            (matrix[held * n + other], matrix[other * n + held]) = (0.0, 0.0);
        }
    }
}

fn is_finite(equations: &NormalEquations) -> bool {
    equations.sum_of_squares.is_finite()
        && equations.gradient.iter().all(|g| g.is_finite())
        && equations.matrix.iter().all(|m| m.is_finite())
}
