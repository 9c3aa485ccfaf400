//! The fit of a user's own model: some constants free, within bounds, from several starts.

use super::rounding::Comparison;
use super::within::{fit_within, rounded_within};
use super::{Fitter, Measure, Parameter, Scale};
use crate::eval::Samples;
use crate::program::Draft;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// What fits from several starts came to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LocalFit {
    /// The loss of the best: the weighted sum of squares, or for [`Measure::Max`] the largest
    /// error. Not finite if the model is finite on all samples from no start.
    pub loss: f64,
    /// The number of starts.
    pub starts: u32,
    /// The number of starts that ended no more than a thousandth above the best, or within the
    /// data's rounding.
    pub reached: u32,
    /// True if the loss is within the data's rounding, so that no fit is better.
    pub is_exact: bool,
}

/// The share above the best loss up to which another counts as the same. By hand: waves of wrong
/// frequencies hardly explain anything, and their losses differ by a hundredth.
const SAME: f64 = 1e-3;

/// The least share of starts that must reach the best loss, as one in so many. By hand, unmeasured.
const ONE_IN: u32 = 4;

impl LocalFit {
    /// Returns true if fewer than a quarter of the starts reached the best loss: then it is likely
    /// that there is a better one which none has reached.
    pub fn starts_disagree(&self) -> bool {
        !self.is_exact && self.reached.saturating_mul(ONE_IN) < self.starts
    }
}

/// Fits the parameters of effective code, all other constants keeping their values, from several
/// starts, and keeps the best fit.
///
/// The first start is the program's constants. Others are drawn within the bounds, on the
/// parameter's scale, or, if a bound is infinite, up to three octaves from the program's, of either
/// sign. A parameter that would leave its bounds is held at the one that it meets, and the others
/// are fitted again. Except for [`Measure::Max`], digits below the data's own rounding are removed.
///
/// # Panics
/// As [`Fitter::fit`]; if a parameter is not in the constant table, or its bounds are out of order.
pub fn fit_model(
    program: &mut Draft,
    samples: &Samples,
    parameters: &[Parameter],
    measure: Measure,
    starts: u32,
    seed: u64,
) -> LocalFit {
    let mut fitter = Fitter::default();
    let mut comparison = Comparison::by(measure, samples);
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let first = program.clone();
    let (mut loss, mut ends) = (f64::INFINITY, Vec::new());
    for start in 0..starts.max(1) {
        let mut trial = first.clone();
        if start > 0 {
            for parameter in parameters {
                let value = &mut trial.consts[parameter.index];
                *value = drawn(&mut rng, *value, parameter);
            }
        }
        let trial_loss = fit_within(&mut fitter, &mut trial, samples, parameters, measure);
        ends.push(comparison.error(&mut fitter, &trial));
        if trial_loss < loss {
            loss = trial_loss;
            program.copy_from(&trial);
        }
    }
    if measure != Measure::Max && loss.is_finite() {
        loss = rounded_within(&mut fitter, program, samples, parameters).unwrap_or(loss);
    }
    let best = ends.iter().copied().fold(f64::INFINITY, f64::min);
    let is_best = |end: &&f64| end.is_finite() && **end <= best * (1.0 + SAME);
    let reached = ends.iter().filter(is_best).count() as u32;
    LocalFit { loss, starts: ends.len() as u32, reached, is_exact: comparison.is_rounding(best) }
}

fn drawn(rng: &mut ChaCha8Rng, value: f32, parameter: &Parameter) -> f32 {
    let [low, high] = parameter.bounds;
    if low.is_finite() && high.is_finite() {
        let share = rng.random::<f32>();
        let between = |low: f32, high: f32| low + (high - low) * share;
        return match parameter.scale {
            Scale::Linear => between(low, high),
            Scale::Logarithmic => between(low.log2(), high.log2()).exp2().clamp(low, high),
        };
    }
    let sign = if rng.random_range(0..4) == 0 { -1.0 } else { 1.0 };
    let away = value.abs().max(1e-3) * rng.random_range(-3.0f32..3.0).exp2();
    (value.signum() * sign * away).clamp(low, high)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dataset::Split;
    use crate::program::{Names, Scope, parse_template};

    fn fitted(
        template: &str,
        f: fn(f32) -> f32,
        bounds: [f32; 2],
        measure: Measure,
    ) -> (f64, Draft) {
        let xs: Vec<f32> = (0..200).map(|i| (i as f32 + 0.5) / 200.0).collect();
        let ys = xs.iter().map(|&x| f(x)).collect();
        let split = Split { columns: vec![xs, ys], ..Split::default() };
        let names = Names::new(["x"], ["y"]);
        let parsed = parse_template(template, Scope::Dataset(&names)).unwrap();
        let parameter = |index: u16| Parameter { bounds, ..Parameter::unbounded(index.into()) };
        let parameters: Vec<Parameter> =
            parsed.free.iter().map(|free| parameter(free.index)).collect();
        let mut draft = parsed.program.into_draft();
        let samples = Measure::Rmse.all_samples(&split, 1, &[1.0]);
        let fitted = fit_model(&mut draft, &samples, &parameters, measure, 20, 1);
        (fitted.loss, draft)
    }

    const ANY: [f32; 2] = [f32::NEG_INFINITY, f32::INFINITY];

    #[test]
    fn several_starts_find_the_frequency_that_one_misses() {
        let (loss, draft) =
            fitted("y = sin($a*x)", |x| (23.0 * x).sin(), [0.0, 40.0], Measure::Rmse);
        assert!(loss < 1e-6, "{loss} {:?}", draft.consts);
    }

    #[test]
    fn a_law_s_constants_are_found_to_the_digit() {
        let (_, draft) = fitted("y = $a*x + $b", |x| 2.5 * x - 0.75, ANY, Measure::Rmse);
        assert_eq!(draft.consts, [2.5, -0.75]);
        let (_, draft) = fitted("y = $a*x + $b", |x| 2.5 * x, ANY, Measure::Rmse);
        assert_eq!(draft.consts, [2.5, 0.0]);
    }

    #[test]
    fn a_bound_holds_and_the_others_make_up_for_it() {
        let (_, draft) = fitted("y = $a*x + $b", |x| 3.0 * x + 1.0, [0.0, 2.0], Measure::Rmse);
        assert_eq!(draft.consts[0], 2.0);
        // The least-squares intercept of 3x + 1 − 2x on [0, 1]: its mean.
        assert!((draft.consts[1] - 1.5).abs() < 1e-4, "{:?}", draft.consts);
    }

    #[test]
    fn the_least_maximum_error_is_chebyshevs() {
        // x² on [0, 1] by a line: x − 1/8, which errs by 1/8 (here on 200 midpoints).
        let (error, draft) = fitted("y = $a*x + $b", |x| x * x, ANY, Measure::Max);
        assert!((error - 0.125).abs() < 2e-3, "{error} {:?}", draft.consts);
    }
}
