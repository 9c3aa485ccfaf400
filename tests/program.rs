//! Laws of programs, on random ones.

use lgp::op::Op;
use lgp::program::{
    Arg, Constants, Draft, Names, Program, effective, parse, parse_open, print, structural_hash,
};
use proptest::prelude::*;

/// Any operation, arguments taken modulo what exists, constants of every size and sign.
fn programs() -> impl Strategy<Value = Program> {
    let constant =
        prop_oneof![-10.0f32..10.0, Just(0.0), Just(-0.0), Just(1.0), prop::num::f32::NORMAL,];
    let instr = (0..Op::ALL.len(), prop::array::uniform4(0u16..1000));
    (
        prop::collection::vec(constant, 1..6),
        prop::collection::vec(instr, 1..20),
        prop::collection::vec(0u16..1000, 1..4),
    )
        .prop_map(|(consts, instrs, outputs)| {
            let mut draft = Draft { inputs: 2, consts, ..Draft::default() };
            let constants = draft.consts.len() as u16;
            let pick = |n: u16, earlier: u16| match n % (2 + constants + 2 * earlier) {
                k if k < 2 => Arg::Input(k),
                k if k < 2 + constants => Arg::Const(k - 2),
                k => Arg::Result((k - 2 - constants) / 2),
            };
            for (i, (op, args)) in instrs.into_iter().enumerate() {
                draft.push(Op::ALL[op], &args.map(|n| pick(n, i as u16)));
            }
            let instructions = draft.instrs.len() as u16;
            draft.outputs = outputs.into_iter().map(|n| pick(n, instructions)).collect();
            Program::verify(draft).expect("arguments are earlier ones")
        })
}

fn names(program: &Program) -> Names {
    let outputs = (0..program.outputs.len()).map(|i| format!("y{i}"));
    Names { inputs: vec!["n_dot_v".into(), "cos".into()], outputs: outputs.collect() }
}

fn bits(values: &[f32]) -> Vec<Option<u32>> {
    values.iter().map(|v| (!v.is_nan()).then(|| v.to_bits())).collect()
}

fn hash(program: &Program) -> u64 {
    structural_hash(program, Constants::Exact, &mut Vec::new())
}

const SAMPLES: [[f32; 2]; 5] =
    [[0.3, 0.7], [0.0, -0.0], [-2.5, 1.0], [1e-30, 4e30], [f32::NAN, 1.0]];

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn print_and_parse_are_inverse(program in programs()) {
        let names = names(&program);
        let text = print(&program, &names);
        let parsed = parse(&text, &names).map_err(|e| TestCaseError::fail(format!("{text}\n{e}")))?;
        prop_assert_eq!(print(&parsed, &names), print(&effective(&parsed), &names));
        prop_assert!(![" + -", " - -"].iter().any(|signs| text.contains(signs)), "{}", text);
        // Signs stand elsewhere than they did, and stay there.
        let again = parse(&print(&parsed, &names), &names).unwrap();
        prop_assert_eq!(hash(&again), hash(&parsed), "{}", text);
        for sample in SAMPLES {
            prop_assert_eq!(bits(&parsed.evaluate(&sample)), bits(&program.evaluate(&sample)));
        }
    }

    #[test]
    fn effective_code_evaluates_bit_for_bit_as_the_whole(program in programs()) {
        let effective = effective(&program);
        prop_assert!(effective.instrs.len() <= program.instrs.len());
        for sample in SAMPLES {
            prop_assert_eq!(bits(&effective.evaluate(&sample)), bits(&program.evaluate(&sample)));
        }
    }

    #[test]
    fn the_hash_sees_neither_introns_nor_operand_order_where_it_commutes(
        program in programs(), swap in prop::collection::vec(any::<bool>(), 20), op in 0..Op::ALL.len()
    ) {
        prop_assert_eq!(hash(&effective(&program)), hash(&program));
        let mut draft = program.clone().into_draft();
        draft.push(Op::ALL[op], &[Arg::Input(0); 4]);
        for (instr, swap) in draft.instrs.iter_mut().zip(swap) {
            if swap && instr.op().commutes() {
                instr.args_mut().swap(0, 1);
            }
        }
        prop_assert_eq!(hash(&Program::verify(draft).unwrap()), hash(&program));
    }

    #[test]
    fn the_hash_sees_a_change_of_operation(program in programs(), at in 0usize..20) {
        let program = effective(&program);
        prop_assume!(!program.instrs.is_empty());
        let at = at % program.instrs.len();
        let mut draft = program.clone().into_draft();
        let instr = draft.instrs[at];
        let other = if instr.op() == Op::Sub { Op::Min } else { Op::Sub };
        let mut args = instr.args().to_vec();
        args.resize(4, Arg::Input(0));
        draft.instrs[at] = lgp::program::Instr::new(other, &args);
        prop_assert_ne!(hash(&Program::verify(draft).unwrap()), hash(&program));
    }
}

