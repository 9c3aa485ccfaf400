//! Removal of constants that make no difference: summands, factors, exponents.

use super::rounding::Comparison;
use super::{Fitter, Stop};
use crate::eval::Samples;
use crate::program::{Arg, Draft};
use crate::simplify::Simplifier;

/// The fit by which the others make up for a dropped constant. Chosen by hand, unmeasured.
const MAKE_UP: Stop = Stop { max_steps: 6, min_gain: 1e-4 };

/// The multiple of the error allowed beyond which the others hardly make up for a constant.
const NEAR: f64 = 16.0;

/// Drops, one after the other, the constants without which the sum of squares, the others fitted
/// again, stays within `(1 + allowance)` times what it was, or below the data's own rounding. A
/// constant is dropped by making it a summand or factor of 0, or a factor, divisor or exponent of 1
/// or −1, and folding the program, which becomes smaller.
///
/// # Panics
/// As [`Fitter::fit`].
pub fn drop_negligible(fitter: &mut Fitter, draft: &mut Draft, samples: &Samples, allowance: f64) {
    let mut comparison = Comparison::by_squares(samples);
    let limit = comparison.error(fitter, draft) * (1.0 + allowance);
    drop_within(limit, draft, |trial| {
        if fitter.is_cut(samples) {
            return f64::INFINITY;
        }
        let error = comparison.error(fitter, trial);
        if error > limit && error < limit * NEAR {
            fitter.fit(trial, comparison.samples(), MAKE_UP);
            return comparison.error(fitter, trial);
        }
        error
    });
}

/// As [`drop_negligible`], but by the largest error, without fitting the other constants again.
///
/// # Panics
/// As [`Fitter::fit`].
pub fn drop_negligible_minimax(
    fitter: &mut Fitter,
    draft: &mut Draft,
    samples: &Samples,
    allowance: f64,
) {
    let mut comparison = Comparison::by_maximum(samples);
    let limit = comparison.error(fitter, draft) * (1.0 + allowance);
    drop_within(limit, draft, |trial| match fitter.is_cut(samples) {
        true => f64::INFINITY,
        false => comparison.error(fitter, trial),
    });
}

/// As [`drop_negligible`], or by the largest error, of what becomes of a child: its constants are
/// the first of the whole, whose others stay.
pub(crate) fn drop_negligible_in(
    fitter: &mut Fitter,
    child: &mut Draft,
    samples: &Samples,
    allowance: f64,
    by_maximum: bool,
    whole: impl Fn(&Draft) -> Draft,
) {
    let mut comparison = match by_maximum {
        true => Comparison::by_maximum(samples),
        false => Comparison::by_squares(samples),
    };
    let limit = comparison.error(fitter, &whole(child)) * (1.0 + allowance);
    drop_within(limit, child, |trial| {
        if fitter.is_cut(samples) {
            return f64::INFINITY;
        }
        let (mut formula, own) = (whole(trial), trial.consts.len());
        let error = comparison.error(fitter, &formula);
        if by_maximum || error <= limit || error >= limit * NEAR {
            return error;
        }
        fitter.fit_free(&mut formula, comparison.samples(), MAKE_UP, |i| i < own);
        trial.consts.copy_from_slice(&formula.consts[..own]);
        comparison.error(fitter, &formula)
    });
}

fn drop_within(limit: f64, draft: &mut Draft, mut error: impl FnMut(&mut Draft) -> f64) {
    if !limit.is_finite() {
        return;
    }
    let mut simplifier = Simplifier::default();
    let mut constant = 0;
    while constant < draft.consts.len() {
        let dropped = [0.0, 1.0, -1.0].into_iter().find_map(|value| {
            let mut trial = without(draft, constant, value, &mut simplifier)?;
            (error(&mut trial) <= limit).then_some(trial)
        });
        match dropped {
            // The next constant has this place now.
            Some(smaller) => *draft = smaller,
            None => constant += 1,
        }
    }
}

/// Returns the program with a constant set to a value and folded; none if that is not smaller.
fn without(
    draft: &Draft,
    constant: usize,
    value: f32,
    simplifier: &mut Simplifier,
) -> Option<Draft> {
    let mut trial = draft.clone();
    trial.consts[constant] = value;
    let mut folded = Draft::default();
    simplifier.fold_constants(&trial, &mut folded);
    (size(&folded) < size(draft)).then_some(folded)
}

/// Counts the instructions and the reads of constants.
fn size(draft: &Draft) -> usize {
    let args = draft.instrs.iter().flat_map(|instr| instr.args()).chain(&draft.outputs);
    draft.instrs.len() + args.filter(|arg| matches!(arg, Arg::Const(_))).count()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dataset::Split;
    use crate::program::{Names, Program, parse, print};

    fn dropped(text: &str, f: fn(f64, f64) -> f64) -> String {
        let points =
            (0..300).map(|i| (1.0 + f64::from(i) / 75.0, 1.0 + f64::from(i * 37 % 300) / 75.0));
        let (xs, ys): (Vec<f64>, Vec<f64>) = points.unzip();
        let single = |values: &[f64]| values.iter().map(|&x| x as f32).collect::<Vec<f32>>();
        let values: Vec<f64> = xs.iter().zip(&ys).map(|(&x, &y)| f(x, y)).collect();
        let split =
            Split { columns: vec![single(&xs), single(&ys), single(&values)], ..Split::default() };
        let names = Names::new(["x", "y"], ["f"]);
        let mut draft = parse(text, &names).unwrap().into_draft();
        let (mut fitter, samples) = (Fitter::default(), Samples::new(&split, 2));
        drop_negligible(&mut fitter, &mut draft, &samples, 0.0);
        print(&Program::verify(draft).unwrap(), &names)
    }

    #[test]
    fn what_is_below_the_data_s_rounding_is_dropped() {
        for (text, left) in [
            ("f = x*y - 8e-8", "f = x*y"),
            ("f = 0.99999994*(x*y)", "f = x*y"),
            ("f = (x + 2e-8)*y + 1e-9*exp2(x)", "f = x*y"),
            ("f = pow(x, 1.0000001)*y", "f = x*y"),
            ("f = x*y/1.0000001", "f = x*y"),
            ("f = 1e-8 - -1.0000001*(x*y)", "f = -(-(x*y))"),
        ] {
            let kept = dropped(text, |x, y| x * y);
            assert!(kept == left || kept == "f = x*y", "{text}: {kept}");
        }
        assert_eq!(dropped("f = sqrt(x*y + 2e-8)", |x, y| (x * y).sqrt()), "f = sqrt(x*y)");
        assert_eq!(dropped("f = 1.5*x + (y - 3e-8)", |x, y| 1.5 * x + y), "f = 1.5*x + y");
    }

    #[test]
    fn what_counts_stays() {
        let law = |x: f64, y: f64| x * y + 1e-4 * x - 0.5;
        assert_eq!(dropped("f = x*y + (0.0001*x - 0.5)", law), "f = x*y + (0.0001*x - 0.5)");
    }
}
