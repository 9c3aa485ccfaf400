//! Derivatives against finite differences, and fits whose answer is known.

use lgp::dataset::Split;
use lgp::eval::{Samples, Tape};
use lgp::fit::{Differentiated, Fitter, Rounds, Stop, minimax_free};
use lgp::op::Op;
use lgp::program::{Arg, Draft, Names, Program, Scope, parse_template};

const TO_CONVERGENCE: Stop = Stop { max_steps: 200, min_gain: 1e-12 };

/// The derivatives of every output by every constant at one sample.
fn derivatives(program: &Program, inputs: &[f32]) -> Vec<Vec<f64>> {
    let mut differentiated = Differentiated::default();
    differentiated.assign(program);
    let values = differentiated.program.evaluate(inputs);
    let mut table = vec![vec![0.0; program.consts.len()]; program.outputs.len()];
    for (o, entries) in differentiated.jacobian.entries.iter().enumerate() {
        for &(parameter, output) in entries {
            table[o][usize::from(parameter)] = f64::from(values[usize::from(output)]);
        }
    }
    table
}

#[test]
fn every_operation_has_the_derivative_that_finite_differences_show() {
    for &op in Op::ALL {
        for place in 0..op.arity() {
            for x in [0.3f32, 0.7, -0.4] {
                let mut draft = Draft { inputs: 0, ..Draft::default() };
                let mut args: Vec<Arg> =
                    [0.6, 0.35, 0.8, 0.45].iter().map(|&v| draft.constant(v)).collect();
                args[place] = draft.constant(x);
                let y = draft.push(op, &args);
                let y = draft.push(Op::Mul, &[y, y]); // the chain rule, too
                draft.outputs = vec![y];
                let at = |value: f32| {
                    let mut draft = draft.clone();
                    draft.consts[4] = value;
                    f64::from(Program::verify(draft).unwrap().evaluate(&[])[0])
                };
                let h = 2f32.powi(-9);
                let numeric = (at(x + h) - at(x - h)) / f64::from(2.0 * h);
                if !numeric.is_finite() {
                    continue; // outside the operation's domain
                }
                let got = derivatives(&Program::verify(draft).unwrap(), &[])[0][4];
                let close = (got - numeric).abs() < 2e-3 * (1.0 + numeric.abs());
                assert!(close, "{op} by argument {place} at {x}: {got}, numerically {numeric}");
            }
        }
    }
}

/// Samples of `f` on a grid of the unit square.
fn square(f: impl Fn(f64, f64) -> f64) -> Samples {
    let points = (0..32).flat_map(|i| (0..32).map(move |j| (i, j)));
    let points: Vec<_> =
        points.map(|(i, j)| ((f64::from(i) + 0.5) / 32.0, (f64::from(j) + 0.5) / 32.0)).collect();
    let column =
        |f: &dyn Fn(f64, f64) -> f64| points.iter().map(|&(x, y)| f(x, y) as f32).collect();
    let columns = vec![column(&|x, _| x), column(&|_, y| y), column(&|x, y| f(x, y))];
    Samples::new(&Split { columns, ..Split::default() }, 2)
}

fn fit(text: &str, samples: &Samples) -> (f64, Vec<f32>) {
    let names = Names::new(["x", "y"], ["f"]);
    let mut draft = parse_template(text, Scope::Dataset(&names)).unwrap().program.into_draft();
    let loss = Fitter::default().fit(&mut draft, samples, TO_CONVERGENCE);
    (loss, draft.consts)
}

#[test]
fn a_linear_model_is_solved_in_closed_form() {
    let samples = square(|x, y| 3.0 - 2.0 * x + 0.5 * y);
    let (loss, constants) = fit("f = $a + $b*x + $c*y", &samples);
    assert!(loss < 1e-9, "{loss}");
    for (got, want) in constants.iter().zip([3.0, -2.0, 0.5]) {
        assert!((got - want).abs() < 1e-5, "{constants:?}");
    }
}

