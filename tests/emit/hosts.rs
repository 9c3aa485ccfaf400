//! C, C++, CUDA's host code, Rust, Python and JavaScript: run, and compared with the interpreter.

use crate::agreement::{Case, OF_FORMULAS, Tolerance, front, operations};
use crate::grid::called;
use crate::programs::programs_of;
use crate::{cuda, text, tools};
use lgp::emit::Language;
use lgp::op::Op;
use lgp::program::{Names, parse};
use std::path::Path;

#[test]
fn c_computes_what_the_interpreter_computes() {
    if !tools::found(&["cc", "--version"], "C was not run") {
        return;
    }
    agree(Language::C, "main.c", c_program, |folder| {
        // With contraction the compiler would fuse what the text keeps apart.
        let options = ["-O1", "-ffp-contract=off", "main.c", "-o", "main", "-lm"];
        tools::run(folder, &[&["cc"], &options[..]].concat());
        tools::run(folder, &["./main"]);
    });
}

#[test]
fn cpp_computes_what_the_interpreter_computes() {
    if !tools::found(&["c++", "--version"], "C++ was not run") {
        return;
    }
    agree(Language::Cpp, "main.cpp", c_program, |folder| {
        let options = ["-std=c++14", "-O1", "-ffp-contract=off", "main.cpp", "-o", "main"];
        tools::run(folder, &[&["c++"], &options[..]].concat());
        tools::run(folder, &["./main"]);
    });
}

/// The same text is for host and device; the host's part runs without a GPU.
#[test]
fn cuda_computes_on_the_host_what_the_interpreter_computes() {
    let Some(nvcc) = cuda::compiler("CUDA was not run") else { return };
    agree(Language::Cuda, "main.cu", c_program, |folder| {
        let options = ["-O1", "-Xcompiler", "-ffp-contract=off", "main.cu", "-o", "main"];
        tools::run(folder, &[&[&*nvcc], cuda::ARCHITECTURE, &options].concat());
        tools::run(folder, &["./main"]);
    });
}

/// Numbers are doubles there: rounded to singles, what is right in doubles is right in singles, too.
#[test]
fn javascript_computes_what_the_interpreter_computes() {
    if !tools::found(&["node", "--version"], "JavaScript was not run") {
        return;
    }
    let run = |folder: &Path| tools::run(folder, &["node", "main.mjs"]);
    agree(Language::Js, "main.mjs", javascript_program, run);
}

#[test]
fn rust_computes_what_the_interpreter_computes() {
    if !tools::found(&["rustc", "--version"], "Rust was not run") {
        return;
    }
    agree(Language::Rust, "main.rs", rust_program, |folder| {
        tools::run(folder, &["rustc", "--edition", "2024", "main.rs"]);
        tools::run(folder, &["./main"]);
    });
}

#[test]
fn python_computes_what_the_interpreter_computes() {
    let Some(python) = python() else { return };
    let run = |folder: &Path| tools::run(folder, &[python, "main.py"]);
    agree(Language::Python, "main.py", python_program, run);
}

/// Of numbers alone numpy makes doubles; what is given singles gives singles.
#[test]
fn python_stays_in_single_precision() {
    let Some(python) = python() else { return };
    let names = Names::new(["x", "y", "z", "w"], ["f"]);
    let chosen = parse("f = select(x < y, 1, 2)*z + step(x, 0.5)", &names).unwrap();
    let programs = Op::ALL.iter().flat_map(|&op| programs_of(op)).chain([chosen]);
    let programs = programs.filter(|program| {
        program.instrs.iter().any(|instr| instr.op().arity() > 1) || program.consts.is_empty()
    });
    let mut source = String::new();
    for (i, program) in programs.enumerate() {
        source += &text(Language::Python, &program, &names, &format!("f{i}"), &[]);
        source += &format!(
            "\nr = f{i}_f(*np.array([[0.3], [0.7], [0.1], [0.9]], np.float32))\n\
             assert r.dtype == np.float32, (f{i}_f, r)\n\n"
        );
    }
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("main.py"), source).unwrap();
    tools::run(folder.path(), &[python, "main.py"]);
}

