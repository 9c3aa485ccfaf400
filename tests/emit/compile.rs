//! Real compilers take what is emitted.

use crate::programs::{SAMPLES, names, nasty_columns, programs, programs_of, words};
use crate::{bits, text, tools};
use lgp::emit::{Language, read_back};
use lgp::op::Op;
use lgp::program::{Arg, Draft, Names, Program, parse};
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;

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

/// The same, and each reserved word of any language as an input, and as a function's name where
/// that is a name of the shader.
pub fn all_to_compile(language: Language) -> Vec<String> {
    let mut codes = samples_to_compile(language);
    let words = words();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    for (i, inputs) in words.chunks(50).enumerate() {
        let mut draft = Draft { inputs: inputs.len(), ..Draft::default() };
        let mut sum = Arg::Input(0);
        for input in 1..inputs.len() {
            sum = draft.push(Op::Add, &[sum, Arg::Input(input as u16)]);
        }
        draft.outputs = vec![sum];
        let program = Program::verify(draft).unwrap();
        codes.push(text(
            language,
            &program,
            &Names::new(inputs.iter().copied(), ["f"]),
            &format!("w{i}"),
            &[],
        ));
    }
    if ![Language::MaterialX, Language::Tsl].contains(&language) {
        let names = Names::new(["x"], ["y", "z"]);
        let program = parse("y = x + 1; z = x*y", &names).unwrap();
        codes.extend(words.iter().map(|word| text(language, &program, &names, word, &[])));
    }
    codes
}

#[test]
fn naga_takes_the_wgsl() {
    for code in all_to_compile(Language::Wgsl) {
        validated(&code);
    }
}

pub fn validated(code: &str) -> (naga::Module, naga::valid::ModuleInfo) {
    let module = naga::front::wgsl::parse_str(code)
        .unwrap_or_else(|e| panic!("{code}\n{}", e.emit_to_string(code)));
    let mut validator = naga::valid::Validator::new(
        naga::valid::ValidationFlags::all(),
        naga::valid::Capabilities::SHADER_FLOAT16,
    );
    let info = validator.validate(&module).unwrap_or_else(|e| panic!("{code}\n{e:?}"));
    (module, info)
}

/// There is no Metal compiler to ask: naga's translation of our WGSL is the witness for our MSL.
#[test]
fn the_msl_computes_what_naga_makes_of_the_wgsl() {
    let (wgsl, msl) = (samples_to_compile(Language::Wgsl), samples_to_compile(Language::Msl));
    let mut compared = 0;
    for (wgsl, ours) in wgsl.iter().zip(&msl) {
        // Bits of what is not finite: naga writes them in decimal, which the reader does not know.
        if wgsl.contains("bitcast") {
            continue;
        }
        let (module, info) = validated(wgsl);
        let (options, pipeline) = Default::default();
        let (theirs, _) =
            naga::back::msl::write_string(&module, &info, &options, &pipeline).unwrap();
        let theirs = as_we_write(&theirs);
        let expected = read_back(Language::Msl, &theirs).unwrap_or_else(|e| panic!("{theirs}{e}"));
        let found = read_back(Language::Msl, ours).unwrap();
        for sample in SAMPLES {
            // Nasty columns are more than a sample has.
            let inputs: Vec<f32> =
                sample.iter().cycle().copied().take(found.program.inputs).collect();
            let (found, expected) = (found.evaluate(&inputs), expected.evaluate(&inputs));
            assert_eq!(bits(&found), bits(&expected), "{ours}\n{theirs}");
        }
        compared += 1;
    }
    assert!(compared > 300, "{compared}");
}

/// naga's MSL without its preamble and namespace, its names such as any may be, its structures named
/// before they are returned, and what it knows of comparisons of constants as such comparisons.
fn as_we_write(msl: &str) -> String {
    let lines = msl.lines().filter(|line| !line.starts_with(['#', '/']) && !line.contains("using"));
    let code = lines.collect::<Vec<_>>().join("\n");
    let code = code.replace("false ?", "1.0 < 0.0 ?").replace("true ?", "0.0 < 1.0 ?");
    let code = without_namespace(&code);
    match code.split_once("return ").and_then(|(before, value)| {
        let (name, values) = value.split_once(" {")?;
        let (values, after) = values.split_once("};")?;
        Some(format!("{before}{name} returned = {{{values}}}; return returned;{after}"))
    }) {
        Some(code) => code,
        None => code,
    }
}

