//! Fits of one group, by a thread that reuses its memory.

use super::Model;
use super::penalty::{Pull, Pulled};
use crate::dataset::{Dataset, Split, output_units};
use crate::eval::{Samples, Tape};
use crate::fit::{Fitter, GlobalSettings, Measure, Parameter, Scale, fit_globally, squares_within};
use crate::program::{Draft, Program};
use serde::{Deserialize, Serialize};
use std::cell::OnceCell;

/// The share by which a fit must be better than another to be preferred to it: between equal
/// optima, the one that continues the neighbours' is kept. That of `lgp fit`'s starts.
pub(super) const SAME: f64 = 1e-3;

/// The mean square that counts as rounding, as a share of the values'. As `fit` has it: a few units
/// of 2⁻²⁴, squared.
const ROUNDING: f64 = 1e-13;

/// The parameters of a group.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Point {
    pub values: Vec<f32>,
    /// The mean square of the errors, outputs in their units.
    pub square: f64,
}

/// The samples of a group.
pub(super) struct Task {
    samples: Samples,
    /// The same with an output for each parameter, once a fit is pulled.
    extended: OnceCell<Samples>,
    /// The mean square below which errors are rounding.
    pub floor: f64,
}

impl Task {
    /// Returns true if a mean square is smaller than another by more than counts as the same.
    pub fn is_better(&self, new: f64, old: f64) -> bool {
        new.is_finite() && (!old.is_finite() || (old > self.floor && new < old * (1.0 - SAME)))
    }

    /// Returns true if two mean squares are those of the same optimum.
    pub fn are_same(&self, a: f64, b: f64) -> bool {
        !self.is_better(a, b) && !self.is_better(b, a)
    }
}

/// What all fits share.
pub(super) struct Problem<'a> {
    pub dataset: &'a Dataset,
    pub model: &'a Model,
    pub measure: Measure,
    pub units: Vec<f64>,
    pub seed: u64,
}

impl<'a> Problem<'a> {
    pub fn new(dataset: &'a Dataset, model: &'a Model, measure: Measure, seed: u64) -> Problem<'a> {
        let units = output_units(&dataset.outputs);
        Problem { dataset, model, measure, units, seed }
    }

    /// Lays out the rows of a group.
    pub fn task(&self, split: &Split, rows: &[u32]) -> Task {
        let samples = self.measure.samples(split, self.dataset.inputs.len(), rows, &self.units);
        let floor = ROUNDING * square_of_values(&samples);
        Task { samples, extended: OnceCell::new(), floor }
    }

    pub fn parameters(&self) -> &'a [Parameter] {
        self.model.parameters()
    }
}

fn square_of_values(samples: &Samples) -> f64 {
    let squares = (0..samples.outputs()).flat_map(|output| {
        let weighted = samples.targets(output).iter().zip(samples.weights(output));
        weighted.map(|(y, w)| f64::from(*w) * f64::from(*y).powi(2))
    });
    squares.sum::<f64>() / samples.total_weight()
}

/// A thread's fitter of groups.
pub(super) struct Bench<'a> {
    problem: &'a Problem<'a>,
    fitter: Fitter,
    draft: Draft,
    tape: Tape,
    pulled: Pulled,
}

