//! What is said of half precision: every half tried where that can be, denormals kept and flushed.

use half::f16;
use lgp::eval::{Arithmetic, Double};
use lgp::num::Interval;
use lgp::program::{Names, Program, parse};
use lgp::stability::{Examination, Questions, Unheld, half_loss, must_stay_single, unheld};

fn program(text: &str, inputs: &[&str]) -> Program {
    parse(text, &Names::new(inputs.iter().copied(), ["y"])).unwrap()
}

/// The largest error in half precision as IEEE has it, at every half of an interval.
fn worst_at_every_half(program: &Program, [low, high]: [f32; 2]) -> f64 {
    let halves = (0..=u16::MAX).map(|bits| f16::from_bits(bits).to_f32());
    let within = halves.filter(|x| (low..=high).contains(x));
    let error = |x: f32| {
        let exact = Double.evaluate(program, &[x.into()])[0];
        let found = lgp::eval::Half::default().evaluate(program, &[f16::from_f32(x)])[0];
        (found.to_f64() - exact).abs()
    };
    within.map(error).fold(0.0, f64::max)
}

#[test]
fn of_one_input_no_half_is_worse_than_what_is_said() {
    for text in [
        "y = saturate(x*(x*(1.3134*x - 3.4018) + 3.0365) + 0.0155)",
        "y = sqrt(1.01 - 0.5*x)",
        "y = exp2(-3*x)*(1 - 0.5*x)",
    ] {
        let (program, domain) = (program(text, &["x"]), [Interval::new(0.0, 1.6)]);
        let (error, tried) = half_loss(&program, &domain, &[]);
        // Halves from 0 to 1.6, and −0.
        assert!(tried.exhaustive && tried.points == 15_360 + 614 + 2, "{tried:?}");
        let worst = worst_at_every_half(&program, [0.0, 1.6]);
        assert!(error >= worst, "{text}: {error} is said, {worst} found");
        // It is halves that err by so much, not the bound that is loose.
        assert!(error <= worst + 1e-4, "{text}: {error} is said, {worst} found");
        for bound in [0.9 * worst, worst / 3.0] {
            let single = must_stay_single(&program, &domain, bound).unwrap_or_default();
            let (mixed, _) = half_loss(&program, &domain, &single);
            assert!(single.is_empty() || mixed <= bound, "{text}: {mixed} for {bound}");
            assert_ne!(must_stay_single(&program, &domain, bound), Some(vec![]), "{text}");
        }
    }
    let g1 = program("y = saturate(x*(x*(1.3134*x - 3.4018) + 3.0365) + 0.0155)", &["x"]);
    let (error, _) = half_loss(&g1, &[Interval::new(0.0, 1.6)], &[]);
    assert!(error > 2.6e-3 && error < 2.7e-3, "{error}");
}

#[test]
fn denormals_are_kept_and_flushed() {
    // Where denormal halves are flushed, this is 0/0.
    let guarded = program("y = 0.5*b/max(b, 0.00001)", &["b"]);
    let domain = [Interval::new(0.0, 1.0)];
    assert_eq!(half_loss(&guarded, &domain, &[]).0, f64::INFINITY);
    assert!(
        matches!(unheld(&guarded, &domain, &[]), Some(Unheld::Output { found, .. }) if found.is_nan())
    );
    assert_ne!(must_stay_single(&guarded, &domain, 0.01), Some(vec![]));
    let questions = Questions {
        domain: domain.to_vec(),
        ranges: vec![[f64::NEG_INFINITY, f64::INFINITY]],
        claims: vec![],
        slack: 1e-5,
        truth: None,
    };
    let examination = Examination::of(&guarded, &questions, 0.01);
    assert!(examination.half.not_finite.is_some());
    // Where they are kept, the multiple of a denormal has lost its digits.
    let scaled = program("y = 10000*(0.0001*b*b)", &["b"]);
    assert!(half_loss(&scaled, &domain, &[]).0 > 1e-3);
}

#[test]
fn of_two_inputs_it_is_the_worst_of_so_many_points() {
    let product = program("y = a*b", &["a", "b"]);
    let (_, tried) = half_loss(&product, &[Interval::new(0.0, 1.0); 2], &[]);
    assert!(!tried.exhaustive && tried.points > 4096, "{tried:?}");
    let narrow = [Interval::new(0.5, 0.501), Interval::new(2.0, 2.0)];
    let (_, tried) = half_loss(&product, &narrow, &[]);
    // Halves are 2^-11 apart there.
    assert!(tried.exhaustive && tried.points == 3, "{tried:?}");
}

#[test]
fn what_no_half_holds_is_named() {
    let domain = [Interval::new(1000.0, 24_880.0)];
    let find = |text: &str, side: Interval, single: &[usize]| {
        unheld(&program(text, &["t"]), &[side], single)
    };
    let unit = Interval::new(0.0, 1.0);
    let constant = |found: Option<Unheld>| match found {
        Some(Unheld::Constant { value, .. }) => value,
        other => panic!("{other:?}"),
    };
    assert_eq!(constant(find("y = 80000*t + 100000", unit, &[])), 80_000.0);
    assert_eq!(constant(find("y = t + 1e-8", unit, &[])), 1e-8);
    assert_eq!(find("y = t + 65504", unit, &[]), None);
    let found = find("y = 3000*t^2", domain[0], &[]);
    let Some(Unheld::Result { instruction: 0, value, input }) = found else { panic!("{found:?}") };
    assert!(value > 6.1e8 && input[0] > 24_000.0, "{value} {input:?}");
    let found = find("y = t*0.5", Interval::new(0.0, 1e6), &[]);
    assert_eq!(found, Some(Unheld::Input { input: 0, value: 1e6 }));
    // What stays single need not be held; what reads it in halves must.
    let text = "y = 0.001/(1 + t*t)";
    let program = program(text, &["t"]);
    let single = must_stay_single(&program, &domain, 1e-3).unwrap();
    assert!(single.contains(&0) && single.contains(&1), "{single:?}");
    assert_eq!(unheld(&program, &domain, &single), None);
    assert!(matches!(unheld(&program, &domain, &[0]), Some(Unheld::Result { .. })));
}
