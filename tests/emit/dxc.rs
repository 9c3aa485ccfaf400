//! HLSL by the DirectX Shader Compiler, Microsoft's own: taken, and computed on Vulkan.

use crate::compile::{MAIN_OF_HLSL, all_to_compile};
use crate::installed::{driver, installed};
use crate::lavapipe::Precision::{self, InHalf};
use crate::lavapipe::{Compiler, agree, words};
use crate::tools;
use lgp::emit::Language;
use std::path::PathBuf;

#[test]
fn hlsl_by_dxc_computes_what_the_interpreter_computes() {
    agree(Compiler::Dxc);
}

#[test]
fn dxc_takes_the_hlsl() {
    if found("HLSL was not compiled by DXC") {
        let mut samples = all_to_compile(Language::Hlsl);
        // Its validator refuses a power of infinity: `No indefinite logarithm`.
        samples.retain(|code| !code.contains("pow(infinity") && !code.contains("pow(minus_inf"));
        assert!(samples.len() > 400, "{}", samples.len());
        let code = samples.join("\n");
        // Functions of a library are compiled even if nothing calls them.
        compiled(&code, &["-T", "lib_6_3", "-default-linkage", "external"]);
        let shader = format!("{code}\n{MAIN_OF_HLSL}");
        compiled(&shader, &["-T", "ps_6_0", "-E", "main"]);
        compiled(&shader, &["-T", "ps_6_0", "-E", "main", "-spirv"]);
    }
}

pub fn found(untested: &str) -> bool {
    installed("libdxcompiler.so", untested).is_some()
        && tools::found(&["python3", "--version"], untested)
}

pub fn spirv(source: &str, precision: Precision) -> Vec<u32> {
    let halves = (precision == InHalf).then_some("-enable-16bit-types");
    let options = ["-T", "cs_6_2", "-E", "main", "-spirv", "-fspv-target-env=vulkan1.2"];
    let (folder, code) = compiled(source, &options.into_iter().chain(halves).collect::<Vec<_>>());
    let words = words(&code);
    drop(folder);
    words
}

fn compiled(source: &str, options: &[&str]) -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("main.hlsl"), source).unwrap();
    let driver = driver("dxc.py");
    let command = ["python3", &driver, "main.hlsl", "main.code"];
    tools::run(folder.path(), &[&command, options].concat());
    let code = folder.path().join("main.code");
    (folder, code)
}
