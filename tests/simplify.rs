//! Simplification keeps what a program computes, and never makes it costlier.

use lgp::cost::{CostScratch, Profile};
use lgp::op::Op;
use lgp::program::{Arg, Draft, Names, Program, parse, print};
use lgp::simplify::{Simplifier, folded, tidy};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

fn simplified(draft: &Draft) -> Program {
    let mut target = Draft::default();
    Simplifier::default().simplify(draft, &mut target);
    Program::verify(target).expect("simplification gives a program")
}

/// What the table shows of its operations, the rules know: no operation is forgotten there.
#[test]
fn what_one_operation_undoes_of_another_is_left_out() {
    let functions: Vec<Op> = Op::ALL.iter().copied().filter(|op| op.arity() == 1).collect();
    let apply = |op: Op, x: f32| op.apply([x, 0.0, 0.0, 0.0]);
    let points: Vec<f32> =
        (-40..40).map(|i| (i as f32 + 0.37) / 8.0).chain([1e-10, -1e-10]).collect();
    let mut known = 0;
    for &outer in &functions {
        for &inner in &functions {
            let pairs = points.iter().map(|&x| (x, apply(inner, x), apply(outer, apply(inner, x))));
            let pairs: Vec<_> = pairs.filter(|(.., y)| y.is_finite()).collect();
            let undone = pairs.iter().all(|(x, _, y)| (x - y).abs() <= 1e-4 * (x.abs() + 1e-6));
            let idle = outer == inner && pairs.iter().all(|(_, once, y)| once == y);
            let mut draft = Draft { inputs: 1, ..Draft::default() };
            let once = draft.push(inner, &[Arg::Input(0)]);
            let twice = draft.push(outer, &[once]);
            draft.outputs = vec![twice];
            let left = simplified(&draft).instrs.len();
            assert!(!undone || left == 0, "{outer}({inner}(x)) is x");
            assert!(!idle || left <= 1, "{outer}({inner}(x)) is {inner}(x)");
            known += usize::from(undone || idle);
        }
    }
    assert!(known > 10, "{known}");
}

/// Operations whose rounding stays small next to their arguments, so that values can be compared.
const TAME: [Op; 12] = [
    Op::Add,
    Op::Sub,
    Op::Mul,
    Op::Div,
    Op::Neg,
    Op::Abs,
    Op::Min,
    Op::Max,
    Op::Mad,
    Op::Rcp,
    Op::Sqrt,
    Op::Saturate,
];

#[test]
fn random_programs_keep_their_values_and_do_not_become_dearer() {
    let profile = Profile::find("gcn").unwrap();
    let mut scratch = CostScratch::default();
    let mut rng = ChaCha8Rng::seed_from_u64(5);
    let mut compared = 0;
    for _ in 0..20_000 {
        let mut draft = Draft { inputs: 2, ..Draft::default() };
        for _ in 0..4 {
            draft.constant(rng.random_range(-2.0..2.0));
        }
        let length = rng.random_range(1..12u16);
        for i in 0..length {
            let args: [Arg; 4] = std::array::from_fn(|_| match rng.random_range(0..5) {
                0 => Arg::Input(rng.random_range(0..2)),
                1 | 2 => Arg::Const(rng.random_range(0..4)),
                _ if i == 0 => Arg::Input(1),
                _ => Arg::Result(rng.random_range(0..i)),
            });
            draft.push(TAME[rng.random_range(0..TAME.len())], &args);
        }
        draft.outputs = vec![Arg::Result(length - 1)];
        let program = Program::verify(draft).unwrap();
        let simple = simplified(&program);
        let [before, after] = [&program, &simple].map(|p| profile.cycles(p, &mut scratch));
        let names = Names::new(["x", "y"], ["f"]);
        let texts = || format!("{} -> {}", print(&program, &names), print(&simple, &names));
        assert!(after <= before, "{before} -> {after}: {}", texts());
        let wide = |p: &Program, x: [f32; 2]| f64::from(p.evaluate(&x)[0]);
        let tidied = tidy(&simple);
        assert_eq!(
            profile.cycles(&tidied, &mut scratch),
            after,
            "{} -> {}",
            texts(),
            print(&tidied, &names)
        );
        for x in [[0.3, 0.6], [0.9, 0.15]] {
            let [a, b] = [&simple, &tidied].map(|p| p.evaluate(&x)[0]);
            assert!(a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan()), "{}", texts());
            let (a, b) = (wide(&program, x), wide(&simple, x));
            // Where values cancel or blow up, rounding differs by more.
            if a.is_finite() && a.abs() > 1e-2 && a.abs() < 1e2 {
                compared += 1;
                assert!((a - b).abs() < 2e-2 * a.abs(), "{a} -> {b}: {}", texts());
            }
        }
    }
    assert!(compared > 10_000, "{compared}");
}

