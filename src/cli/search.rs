use super::evolve::{evolve, time_of};
use super::finish;
use super::plan::Plan;
use super::run_folder::{self, PartialRun};
use super::timings::Timings;
use super::{
    Common, Exit, Failure, columns::Columns, duration, interrupts, refusals, report, tiers,
};
use crate::deadline::Deadline;
use crate::fit::Measure;
use crate::report::table::{Published, front_table};
use crate::search::{
    Checkpoint, Enumeration, Front, MOST_CYCLES, MOST_ISLANDS, MemberRecord, Problem, Run, Search,
    Timetable,
};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Search formulas for a dataset: a front of error against GPU cycles
///
/// Ends with the front as a table, published formulas beside it, and a function to paste.
/// Ctrl-C stops early and keeps everything; once more, what follows the search, too.
#[derive(clap::Args)]
pub struct Args {
    /// A dataset, as `lgp generate` and `lgp import` write them; --resume with --out needs none
    #[arg(required_unless_present = "resume")]
    pub(super) dataset: Option<PathBuf>,
    #[command(flatten)]
    pub(super) columns: Columns,
    /// What is needed of the dataset: a scene beside it, or a .ron file
    #[arg(long, value_name = "S")]
    pub(super) scene: Option<String>,
    /// What may be written: a built-in grammar, or a .ron file [default: shader]
    #[arg(long, value_name = "G")]
    pub(super) grammar: Option<String>,
    /// What it costs: a GPU profile, built in or a .ron file, or a mix such as gcn:2,turing:1
    /// [default: gcn]
    #[arg(long, value_name = "P")]
    pub(super) gpu: Option<String>,
    /// How long it may take until all is written, as in 60s, 10m [default: until little
    /// improves, 60s at most; unless --generations is given]
    #[arg(long, value_parser = duration::parse)]
    pub(super) time: Option<Duration>,
    /// Stop after N generations: with the same seed the same front, whatever the threads
    #[arg(long, value_name = "N")]
    pub(super) generations: Option<u64>,
    /// The most cycles that a formula may cost [default: 40, or what the scene's tiers may spend]
    #[arg(long, value_name = "C", value_parser = budget, allow_hyphen_values = true)]
    pub(super) max_cost: Option<f64>,
    /// What is made small: rmse, max, weighted (by the dataset's weights) or relative [default: rmse,
    /// or weighted where the dataset has weights]
    #[arg(long, value_name = "MEASURE")]
    pub(super) loss: Option<Measure>,
    /// What every formula must be: finite, range=0..1, half=1e-2 (its error in f16), rising=INPUT,
    /// falling=INPUT, ends=INPUT (exact where an input's domain ends), uses=OPERATION or INPUT;
    /// `bias.range=0..1` is for one output
    #[arg(long, value_name = "CONDITION", value_delimiter = ',')]
    pub(super) require: Vec<String>,
    /// Search by way of a function of an output, rcp, log2 or sqrt, the error measured on the
    /// output itself
    #[arg(long, value_name = "OUTPUT=F", value_delimiter = ',')]
    pub(super) transform: Vec<String>,
    /// Populations that evolve apart (part of what a seed repeats) [default: 8]
    #[arg(long, value_name = "N")]
    #[arg(value_parser = clap::value_parser!(u16).range(1..=MOST_ISLANDS as i64))]
    pub(super) islands: Option<u16>,
    /// Try all formulas of at most C cycles first [default: of 1 cycle, if they are few]
    #[arg(long, value_name = "C")]
    pub(super) exhaustive: Option<f64>,
    /// The share of candidates that are made at random, not from others; 1 for random restarts
    /// [default: 0]
    #[arg(long, value_name = "SHARE", value_parser = share)]
    pub(super) immigrants: Option<f64>,
    /// A formula to start from, over the dataset's columns; may be given more than once
    #[arg(long, value_name = "FORMULA")]
    pub(super) guess: Vec<String>,
    /// Where the run is written [default: runs/NAME, or runs/NAME-2 and so on if that is taken]
    #[arg(long, value_name = "DIR")]
    pub(super) out: Option<PathBuf>,
    /// Go on with the run in the output folder, where it stopped; its options need not be given again,
    /// a longer --time or more --generations may be
    #[arg(long)]
    pub(super) resume: bool,
    /// Replace the run that is in the output folder
    #[arg(long, conflicts_with = "resume", requires = "out")]
    pub(super) force: bool,
    /// Say on stderr how many seconds each phase took
    #[arg(long)]
    timings: bool,
}

fn budget(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(cost) if (0.0..=MOST_CYCLES).contains(&cost) => Ok(cost),
        _ => {
            Err(format!("a cost budget is 0 to {MOST_CYCLES} cycles; no formula costs less than 0"))
        }
    }
}

