//! Emitted code: what it looks like, that it means what the program means, and that real
//! compilers take it.

use lgp::emit::{Language, Snippet, emit, read_back};
use lgp::op::Op;
use lgp::program::{Arg, Draft, Names, Program, parse};
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;
use std::io::Write;
use std::path::Path;
use std::process::Command;

const PAPER: &str = "bias = exp2(-(7*n_dot_v + 4*roughness^2)); \
    scale = 1 - bias - roughness^2*max(bias, min(roughness, .739 + .323*n_dot_v) - .434)";

/// Each operation once, those with constant arguments on a few of them.
const EVERY_OPERATION: &str = "a = saturate(mad(x, 3, -y)) + abs(x - y)*min(x, .5)/max(y, 1e-5); \
    b = rcp(x + 1) - sqrt(y)*rsqrt(y + 2) + exp2(-x) - log2(x + 1) + exp(y)*log(y + 3); \
    c = pow(x, 2.2) + sin(x)*cos(y) - tan(x/2) + asin(x)*acos(y) - atan(x) + atan2(y, x)*tanh(a); \
    d = lerp(x, y, a) - step(.5, x)*select(x < y, floor(b), fract(c)) + sign(x - .5)";

fn text(
    language: Language,
    program: &Program,
    names: &Names,
    function: &str,
    header: &[String],
) -> String {
    emit(language, &Snippet { program, names, function, header })
}

fn in_every_language(program: &Program, names: &Names, header: &[&str]) -> String {
    let header: Vec<String> = header.iter().map(|line| (*line).to_owned()).collect();
    let texts = Language::ALL.iter().map(|&l| text(l, program, names, "dfg", &header));
    texts.collect::<Vec<_>>().join("\n")
}

#[test]
fn the_papers_formula_in_every_language() {
    let names = Names::new(["n_dot_v", "roughness"], ["scale", "bias"]);
    let program = parse(PAPER, &names).unwrap();
    insta::assert_snapshot!(in_every_language(&program, &names, &["Pesce & Iwanicki 2015"]));
}

#[test]
fn one_output_is_a_float() {
    let names = Names::new(["n_dot_v", "roughness"], ["bias"]);
    let program = parse("bias = exp2(-(7*n_dot_v + 4*roughness^2))", &names).unwrap();
    insta::assert_snapshot!(in_every_language(&program, &names, &[]));
}

#[test]
fn every_operation_in_every_language() {
    let names = Names::new(["x", "y"], ["a", "b", "c", "d"]);
    let program = parse(EVERY_OPERATION, &names).unwrap();
    for op in Op::ALL {
        let found = program.instrs.iter().any(|instr| instr.op() == *op);
        assert!(found, "{op} is missing");
    }
    insta::assert_snapshot!(in_every_language(&program, &names, &[]));
}

#[test]
fn columns_called_like_keywords_are_renamed() {
    let names = Names::new(["cos", "lambda", "half"], ["out", "sample"]);
    let program = parse("out = cos(cos)*lambda; sample = out + half", &names).unwrap();
    insta::assert_snapshot!(in_every_language(&program, &names, &[]));
}

#[test]
fn more_outputs_than_a_vector_holds_are_a_structure() {
    let names = Names::new(["x"], ["a", "b", "c", "d", "result"]);
    let program = parse("a = x; b = 1; c = x + 1; d = c; result = c*c", &names).unwrap();
    insta::assert_snapshot!(in_every_language(&program, &names, &[]));
}

#[test]
fn constants_that_are_not_finite_are_written_as_bits() {
    let names = Names::new(["x"], ["y"]);
    let program =
        parse("y = max(x, 1/0) + log2(0)*x - 1/0 + (0/0 - 3.4028235e38*x) + 1e-45", &names);
    insta::assert_snapshot!(in_every_language(&program.unwrap(), &names, &[]));
}

#[test]
fn a_header_cannot_leave_its_comment() {
    let names = Names::new(["x"], ["y"]);
    let program = parse("y = x", &names).unwrap();
    let nasty = ["a\nb\r\nc\rd", "e\u{85}f\u{2028}g\u{b}h", "C:\\", "C:\\ \\  ", "", "\n", "*/ \0"];
    let header = nasty.map(str::to_owned);
    for &language in Language::ALL {
        let code = text(language, &program, &names, "f", &header);
        let (comments, function) = code.split_at(code.find("f_y").unwrap());
        let comments = &comments[..comments.rfind('\n').unwrap()];
        for line in comments.split(['\n', '\r', '\u{85}', '\u{2028}', '\u{b}', '\0']) {
            assert!(line.starts_with("//") && !line.ends_with(['\\', ' ']), "{line:?}");
        }
        assert_eq!(function.lines().count(), 4);
        assert!(read_back(language, &code).is_ok());
    }
}

