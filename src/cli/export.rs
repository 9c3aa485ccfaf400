//! `lgp export`: a dataset as a file for other programs.

use super::output::check_writable;
use super::{Common, Failure};
use crate::dataset::Dataset;
use crate::export::{Rows, to_csv};
use crate::file::replace_file;
use clap::ValueEnum;
use serde::Serialize;
use std::path::{Path, PathBuf};

/// Write a dataset as a table for other programs
///
/// The columns are the inputs, the outputs, `weight` and the standard errors as `y_se`, as far as
/// there are any; `lgp import` reads the same values back. Units, domains and claims stay behind.
///
/// For example: lgp export datasets/dfg.bin -o dfg.csv
#[derive(clap::Args)]
pub struct Args {
    /// The dataset: a file from `lgp generate` or `lgp import`
    dataset: PathBuf,
    /// The file to write; its extension says as what: .csv
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// The rows to write
    #[arg(long, value_enum, default_value_t = Which::Both)]
    split: Which,
}

#[derive(Clone, Copy, ValueEnum)]
enum Which {
    /// Those that formulas are fitted to
    Search,
    /// Those that a front is judged on
    Validation,
    /// The search rows, then the validation rows
    Both,
}

#[derive(Serialize)]
struct Exported {
    dataset: String,
    #[serde(serialize_with = "crate::cli::output::readable")]
    path: PathBuf,
    rows: usize,
}

pub fn run(args: &Args, common: &Common) -> Result<(), Failure> {
    let write = writer(&args.output)?;
    let dataset = Dataset::load(&args.dataset)?;
    check_writable(&args.output)?;
    let rows = match args.split {
        Which::Search => Rows::Search,
        Which::Validation => Rows::Validation,
        Which::Both => Rows::Both,
    };
    let bytes = write(&dataset, rows);
    replace_file(&args.output, &bytes).map_err(|error| Failure::unwritable(&args.output, error))?;
    let exported = Exported {
        rows: rows.of(&dataset).iter().map(|split| split.rows()).sum(),
        dataset: dataset.name,
        path: args.output.clone(),
    };
    let text = format!("{}: {} rows of {}", args.output.display(), exported.rows, exported.dataset);
    common.summary(&exported, &text)
}

/// Makes the bytes of a file.
type Writer = fn(&Dataset, Rows) -> Vec<u8>;

/// Returns what writes a file of this extension.
fn writer(path: &Path) -> Result<Writer, Failure> {
    let extension = path.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
    match &*extension {
        "csv" => Ok(|dataset, rows| to_csv(dataset, rows).into_bytes()),
        _ => {
            let path = path.display();
            Err(Failure::usage(format!("{path}: cannot be written as .{extension}; write a .csv")))
        }
    }
}
