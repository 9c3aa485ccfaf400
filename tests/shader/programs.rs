//! Functions written down as programs, and the same functions interpreted.

use crate::cases::{CASES, Case, LANGUAGES};
use lgp::eval::{Arithmetic, Double};
use lgp::shader::Shader;

/// Relative, or absolute below 1. Numbers that are computed of constants are rounded to single
/// precision in programs.
const ACCURACY: f64 = 1e-6;

#[test]
fn programs_compute_what_the_interpreter_computes() {
    let mut compared = 0;
    for case in CASES.iter().filter(|case| case.no_program.is_none()) {
        for language in LANGUAGES {
            let Some(shader) = case.read(language) else { continue };
            compare(case, &shader);
            compared += 1;
        }
    }
    assert!(compared >= 28, "{compared}");
}

fn compare(case: &Case, shader: &Shader) {
    let program = shader.program().unwrap_or_else(|error| panic!("{}: {error}", case.name));
    for point in case.points(500) {
        let (found, expected) = (Double.evaluate(&program, &point), shader.at(&point).unwrap());
        assert_eq!(found.len(), expected.len());
        for (o, (found, expected)) in found.iter().zip(&expected).enumerate() {
            let tolerance = ACCURACY * expected.abs().max(1.0);
            assert!(
                (found - expected).abs() <= tolerance,
                "{}, output {o} at {point:?}: {found:e}, not {expected:e}",
                case.name
            );
        }
    }
}

#[test]
fn what_no_program_is_says_why_and_where() {
    for case in CASES {
        let Some(reason) = case.no_program else { continue };
        for language in LANGUAGES {
            let Some(shader) = case.read(language) else { continue };
            let message = shader.program().unwrap_err().to_string();
            assert!(message.contains(reason), "{message}");
            assert!(message.contains(", line "), "{message}");
        }
    }
}
