//! Global search: differential evolution, then a local search from the best that it found.

use super::differential_evolution::{DifferentialEvolution, Minimum};
use super::nelder_mead::{LARGEST_SIZE, NelderMead};
use super::population::Population;
use super::{Range, RangeError};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

/// How a global minimum is searched for (Pesce & Iwanicki 2015, course notes §3.3): by differential
/// evolution, and then by a local search from its best point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GlobalSettings {
    /// The differential evolution.
    pub evolution: DifferentialEvolution,
    /// The simplices after it; they begin no larger than the extent of the last individuals.
    pub simplex: NelderMead,
    /// The number of samples that a fit's first generations see; all, where there are not at least
    /// twice as many.
    pub first_rows: usize,
    /// The seed of random numbers.
    pub seed: u64,
}

/// The first samples were chosen by hand, unmeasured.
impl Default for GlobalSettings {
    fn default() -> GlobalSettings {
        GlobalSettings {
            evolution: DifferentialEvolution::default(),
            simplex: NelderMead::default(),
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
        let mut population = Population::new(&self.evolution, ranges, self.seed)?;
        population.evolve(&mut |points, _, values| {
            values.par_iter_mut().enumerate().for_each(|(individual, value)| {
                *value = f(&points[individual * ranges.len()..][..ranges.len()]);
            });
        });
        let refined = self.refine(&population, population.best_position(), &mut |point| f(point));
        Ok(Minimum { evaluations: population.evaluations + refined.evaluations, ..refined })
    }

    /// Searches with simplices from a position, the first no larger than the individuals' extent.
    pub(super) fn refine(
        &self,
        population: &Population,
        position: &[f64],
        f: &mut dyn FnMut(&[f64]) -> f64,
    ) -> Minimum {
        let size = self.simplex.size.min(LARGEST_SIZE);
        let step = |(axis, range): (usize, &Range)| {
            let width = range.width();
            population.extent(axis).clamp(FINEST.min(size) * width, size * width)
        };
        let steps: Vec<f64> = population.ranges().iter().enumerate().map(step).collect();
        let rng = ChaCha8Rng::seed_from_u64(self.seed);
        self.simplex.minimise_with(position, &steps, population.ranges(), rng, f)
    }
}

/// The least size of the simplex after a differential evolution, as a share of each range. By hand,
/// unmeasured.
const FINEST: f64 = 1e-3;