pub fn run(args: &Args, common: &Common) -> Result<(), Failure> {
    let mut timings = Timings::new();
    let start = Instant::now();
    let plan = Plan::of(args, common)?;
    let Plan { subject, mut run, grammar, profile, guesses, folder, replaces, checkpoint } = plan;
    let dataset = &subject.dataset;
    let incumbents = subject.published(&run.dataset, &profile)?;
    let problem = Problem::new(dataset, &grammar, &profile, &run.settings);
    timings.note("reading");
    let stop = interrupts::watch();
    // One that was killed before its first candidate begins once more.
    let begun = checkpoint.filter(|checkpoint| checkpoint.search.counts().considered > 0);
    let before = if begun.is_some() { run.seconds } else { 0.0 };
    let time = time_of(&run.budget).map(|time| Duration::from_secs_f64((time - before).max(0.0)));
    let rows = subject.whole.search.rows() + subject.whole.validation.rows();
    let mut times = Timetable::new(start, time, rows, &stop);
    let (mut search, mut partial) = match begun {
        Some(Checkpoint { search, trace, census, .. }) => {
            (search, PartialRun::resumed(folder, trace, census))
        }
        None => {
            let mut search = Search::new(run.settings.clone());
            let mut partial = PartialRun::new(folder, replaces);
            run = so_far(&run, &search, 0.0);
            partial.checkpoint_or_warn(&run, &search);
            enumerate(&mut search, &problem, run.exhaustive, &times.starting())?;
            search.settle_until(&guesses, &problem, &times.search());
            timings.note("start");
            (search, partial)
        }
    };
    let budget = run.budget;
    let seconds =
        evolve(&budget, common, &mut search, &problem, before, &mut times, |point, search| {
            let seconds = point.seconds;
            partial.record(point, search, &problem, || so_far(&run, search, seconds));
        });
    run = so_far(&run, &search, seconds);
    timings.note("search");
    let (front, minimax) = finish::fronts(&search, &problem, &mut times, &mut timings, common);
    let written = partial.finish(&run, &front, &minimax, &incumbents, &search);
    // Whatever became of the files, what was found is shown.
    show(common, &run, &front, &incumbents, partial.folder())?;
    written?;
    timings.note("files");
    report::write(partial.folder(), common, &times.writing())?;
    timings.note("page and pictures");
    say_where(common, &run, partial.folder());
    if args.timings {
        eprintln!("{timings}");
    }
    if stop.requests() > 0 {
        let done = format!(
            "interrupted after {seconds:.1} s; {} is whole, and --resume goes on with it",
            partial.folder().display()
        );
        return Err(Failure::new(Exit::Interrupted, anyhow::Error::msg(done)));
    }
    if front.members.is_empty() {
        let archived = search.archive().members().len();
        let reason = refusals::of_all(&run, archived);
        return Err(Failure::new(Exit::Unmet, anyhow::Error::msg(reason)));
    }
    tiers::check(&run, &front)
}

/// What a run is at some point of its search.
fn so_far(run: &Run, search: &Search, seconds: f64) -> Run {
    Run {
        generations: search.generation(),
        seconds,
        counts: search.counts(),
        enumeration: search.enumeration(),
        ..run.clone()
    }
}

/// With `--exhaustive`, so many structures at most: a few minutes.
const MOST_ENUMERATED: usize = 200_000;

fn enumerate(
    search: &mut Search,
    problem: &Problem,
    asked: Option<f64>,
    deadline: &Deadline,
) -> Result<(), Failure> {
    let (cost, most) = asked.map_or(Enumeration::USUAL, |cost| (cost, MOST_ENUMERATED));
    search.enumerate_until(problem, cost, most, deadline);
    if asked.is_some() && search.enumeration().is_none() && !deadline.is_past() {
        let message = format!(
            "--exhaustive: there are too many formulas of at most {cost} cycles to try all (more than {MOST_ENUMERATED}, or of too many inputs); ask for fewer cycles"
        );
        return Err(Failure::usage(message));
    }
    Ok(())
}

fn share(text: &str) -> Result<f64, String> {
    let share = text.parse().ok().filter(|share| (0.0..=1.0).contains(share));
    share.ok_or_else(|| "a share is from 0 to 1".into())
}

fn show(
    common: &Common,
    run: &Run,
    front: &Front,
    incumbents: &[Published],
    folder: &Path,
) -> Result<(), Failure> {
    let names = run.names();
    let records: Vec<_> = front.members.iter().map(|m| MemberRecord::new(m, &names)).collect();
    let mut text = front_table(front, incumbents, &names.outputs) + &tiers::table(run, front);
    if let Some(knee) = front.knee() {
        let snippet = run_folder::snippet(run, knee, crate::emit::Language::Hlsl);
        text += &format!(
            "\nThe knee, as HLSL (other members and languages: lgp emit {} --lang wgsl --pick N):\n\n{snippet}",
            folder.display()
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
