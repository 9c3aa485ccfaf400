//! `lgp scene`: scenes from what is logged of a use.

use super::output::check_writable;
use super::{Common, Failure};
use crate::dataset;
use crate::file::replace_file;
use crate::import::Error;
use crate::import::table::Table;
use crate::scene::{Logged, Scene};
use clap::Subcommand;
use serde::Serialize;
use std::path::{Path, PathBuf};

/// Make a scene: a file that says what a use needs of a dataset
#[derive(clap::Args)]
pub struct Args {
    #[command(subcommand)]
    from: From,
}

#[derive(Subcommand)]
enum From {
    From(FromArgs),
}

/// Make a scene from logged pixels: which values of the inputs occur, and how often
///
/// The log is a table with a row for each pixel, its columns called like the dataset's inputs.
/// A column called `weight` weighs the rows. Columns that never change become fixed inputs.
///
/// For example: lgp scene from pixels.csv -o satin.ron
#[derive(clap::Args)]
struct FromArgs {
    /// The table, written in any way that `lgp import` reads; - reads standard input
    log: PathBuf,
    /// The scene to write [default: the table's name with .ron]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Use only these columns [default: all]
    #[arg(long, value_name = "A,B", value_delimiter = ',')]
    inputs: Option<Vec<String>>,
    /// The column that weighs the rows [default: weight, if there is one]
    #[arg(long, value_name = "COLUMN")]
    weight: Option<String>,
    /// The number of histogram bins along each input
    #[arg(long, value_name = "N", default_value_t = 16)]
    #[arg(value_parser = clap::value_parser!(u16).range(1..=256))]
    bins: u16,
    /// Make a histogram for each input by itself [default: one for all, up to three inputs]
    #[arg(long)]
    separate: bool,
}

#[derive(Serialize)]
struct Made {
    scene: Scene,
    #[serde(serialize_with = "crate::cli::output::readable")]
    path: PathBuf,
    pixels: usize,
}

/// The column that holds weights unless another is named.
const WEIGHT: &str = "weight";

pub fn run(args: &Args, common: &Common) -> Result<(), Failure> {
    let From::From(args) = &args.from;
    let table = Table::read(&args.log)?;
    let path = args.output.clone().unwrap_or_else(|| default_output(&args.log));
    if path == args.log {
        let message =
            format!("{}: the scene would replace the log; give another -o", path.display());
        return Err(Failure::usage(message));
    }
    check_writable(&path)?;
    let weights = weights(args, &table)?;
    let columns = columns(args, &table)?;
    let logged: Vec<Logged> = columns
        .iter()
        .map(|&index| Logged { name: &table.names[index], values: &table.columns[index] })
        .collect();
    let name = path.file_stem().unwrap_or_default().to_string_lossy();
    let weights = weights.map(|index| table.columns[index].as_slice());
    let scene = Scene::logged(&name, &logged, weights, args.bins.into(), !args.separate)?;
    replace_file(&path, scene.to_ron().as_bytes())
        .map_err(|error| Failure::unwritable(&path, error))?;
    let pixels = table.columns[0].len();
    let first = format!("{}: {pixels} pixels; {}", path.display(), scene.summary());
    let text = [vec![first], table.understood.sentences()].concat().join("\n  ");
    common.summary(&Made { scene, path, pixels }, &text)
}

fn default_output(log: &Path) -> PathBuf {
    let mut name = log.file_stem().unwrap_or_default().to_owned();
    name.push(".ron");
    name.into()
}

fn weights(args: &FromArgs, table: &Table) -> Result<Option<usize>, Failure> {
    let index = match &args.weight {
        Some(name) => Some(table.index_of(&args.log, name)?),
        None => table.names.iter().position(|name| name == WEIGHT),
    };
    let Some(index) = index else { return Ok(None) };
    match table.columns[index].iter().zip(&table.lines).find(|(weight, _)| **weight < 0.0) {
        None => Ok(Some(index)),
        Some((&value, &line)) => {
            let column = table.names[index].clone();
            Err(Error::NegativeWeight { path: args.log.clone(), line, column, value }.into())
        }
    }
}

/// Returns the columns of the inputs.
fn columns(args: &FromArgs, table: &Table) -> Result<Vec<usize>, Failure> {
    let weight = args.weight.as_deref().unwrap_or(WEIGHT);
    let indices: Vec<usize> = match &args.inputs {
        Some(names) => {
            let indices: Result<_, Error> =
                names.iter().map(|name| table.index_of(&args.log, name)).collect();
            indices?
        }
        None => (0..table.names.len()).filter(|&index| table.names[index] != weight).collect(),
    };
    if let Some(twice) = (1..indices.len()).find(|&i| indices[..i].contains(&indices[i])) {
        let name = &table.names[indices[twice]];
        return Err(Failure::usage(format!("--inputs names `{name}` twice")));
    }
    match indices.is_empty() {
        true => Err(dataset::Error::NoInputs { path: args.log.clone() }.into()),
        false => Ok(indices),
    }
}
