//! The individuals of differential evolution, and how a generation follows another.

use super::differential_evolution::{DifferentialEvolution, End, Outside, Start, Strategy};
use super::{Range, RangeError};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Evaluates points, one after the other in one slice, into values. The limit of each is given: a
/// value above it need not be exact.
pub(super) type Evaluate<'a> = dyn FnMut(&[f64], &[f64], &mut [f64]) + 'a;

/// The least number of individuals of which one can be varied by three others.
const LEAST_INDIVIDUALS: usize = 4;

/// Points, as positions on the scales of their ranges, and their values.
pub(super) struct Population<'a> {
    settings: &'a DifferentialEvolution,
    ranges: &'a [Range],
    rng: ChaCha8Rng,
    positions: Vec<f64>,
    values: Vec<f64>,
    trials: Vec<f64>,
    trial_values: Vec<f64>,
    /// The points to evaluate, in the function's own coordinates.
    points: Vec<f64>,
    best: usize,
    /// The least value of the individuals as they were spread.
    pub first_value: f64,
    pub evaluations: u64,
}

impl<'a> Population<'a> {
    /// Spreads individuals, which have no value yet ([`Population::assess`]).
    pub fn new(
        settings: &'a DifferentialEvolution,
        ranges: &'a [Range],
        seed: u64,
        stream: u64,
    ) -> Result<Population<'a>, RangeError> {
        ranges.iter().try_for_each(Range::check_finite)?;
        let usual = 40.min(10 * ranges.len());
        let count = settings.individuals.unwrap_or(usual).max(LEAST_INDIVIDUALS);
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        rng.set_stream(stream);
        let positions = spread(settings.start, count, ranges, &mut rng);
        Ok(Population {
            settings,
            ranges,
            rng,
            trials: vec![0.0; positions.len()],
            points: vec![0.0; positions.len()],
            positions,
            values: vec![f64::INFINITY; count],
            trial_values: vec![f64::INFINITY; count],
            best: 0,
            first_value: f64::INFINITY,
            evaluations: 0,
        })
    }

    /// Evaluates all individuals, for the first time or because the function has changed.
    pub fn assess(&mut self, evaluate: &mut Evaluate) {
        place(self.ranges, &self.positions, &mut self.points);
        // No limit: the values of before are those of another function.
        self.trial_values.fill(f64::INFINITY);
        evaluate(&self.points, &self.trial_values, &mut self.values);
        self.values.iter_mut().for_each(ordered);
        self.find_best();
        if self.evaluations == 0 {
            self.first_value = self.best_value();
        }
        self.evaluations += self.values.len() as u64;
    }

    /// Evaluates all individuals, and goes from generation to generation to the end.
    pub fn evolve(&mut self, evaluate: &mut Evaluate) -> End {
        self.assess(evaluate);
        loop {
            if let Some(end) = self.end() {
                return end;
            }
            self.generation(evaluate);
        }
    }

    /// Tries one point for each individual, all made of the same generation.
    pub fn generation(&mut self, evaluate: &mut Evaluate) {
        let [least, greatest] = self.settings.weights;
        let weight = least + (greatest - least) * self.rng.random::<f64>();
        for individual in 0..self.values.len() {
            self.vary(individual, weight);
        }
        place(self.ranges, &self.trials, &mut self.points);
        evaluate(&self.points, &self.values, &mut self.trial_values);
        self.trial_values.iter_mut().for_each(ordered);
        self.evaluations += self.values.len() as u64;
        self.select();
        self.find_best();
    }

    /// Makes an individual's trial.
    fn vary(&mut self, individual: usize, weight: f64) {
        let dimensions = self.ranges.len();
        let [a, b, c] = self.others(individual);
        let always = self.rng.random_range(0..dimensions.max(1));
        for (axis, range) in self.ranges.iter().enumerate() {
            let at = |individual: usize| self.positions[individual * dimensions + axis];
            let is_mutated = self.rng.random::<f64>() < self.settings.crossover || axis == always;
            let mut position = at(individual);
            if is_mutated {
                position = at(a) + weight * (at(b) - at(c));
                if !range.contains(position) {
                    position = match self.settings.outside {
                        Outside::Reinitialise => range.at(self.rng.random()),
                        Outside::Clamp => range.clamp(position),
                    };
                }
            }
            self.trials[individual * dimensions + axis] = position;
        }
    }

    /// Draws what an individual is varied by: others, all distinct.
    fn others(&mut self, individual: usize) -> [usize; 3] {
        let mut drawn = [individual; 3];
        for place in 0..3 {
            if place == 0 && self.settings.strategy == Strategy::Best1Bin {
                drawn[0] = self.best;
                continue;
            }
            drawn[place] = loop {
                let other = self.rng.random_range(0..self.values.len());
                if other != individual && !drawn[..place].contains(&other) {
                    break other;
                }
            };
        }
        drawn
    }

    fn select(&mut self) {
        let dimensions = self.ranges.len();
        for (individual, trial) in self.trial_values.iter().enumerate() {
            // An equal value counts as progress, or a plateau would never be crossed.
            if *trial <= self.values[individual] {
                self.values[individual] = *trial;
                let own = individual * dimensions..(individual + 1) * dimensions;
                self.positions[own.clone()].copy_from_slice(&self.trials[own]);
            }
        }
    }

    fn find_best(&mut self) {
        let indices = 0..self.values.len();
        let best = indices.min_by(|&a, &b| self.values[a].total_cmp(&self.values[b]));
        self.best = best.unwrap_or(0);
    }

    pub fn best_value(&self) -> f64 {
        self.values[self.best]
    }

    /// Returns the best individual, in the function's own coordinates.
    pub fn best_point(&self) -> Vec<f64> {
        let values = self.ranges.iter().zip(self.best_position());
        values.map(|(range, position)| range.value(*position)).collect()
    }

    pub fn ranges(&self) -> &'a [Range] {
        self.ranges
    }

    pub fn best_position(&self) -> &[f64] {
        let dimensions = self.ranges.len();
        &self.positions[self.best * dimensions..(self.best + 1) * dimensions]
    }

    /// Returns the extent of all individuals along an axis.
    pub fn extent(&self, axis: usize) -> f64 {
        let along = || self.positions.iter().skip(axis).step_by(self.ranges.len());
        let (least, greatest) = (f64::INFINITY, f64::NEG_INFINITY);
        along().copied().fold(greatest, f64::max) - along().copied().fold(least, f64::min)
    }

    /// Returns why the search is at its end, if it is.
    pub fn end(&self) -> Option<End> {
        let DifferentialEvolution { value_spread, point_spread, max_evaluations, .. } =
            *self.settings;
        let largest = self.values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let is_within = |share: f64| {
            let mut axes = self.ranges.iter().enumerate();
            axes.all(|(axis, range)| self.extent(axis) <= share * range.width())
        };
        let best = self.best_value();
        if value_spread.is_some_and(|share| largest - best <= share * best.abs()) {
            return Some(End::ValuesAgree);
        }
        if point_spread.is_some_and(is_within) {
            return Some(End::PointsAgree);
        }
        let next = self.evaluations + self.values.len() as u64;
        (next > max_evaluations).then_some(End::Evaluations)
    }
}

/// A value that is not a number is worse than any.
fn ordered(value: &mut f64) {
    if value.is_nan() {
        *value = f64::INFINITY;
    }
}

/// Turns positions on scales into values.
fn place(ranges: &[Range], positions: &[f64], points: &mut [f64]) {
    for ((point, position), range) in points.iter_mut().zip(positions).zip(ranges.iter().cycle()) {
        *point = range.value(*position);
    }
}

fn spread(start: Start, count: usize, ranges: &[Range], rng: &mut ChaCha8Rng) -> Vec<f64> {
    let mut positions = vec![0.0; count * ranges.len()];
    let mut slices: Vec<usize> = (0..count).collect();
    for (axis, range) in ranges.iter().enumerate() {
        for place in (1..count).rev() {
            slices.swap(place, rng.random_range(0..=place));
        }
        for (individual, slice) in slices.iter().enumerate() {
            let within: f64 = rng.random();
            let share = match start {
                Start::LatinHypercube => (*slice as f64 + within) / count as f64,
                Start::Random => within,
            };
            positions[individual * ranges.len() + axis] = range.at(share);
        }
    }
    positions
}
