//! `lgp info`: the contents of a dataset.

use super::explore::Explored;
use super::{Common, Failure};
use crate::dataset::{Column, Dataset, Split, incumbents_for};
use serde::Serialize;
use std::fmt::Write;
use std::path::PathBuf;

/// Show what a dataset holds and where it comes from
///
/// With --explore also what the rows say before a search, output by output: the share of the
/// variance that each input explains alone, and with all its interactions; which forms hold, such as
/// f(x)*g(y) or f(x*y), and how nearly; a template with the command that searches for its holes.
///
/// For example: lgp info datasets/dfg.bin --explore
#[derive(clap::Args)]
pub struct Args {
    /// The dataset: a file from `lgp generate` or `lgp import`
    dataset: PathBuf,
    /// Test which inputs matter and which separations hold
    #[arg(long)]
    explore: bool,
}

#[derive(Serialize)]
struct Info {
    name: String,
    #[serde(serialize_with = "crate::cli::output::readable")]
    path: PathBuf,
    hash: String,
    recipe: String,
    inputs: Vec<ColumnInfo>,
    outputs: Vec<ColumnInfo>,
    claims: Vec<String>,
    search: Rows,
    validation: Rows,
    incumbents: Vec<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    explored: Option<Explored>,
}

#[derive(Serialize)]
struct ColumnInfo {
    name: String,
    unit: String,
    domain: [f64; 2],
    search: Values,
    validation: Values,
}

#[derive(Serialize)]
struct Rows {
    rows: usize,
    weighted: bool,
    standard_errors: bool,
    grid: Vec<usize>,
}

/// A column in one split; the mean is weighted as the rows are.
#[derive(Serialize)]
struct Values {
    min: f32,
    max: f32,
    mean: f64,
}

pub fn run(args: &Args, common: &Common) -> Result<(), Failure> {
    let dataset = Dataset::load(&args.dataset)?;
    let incumbents = incumbents_for(&args.dataset, &dataset)?;
    let described = |columns: &[Column], first: usize| {
        let columns = columns.iter().enumerate();
        columns.map(|(index, column)| describe(&dataset, column, first + index)).collect()
    };
    let explored = args.explore.then(|| Explored::of(&dataset, &args.dataset));
    let info = Info {
        explored,
        hash: dataset.hash(),
        path: args.dataset.clone(),
        inputs: described(&dataset.inputs, 0),
        outputs: described(&dataset.outputs, dataset.inputs.len()),
        search: rows(&dataset.search),
        validation: rows(&dataset.validation),
        incumbents: incumbents.into_iter().map(|known| known.incumbent.name).collect(),
        claims: dataset.claims,
        name: dataset.name,
        recipe: dataset.origin.to_string(),
    };
    common.result(&info, &page(&info))
}

fn describe(dataset: &Dataset, column: &Column, index: usize) -> ColumnInfo {
    ColumnInfo {
        name: column.name.clone(),
        unit: column.unit.clone(),
        domain: column.domain,
        search: values(&dataset.search, index),
        validation: values(&dataset.validation, index),
    }
}

fn values(split: &Split, index: usize) -> Values {
    let column = split.columns.get(index).map_or(&[][..], Vec::as_slice);
    let mut sum = 0.0;
    let mut weights = 0.0;
    for (row, &value) in column.iter().enumerate() {
        let weight = f64::from(split.weight(row));
        sum += weight * f64::from(value);
        weights += weight;
    }
    Values {
        min: column.iter().copied().fold(f32::INFINITY, f32::min),
        max: column.iter().copied().fold(f32::NEG_INFINITY, f32::max),
        mean: sum / weights,
    }
}

fn rows(split: &Split) -> Rows {
    Rows {
        rows: split.rows(),
        weighted: !split.weights.is_empty(),
        standard_errors: !split.standard_errors.is_empty(),
        grid: split.grid.clone(),
    }
}

fn page(info: &Info) -> String {
    let mut page = format!("{}  ({})\n", info.name, info.path.display());
    let mut line = |text: String| {
        let _ = writeln!(page, "{text}");
    };
    line(format!("recipe      {}", info.recipe.replace('\n', "\n            ")));
    line(format!("hash        {}", info.hash));
    line(format!("search      {}", describe_rows(&info.search)));
    line(format!("validation  {}", describe_rows(&info.validation)));
    if !info.incumbents.is_empty() {
        line(format!("incumbents  {}", info.incumbents.join(", ")));
    }
    if !info.claims.is_empty() {
        line(format!("claims      {}", info.claims.join("\n            ")));
    }
    let all = info.inputs.iter().chain(&info.outputs);
    let width = all.map(|column| column.name.len()).max().unwrap_or(0).max("column".len()).min(60);
    line(format!(
        "\n        {:width$}  {:<8}  {:<22}  {:<22}  mean",
        "column", "unit", "domain", "search split"
    ));
    for (kind, columns) in [("input", &info.inputs), ("output", &info.outputs)] {
        for column in columns {
            line(format!("{kind:<6}  {}", row(column, width)));
        }
    }
    if let Some(explored) = &info.explored {
        line(format!("\n{}", explored.page().trim_end()));
    }
    page
}

fn row(column: &ColumnInfo, width: usize) -> String {
    let unit = if column.unit.is_empty() { "1" } else { &column.unit };
    let [low, high] = column.domain.map(short);
    let Values { min, max, mean } = &column.search;
    let [min, max] = [min, max].map(|&value| short(f64::from(value)));
    let [domain, found] = [format!("{low} … {high}"), format!("{min} … {max}")];
    let mean = short(*mean);
    format!("{:width$}  {unit:<8}  {domain:<22}  {found:<22}  {mean}", column.name)
}

/// Formats at most five significant digits, without trailing zeros.
fn short(value: f64) -> String {
    if value != 0.0 && !(1e-4..1e6).contains(&value.abs()) {
        return format!("{value:.4e}");
    }
    let before_point = value.abs().max(1.0).log10().floor() as usize + 1;
    let text = format!("{value:.*}", 5_usize.saturating_sub(before_point).max(1));
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

fn describe_rows(rows: &Rows) -> String {
    let mut text = format!("{} rows", rows.rows);
    if !rows.grid.is_empty() {
        let axes: Vec<String> = rows.grid.iter().map(ToString::to_string).collect();
        text += &format!(", grid {}", axes.join("×"));
    }
    text += if rows.weighted { ", weighted" } else { "" };
    text + if rows.standard_errors { ", with standard errors" } else { "" }
}
