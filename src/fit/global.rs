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
/// until two rounds agree on the minimum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GlobalSettings {
    /// The differential evolution of each round, but for its crossover.
    pub evolution: DifferentialEvolution,
    /// The crossovers of the first round, the third and so on, and of those between: a small one
    /// suits sums of functions of one coordinate each, a large one all others.
    pub crossovers: [f64; 2],
    /// The simplices after it; they begin no larger than the extent of the last individuals.
    pub simplex: NelderMead,
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
/// crossovers of .5 alone .79 and .43, of .9 alone .70 and .67; with `DE/rand/1/bin` .61 and .34; with
/// one round of it to the end .46 and .26. The samples, and the most evaluations, are by hand,
/// unmeasured.
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
            let is_last = evaluations >= self.max_evaluations
                || least
                    .as_ref()
                    .is_some_and(|least| agree(least.value, found.value, population.first_value));
            if least.as_ref().is_none_or(|least| found.value < least.value) {
                least = Some(found);
            }
            if is_last {
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

/// Returns true if two rounds have found the same least value, as far as rounding lets them: but
/// for a share of it, or of the way to it from the least of the first individuals.
pub(super) fn agree(a: f64, b: f64, first: f64) -> bool {
    let way = if first.is_finite() { (first - a).abs() } else { 0.0 };
    (a - b).abs() <= SAME_VALUE * a.abs().min(b.abs()) + SAME_WAY * way
}

/// By hand, unmeasured.
const SAME_VALUE: f64 = 1e-6;
const SAME_WAY: f64 = 1e-9;

/// The streams of random numbers of local searches; those below are of populations.
const LOCAL_STREAMS: u64 = 1 << 32;

/// The least size of the simplex after a differential evolution, as a share of each range. By hand,
/// unmeasured.
const FINEST: f64 = 1e-3;
