//! One suite for every evaluator: the interpreter in each kind of register gives the scalar
//! reference's bits, the reference is as accurate as its documentation says, and the other
//! arithmetics agree with it, each within its own tolerance.

mod arithmetic;

use lgp::dataset::Split;
use lgp::eval::{Arithmetic, Double, Evaluator, Isa, Samples, Tape};
use lgp::num::math;
use lgp::op::{Accuracy, Op};
use lgp::program::{Arg, Draft, Program};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

const HARD: [f32; 40] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    0.5,
    -0.5,
    2.0,
    -2.0,
    1e-45,
    -1e-45,
    1e-40,
    -1e-40,
    f32::MIN_POSITIVE,
    -f32::MIN_POSITIVE,
    1e-20,
    3.0,
    -3.0,
    7.25,
    0.1,
    -0.1,
    1e4,
    -1e4,
    1e8,
    -1e8,
    3e9,
    1e20,
    -1e20,
    f32::MAX,
    f32::MIN,
    f32::INFINITY,
    f32::NEG_INFINITY,
    f32::NAN,
    0.999_999_94,
    1.000_000_1,
    127.999,
    128.0,
    -126.5,
    -149.5,
    -150.5,
    88.8,
];

fn random_program(rng: &mut ChaCha8Rng, inputs: u16, length: usize) -> Program {
    let mut draft = Draft { inputs: usize::from(inputs), ..Draft::default() };
    for _ in 0..4 {
        let hard = HARD.iter().copied().filter(|c| c.is_finite());
        let values: Vec<f32> = hard.collect();
        draft.constant(values[rng.random_range(0..values.len())]);
    }
    for i in 0..length {
        let op = Op::ALL[rng.random_range(0..Op::ALL.len())];
        let args: [Arg; 4] = std::array::from_fn(|_| match rng.random_range(0..6) {
            0 | 1 => Arg::Input(rng.random_range(0..inputs)),
            2 => Arg::Const(rng.random_range(0..4)),
            _ if i == 0 => Arg::Input(0),
            _ => Arg::Result(rng.random_range(0..i as u16)),
        });
        draft.push(op, &args);
    }
    let last = length as u16 - 1;
    draft.outputs = vec![Arg::Result(last), Arg::Result(last / 2), Arg::Input(0), Arg::Const(1)];
    Program::verify(draft).expect("arguments are earlier ones")
}

/// Columns that pair every hard value with every other, then random bit patterns.
fn hard_samples(rng: &mut ChaCha8Rng, rows: usize) -> Split {
    let hard = |k: usize| HARD[k % HARD.len()];
    let columns = (0..3).map(|column| {
        (0..rows)
            .map(|row| match column {
                _ if row >= HARD.len() * HARD.len() => f32::from_bits(rng.random()),
                0 => hard(row),
                1 => hard(row / HARD.len()),
                _ => hard(row * 7 + row / HARD.len()),
            })
            .collect()
    });
    Split { columns: columns.collect(), ..Split::default() }
}

fn same_bits(a: f32, b: f32) -> bool {
    a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan())
}

fn check(program: &Program, split: &Split) {
    let samples = Samples::new(split, split.columns.len());
    let tape = Tape::new(program);
    let reference: Vec<Vec<f32>> = (0..split.rows())
        .map(|row| {
            let inputs: Vec<f32> = split.columns.iter().map(|column| column[row]).collect();
            program.evaluate(&inputs)
        })
        .collect();
    for isa in Isa::available() {
        let outputs = Evaluator::new(isa).outputs(&tape, &samples);
        for (o, column) in outputs.iter().enumerate() {
            assert_eq!(column.len(), split.rows());
            for (row, value) in column.iter().enumerate() {
                assert!(
                    same_bits(*value, reference[row][o]),
                    "{isa:?}, row {row}, output {o}: {value:e} is not {:e} in {program:?}",
                    reference[row][o]
                );
            }
        }
    }
}

#[test]
fn every_operation_has_the_reference_bits_on_hard_inputs() {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let split = hard_samples(&mut rng, 4000);
    for &op in Op::ALL {
        let mut draft = Draft { inputs: 3, ..Draft::default() };
        let constant = draft.constant(0.75);
        let inputs = [Arg::Input(0), Arg::Input(1), Arg::Input(2), Arg::Input(0)];
        // Every choice of which arguments are constant has a kernel of its own.
        for constants in 0..1 << op.arity() {
            let args: [Arg; 4] =
                std::array::from_fn(|k| if constants >> k & 1 == 1 { constant } else { inputs[k] });
            let result = draft.push(op, &args);
            draft.outputs.push(result);
        }
        check(&Program::verify(draft).unwrap(), &split);
    }
}

