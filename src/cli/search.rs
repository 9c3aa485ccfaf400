//! `lgp search`: a search, from its options to its report.

use super::output::to_stderr;
use super::plan::Plan;
use super::progress::{LiveFront, Phases};
use super::timings::Timings;
use super::truth::Sampled;
use super::{Common, Failure, argument, columns::Columns, interrupts, refusals, tiers};
use crate::emit::Language;
use crate::fit::Measure;
use crate::report::Report;
use crate::run::{FRONT_TABLE, MemberRecord, Outcome, Run, Session};
use crate::search::{CostOf, MAX_ISLANDS, SetupError};
use crate::wording::front_table;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Search for formulas that fit a dataset: a front of error against GPU cycles
///
/// Prints the front as a table, with published formulas beside it, and a function to paste. The run
/// is kept in a folder, for `lgp emit`, `lgp report` and others. Ctrl-C stops early and keeps
/// everything; a second one also cuts short what follows the search.
///
/// For example: lgp search datasets/dfg.bin --time 60s --max-cost 16
#[derive(clap::Args)]
pub struct Args {
    /// The dataset: a file from `lgp generate` or `lgp import`; or a shader (.wgsl, .glsl, .frag,
    /// .comp, .hlsl, .slang, .spv), of which a function is approximated over a --domain. Not needed
    /// with --formula, or for --resume with --out
    #[arg(required_unless_present_any = ["resume", "formula"])]
    pub(super) dataset: Option<PathBuf>,
    #[command(flatten)]
    pub(super) sampled: Sampled,
    #[command(flatten)]
    pub(super) columns: Columns,
    /// Fit only what a scene needs of the dataset: a scene beside it, or a .ron file
    #[arg(long, value_name = "S")]
    pub(super) scene: Option<String>,
    /// The grammar of formulas: a built-in one, or a .ron file [default: shader]
    #[arg(long, value_name = "G")]
    pub(super) grammar: Option<String>,
    /// The GPU to count cycles for: a built-in profile, a .ron file, or a mix such as
    /// gcn:2,turing:1 [default: gcn]
    #[arg(long, value_name = "P")]
    pub(super) gpu: Option<String>,
    /// The time for everything, writing included, as in 60s or 10m [default: until little improves,
    /// at most 60s; no limit with --generations]
    #[arg(long, value_parser = argument::duration)]
    pub(super) time: Option<Duration>,
    /// Stop after N generations; the same seed then gives the same front, on any number of threads
    #[arg(long, value_name = "N")]
    pub(super) generations: Option<u64>,
    /// The most cycles that a formula may cost [default: 40, or the largest budget of the scene's
    /// tiers]
    #[arg(long, value_name = "C", value_parser = argument::cycles, allow_hyphen_values = true)]
    pub(super) max_cost: Option<f64>,
    /// The error to minimise: rmse, max, weighted (by the dataset's weights) or relative [default:
    /// rmse, or weighted if the dataset has weights]
    #[arg(long, value_name = "MEASURE")]
    pub(super) loss: Option<Measure>,
    /// Conditions on every formula: finite, range=0..1, half=1e-2 (error in f16), rising=INPUT,
    /// falling=INPUT, ends=INPUT (exact at the ends of its domain), uses=OPERATION or uses=INPUT, a
    /// comparison as `scale + bias <= 1`, or the name of a claim that comes with the data;
    /// `bias.range=0..1` is for one output, or one hole of a template
    #[arg(long, value_name = "CONDITION", value_delimiter = ',')]
    pub(super) require: Vec<String>,
    /// Search for rcp, log2 or sqrt of an output; formulas then apply the inverse, and pay for it
    /// unless algebra removes it. The error is measured on the output itself
    #[arg(long, value_name = "OUTPUT=F", value_delimiter = ',')]
    pub(super) transform: Vec<String>,
    /// A formula in which functions are to be found, as in "y = D(x, f(roughness))*g(x)" with
    /// D defined before: each function that is called and nowhere defined, and each constant
    /// written $a
    #[arg(long, value_name = "TEMPLATE", conflicts_with = "transform")]
    pub(super) template: Option<String>,
    /// What is costed of a template: the whole formula, or only what fills its holes [default:
    /// whole]
    #[arg(long, value_name = "whole|holes", requires = "template")]
    pub(super) cost_of: Option<CostOf>,
    /// A further output, computed of the dataset's columns, as in "back = srgb": what a template's
    /// formula is measured against; can be given several times
    #[arg(long, value_name = "NAME = EXPRESSION")]
    pub(super) derive: Vec<String>,
    /// The number of populations that evolve apart; the same seed repeats a search only with the
    /// same number [default: 8]
    #[arg(long, value_name = "N")]
    #[arg(value_parser = clap::value_parser!(u16).range(1..=MAX_ISLANDS as i64))]
    pub(super) islands: Option<u16>,
    /// First try all formulas of at most C cycles [default: of 1 cycle, if they are few]
    #[arg(long, value_name = "C")]
    pub(super) exhaustive: Option<f64>,
    /// The share of candidates made at random, not from others; 1 for random restarts [default: 0]
    #[arg(long, value_name = "SHARE", value_parser = argument::share)]
    pub(super) immigrants: Option<f64>,
    /// A formula over the dataset's columns to start from, or for a template some of its holes, as
    /// in "f(x) = 2*x; $a = 0.5"; can be given several times
    #[arg(long, value_name = "FORMULA")]
    pub(super) guess: Vec<String>,
    /// Keep the samples of a function as they are; otherwise they follow the search to where its
    /// formulas err most, if the data are a formula's, a shader's or a target's
    #[arg(long)]
    pub(super) fixed_samples: bool,
    /// The folder to write the run to [default: runs/NAME, or runs/NAME-2 and so on if that is
    /// taken]
    #[arg(long, value_name = "DIR")]
    pub(super) out: Option<PathBuf>,
    /// Continue the run in the output folder from where it stopped, with the options it had; --time
    /// and --generations may be raised
    #[arg(long)]
    pub(super) resume: bool,
    /// Replace the run that is in the output folder
    #[arg(long, conflicts_with = "resume", requires = "out")]
    pub(super) force: bool,
    /// Print how many seconds each phase took, on stderr
    #[arg(long)]
    timings: bool,
}

