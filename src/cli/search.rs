use super::run_folder::{self, PartialRun};
use super::subject::Subject;
use super::{Common, Exit, Failure, columns::Columns, duration, report, tiers};
use crate::cost::Profile;
use crate::dataset::Dataset;
use crate::fit::Measure;
use crate::grammar::Grammar;
use crate::program::{Draft, parse};
use crate::report::table::{Published, front_table, title};
use crate::search::{
    Enumeration, Front, MemberRecord, Problem, Requirement, Run, Search, Settings, TracePoint,
    Transform,
};
use crate::suggest::did_you_mean;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Search formulas for a dataset: a front of error against GPU cycles
///
/// Ends with the front as a table, published formulas beside it, and a function to paste.
/// Ctrl-C stops early and keeps everything.
#[derive(clap::Args)]
pub struct Args {
    /// A dataset, as `lgp generate` and `lgp import` write them
    dataset: PathBuf,
    #[command(flatten)]
    columns: Columns,
    /// What is needed of the dataset: a scene beside it, or a .ron file
    #[arg(long, value_name = "S")]
    scene: Option<String>,
    /// What may be written: a built-in grammar, or a .ron file
    #[arg(long, value_name = "G", default_value = "shader")]
    grammar: String,
    /// What it costs: a GPU profile, built in or a .ron file, or a mix such as gcn:2,turing:1
    #[arg(long, value_name = "P", default_value = "gcn")]
    gpu: String,
    /// How long to search, as in 60s, 10m [default: until little
    /// improves, 60s at most; unless --generations is given]
    #[arg(long, value_parser = duration::parse)]
    time: Option<Duration>,
    /// Stop after N generations: with the same seed the same front, whatever the threads
    #[arg(long, value_name = "N")]
    generations: Option<u64>,
    /// The most cycles that a formula may cost [default: 40, or what the scene's tiers may spend]
    #[arg(long, value_name = "C", value_parser = budget, allow_hyphen_values = true)]
    max_cost: Option<f64>,
    /// What is made small: rmse, max, weighted (by the dataset's weights) or relative [default: rmse,
    /// or weighted where the dataset has weights]
    #[arg(long, value_name = "MEASURE")]
    loss: Option<Measure>,
    /// What every formula must be: finite, range=0..1, half=1e-2 (its error in f16), rising=INPUT,
    /// falling=INPUT, ends=INPUT (exact where an input's domain ends), uses=OPERATION or INPUT;
    /// `bias.range=0..1` is for one output
    #[arg(long, value_name = "CONDITION", value_delimiter = ',')]
    require: Vec<String>,
    /// Search by way of a function of an output, rcp, log2 or sqrt, the error measured on the
    /// output itself
    #[arg(long, value_name = "OUTPUT=F", value_delimiter = ',')]
    transform: Vec<String>,
    /// Populations that evolve apart (part of what a seed repeats)
    #[arg(long, value_name = "N", default_value_t = 8)]
    #[arg(value_parser = clap::value_parser!(u16).range(1..=256))]
    islands: u16,
    /// Try all formulas of at most C cycles first [default: of 1 cycle, if they are few]
    #[arg(long, value_name = "C")]
    exhaustive: Option<f64>,
    /// The share of candidates that are made at random, not from others; 1 for random restarts
    #[arg(long, value_name = "SHARE", default_value_t = 0.0, value_parser = share)]
    immigrants: f64,
    /// A formula to start from, over the dataset's columns; may be given more than once
    #[arg(long, value_name = "FORMULA")]
    guess: Vec<String>,
    /// Where the run is written [default: runs/NAME]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Go on with the run in the output folder, where it stopped
    #[arg(long)]
    resume: bool,
}

/// Without tiers that say what they may spend.
const MAX_COST: f64 = 40.0;

fn budget(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(cost) if (0.0..=1000.0).contains(&cost) => Ok(cost),
        _ => Err("a cost budget is 0 to 1000 cycles; no formula costs less than 0".into()),
    }
}

