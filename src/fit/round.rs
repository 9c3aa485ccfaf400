//! A round of a global fit: differential evolution, then a local search from its best.

use super::differential_evolution::End;
use super::global::GlobalSettings;
use super::global_fit::Finish;
use super::objective::Objective;
use super::population::Population;
use super::rows::GrowingRows;
use super::within::{maximum_within, squares_within};
use super::{Fitter, Measure, Parameter, Range, RangeError};
use crate::eval::Samples;
use crate::program::{Draft, Program};

/// What the rounds of a fit share, and what they have spent.
pub(super) struct Search<'a> {
    fitter: &'a mut Fitter,
    verified: Program,
    samples: &'a Samples,
    rows: GrowingRows<'a>,
    parameters: &'a [Parameter],
    measure: Measure,
    ranges: &'a [Range],
    settings: &'a GlobalSettings,
    pub evaluations: u64,
    pub sampled: u64,
}

/// What a round has found.
pub(super) struct Found {
    pub program: Draft,
    pub loss: f64,
    pub finish: Finish,
    pub end: End,
    /// The least loss of the first individuals.
    pub first_loss: f64,
}

impl Found {
    /// Takes a program if it is better, and returns true if it is.
    fn offer(&mut self, program: Draft, loss: f64, finish: Finish) -> bool {
        let is_better = loss < self.loss;
        if is_better {
            (self.program, self.loss, self.finish) = (program, loss, finish);
        }
        is_better
    }
}

impl<'a> Search<'a> {
    pub fn new(
        fitter: &'a mut Fitter,
        program: &Draft,
        samples: &'a Samples,
        parameters: &'a [Parameter],
        measure: Measure,
        ranges: &'a [Range],
        settings: &'a GlobalSettings,
    ) -> Search<'a> {
        Search {
            fitter,
            verified: Program::verify(program.clone()).expect("effective code is a program"),
            samples,
            rows: GrowingRows::new(samples, settings.first_rows, settings.seed),
            parameters,
            measure,
            ranges,
            settings,
            evaluations: 0,
            sampled: 0,
        }
    }

    /// Returns the loss of a program of these parameters.
    pub fn started(&mut self, program: &Draft) -> f64 {
        let mut objective = self.objective();
        let loss = objective.loss(self.samples, &point_of(program, self.parameters));
        self.evaluations += 1;
        self.end(objective);
        loss
    }

    pub fn round(&mut self, round: u64, program: &Draft) -> Result<Found, RangeError> {
        let settings = self.settings.evolution(round, self.evaluations);
        let mut population = Population::new(&settings, self.ranges, self.settings.seed, round)?;
        let mut objective = self.objective();
        let end = self.rows.evolve(&mut population, &mut objective, &self.fitter.deadline);
        self.evaluations += population.evaluations;
        self.end(objective);
        let mut found = Found {
            program: self.with_constants(program, &population.best_point()),
            loss: population.best_value(),
            finish: Finish::Evolution,
            end,
            first_loss: population.first_value,
        };
        if !self.descend(&mut found) || self.lacks_a_derivative(&found.program) {
            self.shrink(&mut found, &population, round);
        }
        Ok(found)
    }

    /// Follows derivatives down. Returns true if they led anywhere.
    fn descend(&mut self, found: &mut Found) -> bool {
        let mut trial = found.program.clone();
        let (fitter, samples, parameters) = (&mut *self.fitter, self.samples, self.parameters);
        let loss = match self.measure {
            Measure::Max => maximum_within(fitter, &mut trial, samples, parameters),
            _ => squares_within(fitter, &mut trial, samples, parameters),
        };
        found.offer(trial, loss, Finish::Derivatives)
    }

    /// Searches without derivatives.
    fn shrink(&mut self, found: &mut Found, population: &Population, round: u64) {
        let point = point_of(&found.program, self.parameters);
        let along = self.ranges.iter().zip(&point);
        let start: Vec<f64> = along.map(|(range, value)| range.position(*value)).collect();
        let mut objective = self.objective();
        let samples = self.samples;
        let mut loss = |point: &[f64]| objective.loss(samples, point);
        let minimum = self.settings.refine(population, &start, round, &mut loss);
        self.evaluations += minimum.evaluations;
        self.end(objective);
        let trial = self.with_constants(&found.program, &minimum.at);
        found.offer(trial, minimum.value, Finish::Simplex);
    }

    /// Returns true if the outputs have no derivative by a parameter, whatever its value.
    fn lacks_a_derivative(&mut self, program: &Draft) -> bool {
        self.fitter.derivative.assign(program);
        let entries = &self.fitter.derivative.jacobian.entries;
        let has_one = |parameter: &Parameter| {
            let mut derivatives = entries.iter().flatten();
            derivatives.any(|&(index, _)| usize::from(index) == parameter.index)
        };
        !self.parameters.iter().all(has_one)
    }

    fn objective(&mut self) -> Objective<'a> {
        let (samples, parameters) = (self.samples, self.parameters);
        Objective::new(self.fitter, &self.verified, samples, parameters, self.measure)
    }

    fn end(&mut self, objective: Objective<'a>) {
        self.sampled += objective.sampled;
        objective.release(self.fitter);
    }

    fn with_constants(&self, program: &Draft, point: &[f64]) -> Draft {
        let mut program = program.clone();
        for (parameter, value) in self.parameters.iter().zip(point) {
            program.consts[parameter.index] = parameter.nearest(*value);
        }
        program
    }
}

fn point_of(program: &Draft, parameters: &[Parameter]) -> Vec<f64> {
    parameters.iter().map(|parameter| program.consts[parameter.index].into()).collect()
}