#[test]
fn languages_have_names() {
    for &language in Language::ALL {
        assert_eq!(Language::from_name(language.name()), Ok(language));
    }
    assert_eq!(Language::from_name("WebGPU"), Ok(Language::Wgsl));
    let message = Language::from_name("hsl").unwrap_err().to_string();
    assert!(message.contains("did you mean `hlsl`?") && message.contains("wgsl"), "{message}");
}

/// Names that mean something to one of the languages, or that none can declare.
const NASTY_NAMES: &str = "cos lambda half texture sample in out input output fn let ref gl_x a__b _ \
    __x float float3 vec2 vec2f mat3 saturate clamp rcp mad main line point matrix vector Texture2D \
    sampler2D const var return result t0 t1 infinity dfg dfg_outputs min16float int16_t precise \
    common packed buffer f32 i32 array bitcast frac fract lerp mix active from self target std \
    N·V 2d technique TECHNIQUE Pass double uint select and or sign step exp2 uintBitsToFloat \
    asfloat highp layout where shared patch linear noise1 dFdx static struct type x x_ X inverse \
    float3x3 dmat4x2 isampler2DArray smooth flat centroid mod move NULL";

fn nasty_columns() -> (Program, Names) {
    let inputs: Vec<&str> = NASTY_NAMES.split_whitespace().collect();
    let outputs = ["cos", "result", "texture", "infinity_bits", "float4", "half"];
    let mut draft = Draft { inputs: inputs.len(), ..Draft::default() };
    let mut sum = Arg::Input(0);
    for i in 1..inputs.len() {
        sum = draft.push(Op::Max, &[sum, Arg::Input(i as u16)]);
        sum = draft.push(Op::Cos, &[sum]);
    }
    let zero = draft.constant(0.0);
    let infinity = draft.push(Op::Rcp, &[zero]);
    sum = draft.push(Op::Min, &[sum, infinity]);
    draft.outputs = vec![sum, Arg::Result(3), Arg::Result(8), infinity, zero, Arg::Input(1)];
    (Program::verify(draft).unwrap(), Names::new(inputs, outputs))
}

#[test]
fn nasty_names_are_read_back_as_they_were() {
    let (program, names) = nasty_columns();
    let inputs: Vec<f32> = (0..program.inputs).map(|i| (i as f32).sin()).collect();
    for &language in Language::ALL {
        let code = text(language, &program, &names, "dfg", &[]);
        let (read, read_names) = read_back(language, &code).unwrap();
        assert_eq!(read_names, names, "{code}");
        assert_eq!(bits(&read.evaluate(&inputs)), bits(&program.evaluate(&inputs)));
    }
}

fn bits(values: &[f32]) -> Vec<Option<u32>> {
    values.iter().map(|v| (!v.is_nan()).then(|| v.to_bits())).collect()
}

const SAMPLES: [[f32; 4]; 6] = [
    [0.3, 0.7, 0.1, 0.9],
    [0.0, -0.0, 1.0, 2.0],
    [-2.5, 1.0, -0.0, 3.0],
    [1e-30, 4e30, 7.5, -1e-40],
    [f32::NAN, 1.0, 0.5, 2.0],
    [f32::INFINITY, -1.0, 3.0, 1e10],
];

/// The operation on inputs, and on a constant in each place.
fn programs_of(op: Op) -> Vec<Program> {
    let inputs: Vec<Arg> = (0..4).map(Arg::Input).collect();
    let mut programs = Vec::new();
    for place in 0..=op.arity() {
        let mut draft = Draft { inputs: 4, ..Draft::default() };
        let mut args = inputs.clone();
        if place < op.arity() {
            args[place] = draft.constant(-0.75);
        }
        draft.outputs = vec![draft.push(op, &args)];
        programs.push(Program::verify(draft).unwrap());
    }
    programs
}