#[test]
fn signs_stand_where_there_are_fewest() {
    let names = Names::new(["x", "t0"], ["y"]);
    for (text, expected) in [
        ("y = 0.23 - -0.96/t0", "y = 0.23 + 0.96/t0"),
        ("y = x + -0.004", "y = x - 0.004"),
        ("y = -0.5 + x", "y = x - 0.5"),
        ("y = x + -(x*t0)", "y = x - x*t0"),
        ("y = x - -(x + t0)", "y = x + (x + t0)"),
        ("y = x - t0*-2", "y = x + 2*t0"),
        ("y = -2*-x", "y = 2*x"),
        ("y = -(-x)", "y = x"),
        ("y = -x/-t0", "y = x/t0"),
        ("y = -(-2*x)", "y = 2*x"),
        ("y = -x + -t0", "y = -x - t0"),
        ("y = -(x - t0)", "y = -(x - t0)"),
        ("y = max(-x, -1)", "y = max(-x, -1)"),
        ("y = x - 0", "y = x - 0"),
        ("y = x + -0", "y = x - 0"),
    ] {
        let program = parse(text, &names).unwrap();
        assert_eq!(print(&program, &names), expected, "{text}");
        let again = parse(expected, &names).unwrap();
        for sample in SAMPLES {
            assert_eq!(bits(&again.evaluate(&sample)), bits(&program.evaluate(&sample)), "{text}");
        }
    }
}

#[test]
fn text_of_any_length_is_read_or_refused_and_its_places_are_shown() {
    let names = Names::new(["x"], ["y"]);
    let sum = |terms: u32, end: &str| {
        let terms: Vec<String> = (0..terms).map(|i| format!("x*{i}")).collect();
        format!("y = {}{end}", terms.join(" + "))
    };
    assert_eq!(parse(&sum(30_000, ""), &names).unwrap().instrs.len(), 59_999);
    let shown = |text: &str| {
        let message = parse(text, &names).unwrap_err().to_string();
        assert!(message.len() < 700, "{}", message.len());
        message
    };
    assert!(shown(&sum(200_000, "")).contains("at most 1 MiB"));
    assert!(shown(&sum(70_000, "")).contains("too many operations; a formula has at most 65535"));
    assert!(shown(&sum(30_000, " + z")).contains("unknown name `z`"));
    assert!(shown(&format!("y = {}\u{1b}", " ".repeat(70_000))).contains("column 70005"));
    assert!(shown(&format!("y = {}", "x + ".repeat(20_000))).contains("ends where a value"));
    let far: String = (0..20_000).map(|i| format!("t{i} = x; ")).collect();
    assert!(shown(&format!("{far}y = t2000q")).contains("did you mean"));
    let long = "a".repeat(500_000);
    assert!(parse(&format!("{long} = x; y = {long}b"), &names).is_err());
    let inputs: Vec<String> = (0..70_000).map(|i| format!("v{i}")).collect();
    let open = parse_open(&format!("y = {}", inputs.join("+")), &[]).unwrap_err().to_string();
    assert!(open.contains("too many inputs; a formula has at most 65535"), "{}", &open[..200]);
}

#[test]
fn drafts_that_refer_to_nothing_are_refused() {
    let mut draft = Draft { inputs: 1, ..Draft::default() };
    assert!(Program::verify(draft.clone()).is_err(), "no output");
    let forward = draft.push(Op::Add, &[Arg::Result(0), Arg::Input(0)]);
    draft.outputs = vec![forward];
    let error = Program::verify(draft.clone()).unwrap_err().to_string();
    assert!(error.contains("does not come before"), "{error}");
    draft.instrs[0] = lgp::program::Instr::new(Op::Add, &[Arg::Input(1), Arg::Input(0)]);
    assert!(Program::verify(draft.clone()).unwrap_err().to_string().contains("input 1"));
    draft.instrs[0] = lgp::program::Instr::new(Op::Add, &[Arg::Const(0), Arg::Input(0)]);
    assert!(Program::verify(draft.clone()).unwrap_err().to_string().contains("constant 0"));
    draft.consts = vec![f32::NAN];
    assert!(Program::verify(draft).unwrap_err().to_string().contains("NaN"));
}

