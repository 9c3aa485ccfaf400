//! Samples that become more as a global fit goes on.

use super::differential_evolution::End;
use super::objective::Objective;
use super::population::Population;
use crate::deadline::Deadline;
use crate::eval::Samples;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// The number of generations on some of the samples after which there are twice as many. By hand,
/// unmeasured.
const GENERATIONS: u32 = 10;

/// Samples in a random order, of which the first few are seen, then twice as many, then all: each
/// part holds the parts before it.
pub(super) struct GrowingRows<'a> {
    samples: &'a Samples,
    order: Vec<u32>,
    first: usize,
}

impl<'a> GrowingRows<'a> {
    /// Shuffles the samples; `first` of them are seen first, or all if they are not twice as many.
    pub fn new(samples: &'a Samples, first: usize, seed: u64) -> GrowingRows<'a> {
        let first = first.max(1);
        let mut rows = GrowingRows { samples, order: Vec::new(), first };
        if rows.part(first).is_some() {
            let mut rng = ChaCha8Rng::seed_from_u64(seed);
            rows.order = (0..samples.rows() as u32).collect();
            for place in (1..rows.order.len()).rev() {
                rows.order.swap(place, rng.random_range(0..=place));
            }
        }
        rows
    }

    /// Returns the size as one of a part; none if all samples are to be seen.
    fn part(&self, size: usize) -> Option<usize> {
        (size <= self.samples.rows() / 2).then_some(size)
    }

    /// Goes from generation to generation to the end, with more samples on the way. In the end, all
    /// values are those of all samples.
    pub fn evolve(
        &self,
        population: &mut Population,
        objective: &mut Objective,
        deadline: &Deadline,
    ) -> End {
        let mut size = self.part(self.first);
        let mut seen = self.select(size);
        population.assess(&mut objective.on(seen.as_ref().unwrap_or(self.samples)));
        let mut generations = 0;
        loop {
            let end = if deadline.is_past() { Some(End::Deadline) } else { population.end() };
            match (size, end) {
                (None, Some(end)) => return end,
                (Some(now), end) if end.is_some() || generations == GENERATIONS => {
                    let is_cut = matches!(end, Some(End::Evaluations | End::Deadline));
                    size = if is_cut { None } else { self.part(2 * now) };
                    seen = self.select(size);
                    population.assess(&mut objective.on(seen.as_ref().unwrap_or(self.samples)));
                    generations = 0;
                }
                _ => {
                    let samples = seen.as_ref().unwrap_or(self.samples);
                    population.generation(&mut objective.on(samples));
                    generations += 1;
                }
            }
        }
    }

    fn select(&self, size: Option<usize>) -> Option<Samples> {
        size.map(|size| self.samples.select(&self.order[..size]))
    }
}
