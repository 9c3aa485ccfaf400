//! `lgp analyze`: which variables and subexpressions recur.

use super::explore::Explored;
use super::run_folder::{self, Which};
use super::{Common, Failure};
use crate::program::{Arg, Draft, Names};
use crate::run::{Census, Recurring, Subject};
use crate::search::{Front, FrontMember};
use serde::Serialize;
use std::fmt::Write;
use std::path::PathBuf;

/// Show which variables and subexpressions recur in a run's formulas
///
/// A variable that few formulas use may not matter; a subexpression that many share may be the
/// change of variable that the data calls for. Constants are written `c`. A subexpression that
/// occurs only within a larger one, or only moves or scales another, is not listed.
///
/// `from` is the cost from which on formulas of the front depend on a variable. With --explore also
/// what the run's data say, as `lgp info DATASET --explore` does.
///
/// For example: lgp analyze runs/dfg --top 10
#[derive(clap::Args)]
pub struct Args {
    /// A run: a folder that `lgp search` or `lgp merge` wrote
    run: PathBuf,
    /// The number of subexpressions to show
    #[arg(long, value_name = "N", default_value_t = 20)]
    top: usize,
    /// Test on the run's data which inputs matter and which separations hold
    #[arg(long)]
    explore: bool,
}

#[derive(Serialize)]
struct Analysis {
    front: Part,
    /// The best formulas at each cost, sampled during the search; null if not recorded.
    run: Option<Part>,
    #[serde(skip_serializing_if = "Option::is_none")]
    explored: Option<Explored>,
}

#[derive(Serialize)]
struct Part {
    formulas: u64,
    variables: Vec<Variable>,
    subexpressions: Vec<Recurring>,
}

#[derive(Serialize)]
struct Variable {
    name: String,
    count: u64,
    share: f64,
    /// The cycles of the cheapest formula of the front that uses it.
    #[serde(skip_serializing_if = "Option::is_none")]
    cheapest: Option<f64>,
}

pub fn run(args: &Args, common: &Common) -> Result<(), Failure> {
    let (mut run, front) = run_folder::load(&args.run, Which::default())?;
    let names = run.names();
    let through = Census::load(&args.run, &run)?;
    let mut census = Census::default();
    for member in &front.members {
        census.count(&member.program, &names, run.seconds);
    }
    let explored = match args.explore {
        true => {
            let subject = Subject::of_run(&mut run, &args.run)?;
            Some(Explored::of(&subject.dataset, &run.dataset))
        }
        false => None,
    };
    let mut analysis = Analysis {
        explored,
        front: Part::of(&census, &names, args.top),
        run: through.as_ref().map(|census| Part::of(census, &names, args.top)),
    };
    for (i, variable) in analysis.front.variables.iter_mut().enumerate() {
        variable.cheapest = cheapest(&front, i);
    }
    let mut page = text(&analysis, through.as_ref());
    if let Some(explored) = &analysis.explored {
        page += &format!("\n{}", explored.page());
    }
    common.result(&analysis, &page)
}

impl Part {
    fn of(census: &Census, names: &Names, top: usize) -> Part {
        let formulas = census.formulas();
        let count = |i: usize| census.inputs().get(i).copied().unwrap_or(0);
        let variable = |(i, name): (usize, &String)| Variable {
            name: name.clone(),
            count: count(i),
            share: count(i) as f64 / formulas.max(1) as f64,
            cheapest: None,
        };
        let mut subexpressions = census.recurring();
        subexpressions.truncate(top);
        let variables = names.inputs.iter().enumerate().map(variable).collect();
        Part { formulas, variables, subexpressions }
    }
}

/// Returns the cost of the first formula that uses an input; costs rise along the front.
fn cheapest(front: &Front, input: usize) -> Option<f64> {
    let used = Arg::Input(input as u16);
    let uses = |member: &&FrontMember| {
        let Draft { instrs, outputs, .. } = &*member.program;
        instrs.iter().flat_map(|instr| instr.args()).chain(outputs).any(|&arg| arg == used)
    };
    front.members.iter().find(uses).map(|member| member.cost)
}

fn text(analysis: &Analysis, through: Option<&Census>) -> String {
    let mut text = format!("{} formulas in the front\n\n", analysis.front.formulas);
    let percent = |share: f64| format!("{:.0} %", 100.0 * share);
    let mut line = |[a, b, c, d, e]: [&str; 5]| {
        let _ = writeln!(text, "{a:>7}  {b:>7}  {c:>9}  {d:>10}  {e}");
    };
    line(["front", "run", "from", "", "variable"]);
    for (i, variable) in analysis.front.variables.iter().enumerate() {
        let run = analysis.run.as_ref().map(|run| percent(run.variables[i].share));
        let from = variable.cheapest.map(|cost| format!("{cost} cycles"));
        let (run, from) = (run.unwrap_or_default(), from.unwrap_or_default());
        line([&percent(variable.share), &run, &from, "", &variable.name]);
    }
    let unused = analysis.front.variables.iter().filter(|variable| variable.count == 0);
    let unused: Vec<&str> = unused.map(|variable| variable.name.as_str()).collect();
    if !unused.is_empty() {
        let names = unused.join(", ");
        line([&format!("\nNo formula of the front depends on {names}."), "", "", "", ""]);
    }
    line(["\n  front", "run", "since", "operations", "subexpression"]);
    for found in &analysis.front.subexpressions {
        let run = through.and_then(|census| census.find(&found.expression));
        let since = run.as_ref().map(|run| format!("{:.1} s", run.first)).unwrap_or_default();
        let run = run.map(|run| percent(run.share)).unwrap_or_default();
        let operations = found.operations.to_string();
        line([&percent(found.share), &run, &since, &operations, &found.expression]);
    }
    let Some(run) = &analysis.run else { return text };
    let _ = writeln!(
        text,
        "\nThrough the run, of {} times that a formula was the best at its cost:\n",
        run.formulas
    );
    for found in &run.subexpressions {
        let _ = writeln!(
            text,
            "{:>7}  {:>7}  {:>9}  {:>10}  {}",
            "",
            percent(found.share),
            format!("{:.1} s", found.first),
            found.operations,
            found.expression
        );
    }
    text
}