/// Constants whose sums and products are no numbers are left apart, whatever the rules would bring together.
#[test]
fn constants_that_overflow_together_come_to_an_end() {
    const LARGE: [f32; 6] = [3e38, -3e38, 1e30, 1e-38, 0.0, 2.0];
    const ARITHMETIC: [Op; 8] =
        [Op::Add, Op::Sub, Op::Mul, Op::Div, Op::Neg, Op::Rcp, Op::Min, Op::Max];
    let mut rng = ChaCha8Rng::seed_from_u64(2);
    for _ in 0..200_000 {
        let mut draft = Draft { inputs: 1, ..Draft::default() };
        LARGE.iter().for_each(|&large| {
            draft.constant(large);
        });
        let length = rng.random_range(1..9u16);
        for i in 0..length {
            let args: [Arg; 4] = std::array::from_fn(|_| match rng.random_range(0..4) {
                0 => Arg::Input(0),
                1 => Arg::Const(rng.random_range(0..LARGE.len() as u16)),
                _ if i == 0 => Arg::Input(0),
                _ => Arg::Result(rng.random_range(0..i)),
            });
            draft.push(ARITHMETIC[rng.random_range(0..ARITHMETIC.len())], &args);
        }
        draft.outputs = vec![Arg::Result(length - 1)];
        simplified(&draft);
    }
}

#[test]
fn rules_rewrite_as_they_say() {
    let names = Names::new(["x", "y"], ["f"]);
    for (text, expected) in [
        ("f = (x + 1) + 2", "f = x + 3"),
        ("f = 3 - (x + 1)", "f = 2 - x"),
        ("f = x*abs(-1.25*x)*0.8", "f = x*abs(x)"),
        ("f = 2*(x*y + 0.5) - 3", "f = 2*(x*y) - 2"),
        ("f = 3 - 2*(0.5 - x)", "f = 2*x + 2"),
        ("f = 0.5*(x + -1e6) + 3", "f = 0.5*(x - 1e6) + 3"),
        ("f = 2*(3*x)", "f = 6*x"),
        ("f = (2*x + 1)*3", "f = 6*x + 3"),
        ("f = 6/(2*x)", "f = 3/x"),
        ("f = -(x - y)", "f = y - x"),
        ("f = x + -y", "f = x - y"),
        ("f = x*-y", "f = -(x*y)"),
        ("f = min(min(x, 3), 2)", "f = min(x, 2)"),
        ("f = max(x, max(x, y))", "f = max(x, y)"),
        ("f = x*y + y*x", "f = 2*(x*y)"),
        ("f = exp2(log2(x))", "f = x"),
        ("f = 1/sqrt(x)", "f = rsqrt(x)"),
        ("f = sqrt(x^2)", "f = abs(x)"),
        ("f = x - x + y", "f = y"),
        ("f = x/x*y", "f = y"),
        ("f = y*rcp(x)", "f = y/x"),
        ("f = mad(x, y, 1)", "f = x*y + 1"),
        ("f = x + 2*3", "f = x + 6"),
        ("f = 1*x - 0.5", "f = x - 0.5"),
        ("f = y + -1*x", "f = y - x"),
        ("f = y/exp2(x)", "f = y*exp2(-x)"),
        ("f = 3/exp2(2*x)", "f = 3*exp2(-2*x)"),
        ("f = rcp(exp(x))", "f = exp(-x)"),
        ("t = exp2(x); f = y/t + t", "t0 = exp2(x); f = t0 + y/t0"),
        ("f = min(max(x, 0), 1)", "f = saturate(x)"),
        ("f = max(1, min(0, x))", "f = max(min(x, 0), 1)"),
        ("f = max(0, min(1, x + y))", "f = saturate(x + y)"),
        ("f = 2/(4*x + 6)", "f = rcp(2*x + 3)"),
        ("f = (4*x + 2)/(8*y - 4)", "f = (x + 0.5)/(2*y - 1)"),
        ("f = (4*x + 2)/(8*(x*y) - 4)", "f = (0.5*x + 0.25)/(x*y - 0.5)"),
        ("f = 3*(4*x + 2*y)", "f = 12*x + 6*y"),
        ("f = 3*x/(6*y + 9)", "f = x/(2*y + 3)"),
        ("f = 3*((2*x + 4)/y)", "f = (6*x + 12)/y"),
        ("f = (4*x + 2)*(3*y + 5)", "f = (x + 0.5)*(12*y + 20)"),
        ("f = 3*rcp(y)", "f = 3/y"),
        ("f = (x + 2)/(y + 3)", "f = (x + 2)/(y + 3)"),
    ] {
        let simple = simplified(&parse(text, &names).unwrap());
        assert_eq!(print(&simple, &names), expected, "{text}");
    }
}