fn python() -> Option<&'static str> {
    // Debian's numpy belongs to Debian's interpreter, which need not be the first.
    let interpreters = ["python3", "/usr/bin/python3"];
    let with_numpy = |python: &&str| tools::runs(&[python, "-c", "import numpy"]);
    let python = interpreters.into_iter().find(with_numpy);
    if python.is_none() {
        tools::skipped("no python3 has numpy; Python was not run");
    }
    python
}

/// What the C library and numpy may be off in one operation on ordinary arguments.
fn tolerance(op: Op) -> Tolerance {
    let [absolute, relative] = match op {
        Op::Neg | Op::Abs | Op::Min | Op::Max | Op::Saturate | Op::Step | Op::Select => [0.0, 0.0],
        Op::Floor | Op::Fract | Op::Sign => [0.0, 0.0],
        Op::Add | Op::Sub | Op::Mul | Op::Div | Op::Rcp | Op::Sqrt => [0.0, 0.0],
        // A product rounded by itself, up to 64, and a sum that may cancel it.
        Op::Mad | Op::Lerp => [1e-5, 0.0],
        // 2 ulp; 4; and 4 of an exponent up to 24.
        Op::Rsqrt => [0.0, 2.4e-7],
        Op::Exp2 | Op::Exp | Op::Log2 | Op::Log => [0.0, 4.8e-7],
        Op::Pow => [0.0, 1.2e-5],
        Op::Sin | Op::Cos | Op::Tan | Op::Tanh => [1e-7, 4.8e-7],
        Op::Asin | Op::Acos | Op::Atan | Op::Atan2 => [1e-7, 4.8e-7],
    };
    Tolerance { absolute, relative }
}

/// Each case's columns are put into a file one behind the other; the program leaves a file with
/// the outputs of each row.
fn agree(language: Language, file: &str, program: fn(&Case) -> String, run: impl Fn(&Path)) {
    for (title, cases) in [("operations", operations()), ("front", front())] {
        let folder = tempfile::tempdir().unwrap();
        let path =
            |case: &Case, kind: &str| folder.path().join(format!("{}.{kind}", case.function));
        let mut source = String::new();
        for case in &cases {
            std::fs::write(path(case, "in"), bytemuck::cast_slice(&case.inputs.concat())).unwrap();
            source += &text(language, &case.program, &case.names, &case.function, &[]);
        }
        source += &match language {
            Language::C | Language::Cpp | Language::Cuda => {
                format!("{C_FILES}int main(void) {{\n{}}}\n", all(&cases, program))
            }
            Language::Js => JAVASCRIPT_FILES.to_owned() + &all(&cases, program),
            Language::Rust => format!("{RUST_FILES}fn main() {{\n{}}}\n", all(&cases, program)),
            _ => PYTHON_FILES.to_owned() + &all(&cases, program),
        };
        std::fs::write(folder.path().join(file), source).unwrap();
        run(folder.path());
        let compared = cases.iter().map(|case| {
            let values = read_floats(&path(case, "out"));
            let tolerance = case.op.map_or(OF_FORMULAS, tolerance);
            case.compare(&columns(&values, case.expected.len()), tolerance)
        });
        println!("{language}, {title}: {:.1e} apart at most", compared.fold(0.0, f32::max));
    }
}

fn all(cases: &[Case], program: fn(&Case) -> String) -> String {
    cases.iter().map(program).collect()
}

fn read_floats(path: &Path) -> Vec<f32> {
    let bytes = std::fs::read(path).unwrap();
    bytes.chunks_exact(4).map(|b| f32::from_le_bytes(b.try_into().unwrap())).collect()
}

