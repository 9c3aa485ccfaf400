//! Whatever the formula, the domain and what is asked, an examination comes to an end.

use lgp::num::Interval;
use lgp::op::Op;
use lgp::program::{Arg, Claim, Draft, Names, Program, parse};
use lgp::stability::{Bound, Examination, Limits, Property, Questions, Rounding, Status, prove};
use lgp::wording::examination;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

const PROGRAMS: usize = 30;

/// Two outputs of few instructions, fused products and sums among them more often than not.
fn random_program(rng: &mut ChaCha8Rng) -> Program {
    let inputs = rng.random_range(1..4);
    let mut draft = Draft { inputs, ..Draft::default() };
    for value in [0.5, -3.0, 1e30] {
        draft.constant(value);
    }
    for i in 0..rng.random_range(1..8) {
        let op = match rng.random_range(0..3) {
            0 => Op::Mad,
            _ => Op::ALL[rng.random_range(0..Op::ALL.len())],
        };
        let mut arg = || match rng.random_range(0..6) {
            0 => Arg::Const(rng.random_range(0..3)),
            1 | 2 => Arg::Input(rng.random_range(0..inputs as u16)),
            _ if i == 0 => Arg::Input(0),
            _ => Arg::Result(rng.random_range(0..i)),
        };
        let args = [arg(), arg(), arg(), arg()];
        draft.push(op, &args);
    }
    let last = draft.instrs.len() as u16;
    draft.outputs = vec![Arg::Result(last - 1), Arg::Result(rng.random_range(0..last))];
    Program::verify(draft).unwrap()
}

fn random_side(rng: &mut ChaCha8Rng) -> Interval {
    let ends = [0.0, 1.0, -1.0, 0.01, 1e-30, -1e-42, 1e30, 7.5, f32::MAX, f32::MIN];
    let [a, b] = [0; 2].map(|_| ends[rng.random_range(0..ends.len())]);
    Interval::new(a.min(b), a.max(b))
}

const CLAIMS: [&str; 3] = [
    "energy: f0*scale + bias <= 1 for f0 in 0..1",
    "order: scale >= bias*exp2(k) for k in -3..-1",
    "sum: scale*scale + bias <= 1",
];

#[test]
fn an_examination_of_anything_is_text_and_json() {
    let mut rng = ChaCha8Rng::seed_from_u64(7);
    for _ in 0..PROGRAMS {
        let program = random_program(&mut rng);
        let domain: Vec<Interval> = (0..program.inputs).map(|_| random_side(&mut rng)).collect();
        let ranges = vec![[0.0, 1.0], [f64::NEG_INFINITY, 1e-3]];
        let names = ["a", "b", "c"][..program.inputs].iter().copied();
        let names = Names::new(names, ["scale", "bias"]);
        let some = CLAIMS[..rng.random_range(0..=CLAIMS.len())].iter();
        let claims = some.map(|text| Claim::parse(text, &names).unwrap()).collect();
        let questions = Questions { domain, ranges, claims, slack: 1e-5, truth: None };
        let bound = [1e-6, 1e-2, 1e3][rng.random_range(0..3)];
        let examination = Examination::of(&program, &questions, bound);
        let text = examination::text(&examination, &names);
        assert!(text.contains("scale finite") && text.contains("smoothness"), "{text}");
        assert!(examination::json(&examination, &names)["claims"].is_array());
    }
}

/// A product and a sum are two instructions where a compiler does not fuse them.
#[test]
fn what_an_unfused_product_loses_is_said_of_the_formula_as_written() {
    let names = Names::new(["a", "b"], ["y"]);
    let program = parse("y = mad(a, log2(b), b)", &names).unwrap();
    let questions = Questions {
        domain: vec![Interval::new(0.01, 1.0), Interval::new(0.0, 1.0)],
        ranges: vec![[f64::NEG_INFINITY, f64::INFINITY]],
        claims: vec![],
        slack: 1e-5,
        truth: None,
    };
    let examination = Examination::of(&program, &questions, 1e-2);
    let losses = [examination.single, examination.half];
    let losses = losses.iter().flat_map(|of| [&of.absolute, &of.relative, &of.not_finite]);
    for instruction in losses.flatten().filter_map(|loss| loss.blame.instruction) {
        assert!(instruction < program.instrs.len(), "{instruction}");
    }
}

/// A sum of so many inputs.
fn sum(inputs: usize) -> Program {
    let mut draft = Draft { inputs, ..Draft::default() };
    let mut total = Arg::Input(0);
    for i in 1..inputs {
        total = draft.push(Op::Add, &[total, Arg::Input(i as u16)]);
    }
    draft.outputs = vec![total];
    Program::verify(draft).unwrap()
}

#[test]
fn many_inputs_are_looked_at_in_bounded_work() {
    for inputs in [13, 30, 64] {
        let program = sum(inputs);
        let domain = vec![Interval::new(0.0, 1.0); inputs];
        let most = inputs as f64;
        let bounds = [Bound::Finite, Bound::AtMost(1.01 * most), Bound::AtMost(0.99 * most)];
        let claims = [bounds.as_slice(), &[Bound::AtLeast(0.01)]].concat();
        let claims: Vec<Property> =
            claims.into_iter().map(|bound| Property::of(0, bound)).collect();
        let limits = Limits { boxes: 100, ..Limits::new(Rounding::Exact) };
        let found = prove(&program, &domain, &claims, &limits);
        assert_eq!(found[..2], [Status::Proved, Status::Proved], "{inputs} inputs");
        for status in &found[2..] {
            assert!(matches!(status, Status::Refuted { .. }), "{inputs} inputs: {status:?}");
        }
    }
    let program = sum(40);
    let questions = Questions {
        domain: vec![Interval::new(0.0, 1.0); 40],
        ranges: vec![[0.0, 1.0]],
        claims: vec![],
        slack: 1e-5,
        truth: None,
    };
    let examination = Examination::of(&program, &questions, 1e-2);
    assert!(!examination.half_tried.exhaustive);
    assert!(!examination.extremes.is_empty());
    // Halves of forty numbers, most of which need all their digits, are not summed exactly.
    assert!(examination.half.absolute.unwrap().absolute() > 0.02);
}
