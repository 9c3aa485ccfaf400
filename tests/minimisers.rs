//! Global and local minimisers on functions whose minima are published.

// A test has no use for all that the benchmark has.
#[allow(dead_code)]
#[path = "../benches/minimisers/problems/mod.rs"]
mod problems;

use lgp::fit::{
    DifferentialEvolution, End, GlobalSettings, Minimum, NelderMead, Outside, Range, Scale, Start,
    Strategy,
};
use problems::{Problem, mgh, multimodal};

const PATIENT: NelderMead =
    NelderMead { size: 0.1, shrinkage: 1e-9, restarts: 60, max_evaluations: 200_000 };

fn ranges(problem: &Problem) -> Vec<Range> {
    let range = |[low, high]: &[f64; 2]| Range::new(*low, *high, Scale::Linear).unwrap();
    problem.ranges.iter().map(range).collect()
}

/// The least value near the published minimum, or from the standard start, and the published one.
#[test]
fn published_minima_are_minima() {
    let mut wrong = Vec::new();
    for problem in multimodal::all().iter().chain(&mgh::all()) {
        let free = vec![Range::ANY; problem.start.len()];
        let near = problem.near.as_ref().unwrap_or(&problem.start);
        let minimum = PATIENT.minimise(near, &free, 1, |x| problem.value(x));
        let difference = minimum.value - problem.least;
        if difference.abs() > problem.tolerance {
            wrong.push(format!("{}: {} for {}", problem.name, minimum.value, problem.least));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
