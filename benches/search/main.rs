//! A search benchmark: datasets × seeds × budgets, medians and spread of the error at each cost.
//!
//! `cargo run --release --example search -- --data bias,acos --budgets 6s,20s --seeds 1,2,3,4,5`
//!
//! Runs are added to `results/search/DATA/BUDGET.json`, so that a long benchmark can be made piece
//! by piece; the tables, the pictures and `results/search/README.md` are made again from all that
//! is there. One run serves all budgets: its clock stands while the front of a smaller one is
//! polished.

mod functions;
mod peers;
mod record;
mod summary;

use clap::Parser;
use cpu_time::ProcessTime;
use functions::FUNCTIONS;
use lgp::cost::Profile;
use lgp::dataset::{Dataset, Incumbent, incumbents_for};
use lgp::fit::Measure;
use lgp::grammar::Grammar;
use lgp::run::Session;
use lgp::search::{Front, FrontMember, Goal, Method, Problem, ScoredIncumbent, Search};
use record::{Budget, Member, Run, Runs, TRACED, TracePoint};
use std::error::Error;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Each traced moment is this many times later than the one before.
const TRACE_RATIO: f64 = 1.2;

/// Of the time that a search's threads have on a quiet machine, the part in which they are not waiting
/// for each other.
const BUSY: f64 = 0.9;

/// Seconds of wall time, or such as a quiet machine would take for the CPU time spent.
fn seconds(args: &Args, work: impl FnOnce()) -> f64 {
    let (start, spent) = (Instant::now(), ProcessTime::now());
    work();
    match args.cpu {
        true => spent.elapsed().as_secs_f64() / (args.threads as f64 * BUSY),
        false => start.elapsed().as_secs_f64(),
    }
}

#[derive(Parser)]
struct Args {
    /// Which datasets [default: all]: dfg, bias, scale, and the bench's own functions
    #[arg(long, value_delimiter = ',')]
    data: Vec<String>,
    #[arg(long, value_delimiter = ',', default_value = "1,2,3,4,5")]
    seeds: Vec<u64>,
    /// As in 60s, or 200g for generations
    #[arg(long, value_delimiter = ',', default_value = "6s,20s,60s")]
    budgets: Vec<Budget>,
    #[arg(long, default_value_t = 2)]
    threads: usize,
    /// Budgets in CPU time, so that other work on the machine changes nothing: what all threads spend,
    /// over what they would spend in a second of a quiet machine
    #[arg(long)]
    cpu: bool,
    #[arg(long, default_value_t = Goal::default().max_cost)]
    max_cost: f64,
    #[arg(long, default_value = "shader")]
    grammar: String,
    #[arg(long, default_value = "results/search")]
    out: PathBuf,
    /// What the search makes small: rmse or max
    #[arg(long, default_value = "rmse")]
    loss: Measure,
    /// The front polished for the maximum error, too
    #[arg(long)]
    minimax: bool,
    /// Search nothing: only make the tables and pictures of what is there
    #[arg(long)]
    tables: bool,
    /// Search nothing: write the datasets to this folder, their search splits as CSV, too
    #[arg(long, value_name = "DIR")]
    export: Option<PathBuf>,
}

/// A dataset, and what was published for it.
pub struct Case {
    pub name: String,
    pub definition: String,
    pub dataset: Dataset,
    pub published: Vec<ScoredIncumbent>,
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut args = Args::parse();
    rayon::ThreadPoolBuilder::new().num_threads(args.threads).build_global()?;
    let profile = Profile::find("gcn")?;
    let cases = cases(&profile)?;
    if let Some(unknown) = args.data.iter().find(|name| cases.iter().all(|c| c.name != **name)) {
        let known: Vec<&str> = cases.iter().map(|case| case.name.as_str()).collect();
        return Err(format!("no dataset `{unknown}`; there are {}", known.join(", ")).into());
    }
    if let Some(folder) = &args.export {
        std::fs::create_dir_all(folder)?;
        for case in &cases {
            case.dataset.save(&folder.join(format!("{}.bin", case.name)))?;
            std::fs::write(folder.join(format!("{}.csv", case.name)), csv(&case.dataset))?;
        }
        return Ok(());
    }
    if ![Measure::Rmse, Measure::Max].contains(&args.loss) {
        return Err("--loss is rmse or max".into());
    }
    args.budgets.sort_by(|a, b| a.partial_cmp(b).expect("budgets are ordered"));
    let wanted = |case: &&Case| args.data.is_empty() || args.data.contains(&case.name);
    for case in cases.iter().filter(wanted).filter(|_| !args.tables) {
        for &seed in &args.seeds {
            measure(&args, case, &profile, seed)?;
        }
    }
    std::fs::create_dir_all(&args.out)?;
    summary::write(&args.out, &cases)?;
    peers::draw(&args.out.join("peers"))
}

/// The search split, a column for each input and output.
fn csv(dataset: &Dataset) -> String {
    let names = dataset.names();
    let mut text = [names.inputs, names.outputs].concat().join(",") + "\n";
    for row in 0..dataset.search.rows() {
        let cells: Vec<String> =
            dataset.search.columns.iter().map(|column| column[row].to_string()).collect();
        text += &(cells.join(",") + "\n");
    }
    text
}