#[test]
fn tidied_formulas_have_fewer_signs() {
    let names = Names::new(["x", "y"], ["f"]);
    for (text, expected) in [
        ("f = x + -0.5", "f = x - 0.5"),
        ("f = -2*x + y", "f = y - 2*x"),
        ("f = y - -2*x", "f = y + 2*x"),
        ("f = x - -0.5", "f = x + 0.5"),
        ("f = 0.23 - -0.96/y", "f = 0.23 + 0.96/y"),
        ("f = x + -0.004/y", "f = x - 0.004/y"),
        ("t = -2*x; f = (t + y)*t", "t0 = -2*x; f = (t0 + y)*t0"),
    ] {
        assert_eq!(print(&tidy(&parse(text, &names).unwrap()), &names), expected, "{text}");
    }
}

/// A program of a few instructions of any kind on two inputs, and on constants that folding knows.
fn random_program(rng: &mut ChaCha8Rng) -> Program {
    const TRIVIAL: [f32; 7] = [0.0, -0.0, 1.0, -1.0, 2.0, 0.5, -3.0];
    let mut draft = Draft { inputs: 2, ..Draft::default() };
    for _ in 0..4 {
        let value = match rng.random_range(0..2) {
            0 => TRIVIAL[rng.random_range(0..TRIVIAL.len())],
            _ => rng.random_range(-2.0..2.0),
        };
        draft.constant(value);
    }
    let length = rng.random_range(1..12u16);
    for i in 0..length {
        let args: [Arg; 4] = std::array::from_fn(|_| match rng.random_range(0..5) {
            0 => Arg::Input(rng.random_range(0..2)),
            1 => Arg::Const(rng.random_range(0..4)),
            _ if i == 0 => Arg::Input(1),
            _ => Arg::Result(rng.random_range(0..i)),
        });
        let ops = if rng.random_range(0..2) == 0 { &TAME[..] } else { Op::ALL };
        draft.push(ops[rng.random_range(0..ops.len())], &args);
    }
    draft.outputs = vec![Arg::Result(length - 1), Arg::Result(rng.random_range(0..length))];
    Program::verify(draft).unwrap()
}

/// What an instruction does that no compiler would leave; of what reads constants alone only what has a finite
/// value, since no constant is infinite.
fn idle(program: &Program) -> Option<String> {
    let constant = |arg: &Arg| match arg {
        Arg::Const(i) => Some(program.consts[usize::from(*i)]),
        _ => None,
    };
    let negates = |arg: &Arg| match arg {
        Arg::Result(i) => program.instrs[usize::from(*i)].op() == Op::Neg,
        _ => false,
    };
    program.instrs.iter().enumerate().find_map(|(i, instr)| {
        let args = instr.args();
        let is = |place: usize, value: f32| constant(&args[place]) == Some(value);
        let values: Vec<f32> = args.iter().filter_map(constant).collect();
        let is_idle = match instr.op() {
            Op::Add => is(0, 0.0) || is(1, 0.0),
            Op::Sub => is(0, 0.0) || is(1, 0.0) || args[0] == args[1],
            Op::Mul => [0.0, 1.0, -1.0].iter().any(|&value| is(0, value) || is(1, value)),
            Op::Div => is(1, 1.0) || is(1, -1.0) || is(0, 0.0) && !is(1, 0.0),
            Op::Mad => [0.0, 1.0, -1.0].iter().any(|&v| is(0, v) || is(1, v)) || is(2, 0.0),
            Op::Neg => negates(&args[0]),
            Op::Min | Op::Max => args[0] == args[1],
            Op::Lerp => args[0] == args[1] || is(2, 0.0),
            Op::Select => args[2] == args[3],
            _ => false,
        };
        let twice = program.instrs[..i].contains(instr);
        let mut padded = [0.0; 4];
        padded.iter_mut().zip(&values).for_each(|(to, &value)| *to = value);
        let constant = values.len() == args.len() && instr.op().apply(padded).is_finite();
        (is_idle || twice || constant).then(|| format!("{:?} {args:?}", instr.op()))
    })
}

