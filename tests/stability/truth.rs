//! Bounds on the error against a truth: never violated, and close where the truth is known.

use crate::sloppy::Sloppy;
use lgp::eval::{Arithmetic, Double};
use lgp::num::Interval;
use lgp::op::Op;
use lgp::program::{Arg, Draft, Names, Program, parse};
use lgp::stability::{ErrorBound, ErrorLimits, Rounding, Status, largest_error};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

fn program(text: &str, inputs: &[&str]) -> Program {
    parse(&format!("y = {text}"), &Names::new(inputs.iter().copied(), ["y"])).unwrap()
}

fn doubles(program: &Program) -> Vec<f64> {
    program.consts.iter().map(|&c| f64::from(c)).collect()
}

/// Inputs are `x`, then `r`.
fn bound(formula: &str, truth: &str, domain: &[[f32; 2]], rounding: Rounding) -> ErrorBound {
    let inputs = &["x", "r"][..domain.len()];
    let (formula, truth) = (program(formula, inputs), program(truth, inputs));
    let domain: Vec<Interval> = domain.iter().map(|&[a, b]| Interval::new(a, b)).collect();
    let limits = ErrorLimits::new(rounding);
    largest_error(&formula, (&truth, &doubles(&truth)), 0, &domain, &limits)
}

/// The largest error on a fine grid, the truth in `f64`.
fn on_a_grid(formula: &str, truth: &str, [low, high]: [f32; 2]) -> f64 {
    let (formula, truth) = (program(formula, &["x"]), program(truth, &["x"]));
    let consts = doubles(&truth);
    let step = f64::from(high - low) / 100_000.0;
    let errors = (0..=100_000).map(|i| {
        let x = ((f64::from(low) + f64::from(i) * step) as f32).clamp(low, high);
        (f64::from(formula.evaluate(&[x])[0]) - in_f64(&truth, &consts, &[x], 0.0).unwrap()).abs()
    });
    errors.fold(0.0, f64::max)
}

/// The output in `f64`, each result moved up by so many units in the last place; none if a result
/// is no number.
fn in_f64(program: &Program, consts: &[f64], input: &[f32], units: f64) -> Option<f64> {
    let mut results: Vec<f64> = Vec::new();
    let value = |arg: Arg, results: &[f64]| match arg {
        Arg::Input(i) => f64::from(input[usize::from(i)]),
        Arg::Const(i) => consts[usize::from(i)],
        Arg::Result(i) => results[usize::from(i)],
    };
    for instr in &program.instrs {
        let mut args = [0.0; 4];
        args.iter_mut().zip(instr.args()).for_each(|(to, &arg)| *to = value(arg, &results));
        let result = Double.apply(instr.op(), args);
        results.push(result + result.abs() * units * f64::EPSILON);
    }
    let numbers = results.iter().all(|x| x.is_finite());
    numbers.then(|| value(program.outputs[0], &results))
}

const HASTINGS: &str = "sqrt(1 - x)*(1.5707288 + x*(-0.2121144 + x*(0.0742610 - 0.0187293*x)))";

/// Formulas of one input, truths, domains: least maxima, refitted by an exchange algorithm where
/// they are not Hastings', "Approximations for Digital Computers", 1955.
const FITS: [(&str, &str, [f32; 2]); 9] = [
    (HASTINGS, "acos(x)", [0.0, 1.0]),
    (
        "x*(0.9998660 + x*x*(-0.3302995 + x*x*(0.1801410 + x*x*(-0.0851330 + x*x*0.0208351))))",
        "atan(x)",
        [0.0, 1.0],
    ),
    ("0.99989295 + x*(0.6964574 + x*(0.22433837 + x*0.07920424))", "exp2(x)", [0.0, 1.0]),
    (
        "1.0000037 + x*(0.6929661 + x*(0.24163845 + x*(0.051690358 + x*0.013697664)))",
        "exp2(x)",
        [0.0, 1.0],
    ),
    (
        "0.79118574*sqrt(x) + 0.28181344*sqrt(sqrt(x)) - 0.05274753*x - 0.02059902",
        "pow(x, 1/2.4)",
        [0.003, 1.0],
    ),
    ("x*(0.9996977 + x*x*(-0.16567502 + x*x*0.00751517))", "sin(x)", [0.0, 1.57]),
    ("max(x, 0.3)", "max(x, 0.3) + 1e-4*sin(10*x)", [0.0, 1.0]),
    ("abs(x - 0.3)", "sqrt((x - 0.3)^2 + 1e-6)", [-1.0, 1.0]),
    ("sqrt(x) + 1e-5*x", "sqrt(x)", [0.0, 1.0]),
];