#[test]
fn random_programs_have_the_reference_bits() {
    let programs = std::env::var("LGP_CONFORMANCE_PROGRAMS");
    let programs: usize = programs.ok().and_then(|n| n.parse().ok()).unwrap_or(3000);
    let mut rng = ChaCha8Rng::seed_from_u64(2);
    for _ in 0..programs {
        let rows = rng.random_range(1..80);
        let split = hard_samples(&mut rng, rows);
        let length = rng.random_range(1..30);
        check(&random_program(&mut rng, 3, length), &split);
    }
}

#[test]
fn losses_agree_with_a_plain_sum_and_across_registers() {
    let mut rng = ChaCha8Rng::seed_from_u64(3);
    for _ in 0..300 {
        let rows = rng.random_range(1..3000);
        let mut column = || (0..rows).map(|_| rng.random_range(0.1f32..1.0)).collect::<Vec<_>>();
        let columns = vec![column(), column(), column()];
        let weights = column();
        let split = Split { columns, weights, ..Split::default() };
        let samples = Samples::new(&split, 1);
        let mut draft = Draft { inputs: 1, ..Draft::default() };
        let square = draft.push(Op::Mul, &[Arg::Input(0), Arg::Input(0)]);
        draft.outputs = vec![square, Arg::Input(0)];
        let tape = Tape::new(&Program::verify(draft).unwrap());
        let expected = |o: usize| {
            (0..rows).fold((0.0f64, 0.0f32), |(sum, max), row| {
                let x = split.columns[0][row];
                let difference = [x * x, x][o] - split.columns[o + 1][row];
                let square = f64::from(difference) * f64::from(difference);
                (sum + f64::from(split.weights[row]) * square, max.max(difference.abs()))
            })
        };
        let losses: Vec<_> = Isa::available()
            .into_iter()
            .map(|isa| Evaluator::new(isa).loss(&tape, &samples, f64::INFINITY))
            .collect();
        for o in 0..2 {
            let (sum, max) = expected(o);
            assert!((losses[0].sum_of_squares[o] / sum - 1.0).abs() < 1e-5);
            assert_eq!(losses[0].max_error[o], max);
        }
        assert!(losses.iter().all(|loss| *loss == losses[0]));
        let bound = losses[0].total() / 2.0;
        let early = Evaluator::default().loss(&tape, &samples, bound);
        assert!(early.total() > bound);
    }
}

/// The largest error in units in the last place over `samples` arguments spread evenly over the
/// bit patterns between `low` and `high`, and over the values between them.
fn worst_ulp(f: impl Fn(f32) -> f32, exact: impl Fn(f64) -> f64, low: f32, high: f32) -> f64 {
    let samples = 400_000;
    let mut rng = ChaCha8Rng::seed_from_u64(4);
    let mut worst = 0.0f64;
    for i in 0..samples {
        let x = if i % 2 == 0 {
            low + (high - low) * (i as f32 / samples as f32)
        } else {
            f32::from_bits(rng.random()) // any magnitude
        };
        if !(low..=high).contains(&x) {
            continue;
        }
        let (got, want) = (f64::from(f(x)), exact(f64::from(x)));
        let rounded = want as f32;
        let ulp =
            f64::from(f32::from_bits((rounded.abs().to_bits()).max(0x0080_0000) & 0x7f80_0000))
                * f64::from(f32::EPSILON);
        if rounded.is_finite() {
            worst = worst.max((got - want).abs() / ulp);
        }
    }
    worst
}

/// Where an operation of one argument is tried, and where more closely.
#[deny(clippy::wildcard_enum_match_arm)]
fn ranges(op: Op) -> &'static [[f32; 2]] {
    match op {
        Op::Rcp => &[[f32::MIN, -1e-38], [1e-38, f32::MAX]],
        Op::Sqrt | Op::Rsqrt => &[[1e-45, f32::MAX]],
        Op::Exp2 => &[[-200.0, 200.0]],
        Op::Exp => &[[-120.0, 100.0]],
        Op::Log2 | Op::Log => &[[1e-45, f32::MAX], [0.7, 1.5]],
        Op::Sin | Op::Cos | Op::Tan => &[[-1e4, 1e4]],
        Op::Asin | Op::Acos => &[[-1.0, 1.0]],
        Op::Atan => &[[f32::MIN, f32::MAX], [-5.0, 5.0]],
        Op::Tanh => &[[-20.0, 20.0]],
        Op::Fract => &[[-1e4, 1e4], [-2.0, 2.0]],
        Op::Neg | Op::Abs | Op::Saturate | Op::Floor | Op::Sign => &[[f32::MIN, f32::MAX]],
        // Of more than one argument.
        Op::Add | Op::Sub | Op::Mul | Op::Div | Op::Mad | Op::Pow | Op::Lerp => &[],
        Op::Min | Op::Max | Op::Atan2 | Op::Step | Op::Select => &[],
    }
}

