//! What formulas of the multi-lobe model's parameters cost in error, beside the tables that they
//! replace (`datasets/ggx_lobes.bin`).
//!
//! `cargo run --release --example lobes -- FORMULA…`, each of one parameter or several over
//! `n_dot_v` and `roughness`, such as `spread = roughness^2*(1.4 - 0.7*n_dot_v)`; parameters without
//! one are the tables'. Prints means over places of the error integral
//! `∫ (R - M)²`, and of that as a share of `∫ R²`: at the tables' own places, and in the middle
//! between four of them, where tables are interpolated bilinearly.

use lgp::dataset::{Dataset, Split};
use lgp::lobes::{Fan, Misfit, Moments, Response};
use lgp::program::{Names, Program, Template, parse};
use rayon::prelude::*;
use std::error::Error;
use std::path::Path;

/// Points from each distribution: errors to half a percent.
const POINTS: usize = 864;
const LOBES: usize = 8;

fn main() -> Result<(), Box<dyn Error>> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("datasets/ggx_lobes.bin");
    let data = Dataset::load(&path)?;
    let names = data.names();
    let formulas = std::env::args()
        .skip(1)
        .map(|text| read(&text, &names))
        .collect::<Result<Vec<_>, Box<dyn Error>>>()?;
    let (table, fitted) = (&data.search, &data.validation);
    println!("places,parameters,mean error,mean share of the squares");
    let own: Vec<[f32; 6]> = (0..table.rows()).map(|row| row_of(table, row)).collect();
    report("at the table's", &own, &formulas);
    let [rows, columns] = table.grid[..] else { return Err("no grid".into()) };
    let between = |row: usize| -> Option<[[f32; 6]; 2]> {
        let (i, j) = (row / (columns + 1), row % (columns + 1));
        let inside = (1..rows).contains(&i) && (1..columns).contains(&j);
        inside.then(|| {
            let corners = [(i - 1, j - 1), (i - 1, j), (i, j - 1), (i, j)];
            let corners = corners.map(|(i, j)| own[i * columns + j]);
            let mean = |k: usize| 0.25 * corners.iter().map(|corner| corner[k]).sum::<f32>();
            [row_of(fitted, row), std::array::from_fn(mean)]
        })
    };
    let pairs: Vec<_> = (0..fitted.rows()).filter_map(between).collect();
    let [optima, interpolated] =
        [0, 1].map(|k| pairs.iter().map(|pair| pair[k]).collect::<Vec<_>>());
    report("between, fitted there", &optima, &[]);
    report("between", &interpolated, &formulas);
    Ok(())
}

/// A formula, and the columns that it replaces.
struct Formula {
    columns: Vec<usize>,
    program: Program,
}

fn read(text: &str, names: &Names) -> Result<Formula, Box<dyn Error>> {
    let outputs = Template::assigned(text, names)?;
    if outputs.is_empty() {
        return Err(format!("{text}: it assigns none of {}", names.outputs.join(", ")).into());
    }
    let place = |name: &String| names.outputs.iter().position(|known| known == name);
    let columns = outputs.iter().filter_map(place).map(|at| names.inputs.len() + at).collect();
    let program = parse(text, &Names::new(names.inputs.clone(), outputs))?;
    Ok(Formula { columns, program })
}

fn row_of(split: &Split, row: usize) -> [f32; 6] {
    std::array::from_fn(|column| split.columns[column][row])
}

/// Prints the errors of rows of parameters, and of the same with the formulas in their place.
fn report(places: &str, rows: &[[f32; 6]], formulas: &[Formula]) {
    let replaced = |row: &[f32; 6]| {
        let mut row = *row;
        for Formula { columns, program } in formulas {
            let values = program.evaluate(&row[..2]);
            columns.iter().zip(values).for_each(|(&column, value)| row[column] = value);
        }
        row
    };
    let before = mean_errors(rows);
    println!("{places},tables,{:.4e},{:.5}", before[0], before[1]);
    if !formulas.is_empty() {
        let after = mean_errors(&rows.iter().map(replaced).collect::<Vec<_>>());
        println!("{places},formulas,{:.4e},{:.5}", after[0], after[1]);
        let [error, share] = [0, 1].map(|k| after[k] / before[k]);
        println!("{places},ratio,{error:.3},{share:.3}");
    }
}

fn mean_errors(rows: &[[f32; 6]]) -> [f64; 2] {
    let moments: Vec<Moments> = rows.par_iter().map(moments).collect();
    let mean =
        |of: &dyn Fn(&Moments) -> f64| moments.iter().map(of).sum::<f64>() / moments.len() as f64;
    [mean(&Moments::error), mean(&Moments::relative_error)]
}

/// Integrates for a row of n·v, roughness and parameters.
fn moments(row: &[f32; 6]) -> Moments {
    let [n_dot_v, roughness, cosine, spread, log_amplitude, log_lambda] = row.map(f64::from);
    let theta = cosine.clamp(-1.0, 1.0).acos();
    let (lambda, amplitude) = (log_lambda.exp(), log_amplitude.exp());
    let fan = Fan { count: LOBES, theta, spread: spread.max(0.0), lambda, amplitude };
    Misfit::new(Response::new(n_dot_v, roughness * roughness), POINTS).fan_moments(&fan)
}