/// All datasets: those of `datasets/dfg.bin`, and the bench's own.
fn cases(profile: &Profile) -> Result<Vec<Case>, Box<dyn Error>> {
    let path = Path::new("datasets/dfg.bin");
    let dfg = Dataset::load(path)?;
    let mut cases = Vec::new();
    for (name, outputs) in
        [("dfg", &["scale", "bias"][..]), ("bias", &["bias"]), ("scale", &["scale"])]
    {
        let outputs: Vec<String> = outputs.iter().map(|&output| output.to_owned()).collect();
        let dataset = dfg.select(None, Some(&outputs))?;
        let published = incumbents_for(path, &dataset)?
            .into_iter()
            .filter(|known| known.outputs == outputs)
            .map(|known| published(known.incumbent.name, known.program, &dataset, profile));
        cases.push(Case {
            name: name.into(),
            definition: format!(
                "{} of the split-integral DFG, datasets/dfg.bin",
                outputs.join(" and ")
            ),
            published: published.collect(),
            dataset,
        });
    }
    for function in FUNCTIONS {
        let dataset = function.dataset();
        let mut known = Vec::new();
        for &(name, source, formula) in function.published {
            let incumbent = Incumbent {
                name: name.into(),
                source: source.into(),
                formula: formula.into(),
                cost: None,
                note: String::new(),
            };
            let comparable = incumbent.compared_on(&dataset);
            let comparable =
                comparable.ok_or_else(|| format!("{name}: not over {}", function.name))?;
            known.push(published(name.into(), comparable.program, &dataset, profile));
        }
        cases.push(Case {
            name: function.name.into(),
            definition: function.definition.into(),
            dataset,
            published: known,
        });
    }
    Ok(cases)
}

fn published(
    name: String,
    program: lgp::program::Program,
    dataset: &Dataset,
    profile: &Profile,
) -> ScoredIncumbent {
    ScoredIncumbent { name, member: FrontMember::new(program, dataset, profile, &dataset.names()) }
}

/// One search, its front noted at each budget.
fn measure(args: &Args, case: &Case, profile: &Profile, seed: u64) -> Result<(), Box<dyn Error>> {
    let problem = Problem::of(case.dataset.clone())
        .grammar(Grammar::find(&args.grammar)?)
        .profile(profile.clone())
        .measure(args.loss)
        .max_cost(args.max_cost)
        .build()?;
    // The benchmark's clock decides, not the session's.
    let endless = lgp::run::Budget { generations: Some(u64::MAX), ..Default::default() };
    let method = Method { seed, ..Method::default() };
    let mut session = Session::new(problem, method)?.budget(endless);
    let mut clock = 0.0;
    let mut trace: Vec<TracePoint> = Vec::new();
    for &budget in &args.budgets {
        while !budget.is_spent(clock, session.search().generation()) {
            let mut step = Ok(None);
            clock += seconds(args, || step = session.step());
            step?;
            if trace.last().is_none_or(|last| clock >= last.seconds * TRACE_RATIO) {
                trace.push(trace_point(session.search(), clock));
            }
        }
        let search = session.search();
        let front = |measure, wanted: bool| -> Vec<Member> {
            let front = wanted.then(|| Front::in_measure(search, measure));
            front.iter().flat_map(|front| &front.members).map(member).collect()
        };
        let run = Run {
            seed,
            version: env!("CARGO_PKG_VERSION").into(),
            grammar: args.grammar.clone(),
            max_cost: args.max_cost,
            threads: args.threads,
            cpu: args.cpu,
            seconds: short(clock),
            generations: search.generation(),
            considered: search.counts().considered,
            front: front(Measure::Rmse, args.loss == Measure::Rmse),
            minimax: front(Measure::Max, args.loss == Measure::Max || args.minimax),
            trace: trace.iter().cloned().chain([trace_point(search, clock)]).collect(),
        };
        let error_at = if args.loss == Measure::Max { Run::max_error_at } else { Run::error_at };
        let errors: Vec<String> =
            TRACED.iter().map(|&cost| format!("{cost}: {:.5}", error_at(&run, cost))).collect();
        eprintln!("{} {budget} seed {seed}: {}", case.name, errors.join("  "));
        Runs::add(&args.out, &case.name, &case.dataset.hash(), budget, args.loss, run)?;
    }
    Ok(())
}

fn trace_point(search: &Search, seconds: f64) -> TracePoint {
    let error =
        |cost| Some(search.archive().best_loss(cost).sqrt()).filter(|error| error.is_finite());
    TracePoint { seconds: short(seconds), errors: TRACED.map(|cost| error(cost).map(short)) }
}

fn member(member: &FrontMember) -> Member {
    let search = member.search_error();
    Member {
        cost: member.cost,
        rmse: short(search.rmse),
        max: short(search.max),
        validation_rmse: short(member.validation_error().rmse),
        formula: member.formula.clone(),
    }
}

/// Five digits, which is more than is known.
fn short(value: f64) -> f64 {
    format!("{value:.4e}").parse().unwrap_or(value)
}
