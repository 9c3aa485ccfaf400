//! Emitted code: what it looks like, that it means what the program means, that real compilers
//! take it, and that it computes what the interpreter computes.

mod agreement;
mod browser;
mod call;
mod compile;
mod cuda;
mod dxc;
mod engines;
mod grid;
mod half;
mod hosts;
mod installed;
mod lavapipe;
mod materialx;
mod osl;
mod programs;
mod read_back;
mod slang;
mod tools;
#[path = "../vulkan/mod.rs"]
mod vulkan;

use lgp::emit::{Engine, Language, Snippet, emit, emit_half, javascript, mathml, read_back};
use lgp::op::Op;
use lgp::program::{Names, Program, parse};
use programs::EVERY_OPERATION;

/// Languages with comments to the line's end, and a function that begins on the line after them.
const LIKE_C: &[Language] = &[
    Language::Hlsl,
    Language::Wgsl,
    Language::Glsl,
    Language::GlslEs,
    Language::Msl,
    Language::Slang,
    Language::Osl,
];

const PAPER: &str = "bias = exp2(-(7*n_dot_v + 4*roughness^2)); \
    scale = 1 - bias - roughness^2*max(bias, min(roughness, .739 + .323*n_dot_v) - .434)";

fn text(
    language: Language,
    program: &Program,
    names: &Names,
    function: &str,
    header: &[String],
) -> String {
    emit(language, &Snippet::new(program, names, function).header(header))
}

fn bits(values: &[f32]) -> Vec<Option<u32>> {
    values.iter().map(|v| (!v.is_nan()).then(|| v.to_bits())).collect()
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
fn every_operation_in_half_precision() {
    let names = Names::new(["x", "y"], ["a", "b", "c", "d"]);
    let program = parse(EVERY_OPERATION, &names).unwrap();
    let snippet = Snippet::new(&program, &names, "dfg");
    let texts: Vec<String> =
        Language::ALL.iter().filter_map(|&language| emit_half(language, &snippet, &[])).collect();
    insta::assert_snapshot!(texts.join("\n"));
}

#[test]
fn what_stays_in_single_precision_is_converted_at_its_edges() {
    let names = Names::new(["x"], ["y", "z"]);
    let program = parse("t = exp2(3.25*x); y = t - x; z = t", &names).unwrap();
    let snippet = Snippet::new(&program, &names, "f");
    let second = emit_half(Language::Wgsl, &snippet, &[1]).unwrap();
    let expected = "enable f16;

fn f(x: f16) -> vec2<f16> {
    let t0 = exp2(f32(3.25h*x));
    let z = f16(t0);
    let y = f16(t0) - x;
    return vec2<f16>(y, z);
}
";
    assert_eq!(second, expected);
    let others = emit_half(Language::Msl, &snippet, &[0, 2]).unwrap();
    let expected = "half2 f(half x) {
    const half z = exp2(half(3.25*float(x)));
    const half y = half(float(z) - float(x));
    return half2(y, z);
}
";
    assert_eq!(others, expected);
}

#[test]
fn constants_in_half_precision_are_rounded_before_they_are_folded() {
    let names = Names::new(["x"], ["y"]);
    let program = parse("y = x*(0.1 + 0.2) - 70000 + 1e-9*x + 1/0", &names).unwrap();
    let snippet = Snippet::new(&program, &names, "f");
    insta::assert_snapshot!(emit_half(Language::Glsl, &snippet, &[]).unwrap());
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
    let nasty =
        ["a\nb\r\nc\rd", "e\u{85}f\u{2028}g\u{b}h", "C:\\", "C:\\ \\  ", "", "\n", "\u{202e}*/ \0"];
    let header = nasty.map(str::to_owned);
    for &language in LIKE_C {
        let code = text(language, &program, &names, "f", &header);
        let (comments, function) = code.split_at(code.find("f_y").unwrap());
        let comments = &comments[..comments.rfind('\n').unwrap()];
        assert!(!code.contains('\u{202e}'), "what is shown is what is compiled");
        for line in comments.split(['\n', '\r', '\u{85}', '\u{2028}', '\u{b}', '\0']) {
            assert!(line.starts_with("//") && !line.ends_with(['\\', ' ']), "{line:?}");
        }
        assert_eq!(function.lines().count(), 4);
        assert!(read_back(language, &code).is_ok());
    }
}

#[test]
fn no_name_stands_in_what_a_page_takes_for_script_or_elements() {
    let hostile =
        "</script><script>alert(1)</script><img src=x onerror='alert(2)'>\n*/ alert(3) //";
    let over = Names::new(["a", "b"], ["y", "z"]);
    let program = parse("y = a*b; z = y + a", &over).unwrap();
    let names = Names::new([hostile, "b"], [&format!("{hostile} y"), "z"]);
    let header = [hostile.to_owned()];
    let snippet = Snippet::new(&program, &names, hostile).header(&header);
    for text in [javascript(&program), mathml(&snippet)] {
        let harmful = ["alert(", "<script", "<img", "</script", "//", "*/"];
        assert!(!harmful.iter().any(|harm| text.contains(harm)), "{text}");
    }
}

#[test]
fn the_guide_names_every_language_and_engine() {
    let guide = include_str!("../../docs/guide/src/emit.md");
    for language in Language::ALL {
        assert!(guide.contains(&format!("| `{language}` | ")), "{language}");
    }
    for engine in Engine::ALL {
        assert!(guide.contains(&format!("| `{engine}` | ")), "{engine}");
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
