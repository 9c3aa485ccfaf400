//! Candidates a second on joint DFG, one thread: considered by a search, and fitted on all samples.
//!
//! `RAYON_NUM_THREADS=1 cargo run --release --example candidates [GENERATIONS]`

use lgp::dataset::Dataset;
use lgp::eval::Samples;
use lgp::fit::{Fitter, Stop};
use lgp::search::{Method, Problem, Search};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::error::Error;
use std::time::Instant;

/// A fit ends when a step gains less than a thousandth.
const STOP: Stop = Stop { max_steps: 50, min_gain: 1e-3 };

fn main() -> Result<(), Box<dyn Error>> {
    let generations: u64 = std::env::args().nth(1).map_or(Ok(60), |text| text.parse())?;
    let dataset = Dataset::load("datasets/dfg.bin".as_ref())?;
    let problem = Problem::of(dataset.clone()).build()?;
    let mut search = Search::new(problem, Method::default())?;
    let start = Instant::now();
    for _ in 0..generations {
        search.advance();
    }
    let (counts, elapsed) = (search.counts(), start.elapsed().as_secs_f64());
    println!("considered            {:8.0} /s", counts.considered as f64 / elapsed);
    println!("fitted on the subset  {:8.0} /s", counts.fitted as f64 / elapsed);

    let samples = Samples::new(&dataset.search, dataset.inputs.len());
    let mut fitter = Fitter::default();
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let drafts: Vec<_> = search.archive().members().iter().map(|m| m.draft.clone()).collect();
    let (mut fits, mut operations) = (0, 0);
    let start = Instant::now();
    while start.elapsed().as_secs_f64() < 5.0 {
        let mut draft = drafts[fits % drafts.len()].clone();
        draft.consts.iter_mut().for_each(|c| *c *= rng.random_range(0.7f32..1.4));
        operations += draft.instrs.len();
        fitter.fit(&mut draft, &samples, STOP);
        fits += 1;
    }
    println!(
        "fitted on all samples {:8.0} /s, of {:.1} operations",
        fits as f64 / start.elapsed().as_secs_f64(),
        operations as f64 / fits as f64
    );
    Ok(())
}
