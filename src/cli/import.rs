//! `lgp import`: a dataset from a table, a texture or an array.

use super::output::{check_writable, save};
use super::pruning::Pruning;
use super::texture::{Read, Texture};
use super::{Common, Exit, Failure};
use crate::dataset::Column;
use crate::import::table::{Decimal, InputColumns, Options, Separator, Understood, parse, read};
use serde::Serialize;
use std::path::{Path, PathBuf};

/// Make a dataset from a table of numbers, a texture or an array
///
/// Of a table, separators, decimal commas, titles, names, units and comments are found, and what
/// was understood is printed; options overrule it. Without --inputs and --outputs the last column is
/// the output. A column called `weight` weighs the rows. A column `y_se`, where `y` is an output,
/// holds the standard errors of `y`: no formula wins by a smaller difference. Columns of text are
/// left out. One row in four is kept for validation.
///
/// Of a texture (PNG, EXR, HDR, DDS, KTX2), a lookup table (.cube, .spi1d, .spi3d), an array (.npy, .npz,
/// raw numbers, or one in a source file), each texel is a row: its place on the axes are the inputs,
/// its channels the outputs.
///
/// For example: lgp import mine.csv -o mine.bin --inputs 2
///
/// Or: lgp import lut.exr -o lut.bin --axes n_dot_v,roughness --channels scale,bias
#[derive(clap::Args)]
pub struct Args {
    /// The table, as .csv, .tsv, .txt or .dat, texture or array; - reads a table from standard input
    table: PathBuf,
    /// The dataset to write
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// The inputs: N for the first N columns, or names as in a,b; all other columns are outputs
    /// [default: all but the outputs]
    #[arg(long, value_name = "N|NAMES", value_parser = input_columns)]
    inputs: Option<InputColumns>,
    /// The outputs [default: all but --inputs, or the last column]
    #[arg(long, value_name = "A,B", value_delimiter = ',')]
    outputs: Option<Vec<String>>,
    #[command(flatten)]
    written: Written,
    #[command(flatten)]
    columns: Adjusted,
    /// A claim that formulas should meet, as in "sum: a + b <= 1"; can be given several times
    #[arg(long, value_name = "CLAIM")]
    claim: Vec<String>,
    #[command(flatten)]
    pruning: Pruning,
    #[command(flatten)]
    texture: Texture,
}

/// How the table is written, where that is not found.
#[derive(clap::Args)]
#[command(next_help_heading = "How the table is written (default: found)")]
struct Written {
    /// What stands between columns: a character, or comma, semicolon, tab, bar, blanks
    #[arg(long, value_name = "CHARACTER", value_parser = Separator::parse)]
    separator: Option<Separator>,
    /// The sign before decimals, point or comma; the other one then groups digits
    #[arg(long, value_name = "SIGN", value_parser = decimal)]
    decimal: Option<Decimal>,
    /// The number of lines before the table; the names are in the next one
    #[arg(long, value_name = "N")]
    skip: Option<usize>,
    /// The most rows to read
    #[arg(long, value_name = "N")]
    #[arg(value_parser = clap::value_parser!(u64).range(1..))]
    rows: Option<u64>,
    /// No line holds names: columns are called x0, x1, …, y
    #[arg(long)]
    no_header: bool,
}

/// What is made of the columns.
#[derive(clap::Args)]
#[command(next_help_heading = "Columns")]
struct Adjusted {
    /// Names for all columns of the file, in its order
    #[arg(long, value_name = "A,B", value_delimiter = ',')]
    columns: Option<Vec<String>>,
    /// Leave out these columns
    #[arg(long, value_name = "A,B", value_delimiter = ',')]
    drop: Vec<String>,
    /// The column that weighs the rows [default: weight, if there is one]
    #[arg(long, value_name = "COLUMN")]
    weights: Option<String>,
    /// Domains of inputs, as in x=0..1,a=1e-3..1 [default: the range of their values]
    #[arg(long, value_name = "NAME=LOW..HIGH", value_delimiter = ',', value_parser = domain)]
    #[arg(allow_hyphen_values = true)]
    domain: Vec<(String, [f64; 2])>,
    /// Multiply columns by powers of ten, as in flux=1e20; their names then say so
    #[arg(long, value_name = "NAME=1eN", value_delimiter = ',', value_parser = scale)]
    scale: Vec<(String, i32)>,
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
    understood: Understanding,
}

