//! The crate `symbolic_regression` on a table: `peer-symbolic-regression TABLE.csv SECONDS SEED`.
//! The last column is the target. Prints the front, a formula a line, over `x0`, `x1`, ….

use dynamic_expressions::strings::{StringTreeOptions, string_tree};
use ndarray::{Array1, Array2};
use symbolic_regression::prelude::*;

/// As the shader grammar: what the crate calls `inv` is `rcp`.
const OPERATORS: [&str; 10] = ["add", "sub", "mul", "div", "min", "max", "exp2", "log2", "sqrt", "inv"];

fn main() {
    let args: Vec<String> = std::env::args().collect();
    let [_, table, seconds, seed] = &args[..] else { panic!("TABLE.csv SECONDS SEED") };
    let text = std::fs::read_to_string(table).expect("the table");
    let parse = |cell: &str| cell.parse::<f32>().expect("a number");
    let rows: Vec<Vec<f32>> =
        text.lines().skip(1).map(|line| line.split(',').map(parse).collect()).collect();
    let inputs = rows[0].len() - 1;
    let x = Array2::from_shape_fn((inputs, rows.len()), |(column, row)| rows[row][column]);
    let y = Array1::from_iter(rows.iter().map(|row| row[inputs]));
    let options = Options::<f32, 3> {
        seed: seed.parse().expect("a seed"),
        timeout_in_seconds: seconds.parse().expect("seconds"),
        niterations: usize::MAX / 2,
        maxsize: 40,
        progress: false,
        operators: BuiltinOpsF32::from_names(OPERATORS).expect("known operators"),
        ..Default::default()
    };
    let result = equation_search::<f32, BuiltinOpsF32, 3>(&Dataset::new(x, y), &options);
    for member in result.hall_of_fame.pareto_front() {
        let precise = StringTreeOptions { print_precision: Some(9), ..Default::default() };
        println!("{}", string_tree(&member.expr, precise));
    }
}
