//! Importance sampling, with one distribution or several.

use super::Estimate;
use crate::num::CompensatedSum;

/// A way to draw points `X` with a known density.
pub struct Technique<'a, X, const D: usize> {
    /// Maps coordinates in [0, 1) to a point.
    pub sample: &'a dyn Fn([f64; D]) -> X,
    /// The density with which a point is drawn, in the measure of the integral.
    pub density: &'a dyn Fn(&X) -> f64,
}

/// Integrates `f` as the mean of `f(x) / density(x)` over points `x` of the technique, one for each
/// of `coordinates`: random numbers, or points of a low-discrepancy sequence. The density must not
/// be zero where `f` is not.
///
/// The error is the standard error of random coordinates; that of
/// low-discrepancy ones is usually far smaller. It is infinite with fewer than
/// two points.
pub fn importance<X, const D: usize>(
    technique: &Technique<X, D>,
    coordinates: impl IntoIterator<Item = [f64; D]>,
    f: impl Fn(&X) -> f64,
) -> Estimate {
    let mut mean = Mean::default();
    for coordinates in coordinates {
        let x = (technique.sample)(coordinates);
        mean.add(ratio(f(&x), (technique.density)(&x)));
    }
    Estimate::checked(mean.value(), mean.variance().sqrt(), mean.count)
}

/// Integrates `f` with points of several techniques at once, each with its coordinates, combined by
/// the balance heuristic: a point counts `f(x) / Σₖ nₖ densityₖ(x)`, whichever technique drew it
/// (Veach and Guibas, "Optimally Combining Sampling Techniques for Monte Carlo Rendering", 1995,
/// eq. 8, and theorem 1 for its variance). Unbiased if, wherever `f` is not zero, some density is
/// not. The error is that of [`importance`].
pub fn multiple_importance<X, const D: usize>(
    techniques: &[(Technique<X, D>, &[[f64; D]])],
    f: impl Fn(&X) -> f64,
) -> Estimate {
    let (mut value, mut variance) = (CompensatedSum::default(), CompensatedSum::default());
    let mut evaluations = 0;
    for (technique, coordinates) in techniques {
        let share = coordinates.len() as f64;
        let mut mean = Mean::default();
        for &coordinates in *coordinates {
            let x = (technique.sample)(coordinates);
            let weighted =
                techniques.iter().map(|(other, own)| own.len() as f64 * (other.density)(&x));
            mean.add(ratio(share * f(&x), weighted.sum()));
        }
        if mean.count > 0 {
            value += mean.value();
            variance += mean.variance();
            evaluations += mean.count;
        }
    }
    let error = if evaluations > 0 { variance.value().sqrt() } else { f64::INFINITY };
    Estimate::checked(value.value(), error, evaluations)
}

/// Returns zero if the integrand is zero, whatever the density.
fn ratio(value: f64, density: f64) -> f64 {
    if value == 0.0 { 0.0 } else { value / density }
}

/// Mean and variance of a stream (Welford, "Note on a method for calculating
/// corrected sums of squares and products", 1962).
#[derive(Default)]
struct Mean {
    count: usize,
    mean: f64,
    squares: f64,
}

impl Mean {
    fn add(&mut self, term: f64) {
        self.count += 1;
        let from_mean = term - self.mean;
        self.mean += from_mean / self.count as f64;
        self.squares += from_mean * (term - self.mean);
    }

    fn value(&self) -> f64 {
        self.mean
    }

    /// Returns the variance of the mean.
    fn variance(&self) -> f64 {
        let count = self.count as f64;
        if self.count < 2 { f64::INFINITY } else { self.squares / (count * (count - 1.0)) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::low_discrepancy::hammersley;
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    /// Uniform on [0, 1].
    const UNIFORM: Technique<f64, 1> = Technique { sample: &|[u]| u, density: &|_| 1.0 };
    /// Density 3x².
    const RISING: Technique<f64, 1> =
        Technique { sample: &|[u]| u.cbrt(), density: &|x| 3.0 * x * x };
    /// Density 2 on [0, 1/2] alone.
    const LEFT: Technique<f64, 1> =
        Technique { sample: &|[u]| 0.5 * u, density: &|&x| if x < 0.5 { 2.0 } else { 0.0 } };

    fn random(seed: u64, count: usize) -> Vec<[f64; 1]> {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        (0..count).map(|_| [rng.random()]).collect()
    }

    #[test]
    fn a_proportional_density_has_no_variance() {
        let found = importance(&RISING, random(1, 100), |x| 5.0 * x * x);
        assert!((found.value - 5.0 / 3.0).abs() < 1e-14 && found.error < 1e-14, "{found:?}");
        assert_eq!(found.evaluations, 100);
    }

    #[test]
    fn low_discrepancy_points_converge_faster() {
        let f = |x: &f64| (3.0 * x).sin();
        let exact = (1.0 - 3.0_f64.cos()) / 3.0;
        let count = 4096;
        let even = importance(&UNIFORM, (0..count).map(|i| hammersley::<1>(i, count)), f);
        let loose = importance(&UNIFORM, random(2, count as usize), f);
        assert!((even.value - exact).abs() < 0.05 * loose.error, "{even:?} {loose:?}");
    }

    #[test]
    fn the_standard_error_is_that_of_the_spread() {
        let spread: f64 = (0..200)
            .map(|seed| {
                let found = importance(&UNIFORM, random(seed, 50), |x| x * x);
                ((found.value - 1.0 / 3.0) / found.error).powi(2)
            })
            .sum();
        assert!((0.8..1.25).contains(&(spread / 200.0)), "{spread}");
    }

    #[test]
    fn several_distributions_are_unbiased_and_no_worse_than_the_balance_bound() {
        // LEFT alone would miss half of the integral.
        let f = |x: &f64| x.exp();
        let exact = 1.0_f64.exp() - 1.0;
        let mut mean = Mean::default();
        let mut stated = 0.0;
        for seed in 0..400 {
            let [a, b, c] = [(0, 40), (1, 25), (2, 10)].map(|(k, n)| random(3 * seed + k, n));
            let found =
                multiple_importance(&[(UNIFORM, &a[..]), (RISING, &b[..]), (LEFT, &c[..])], f);
            assert_eq!(found.evaluations, 75);
            stated += found.error * found.error / 400.0;
            mean.add(found.value);
        }
        let deviation = (mean.value() - exact) / mean.variance().sqrt();
        assert!(deviation.abs() < 3.0, "{deviation}");
        let seen = mean.variance() * 400.0;
        assert!((seen / stated - 1.0).abs() < 0.25, "{seen:e} {stated:e}");
    }

    #[test]
    fn one_distribution_is_importance_sampling() {
        let points = random(7, 30);
        let f = |x: &f64| x.sqrt();
        let [one, same] = [
            importance(&RISING, points.iter().copied(), f),
            multiple_importance(&[(RISING, &points[..])], f),
        ];
        assert!((one.value - same.value).abs() < 1e-14 && (one.error - same.error).abs() < 1e-14);
    }

    #[test]
    fn too_few_points_have_an_infinite_error() {
        assert_eq!(importance(&UNIFORM, random(1, 1), |x| *x).error, f64::INFINITY);
        assert_eq!(multiple_importance::<f64, 1>(&[], |x| *x).error, f64::INFINITY);
        let missed = importance(&LEFT, [[0.999], [0.5]], |x| if *x > 2.0 { 1.0 } else { 0.0 });
        assert_eq!(missed.value, 0.0);
    }
}