/// What was understood of the file.
#[derive(Serialize)]
#[serde(untagged)]
enum Understanding {
    Table(Understood),
    Array(Vec<String>),
}

impl Understanding {
    fn sentences(&self) -> Vec<String> {
        match self {
            Understanding::Table(understood) => understood.sentences(),
            Understanding::Array(said) => said.clone(),
        }
    }
}

pub fn run(args: &Args, common: &Common) -> Result<(), Failure> {
    let is_table = args.inputs.is_some() || args.outputs.is_some();
    let (mut dataset, understood) = match args.texture.read(&args.table, is_table)? {
        Some(Read::Dataset(dataset, said)) => (*dataset, Understanding::Array(said)),
        Some(Read::Table(text)) => {
            let (dataset, said) = parse(&args.table, text.into_bytes(), &args.options())?;
            (dataset, Understanding::Table(said))
        }
        None if args.table.extension().is_some_and(|extension| extension == "bin") => {
            let path = args.table.display();
            return Err(Failure::input(format!(
                "{path}: not read as a table: by its name it is a dataset, which `lgp info` shows; give --size if it holds raw numbers, or rename it to .txt if it is a table"
            )));
        }
        None => {
            let (dataset, said) = read(&args.table, &args.options())?;
            (dataset, Understanding::Table(said))
        }
    };
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
        understood,
    };
    common.summary(&imported, &summary(&imported))
}

impl Args {
    fn options(&self) -> Options {
        let Args { written, columns, .. } = self;
        Options {
            separator: written.separator,
            decimal: written.decimal,
            skip: written.skip,
            rows: written.rows.map(|rows| usize::try_from(rows).unwrap_or(usize::MAX)),
            no_header: written.no_header,
            columns: columns.columns.clone(),
            drop: columns.drop.clone(),
            inputs: self.inputs.clone(),
            outputs: self.outputs.clone(),
            weights: columns.weights.clone(),
            domains: columns.domain.clone(),
            scales: columns.scale.clone(),
        }
    }
}

fn summary(imported: &Imported) -> String {
    let first = format!(
        "{}: {} → {}, {} search and {} validation rows{}",
        imported.path.display(),
        imported.inputs.join(", "),
        imported.outputs.join(", "),
        imported.search_rows,
        imported.validation_rows,
        if imported.standard_errors { ", with standard errors" } else { "" }
    );
    [vec![first], imported.understood.sentences()].concat().join("\n  ")
}

pub(super) fn same_file(a: &Path, b: &Path) -> bool {
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

fn decimal(text: &str) -> Result<Decimal, String> {
    match text {
        "." | "point" => Ok(Decimal::Point),
        "," | "comma" => Ok(Decimal::Comma),
        _ => Err("write point or comma".into()),
    }
}

fn domain(text: &str) -> Result<(String, [f64; 2]), String> {
    let wanted = "write NAME=LOW..HIGH, as in x=0..1";
    let (name, range) = text.split_once('=').ok_or(wanted)?;
    let (low, high) = range.split_once("..").ok_or(wanted)?;
    let end = |text: &str| text.trim().parse().ok().filter(|end: &f64| end.is_finite());
    let [low, high] = [end(low).ok_or(wanted)?, end(high).ok_or(wanted)?];
    match low <= high {
        true => Ok((name.trim().to_owned(), [low, high])),
        false => Err(format!("{text}: the lower end is above the upper one")),
    }
}

fn scale(text: &str) -> Result<(String, i32), String> {
    let parsed = text.split_once('=').and_then(|(name, factor)| {
        let power: i32 = factor.trim().strip_prefix("1e")?.parse().ok()?;
        (power.unsigned_abs() <= 400).then(|| (name.trim().to_owned(), power))
    });
    parsed.ok_or_else(|| "write NAME=1eN, as in flux=1e20 or mass=1e-30".into())
}
