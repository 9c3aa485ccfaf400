use super::{Common, Exit, Failure, columns::Columns};
use crate::cost::Profile;
use crate::dataset::Dataset;
use crate::program::{Names, ParseError, Parsed, Scope, parse_template};
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
    /// What it costs: a GPU profile, built in or a .ron file, or a mix such as gcn:2,turing:1
    #[arg(long, value_name = "P", default_value = "gcn")]
    gpu: String,
}

pub fn run(args: &Args, common: &Common) -> Result<(), Failure> {
    let dataset = args.columns.of(&Dataset::load(&args.dataset)?)?;
    let profile = Profile::find(&args.gpu)?;
    let Parsed { program, names, free } = assigned_outputs(&args.formula, &dataset.names())?;
    if let Some(constant) = free.first() {
        let name = &constant.name;
        let message =
            format!("`${name}` is a free constant; give it a value, or fit it with `lgp fit`");
        return Err(Failure::new(Exit::Input, anyhow::Error::msg(message)));
    }
    let dataset = dataset.select(Some(&names.inputs), Some(&names.outputs))?;
    let member = FrontMember::new(program, &dataset, &profile, &names);
    let record = MemberRecord::new(&member, &names);
    let table =
        front_table(&Front { members: vec![member], ..Front::default() }, &[], &names.outputs);
    common.result(&record, &table)
}

/// What a text says of those outputs that it assigns.
pub(super) fn assigned_outputs(formula: &str, names: &Names) -> Result<Parsed, ParseError> {
    let over =
        |outputs: &[String]| Names { inputs: names.inputs.clone(), outputs: outputs.to_vec() };
    let parsed = |outputs: &[String]| parse_template(formula, Scope::Dataset(&over(outputs)));
    let assigned =
        names.outputs.iter().filter(|&output| parsed(std::slice::from_ref(output)).is_ok());
    let assigned: Vec<String> = assigned.cloned().collect();
    if assigned.is_empty() { parsed(&names.outputs) } else { parsed(&assigned) }
}
