//! `lgp generate`: the dataset of a target.

use super::output::{check_writable, save};
use super::pruning::Pruning;
use super::{Common, Exit, Failure};
use crate::targets::{self, Recipe, targets};
use serde::Serialize;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Make the dataset of a built-in ground truth (a target)
///
/// `lgp list` shows the targets, their columns, and the parameters that --set takes.
///
/// For example: lgp generate dfg -o dfg.bin --set points=32
#[derive(clap::Args)]
pub struct Args {
    /// A target's name, or a recipe: a file that ends in .ron
    target: String,
    /// The file to write [default: the name of the target or recipe, with .bin]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Set a parameter of the target, as in --set points=32; can be given several times
    #[arg(long, value_name = "K=V", value_parser = key_value)]
    set: Vec<(String, String)>,
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
    let recipe = recipe(args)?;
    let path = args.output.clone().unwrap_or_else(|| default_output(args, &recipe));
    check_writable(&path)?;
    let start = Instant::now();
    let bar = common.progress("integrating");
    let dataset = targets::generate(&recipe, &|done, total| {
        bar.set_length(total as u64);
        // Reports arrive from several threads, and not in order.
        bar.set_position(bar.position().max(done as u64));
    });
    bar.finish_and_clear();
    let dataset = save(args.pruning.applied_to(dataset?), &path)?;
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

fn summary(made: &Made, measured: &str) -> String {
    format!(
        "{}: {} search and {} validation rows, {measured}, in {:.1} s",
        made.path.display(),
        made.search_rows,
        made.validation_rows,
        made.seconds
    )
}

fn recipe(args: &Args) -> Result<Recipe, Failure> {
    let mut recipe = match recipe_file(args) {
        Some(file) => Recipe::load(file)?,
        None => Recipe::new(&args.target).map_err(on_the_command_line)?,
    };
    for (key, value) in &args.set {
        recipe.set(key, value).map_err(on_the_command_line)?;
    }
    Ok(recipe)
}

fn on_the_command_line(error: targets::Error) -> Failure {
    Failure::new(Exit::Usage, error)
}

fn recipe_file(args: &Args) -> Option<&Path> {
    let path = Path::new(&args.target);
    let is_target = targets().iter().any(|target| target.name == args.target);
    let is_file = path.extension().is_some_and(|extension| extension == "ron") || path.is_file();
    (is_file && !is_target).then_some(path)
}

fn default_output(args: &Args, recipe: &Recipe) -> PathBuf {
    let stem = recipe_file(args).and_then(Path::file_stem);
    Path::new(stem.unwrap_or(recipe.target().name.as_ref())).with_extension("bin")
}

fn key_value(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((key, value)) if !key.trim().is_empty() => {
            Ok((key.trim().to_owned(), value.trim().to_owned()))
        }
        _ => Err("write a parameter and its value, as in points=32".into()),
    }
}
