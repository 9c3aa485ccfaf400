//! Programs, samples, and what the interpreter makes of them: what emitted code has to agree with.

use crate::programs::programs_of;
use lgp::dataset::{Dataset, Split};
use lgp::eval::{Evaluator, Samples, Tape};
use lgp::fit::Measure;
use lgp::op::Op;
use lgp::program::{Names, Program, parse};
use lgp::run::Run;
use lgp::search::Front;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::f32::consts::PI;
use std::path::Path;

pub struct Case {
    /// What the function is called, and what it is.
    pub function: String,
    pub title: String,
    pub program: Program,
    pub names: Names,
    /// The input columns.
    pub inputs: Vec<Vec<f32>>,
    /// The interpreter's output columns.
    pub expected: Vec<Vec<f32>>,
    /// If it is of one operation.
    pub op: Option<Op>,
    /// The instructions that stay in single precision where it is written in halves.
    pub stay_single: Vec<usize>,
}

/// Values agree if either holds.
#[derive(Clone, Copy, Debug)]
pub struct Tolerance {
    pub absolute: f32,
    pub relative: f32,
}

/// For whole formulas.
pub const OF_FORMULAS: Tolerance = Tolerance { absolute: 1e-5, relative: 1e-4 };

impl Case {
    fn new(number: usize, title: String, program: Program, names: Names, split: &Split) -> Case {
        let samples = Samples::new(split, program.inputs);
        Case {
            function: format!("case{number}"),
            title,
            expected: Evaluator::default().outputs(&Tape::new(&program), &samples),
            inputs: split.columns[..program.inputs].to_vec(),
            op: None,
            stay_single: Vec::new(),
            program,
            names,
        }
    }

    pub fn rows(&self) -> usize {
        self.inputs[0].len()
    }

    /// The largest difference where the interpreter's value is finite, relative to the value if
    /// that is larger than 1.
    ///
    /// # Panics
    /// If some value does not agree.
    pub fn compare(&self, found: &[Vec<f32>], tolerance: Tolerance) -> f32 {
        self.compare_with(&self.expected, found, tolerance)
    }

    /// Compares with other outputs than the interpreter's.
    pub fn compare_with(
        &self,
        expected: &[Vec<f32>],
        found: &[Vec<f32>],
        tolerance: Tolerance,
    ) -> f32 {
        let Tolerance { absolute, relative } = tolerance;
        let mut worst = 0.0f32;
        for (o, (found, expected)) in found.iter().zip(expected).enumerate() {
            assert_eq!(found.len(), expected.len(), "{}", self.title);
            for (row, (found, expected)) in found.iter().zip(expected).enumerate() {
                if !expected.is_finite() {
                    continue;
                }
                let difference = (found - expected).abs();
                assert!(
                    difference <= absolute || difference <= relative * expected.abs(),
                    "{}, output {o} at {:?}: {found:e}, not {expected:e}",
                    self.title,
                    self.inputs.iter().map(|column| column[row]).collect::<Vec<_>>()
                );
                worst = worst.max(difference / expected.abs().max(1.0));
            }
        }
        worst
    }
}

/// Every member of a front of the fixtures, on both splits of its dataset.
pub fn front() -> Vec<Case> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let folder = root.join("tests/fixtures/dfg");
    let run = Run::load(&folder).unwrap();
    let data = Dataset::load(&root.join("datasets/dfg.bin")).unwrap();
    let both = |column: usize| {
        let parts = [&data.search, &data.validation].map(|split| split.columns[column].as_slice());
        parts.concat()
    };
    let split = Split { columns: (0..run.inputs.len()).map(both).collect(), ..Split::default() };
    let members = Front::load(&folder.join("front.json"), &run, Measure::Rmse).unwrap().members;
    assert!(members.len() >= 20);
    let cases = members.into_iter().enumerate().map(|(i, member)| {
        Case::new(i, format!("member {}", i + 1), member.program, run.names(), &split)
    });
    cases.collect()
}

/// Each operation, on inputs and on a constant in each place.
pub fn operations() -> Vec<Case> {
    let names = Names::new(["x", "y", "z", "w"], ["f"]);
    let mut rng = ChaCha8Rng::seed_from_u64(7);
    let programs = Op::ALL.iter().flat_map(|&op| programs_of(op).into_iter().map(move |p| (op, p)));
    let cases = programs.enumerate().map(|(i, (op, program))| {
        let mut column = || (0..256).map(|_| argument(&mut rng, op)).collect();
        let split = Split { columns: (0..4).map(|_| column()).collect(), ..Split::default() };
        Case {
            op: Some(op),
            ..Case::new(i, format!("{op}, form {i}"), program, names.clone(), &split)
        }
    });
    cases.collect()
}

/// A formula whose constants are small or have many digits.
pub fn fine_constants() -> Case {
    let names = Names::new(["x", "y"], ["f"]);
    let text = "f = x*1.2345678e-5 + (y*0.12345679 - 3.14e-9)/(x + 1e-7) - 2.5e-30";
    let column = |from: f32| (0..256).map(|i| from + i as f32 / 256.0).collect();
    let split = Split { columns: vec![column(0.0), column(-0.5)], ..Split::default() };
    Case::new(0, "fine constants".to_owned(), parse(text, &names).unwrap(), names, &split)
}

/// Ordinary values, and those where something changes.
fn argument(rng: &mut ChaCha8Rng, op: Op) -> f32 {
    const SPECIAL: [f32; 8] = [-2.0, -1.0, -0.5, 0.0, 0.5, 0.75, 1.0, 3.0];
    let [low, high] = match op {
        Op::Asin | Op::Acos => [-1.0, 1.0],
        Op::Sqrt | Op::Rsqrt | Op::Log2 | Op::Log | Op::Pow => [0.0, 8.0],
        // Shaders promise nothing outside.
        Op::Sin | Op::Cos => [-PI, PI],
        // Short of the pole.
        Op::Tan => [-1.3, 1.3],
        _ => [-8.0, 8.0],
    };
    let special = SPECIAL.map(|value| match op {
        // Nor where both are zero.
        Op::Atan2 if value == 0.0 => 0.25,
        _ => value.clamp(low, high),
    });
    match rng.random_range(0..4) {
        0 => special[rng.random_range(0..special.len())],
        _ => rng.random_range(low..high),
    }
}
