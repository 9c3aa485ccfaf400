//! Rounding of constants to few digits.

use super::rounding::Comparison;
use super::{Fitter, Stop};
use crate::eval::Samples;
use crate::program::Draft;

/// The fit by which the others make up for a rounded constant. Chosen by hand, unmeasured.
const MAKE_UP: Stop = Stop { max_steps: 6, min_gain: 1e-4 };

const NOTHING: Stop = Stop { max_steps: 0, min_gain: 0.0 };

/// The number of digits beyond which an `f32` constant is left as it is.
pub(super) const MAX_DIGITS: usize = 7;

/// Rounds the constants one after the other, each to 0 or to the fewest decimal digits with which
/// the sum of squares, the remaining constants fitted again, stays within `(1 + allowance)` times
/// what it was, or below the data's own rounding. Returns the sum of squares.
///
/// # Panics
/// As [`Fitter::fit`].
pub fn shorten(fitter: &mut Fitter, draft: &mut Draft, samples: &Samples, allowance: f64) -> f64 {
    shorten_free(fitter, draft, samples, allowance, |_| true)
}

/// As [`shorten`], but rounds only the constants whose index is free.
pub(crate) fn shorten_free(
    fitter: &mut Fitter,
    draft: &mut Draft,
    samples: &Samples,
    allowance: f64,
    is_free: impl Fn(usize) -> bool,
) -> f64 {
    let mut loss = fitter.fit(draft, samples, NOTHING);
    let mut comparison = Comparison::by_squares(samples);
    let limit = comparison.error(fitter, draft) * (1.0 + allowance);
    let free: Vec<usize> = (0..draft.consts.len()).filter(|&i| is_free(i)).collect();
    let order = simplest_first(free, limit, draft, |trial| match fitter.is_cut(samples) {
        true => f64::INFINITY,
        false => comparison.error(fitter, trial),
    });
    let mut trial = draft.clone();
    for (place, &constant) in order.iter().enumerate() {
        let later = &order[place + 1..];
        for digits in 0..=MAX_DIGITS {
            if fitter.is_cut(samples) {
                return loss;
            }
            trial.copy_from(draft);
            trial.consts[constant] = rounded(draft.consts[constant], digits);
            // The loss of a constant that is nearly 0 needs no making up for.
            let stop = if digits == 0 { NOTHING } else { MAKE_UP };
            let trial_loss = fitter.fit_free(&mut trial, samples, stop, |i| later.contains(&i));
            if comparison.error(fitter, &trial) <= limit {
                draft.copy_from(&trial);
                loss = trial_loss;
                break;
            }
        }
    }
    loss
}

/// Orders constants, those first that are nearly numbers of one digit and may become them: or one
/// that is nearly 1 would stay so to make up for a third that was cut off.
fn simplest_first(
    mut constants: Vec<usize>,
    limit: f64,
    draft: &Draft,
    mut error: impl FnMut(&Draft) -> f64,
) -> Vec<usize> {
    let mut trial = draft.clone();
    let mut is_simple = |constant: usize| {
        let value = draft.consts[constant];
        let simple = rounded(value, 1);
        if (simple - value).abs() > NEARLY * value.abs() {
            return false;
        }
        trial.consts[constant] = simple;
        let is_enough = error(&trial) <= limit;
        trial.consts[constant] = value;
        is_enough
    };
    constants.sort_by_cached_key(|&constant| !is_simple(constant));
    constants
}

/// The share by which a fitted constant may differ from a law's. Chosen by hand, unmeasured.
const NEARLY: f32 = 1e-5;

/// Returns the value rounded to `digits` significant decimal digits; 0 for none.
pub(super) fn rounded(value: f32, digits: usize) -> f32 {
    if digits == 0 {
        return 0.0;
    }
    format!("{value:.*e}", digits - 1).parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dataset::Split;
    use crate::program::{Names, parse};

    #[test]
    fn rounding_keeps_the_digits_asked_for() {
        assert_eq!(rounded(6.9823, 1), 7.0);
        assert_eq!(rounded(-0.012345, 2), -0.012);
        assert_eq!(rounded(0.0, 3), 0.0);
        assert_eq!(rounded(5e-26, 0), 0.0);
        assert_eq!(rounded(9.99e-40, 1), 1e-39);
    }

    #[test]
    fn constants_become_short_and_errors_stay() {
        let xs: Vec<f32> = (0..100).map(|i| i as f32 / 99.0).collect();
        let ys = xs.iter().map(|x| (2.0137 * x).sin() + 0.01 * (40.0 * x).sin()).collect();
        let split = Split { columns: vec![xs, ys], ..Split::default() };
        let samples = Samples::new(&split, 1);
        let names = Names::new(["x"], ["y"]);
        let mut draft = parse("y = sin(2*x) + 0.1*x^2 - 3", &names).unwrap().into_draft();
        let mut fitter = Fitter::default();
        let stop = Stop { max_steps: 100, min_gain: 1e-9 };
        let fitted = fitter.fit(&mut draft, &samples, stop);
        let digits =
            |draft: &Draft| draft.consts.iter().map(|c| format!("{c}").len()).sum::<usize>();
        let before = digits(&draft);
        let shortened = shorten(&mut fitter, &mut draft, &samples, 0.01);
        assert!(shortened <= fitted * 1.01, "{fitted} {shortened}");
        assert!(digits(&draft) * 2 < before, "{before} {:?}", draft.consts);
    }

    #[test]
    fn what_is_nearly_one_is_one() {
        let xs: Vec<f32> = (0..100).map(|i| i as f32 / 99.0).collect();
        let ys = xs.iter().map(|&x| (f64::from(x) / (1.0 - f64::from(x) / 3.0)) as f32).collect();
        let split = Split { columns: vec![xs, ys], ..Split::default() };
        let samples = Samples::new(&split, 1);
        let names = Names::new(["x"], ["y"]);
        for text in ["y = x/(1.0000001 - 0.3333333*x)", "y = x/(0.9999999 - x*0.3333334)"] {
            let mut draft = parse(text, &names).unwrap().into_draft();
            shorten(&mut Fitter::default(), &mut draft, &samples, 0.0);
            assert!(draft.consts.contains(&1.0), "{:?}", draft.consts);
        }
    }

    #[test]
    fn digits_below_the_data_s_rounding_are_none() {
        let xs: Vec<f32> = (0..100).map(|i| i as f32 / 99.0).collect();
        let ys = xs.iter().map(|x| 2.5 * x - 0.75).collect();
        let zeros = vec![0.0; 100];
        let split = Split { columns: vec![xs, ys, zeros], ..Split::default() };
        let samples = Samples::new(&split, 1);
        let names = Names::new(["x"], ["y", "z"]);
        let text = "y = 2.5000002*x - 0.75000024; z = 5e-26";
        let mut draft = parse(text, &names).unwrap().into_draft();
        shorten(&mut Fitter::default(), &mut draft, &samples, 0.0);
        assert_eq!(draft.consts, [2.5, 0.75, 0.0]);
    }
}
