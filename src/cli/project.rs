//! `lgp project`: the parameters of a model, point by point.

use super::explore::quoted;
use super::fit::{bounds, start};
use super::import::same_file;
use super::output::{check_writable, save, to_stderr};
use super::{Common, Exit, Failure, interrupts};
use crate::dataset::{Dataset, LARGEST_FILE};
use crate::deadline::Deadline;
use crate::file::{read_file, remove_file, replace_file};
use crate::fit::Measure;
use crate::program::format_constant;
use crate::project::{self, Place, Projection, Proposal, Settings, State, Surfaces};
use crate::report::{ProjectionReport, findings};
use serde::Serialize;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Fit the parameters of a model, written $name, for each combination of some inputs
///
/// The rows that have the same values of the --over inputs are a group, and the parameters are fitted
/// to each group. Written is a dataset whose inputs are those, and whose outputs are the parameters
/// and `residual`, the RMSE of each group; search it for formulas of the parameters. Ctrl-C keeps
/// what is done, for --resume.
///
/// For example: lgp project 'y = $p*exp2(-$q*x)' lobe.bin --over alpha,size -o params.bin
///
/// In single quotes: within double quotes a shell takes $p for a variable of its own.
#[derive(clap::Args)]
pub struct Args {
    /// Statements `name = expression`, separated by `;`, over the dataset's columns; `$name` is a
    /// parameter. Several outputs are fitted together
    template: String,
    /// The dataset: a file from `lgp generate` or `lgp import`
    dataset: PathBuf,
    /// The inputs that the parameters are to be functions of
    #[arg(long, value_name = "A,B", value_delimiter = ',', required = true)]
    over: Vec<String>,
    /// The dataset of parameters to write
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// The error to minimise: rmse, weighted (by the dataset's weights) or visible [default: rmse,
    /// or weighted if the dataset has weights]
    #[arg(long, value_name = "MEASURE")]
    loss: Option<Measure>,
    /// Starting values of parameters, as in p=2.5,q=1 [default: 1]
    #[arg(long, value_name = "NAME=X", value_delimiter = ',', value_parser = start)]
    #[arg(allow_hyphen_values = true)]
    start: Vec<(String, f32)>,
    /// Bounds of parameters, as in p=0..4,q=..1; a global fit searches all between them
    #[arg(long, value_name = "NAME=LOW..HIGH", value_delimiter = ',', value_parser = bounds)]
    #[arg(allow_hyphen_values = true)]
    bounds: Vec<(String, [f32; 2])>,
    /// Parameters to search and smooth on a logarithmic scale, as in p,q; they need two positive
    /// --bounds
    #[arg(long, value_name = "NAME", value_delimiter = ',')]
    log: Vec<String>,
    /// Penalise steps of parameters between neighbouring groups: the penalty of a step as large as
    /// a parameter's spread, as a share of the outputs' variance, as in 1e-3
    #[arg(long, value_name = "L", default_value_t = 0.0, allow_hyphen_values = true)]
    smooth: f64,
    /// Search the whole range between bounds for each group, not only for the first ones and where
    /// neighbours disagree
    #[arg(long)]
    global: bool,
    /// The folder to write pictures and a page (report.html) to [default: that of the output, with
    /// `_report` in place of the extension]
    #[arg(long, value_name = "DIR")]
    report: Option<PathBuf>,
    /// A place at which the error is drawn over the parameters, as in alpha=0.3,size=0.1; can be
    /// given several times [default: the middle, and where the residual is largest]
    #[arg(long, value_name = "A=X,B=Y", value_parser = place)]
    surface: Vec<Vec<(String, f32)>>,
    /// Go on with what an interrupted projection has left beside the output, with the same options
    #[arg(long)]
    resume: bool,
}

#[derive(Serialize)]
struct Projected {
    #[serde(serialize_with = "crate::cli::output::readable")]
    path: PathBuf,
    groups: usize,
    validation_groups: usize,
    grid: Vec<usize>,
    parameters: Vec<Range>,
    rmse: f64,
    notes: Vec<String>,
    findings: Vec<String>,
    commands: Vec<String>,
    seconds: f64,
}

/// The values of a parameter.
#[derive(Serialize)]
struct Range {
    name: String,
    least: f32,
    most: f32,
    at_lower_bound: usize,
    at_upper_bound: usize,
}

