//! `lgp fit`: the constants of a model.

use super::eval::assigned_outputs;
use super::{Common, Exit, Failure, columns::Columns};
use crate::cost::Profile;
use crate::dataset::{Dataset, output_units};
use crate::eval::Samples;
use crate::fit::{
    Bound, Fitter, GlobalFit, GlobalSettings, LocalFit, Measure, Parameter, RangeError, Scale,
    fit_globally, fit_model,
};
use crate::program::{Draft, FreeConstant, Names, Parsed, Program};
use crate::run::MemberRecord;
use crate::search::{Front, FrontMember};
use crate::suggest::did_you_mean;
use crate::wording::front_table;
use serde::Serialize;
use std::collections::BTreeMap;
use std::path::PathBuf;

/// Fit the free constants, written $name, of a formula of your own
///
/// For example: lgp fit "bias = exp2(-($a*n_dot_v + $b*roughness^2))" datasets/dfg.bin
#[derive(clap::Args)]
pub struct Args {
    /// Statements `name = expression`, separated by `;`, over the dataset's columns; `$name` is a
    /// free constant
    template: String,
    /// The dataset: a file from `lgp generate` or `lgp import`
    dataset: PathBuf,
    #[command(flatten)]
    columns: Columns,
    /// The error to minimise: rmse, max, weighted (by the dataset's weights) or relative [default:
    /// rmse, or weighted if the dataset has weights]
    #[arg(long, value_name = "MEASURE")]
    loss: Option<Measure>,
    /// Starting values of constants, as in a=2.5,b=1 [default: 1]
    #[arg(long, value_name = "NAME=X", value_delimiter = ',', value_parser = start)]
    #[arg(allow_hyphen_values = true)]
    start: Vec<(String, f32)>,
    /// Bounds of constants, as in a=0..4,b=..1
    #[arg(long, value_name = "NAME=LOW..HIGH", value_delimiter = ',', value_parser = bounds)]
    #[arg(allow_hyphen_values = true)]
    bounds: Vec<(String, [f32; 2])>,
    /// Constants whose starts and searches are on a logarithmic scale, as in a,b; each needs two
    /// positive --bounds
    #[arg(long, value_name = "NAME", value_delimiter = ',')]
    log: Vec<String>,
    /// Also search the whole range between bounds, by differential evolution (without bounds: ten
    /// times the start, of either sign); done anyway if fewer than a quarter of the starts reach the
    /// best fit
    #[arg(long)]
    global: bool,
    /// The number of starting points to fit from; the best fit counts
    #[arg(long, value_name = "N", default_value_t = 24)]
    #[arg(value_parser = clap::value_parser!(u32).range(1..=100_000))]
    starts: u32,
    /// The GPU to count cycles for: a built-in profile or a .ron file
    #[arg(long, value_name = "P", default_value = "gcn")]
    gpu: String,
}

#[derive(Serialize)]
struct Fitted<'a> {
    #[serde(flatten)]
    constants: Constants<'a>,
    #[serde(flatten)]
    member: MemberRecord,
}

#[derive(Serialize)]
struct Constants<'a> {
    #[serde(rename = "constants")]
    values: BTreeMap<&'a str, f32>,
    /// Those that lie on one of their bounds.
    at_bounds: BTreeMap<&'a str, Bound>,
}

