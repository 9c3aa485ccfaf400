//! What is emitted, read back, means what it meant.

use crate::programs::{EVERY_OPERATION, SAMPLES, names, nasty_columns, programs, programs_of};
use crate::{bits, text};
use lgp::emit::{Language, read_back};
use lgp::op::Op;
use lgp::program::{Arg, Draft, Names, Program, parse};
use proptest::prelude::*;

#[test]
fn nasty_names_are_read_back_as_they_were() {
    let (program, names) = nasty_columns();
    let inputs: Vec<f32> = (0..program.inputs).map(|i| (i as f32).sin()).collect();
    for &language in Language::SHADING {
        let code = text(language, &program, &names, "dfg", &[]);
        let (read, read_names) = read_back(language, &code).unwrap();
        assert_eq!(read_names, names, "{code}");
        assert_eq!(bits(&read.evaluate(&inputs)), bits(&program.evaluate(&inputs)));
    }
}

#[test]
fn every_operation_is_read_back_with_its_meaning() {
    let names = Names::new(["x", "y", "z", "w"], ["f"]);
    for &language in Language::SHADING {
        for &op in Op::ALL {
            for program in programs_of(op) {
                let code = text(language, &program, &names, "f", &[]);
                let (read, _) = read_back(language, &code).unwrap_or_else(|e| panic!("{code}{e}"));
                for sample in SAMPLES {
                    let (expected, found) =
                        (program.evaluate(&sample)[0], read.evaluate(&sample)[0]);
                    let tolerance = match (language, op) {
                        (Language::Glsl, Op::Mad) => 1e-6 * expected.abs().max(1.0),
                        _ => 0.0,
                    };
                    let same = bits(&[expected]) == bits(&[found]);
                    assert!(
                        same || (expected - found).abs() <= tolerance,
                        "{code}{sample:?}: {found}, not {expected}"
                    );
                }
            }
        }
    }
}

/// The same instructions as the language computes them.
fn with_separate_multiply_and_add(program: &Program) -> Program {
    let mut draft = Draft { inputs: program.inputs, ..Draft::default() };
    draft.consts = program.consts.clone();
    let mut moved = Vec::new();
    let mut folded: Vec<bool> = Vec::new();
    for instr in &program.instrs {
        let constant = instr.args().iter().all(|&arg| match arg {
            Arg::Input(_) => false,
            Arg::Const(_) => true,
            Arg::Result(i) => folded[usize::from(i)],
        });
        let args: Vec<Arg> = instr.args().iter().map(|&arg| at(&moved, arg)).collect();
        let result = match (instr.op(), args.as_slice()) {
            (Op::Mad, &[a, b, c]) if !constant => {
                let product = draft.push(Op::Mul, &[a, b]);
                draft.push(Op::Add, &[product, c])
            }
            (op, args) => draft.push(op, args),
        };
        moved.push(result);
        folded.push(constant);
    }
    draft.outputs = program.outputs.iter().map(|&arg| at(&moved, arg)).collect();
    Program::verify(draft).unwrap()
}

fn at(moved: &[Arg], arg: Arg) -> Arg {
    match arg {
        Arg::Result(i) => moved[usize::from(i)],
        other => other,
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn what_is_emitted_reads_back_as_it_was(program in programs()) {
        let names = names(&program);
        for &language in Language::SHADING {
            let code = text(language, &program, &names, "f", &[]);
            let read = read_back(language, &code);
            let (read, read_names) = read.map_err(|e| TestCaseError::fail(format!("{code}\n{e}")))?;
            prop_assert_eq!(&read_names, &names);
            prop_assert!(code.lines().all(|line| line.len() <= 100), "{}", code);
            let meant = match language {
                Language::Glsl => with_separate_multiply_and_add(&program),
                _ => program.clone(),
            };
            for sample in SAMPLES {
                let (found, expected) = (read.evaluate(&sample[..2]), meant.evaluate(&sample[..2]));
                prop_assert_eq!(bits(&found), bits(&expected), "{}", code);
            }
        }
    }

    #[test]
    fn no_text_makes_the_reader_panic(
        start in 0usize..400, length in 0usize..60, inserted in "[-+*/(){}<>=?:;,.0-9a-fx_ ·\n]{0,12}"
    ) {
        let names = Names::new(["x", "y"], ["a", "b", "c", "d"]);
        let program = parse(EVERY_OPERATION, &names).unwrap();
        for &language in Language::SHADING {
            let mut code = text(language, &program, &names, "f", &[]);
            let start = start.min(code.len());
            let end = (start + length).min(code.len());
            code.replace_range(start..end, &inserted);
            let _ = read_back(language, &code);
        }
    }
}

#[test]
fn errors_say_where_and_what_is_wrong() {
    let error = |body: &str| {
        let code = format!("float f(float x, float n_dot_v) {{\n    {body}\n}}\n");
        read_back(Language::Hlsl, &code).unwrap_err().to_string()
    };
    let deep = format!("return {}x;", "(".repeat(100_000));
    let negative = format!("return {}x;", "-".repeat(100_000));
    for (body, expected) in [
        ("return n_dot_w;", "did you mean `n_dot_v`?"),
        ("return x", "expected `;`"),
        ("return saturat(x);", "did you mean `saturate`?"),
        ("return exp2(x, x);", "not read with these arguments"),
        ("return x ? 1.0 : 2.0;", "expected a comparison"),
        ("return x < 1.0;", "expected a float or a vector"),
        ("return 1e99;", "too large"),
        ("return 1.2.3;", "`1.2.3` is no number"),
        ("float y;", "expected `=`"),
        ("if (x < 1.0) { return x; } return x;", "expected `=`"),
        ("return x; } float g(float x) { return x;", "no more than one function"),
        ("return é;", "has no meaning here"),
        ("float y = x;\n", "line 4, column 1"),
        (&deep, "nested more than"),
        (&negative, "nested more than"),
    ] {
        let message = error(body);
        assert!(message.contains(expected), "{}: {}", &body[..body.len().min(60)], message);
    }
    for language in Language::SHADING {
        for text in ["", "struct", "struct x {", "f", "f(", "f()", "f(x) {", "fn f(x:", "return"] {
            assert!(read_back(*language, text).is_err(), "{text}");
        }
    }
}

#[test]
fn edited_snippets_are_read() {
    let (program, names) = read_back(
        Language::Glsl,
        "highp float f(in float n_dot_v /* cosine */, float r) {
            precise float a = n_dot_v > r ? 1.f : +r; // larger
            return a;
        }"
        .replace("+r", "-(r)")
        .as_str(),
    )
    .unwrap();
    assert_eq!(names, Names::new(["n_dot_v", "r"], ["a"]));
    assert_eq!(program.evaluate(&[0.2, 0.5]), [-0.5]);
    assert_eq!(program.evaluate(&[0.7, 0.5]), [1.0]);
}
