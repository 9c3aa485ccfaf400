//! Formulas over a dataset's columns.

use super::Outcome;
use lgp::dataset::{Split, load_incumbents};
use lgp::eval::{Evaluator, Samples, Tape};
use lgp::program::{Names, Program, parse};
use std::path::Path;

pub struct Formula {
    pub name: String,
    program: Program,
}

impl Formula {
    /// The published formulas of a dataset.
    pub fn incumbents(dataset: &str, inputs: &[&str], outputs: &[&str]) -> Outcome<Vec<Formula>> {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("datasets/incumbents");
        let names = Names::new(inputs.iter().copied(), outputs.iter().copied());
        let all = load_incumbents(&folder.join(dataset).with_extension("ron"))?;
        let formula = |one: lgp::dataset::Incumbent| -> Outcome<Formula> {
            Ok(Formula { program: parse(&one.formula, &names)?, name: one.name })
        };
        all.into_iter().map(formula).collect()
    }

    /// The formula that a file has.
    pub fn read(file: &Path, inputs: &[&str], outputs: &[&str]) -> Outcome<Formula> {
        let names = Names::new(inputs.iter().copied(), outputs.iter().copied());
        let program = parse(&std::fs::read_to_string(file)?, &names)?;
        Ok(Formula { name: file.display().to_string(), program })
    }

    /// The values of each output on all rows.
    pub fn values<const N: usize>(&self, rows: &[[f32; N]]) -> Vec<Vec<f32>> {
        let column = |index: usize| rows.iter().map(|row| row[index]).collect();
        let split = Split { columns: (0..N).map(column).collect(), ..Split::default() };
        let mut evaluator = Evaluator::default();
        evaluator.outputs(&Tape::new(&self.program), &Samples::new(&split, N))
    }
}
