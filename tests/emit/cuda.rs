//! CUDA C++ by nvcc: taken, and halves compiled for a device.

use crate::agreement::{Case, front, operations};
use crate::compile::{compiled, samples_to_compile};
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
    let code = samples_to_compile(Language::Cuda).join("\n");
    compiled("snippets.cu", &code, &[&[&*nvcc, "-ptx"], ARCHITECTURE].concat());
}

/// The host has no functions of halves, so they are not run: a kernel calls each.
#[test]
fn nvcc_takes_the_cuda_in_half_precision() {
    let Some(nvcc) = compiler("CUDA in half precision was not compiled") else { return };
    for cases in [operations(), front()] {
        let mut functions = String::new();
        let mut calls = String::new();
        for case in &cases {
            let Case { program, names, function, .. } = case;
            let snippet = Snippet::new(program, names, function);
            functions += &emit_half(Language::Cuda, &snippet, &[]).expect("CUDA has halves");
            let called = if names.outputs.len() == 1 { "_f" } else { "" };
            let arguments: Vec<String> =
                (0..case.inputs.len()).map(|i| format!("__half(x[{i}])")).collect();
            calls += &format!(
                "    {{ auto y = {function}{called}({}); __builtin_memcpy(values, &y, sizeof y); \
                 values += 4; }}\n",
                arguments.join(", ")
            );
        }
        let kernel = format!(
            "{functions}extern \"C\" __global__ void all(const float *x, float *values) \
             {{\n{calls}}}\n"
        );
        compiled("halves.cu", &kernel, &[&[&*nvcc, "-ptx"], ARCHITECTURE].concat());
    }
}