impl<'a> Constants<'a> {
    fn new(known: &[&'a str], parameters: &[Parameter], draft: &Draft) -> Constants<'a> {
        let fitted = || known.iter().copied().zip(parameters);
        let value = |parameter: &Parameter| draft.consts[parameter.index];
        let bounds = fitted().map(|(name, parameter)| (name, parameter.bound(value(parameter))));
        Constants {
            values: fitted().map(|(name, parameter)| (name, value(parameter))).collect(),
            at_bounds: bounds.filter_map(|(name, bound)| Some((name, bound?))).collect(),
        }
    }

    fn line(&self, name: &str, value: f32) -> String {
        let at_bound = match self.at_bounds.get(name) {
            Some(Bound::Lower) => " (at its lower bound)",
            Some(Bound::Upper) => " (at its upper bound)",
            None => "",
        };
        format!("{name:>8} = {value}{at_bound}\n")
    }
}

pub fn run(args: &Args, common: &Common) -> Result<(), Failure> {
    let whole = args.columns.of(&Dataset::load(&args.dataset)?)?;
    let profile = Profile::find(&args.gpu)?;
    let Parsed { program, names, free, .. } = assigned_outputs(&args.template, &whole.names())?;
    let known: Vec<&str> = free.iter().map(|constant| constant.name.as_str()).collect();
    if known.is_empty() {
        let message = "the template has no free constant; write one as $name, or use `lgp eval`";
        return Err(Failure::usage(message));
    }
    let dataset = whole.select(Some(&names.inputs), Some(&names.outputs))?;
    let measure = args.loss.unwrap_or(Measure::usual(&dataset.search));
    let units = output_units(&dataset.outputs);
    let samples = measure.all_samples(&dataset.search, dataset.inputs.len(), &units);
    let mut draft = program.into_draft();
    let parameters = parameters(args, &known, &free, &mut draft)?;
    let seed = common.seed();
    let local = fit_model(&mut draft, &samples, &parameters, measure, args.starts, seed);
    let global = match args.global || local.starts_disagree() {
        true => Some(globally(&mut draft, &samples, &parameters, measure, seed)?),
        false => None,
    };
    if !global.map_or(local.loss, |global| global.loss).is_finite() {
        let message = "the model is not finite on every sample from any start; give other --start values, or --bounds";
        return Err(Failure::input(message));
    }
    let error_of = |loss: f64| match measure {
        Measure::Max => loss,
        _ => (loss / samples.total_weight()).sqrt(),
    };
    if let Some(global) = global {
        common.note(&remark(local, global, measure, error_of));
    }
    let constants = Constants::new(&known, &parameters, &draft);
    show(measure, common, draft_member(draft, &dataset, &profile, &names)?, constants, &names)
}

/// Returns the constants to fit as the options have them, and sets their starts.
fn parameters(
    args: &Args,
    known: &[&str],
    free: &[FreeConstant],
    draft: &mut Draft,
) -> Result<Vec<Parameter>, Failure> {
    let unbounded = free.iter().map(|constant| Parameter::unbounded(constant.index.into()));
    let mut parameters: Vec<Parameter> = unbounded.collect();
    for (name, bounds) in &args.bounds {
        parameters[place(name, known, "--bounds")?].bounds = *bounds;
    }
    for (name, value) in &args.start {
        draft.consts[parameters[place(name, known, "--start")?].index] = *value;
    }
    for name in &args.log {
        parameters[place(name, known, "--log")?].scale = Scale::Logarithmic;
    }
    for (parameter, name) in parameters.iter().zip(known) {
        let value = &mut draft.consts[parameter.index];
        parameter.range(*value).map_err(|error| unusable(name, error))?;
        let [low, high] = parameter.bounds;
        *value = value.clamp(low, high);
    }
    Ok(parameters)
}

fn globally(
    draft: &mut Draft,
    samples: &Samples,
    parameters: &[Parameter],
    measure: Measure,
    seed: u64,
) -> Result<GlobalFit, Failure> {
    let settings = GlobalSettings { seed, ..GlobalSettings::default() };
    fit_globally(&mut Fitter::default(), draft, samples, parameters, measure, &settings)
        .map_err(|error| Failure::usage(format!("--bounds: {error}")))
}

/// Says why there was a global fit, and what it came to.
fn remark(
    local: LocalFit,
    global: GlobalFit,
    measure: Measure,
    error_of: impl Fn(f64) -> f64,
) -> String {
    let LocalFit { reached, starts, .. } = local;
    let why = match local.starts_disagree() {
        true => format!("{reached} of {starts} starts reached the best fit"),
        false => format!("a global fit after {starts} starts"),
    };
    let (before, after) = (error_of(local.loss), error_of(global.loss));
    let what = match global.loss < local.loss {
        true if before.is_finite() => {
            format!("a global search found a better one, {measure} {after:.3e} for {before:.3e}")
        }
        true => format!("a global search found {measure} {after:.3e}"),
        false => "a global search found none better".to_owned(),
    };
    format!("{why}; {what} ({} evaluations)", global.evaluations)
}

fn unusable(name: &str, error: RangeError) -> Failure {
    let option = match error {
        RangeError::NotPositive { .. } => "--log",
        _ => "--bounds",
    };
    Failure::usage(format!("{option}: ${name}: {error}"))
}

fn draft_member(
    draft: Draft,
    dataset: &Dataset,
    profile: &Profile,
    names: &Names,
) -> Result<FrontMember, Failure> {
    let program = Program::verify(draft).map_err(|error| Failure::new(Exit::Failed, error))?;
    Ok(FrontMember::new(program, dataset, profile, names))
}

fn show(
    measure: Measure,
    common: &Common,
    member: FrontMember,
    constants: Constants,
    names: &Names,
) -> Result<(), Failure> {
    let values = constants.values.iter();
    let mut text: String = values.map(|(name, value)| constants.line(name, *value)).collect();
    let record = MemberRecord::new(&member, names);
    text += "\n";
    text += &front_table(&Front { measure, members: vec![member] }, &[], &names.outputs);
    common.result(&Fitted { constants, member: record }, &text)
}

/// Returns the index of a free constant among the template's.
fn place(name: &str, known: &[&str], option: &str) -> Result<usize, Failure> {
    known.iter().position(|constant| *constant == name).ok_or_else(|| {
        let meant = did_you_mean(name, known.iter().copied());
        Failure::usage(format!("{option}: the template has no constant ${name}{meant}"))
    })
}

pub(super) fn start(text: &str) -> Result<(String, f32), String> {
    let wanted = "give NAME=NUMBER, as in a=2.5";
    let (name, value) = text.split_once('=').ok_or(wanted)?;
    let value: f32 = value.parse().map_err(|_| wanted)?;
    let name = name.trim_start_matches('$').to_owned();
    if value.is_finite() { Ok((name, value)) } else { Err("a start must be finite".into()) }
}

pub(super) fn bounds(text: &str) -> Result<(String, [f32; 2]), String> {
    let wanted = "give NAME=LOW..HIGH, as in a=0..4, a=..1 or a=0..";
    let (name, range) = text.split_once('=').ok_or(wanted)?;
    let (low, high) = range.split_once("..").ok_or(wanted)?;
    let end = |text: &str, open: f32| match text {
        "" => Ok(open),
        number => number.parse().ok().filter(|end: &f32| end.is_finite()).ok_or(
            "an end is a number within ±3.4e38; leave it out where there is none, as in a=0..",
        ),
    };
    let range = [end(low, f32::NEG_INFINITY)?, end(high, f32::INFINITY)?];
    if range[0] <= range[1] {
        Ok((name.trim_start_matches('$').to_owned(), range))
    } else {
        Err(format!("{text}: the lower bound is above the upper one"))
    }
}