fn columns(values: &[f32], outputs: usize) -> Vec<Vec<f32>> {
    (0..outputs).map(|o| values.iter().skip(o).step_by(outputs).copied().collect()).collect()
}

/// The columns' values at the row `i`.
fn arguments(case: &Case) -> String {
    let columns = (0..case.inputs.len()).map(|c| format!("x[{} + i]", c * case.rows()));
    columns.collect::<Vec<_>>().join(", ")
}

const C_FILES: &str = "
#include <stdio.h>
#include <stdlib.h>

static float *load(const char *path, size_t count) {
    float *values = (float *)malloc(count * sizeof *values);
    FILE *file = fopen(path, \"rb\");
    if (!file || fread(values, sizeof *values, count, file) != count) exit(1);
    fclose(file);
    return values;
}

";

fn c_program(case: &Case) -> String {
    let (rows, function, called) = (case.rows(), &case.function, called(case));
    let arguments = arguments(case);
    format!(
        "    {{
        float *x = load(\"{function}.in\", {});
        FILE *out = fopen(\"{function}.out\", \"wb\");
        for (size_t i = 0; i < {rows}; ++i) {{
            __typeof__({called}({arguments})) y = {called}({arguments});
            fwrite(&y, sizeof y, 1, out);
        }}
        fclose(out);
        free(x);
    }}\n",
        rows * case.inputs.len()
    )
}

const RUST_FILES: &str = "
fn load(path: &str) -> Vec<f32> {
    let bytes = std::fs::read(path).unwrap();
    bytes.chunks_exact(4).map(|b| f32::from_le_bytes(b.try_into().unwrap())).collect()
}

fn save(path: &str, values: &[f32]) {
    let bytes: Vec<u8> = values.iter().flat_map(|v| v.to_le_bytes()).collect();
    std::fs::write(path, bytes).unwrap();
}

";

fn rust_program(case: &Case) -> String {
    let (rows, function, called) = (case.rows(), &case.function, called(case));
    let values: Vec<String> = match case.names.outputs.len() {
        1 => vec!["y".to_owned()],
        n => (0..n).map(|o| format!("y.{o}")).collect(),
    };
    format!(
        "    let x = load(\"{function}.in\");
    let mut values = Vec::new();
    for i in 0..{rows} {{
        let y = {called}({});
        values.extend([{}]);
    }}
    save(\"{function}.out\", &values);\n",
        arguments(case),
        values.join(", ")
    )
}

/// What depends on an input must be of its type: a double would be better than what is promised.
const PYTHON_FILES: &str = "
def run(name, function, columns):
    x = np.fromfile(name + \".in\", np.float32).reshape(columns, -1)
    with np.errstate(all=\"ignore\"):
        y = function(*x)
    y = y if isinstance(y, tuple) else (y,)
    assert all(isinstance(v, float) or v.dtype == np.float32 for v in y), name
    rows = np.stack([np.broadcast_to(np.float32(v), x.shape[1]) for v in y], axis=1)
    rows.tofile(name + \".out\")


";

fn python_program(case: &Case) -> String {
    let (function, called) = (&case.function, called(case));
    format!("run(\"{function}\", {called}, {})\n", case.inputs.len())
}

const JAVASCRIPT_FILES: &str = "
import { readFileSync, writeFileSync } from 'node:fs';

function run(name, f, columns) {
    const bytes = readFileSync(name + '.in');
    const x = new Float32Array(bytes.buffer, bytes.byteOffset, bytes.length/4);
    const rows = x.length/columns;
    const values = [];
    for (let i = 0; i < rows; ++i) {
        values.push(f(...Array.from({ length: columns }, (_, c) => x[c*rows + i])));
    }
    writeFileSync(name + '.out', new Float32Array(values.flat()));
}

";

fn javascript_program(case: &Case) -> String {
    let (function, called) = (&case.function, called(case));
    format!("run('{function}', {called}, {});\n", case.inputs.len())
}