/// Units in the last place that the operation table grants; of an operation made of others, none by itself.
fn stated_ulps(op: Op) -> Option<f64> {
    match op.accuracy() {
        Accuracy::Exact => Some(0.0),
        Accuracy::InSteps => None,
        Accuracy::Within(tolerance) => Some(tolerance.ulps),
    }
}

#[test]
fn operations_are_as_accurate_as_the_table_says() {
    for &op in Op::ALL {
        let Some(stated) = stated_ulps(op) else { continue };
        let single = |x: f32| op.apply([x; 4]);
        let double = |x: f64| Double.apply(op, [x; 4]);
        assert_eq!(ranges(op).is_empty(), op.arity() > 1, "{op}");
        for &[low, high] in ranges(op) {
            assert!(high <= op.accuracy().up_to(), "{op} up to {high}");
            let worst = worst_ulp(single, double, low, high);
            println!("{op} from {low:e} to {high:e}: {worst:.3} ulp (stated: {stated})");
            assert!(worst <= stated, "{op}: {worst} ulp, stated {stated}");
        }
    }
}

/// Bounds count from the nearest floating-point numbers, and allow it more.
#[test]
fn exp_is_nearer_than_the_table_says() {
    let worst = worst_ulp(math::exp, f64::exp, -120.0, 100.0);
    assert!(worst <= 1.0, "{worst}");
}

#[test]
fn operations_of_several_arguments_are_as_accurate_as_the_table_says() {
    let mut rng = ChaCha8Rng::seed_from_u64(6);
    for &op in Op::ALL.iter().filter(|op| op.arity() > 1) {
        let Some(stated) = stated_ulps(op) else { continue };
        for _ in 0..100_000 {
            let args: [f32; 4] = std::array::from_fn(|_| {
                rng.random_range(-1.0f32..1.0) * rng.random_range(-8.0f32..8.0).exp2()
            });
            let exact = Double.apply(op, args.map(f64::from));
            let (got, rounded) = (f64::from(op.apply(args)), (exact as f32).abs());
            // Sums that cancel are exact in neither; the double's own error is in its 53rd digit.
            let ulp = f64::from(rounded.next_up()) - f64::from(rounded);
            let allowed =
                stated * ulp + 1e-9 * ulp + args.map(f32::abs).iter().sum::<f32>() as f64 * 1e-15;
            assert!((got - exact).abs() <= allowed, "{op} {args:?}: {got:e}, not {exact:e}");
        }
    }
}

#[test]
fn elementary_functions_have_their_special_values() {
    let (inf, nan) = (f32::INFINITY, f32::NAN);
    for (got, want) in [
        (math::exp2(-inf), 0.0),
        (math::exp2(inf), inf),
        (math::exp2(nan), nan),
        (math::exp2(0.0f32), 1.0),
        (math::exp2(-149.0f32), 1e-45),
        (math::exp2(127.0f32), 2f32.powi(127)),
        (math::exp(0.0f32), 1.0),
        (math::exp(-inf), 0.0),
        (math::log2(0.0f32), -inf),
        (math::log2(-0.0f32), -inf),
        (math::log2(inf), inf),
        (math::log2(-1.0f32), nan),
        (math::log2(-inf), nan),
        (math::log2(nan), nan),
        (math::log2(1.0f32), 0.0),
        (math::log2(2f32.powi(-140)), -140.0),
        (math::log(0.0f32), -inf),
        (math::log(1.0f32), 0.0),
        (math::pow(0.0f32, 0.0), nan),
        (math::pow(0.0f32, 2.0), 0.0),
        (math::pow(-1.0f32, 2.0), nan),
        (math::sin(inf), nan),
        (math::cos(-inf), nan),
        (math::cos(0.0f32), 1.0),
        (math::asin(1.5f32), nan),
        (math::acos(-1.5f32), nan),
        (math::acos(1.0f32), 0.0),
        (math::atan(inf), std::f32::consts::FRAC_PI_2),
        (math::atan2(0.0f32, -1.0), std::f32::consts::PI),
        (math::atan2(0.0f32, 0.0), 0.0),
        (math::atan2(-1.0f32, 0.0), -std::f32::consts::FRAC_PI_2),
        (math::atan2(inf, inf), std::f32::consts::FRAC_PI_4),
        (math::atan2(nan, 1.0), nan),
        (math::tanh(inf), 1.0),
        (math::tanh(-100.0f32), -1.0),
        (math::tanh(nan), nan),
        (math::rsqrt(0.0f32), inf),
        (math::sign(-3.0f32), -1.0),
        (math::sign(0.0f32), 0.0),
        (math::step(1.0f32, 1.0), 1.0),
        (math::step(nan, 1.0), 0.0),
        (math::saturate(-0.5f32), 0.0),
        (math::saturate(7.0f32), 1.0),
    ] {
        assert!(same_bits(got, want) || (got == 0.0 && want == 0.0), "{got} is not {want}");
    }
}
