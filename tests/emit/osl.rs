//! OSL by the compiler and the runtime in Cycles, compared with the interpreter.

use crate::agreement::{Case, Tolerance};
use crate::compile::all_to_compile;
use crate::grid::{Grid, called};
use crate::installed::{PYTHON, driver, installed};
use crate::{lavapipe, materialx, tools};
use lgp::emit::Language;
use lgp::op::Op;

#[test]
fn cycles_computes_osl_as_the_interpreter() {
    let Some(python) = installed(PYTHON, "OSL was not run") else { return };
    let grid = Grid::of_all();
    let mut code = all_to_compile(Language::Osl);
    code.extend(grid.functions(Language::Osl));
    code.push(evaluate(&grid, |case, arguments| match case.expected.len() {
        1 => format!("a = {}({arguments})", called(case)),
        _ => format!("{}({arguments}, a, b)", called(case)),
    }));
    run(&python, "osl", &grid, &code.join("\n"));
}

/// The language that renderers which know MaterialX are given it in.
#[test]
fn cycles_computes_the_osl_of_materialx_as_the_interpreter() {
    let Some(python) = installed(PYTHON, "MaterialX's OSL was not run") else { return };
    let grid = Grid::of_all();
    let functions = materialx::functions_of(&grid.cases, "osl", "shader values");
    let evaluate = evaluate(&grid, |case, arguments| match case.expected.len() {
        1 => format!("NG_{}({arguments}, a)", called(case)),
        _ => format!("NG_{}({arguments}, a, b)", called(case)),
    });
    run(&python, "materialx in osl", &grid, &(functions + &evaluate));
}

fn run(python: &str, what: &str, grid: &Grid, code: &str) {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("functions.osl"), code).unwrap();
    grid.write_points(&folder.path().join("points.f32"));
    tools::run(folder.path(), &[python, &driver("osl.py"), "."]);
    grid.compare(what, &folder.path().join("values.f32"), tolerance);
}

/// Chooses among functions that all give two outputs by parameters.
pub fn of_outputs(grid: &Grid) -> String {
    evaluate(grid, |case, arguments| format!("{}({arguments}, a, b)", case.function))
}

/// Chooses the case of a row; its outputs are two at most.
fn evaluate(grid: &Grid, call: fn(&Case, arguments: &str) -> String) -> String {
    let head = "void evaluate(int row, float x, float y, float z, float w, output float a, \
                output float b) {\n";
    let choices = grid.with_rows().map(|(case, rows)| {
        let value = call(case, &["x", "y", "z", "w"][..case.inputs.len()].join(", "));
        format!("    if (row >= {} && row < {}) {value};\n", rows.start, rows.end)
    });
    head.to_owned() + &choices.collect::<String>() + "}\n"
}

/// Cycles's OSL computes exponentials by a polynomial, to 1.1e-5 of the value.
fn tolerance(op: Op) -> Tolerance {
    match op {
        Op::Exp2 | Op::Exp => Tolerance { absolute: 0.0, relative: 1.2e-5 },
        Op::Tanh => Tolerance { absolute: 6e-6, relative: 1.2e-5 },
        op => lavapipe::tolerance(op),
    }
}