#[test]
fn folding_leaves_nothing_that_compilers_drop_and_keeps_finite_values() {
    let mut rng = ChaCha8Rng::seed_from_u64(11);
    let mut compared = 0;
    for _ in 0..20_000 {
        let program = random_program(&mut rng);
        let names = Names::new(["x", "y"], ["f", "g"]);
        let fold = folded(&program);
        let texts = || format!("{} -> {}", print(&program, &names), print(&fold, &names));
        assert_eq!(idle(&fold), None, "{}", texts());
        assert_eq!(folded(&fold), fold, "{}", texts());
        // In one the sign of a zero counts, the other is rounded unless its exponent is 1.
        let differs = program.instrs.iter().any(|i| matches!(i.op(), Op::Atan2 | Op::Pow));
        let unchanged = print(&program, &names) == print(&fold, &names);
        let quick = Simplifier::is_folded(&program) && are_distinct(&program.consts);
        assert!(!quick || unchanged, "{}", texts());
        for x in [[0.3, 0.6], [0.9, -0.15], [2.5, 1e-3]] {
            for (a, b) in program.evaluate(&x).into_iter().zip(fold.evaluate(&x)) {
                // Where something on the way is not finite, what is left may be.
                if !differs && a.is_finite() && b.is_finite() && a != b {
                    let through = every_value(&program, &x).iter().all(|value| value.is_finite());
                    assert!(!through, "{a} {b} at {x:?}: {}", texts());
                }
                compared += 1;
            }
        }
    }
    assert!(compared > 10_000, "{compared}");
}

fn every_value(program: &Program, x: &[f32]) -> Vec<f32> {
    let mut draft = program.clone().into_draft();
    draft.outputs = (0..draft.instrs.len()).map(|i| Arg::Result(i as u16)).collect();
    Program::verify(draft).unwrap().evaluate(x)
}

#[test]
fn cycles_are_those_of_the_folded_code() {
    let mut rng = ChaCha8Rng::seed_from_u64(12);
    let mut scratch = CostScratch::default();
    let profiles: Vec<Profile> =
        Profile::built_in().map(|name| Profile::find(name).unwrap()).collect();
    for _ in 0..5_000 {
        let program = random_program(&mut rng);
        let fold = folded(&program);
        for profile in &profiles {
            let cycles = profile.cycles(&fold, &mut scratch);
            assert_eq!(profile.cost(&program), profile.cost(&fold));
            assert!((profile.cost(&program).cycles - cycles).abs() < 1e-9);
            // Equal constants may be fitted apart.
            if are_distinct(&program.consts) {
                assert_eq!(profile.cycles(&program, &mut scratch), cycles);
            }
        }
    }
}

fn are_distinct(constants: &[f32]) -> bool {
    let mut bits: Vec<u32> = constants.iter().map(|c| c.to_bits()).collect();
    bits.sort_unstable();
    bits.windows(2).all(|pair| pair[0] != pair[1])
}

#[test]
fn equal_constants_are_costed_apart_while_they_are_fitted() {
    let draft = |values: [f32; 2]| {
        let mut draft = Draft { inputs: 1, ..Draft::default() };
        let terms = values.map(|value| {
            let constant = draft.constant(value);
            let power = draft.push(Op::Pow, &[Arg::Input(0), constant]);
            draft.push(Op::Exp2, &[power])
        });
        let sum = draft.push(Op::Sub, &terms);
        draft.outputs.push(sum);
        draft
    };
    let (gcn, mut scratch) = (Profile::find("gcn").unwrap(), CostScratch::default());
    let [equal, different] =
        [[0.75, 0.75], [0.75, 1.75]].map(|values| gcn.cycles(&draft(values), &mut scratch));
    assert_eq!(equal, different);
    assert_eq!(gcn.cost(&draft([0.75, 0.75])).cycles, 0.0);
}