pub fn run(args: &Args, common: &Common) -> Result<(), Failure> {
    let subject = Subject::load(&args.dataset, args.scene.as_deref(), &args.columns)?;
    let dataset = &subject.dataset;
    let grammar = Grammar::find(&args.grammar)?;
    let profile = Profile::find(&args.gpu)?;
    let guesses = guesses(&args.guess, dataset)?;
    let incumbents = subject.published(&args.dataset, &profile)?;
    let folder = args.out.clone().unwrap_or_else(|| Path::new("runs").join(&dataset.name));
    let tiers_spend = subject.scene.as_ref().and_then(|scene| scene.max_cost());
    let settings = Settings {
        seed: common.seed,
        islands: args.islands.into(),
        max_cost: args.max_cost.or(tiers_spend).unwrap_or(MAX_COST),
        measure: args.loss.unwrap_or(Measure::usual(&dataset.search)),
        immigrants: args.immigrants,
        requirements: requirements(args, dataset)?,
        transforms: transforms(&args.transform, dataset)?,
        ..Settings::default()
    };
    let (mut search, mut before) = if args.resume {
        resumed(&folder, &subject, &settings, args)?
    } else {
        (Search::new(settings), 0.0)
    };
    run_folder::create(&folder)?;
    let problem = Problem::new(dataset, &grammar, &profile, search.settings());
    if !args.resume {
        let start = Instant::now();
        enumerate(&mut search, &problem, args.exhaustive)?;
        before = start.elapsed().as_secs_f64();
        search.settle(&guesses, &problem);
    }
    let mut partial = PartialRun::new(&folder, args.resume)?;
    let interrupted = watch_for_interrupts();
    let describe = |search: &Search, seconds: f64| Run {
        version: env!("CARGO_PKG_VERSION").to_owned(),
        command: std::env::args().collect(),
        dataset: args.dataset.clone(),
        dataset_hash: subject.whole.hash(),
        scene: subject.scene.clone(),
        name: dataset.name.clone(),
        inputs: dataset.inputs.clone(),
        outputs: dataset.outputs.clone(),
        grammar: args.grammar.clone(),
        gpu: args.gpu.clone(),
        settings: search.settings().clone(),
        machine: machine(),
        threads: rayon::current_num_threads(),
        generations: search.generation(),
        seconds,
        counts: search.counts(),
        enumeration: search.enumeration(),
        sources: Vec::new(),
    };
    let seconds =
        evolve(args, common, &mut search, &problem, before, &interrupted, |point, search| {
            let seconds = point.seconds;
            partial.record(point, search, &problem, || describe(search, seconds))
        })?;
    let front = Front::of(&search, &problem);
    let minimax = match front.measure {
        Measure::Max => front.clone(),
        _ => Front::in_measure(&search, &problem, Measure::Max),
    };
    let run = describe(&search, seconds);
    partial.finish(&run, &front, &minimax, &incumbents, &search, dataset)?;
    report::write(&folder, common)?;
    show(common, &run, &front, &incumbents, &folder)?;
    if interrupted.load(Ordering::Relaxed) {
        let done = format!(
            "interrupted after {seconds:.1} s; {} is whole, and --resume goes on with it",
            folder.display()
        );
        return Err(Failure::new(Exit::Interrupted, anyhow::Error::msg(done)));
    }
    tiers::check(&run, &front)
}

/// With `--exhaustive`, so many structures at most: a few minutes.
const MOST_ENUMERATED: usize = 200_000;

fn enumerate(search: &mut Search, problem: &Problem, asked: Option<f64>) -> Result<(), Failure> {
    let (cost, most) = asked.map_or(Enumeration::USUAL, |cost| (cost, MOST_ENUMERATED));
    search.enumerate(problem, cost, most);
    if asked.is_some() && search.enumeration().is_none() {
        let message = format!(
            "--exhaustive: more than {MOST_ENUMERATED} formulas cost at most {cost} cycles; ask for fewer cycles"
        );
        return Err(Failure::usage(message));
    }
    Ok(())
}

