//! `lgp eval`: errors and cost of a formula.

use super::{Common, Failure, columns::Columns};
use crate::cost::Profile;
use crate::program::{Names, ParseError, Parsed, Program, Scope, parse_template};
use crate::run::MemberRecord;
use crate::run::Subject;
use crate::search::{Front, FrontMember};
use crate::wording::front_table;
use std::path::PathBuf;

/// Score a formula of your own on a dataset: errors and GPU cycles
///
/// For example: lgp eval "bias = exp2(-(7*n_dot_v + 4*roughness^2))" datasets/dfg.bin
#[derive(clap::Args)]
pub struct Args {
    /// Statements `name = expression`, separated by `;`, over the dataset's columns
    formula: String,
    /// The dataset: a file from `lgp generate` or `lgp import`
    dataset: PathBuf,
    #[command(flatten)]
    columns: Columns,
    /// Score on what a scene needs of the dataset: a scene beside it, or a .ron file; the formula
    /// may use the columns of either
    #[arg(long, value_name = "S")]
    scene: Option<String>,
    /// The GPU to count cycles for: a built-in profile, a .ron file, or a mix such as
    /// gcn:2,turing:1
    #[arg(long, value_name = "P", default_value = "gcn")]
    gpu: String,
}

pub fn run(args: &Args, common: &Common) -> Result<(), Failure> {
    let subject =
        Subject::load(&args.dataset, args.scene.as_deref(), |data| args.columns.of(data))?;
    let profile = Profile::find(&args.gpu)?;
    let (program, names) = read(args, &subject)?;
    let dataset = subject.dataset.select(Some(&names.inputs), Some(&names.outputs))?;
    let member = FrontMember::new(program, &dataset, &profile, &names);
    let record = MemberRecord::new(&member, &names);
    let table =
        front_table(&Front { members: vec![member], ..Front::default() }, &[], &names.outputs);
    common.result(&record, &table)
}

/// Parses the formula over the subject's columns.
fn read(args: &Args, subject: &Subject) -> Result<(Program, Names), Failure> {
    let names = subject.dataset.names();
    let refusal = match assigned_outputs(&args.formula, &names) {
        Ok(parsed) => return settled(parsed),
        Err(error) => error,
    };
    let Some(scene) = &subject.scene else { return Err(refusal.into()) };
    let view = scene.over(&subject.whole)?;
    let whole = assigned_outputs(&args.formula, &subject.whole.names());
    let Some(Parsed { program, names: defined, .. }) = whole.ok().filter(|p| p.free.is_empty())
    else {
        return Err(refusal.into());
    };
    match view.program(&program, &defined.outputs, &names.outputs) {
        Some(program) if view.inputs() == names.inputs => Ok((program, names)),
        _ => Err(refusal.into()),
    }
}

/// Returns a formula that has no free constants.
pub(super) fn settled(parsed: Parsed) -> Result<(Program, Names), Failure> {
    let Parsed { program, names, free, .. } = parsed;
    match free.first() {
        None => Ok((program, names)),
        Some(constant) => {
            let name = &constant.name;
            let message =
                format!("`${name}` is a free constant; give it a value, or fit it with `lgp fit`");
            Err(Failure::input(message))
        }
    }
}

/// Parses a text as a formula for the outputs that it assigns.
pub(super) fn assigned_outputs(formula: &str, names: &Names) -> Result<Parsed, ParseError> {
    let over =
        |outputs: &[String]| Names { inputs: names.inputs.clone(), outputs: outputs.to_vec() };
    let parsed = |outputs: &[String]| parse_template(formula, Scope::Dataset(&over(outputs)));
    let assigned =
        names.outputs.iter().filter(|&output| parsed(std::slice::from_ref(output)).is_ok());
    let assigned: Vec<String> = assigned.cloned().collect();
    if assigned.is_empty() { parsed(&names.outputs) } else { parsed(&assigned) }
}
