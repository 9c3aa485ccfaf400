//! `lgp generate`: the dataset of a target.

use super::output::{check_writable, save};
use super::pruning::Pruning;
use super::truth::Sampled;
use super::{Common, Exit, Failure};
use crate::dataset::Dataset;
use crate::targets::{self, Recipe, targets};
use serde::Serialize;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Make the dataset of a built-in ground truth (a target), or of a function of your own
///
/// `lgp list` shows the targets, their columns, and the parameters that --set takes.
///
/// For example: lgp generate dfg -o dfg.bin --set points=32
///
/// Or of your own: lgp generate --formula "y = sqrt(1 - x*x)" --domain x=0..1 -o circle.bin
#[derive(clap::Args)]
pub struct Args {
    /// A target's name, or a recipe: a file that ends in .ron; not needed with --formula
    #[arg(required_unless_present = "formula")]
    target: Option<String>,
    #[command(flatten)]
    sampled: Sampled,
    /// The file to write [default: the name of the target or recipe, with .bin]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    #[command(flatten)]
    pruning: Pruning,
}

#[derive(Serialize)]
struct Made {
    dataset: String,
    #[serde(serialize_with = "crate::cli::output::readable")]
    path: PathBuf,
    recipe: String,
    search_rows: usize,
    validation_rows: usize,
    hash: String,
    seconds: f64,
}

pub fn run(args: &Args, common: &Common) -> Result<(), Failure> {
    let start = Instant::now();
    let (path, dataset) = match args.sampled.truth(args.target.as_deref().map(Path::new), None)? {
        Some(truth) => {
            let path =
                args.output.clone().unwrap_or_else(|| format!("{}.bin", truth.name()).into());
            check_writable(&path)?;
            (path, args.sampled.dataset(&truth, common)?)
        }
        None => integrated(args, common)?,
    };
    let dataset = save(args.pruning.applied_to(dataset), &path)?;
    let made = Made {
        search_rows: dataset.search.rows(),
        validation_rows: dataset.validation.rows(),
        hash: dataset.hash(),
        seconds: start.elapsed().as_secs_f64(),
        dataset: dataset.name,
        path,
        recipe: dataset.origin.to_string(),
    };
    common.summary(&made, &summary(&made, &dataset.origin.notes().join(", ")))
}

/// Returns the dataset of a target, and the path to write it to.
fn integrated(args: &Args, common: &Common) -> Result<(PathBuf, Dataset), Failure> {
    let target = args.target.as_deref().unwrap_or_default();
    args.sampled.refuse_all_but_set()?;
    let set = args.sampled.set.iter().map(|text| key_value(text).map_err(Failure::usage));
    let recipe = recipe(target, &set.collect::<Result<Vec<_>, _>>()?)?;
    let path = args.output.clone().unwrap_or_else(|| default_output(target, &recipe));
    check_writable(&path)?;
    let bar = common.progress("integrating");
    let dataset = targets::generate(&recipe, &|done, total| {
        bar.set_length(total as u64);
        // Reports arrive from several threads, and not in order.
        bar.set_position(bar.position().max(done as u64));
    });
    bar.finish_and_clear();
    Ok((path, dataset?))
}

fn summary(made: &Made, measured: &str) -> String {
    format!(
        "{}: {} search and {} validation rows, {measured}, in {:.1} s",
        made.path.display(),
        made.search_rows,
        made.validation_rows,
        made.seconds
    )
}

fn recipe(target: &str, set: &[(String, String)]) -> Result<Recipe, Failure> {
    let mut recipe = match recipe_file(target) {
        Some(file) => Recipe::load(file)?,
        None => Recipe::new(target).map_err(on_the_command_line)?,
    };
    for (key, value) in set {
        recipe.set(key, value).map_err(on_the_command_line)?;
    }
    Ok(recipe)
}

fn on_the_command_line(error: targets::Error) -> Failure {
    Failure::new(Exit::Usage, error)
}

fn recipe_file(target: &str) -> Option<&Path> {
    let path = Path::new(target);
    let is_target = targets().iter().any(|known| known.name == target);
    let is_file = path.extension().is_some_and(|extension| extension == "ron") || path.is_file();
    (is_file && !is_target).then_some(path)
}

fn default_output(target: &str, recipe: &Recipe) -> PathBuf {
    let stem = recipe_file(target).and_then(Path::file_stem);
    Path::new(stem.unwrap_or(recipe.target().name.as_ref())).with_extension("bin")
}

fn key_value(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((key, value)) if !key.trim().is_empty() => {
            Ok((key.trim().to_owned(), value.trim().to_owned()))
        }
        _ => Err(format!("--set {text}: write a parameter and its value, as in points=32")),
    }
}
