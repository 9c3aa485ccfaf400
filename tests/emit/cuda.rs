//! CUDA C++ by nvcc: taken, and halves compiled for a device.

use crate::agreement::{Case, front, operations};
use crate::compile::{all_to_compile, compiled};
use crate::grid::called;
use crate::installed::{NVCC, installed};
use crate::tools;
use lgp::emit::{Language, Snippet, emit_half};

/// The oldest with all functions of halves that nvcc 13 compiles for.
pub const ARCHITECTURE: &[&str] = &["-arch=sm_75"];

pub fn compiler(untested: &str) -> Option<String> {
    installed(NVCC, untested).filter(|_| tools::found(&["c++", "--version"], untested))
}

#[test]
fn nvcc_takes_the_cuda() {
    let Some(nvcc) = compiler("CUDA was not compiled") else { return };
    let code = all_to_compile(Language::Cuda).join("\n");
    compiled("snippets.cu", &code, &[&[&*nvcc, "-ptx"], ARCHITECTURE].concat());
}

/// The host has no functions of halves, so they are not run: a kernel calls each. Every second
/// operation in single precision is where most conversions are.
#[test]
fn nvcc_takes_the_cuda_in_half_precision() {
    let Some(nvcc) = compiler("CUDA in half precision was not compiled") else { return };
    for (step, cases) in [(None, operations()), (None, front()), (Some(2), front())] {
        let stay_single = |case: &Case| -> Vec<usize> {
            step.map_or(Vec::new(), |step| (0..case.program.instrs.len()).step_by(step).collect())
        };
        let functions: String =
            cases.iter().map(|case| in_half(case, &stay_single(case))).collect();
        let calls: String = cases.iter().map(call).collect();
        let kernel = format!(
            "{functions}extern \"C\" __global__ void all(const float *x, float *values) \
             {{\n{calls}}}\n"
        );
        compiled("halves.cu", &kernel, &[&[&*nvcc, "-ptx"], ARCHITECTURE].concat());
    }
}

fn in_half(case: &Case, stay_single: &[usize]) -> String {
    let snippet = Snippet::new(&case.program, &case.names, &case.function);
    emit_half(Language::Cuda, &snippet, stay_single).expect("CUDA has halves")
}

/// Calls the function, and leaves its result where it cannot be left out.
fn call(case: &Case) -> String {
    let arguments: Vec<String> =
        (0..case.inputs.len()).map(|i| format!("__half(x[{i}])")).collect();
    format!(
        "    {{ auto y = {}({}); __builtin_memcpy(values, &y, sizeof y); values += 4; }}\n",
        called(case),
        arguments.join(", ")
    )
}
