//! The interpreter in double precision, and C++ that was translated by hand.

use crate::cases::{CASES, Case, LANGUAGES, folder};
use crate::tools;
use std::path::Path;

const POINTS: usize = 300;

/// Relative to the largest value of the output near 1: roundings of some hundred operations.
const ACCURACY: f64 = 1e-12;

#[test]
fn shaders_compute_what_cpp_computes() {
    if !tools::found(&["c++", "--version"], "shaders were not compared with C++") {
        return;
    }
    let directory = tempfile::tempdir().unwrap();
    let source = folder().join("functions.cpp");
    let command = ["c++", "-O1", "-std=c++17", "-ffp-contract=off", "-Wall", "-o", "functions"];
    tools::run(directory.path(), &[&command[..], &[source.to_str().unwrap()]].concat());
    let mut arguments = vec!["./functions".to_owned()];
    for case in &CASES {
        let (inputs, outputs) = (case.domain.len(), case.outputs.len());
        arguments.extend([case.name.to_owned(), inputs.to_string(), outputs.to_string()]);
        let values = case.points(POINTS).concat();
        let bytes: Vec<u8> = values.iter().flat_map(|value| value.to_le_bytes()).collect();
        std::fs::write(directory.path().join(format!("{}.in", case.name)), bytes).unwrap();
    }
    tools::run(directory.path(), &arguments.iter().map(String::as_str).collect::<Vec<_>>());
    for case in &CASES {
        for language in LANGUAGES {
            compare(case, language, directory.path());
        }
    }
}

fn compare(case: &Case, language: &str, directory: &Path) {
    let Some(shader) = case.read(language) else { return };
    let bytes = std::fs::read(directory.join(format!("{}.out", case.name))).unwrap();
    let values: Vec<f64> =
        bytes.chunks_exact(8).map(|b| f64::from_le_bytes(b.try_into().unwrap())).collect();
    let points = case.points(POINTS);
    assert_eq!(values.len(), points.len() * case.outputs.len(), "{}", case.name);
    let mut worst = 0.0f64;
    for (point, expected) in points.iter().zip(values.chunks_exact(case.outputs.len())) {
        let found = shader.at(point).unwrap_or_else(|error| panic!("{}: {error}", case.name));
        for (o, (found, expected)) in found.iter().zip(expected).enumerate() {
            let apart = (found - expected).abs() / expected.abs().max(1.0);
            assert!(
                apart <= ACCURACY,
                "{}.{language}, output {o} at {point:?}: {found:e}, not {expected:e}",
                case.name
            );
            worst = worst.max(apart);
        }
    }
    println!("{}.{language}: {worst:.1e} apart at most", case.name);
}