#[test]
fn what_is_proved_is_close_to_what_is_seen() {
    for (formula, truth, domain) in FITS {
        let sampled = on_a_grid(formula, truth, domain);
        let exact = bound(formula, truth, &[domain], Rounding::Exact);
        assert!(exact.seen >= 0.999 * sampled, "{formula}: {exact:?}, but {sampled} on a grid");
        assert!(exact.proved >= sampled && exact.proved <= 1.02 * exact.seen, "{exact:?}");
        assert!(exact.boxes < 2000, "{formula}: {exact:?}");
        let gpu = bound(formula, truth, &[domain], Rounding::Gpu);
        assert!(gpu.proved >= exact.proved && gpu.proved <= 1.15 * gpu.seen, "{formula}: {gpu:?}");
    }
}

#[test]
fn hastings_claim_of_his_arc_cosine_holds() {
    let found = bound(HASTINGS, "acos(x)", &[[0.0, 1.0]], Rounding::Exact);
    assert_eq!(found.decided(6.8e-5), Status::Proved);
    // At 0 he has 1.5707288, and the truth is π/2.
    let off = std::f64::consts::FRAC_PI_2 - f64::from(1.570_728_8f32);
    assert!((found.seen - off).abs() < 1e-12, "{found:?}");
    let refuted = Status::Refuted { input: vec![0.0], value: 1.570_728_8 };
    assert_eq!(found.decided(6.75e-5), refuted);
    assert!(matches!(found.decided(0.5 * (found.seen + found.proved)), Status::Open { .. }));
}

#[test]
fn two_inputs_are_bounded_as_well() {
    let exponential = "0.9998791 + x*(-2.9906194 + x*(4.381189 + x*(-3.9363546 \
                       + x*(2.098059 - 0.5024867*x))))";
    let formula = format!("(1 - 0.5*r)*({exponential})");
    let unit = [0.0, 1.0];
    let found = bound(&formula, "exp(-3*x)*(1 - r/2)", &[unit, unit], Rounding::Exact);
    assert!(found.proved <= 1.02 * found.seen && found.proved < 1.25e-4, "{found:?}");
    let found = bound("max(x, r) + 0.4*min(x, r)", "sqrt(x*x + r*r)", &[unit, unit], Rounding::Gpu);
    assert!(found.proved <= 1.02 * found.seen && found.seen > 0.083, "{found:?}");
}

#[test]
fn constants_of_the_truth_are_those_given() {
    let (formula, truth) = (program("x*x + 0.25", &["x"]), program("0.5 + x*x*2", &["x"]));
    let consts: Vec<f64> =
        truth.consts.iter().map(|&c| if c == 0.5 { 0.25 } else { 1.0 }).collect();
    let limits = ErrorLimits::new(Rounding::Exact);
    let domain = [Interval::new(0.0, 1.0)];
    let found = largest_error(&formula, (&truth, &consts), 0, &domain, &limits);
    assert!(found.proved < 2e-7, "{found:?}");
}

#[test]
fn errors_of_the_order_of_rounding_say_so() {
    let found = bound("exp2(x)", "exp2(x)", &[[0.0, 1.0]], Rounding::Exact);
    assert!(found.seen < found.reach && found.proved <= 1.02 * found.reach, "{found:?}");
    assert!(found.proved < 2.0 * f64::from(f32::EPSILON) * 1.01, "{found:?}");
}

#[test]
fn no_value_is_infinitely_far_and_no_truth_is_a_gap() {
    let found = bound("sqrt(x - 0.5)", "x", &[[0.0, 1.0]], Rounding::Exact);
    assert!(found.seen == f64::INFINITY && found.value.is_nan() && found.at[0] < 0.5, "{found:?}");
    assert!(matches!(found.decided(1e9), Status::Refuted { .. }));
    let found = bound("1 - x*x/6", "sin(x)/x", &[[0.0, 1.0]], Rounding::Exact);
    assert_eq!((found.gap.as_deref(), found.gaps), (Some([0.0].as_slice()), 1));
    assert!(found.proved <= 1.02 * found.seen, "{found:?}");
    let found = bound("1", "log(x)", &[[-1.0, -0.5]], Rounding::Exact);
    assert!(found.proved == f64::INFINITY && found.at.is_empty(), "{found:?}");
}

#[test]
fn a_jump_between_branches_is_met() {
    let found = bound("x < 0.5 ? 0 : 1", "step(0.5, x)", &[[0.0, 1.0]], Rounding::Exact);
    assert_eq!((found.seen, found.proved), (0.0, found.reach));
    let found = bound("x <= 0.5 ? 0 : 1", "step(0.5, x)", &[[0.0, 1.0]], Rounding::Exact);
    assert_eq!((found.seen, found.at.as_slice()), (1.0, [0.5].as_slice()), "{found:?}");
}