#[test]
fn a_simplified_program_is_its_own_simplification_and_no_dearer() {
    let mut rng = ChaCha8Rng::seed_from_u64(13);
    let mut scratch = CostScratch::default();
    let gcn = Profile::find("gcn").unwrap();
    for _ in 0..40_000 {
        let program = random_program(&mut rng);
        let names = Names::new(["x", "y"], ["f", "g"]);
        let simple = simplified(&program);
        let again = simplified(&simple);
        let texts = || format!("{} -> {}", print(&program, &names), print(&simple, &names));
        assert_eq!(again, simple, "{} -> {}", texts(), print(&again, &names));
        assert_eq!(idle(&simple), None, "{}", texts());
        // Of several outputs one may be what another has for nothing but its sign; and of products taken
        // apart from their sums one may be shared.
        let mut one = program.clone().into_draft();
        one.outputs.truncate(1);
        let one = Program::verify(one).unwrap();
        let names = Names::new(["x", "y"], ["f"]);
        let [before, after] = [&one, &simplified(&one)].map(|p| gcn.cycles(p, &mut scratch));
        let after_text = print(&simplified(&one), &names);
        let fused = one.instrs.iter().any(|instr| instr.op() == Op::Mad);
        assert!(
            fused || after <= before,
            "{before} -> {after}: {} -> {after_text}",
            print(&one, &names)
        );
    }
}

/// Sums, products and quotients of sums whose terms have factors: with constants that can move in many ways.
#[test]
fn constants_of_rational_functions_come_to_rest() {
    const RATIONAL: [Op; 8] =
        [Op::Add, Op::Add, Op::Sub, Op::Mul, Op::Mul, Op::Div, Op::Rcp, Op::Neg];
    let mut rng = ChaCha8Rng::seed_from_u64(14);
    let mut scratch = CostScratch::default();
    let gcn = Profile::find("gcn").unwrap();
    let names = Names::new(["x", "y"], ["f"]);
    let value = |rng: &mut ChaCha8Rng| match rng.random_range(0..12) {
        0 => [0.0, 1.0, -1.0, 1e30, 3e38, 1e-38][rng.random_range(0..6)],
        _ => rng.random_range(-3.0..3.0f32),
    };
    for _ in 0..40_000 {
        let mut draft = Draft { inputs: 2, ..Draft::default() };
        let mut unread: Vec<Arg> = Vec::new();
        for _ in 0..rng.random_range(4..26) {
            let grows = unread.len() < 2 || rng.random_range(0..3) == 0;
            let result = if rng.random_range(0..16) == 0 {
                let values = [value(&mut rng), value(&mut rng)].map(|value| draft.constant(value));
                draft.push(RATIONAL[rng.random_range(0..RATIONAL.len())], &values)
            } else if grows {
                let value = draft.constant(value(&mut rng));
                draft.push(Op::Mul, &[Arg::Input(rng.random_range(0..2)), value])
            } else {
                let op = RATIONAL[rng.random_range(0..RATIONAL.len())];
                let at = rng.random_range(0..unread.len());
                let first = unread.swap_remove(at);
                let second = match rng.random_range(0..3) {
                    0 => draft.constant(value(&mut rng)),
                    _ => unread.pop().unwrap(),
                };
                draft.push(op, &[first, second])
            };
            unread.push(result);
        }
        draft.outputs = vec![*unread.last().unwrap()];
        let program = Program::verify(draft).unwrap();
        let simple = simplified(&program);
        let texts = || format!("{} -> {}", print(&program, &names), print(&simple, &names));
        assert_eq!(simplified(&simple), simple, "{}", texts());
        let [before, after] = [&program, &simple].map(|p| gcn.cycles(p, &mut scratch));
        // Constants that overflow together stay apart.
        let overflows = program.consts.iter().any(|c| *c != 0.0 && !(1e-9..1e9).contains(&c.abs()));
        assert!(overflows || after <= before, "{before} -> {after}: {}", texts());
        for x in [[0.3f32, 0.6], [0.9, 0.15]] {
            let [exact, rounded] = [&program, &simple].map(|p| f64::from(p.evaluate(&x)[0]));
            let steps = every_value(&program, &x);
            // Where nothing cancels or blows up on the way.
            if steps.iter().all(|v| v.abs() > 1e-2 && v.abs() < 1e2) {
                assert!(
                    (exact - rounded).abs() < 1e-2 * exact.abs(),
                    "{exact} {rounded}: {}",
                    texts()
                );
            }
        }
    }
}
