//! MaterialX's own library: it validates the documents, and generates code of them that is computed on
//! Vulkan.

use crate::agreement::{Case, Tolerance, fine_constants};
use crate::compile::all_to_compile;
use crate::grid::called;
use crate::installed::{PYTHON, driver, installed};
use crate::lavapipe::{Compiler, Precision, agree_within, device, outputs, tolerance};
use crate::{text, tools};
use lgp::emit::Language;
use lgp::op::Op;
use std::path::Path;

#[test]
fn materialx_computes_what_the_interpreter_computes() {
    agree_within(Compiler::MaterialX, |op| match op {
        // A power of two, as precise as a power.
        Op::Exp2 => tolerance(Op::Pow),
        _ => tolerance(op),
    });
}

/// Its generators write numbers with six decimals.
#[test]
fn materialx_has_constants_of_more_than_six_decimals() {
    let Some(gpu) = device(Compiler::MaterialX) else { return };
    let case = [fine_constants()];
    let found = outputs(&gpu, Compiler::MaterialX, Precision::Single, &case);
    case[0].compare(&found[0], Tolerance { absolute: 0.0, relative: 1e-6 });
}

/// Its generators make shaders of them, in each of their languages.
#[test]
fn materialx_takes_the_documents() {
    if found("MaterialX's documents were not validated") {
        let folder = tempfile::tempdir().unwrap();
        generated(folder.path(), all_to_compile(Language::MaterialX));
        if tools::found(&["glslangValidator", "--version"], "MaterialX's GLSL was not compiled") {
            let command = ["glslangValidator", "-S", "frag", "pixel.glsl"];
            tools::run(folder.path(), &command);
            tools::run(folder.path(), &["glslangValidator", "-S", "frag", "pixel.essl"]);
        }
    }
}

pub fn found(untested: &str) -> bool {
    installed(PYTHON, untested).is_some()
}

/// The functions of the documents in GLSL, called and returning as those of the language are.
pub fn functions(cases: &[Case]) -> String {
    let shader = functions_of(cases, "glsl", "void main()");
    // What the shader is given and gives is not the functions'.
    let of_the_shader = ["#version", "#pragma", "uniform", "out ", "in "];
    let lines = shader.lines().filter(|line| !of_the_shader.iter().any(|w| line.starts_with(w)));
    lines.map(|line| format!("{line}\n")).chain(cases.iter().map(returning)).collect()
}

/// The functions of the documents in a language, before a shader's own function.
pub fn functions_of(cases: &[Case], language: &str, of_the_shader: &str) -> String {
    let folder = tempfile::tempdir().unwrap();
    let document =
        |case: &Case| text(Language::MaterialX, &case.program, &case.names, &case.function, &[]);
    generated(folder.path(), cases.iter().map(document));
    let shader = std::fs::read_to_string(folder.path().join(format!("pixel.{language}"))).unwrap();
    shader[..shader.find(of_the_shader).expect("the shader's own function")].to_owned()
}

/// A function of GLSL that returns what MaterialX's gives by parameters.
fn returning(case: &Case) -> String {
    let each = |before: &str, count: usize| {
        (0..count).map(|i| format!("{before}{i}")).collect::<Vec<_>>().join(", ")
    };
    let (inputs, outputs) = (case.inputs.len(), case.expected.len());
    let of = if outputs == 1 { "float".to_owned() } else { format!("vec{outputs}") };
    let (parameters, arguments, values) =
        (each("float x", inputs), each("x", inputs), each("y", outputs));
    let function = called(case);
    format!(
        "{of} {function}({parameters}) {{
    float {values};
    NG_{function}({arguments}, {values});
    return {of}({values});
}}\n"
    )
}

/// One shader, of all the documents, in every language of the generators.
fn generated(folder: &Path, documents: impl IntoIterator<Item = String>) {
    for (i, document) in documents.into_iter().enumerate() {
        std::fs::write(folder.join(format!("{i}.mtlx")), document).unwrap();
    }
    let python = installed(PYTHON, "").expect("it was found");
    tools::run(folder, &[&python, &driver("materialx.py"), "."]);
}
