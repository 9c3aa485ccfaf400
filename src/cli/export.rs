//! `lgp export`: a dataset as a file for other programs.

use super::output::check_writable;
use super::{Common, Failure};
use crate::dataset::Dataset;
use crate::export::{Rows, to_csv};
use crate::file::replace_file;
use crate::import::array::{Array, to_exr, to_npy};
use clap::ValueEnum;
use serde::Serialize;
use std::path::{Path, PathBuf};

/// Write a dataset as a table or a picture for other programs
///
/// As .csv or .npy a table. The columns are the inputs, the outputs, `weight` and the standard errors as `y_se`, as far as
/// there are any; `lgp import` reads the same values back. As .exr, or as .npy with --grid, the outputs
/// on their grid, the first input along x. Units, domains and claims stay behind.
///
/// For example: lgp export datasets/dfg.bin -o dfg.csv
#[derive(clap::Args)]
pub struct Args {
    /// The dataset: a file from `lgp generate` or `lgp import`
    dataset: PathBuf,
    /// The file to write; its extension says as what: .csv, .npy or .exr
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// The rows to write
    #[arg(long, value_enum, default_value_t = Which::Both)]
    split: Which,
    /// Write the outputs on the grid of the inputs, without these, as .exr always does
    #[arg(long)]
    grid: bool,
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
    let write = writer(&args.output, args.grid)?;
    let dataset = Dataset::load(&args.dataset)?;
    check_writable(&args.output)?;
    let rows = match args.split {
        Which::Search => Rows::Search,
        Which::Validation => Rows::Validation,
        Which::Both => Rows::Both,
    };
    let (bytes, count) = write(&dataset, rows)
        .map_err(|reason| Failure::input(format!("{}: {reason}", args.dataset.display())))?;
    replace_file(&args.output, &bytes).map_err(|error| Failure::unwritable(&args.output, error))?;
    let exported = Exported { rows: count, dataset: dataset.name, path: args.output.clone() };
    let text = format!("{}: {} rows of {}", args.output.display(), exported.rows, exported.dataset);
    common.summary(&exported, &text)
}

/// Makes the bytes of a file and counts its rows, or says why there are none.
type Writer = fn(&Dataset, Rows) -> Result<(Vec<u8>, usize), String>;

/// Returns what writes a file of this extension.
fn writer(path: &Path, grid: bool) -> Result<Writer, Failure> {
    let extension = path.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
    match (&*extension, grid) {
        ("csv", false) => {
            Ok(|dataset, rows| Ok((to_csv(dataset, rows).into_bytes(), count(dataset, rows))))
        }
        ("csv", true) => Err(Failure::usage("--grid: a .csv has rows; write a .npy or an .exr")),
        ("npy", false) => Ok(|dataset, rows| {
            let array = Array::of_rows(dataset, &rows.of(dataset));
            Ok((to_npy(&array), count(dataset, rows)))
        }),
        ("npy", true) => Ok(|dataset, rows| {
            let array = on_grid(dataset, rows)?;
            Ok((to_npy(&array), array.size.iter().product()))
        }),
        ("exr", _) => Ok(|dataset, rows| {
            let array = on_grid(dataset, rows)?;
            let bytes = to_exr(&array).map_err(|fault| fault.to_string())?;
            Ok((bytes, array.size.iter().product()))
        }),
        _ => {
            let path = path.display();
            Err(Failure::usage(format!(
                "{path}: cannot be written as .{extension}; write a .csv, .npy or .exr"
            )))
        }
    }
}

fn count(dataset: &Dataset, rows: Rows) -> usize {
    rows.of(dataset).iter().map(|split| split.rows()).sum()
}

fn on_grid(dataset: &Dataset, rows: Rows) -> Result<Array, String> {
    let split = match rows {
        Rows::Search => Some(&dataset.search),
        Rows::Validation => Some(&dataset.validation),
        Rows::Both => None,
    };
    let rows = "its rows are on no grid; write them as .csv, or as .npy without --grid";
    Array::of_grid(dataset, split).ok_or_else(|| rows.to_owned())
}
