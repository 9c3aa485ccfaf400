//! `lgp import`: a dataset from a table in CSV.

use super::output::{check_writable, save};
use super::pruning::Pruning;
use super::{Common, Exit, Failure};
use crate::dataset::{Column, InputColumns, import_csv};
use serde::Serialize;
use std::path::{Path, PathBuf};

/// Make a dataset from a table in CSV
///
/// The first line names the columns; every other line holds one number for each. A column called
/// `weight` weighs the rows. A column `y_se`, where `y` is an output, holds the standard errors of
/// `y`: no formula wins by a smaller difference. One row in four is kept for
/// validation.
///
/// For example: lgp import mine.csv -o mine.bin --inputs 2
#[derive(clap::Args)]
pub struct Args {
    /// The table: comma-separated numbers under a line of column names
    table: PathBuf,
    /// The dataset to write
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// The inputs: N for the first N columns, or names as in a,b; all other columns are outputs
    #[arg(long, value_name = "N|NAMES", value_parser = input_columns)]
    inputs: InputColumns,
    /// A claim that formulas should meet, as in "sum: a + b <= 1"; can be given several times
    #[arg(long, value_name = "CLAIM")]
    claim: Vec<String>,
    #[command(flatten)]
    pruning: Pruning,
}

#[derive(Serialize)]
struct Imported {
    dataset: String,
    #[serde(serialize_with = "crate::cli::output::readable")]
    path: PathBuf,
    inputs: Vec<String>,
    outputs: Vec<String>,
    search_rows: usize,
    validation_rows: usize,
    standard_errors: bool,
    hash: String,
}

pub fn run(args: &Args, common: &Common) -> Result<(), Failure> {
    let mut dataset = import_csv(&args.table, &args.inputs)?;
    let claimed = args.claim.iter().try_for_each(|claim| dataset.claim(claim));
    claimed.map_err(|error| Failure::new(Exit::Usage, error))?;
    if same_file(&args.table, &args.output) {
        let path = args.output.display();
        let message = format!("{path}: the output would replace the table; write to another file");
        return Err(Failure::usage(message));
    }
    check_writable(&args.output)?;
    let dataset = save(args.pruning.applied_to(dataset), &args.output)?;
    let names =
        |columns: &[Column]| columns.iter().map(|column| column.name.clone()).collect::<Vec<_>>();
    let imported = Imported {
        inputs: names(&dataset.inputs),
        outputs: names(&dataset.outputs),
        search_rows: dataset.search.rows(),
        validation_rows: dataset.validation.rows(),
        standard_errors: !dataset.search.standard_errors.is_empty(),
        hash: dataset.hash(),
        dataset: dataset.name,
        path: args.output.clone(),
    };
    common.summary(&imported, &summary(&imported))
}

fn summary(imported: &Imported) -> String {
    format!(
        "{}: {} → {}, {} search and {} validation rows{}",
        imported.path.display(),
        imported.inputs.join(", "),
        imported.outputs.join(", "),
        imported.search_rows,
        imported.validation_rows,
        if imported.standard_errors { ", with standard errors" } else { "" }
    )
}

fn same_file(a: &Path, b: &Path) -> bool {
    match (a.canonicalize(), b.canonicalize()) {
        (Ok(a), Ok(b)) => a == b,
        _ => false,
    }
}

fn input_columns(text: &str) -> Result<InputColumns, String> {
    let explained = "write how many of the first columns are inputs, or their names with commas";
    if let Ok(count) = text.trim().parse::<usize>() {
        return match count {
            0 => Err(format!("at least one input is needed; {explained}")),
            count => Ok(InputColumns::Count(count)),
        };
    }
    let names: Vec<String> = text.split(',').map(|name| name.trim().to_owned()).collect();
    match names.iter().any(String::is_empty) {
        true => Err(format!("a name is empty; {explained}")),
        false => Ok(InputColumns::Names(names)),
    }
}