/// Programs to try; `LGP_SOUNDNESS_PROGRAMS` sets another number.
fn programs() -> usize {
    let set = std::env::var("LGP_SOUNDNESS_PROGRAMS");
    set.ok().and_then(|n| n.parse().ok()).unwrap_or(2000)
}

const POINTS: usize = 24;

fn random_program(rng: &mut ChaCha8Rng, inputs: u16) -> Program {
    let mut draft = Draft { inputs: inputs.into(), ..Draft::default() };
    for value in [0.5, 2.0, 0.0, rng.random_range(-3.0..3.0)] {
        draft.constant(value);
    }
    for i in 0..rng.random_range(1..9) {
        let op = Op::ALL[rng.random_range(0..Op::ALL.len())];
        let mut arg = || match rng.random_range(0..7) {
            0 | 1 => Arg::Input(rng.random_range(0..inputs)),
            2 => Arg::Const(rng.random_range(0..4)),
            _ if i == 0 => Arg::Input(0),
            // Mostly chains: what nothing reads is not tried.
            3..5 => Arg::Result(i - 1),
            _ => Arg::Result(rng.random_range(0..i)),
        };
        let args = [arg(), arg(), arg(), arg()];
        draft.push(op, &args);
    }
    draft.outputs = vec![Arg::Result(draft.instrs.len() as u16 - 1)];
    Program::verify(draft).unwrap()
}

/// Of any width, at ordinary numbers, some of which are ends of the operations' domains.
fn random_side(rng: &mut ChaCha8Rng) -> Interval {
    let ends = [0.0, 1.0, -1.0, 0.5, 2.0];
    let at = match rng.random_bool(0.3) {
        true => ends[rng.random_range(0..ends.len())],
        false => rng.random_range(-2.0..2.0f32),
    };
    let width = 10f32.powf(rng.random_range(-7.0..0.5));
    if rng.random_bool(0.5) { Interval::new(at, at + width) } else { Interval::new(at - width, at) }
}

fn random_point(rng: &mut ChaCha8Rng, domain: &[Interval]) -> Vec<f32> {
    let coordinate = |side: &Interval| match rng.random_range(0..4) {
        0 => side.low(),
        1 => side.high(),
        _ => rng.random_range(side.low()..=side.high()),
    };
    domain.iter().map(coordinate).collect()
}

/// One box and no more, so that its bound is not hidden by that of a worse box.
#[test]
fn no_error_exceeds_what_is_proved() {
    let mut rng = ChaCha8Rng::seed_from_u64(11);
    let sloppy = Sloppy::new(5);
    let (mut bounded, mut close) = (0, 0);
    for _ in 0..programs() {
        let inputs = rng.random_range(1..4);
        let formula = random_program(&mut rng, inputs);
        let truth = match rng.random_bool(0.5) {
            true => formula.clone(),
            false => random_program(&mut rng, inputs),
        };
        let consts: Vec<f64> = doubles(&truth).iter().map(|c| c * 1.001 + 1e-9).collect();
        let domain: Vec<Interval> = (0..inputs).map(|_| random_side(&mut rng)).collect();
        for rounding in [Rounding::Exact, Rounding::Gpu] {
            let limits = ErrorLimits { rounding, ratio: 1.01, boxes: rng.random_range(1..4) };
            let found = largest_error(&formula, (&truth, &consts), 0, &domain, &limits);
            bounded += usize::from(found.proved.is_finite());
            close += usize::from(found.proved.is_finite() && found.proved <= 1.2 * found.seen);
            for _ in 0..POINTS {
                let input = random_point(&mut rng, &domain);
                let value = match rounding {
                    Rounding::Exact => formula.evaluate(&input)[0],
                    Rounding::Gpu => sloppy.evaluate(&formula, &input)[0],
                };
                let tried = [-1.0, 0.0, 1.0].map(|units| in_f64(&truth, &consts, &input, units));
                let [Some(below), Some(truth_value), Some(above)] = tried else { continue };
                // What `f64` itself may be off.
                let doubt = 16.0 * (below - truth_value).abs().max((above - truth_value).abs());
                let error = (f64::from(value) - truth_value).abs();
                let held = error <= found.proved * (1.0 + 1e-9) + doubt + 1e-300
                    || found.proved == f64::INFINITY;
                assert!(
                    held && (value.is_finite() || found.proved == f64::INFINITY),
                    "{rounding:?}: {value} at {input:?} of {domain:?} is {error} off {truth_value}, \
                     proved {found:?}\n{formula:?}\n{truth:?} with {consts:?}",
                );
            }
        }
    }
    // Otherwise nothing was tried.
    let runs = 2 * programs();
    assert!(bounded > runs / 4 && close > runs / 20, "{bounded} bounded, {close} close of {runs}");
}
