//! What is emitted, read back, means what it meant.

use crate::programs::{EVERY_OPERATION, SAMPLES, names, nasty_columns, programs, programs_of};
use crate::{bits, text};
use ::half::f16;
use lgp::emit::{Language, Snippet, emit, emit_half, mathml, read_back};
use lgp::eval::{Arithmetic, Half};
use lgp::op::{MAX_ARITY, Op};
use lgp::program::{Arg, Draft, Names, Program, parse};
use proptest::prelude::*;

/// The languages that are read back.
fn readable() -> impl Iterator<Item = Language> {
    Language::ALL.iter().copied()
}

/// Those with a multiply-add of one rounding.
fn has_multiply_add(language: Language) -> bool {
    use Language::{C, Cuda, Hlsl, Msl, Rust, Slang, Wgsl};
    [C, Cuda, Hlsl, Msl, Rust, Slang, Wgsl].contains(&language)
}

/// Those that write other numbers for infinities and NaNs.
fn has_finite_numbers_alone(language: Language) -> bool {
    [Language::Osl, Language::MaterialX].contains(&language)
}

/// Whether some constant part of the program is not finite.
fn has_non_finite_constants(program: &Program) -> bool {
    let known = depends_on_no_input(program);
    let mut results: Vec<f32> = Vec::new();
    for (instr, known) in program.instrs.iter().zip(known) {
        let mut args = [0.0; MAX_ARITY];
        for (to, &arg) in args.iter_mut().zip(instr.args()) {
            *to = match arg {
                Arg::Input(_) => 0.0,
                Arg::Const(i) => program.consts[usize::from(i)],
                Arg::Result(i) => results[usize::from(i)],
            };
        }
        // A multiply-add's product of numbers is one, too.
        if instr.op() == Op::Mad && !(args[0] * args[1]).is_finite() {
            return true;
        }
        // And an interpolation's difference.
        if instr.op() == Op::Lerp && !(args[1] - args[0]).is_finite() {
            return true;
        }
        results.push(if known { instr.op().apply(args) } else { 0.0 });
    }
    results.iter().any(|value| !value.is_finite())
}

#[test]
fn a_root_below_1_is_a_reciprocal_root_only_where_it_is_alone() {
    let names = Names::new(["x", "b"], ["y"]);
    for formula in ["y = 1/(sqrt(x)*x + 1/x)", "y = rsqrt(x*rsqrt(b))", "y = 1/(sqrt(x) + b)"] {
        let program = parse(formula, &names).unwrap();
        let code = text(Language::Latex, &program, &names, "f", &[]);
        let read = read_back(Language::Latex, &code).unwrap();
        assert_eq!(read.evaluate(&[0.3, 0.7]), program.evaluate(&[0.3, 0.7]), "{code}");
    }
}

#[test]
fn nasty_names_are_read_back_as_they_were() {
    let (program, names) = nasty_columns();
    let inputs: Vec<f32> = (0..program.inputs).map(|i| (i as f32).sin()).collect();
    for language in readable() {
        let code = text(language, &program, &names, "dfg", &[]);
        let read = read_back(language, &code).unwrap();
        assert_eq!(read.names, names, "{code}");
        if has_finite_numbers_alone(language) {
            continue;
        }
        assert_eq!(bits(&read.evaluate(&inputs)), bits(&program.evaluate(&inputs)));
    }
}

