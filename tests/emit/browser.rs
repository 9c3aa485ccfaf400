//! What runs in browsers: drawn or computed by Chromium's WebGL2 and WebGPU, by three.js and Babylon.js,
//! and compared with the interpreter.

use crate::agreement::Case;
use crate::compile::all_to_compile;
use crate::grid::{Chosen, Grid, called};
use crate::installed::{driver, installed};
use crate::lavapipe::tolerance;
use crate::tools;
use lgp::emit::{Language, Snippet, emit_half};
use std::ops::Range;
use std::path::Path;

/// Of GLSL and GLSL ES.
const GLSL: Chosen = Chosen {
    open: "highp vec4 evaluate(highp int row, highp vec4 p) {\n    highp vec4 values;\n",
    choice: |rows, values| {
        format!("    if (row >= {} && row < {}) values = {values};\n", rows.start, rows.end)
    },
    close: "    return values;\n}\n",
    vector: "vec4",
};

const WGSL: Chosen = Chosen {
    open: "fn evaluate(row: i32, p: vec4<f32>) -> vec4<f32> {\n    var values: vec4<f32>;\n",
    choice: |rows, values| {
        let Range { start, end } = rows;
        format!("    if (row >= {start} && row < {end}) {{ values = {values}; }}\n")
    },
    close: "    return values;\n}\n",
    vector: "vec4<f32>",
};

#[test]
fn webgl2_computes_glsl_es_as_the_interpreter() {
    agree("webgl2.html", Language::GlslEs, &GLSL, "swiftshader");
}

#[test]
fn mesa_computes_glsl_es_as_the_interpreter() {
    agree("webgl2.html", Language::GlslEs, &GLSL, "mesa");
}

#[test]
fn a_shader_material_of_three_computes_glsl_as_the_interpreter() {
    agree("three_glsl.html", Language::Glsl, &GLSL, "swiftshader");
}

#[test]
fn a_shader_material_of_babylon_computes_glsl_as_the_interpreter() {
    agree("babylon.html", Language::Glsl, &GLSL, "swiftshader");
}

#[test]
fn webgpu_computes_wgsl_as_the_interpreter() {
    agree("webgpu.html", Language::Wgsl, &WGSL, "swiftshader");
}

/// The page's shader has the samples in it, too.
fn agree(page: &str, language: Language, chosen: &Chosen, backend: &str) {
    if !found(&format!("{language} was not run in {page}")) {
        return;
    }
    let grid = grid();
    let mut code = all_to_compile(language);
    if page == "babylon.html" {
        // It writes `in` for `varying`, also within names.
        code.retain(|code| !code.contains("varying"));
    }
    code.extend(grid.functions(language));
    code.push(grid.chosen(chosen));
    let folder = tempfile::tempdir().unwrap();
    let file = format!("functions.{}", if language == Language::Wgsl { "wgsl" } else { "glsl" });
    std::fs::write(folder.path().join(file), code.join("\n")).unwrap();
    run(folder.path(), &grid, page, backend);
    let title = format!("{language} in {page} on {backend}");
    grid.compare(&title, &folder.path().join("values.f32"), tolerance);
}

#[test]
fn tsl_on_webgl2_computes_what_the_interpreter_computes() {
    agree_in_tsl("three_tsl.html");
}

#[test]
fn tsl_on_webgpu_computes_what_the_interpreter_computes() {
    agree_in_tsl("three_tsl.html?webgpu");
}

/// Each function is a module, with its line of imports.
fn agree_in_tsl(page: &str) {
    if !found(&format!("TSL was not run in {page}")) {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let write = |file: &str, code: &str| std::fs::write(folder.path().join(file), code).unwrap();
    let grid = grid();
    let to_compile = all_to_compile(Language::Tsl);
    let (mut imports, mut samples, mut cases) = (String::new(), String::new(), String::new());
    for (i, code) in to_compile.iter().enumerate() {
        write(&format!("sample{i}.js"), code);
        let (of, inputs, outputs) = shape(code);
        imports += &format!("import {{ {of} }} from './sample{i}.js';\n");
        // Names are JavaScript's alone, so this one is only read: as an expression it is too deep.
        if inputs > 4 {
            continue;
        }
        samples += &format!("    {{ of: {of}, inputs: {inputs}, outputs: {outputs} }},\n");
    }
    for (i, ((case, rows), code)) in grid.with_rows().zip(grid.functions(Language::Tsl)).enumerate()
    {
        write(&format!("case{i}.js"), &code);
        let (of, inputs, outputs) = (called(case), case.inputs.len(), case.expected.len());
        let end = rows.end;
        imports += &format!("import {{ {of} }} from './case{i}.js';\n");
        cases +=
            &format!("    {{ of: {of}, inputs: {inputs}, outputs: {outputs}, end: {end} }},\n");
    }
    let lists =
        format!("export const samples = [\n{samples}];\nexport const cases = [\n{cases}];\n");
    write("cases.js", &(imports + &lists));
    run(folder.path(), &grid, page, "swiftshader");
    grid.compare(&format!("tsl in {page}"), &folder.path().join("values.f32"), tolerance);
}

/// The function's name and its numbers of inputs and outputs.
fn shape(code: &str) -> (&str, usize, usize) {
    let head = code.split("export const ").nth(1).expect("a function");
    let (of, rest) = head.split_once(" = ").expect("a value");
    let inputs = rest.split(") => {").next().unwrap().matches(',').count() + 1;
    let returned = code.rsplit("return ").next().unwrap();
    let outputs =
        if returned.starts_with("float(") { 1 } else { returned.matches(',').count() + 1 };
    (of, inputs, outputs)
}

/// SwiftShader has the logarithm of 0 finite, whence a power of it is not 0.
fn grid() -> Grid {
    Grid::of_all().without_powers_of_zero()
}

/// What a page computes of functions of GLSL.
pub fn outputs_of(
    grid: &Grid,
    page: &str,
    backend: &str,
    functions: Vec<String>,
) -> Vec<Vec<Vec<f32>>> {
    let code = functions.into_iter().chain([grid.chosen(&GLSL)]).collect::<String>();
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("functions.glsl"), code).unwrap();
    run(folder.path(), grid, page, backend);
    grid.outputs(&folder.path().join("values.f32"))
}

/// What Mesa computes in `mediump`.
pub fn outputs_in_half(grid: &Grid) -> Vec<Vec<Vec<f32>>> {
    let half = |case: &Case| {
        let snippet = Snippet::new(&case.program, &case.names, &case.function);
        emit_half(Language::GlslEs, &snippet, &case.stay_single).expect("it has halves")
    };
    outputs_of(grid, "webgl2.html", "mesa", grid.cases.iter().map(half).collect())
}

pub fn found(untested: &str) -> bool {
    installed("node_modules/three/build/three.webgpu.js", untested).is_some()
        && tools::found(&["chromium", "--version"], untested)
        && tools::found(&["python3", "--version"], untested)
}

fn run(folder: &Path, grid: &Grid, page: &str, backend: &str) {
    grid.write_points(&folder.join("points.f32"));
    tools::run(folder, &["python3", &driver("browser.py"), page, ".", backend]);
}