#[test]
fn text_means_what_the_grammar_says() {
    let names = Names::new(["x", "y"], ["f"]);
    let value = |text: &str, x: f32, y: f32| parse(text, &names).unwrap().evaluate(&[x, y])[0];
    assert_eq!(value("f = -x^2", 3.0, 0.0), -9.0);
    assert_eq!(value("f = 2*x^3/3", 3.0, 0.0), 18.0);
    assert_eq!(value("f = x^2^3", 2.0, 0.0), 256.0);
    assert_eq!(value("f = x - y - 1", 5.0, 2.0), 2.0);
    assert_eq!(value("f = x/y/2", 8.0, 2.0), 2.0);
    assert_eq!(value("t = x + 1; f = t*t # a square", 2.0, 0.0), 9.0);
    assert_eq!(value("f = select(x > y, 1, 2)", 2.0, 1.0), 1.0);
    assert_eq!(value("f = select(x < y, 1, 2)", 2.0, 1.0), 2.0);
    assert_eq!(value("f = atan2(y, x)", -1.0, 0.0), std::f32::consts::PI);
    assert_eq!(value("f = fma(x,\n y, .5e1)", 2.0, 3.0), 11.0);
    assert_eq!(parse("f = x^8", &names).unwrap().instrs.len(), 3);
}

#[test]
fn text_is_read_as_shader_programmers_write_it() {
    let names = Names::new(["x", "y"], ["f"]);
    let value = |text: &str, x: f32, y: f32| parse(text, &names).unwrap().evaluate(&[x, y])[0];
    let check = |text: &str, at: [f32; 2], expected: f32| {
        let found = value(&format!("f = {text}"), at[0], at[1]);
        assert!((found - expected).abs() <= 1e-6 * expected.abs(), "{text}: {found}");
    };
    check("1.0f*x + .5h - 1e-1F*y", [2.0, 10.0], 1.5);
    check("pow(x, 2.0) // a square", [3.0, 0.0], 9.0);
    check("mix(x, y, 0.25)", [2.0, 6.0], 3.0);
    check("frac(x) + inversesqrt(y)", [2.25, 4.0], 0.75);
    check("atan(y, x)", [-1.0, 0.0], std::f32::consts::PI);
    check("atan(y)", [0.0, 1.0], std::f32::consts::FRAC_PI_4);
    for (x, clamped) in [(-3.0, -1.0), (0.5, 0.5), (9.0, 2.0)] {
        check("clamp(x, -1.0, 2.0)", [x, 0.0], clamped);
    }
    for (x, step) in [(0.5, 0.0), (1.0, 0.0), (1.5, 0.15625), (2.0, 0.5), (3.0, 1.0), (4.0, 1.0)] {
        check("smoothstep(1.0, 3.0, x)", [x, 0.0], step);
    }
    check("mod(x, 3.0)", [-1.0, 0.0], 2.0);
    check("ceil(x)*10 + ceil(y)", [1.25, -1.25], 19.0);
    check("degrees(radians(x)) + log10(y)", [30.0, 1000.0], 33.0);
    for (sign, at) in [("<", [1, 2, 2]), ("<=", [1, 1, 2]), (">", [2, 2, 1]), (">=", [2, 1, 1])] {
        for (y, expected) in [(3.0, at[0]), (2.0, at[1]), (1.0, at[2])] {
            check(&format!("x {sign} y ? 1 : 2"), [2.0, y], expected as f32);
            check(&format!("3*((x + 0) {sign} y ? 1 : 2)"), [2.0, y], 3.0 * expected as f32);
            check(&format!("(x {sign} (y)) ? 1 : 2"), [2.0, y], expected as f32);
            check(&format!("select(x {sign} y, 1, 2)"), [2.0, y], expected as f32);
        }
    }
    let nested = "x < 1 ? 10 : x < 2 ? 20 : y > 0 ? 30 : 40";
    for (at, expected) in [([0.5, 0.0], 10.0), ([1.5, 0.0], 20.0), ([3.0, 1.0], 30.0)] {
        check(nested, at, expected);
    }
    check("(x < 1 ? 1 : 2) < y ? 5 : 6", [0.0, 1.5], 5.0);
}

