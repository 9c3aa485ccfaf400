//! The command line: one file a subcommand, each with its `Args` and a `run`.

mod against;
mod analyze;
mod argument;
mod check;
mod columns;
mod cost;
mod emit;
mod eval;
mod explore;
mod export;
mod failure;
mod fit;
mod front;
mod generate;
mod import;
mod info;
mod interrupts;
mod inventory;
mod list;
mod merge;
mod output;
mod plan;
mod progress;
mod project;
mod pruning;
mod refusals;
mod render;
mod report;
mod resume;
mod run_folder;
mod scene;
mod search;
mod specialize;
mod texture;
mod tiers;
mod timings;
mod truth;
mod verify;

pub use failure::{Exit, Failure};
pub use output::Common;

use clap::{CommandFactory, Parser, Subcommand};
use std::ffi::OsString;
use std::process::ExitCode;

const ABOUT: &str = "\
Finds cheap closed-form shader formulas for a shader, a formula, or a table.

A dataset holds samples of a function: import your own table or texture, or
generate one of the built-in ground truths. Formulas are judged on two axes:
their error, and the GPU cycles they cost.";

const EXAMPLES: &str = "\
To begin:
  lgp search slow.wgsl --domain x=0..1
                                approximate the function of a shader, or
  lgp search --formula \"y = acos(x)\" --domain x=0..1
                                a formula; or from a dataset:
  lgp list                      show targets, datasets, grammars, GPU profiles
  lgp generate dfg -o dfg.bin   make the dataset of a ground truth, or
  lgp import mine.csv -o mine.bin --inputs 2
                                of your own table: two inputs, the rest outputs
  lgp info dfg.bin              show what a dataset holds
  lgp search dfg.bin            search for a minute at most: a front of error
                                against GPU cycles, and a formula to paste
  lgp emit runs/dfg --lang wgsl --max-cost 16
                                print the most accurate one that you can afford
  lgp report runs/dfg           make a page of it: where formulas err, code
  lgp eval \"scale = 1 - roughness\" dfg.bin --outputs scale
                                score a formula of your own on the same axes
  lgp cost \"y = exp2(-a*b)\"     show what a formula costs on each GPU
  lgp check runs/dfg            prove each formula finite and in range, or find
                                the input that refutes it
  lgp verify dfg.wgsl dfg.bin --max-error 0.01
                                check a shader file against the data, in your CI

`lgp search --help` explains a command, `lgp search -h` in short; so do all others.

Exit codes: 0 done, 1 failed, 2 usage, 3 unusable input, 4 a target asked for
was not met, 130 interrupted.";

#[derive(Parser)]
#[command(name = "lgp", version, about = ABOUT, after_help = EXAMPLES)]
#[command(subcommand_required = true, arg_required_else_help = true)]
struct Cli {
    #[command(subcommand)]
    command: Command,
    #[command(flatten)]
    common: Common,
}

#[derive(Subcommand)]
enum Command {
    Search(Box<search::Args>),
    Front(front::Args),
    Emit(emit::Args),
    Eval(eval::Args),
    Cost(cost::Args),
    Check(check::Args),
    Verify(verify::Args),
    Report(report::Args),
    Render(render::Args),
    Analyze(analyze::Args),
    Merge(merge::Args),
    Fit(fit::Args),
    Project(Box<project::Args>),
    Scene(scene::Args),
    Specialize(specialize::Args),
    Generate(generate::Args),
    Import(import::Args),
    Export(export::Args),
    Info(info::Args),
    List(list::Args),
}

impl Command {
    fn run(&self, common: &Common) -> Result<(), Failure> {
        match self {
            Command::Search(args) => search::run(args, common),
            Command::Front(args) => front::run(args, common),
            Command::Emit(args) => emit::run(args, common),
            Command::Eval(args) => eval::run(args, common),
            Command::Cost(args) => cost::run(args, common),
            Command::Check(args) => check::run(args, common),
            Command::Verify(args) => verify::run(args, common),
            Command::Report(args) => report::run(args, common),
            Command::Render(args) => render::run(args, common),
            Command::Analyze(args) => analyze::run(args, common),
            Command::Merge(args) => merge::run(args, common),
            Command::Fit(args) => fit::run(args, common),
            Command::Project(args) => project::run(args, common),
            Command::Scene(args) => scene::run(args, common),
            Command::Specialize(args) => specialize::run(args, common),
            Command::Generate(args) => generate::run(args, common),
            Command::Import(args) => import::run(args, common),
            Command::Export(args) => export::run(args, common),
            Command::Info(args) => info::run(args, common),
            Command::List(args) => list::run(args, common),
        }
    }
}

/// Runs the command that the process was started with.
pub fn run() -> ExitCode {
    run_words(std::env::args_os())
}

/// Runs the command of these words, the first of which is the program's name.
pub fn run_words(words: impl IntoIterator<Item = OsString>) -> ExitCode {
    let cli = match Cli::try_parse_from(words) {
        Ok(cli) => cli,
        Err(usage) => {
            // Help for a reader that has gone away is no failure.
            let _ = usage.print();
            return ExitCode::from(usage.exit_code() as u8);
        }
    };
    let done = cli.common.start().and_then(|()| cli.command.run(&cli.common));
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            failure.report();
            failure.exit.into()
        }
    }
}

/// The command line as data: its subcommands, options and help.
pub fn command() -> clap::Command {
    Cli::command()
}