impl<'a> Bench<'a> {
    pub fn new(problem: &'a Problem<'a>) -> Bench<'a> {
        let draft = problem.model.program.clone();
        let program = Program::verify(draft.clone()).expect("a parsed formula is a program");
        let pulled = Pulled::new(&draft, problem.parameters());
        Bench { problem, fitter: Fitter::default(), draft, tape: Tape::new(&program), pulled }
    }

    /// Returns the mean square with some values, without a fit.
    pub fn square(&mut self, task: &Task, values: &[f32]) -> f64 {
        set(&mut self.draft, self.problem.parameters(), values);
        self.tape.set_constants(&self.draft.consts);
        let sums = self.fitter.evaluator.loss(&self.tape, &task.samples, f64::INFINITY);
        finite(sums.total() / task.samples.total_weight())
    }

    /// Returns the outputs with some values.
    pub fn outputs(&mut self, task: &Task, values: &[f32]) -> Vec<Vec<f32>> {
        set(&mut self.draft, self.problem.parameters(), values);
        self.tape.set_constants(&self.draft.consts);
        self.fitter.evaluator.outputs(&self.tape, &task.samples)
    }

    /// Fits from some values.
    pub fn local(&mut self, task: &Task, from: &[f32]) -> Point {
        let parameters = self.problem.parameters();
        set(&mut self.draft, parameters, from);
        let loss = squares_within(&mut self.fitter, &mut self.draft, &task.samples, parameters);
        let values = values_of(&self.draft, parameters);
        Point { values, square: finite(loss / task.samples.total_weight()) }
    }

    /// Fits from some values, pulled towards others; returns the fit and what was made small.
    pub fn pulled(&mut self, task: &Task, from: &[f32], pull: &Pull) -> (Point, f64) {
        let parameters = self.problem.parameters();
        let total = task.samples.total_weight();
        let samples = task.extended.get_or_init(|| task.samples.with_outputs(parameters.len()));
        let draft = self.pulled.draft(parameters, from, pull, total);
        squares_within(&mut self.fitter, draft, samples, parameters);
        let values = values_of(draft, parameters);
        let square = self.square(task, &values);
        let made_small = square + pull.penalty(parameters, &values);
        (Point { values, square }, made_small)
    }

    /// Fits globally, then locally.
    pub fn global(&mut self, task: &Task, from: &[f32], group: u32) -> Point {
        let Problem { seed, .. } = *self.problem;
        let parameters = self.problem.parameters();
        let settings = GlobalSettings {
            seed: seed.wrapping_add(u64::from(group).wrapping_mul(0x9e37_79b9_7f4a_7c15)),
            ..GlobalSettings::default()
        };
        set(&mut self.draft, parameters, from);
        let Bench { fitter, draft, .. } = self;
        // The ranges were checked with the model: bounds are kept.
        let done = fit_globally(fitter, draft, &task.samples, parameters, Measure::Rmse, &settings);
        let values = values_of(&self.draft, parameters);
        match done {
            Ok(_) => self.local(task, &values),
            Err(_) => Point { square: f64::INFINITY, values },
        }
    }
}

fn set(draft: &mut Draft, parameters: &[Parameter], values: &[f32]) {
    for (parameter, &value) in parameters.iter().zip(values) {
        draft.consts[parameter.index] = value.clamp(parameter.bounds[0], parameter.bounds[1]);
    }
}

fn values_of(draft: &Draft, parameters: &[Parameter]) -> Vec<f32> {
    parameters.iter().map(|parameter| draft.consts[parameter.index]).collect()
}

fn finite(square: f64) -> f64 {
    if square.is_finite() { square } else { f64::INFINITY }
}

/// Returns a value's position on its parameter's scale.
pub(super) fn position(parameter: &Parameter, value: f32) -> f64 {
    match parameter.scale {
        Scale::Linear => value.into(),
        Scale::Logarithmic => f64::from(value).log2(),
    }
}

/// Returns the value at a position.
pub(super) fn value_at(parameter: &Parameter, position: f64) -> f32 {
    let value = match parameter.scale {
        Scale::Linear => position,
        Scale::Logarithmic => position.exp2(),
    };
    (value as f32).clamp(parameter.bounds[0], parameter.bounds[1])
}

/// Returns the mean of some groups' values, each on its parameter's scale.
pub(super) fn mean(parameters: &[Parameter], points: &[&[f32]]) -> Vec<f32> {
    let of = |(place, parameter): (usize, &Parameter)| {
        let positions = points.iter().map(|values| position(parameter, values[place]));
        value_at(parameter, positions.sum::<f64>() / points.len() as f64)
    };
    parameters.iter().enumerate().map(of).collect()
}
