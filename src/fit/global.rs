//! Global search: differential evolution, then a local search from the best that it found.

use super::differential_evolution::{DifferentialEvolution, Minimum, Strategy};
use super::nelder_mead::{LARGEST_SIZE, NelderMead};
use super::population::Population;
use super::{Range, RangeError};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

/// How a global minimum is searched for (Pesce & Iwanicki 2015, course notes §3.3): by differential
/// evolution, and then by a local search from its best point; and again with other individuals,
/// until some of these rounds agree on the minimum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GlobalSettings {
    /// The differential evolution of each round, but for its crossover.
    pub evolution: DifferentialEvolution,
    /// The crossovers of the first round, the third and so on, and of those between: a small one
    /// suits sums of functions of one coordinate each, a large one all others.
    pub crossovers: [f64; 2],
    /// The simplices after it; they begin no larger than the extent of the last individuals.
    pub simplex: NelderMead,
    /// The number of rounds that must agree on the least value for the search to end: more for
    /// functions of many minima, 1 for a single round.
    pub agreeing: u32,
    /// The most rounds; at least one.
    pub rounds: u32,
    /// The most evaluations of all rounds together; a local search that has begun ends.
    pub max_evaluations: u64,
    /// The number of samples that a fit's first generations see; all, where there are not at least
    /// twice as many.
    pub first_rows: usize,
    /// The seed of random numbers.
    pub seed: u64,
}

/// Chosen on the functions of `results/fit`: the share of runs that reach the minimum within 5000
/// evaluations, of the multimodal ones and of the sums of squares, is .73 and .67 with these; with
/// crossovers of .5 alone .79 and .43, of .9 alone .70 and .67; with `DE/rand/1/bin` .61 and .34;
/// with one round of it to the end .46 and .26. Within 20,000 it is .64 and .83 if one round is
/// enough, .86 and .86 if two agree, .87 and .86 if three do. The rest is by hand, unmeasured.
impl Default for GlobalSettings {
    fn default() -> GlobalSettings {
        GlobalSettings {
            evolution: DifferentialEvolution {
                strategy: Strategy::Best1Bin,
                value_spread: Some(1e-2),
                point_spread: Some(1e-2),
                ..DifferentialEvolution::default()
            },
            crossovers: [0.9, 0.5],
            simplex: NelderMead::default(),
            agreeing: 2,
            rounds: 8,
            max_evaluations: 20_000,
            first_rows: 256,
            seed: 1,
        }
    }
}

impl GlobalSettings {
    /// Minimises a function of one coordinate a range by differential evolution, a generation's
    /// points in parallel, then by Nelder and Mead's simplices. The same settings and ranges give
    /// the same minimum.
    ///
    /// Returns an error if a range is not finite.
    pub fn minimise(
        &self,
        ranges: &[Range],
        f: impl Fn(&[f64]) -> f64 + Sync,
    ) -> Result<Minimum, RangeError> {
        let mut least: Option<Minimum> = None;
        let mut agreement = Agreement::default();
        let mut evaluations = 0;
        for round in 0..u64::from(self.rounds.max(1)) {
            let evolution = self.evolution(round, evaluations);
            let mut population = Population::new(&evolution, ranges, self.seed, round)?;
            population.evolve(&mut |points, _, values| {
                values.par_iter_mut().enumerate().for_each(|(individual, value)| {
                    *value = f(&points[individual * ranges.len()..][..ranges.len()]);
                });
            });
            let start = population.best_position();
            let found = self.refine(&population, start, round, &mut |point| f(point));
            evaluations += population.evaluations + found.evaluations;
            let agreeing = agreement.add(found.value, population.first_value);
            if least.as_ref().is_none_or(|least| found.value < least.value) {
                least = Some(found);
            }
            if agreeing >= self.agreeing || evaluations >= self.max_evaluations {
                break;
            }
        }
        Ok(Minimum { evaluations, ..least.expect("at least one round") })
    }

    /// Returns the settings of a round, given the evaluations before it.
    pub(super) fn evolution(&self, round: u64, evaluations: u64) -> DifferentialEvolution {
        let left = self.max_evaluations.saturating_sub(evaluations);
        let max_evaluations = self.evolution.max_evaluations.min(left);
        let crossover = self.crossovers[(round % 2) as usize];
        DifferentialEvolution { max_evaluations, crossover, ..self.evolution }
    }

    /// Searches with simplices from a position, the first no larger than the individuals' extent.
    pub(super) fn refine(
        &self,
        population: &Population,
        position: &[f64],
        round: u64,
        f: &mut dyn FnMut(&[f64]) -> f64,
    ) -> Minimum {
        let size = self.simplex.size.min(LARGEST_SIZE);
        let step = |(axis, range): (usize, &Range)| {
            let width = range.width();
            population.extent(axis).clamp(FINEST.min(size) * width, size * width)
        };
        let steps: Vec<f64> = population.ranges().iter().enumerate().map(step).collect();
        let mut rng = ChaCha8Rng::seed_from_u64(self.seed);
        rng.set_stream(LOCAL_STREAMS + round);
        self.simplex.minimise_with(position, &steps, population.ranges(), rng, f)
    }
}

/// The least value of the rounds so far, and how many have found it.
#[derive(Default)]
pub(super) struct Agreement {
    least: Option<f64>,
    rounds: u32,
}

impl Agreement {
    /// Adds a round's value, given the least of its first individuals, and returns how many rounds
    /// agree on the least. Values agree up to a share of them, or of the way to them from there.
    pub fn add(&mut self, value: f64, first: f64) -> u32 {
        let least = self.least.unwrap_or(value);
        let way = if first.is_finite() { (first - value).abs() } else { 0.0 };
        let same = SAME_VALUE * value.abs().min(least.abs()) + SAME_WAY * way;
        if (value - least).abs() <= same {
            self.rounds += 1;
        } else if value < least {
            self.rounds = 1;
        }
        self.least = Some(least.min(value));
        self.rounds
    }
}

/// By hand, unmeasured.
const SAME_VALUE: f64 = 1e-6;
const SAME_WAY: f64 = 1e-9;

/// The streams of random numbers of local searches; those below are of populations.
const LOCAL_STREAMS: u64 = 1 << 32;

/// The least size of the simplex after a differential evolution, as a share of each range. By hand,
/// unmeasured.
const FINEST: f64 = 1e-3;
