//! No value of any instruction leaves its bounds, whatever the program and the box.

use crate::sloppy::Sloppy;
use lgp::eval::{Arithmetic, Double};
use lgp::num::Interval;
use lgp::op::Op;
use lgp::program::{Arg, Draft, Program};
use lgp::stability::{Enclosure, Rounding};
use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

const HARD: [f32; 24] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    0.5,
    2.0,
    -2.0,
    1e-45,
    -1e-40,
    1e-38,
    1e-20,
    3.0,
    7.25,
    0.1,
    100.0,
    -100.0,
    1e4,
    1e8,
    1e20,
    -1e20,
    f32::MAX,
    127.999,
    -126.5,
    0.999_999_94,
];

/// Programs to try for each arithmetic; `LGP_SOUNDNESS_PROGRAMS` sets another number.
fn programs() -> usize {
    let set = std::env::var("LGP_SOUNDNESS_PROGRAMS");
    set.ok().and_then(|n| n.parse().ok()).unwrap_or(4000)
}

const POINTS: usize = 20;

/// A program all of whose instructions are outputs, with constants of ordinary size as a rule.
fn random_program(rng: &mut ChaCha8Rng) -> Program {
    let mut draft = Draft { inputs: 3, ..Draft::default() };
    for _ in 0..4 {
        let hard = rng.random_bool(0.2);
        let value =
            if hard { HARD[rng.random_range(0..HARD.len())] } else { rng.random_range(-3.0..3.0) };
        draft.constant(value);
    }
    for i in 0..rng.random_range(1..14) {
        let op = Op::ALL[rng.random_range(0..Op::ALL.len())];
        let mut arg = || match rng.random_range(0..6) {
            0 | 1 => Arg::Input(rng.random_range(0..3)),
            2 => Arg::Const(rng.random_range(0..4)),
            _ if i == 0 => Arg::Input(0),
            _ => Arg::Result(rng.random_range(0..i)),
        };
        let mut args = [arg(), arg(), arg(), arg()];
        if rng.random_bool(0.2) {
            args[1] = args[0];
        }
        let result = draft.push(op, &args);
        draft.outputs.push(result);
    }
    Program::verify(draft).unwrap()
}

fn random_side(rng: &mut ChaCha8Rng) -> Interval {
    let hard = rng.random_bool(0.15);
    let width: f32 = 10f32.powf(rng.random_range(-6.0..1.0));
    let low: f32 = rng.random_range(-2.0..2.0);
    match (hard, rng.random_range(0..3)) {
        (true, _) => {
            let ends = [0; 2].map(|_| HARD[rng.random_range(0..HARD.len())]);
            Interval::new(ends[0].min(ends[1]), ends[0].max(ends[1]))
        }
        (false, 0) => Interval::new(0.0, width),
        (false, _) => Interval::new(low, low + width),
    }
}

/// A number of the interval, often an end.
fn sample(rng: &mut impl Rng, side: Interval) -> f32 {
    match rng.random_range(0..6) {
        0 => side.low(),
        1 => side.high(),
        _ => (side.low() + (side.high() - side.low()) * rng.random::<f32>())
            .clamp(side.low(), side.high()),
    }
}

fn check(
    rounding: Rounding,
    seed: u64,
    values: impl Fn(&Program, &[f32], &mut ChaCha8Rng) -> Vec<Vec<f64>>,
) {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut enclosure = Enclosure::new(rounding);
    for _ in 0..programs() {
        let program = random_program(&mut rng);
        let domain: Vec<Interval> = (0..3).map(|_| random_side(&mut rng)).collect();
        enclosure.evaluate(&program, &domain);
        for _ in 0..POINTS {
            let point: Vec<f32> = domain.iter().map(|&side| sample(&mut rng, side)).collect();
            for values in values(&program, &point, &mut rng) {
                for (i, &value) in values.iter().enumerate() {
                    let bounds = enclosure.bounds(&program, Arg::Result(i as u16));
                    assert!(
                        bounds.contains(value),
                        "{:?}, instruction {i}: {value:e} outside {bounds:?} at {point:?} of {domain:?} in {program:?}",
                        rounding
                    );
                }
            }
        }
    }
}

#[test]
fn no_value_of_the_interpreter_leaves_its_bounds() {
    check(Rounding::Exact, 1, |program, point, _| {
        vec![program.evaluate(point).into_iter().map(f64::from).collect()]
    });
}

#[test]
fn no_value_of_a_sloppy_gpu_leaves_its_bounds() {
    check(Rounding::Gpu, 2, |program, point, rng| {
        let single = program.evaluate(point).into_iter().map(f64::from).collect();
        let sloppy = Sloppy::new(rng.random());
        let sloppy = sloppy.evaluate(program, point).into_iter().map(f64::from).collect();
        vec![single, sloppy]
    });
}

/// Differences of numbers near the largest are no reason to think that they are ordered.
#[test]
fn a_form_that_overflows_says_nothing() {
    let names = lgp::program::Names::new(["a", "b", "c"], ["f"]);
    let text = "f = select(c < saturate(b), b, a)";
    let program = lgp::program::parse(text, &names).unwrap();
    let domain = [(0.0, 7.4), (0.999_999_94, f32::MAX), (0.0, 5e-5)];
    let domain = domain.map(|(low, high)| Interval::new(low, high));
    for rounding in [Rounding::Exact, Rounding::Gpu] {
        let mut enclosure = Enclosure::new(rounding);
        enclosure.evaluate(&program, &domain);
        let bounds = enclosure.bounds(&program, program.outputs[0]);
        assert!(bounds.contains(1e38), "{bounds:?}");
    }
}

/// Smooth programs at a small box: forms must beat plain intervals, or they are not worth having.
#[test]
fn the_excess_falls_with_the_square_of_the_width() {
    let names = lgp::program::Names::new(["x", "y"], ["f"]);
    let text = "f = (x - x*y)/(1 + x) + exp2(-3*x)*(1 - y) - sqrt(x + y) + log2(2 + x*x)";
    let program = lgp::program::parse(text, &names).unwrap();
    let mut enclosure = Enclosure::new(Rounding::Exact);
    let mut excess = |width: f32| {
        let domain = [0.3, 0.6].map(|low| Interval::new(low, low + width));
        enclosure.evaluate(&program, &domain);
        let bounds = enclosure.bounds(&program, program.outputs[0]);
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for i in 0..=20 {
            for j in 0..=20 {
                let at = |k: i32, start: f64| start + f64::from(width) * f64::from(k) / 20.0;
                let value = Double.evaluate(&program, &[at(i, 0.3), at(j, 0.6)])[0];
                (low, high) = (low.min(value), high.max(value));
            }
        }
        (f64::from(bounds.high()) - f64::from(bounds.low())) - (high - low)
    };
    let (wide, narrow) = (excess(0.2), excess(0.02));
    assert!(wide > 0.0 && narrow > 0.0 && narrow < wide / 50.0, "{wide:e} {narrow:e}");
}
