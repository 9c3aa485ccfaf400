//! `lgp cost`: what a formula costs on GPUs.

use super::{Common, Failure};
use crate::cost::{Cost, Profile};
use crate::program::parse_open;
use crate::wording::cycles_text;
use std::collections::BTreeMap;
use std::fmt::Write;

/// Show what a formula costs on GPUs: cycles, registers, critical path
///
/// Needs no dataset: names that are never assigned are inputs.
///
/// For example: lgp cost "d = normal*half; y = d^2/(d^2 + 1)"
#[derive(clap::Args)]
pub struct Args {
    /// Statements `name = expression`, separated by `;`
    formula: String,
    /// The GPUs: built-in profiles, .ron files, or all built-in profiles
    #[arg(long, value_name = "P,…|all", value_delimiter = ',', default_value = "all")]
    gpu: Vec<String>,
    /// The formula's outputs [default: the statements that no later one reads]
    #[arg(long, value_name = "A,B", value_delimiter = ',')]
    outputs: Vec<String>,
}

pub fn run(args: &Args, common: &Common) -> Result<(), Failure> {
    let program = parse_open(&args.formula, &args.outputs)?.program;
    let mut costs = Vec::new();
    for name in &args.gpu {
        match name.as_str() {
            "all" => {
                for name in Profile::built_in() {
                    costs.push(Profile::find(name)?.cost(&program));
                }
            }
            name => costs.push(Profile::find(name)?.cost(&program)),
        }
    }
    common.result(&costs, &(table(&costs) + &breakdown(&costs)))
}

fn table(costs: &[Cost]) -> String {
    let mut text = format!(
        "{:<10} {:>7}  {:<15} {:>9} {:>14}\n",
        "GPU", "cycles", "limited by", "registers", "critical path"
    );
    for cost in costs {
        let _ = writeln!(
            text,
            "{:<10} {:>7}  {:<15} {:>9} {:>14}",
            cost.gpu,
            cycles_text(cost.cycles),
            cost.limit,
            cost.registers,
            cycles_text(cost.critical_path)
        );
    }
    text
}

/// Lists the cycles of each operation on the pipe that decides; they sum to the cycles above.
fn breakdown(costs: &[Cost]) -> String {
    let mut counts: BTreeMap<&str, u32> = BTreeMap::new();
    for cost in costs {
        for (&op, share) in &cost.ops {
            counts
                .entry(op)
                .and_modify(|count| *count = share.count.max(*count))
                .or_insert(share.count);
        }
    }
    if counts.is_empty() {
        return "\nno operations: it gives inputs or constants as they are\n".to_owned();
    }
    let mut text = format!("\n{:<10} {:>7} ", "operation", "written");
    costs.iter().for_each(|cost| text += &format!(" {:>9}", cost.gpu));
    text.push('\n');
    for (op, count) in counts {
        let _ = write!(text, "{op:<10} {count:>7} ");
        for cost in costs {
            let slots = cost.ops.get(op).and_then(|share| share.slots.get(&cost.limit));
            let _ = write!(text, " {:>9}", cycles_text(slots.copied().unwrap_or(0.0)));
        }
        text.push('\n');
    }
    text
}
