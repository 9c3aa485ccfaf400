//! `lgp fit`: the constants of a model.

use super::eval::assigned_outputs;
use super::{Common, Exit, Failure, columns::Columns};
use crate::cost::Profile;
use crate::dataset::{Dataset, output_units};
use crate::fit::{Measure, Parameter, fit_model};
use crate::program::{Draft, Names, Parsed, Program};
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
    constants: BTreeMap<&'a str, f32>,
    #[serde(flatten)]
    member: MemberRecord,
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
    let mut parameters: Vec<Parameter> = free
        .iter()
        .map(|constant| Parameter {
            index: constant.index.into(),
            bounds: [f32::NEG_INFINITY, f32::INFINITY],
        })
        .collect();
    for (name, bounds) in &args.bounds {
        parameters[place(name, &known, "--bounds")?].bounds = *bounds;
    }
    for (name, value) in &args.start {
        draft.consts[parameters[place(name, &known, "--start")?].index] = *value;
    }
    for parameter in &parameters {
        let [low, high] = parameter.bounds;
        let value = &mut draft.consts[parameter.index];
        *value = value.clamp(low, high);
    }
    let loss = fit_model(&mut draft, &samples, &parameters, measure, args.starts, common.seed());
    if !loss.is_finite() {
        let message = "the model is not finite on every sample from any start; give other --start values, or --bounds";
        return Err(Failure::input(message));
    }
    let constants: BTreeMap<&str, f32> = known
        .iter()
        .zip(&parameters)
        .map(|(name, parameter)| (*name, draft.consts[parameter.index]))
        .collect();
    show(measure, common, draft_member(draft, &dataset, &profile, &names)?, constants, &names)
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
    constants: BTreeMap<&str, f32>,
    names: &Names,
) -> Result<(), Failure> {
    let mut text: String =
        constants.iter().map(|(name, value)| format!("{name:>8} = {value}\n")).collect();
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

fn start(text: &str) -> Result<(String, f32), String> {
    let wanted = "give NAME=NUMBER, as in a=2.5";
    let (name, value) = text.split_once('=').ok_or(wanted)?;
    let value: f32 = value.parse().map_err(|_| wanted)?;
    let name = name.trim_start_matches('$').to_owned();
    if value.is_finite() { Ok((name, value)) } else { Err("a start must be finite".into()) }
}

fn bounds(text: &str) -> Result<(String, [f32; 2]), String> {
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