pub fn run(args: &Args, common: &Common) -> Result<(), Failure> {
    let begun = Instant::now();
    check_writable(&args.output)?;
    if same_file(&args.dataset, &args.output) {
        let output = args.output.display();
        return Err(Failure::usage(format!("{output}: the output would replace the dataset")));
    }
    let data = Dataset::load(&args.dataset)?;
    let settings = Settings {
        bounds: args.bounds.clone(),
        starts: args.start.clone(),
        logarithmic: args.log.clone(),
        measure: args.loss,
        smooth: args.smooth,
        everywhere: args.global,
        seed: common.seed(),
    };
    let projection = Projection::new(&data, &args.template, &args.over, settings)?;
    let folder = args.report.clone().unwrap_or_else(|| folder_beside(&args.output));
    check_folder(&folder)?;
    check_places(args)?;
    let surfaces = fitted(args, common, &projection)?;
    for note in &surfaces.notes {
        common.note(&format!("note: {note}"));
    }
    let dataset = save(surfaces.dataset(&projection)?, &args.output)?;
    let part = part_of(&args.output);
    remove_file(&part).map_err(|error| Failure::unwritable(&part, error))?;
    let dependences = projection.dependences(&surfaces);
    let next = projection.proposal(&surfaces, &dependences);
    let commands = commands(args, &projection, &data, &next);
    let report = ProjectionReport {
        projection: &projection,
        surfaces: &surfaces,
        dependences: &dependences,
        places: places(args, &surfaces)?,
        commands,
    };
    std::fs::create_dir_all(&folder).map_err(|error| Failure::unwritable(&folder, error))?;
    report.write(&folder)?;
    let projected = Projected::of(args, &report, &dataset, begun.elapsed());
    common.summary(&projected, &projected.text(&folder))
}

/// Refuses places that are not of the inputs, before anything is computed.
fn check_places(args: &Args) -> Result<(), Failure> {
    for (name, _) in args.surface.iter().flatten() {
        if !args.over.contains(name) {
            let over = args.over.join(", ");
            return Err(project::Error::UnknownPlace { name: name.clone(), over }.into());
        }
    }
    Ok(())
}

/// Refuses a folder of the report that could not be one, before anything is computed.
fn check_folder(folder: &Path) -> Result<(), Failure> {
    match folder.exists() && !folder.is_dir() {
        true => Err(Failure::unwritable(folder, ErrorKind::AlreadyExists.into())),
        false => Ok(()),
    }
}

/// Returns the places at which errors are drawn.
fn places<'a>(args: &Args, surfaces: &'a Surfaces) -> Result<Vec<&'a Place>, Failure> {
    if args.surface.is_empty() {
        return Ok(vec![surfaces.nearest(&[])?, surfaces.worst()]);
    }
    Ok(args.surface.iter().map(|asked| surfaces.nearest(asked)).collect::<Result<_, _>>()?)
}

/// Returns the folder of the report, beside the output.
fn folder_beside(output: &Path) -> PathBuf {
    let stem = output.file_stem().unwrap_or_default().to_string_lossy();
    output.with_file_name(format!("{stem}_report"))
}

/// Returns the command lines to go on with: a search for each parameter, and one for all together
/// in the model, from a rough guess of each. In single quotes: a shell leaves `$` alone there.
fn commands(args: &Args, projection: &Projection, data: &Dataset, next: &Proposal) -> Vec<String> {
    let model = projection.model();
    let path = quoted(&args.output.display().to_string());
    let each = model.labels().iter().zip(&next.arguments).filter(|(_, inputs)| !inputs.is_empty());
    let each = each.map(|(label, inputs)| match inputs.len() < args.over.len() {
        true => format!("lgp search {path} --outputs {label} --inputs {}", inputs.join(",")),
        false => format!("lgp search {path} --outputs {label}"),
    });
    let whole = next.template.as_ref().map(|template| {
        let outputs = match model.outputs() == data.names().outputs {
            true => String::new(),
            false => format!(" --outputs {}", model.outputs().join(",")),
        };
        let data = quoted(&args.dataset.display().to_string());
        let (template, guess) = (quoted(template), quoted(&next.guess));
        format!("lgp search {data}{outputs} --template {template} --guess {guess}")
    });
    each.chain(whole).collect()
}

/// Returns four digits of a value; zero if it is less than counts as nothing.
fn shown(value: f32, nothing: f32) -> String {
    let value = if value.abs() < nothing { 0.0 } else { value };
    format_constant(format!("{value:.3e}").parse().unwrap_or(value))
}

fn place(text: &str) -> Result<Vec<(String, f32)>, String> {
    text.split(',').map(start).collect()
}