/// What stands in the namespace of Metal without it, and other names such that they are none of Metal's.
fn without_namespace(code: &str) -> String {
    let belongs = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '.';
    let mut text = String::new();
    let mut rest = code;
    while let Some(first) = rest.chars().next() {
        let length = rest.find(|c| !belongs(c)).unwrap_or(rest.len()).max(first.len_utf8());
        let (word, after) = rest.split_at(length);
        rest = after;
        if word == "metal" {
            let (name, after) = rest.split_at(2 + rest[2..].find(|c| !belongs(c)).unwrap());
            text += &name[2..];
            rest = after;
        } else if first.is_ascii_alphabetic()
            && !["float", "return", "struct", "const"].contains(&word)
            || first == '_'
        {
            let first = if first == '_' { "u" } else { "" };
            text.extend([first, word.trim_start_matches('_'), "q"]);
        } else {
            text += word;
        }
    }
    text
}

const MAIN_OF_GLSL: &str =
    "out vec4 of_main;\nvoid main() { of_main = vec4(f0_f(1.0, 2.0, 3.0, 4.0)); }\n";

pub const MAIN_OF_HLSL: &str = "float4 main(float4 p : TEXCOORD0) : SV_Target {\n\
    return f0_f(p.x, p.y, p.z, p.w);\n}\n";

#[test]
fn glslang_takes_the_glsl_and_the_hlsl() {
    if !tools::found(&["glslangValidator", "--version"], "HLSL and GLSL were not compiled") {
        return;
    }
    let glsl = all_to_compile(Language::Glsl).join("\n");
    let hlsl = all_to_compile(Language::Hlsl).join("\n");
    let es = format!("#version 300 es\nprecision highp float;\n{glsl}\n{MAIN_OF_GLSL}");
    let desktop = format!("#version 450\n{glsl}\n{MAIN_OF_GLSL}");
    compiled("es.frag", &es, &["glslangValidator"]);
    compiled("desktop.frag", &desktop, &["glslangValidator"]);
    let command = ["glslangValidator", "-D", "-V", "-e", "main", "-S", "frag"];
    compiled("pixel.hlsl", &format!("{hlsl}\n{MAIN_OF_HLSL}"), &command);
}

#[test]
fn a_compiler_takes_the_c() {
    if tools::found(&["cc", "--version"], "C was not compiled") {
        let code = all_to_compile(Language::C).join("\n");
        let command =
            ["cc", "-std=c99", "-Wall", "-Wextra", "-Wno-unused-parameter", "-Werror", "-c"];
        compiled("snippets.c", &code, &command);
    }
}

#[test]
fn a_compiler_takes_the_c_as_cpp() {
    if tools::found(&["c++", "--version"], "C was not compiled as C++") {
        let code = all_to_compile(Language::C).join("\n");
        compiled(
            "snippets.cpp",
            &code,
            &["c++", "-std=c++11", "-Wall", "-Wextra", "-Wno-unused-parameter", "-c"],
        );
    }
}

#[test]
fn a_compiler_takes_the_cpp() {
    if tools::found(&["c++", "--version"], "C++ was not compiled") {
        let code = all_to_compile(Language::Cpp).join("\n");
        let command =
            ["c++", "-std=c++14", "-Wall", "-Wextra", "-Wno-unused-parameter", "-Werror", "-c"];
        compiled("snippets.cpp", &code, &command);
    }
}

#[test]
fn an_engine_takes_the_javascript() {
    if tools::found(&["node", "--version"], "JavaScript was not parsed") {
        let code = all_to_compile(Language::Js).join("\n");
        compiled("snippets.mjs", &code, &["node", "--check"]);
    }
}

#[test]
fn a_compiler_takes_the_rust() {
    if tools::found(&["rustc", "--version"], "Rust was not compiled") {
        let code = all_to_compile(Language::Rust).join("\n");
        let allowed = "#![deny(warnings)]\n#![allow(nonstandard_style, unused_variables)]\n";
        let command = ["rustc", "--edition", "2024", "--crate-type", "lib", "--emit", "metadata"];
        compiled("snippets.rs", &format!("{allowed}{code}"), &command);
    }
}

#[test]
fn an_interpreter_takes_the_python() {
    if tools::found(&["python3", "--version"], "Python was not compiled") {
        let code = all_to_compile(Language::Python).join("\n");
        compiled("snippets.py", &code, &["python3", "-W", "error", "-m", "py_compile"]);
    }
}

/// Writes the file and gives its name to the command.
pub fn compiled(file: &str, source: &str, command: &[&str]) {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join(file), source).unwrap();
    tools::run(folder.path(), &[command, &[file]].concat());
}
