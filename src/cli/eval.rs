use super::{Common, Failure, columns::Columns};
use crate::cost::Profile;
use crate::dataset::Dataset;
use crate::program::{Names, ParseError, Program, parse};
use crate::report::table::front_table;
use crate::search::{Front, FrontMember, MemberRecord};
use std::path::PathBuf;

/// Score a formula of your own on a dataset: errors and GPU cycles
///
/// For example: lgp eval "bias = exp2(-(7*n_dot_v + 4*roughness^2))" datasets/dfg.bin
#[derive(clap::Args)]
pub struct Args {
    /// Statements `name = expression`, separated by `;`, over the dataset's columns
    formula: String,
    /// A dataset, as `lgp generate` and `lgp import` write them
    dataset: PathBuf,
    #[command(flatten)]
    columns: Columns,
    /// What it costs: a built-in GPU profile, or a .ron file
    #[arg(long, value_name = "P", default_value = "gcn")]
    gpu: String,
}

pub fn run(args: &Args, common: &Common) -> Result<(), Failure> {
    let dataset = args.columns.of(&Dataset::load(&args.dataset)?)?;
    let profile = Profile::find(&args.gpu)?;
    let (program, names) = assigned_outputs(&args.formula, &dataset.names())?;
    let dataset = dataset.select(Some(&names.inputs), Some(&names.outputs))?;
    let member = FrontMember::new(program, &dataset, &profile, &names);
    let record = MemberRecord::new(&member, &names);
    let table = front_table(&Front { members: vec![member] }, &[], &names.outputs);
    common.result(&record, &table)
}

/// The program of those outputs that the formula assigns.
fn assigned_outputs(formula: &str, names: &Names) -> Result<(Program, Names), ParseError> {
    let over =
        |outputs: &[String]| Names { inputs: names.inputs.clone(), outputs: outputs.to_vec() };
    let assigned = names
        .outputs
        .iter()
        .filter(|&output| parse(formula, &over(std::slice::from_ref(output))).is_ok());
    let assigned: Vec<String> = assigned.cloned().collect();
    let names = if assigned.is_empty() { names.clone() } else { over(&assigned) };
    Ok((parse(formula, &names)?, names))
}