fn share(text: &str) -> Result<f64, String> {
    let share = text.parse().ok().filter(|share| (0.0..=1.0).contains(share));
    share.ok_or_else(|| "a share is from 0 to 1".into())
}

fn guesses(texts: &[String], dataset: &Dataset) -> Result<Vec<Draft>, Failure> {
    let names = dataset.names();
    texts.iter().map(|text| Ok(parse(text, &names)?.into_draft())).collect()
}

fn requirements(args: &Args, dataset: &Dataset) -> Result<Vec<Requirement>, Failure> {
    let names = dataset.names();
    let read = |text: &String| {
        Requirement::parse(text, &names)
            .map_err(|reason| Failure::usage(format!("--require {reason}")))
    };
    let requirements: Vec<Requirement> = args.require.iter().map(read).collect::<Result<_, _>>()?;
    let ends = requirements.iter().any(|one| matches!(one, Requirement::Ends { .. }));
    if ends && args.loss == Some(Measure::Relative) {
        let message = "--require ends=… goes with --loss rmse, max or weighted, not relative";
        return Err(Failure::usage(message));
    }
    Ok(requirements)
}

fn transforms(texts: &[String], dataset: &Dataset) -> Result<Vec<Option<Transform>>, Failure> {
    let outputs = dataset.names().outputs;
    let mut transforms = vec![None; outputs.len()];
    for text in texts {
        let usage = |reason: String| Failure::usage(format!("--transform {reason}"));
        let (name, function) = text
            .split_once('=')
            .ok_or_else(|| usage(format!("{text}: give OUTPUT=F, as in norm=rcp")))?;
        let place = outputs.iter().position(|output| output == name).ok_or_else(|| {
            let meant = did_you_mean(name, outputs.iter().map(String::as_str));
            usage(format!("{text}: there is no output `{name}`{meant}"))
        })?;
        transforms[place] = Some(function.parse().map_err(usage)?);
    }
    Ok(transforms)
}

/// The search of a run's folder, if it was of the same data and settings, and its seconds so far.
fn resumed(
    folder: &Path,
    subject: &Subject,
    settings: &Settings,
    args: &Args,
) -> Result<(Search, f64), Failure> {
    let run = Run::load(folder)?;
    if !run.sources.is_empty() {
        let message = format!(
            "{}: a union of runs cannot be resumed; start a search with its formulas as --guess",
            folder.display()
        );
        return Err(Failure::new(Exit::Input, anyhow::Error::msg(message)));
    }
    let search = Search::load(folder, &subject.dataset)?;
    let same = (&run.grammar, &run.gpu, search.settings()) == (&args.grammar, &args.gpu, settings);
    if !same || run.scene != subject.scene {
        let path = folder.join("run.ron");
        let message = format!(
            "{}: the run there has other settings; give the same --scene, --seed, --grammar, --gpu, --loss, --require, --transform, --max-cost and --islands, or another --out",
            path.display()
        );
        return Err(Failure::new(Exit::Input, anyhow::Error::msg(message)));
    }
    Ok((search, run.seconds))
}

fn watch_for_interrupts() -> Arc<AtomicBool> {
    let interrupted = Arc::new(AtomicBool::new(false));
    let seen = Arc::clone(&interrupted);
    // Without a handler Ctrl-C ends the process, and the last checkpoint stands.
    let _ = ctrlc::set_handler(move || {
        if seen.swap(true, Ordering::Relaxed) {
            std::process::exit(Exit::Interrupted as i32);
        }
    });
    interrupted
}

