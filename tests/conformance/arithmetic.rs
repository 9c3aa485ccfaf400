//! Double, half and interval arithmetic on the programs that the interpreter is tested on.

use crate::{HARD, random_program};
use half::f16;
use lgp::eval::{Arithmetic, Bounds, Double, Half};
use lgp::num::Interval;
use lgp::op::{Accuracy, Op};
use lgp::program::{Arg, Draft, Program};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

const ORDINARY: [f32; 11] = [-2.75, -1.0, -0.625, -0.0, 0.0, 0.125, 0.5, 0.75, 1.0, 1.5, 2.75];

/// Calls `check` with every operation on every choice of ordinary arguments.
fn each_on_ordinary_values(check: impl Fn(Op, [f32; 4])) {
    for &op in Op::ALL {
        for i in 0..ORDINARY.len().pow(op.arity() as u32) {
            let digit = |k: u32| i / ORDINARY.len().pow(k) % ORDINARY.len();
            check(op, std::array::from_fn(|k| ORDINARY[digit(k as u32)]));
        }
    }
}

#[test]
fn double_precision_is_the_reference_without_its_rounding() {
    each_on_ordinary_values(|op, args| {
        let single = f64::from(op.apply(args));
        let double = Double.apply(op, args.map(f64::from));
        // A quotient of sine and cosine, both rounded; everything else is closer.
        let tolerance = 1e-6 * single.abs().max(0.1);
        let same = single == double || (single.is_nan() && double.is_nan());
        assert!(same || (single - double).abs() < tolerance, "{op} {args:?}: {single} {double}");
    });
}

#[test]
fn half_precision_rounds_every_operation_once() {
    each_on_ordinary_values(|op, args| {
        let half = Half::default().apply(op, args.map(f16::from_f32));
        let double = Double.apply(op, args.map(f64::from));
        let exact = f16::from_f64(double);
        let allowed = match op.accuracy() {
            Accuracy::Exact => 0,
            // Rounded correctly to single precision, which is fine enough to be rounded again.
            Accuracy::Within(tolerance) if tolerance.ulps <= 0.5 => 0,
            Accuracy::Within(_) | Accuracy::InSteps => 1,
        };
        let apart = half.to_bits().abs_diff(exact.to_bits());
        let near_zero = (f64::from(half) - double).abs() < 1e-6;
        let same = half == exact || (half.is_nan() && exact.is_nan());
        assert!(same || apart <= allowed || near_zero, "{op} {args:?}: {half} {double}");
    });
}

#[test]
fn half_precision_is_that_of_the_half_crate() {
    type InHalves = fn(f16, f16) -> f16;
    let operations: [(Op, InHalves); 6] = [
        (Op::Add, |a, b| a + b),
        (Op::Sub, |a, b| a - b),
        (Op::Mul, |a, b| a * b),
        (Op::Div, |a, b| a / b),
        (Op::Neg, |a, _| -a),
        (Op::Rcp, |a, _| f16::ONE / a),
    ];
    let mut rng = ChaCha8Rng::seed_from_u64(7);
    for _ in 0..400_000 {
        let [a, b] = [0; 2].map(|_| f16::from_bits(rng.random()));
        for (op, in_halves) in operations {
            let (found, expected) = (Half::default().apply(op, [a, b, a, b]), in_halves(a, b));
            let same = found.to_bits() == expected.to_bits() || found.is_nan() && expected.is_nan();
            assert!(same, "{op} {a} {b}: {found}, not {expected}");
        }
    }
}