#[test]
fn vectors_have_components_lengths_and_products() {
    let names = Names::new(["x", "y", "z"], ["f"]);
    let check = |text: &str, expected: f32| {
        let found = parse(text, &names).unwrap().evaluate(&[3.0, 4.0, 12.0])[0];
        assert!((found - expected).abs() <= 1e-6 * expected.abs(), "{text}: {found}");
    };
    check("v = (x, y, z); f = v.x + 10*v.y + 100*v.z", 1243.0);
    check("v = (x, y, z); w = v.zyx; u = w.gb; f = w.r + 10*u.y", 42.0);
    check("v = (x, y, z); f = dot(v, v.yxz)", 168.0);
    check("f = length((x, y, z)) + length((-x, 4))", 18.0);
    check("v = (x, y, z); n = normalize(v); f = dot(n, v)", 13.0);
    check("g(v) = v.y*v.w; f = g((x, y, z, x))", 12.0);
    let error = |text: &str| parse(text, &names).unwrap_err().to_string();
    for (text, expected) in [
        ("f = x.y", "`x` is one value, and has no components `y`"),
        ("v = (x, y); f = v.z", "`v` has the components `xy`, and no `z`"),
        ("v = (x, y); f = v.xg", "`v` has the components `xy`, and no `xg`"),
        ("f = w.x", "unknown name `w`"),
        ("v = (x, y); v.x = 1; f = v.y", "components cannot be assigned; assign all of `v`"),
        ("f = dot((x, y), (x, y, z))", "do not go together"),
        ("f = length(-x)", "`length` is of vectors, not of single values"),
        ("f = dot(x)", "`dot` takes 2 arguments, not 1"),
    ] {
        assert!(error(text).contains(expected), "{text}: {}", error(text));
    }
}

#[test]
fn errors_say_where_and_what_was_meant() {
    let names = Names::new(["n_dot_v", "roughness"], ["bias"]);
    let error = |text: &str| parse(text, &names).unwrap_err().to_string();
    for (text, expected) in [
        ("bias = rougness", "did you mean `roughness`?"),
        ("bias = sqt(roughness)", "did you mean `sqrt`?"),
        ("bias = roughness^7", "pow(x, 7)"),
        ("bias = (roughness", "expected `)`"),
        ("bias = ", "ends where a value is expected"),
        ("bias = 1 2", "expected an operator"),
        ("bais = 1", "output `bias` is never assigned; did you mean `bais`?"),
        ("bias = 1; bias = 2", "assigned twice"),
        ("roughness = 1; bias = 2", "is an input"),
        ("bias = min(roughness)", "takes 2 arguments, not 1"),
        ("bias = $a*roughness", "free constant"),
        ("bias = 1e99", "too large"),
        ("bias = add(1, 2)", "no function form"),
        ("bias = roughness ? 1 : 2", "`?` needs a comparison before it"),
        ("bias = roughness < 1 ? 2", "expected `:` between the two values"),
        ("bias = roughness < 1", "expected `?` after the condition"),
        ("bias = roughness == 1 ? 2 : 3", "expected an operator"),
        ("bias = clmap(roughness, 0, 1)", "did you mean `clamp`?"),
        ("bias = clamp(roughness)", "`clamp` takes 3 arguments, not 1"),
        ("bias = mix(roughness)", "`mix` takes 3 arguments, not 1"),
        ("bias = 2h", "expected an operator"),
        ("bias = 2.0fx", "expected an operator"),
        ("bias = roughness @ 1", "no meaning"),
        (&format!("bias = {}", "1 < 2 ? 3 : ".repeat(50_000)), "nested more than"),
        (&format!("bias = {}", "mix(".repeat(100_000)), "nested more than"),
        (&format!("bias = {}", "(".repeat(100_000)), "nested more than"),
        (&format!("bias = {}1", "-".repeat(100_000)), "nested more than"),
        ("t = 1;\nbias = nope", "line 2, column 8"),
    ] {
        let message = error(text);
        assert!(message.contains(expected), "{text:.80}: {message}");
    }
}