/// Runs generations until the budget is spent; gives the seconds of the whole run.
fn evolve(
    args: &Args,
    common: &Common,
    search: &mut Search,
    problem: &Problem,
    before: f64,
    interrupted: &AtomicBool,
    mut record: impl FnMut(TracePoint, &Search) -> Result<(), Failure>,
) -> Result<f64, Failure> {
    let default = args.generations.is_none().then_some(Duration::from_secs(60));
    let time = args.time.or(default);
    let mut progress_made =
        (args.time.is_none() && args.generations.is_none()).then(Improvement::default);
    let bar = live_front(common);
    let start = Instant::now();
    let seconds = || before + start.elapsed().as_secs_f64();
    loop {
        let spent = time.is_some_and(|time| seconds() >= time.as_secs_f64());
        let done = args.generations.is_some_and(|n| search.generation() >= n);
        if spent || done || interrupted.load(Ordering::Relaxed) {
            break;
        }
        search.advance(problem);
        let point = search.trace_point(problem, seconds());
        let progress = match (time, args.generations) {
            (_, Some(n)) => search.generation() as f64 / n.max(1) as f64,
            (Some(time), None) => point.seconds / time.as_secs_f64().max(1e-3),
            (None, None) => 0.0,
        };
        show_progress(&bar, &point, search.settings().measure, progress);
        let stalled = progress_made.as_mut().is_some_and(|improvement| improvement.stalled(&point));
        record(point, search)?;
        if stalled {
            break;
        }
    }
    bar.finish_and_clear();
    Ok(seconds())
}

/// When a search without a budget last became better.
#[derive(Default)]
struct Improvement {
    hypervolume: f64,
    seconds: f64,
}

impl Improvement {
    /// A hypervolume larger by this share is an improvement.
    const ENOUGH: f64 = 1e-3;

    /// Whether nothing has improved for long: ten seconds, and a third of the time.
    fn stalled(&mut self, point: &TracePoint) -> bool {
        if point.hypervolume > self.hypervolume * (1.0 + Improvement::ENOUGH) {
            *self = Improvement { hypervolume: point.hypervolume, seconds: point.seconds };
        }
        point.seconds - self.seconds > (point.seconds / 3.0).max(10.0)
    }
}

fn live_front(common: &Common) -> ProgressBar {
    if common.quiet || !std::io::stderr().is_terminal() {
        return ProgressBar::with_draw_target(None, ProgressDrawTarget::hidden());
    }
    let style = ProgressStyle::with_template("{msg}\n{wide_bar} {percent}%");
    ProgressBar::new(1000).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}

fn show_progress(bar: &ProgressBar, point: &TracePoint, measure: Measure, progress: f64) {
    if bar.is_hidden() {
        return;
    }
    let row = |label: &str, cells: Vec<String>| {
        let cells: String = cells.iter().map(|cell| format!("{cell:>9}")).collect();
        format!("{label:<7}{cells}")
    };
    let costs = crate::search::TRACE_COSTS.iter().map(|cost| format!("≤ {cost}")).collect();
    let errors = point.errors.iter().map(|error| format!("{error:.5}")).collect();
    bar.set_message(format!(
        "{:.0} s, {} candidates considered, {} fitted\n{}\n{}",
        point.seconds,
        point.counts.considered,
        point.counts.fitted,
        row("cycles", costs),
        row(title(measure), errors)
    ));
    bar.set_position((progress.min(1.0) * 1000.0) as u64);
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
    common.result(&records, &text)?;
    if !common.quiet {
        eprintln!(
            "{} generations, {} candidates considered, {} fitted in {:.1} s; written to {}",
            run.generations,
            run.counts.considered,
            run.counts.fitted,
            run.seconds,
            folder.display()
        );
        if let Some(enumeration) = run.enumeration {
            eprintln!(
                "all {} structures of at most {} cycles were tried",
                enumeration.structures, enumeration.cost
            );
        }
    }
    Ok(())
}

fn machine() -> String {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    format!(
        "{} {}, {cores} cores, {}",
        std::env::consts::ARCH,
        std::env::consts::OS,
        crate::eval::Isa::best()
    )
}
