//! Minimisers on functions whose minima are published: `results/fit/`.
//!
//! `cargo run --release --example minimisers` prints a table of runs. `… list` and `… serve NAME`
//! are for `results/fit.py`, which runs other libraries' minimisers on the same functions.

// The tests have a use for the rest of it.
#[allow(dead_code)]
mod problems;
mod record;

use lgp::fit::{DifferentialEvolution, GlobalSettings, NelderMead, Range, Scale, Strategy};
use problems::{Problem, Random, mgh, multimodal};
use record::Recorder;
use std::io::{Read, Write};

const EVALUATIONS: u64 = 20_000;
const SEEDS: u64 = 50;

fn main() -> std::io::Result<()> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    match words.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        [] => runs(),
        ["list"] => list(),
        ["serve", name] => return serve(&problems::find(name).expect("a problem of the list")),
        _ => panic!("minimisers [list | serve NAME]"),
    }
    Ok(())
}

fn runs() {
    println!("suite,problem,method,seed,reached,evaluations,best");
    for problem in multimodal::all() {
        let ranges = ranges(&problem);
        for seed in 1..=SEEDS {
            for strategy in [Strategy::Rand1Bin, Strategy::Best1Bin] {
                let recorder = Recorder::new(&problem);
                let evolution =
                    DifferentialEvolution { strategy, ..DifferentialEvolution::default() };
                let minimum = evolution.minimise(&ranges, seed, |x| recorder.value(x));
                minimum.expect("finite ranges");
                let rand = strategy == Strategy::Rand1Bin;
                recorder.print("multimodal", if rand { "lgp_de" } else { "lgp_de_best" }, seed);
            }
            let recorder = Recorder::new(&problem);
            simplices(&problem, &ranges, seed, &recorder);
            recorder.print("multimodal", "lgp_nm", seed);
            globally("multimodal", &problem, seed);
        }
    }
    for problem in mgh::all() {
        for seed in 0..20 {
            let recorder = Recorder::new(&problem);
            let simplex = NelderMead { max_evaluations: EVALUATIONS, ..NelderMead::default() };
            let anywhere = vec![Range::ANY; problem.start.len()];
            simplex.minimise(&problem.start_of(seed), &anywhere, seed, |x| recorder.value(x));
            recorder.print("mgh", "lgp_nm", seed);
            globally("mgh", &problem, seed);
        }
    }
}

fn ranges(problem: &Problem) -> Vec<Range> {
    let range = |[low, high]: &[f64; 2]| Range::new(*low, *high, Scale::Linear);
    problem.ranges.iter().map(range).collect::<Result<_, _>>().expect("ranges")
}

/// Simplices from one random start after the other, until all evaluations are spent.
fn simplices(problem: &Problem, ranges: &[Range], seed: u64, recorder: &Recorder) {
    let mut random = Random(seed);
    while recorder.count() < EVALUATIONS {
        let max_evaluations = EVALUATIONS - recorder.count();
        let simplex = NelderMead { max_evaluations, ..NelderMead::default() };
        let start = random.point(&problem.ranges);
        simplex.minimise(&start, ranges, seed, |x| recorder.value(x));
    }
}

fn globally(suite: &str, problem: &Problem, seed: u64) {
    let recorder = Recorder::new(problem);
    let settings = GlobalSettings { seed, ..GlobalSettings::default() };
    // The order of evaluations, which is recorded, is that of one thread.
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
    let minimum = pool.install(|| settings.minimise(&ranges(problem), |x| recorder.value(x)));
    minimum.expect("finite ranges");
    recorder.print(suite, "lgp_de_nm", seed);
}

/// A line a problem: suite, name, tolerated value, ranges, starts by seed.
fn list() {
    for (suite, problems) in [("multimodal", multimodal::all()), ("mgh", mgh::all())] {
        for problem in problems {
            let starts: Vec<Vec<f64>> = (0..20).map(|seed| problem.start_of(seed)).collect();
            let value = problem.least + problem.tolerance;
            let line = serde_json::json!({
                "suite": suite, "name": problem.name, "value": value, "ranges": problem.ranges,
                "starts": starts,
            });
            println!("{line}");
        }
    }
}

/// Answers each point on stdin, as many f64s as there are coordinates, with its value on stdout.
fn serve(problem: &Problem) -> std::io::Result<()> {
    let (mut input, mut output) = (std::io::stdin().lock(), std::io::stdout().lock());
    let mut bytes = vec![0; 8 * problem.start.len()];
    while input.read_exact(&mut bytes).is_ok() {
        let number = |bytes: &[u8]| f64::from_le_bytes(bytes.try_into().expect("eight bytes"));
        let point: Vec<f64> = bytes.chunks(8).map(number).collect();
        output.write_all(&problem.value(&point).to_le_bytes())?;
        output.flush()?;
    }
    Ok(())
}