#[test]
fn every_operation_is_read_back_with_its_meaning() {
    let names = Names::new(["x", "y", "z", "w"], ["f"]);
    for &language in Language::ALL {
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

/// Any operation, arguments taken modulo what exists, constants of every size and sign.
fn programs() -> impl Strategy<Value = Program> {
    let constant = prop_oneof![
        -10.0f32..10.0,
        Just(0.0),
        Just(-0.0),
        Just(1.0),
        Just(f32::MAX),
        prop::num::f32::NORMAL | prop::num::f32::SUBNORMAL,
    ];
    let instr = (0..Op::ALL.len(), prop::array::uniform4(0u16..1000));
    (
        prop::collection::vec(constant, 1..6),
        prop::collection::vec(instr, 1..40),
        prop::collection::vec(0u16..1000, 1..6),
    )
        .prop_map(|(consts, instrs, outputs)| {
            let mut draft = Draft { inputs: 2, consts, ..Draft::default() };
            let constants = draft.consts.len() as u16;
            let pick = |n: u16, earlier: u16| match n % (2 + constants + 4 * earlier) {
                k if k < 2 => Arg::Input(k),
                k if k < 2 + constants => Arg::Const(k - 2),
                k => Arg::Result((k - 2 - constants) / 4),
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
        for &language in Language::ALL {
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
        for &language in Language::ALL {
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
    for language in Language::ALL {
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

/// What compilers are given: every operation, every constant hazard, nasty names, and programs
/// drawn at random, each under a function name of its own.
fn samples_to_compile(language: Language) -> Vec<String> {
    let mut codes = Vec::new();
    let mut add = |program: &Program, names: &Names| {
        let function = format!("f{}", codes.len());
        codes.push(text(language, program, names, &function, &["C:\\".to_owned()]));
    };
    let four = Names::new(["x", "y", "z", "w"], ["f"]);
    for program in Op::ALL.iter().flat_map(|&op| programs_of(op)) {
        add(&program, &four);
    }
    let (program, columns) = nasty_columns();
    add(&program, &columns);
    let cosine = parse("y = cos(x)", &Names::new(["x"], ["y"])).unwrap();
    for name in columns.inputs {
        add(&cosine, &Names::new([name.as_str()], [name.as_str()]));
    }
    let mut runner = TestRunner::deterministic();
    for _ in 0..250 {
        let program = programs().new_tree(&mut runner).unwrap().current();
        add(&program, &names(&program));
    }
    codes
}

#[test]
fn naga_takes_the_wgsl() {
    for code in samples_to_compile(Language::Wgsl) {
        let module = naga::front::wgsl::parse_str(&code)
            .unwrap_or_else(|e| panic!("{code}\n{}", e.emit_to_string(&code)));
        let mut validator = naga::valid::Validator::new(
            naga::valid::ValidationFlags::all(),
            naga::valid::Capabilities::empty(),
        );
        validator.validate(&module).unwrap_or_else(|e| panic!("{code}\n{e:?}"));
    }
}

#[test]
fn glslang_takes_the_glsl_and_the_hlsl() {
    if !is_installed("glslangValidator") {
        let line = "SKIPPED: glslangValidator is not installed; HLSL and GLSL were not compiled";
        assert!(std::env::var("LGP_REQUIRE_TOOLS").as_deref() != Ok("1"), "{line}");
        // The test harness captures what the print macros write, but not this.
        // In one piece, lest another test's line stands in it.
        let _ = std::io::stderr().write_all(format!("\n{line}\n").as_bytes());
        return;
    }
    let glsl = samples_to_compile(Language::Glsl).join("\n");
    let hlsl = samples_to_compile(Language::Hlsl).join("\n");
    let folder = tempfile::tempdir().unwrap();
    for (file, options, source) in [
        (
            "es.frag",
            &[][..],
            format!(
                "#version 300 es\nprecision highp float;\n{glsl}\n\
                 out vec4 color;\nvoid main() {{ color = vec4(f0_f(1.0, 2.0, 3.0, 4.0)); }}\n"
            ),
        ),
        (
            "desktop.frag",
            &[],
            format!(
                "#version 450\n{glsl}\n\
                 out vec4 color;\nvoid main() {{ color = vec4(f0_f(1.0, 2.0, 3.0, 4.0)); }}\n"
            ),
        ),
        (
            "pixel.hlsl",
            &["-D", "-V", "-e", "main", "-S", "frag"],
            format!(
                "{hlsl}\nfloat4 main(float4 p : TEXCOORD0) : SV_Target {{\n\
                 return f0_f(p.x, p.y, p.z, p.w);\n}}\n"
            ),
        ),
    ] {
        let path = folder.path().join(file);
        std::fs::write(&path, source).unwrap();
        compile(&path, options);
    }
}

fn is_installed(tool: &str) -> bool {
    Command::new(tool).arg("--version").output().is_ok()
}

fn compile(path: &Path, options: &[&str]) {
    let output = Command::new("glslangValidator")
        .args(options)
        .arg(path)
        .current_dir(path.parent().unwrap())
        .output()
        .unwrap();
    let messages = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success(), "{messages}\n{}", std::fs::read_to_string(path).unwrap());
}
