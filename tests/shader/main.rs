//! Functions of shaders as truths: that they compute what compilers and GPUs make of them, that
//! programs of them are the same functions, and what becomes of files that are none.

#![cfg(feature = "cli")]

mod cases;
mod cpp;
mod hlsl;
mod hostile;
mod lavapipe;
mod programs;
mod random;
mod refused;
mod spellings;
mod spirv;
#[path = "../emit/tools.rs"]
mod tools;
#[path = "../vulkan/mod.rs"]
mod vulkan;

use lgp::shader::{Error, Options, Shader};

/// Reads a function of a text.
fn read(file: &str, text: &str) -> Result<Shader, Error> {
    read_with(file, text, &Options::default())
}

fn read_with(file: &str, text: &str, options: &Options) -> Result<Shader, Error> {
    Shader::parse(file.as_ref(), text.into(), options)
}

/// Options: the entry, unless empty; `--set`s; `--let`s; the inputs that have a range.
fn options(entry: &str, set: &[&str], define: &[&str], ranged: &[&str]) -> Options {
    let all = |texts: &[&str]| texts.iter().map(|&text| text.to_owned()).collect();
    Options {
        entry: (!entry.is_empty()).then(|| entry.to_owned()),
        set: all(set),
        define: all(define),
        ranged: all(ranged),
    }
}

/// Asserts that a message has all of these parts in it.
fn says(error: &Error, parts: &[&str]) {
    let message = error.to_string();
    for part in parts {
        assert!(message.contains(part), "{part:?} is not in: {message}");
    }
}