#[test]
fn a_nonlinear_model_finds_the_constants_that_made_the_data() {
    let samples = square(|x, y| 1.0 / (0.96 + 0.37 * x / (y + 0.1).powf(1.5)));
    let (loss, constants) = fit("f = rcp($a + $b*x/pow(y + 0.1, $c))", &samples);
    assert!(loss < 1e-7, "{loss}");
    // `0.1` is a constant of the text, and so is fitted, too: a, b, 0.1, c.
    for (got, want) in constants.iter().zip([0.96, 0.37, 0.1, 1.5]) {
        assert!((got - want).abs() < 1e-2, "{constants:?}");
    }
}

#[test]
fn constants_without_influence_stay_and_do_no_harm() {
    let samples = square(|x, _| 2.0 * x);
    let (loss, constants) = fit("f = $a*x + min($b, 0)*0", &samples);
    assert!(loss < 1e-9, "{loss} {constants:?}");
}

#[test]
fn what_is_not_finite_is_not_fitted() {
    let samples = square(|x, _| x);
    let (loss, constants) = fit("f = $a*log2(x - 2)", &samples);
    assert!(loss.is_nan());
    assert_eq!(constants[0], 1.0);
}

/// Chebyshev's alternation theorem, for rational functions Achieser's: e^x by (a + bx)/(1 + cx) on [−1, 1] has
/// four extreme errors of alternating signs, all as large.
#[test]
fn the_least_maximum_error_of_a_rational_function_alternates() {
    let xs: Vec<f32> = (-500..=500).map(|i| i as f32 / 500.0).collect();
    let ys = xs.iter().map(|x| x.exp()).collect();
    let samples = Samples::new(&Split { columns: vec![xs, ys], ..Split::default() }, 1);
    let names = Names::new(["x"], ["y"]);
    let template = parse_template("y = ($a + $b*x)/(1 + $c*x)", Scope::Dataset(&names)).unwrap();
    let mut draft = template.program.into_draft();
    let free = |index: usize| template.free.iter().any(|free| usize::from(free.index) == index);
    // Without a pole to begin with.
    (0..draft.consts.len()).filter(|&c| free(c)).for_each(|c| draft.consts[c] = 0.5);
    let mut fitter = Fitter::default();
    fitter.fit_free(&mut draft, &samples, TO_CONVERGENCE, free);
    let largest = minimax_free(&mut fitter, &mut draft, &samples, Rounds::TO_CONVERGENCE, free);
    let program = Program::verify(draft).unwrap();
    let values = fitter.evaluator.outputs(&Tape::new(&program), &samples);
    let errors = values[0].iter().zip(samples.targets(0)).map(|(f, y)| f64::from(f - y));
    let mut extremes: Vec<f64> = Vec::new();
    for error in errors {
        match extremes.last_mut() {
            Some(last) if last.signum() == error.signum() => {
                *last = if error.abs() > last.abs() { error } else { *last }
            }
            _ => extremes.push(error),
        }
    }
    assert_eq!(extremes.len(), 4, "{extremes:?}");
    assert!(extremes.iter().all(|e| (e.abs() / largest - 1.0).abs() < 1e-3), "{extremes:?}");
}

/// A sample that weighs four times as much errs half as much.
#[test]
fn weights_count_in_the_maximum() {
    let split = Split { columns: vec![vec![0.0, 1.0], vec![0.0, 3.0]], ..Split::default() };
    let mut samples = Samples::new(&split, 1);
    samples.set_weights(0, &[1.0, 4.0]);
    let mut draft = Draft { inputs: 1, ..Draft::default() };
    let y = draft.constant(0.1);
    draft.outputs = vec![y];
    let rounds = Rounds::TO_CONVERGENCE;
    let largest = minimax_free(&mut Fitter::default(), &mut draft, &samples, rounds, |_| true);
    // c and 2(3 − c) meet at 2.
    assert!((draft.consts[0] - 2.0).abs() < 1e-4 && (largest - 2.0).abs() < 1e-4, "{draft:?}");
}
