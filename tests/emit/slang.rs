//! Slang by its compiler: taken, and computed on Vulkan.

use crate::compile::{MAIN_OF_HLSL, all_to_compile};
use crate::installed::{SLANGC, installed};
use crate::lavapipe::{Compiler, agree, words};
use crate::tools;
use lgp::emit::Language;
use std::path::Path;

#[test]
fn slang_computes_what_the_interpreter_computes() {
    agree(Compiler::Slangc);
}

#[test]
fn slangc_takes_the_slang() {
    if found("Slang was not compiled") {
        let code = all_to_compile(Language::Slang).join("\n");
        let folder = tempfile::tempdir().unwrap();
        let shader = format!("[shader(\"fragment\")]\n{MAIN_OF_HLSL}");
        compiled(folder.path(), &format!("{code}\n{shader}"), "hlsl", "fragment");
    }
}

pub fn found(untested: &str) -> bool {
    installed(SLANGC, untested).is_some()
}

pub fn spirv(source: &str) -> Vec<u32> {
    let folder = tempfile::tempdir().unwrap();
    compiled(folder.path(), source, "spirv", "compute");
    words(&folder.path().join("main.code"))
}

fn compiled(folder: &Path, source: &str, target: &str, stage: &str) {
    std::fs::write(folder.join("main.slang"), source).unwrap();
    let slangc = installed(SLANGC, "").expect("it was found");
    // The optimiser of SPIR-V is no part of the wheel.
    let options = ["-O0", "-target", target, "-entry", "main", "-stage", stage];
    let command = [&*slangc, "main.slang", "-o", "main.code"];
    tools::run(folder, &[&command[..], &options].concat());
}
