//! Nelder and Mead's simplex: a minimum near a point, without derivatives.

use super::Range;
use super::differential_evolution::{End, Minimum};
use super::simplex::Simplex;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use std::cell::Cell;

/// The simplex method (Nelder & Mead 1965; Pesce & Iwanicki 2015, course notes §3.2.2), with
/// restarts.
///
/// ```
/// use lgp::fit::{NelderMead, Range};
///
/// let valley = |x: &[f64]| 100.0 * (x[1] - x[0] * x[0]).powi(2) + (1.0 - x[0]).powi(2);
/// let minimum = NelderMead::default().minimise(&[-1.2, 1.0], &[Range::ANY; 2], 1, valley);
/// assert!((minimum.at[0] - 1.0).abs() < 1e-4 && (minimum.at[1] - 1.0).abs() < 1e-4);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NelderMead {
    /// The size of a new simplex, as a share of each range on its scale; of an infinite range, as a
    /// share of the start's coordinate, or of 1 at 0. Half a range is the most.
    pub size: f64,
    /// The simplex is small once it has shrunk to this share of its first size.
    pub shrinkage: f64,
    /// The most new simplices around the centroid of a small one. The first that gains next to
    /// nothing is the last.
    pub restarts: u32,
    /// The most evaluations of the function from one start; a step that has begun ends.
    pub max_evaluations: u64,
}

/// The least gain of a restart, as a share of the value, after which there is another. By hand,
/// unmeasured.
const MIN_GAIN: f64 = 1e-9;

/// By hand, unmeasured.
impl Default for NelderMead {
    fn default() -> NelderMead {
        NelderMead { size: 0.1, shrinkage: 1e-7, restarts: 10, max_evaluations: 10_000 }
    }
}

impl NelderMead {
    /// Minimises a function of one coordinate a range from a start. Coordinates stay within their
    /// ranges by being clamped to them. Values that are NaN count as infinite.
    ///
    /// # Panics
    /// If the start has not as many coordinates as there are ranges.
    pub fn minimise(
        &self,
        start: &[f64],
        ranges: &[Range],
        seed: u64,
        mut f: impl FnMut(&[f64]) -> f64,
    ) -> Minimum {
        self.minimise_on(0, start, ranges, seed, &mut f)
    }

    /// Minimises from each of several starts, in parallel, and returns the least minimum; of equal
    /// ones the first. Its evaluations are those from all starts.
    ///
    /// # Panics
    /// As [`NelderMead::minimise`]; if there is no start.
    pub fn minimise_from(
        &self,
        starts: &[Vec<f64>],
        ranges: &[Range],
        seed: u64,
        f: impl Fn(&[f64]) -> f64 + Sync,
    ) -> Minimum {
        let from = |(stream, start): (usize, &Vec<f64>)| {
            self.minimise_on(stream as u64, start, ranges, seed, &mut |point| f(point))
        };
        let minima: Vec<Minimum> = starts.par_iter().enumerate().map(from).collect();
        let evaluations = minima.iter().map(|minimum| minimum.evaluations).sum();
        let least = minima.into_iter().min_by(|a, b| a.value.total_cmp(&b.value));
        Minimum { evaluations, ..least.expect("at least one start") }
    }

    /// As [`NelderMead::minimise`], with a stream of random numbers of one's own.
    fn minimise_on(
        &self,
        stream: u64,
        start: &[f64],
        ranges: &[Range],
        seed: u64,
        f: &mut dyn FnMut(&[f64]) -> f64,
    ) -> Minimum {
        assert_eq!(start.len(), ranges.len(), "a coordinate for each range");
        let along = || ranges.iter().zip(start);
        let at: Vec<f64> = along().map(|(range, value)| range.position(*value)).collect();
        let size = self.size.min(LARGEST_SIZE);
        let steps = ranges.iter().zip(&at).map(|(range, at)| range.step(*at, size));
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        rng.set_stream(stream);
        self.minimise_with(&at, &steps.collect::<Vec<f64>>(), ranges, rng, f)
    }

    /// As [`NelderMead::minimise`], from a position on the ranges' scales, with given first steps.
    pub(super) fn minimise_with(
        &self,
        start: &[f64],
        steps: &[f64],
        ranges: &[Range],
        mut rng: ChaCha8Rng,
        f: &mut dyn FnMut(&[f64]) -> f64,
    ) -> Minimum {
        let evaluations = Cell::new(0);
        let mut point = vec![0.0; ranges.len()];
        let mut evaluate = |position: &[f64]| {
            for ((to, range), position) in point.iter_mut().zip(ranges).zip(position) {
                *to = range.value(*position);
            }
            evaluations.set(evaluations.get() + 1);
            let value = f(&point);
            if value.is_nan() { f64::INFINITY } else { value }
        };
        let (mut centre, mut value) = (start.to_vec(), evaluate(start));
        let (mut best, mut least) = (centre.clone(), value);
        let mut end = End::PointsAgree;
        for restart in 0..=self.restarts {
            if restart > 0 {
                value = evaluate(&centre);
            }
            let mut simplex =
                Simplex::around((&centre, value), steps, ranges, &mut rng, &mut evaluate);
            while end == End::PointsAgree && !simplex.is_within(self.shrinkage, steps) {
                match evaluations.get() < self.max_evaluations {
                    true => simplex.step(ranges, &mut evaluate),
                    false => end = End::Evaluations,
                }
            }
            let (at, found) = simplex.best();
            let gain = least - found;
            if found < least {
                (best, least) = (at.to_vec(), found);
            }
            // Infinite values have no difference: the next simplex may lead away from them.
            if end == End::Evaluations || gain <= MIN_GAIN * found.abs() {
                break;
            }
            centre = simplex.centroid();
        }
        let at = ranges.iter().zip(&best).map(|(range, at)| range.value(*at)).collect();
        Minimum { at, value: least, evaluations: evaluations.get(), end }
    }
}

/// The largest share of a range that fits within it on one side of any point.
pub(super) const LARGEST_SIZE: f64 = 0.5;
