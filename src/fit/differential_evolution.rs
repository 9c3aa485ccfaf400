//! Differential evolution: the minimum of any function within ranges.

use super::population::Population;
use super::{Range, RangeError};
use rayon::prelude::*;

/// Where a mutation starts from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Strategy {
    /// A random individual: `DE/rand/1/bin`.
    #[default]
    Rand1Bin,
    /// The best individual: `DE/best/1/bin`, faster and more easily caught in a local minimum.
    Best1Bin,
}

/// What becomes of a coordinate that a mutation takes out of its range.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Outside {
    /// It is drawn anew within the range.
    #[default]
    Reinitialise,
    /// It is set to the bound that it passed, so that minima on bounds are met exactly.
    Clamp,
}

/// How the first individuals are spread.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Start {
    /// A Latin hypercube: each of as many slices of each range as there are individuals has one
    /// (McKay, Beckman & Conover 1979).
    #[default]
    LatinHypercube,
    /// Independent random points.
    Random,
}

/// Differential evolution (Storn & Price 1997; Pesce & Iwanicki 2015, course notes §3.2.1).
///
/// Each generation tries one point for every individual `x`: a coordinate of it is that of
/// `a + weight·(b − c)`, with `b`, `c` and, as the strategy has it, `a` other individuals at random,
/// or else that of `x`. The point takes the place of `x` unless its value is larger.
///
/// ```
/// use lgp::fit::{DifferentialEvolution, Range, Scale};
///
/// let wavy = |x: &[f64]| x.iter().map(|x| x * x - (18.0 * x).cos()).sum::<f64>();
/// let ranges = [Range::new(-5.0, 5.0, Scale::Linear)?; 2];
/// let minimum = DifferentialEvolution::default().minimise(&ranges, 1, wavy)?;
/// assert!((minimum.value + 2.0).abs() < 1e-6);
/// # Ok::<(), lgp::fit::RangeError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DifferentialEvolution {
    /// Where mutations start from.
    pub strategy: Strategy,
    /// Each generation's weight is drawn between these (dithering), or is both if they are equal.
    pub weights: [f64; 2],
    /// The probability that a coordinate is the mutation's; one at random always is.
    pub crossover: f64,
    /// What becomes of coordinates outside their ranges.
    pub outside: Outside,
    /// How the first individuals are spread.
    pub start: Start,
    /// The number of individuals, four or more; none for the smaller of 40 and ten for each
    /// coordinate.
    pub individuals: Option<usize>,
    /// The search has converged if the largest value exceeds the least by no more than this share
    /// of the least. None to go on, where many values are equal far from the minimum.
    pub value_spread: Option<f64>,
    /// The search has converged if all individuals are within this share of each range. None to go
    /// on.
    pub point_spread: Option<f64>,
    /// The most evaluations of the function; the first individuals are evaluated in any case.
    pub max_evaluations: u64,
}

/// The weights, the crossover and the number of individuals are the course notes', the weights
/// dithered as there. The rest was chosen by hand, unmeasured.
impl Default for DifferentialEvolution {
    fn default() -> DifferentialEvolution {
        DifferentialEvolution {
            strategy: Strategy::Rand1Bin,
            weights: [0.5, 1.0],
            crossover: 0.5,
            outside: Outside::Reinitialise,
            start: Start::LatinHypercube,
            individuals: None,
            value_spread: Some(1e-8),
            point_spread: Some(1e-6),
            max_evaluations: 20_000,
        }
    }
}

/// Why a search for a minimum ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// All values were nearly equal.
    ValuesAgree,
    /// All points were nearly equal.
    PointsAgree,
    /// As many evaluations were made as were allowed.
    Evaluations,
    /// The fit's deadline passed ([`crate::fit::Fitter::deadline`]).
    Deadline,
}

/// The least value that was found.
#[derive(Clone, Debug, PartialEq)]
pub struct Minimum {
    /// The point, one coordinate a range.
    pub at: Vec<f64>,
    /// The function's value there; infinite if it was finite nowhere.
    pub value: f64,
    /// The number of evaluations of the function.
    pub evaluations: u64,
    /// Why the search ended.
    pub end: End,
}

impl DifferentialEvolution {
    /// Minimises a function of one coordinate a range. Values that are NaN count as infinite. The
    /// same settings, ranges and seed give the same minimum.
    ///
    /// Returns an error if a range is not finite.
    pub fn minimise(
        &self,
        ranges: &[Range],
        seed: u64,
        mut f: impl FnMut(&[f64]) -> f64,
    ) -> Result<Minimum, RangeError> {
        self.minimise_by(ranges, seed, &mut |points, values| {
            for (individual, value) in values.iter_mut().enumerate() {
                *value = f(&points[individual * ranges.len()..][..ranges.len()]);
            }
        })
    }

    /// As [`DifferentialEvolution::minimise`], and with the same result, but evaluates a
    /// generation's points in parallel.
    pub fn minimise_in_parallel(
        &self,
        ranges: &[Range],
        seed: u64,
        f: impl Fn(&[f64]) -> f64 + Sync,
    ) -> Result<Minimum, RangeError> {
        self.minimise_by(ranges, seed, &mut |points, values| {
            values.par_iter_mut().enumerate().for_each(|(individual, value)| {
                *value = f(&points[individual * ranges.len()..][..ranges.len()]);
            });
        })
    }

    fn minimise_by(
        &self,
        ranges: &[Range],
        seed: u64,
        evaluate: &mut dyn FnMut(&[f64], &mut [f64]),
    ) -> Result<Minimum, RangeError> {
        let mut population = Population::new(self, ranges, seed, 0)?;
        let mut all = |points: &[f64], _: &[f64], values: &mut [f64]| evaluate(points, values);
        let end = population.evolve(&mut all);
        let (at, value) = (population.best_point(), population.best_value());
        Ok(Minimum { at, value, evaluations: population.evaluations, end })
    }
}