#[test]
fn half_precision_overflows_and_flushes_as_halves_do() {
    let (keep, flush) = (Half::default(), Half { flush_to_zero: true });
    let two =
        |op: Op, how: Half, a: f32, b: f32| how.apply(op, [a, b, 0.0, 0.0].map(f16::from_f32));
    assert!(two(Op::Mul, keep, 300.0, 300.0).is_infinite());
    assert_eq!(two(Op::Mul, keep, 1e-3, 1e-2).to_f32(), f16::from_f32(1e-5).to_f32());
    assert_eq!(two(Op::Mul, flush, -1e-3, 1e-2).to_bits(), 0x8000);
    assert_eq!(two(Op::Add, flush, 1e-5, 0.0).to_bits(), 0);
    assert_eq!(keep.constant(1e-5), f16::from_f32(1e-5));
    assert_eq!(flush.constant(1e-5).to_bits(), 0);
}

#[test]
fn bounds_of_a_point_hold_the_operation_and_little_else() {
    each_on_ordinary_values(|op, args| {
        let point = Bounds.apply(op, args.map(|x| Interval::new(x, x)));
        let value = f64::from(op.apply(args));
        assert!(point.contains(value), "{op} {args:?}: {value} outside {point:?}");
        let width = f64::from(point.high()) - f64::from(point.low());
        let at_a_jump = point == Interval::LINE || point.may_be_nan() || op == Op::Atan2;
        assert!(at_a_jump || width <= 1e-5 * value.abs().max(1.0), "{op} {args:?}: {point:?}");
    });
}

/// A box, ordinary or between hard values.
fn random_box(rng: &mut ChaCha8Rng) -> Interval {
    let bound = |rng: &mut ChaCha8Rng, hard: bool| {
        if hard { HARD[rng.random_range(0..HARD.len())] } else { rng.random_range(-3.0f32..3.0) }
    };
    loop {
        let hard = rng.random_bool(0.3);
        let (a, b) = (bound(rng, hard), bound(rng, hard));
        if a <= b {
            return Interval::new(a, b);
        }
    }
}

/// A value of the interval, often a bound.
fn sample(rng: &mut ChaCha8Rng, interval: Interval) -> f32 {
    let (low, high) = (interval.low(), interval.high());
    match rng.random_range(0..5) {
        0 => low,
        1 => high,
        2 if interval.contains(0.0) => [0.0, -0.0][rng.random_range(0..2)],
        _ => (low * 0.5 + (high * 0.5 - low * 0.5) * rng.random::<f32>() + low * 0.5)
            .clamp(low, high),
    }
}

fn check_soundness(rng: &mut ChaCha8Rng, program: &Program) {
    let domain: Vec<Interval> = (0..program.inputs).map(|_| random_box(rng)).collect();
    let bounds = Bounds.evaluate(program, &domain);
    for _ in 0..20 {
        let point: Vec<f32> = domain.iter().map(|&interval| sample(rng, interval)).collect();
        if point.iter().any(|x| x.is_nan()) {
            continue;
        }
        let single = program.evaluate(&point);
        let double = Double.evaluate(program, &point.iter().map(|&x| x.into()).collect::<Vec<_>>());
        for (o, bound) in bounds.iter().enumerate() {
            for value in [f64::from(single[o]), double[o]] {
                assert!(
                    bound.contains(value),
                    "output {o}: {value:e} outside {bound:?} at {point:?} of {domain:?} in {program:?}"
                );
            }
        }
    }
}

#[test]
fn no_value_of_an_operation_leaves_its_bounds() {
    let mut rng = ChaCha8Rng::seed_from_u64(5);
    for &op in Op::ALL {
        let args = [0, 1, 2, 3].map(Arg::Input);
        let mut draft = Draft { inputs: 4, ..Draft::default() };
        let result = draft.push(op, &args);
        draft.outputs = vec![result];
        let program = Program::verify(draft).unwrap();
        for _ in 0..2000 {
            check_soundness(&mut rng, &program);
        }
    }
}

#[test]
fn no_value_of_a_random_program_leaves_its_bounds() {
    let mut rng = ChaCha8Rng::seed_from_u64(6);
    for _ in 0..20_000 {
        let length = rng.random_range(1..12);
        let program = random_program(&mut rng, 3, length);
        check_soundness(&mut rng, &program);
    }
}