pub fn run(args: &Args, common: &Common) -> Result<(), Failure> {
    let mut timings = Timings::new();
    let Plan { subject, session } = Plan::of(args, common)?;
    let profile = session.search().problem().profile();
    let incumbents = subject.published(&data_path(&session), profile)?;
    if let Err(reason) = subject.original(profile) {
        common.note(&format!("the original cannot be compared with: {reason}"));
    }
    timings.note("reading");
    let stop = interrupts::watch();
    let mut session = session.since(timings.start()).until_asked(&stop).compared_with(incumbents);
    session.begin().map_err(|error| match error {
        SetupError::TooMany { .. } => Failure::usage(format!("--exhaustive: {error}")),
        error => error.into(),
    })?;
    timings.note("start");
    search(&mut session, common)?;
    timings.note("search");
    let phases = Phases::new(common, &mut timings);
    let outcome = session.finish(&|phase, share| phases.hear(phase, share));
    if let Some(reason) = session.take_follow_error() {
        common.note(&reason.to_string());
    }
    let Outcome { run, front, published, .. } = &outcome;
    let table = front_table(front, published, &run.names().outputs);
    let written = session.write(&outcome, vec![(FRONT_TABLE.to_owned(), table.clone().into())]);
    // What was found is shown even if files could not be written.
    let folder = session.folder().unwrap_or(Path::new("")).to_owned();
    show(common, &outcome, table, &folder)?;
    written?;
    timings.note("files");
    let report = Report::of(&outcome, subject.dataset, published.clone());
    if !report.write(&folder, &session.time_left())?.is_whole && !common.quiet {
        let folder = folder.display();
        eprintln!("there was no time for all pictures; `lgp report {folder}` makes them");
    }
    timings.note("page and pictures");
    say_where(common, run, &folder);
    if args.timings {
        eprintln!("{timings}");
    }
    if stop.requests() > 0 {
        let seconds = run.seconds;
        let folder = folder.display();
        return Err(Failure::interrupted(format!(
            "interrupted after {seconds:.1} s; {folder} is whole, and --resume goes on with it"
        )));
    }
    if front.members.is_empty() {
        let reason = refusals::of_all(run, outcome.archived);
        return Err(Failure::unmet(reason));
    }
    tiers::check(run, front)
}

/// Returns the path of the data: from here, or in the run's folder.
fn data_path(session: &Session) -> PathBuf {
    let noted = &session.record().dataset;
    let kept = session.folder().map(|folder| folder.join(noted));
    kept.filter(|path| path.is_file()).unwrap_or_else(|| noted.clone())
}

/// Steps until the budget is spent or the user stops it.
fn search(session: &mut Session, common: &Common) -> Result<(), Failure> {
    let bar = LiveFront::new(common);
    let mut warned = String::new();
    loop {
        let step = session.step()?;
        let warning = session.take_warning().map(|error| Failure::from(error).error.to_string());
        if let Some(warning) = warning.filter(|warning| *warning != warned) {
            to_stderr(&format!(
                "warning: {warning}\nthe search goes on, but could not be resumed from here"
            ));
            warned = warning;
        }
        if let Some(reason) = session.take_follow_error() {
            common.note(&reason.to_string());
        }
        let Some(progress) = step else { break };
        bar.show(&progress);
    }
    bar.clear();
    Ok(())
}

fn show(common: &Common, outcome: &Outcome, table: String, folder: &Path) -> Result<(), Failure> {
    let Outcome { run, front, .. } = outcome;
    let names = run.names();
    let records: Vec<_> = front.members.iter().map(|m| MemberRecord::new(m, &names)).collect();
    let mut text = table + &tiers::table(run, front);
    if let Some(knee) = front.knee() {
        text += &format!(
            "\nThe knee, as HLSL (other members and languages: lgp emit {} --lang wgsl --pick N):\n\n{}",
            folder.display(),
            outcome.snippet(knee, Language::Hlsl)
        );
    }
    common.result(&records, &text)
}

fn say_where(common: &Common, run: &Run, folder: &Path) {
    common.note(&format!(
        "{} generations, {} candidates considered, {} fitted in {:.1} s; written to {}",
        run.generations,
        run.counts.considered,
        run.counts.fitted,
        run.seconds,
        folder.display()
    ));
    if let Some(enumeration) = run.enumeration {
        common.note(&format!(
            "all {} structures of at most {} cycles were tried",
            enumeration.structures, enumeration.cost
        ));
    }
}