/// Fits all groups, from where an interrupted projection stopped.
fn fitted(args: &Args, common: &Common, projection: &Projection) -> Result<Surfaces, Failure> {
    let part = part_of(&args.output);
    let mut state = begin(args, common, projection, &part)?;
    let stop = interrupts::watch();
    let deadline = Deadline::NEVER.or_request(&stop);
    let bar = common.progress("fitting");
    bar.set_length(STEPS);
    let mut saved = Instant::now();
    let mut refusal = None;
    let mut share = 0.0;
    let is_done = projection.advance(&mut state, &deadline, &mut |state, now| {
        share = now;
        bar.set_position((share * STEPS as f64) as u64);
        if saved.elapsed() >= SAVE_EVERY && refusal.is_none() {
            refusal = replace_file(&part, &projection.save(state)).err();
            saved = Instant::now();
        }
    });
    bar.finish_and_clear();
    if let Some(error) = refusal {
        to_stderr(&format!("warning: {}: cannot be written: {error}", part.display()));
    }
    if is_done {
        return Ok(projection.surfaces(&state)?);
    }
    replace_file(&part, &projection.save(&state))
        .map_err(|error| Failure::unwritable(&part, error))?;
    Err(Failure::interrupted(format!(
        "interrupted after {:.0} % of the work; {} keeps it, and --resume goes on with it",
        100.0 * share,
        part.display()
    )))
}

const STEPS: u64 = 1000;

/// By hand: what a killed process loses.
const SAVE_EVERY: Duration = Duration::from_secs(5);

fn begin(
    args: &Args,
    common: &Common,
    projection: &Projection,
    part: &Path,
) -> Result<State, Failure> {
    let shown = part.display();
    match (read_file(part, LARGEST_FILE), args.resume) {
        (Ok(bytes), true) => projection.resume(&bytes).map_err(|error| {
            Failure::new(Exit::Input, anyhow::anyhow!("{shown}: cannot be gone on with: {error}"))
        }),
        (Err(error), true) if error.kind() == ErrorKind::NotFound => {
            common.note(&format!("{shown}: there is none; beginning anew"));
            Ok(projection.begin())
        }
        (Err(error), _) if error.kind() != ErrorKind::NotFound => {
            Err(Failure::input(format!("{shown}: cannot be read: {error}; remove it")))
        }
        (Ok(_), false) => Err(Failure::usage(format!(
            "{shown} is what an interrupted projection left: --resume goes on with it; or remove it"
        ))),
        (Err(_), _) => Ok(projection.begin()),
    }
}

/// Returns the file of what is done so far.
fn part_of(output: &Path) -> PathBuf {
    let mut name = output.as_os_str().to_owned();
    name.push(".part");
    name.into()
}

impl Projected {
    fn of(args: &Args, report: &ProjectionReport, dataset: &Dataset, time: Duration) -> Projected {
        let ProjectionReport { projection, surfaces, dependences, .. } = *report;
        let parameter = |(place, name): (usize, &String)| {
            let values = surfaces.search.iter().map(|found| found.values[place]);
            let [at_lower_bound, at_upper_bound] =
                surfaces.on_bounds(projection, place).map(|places| places.len());
            Range {
                name: name.clone(),
                least: values.clone().fold(f32::INFINITY, f32::min),
                most: values.fold(f32::NEG_INFINITY, f32::max),
                at_lower_bound,
                at_upper_bound,
            }
        };
        Projected {
            path: args.output.clone(),
            groups: surfaces.search.len(),
            validation_groups: dataset.validation.rows(),
            parameters: surfaces.labels.iter().enumerate().map(parameter).collect(),
            rmse: surfaces.rmse(),
            findings: findings(projection, surfaces, dependences),
            commands: report.commands.clone(),
            grid: surfaces.grid.clone(),
            notes: surfaces.notes.clone(),
            seconds: time.as_secs_f64(),
        }
    }

    fn text(&self, folder: &Path) -> String {
        let Projected { path, groups, validation_groups, rmse, seconds, .. } = self;
        let path = path.display();
        let mut text = format!(
            "{path}: {groups} groups ({validation_groups} validate), RMSE {rmse:.3e} over all, in {seconds:.1} s\n"
        );
        for Range { name, least, most, .. } in &self.parameters {
            let nothing = 1e-4 * least.abs().max(most.abs());
            let [least, most] = [least, most].map(|&end| shown(end, nothing));
            text += &format!("{name:>8}: {least} to {most}\n");
        }
        for finding in &self.findings {
            text += &format!("{finding}\n");
        }
        text += &format!("\nPictures and a page: {}\nTo go on:\n", folder.display());
        for command in &self.commands {
            text += &format!("  {command}\n");
        }
        text
    }
}
