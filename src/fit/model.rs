//! The fit of a user's own model: some constants free, within bounds, from several starts.

use super::shorten::shorten_free;
use super::{Fitter, Measure, Rounds, Stop, minimax_free};
use crate::eval::Samples;
use crate::program::Draft;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// A constant to be fitted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameter {
    /// The index in the constant table.
    pub index: usize,
    /// The least and the greatest value; infinite if unbounded.
    pub bounds: [f32; 2],
}

/// The end of the fit from each start. Chosen by hand, unmeasured.
const TO_CONVERGENCE: Stop = Stop { max_steps: 500, min_gain: 1e-10 };

/// Fits the parameters of effective code, all other constants keeping their values. Returns the
/// loss of the best of `starts` fits: the weighted sum of squares, or for [`Measure::Max`] the
/// largest error.
///
/// The first start is the program's constants. Others are drawn within the bounds, or, if one is
/// infinite, up to three octaves from the program's, of either sign. A parameter that would leave
/// its bounds is held at the one that it meets, and the others are fitted again. Except for
/// [`Measure::Max`], digits below the data's own rounding are removed.
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
) -> f64 {
    let mut fitter = Fitter::default();
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let first = program.clone();
    let mut least = f64::INFINITY;
    for start in 0..starts.max(1) {
        let mut trial = first.clone();
        if start > 0 {
            for parameter in parameters {
                let value = &mut trial.consts[parameter.index];
                *value = drawn(&mut rng, *value, parameter.bounds);
            }
        }
        let loss = fit_within(&mut fitter, &mut trial, samples, parameters, measure);
        if loss < least {
            least = loss;
            program.copy_from(&trial);
        }
    }
    if measure != Measure::Max && least.is_finite() {
        least = rounded_within(&mut fitter, program, samples, parameters).unwrap_or(least);
    }
    least
}

/// Removes the parameters' digits below the data's rounding and returns the loss; changes nothing
/// and returns none if a parameter would leave its bounds.
fn rounded_within(
    fitter: &mut Fitter,
    program: &mut Draft,
    samples: &Samples,
    parameters: &[Parameter],
) -> Option<f64> {
    let mut short = program.clone();
    let is_free = |index: usize| parameters.iter().any(|parameter| parameter.index == index);
    let loss = shorten_free(fitter, &mut short, samples, 0.0, is_free);
    let is_within = |parameter: &Parameter| {
        let [low, high] = parameter.bounds;
        (low..=high).contains(&short.consts[parameter.index])
    };
    parameters.iter().all(is_within).then(|| {
        program.copy_from(&short);
        loss
    })
}

fn drawn(rng: &mut ChaCha8Rng, value: f32, [low, high]: [f32; 2]) -> f32 {
    if low.is_finite() && high.is_finite() {
        return low + (high - low) * rng.random::<f32>();
    }
    let sign = if rng.random_range(0..4) == 0 { -1.0 } else { 1.0 };
    let away = value.abs().max(1e-3) * rng.random_range(-3.0f32..3.0).exp2();
    (value.signum() * sign * away).clamp(low, high)
}

fn fit_within(
    fitter: &mut Fitter,
    program: &mut Draft,
    samples: &Samples,
    parameters: &[Parameter],
    measure: Measure,
) -> f64 {
    let mut free: Vec<Parameter> = parameters.to_vec();
    loop {
        let is_free = |index: usize| free.iter().any(|parameter| parameter.index == index);
        let mut loss = fitter.fit_free(program, samples, TO_CONVERGENCE, is_free);
        if measure == Measure::Max && loss.is_finite() {
            let rounds = Rounds::TO_CONVERGENCE;
            loss = minimax_free(fitter, program, samples, rounds, is_free);
        }
        let outside = free.iter().position(|parameter| {
            let [low, high] = parameter.bounds;
            !(low..=high).contains(&program.consts[parameter.index])
        });
        match outside {
            None => return loss,
            Some(at) => {
                let Parameter { index, bounds: [low, high] } = free.remove(at);
                program.consts[index] = program.consts[index].clamp(low, high);
            }
        }
    }
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
        let parameters: Vec<Parameter> =
            parsed.free.iter().map(|free| Parameter { index: free.index.into(), bounds }).collect();
        let mut draft = parsed.program.into_draft();
        let samples = Measure::Rmse.all_samples(&split, 1, &[1.0]);
        let loss = fit_model(&mut draft, &samples, &parameters, measure, 20, 1);
        (loss, draft)
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
