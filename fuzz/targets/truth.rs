//! A function as a truth: a shader in WGSL, GLSL or SPIR-V, or a formula, by the first byte. What is
//! read is evaluated and written down as a program, which computes the same.
//!
//! naga may panic in its thread, where that is an error as others are.
#![no_main]

use lgp::eval::{Arithmetic, Double};
use lgp::shader::{Options, Shader};
use lgp::truth::{Truth, parse_domain, read_formula};
use libfuzzer_sys::fuzz_target;
use std::panic::{set_hook, take_hook};
use std::path::Path;

/// Enough for every loop that a program can be of, and over soon.
const STEPS: u64 = 20_000;
const VALUES: [f64; 5] = [0.5, 0.0, -1.5, 3.0, 0.25];

fuzz_target!(
    init: {
        let aborts = take_hook();
        set_hook(Box::new(move |panic| match std::thread::current().name() {
            Some("shader") => {}
            _ => aborts(panic),
        }));
    },
    |content: &[u8]| {
        let Some((first, rest)) = content.split_first() else { return };
        match first % 4 {
            0 => shader("fuzzed.wgsl", rest),
            1 => shader("fuzzed.glsl", rest),
            2 => shader("fuzzed.spv", rest),
            _ => formula(rest),
        }
    }
);

fn shader(file: &str, content: &[u8]) {
    let read = Shader::parse(Path::new(file), content.to_vec(), &Options::default());
    let Ok(shader) = read else { return };
    let shader = shader.within(STEPS);
    let program = shader.program();
    for shift in 0..VALUES.len() {
        let inputs = shader.inputs().len();
        let point: Vec<f64> = (0..inputs).map(|i| VALUES[(i + shift) % VALUES.len()]).collect();
        let Ok(values) = shader.at(&point) else { return };
        assert_eq!(values.len(), shader.outputs().len());
        let Ok(program) = &program else { continue };
        assert_eq!(Double.evaluate(program, &point).len(), values.len());
    }
}

fn formula(content: &[u8]) {
    let Ok(text) = std::str::from_utf8(content) else { return };
    let Ok(parsed) = read_formula(text, &[]) else { return };
    let domain: Vec<String> =
        parsed.names.inputs.iter().map(|name| format!("{name}=0.25..2")).collect();
    let Ok(domain) = parse_domain(&domain.join(",")) else { return };
    let Ok(truth) = Truth::formula(text, &[], &domain) else { return };
    let point: Vec<f64> = truth.axes().iter().map(|_| 0.5).collect();
    if let Ok(values) = truth.at(&point) {
        assert_eq!(values.len(), truth.outputs().len());
    }
}