#[test]
fn every_operation_is_read_back_with_its_meaning() {
    let names = Names::new(["x", "y", "z", "w"], ["f"]);
    for language in readable() {
        for &op in Op::ALL {
            for program in programs_of(op) {
                if has_finite_numbers_alone(language) && has_non_finite_constants(&program) {
                    continue;
                }
                let code = text(language, &program, &names, "f", &[]);
                let read = read_back(language, &code).unwrap_or_else(|e| panic!("{code}{e}"));
                for sample in SAMPLES {
                    let (expected, found) =
                        (program.evaluate(&sample)[0], read.evaluate(&sample)[0]);
                    let tolerance = match (language, op) {
                        (Language::Latex, _) => 1e-6 * expected.abs(),
                        (_, Op::Mad) if !has_multiply_add(language) => {
                            1e-6 * expected.abs().max(1.0)
                        }
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

/// Whether each instruction's value is known beforehand.
fn depends_on_no_input(program: &Program) -> Vec<bool> {
    let mut known: Vec<bool> = Vec::new();
    for instr in &program.instrs {
        let all = instr.args().iter().all(|&arg| match arg {
            Arg::Input(_) => false,
            Arg::Const(_) => true,
            Arg::Result(i) => known[usize::from(i)],
        });
        known.push(all);
    }
    known
}

/// The outputs in halves, but for the instructions that stay in single precision.
fn mixed(program: &Program, stay_single: &[usize], inputs: &[f32]) -> Vec<f32> {
    let half = |x: f32| f16::from_f32(x).to_f32();
    let mut results: Vec<f32> = Vec::new();
    let value = |arg: Arg, results: &[f32]| match arg {
        Arg::Input(i) => half(inputs[usize::from(i)]),
        Arg::Const(i) => program.consts[usize::from(i)],
        Arg::Result(i) => results[usize::from(i)],
    };
    for (i, instr) in program.instrs.iter().enumerate() {
        let mut args = [0.0; MAX_ARITY];
        args.iter_mut().zip(instr.args()).for_each(|(to, &arg)| *to = value(arg, &results));
        results.push(match stay_single.contains(&i) {
            true => instr.op().apply(args),
            false => Half::default().apply(instr.op(), args.map(f16::from_f32)).to_f32(),
        });
    }
    program.outputs.iter().map(|&arg| half(value(arg, &results))).collect()
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
        for language in readable() {
            let code = text(language, &program, &names, "f", &[]);
            let read = read_back(language, &code);
            let read = read.map_err(|e| TestCaseError::fail(format!("{code}\n{e}")))?;
            prop_assert_eq!(&read.names, &names);
            prop_assert!(!read.in_half);
            let long = |line: &str| {
                let is_head = line.starts_with("import") || line.starts_with("void");
                line.len() > 100 && !is_head
            };
            prop_assert!(language == Language::Latex || !code.lines().any(long), "{}", code);
            // An equation does not say in what order it is computed.
            if language == Language::Latex {
                continue;
            }
            if has_finite_numbers_alone(language) && has_non_finite_constants(&program) {
                continue;
            }
            let meant = match has_multiply_add(language) {
                false => with_separate_multiply_and_add(&program),
                true => program.clone(),
            };
            for sample in SAMPLES {
                let (found, expected) = (read.evaluate(&sample[..2]), meant.evaluate(&sample[..2]));
                prop_assert_eq!(bits(&found), bits(&expected), "{}", code);
            }
        }
    }

    #[test]
    fn halves_are_read_back_as_they_were(program in programs(), single in prop::collection::vec(0..5, 40)) {
        let names = names(&program);
        let known = depends_on_no_input(&program);
        let stay_single: Vec<usize> =
            (0..program.instrs.len()).filter(|&i| single[i] == 0 && !known[i]).collect();
        let snippet = Snippet::new(&program, &names, "f");
        for language in readable().filter(|language| language.has_halves()) {
            let code = emit_half(language, &snippet, &stay_single).unwrap();
            let read = read_back(language, &code);
            let read = read.map_err(|e| TestCaseError::fail(format!("{code}\n{e}")))?;
            prop_assert!(read.in_half);
            prop_assert_eq!(&read.names, &names);
            // The program may be what spells another operation in this language.
            let literal = read.literal.as_deref().cloned();
            let read = if read.is(&program) { read } else { literal.unwrap_or(read) };
            prop_assert!(read.is(&program), "{}", code);
            let mads = program.instrs.iter().any(|instr| instr.op() == Op::Mad);
            if mads && !has_multiply_add(language) {
                continue;
            }
            for sample in SAMPLES {
                let (found, expected) =
                    (read.evaluate(&sample[..2]), mixed(&program, &stay_single, &sample[..2]));
                prop_assert_eq!(bits(&found), bits(&expected), "{}", code);
            }
        }
    }

    #[test]
    fn no_two_signs_stand_side_by_side(program in programs()) {
        let names = names(&program);
        let snippet = Snippet::new(&program, &names, "f");
        let halves = Language::ALL.iter().filter_map(|&l| emit_half(l, &snippet, &[]));
        let singles = Language::ALL.iter().map(|&l| emit(l, &snippet).replace("<!--", "").replace("-->", ""));
        for code in halves.chain(singles) {
            prop_assert!(![" + -", " - -", "--"].iter().any(|signs| code.contains(signs)), "{}", code);
        }
        let page = mathml(&snippet);
        prop_assert!(!page.contains("<mo>+</mo><mrow><mo>−</mo>"), "{}", page);
    }

    #[test]
    fn no_text_makes_the_reader_panic(
        start in 0usize..400, length in 0usize..60, inserted in "[-+*/(){}<>=?:;,.0-9a-fx_ ·\n]{0,12}"
    ) {
        let names = Names::new(["x", "y"], ["a", "b", "c", "d"]);
        let program = parse(EVERY_OPERATION, &names).unwrap();
        for language in readable() {
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
    let negative = format!("return {}x;", "- ".repeat(100_000));
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
        ("if (x < 1.0) { return x; } return x;", "`if` cannot be the type of a local"),
        ("return x; } float g(float x) { return x;", "no more than one function"),
        ("return é;", "has no meaning here"),
        ("float y = x;\n", "line 4, column 1"),
        (&deep, "nested more than"),
        (&negative, "nested more than"),
    ] {
        let message = error(body);
        assert!(message.contains(expected), "{}: {}", &body[..body.len().min(60)], message);
    }
    for language in readable() {
        for text in ["", "struct", "struct x {", "f", "f(", "f()", "f(x) {", "fn f(x:", "return"] {
            assert!(read_back(language, text).is_err(), "{text}");
        }
    }
}

/// What a compiler takes for something else, or not at all, in a function of floats.
#[test]
fn what_compilers_read_otherwise_is_refused() {
    let c = |language: Language, body: &str| {
        let code = format!("float f(float x, float y) {{\n    {body}\n}}\n");
        read_back(language, &code).map(|read| read.evaluate(&[0.3, 0.7])[0])
    };
    let wgsl = |body: &str| {
        let code = format!("fn f(x: f32, y: f32) -> f32 {{\n    {body}\n}}\n");
        read_back(Language::Wgsl, &code).map(|read| read.evaluate(&[0.3, 0.7])[0])
    };
    for (body, expected) in [
        ("return x*(19/80);", "arithmetic of integers"),
        ("return x + (1 - 2);", "arithmetic of integers"),
        ("return x*(0.1*0.3);", "write the result"),
        ("return x + 1.0/0.0;", "make no finite one"),
        ("return x*010;", "octal"),
        ("return x*3000000000;", "too large for an integer"),
        ("return x*1.0l;", "no number of single or half precision"),
        ("return x*2u;", "no number of single or half precision"),
        ("return x --y;", "changes a value"),
        ("return x + (x < y);", "expected a float"),
        ("int t = x; return t;", "`int` cannot be the type of a local"),
        ("double t = x; return t;", "`double` cannot be the type of a local"),
        ("bool t = x; return t;", "`bool` cannot be the type of a local"),
        ("uint t = x; return x;", "`uint` cannot be the type of a local"),
        ("float2 t = x; return x;", "`float2`"),
        ("auto t = x; return t;", "`auto` cannot be the type of a local"),
        ("float t = x; float t = y; return t;", "`t` is declared twice"),
        ("float x = y; return x;", "`x` is declared twice"),
        ("x = y; return x;", "`x` is changed"),
        ("float t = x; t = y; return t;", "`t` is changed"),
        ("float exp2 = x; return exp2;", "means something"),
        ("float f = x; return f;", "`f` is declared twice"),
        ("float t = x; // note \\\n return t;", "backslash"),
        ("float t = x; // note \\ \n return t;", "backslash"),
        ("float t = x; // note ??/\n return t;", "backslash"),
        ("/* \\\n */ return x;", "backslash"),
        ("#define x y\n return x;", "preprocessor"),
        ("#if 0\n return x;\n#else\n return y;\n#endif", "preprocessor"),
        ("return x; // \r + y;", "ends a line"),
        ("return x; // \u{2028} + y;", "ends a line"),
        ("return x; /* without end", "without an end"),
        ("return float2(x, y);", "2 values where the function returns 1"),
    ] {
        for language in [Language::Hlsl, Language::Msl, Language::Slang, Language::Glsl] {
            let types = ["float2", "vec2"];
            let body = if language == Language::Glsl {
                body.replace(types[0], types[1])
            } else {
                body.to_owned()
            };
            let expected = if language == Language::Glsl {
                expected.replace(types[0], types[1])
            } else {
                expected.to_owned()
            };
            let message = c(language, &body).unwrap_err().to_string();
            assert!(message.contains(&expected), "{language}: {body}: {message}");
        }
    }
    for (body, expected) in [
        ("return x*(19/80);", "arithmetic of integers"),
        ("let t = 2; return x*f32(t);", "an integer, and so is the local"),
        ("let t: i32 = 2; return x;", "`i32` cannot be the type of a local"),
        ("let t: f16 = 2.0; return x;", "a half in a function of floats"),
        ("return x < y ? x : y;", "WGSL has no `?`"),
        ("return x*1.0h;", "an f16 meets an f32"),
        ("let x = y; return x;", "`x` is declared twice"),
        ("const t = x; return t;", "of numbers alone"),
        ("float t = x; return t;", "expected a local"),
    ] {
        let message = wgsl(body).unwrap_err().to_string();
        assert!(message.contains(expected), "{body}: {message}");
    }
    // An integer beside a float is one, but in GLSL ES; as an argument of an overloaded function it is not.
    for body in ["return 2*x;", "return x - 1;", "return -2*x/3;", "return x < 1 ? x : 2*y;"] {
        let floats = body.replace('1', "1.0").replace('2', "2.0").replace('3', "3.0");
        let expected = c(Language::Hlsl, &floats).unwrap();
        assert_eq!(c(Language::Hlsl, body).unwrap(), expected);
        assert_eq!(c(Language::Msl, body).unwrap(), expected);
        if !body.contains('?') {
            assert_eq!(wgsl(body).unwrap(), expected);
        }
        let message = c(Language::Glsl, body).unwrap_err().to_string();
        assert!(message.contains("GLSL ES does not take"), "{message}");
    }
    assert_eq!(c(Language::Hlsl, "return max(x, 1);").unwrap(), 1.0);
    assert_eq!(wgsl("return max(x, 1);").unwrap(), 1.0);
    for language in [Language::Msl, Language::Glsl] {
        assert!(c(language, "return max(x, 1);").unwrap_err().message.contains("ambiguous"));
    }
    // `sign` is an integer in HLSL and Slang.
    for language in [Language::Hlsl, Language::Slang] {
        let message = c(language, "return x + sign(x)/2;").unwrap_err().to_string();
        assert!(message.contains("arithmetic of integers"), "{message}");
    }
    assert_eq!(c(Language::Msl, "return x + sign(x)/2;").unwrap(), 0.8);
}

/// A type of every declaration replaced by another.
#[test]
fn no_type_can_be_changed_unseen() {
    let names = Names::new(["x", "y"], ["a", "b", "c", "d"]);
    let program = parse(EVERY_OPERATION, &names).unwrap();
    let mut tried = 0;
    for (&language, float, others) in [
        (
            &Language::Hlsl,
            "float ",
            &["int ", "uint ", "half ", "min16float ", "double ", "bool ", "float2 "],
        ),
        (
            &Language::Slang,
            "float ",
            &["int ", "uint ", "half ", "let ", "double ", "bool ", "float2 "],
        ),
        (
            &Language::Msl,
            "float ",
            &["int ", "uint ", "half ", "bfloat ", "long ", "bool ", "float2 "],
        ),
        (
            &Language::Glsl,
            "float ",
            &["int ", "uint ", "mediump float ", "float16_t ", "double ", "bool ", "vec2 "],
        ),
        (
            &Language::Wgsl,
            ": f32",
            &[": i32", ": u32", ": f16", ": bool", ": f64", ": vec2<f32>", ": vec2f"],
        ),
    ] {
        let code = text(language, &program, &names, "f", &[]);
        let code = if language == Language::Wgsl { code.replace(" = ", ": f32 = ") } else { code };
        assert!(read_back(language, &code).is_ok(), "{code}");
        for (at, _) in code.match_indices(float) {
            for other in others {
                let mut changed = code.clone();
                changed.replace_range(at..at + float.len(), other);
                let error = read_back(language, &changed).expect_err(&changed);
                let line = code[..at].matches('\n').count() + 1;
                // A vector may be a parameter; it is refused where it is read as a float.
                let may_be = line == 1 && other.contains('2') && !other.contains("16");
                assert!(error.line == line || may_be && error.line > line, "{error}");
                tried += 1;
            }
        }
    }
    assert!(tried > 200, "{tried}");
}

#[test]
fn text_too_long_is_not_read_and_places_far_right_are_shown() {
    let far = format!("float f(float x) {{ return x{}; }}", " + x".repeat(30_000));
    assert!(read_back(Language::Hlsl, &far).is_ok());
    let message = read_back(Language::Hlsl, &far.replace("; }", " é; }")).unwrap_err().to_string();
    assert!(message.len() < 600 && message.contains("column 120029"), "{message}");
    let many = format!("float f(float x) {{ return x{}; }}", " + x".repeat(70_000));
    assert!(read_back(Language::Hlsl, &many).unwrap_err().message.contains("65535 operations"));
    let long = format!("float f(float x) {{ return x{}; }}", " + x".repeat(300_000));
    assert!(read_back(Language::Hlsl, &long).unwrap_err().message.contains("at most 1 MiB"));
}

#[test]
fn edited_snippets_are_read() {
    let code = read_back(
        Language::Glsl,
        "highp float f(in float n_dot_v /* cosine */, float r) {
            precise float a = n_dot_v > r ? 1.f : +r; // larger
            return a;
        }"
        .replace("+r", "-(r)")
        .as_str(),
    )
    .unwrap();
    assert_eq!(code.names, Names::new(["n_dot_v", "r"], ["a"]));
    assert_eq!(code.evaluate(&[0.2, 0.5]), [-0.5]);
    assert_eq!(code.evaluate(&[0.7, 0.5]), [1.0]);
}
