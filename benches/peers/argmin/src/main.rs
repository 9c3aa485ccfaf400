//! `argmin`'s minimisers without derivatives on the functions of `results/fit`, one line a run.

#[allow(dead_code)]
#[path = "../../../minimisers/problems/mod.rs"]
mod problems;
#[path = "../../../minimisers/record.rs"]
mod record;

use argmin::core::{CostFunction, Error, Executor};
use argmin::solver::neldermead::NelderMead;
use argmin::solver::particleswarm::ParticleSwarm;
use problems::{Problem, Random, mgh, multimodal};
use record::Recorder;

const EVALUATIONS: u64 = 20_000;
const PARTICLES: usize = 40;

/// A function, infinite beyond its ranges if it has any.
struct Cost<'a, 'b> {
    recorder: &'a Recorder<'b>,
    ranges: Option<&'a [[f64; 2]]>,
}

impl CostFunction for Cost<'_, '_> {
    type Param = Vec<f64>;
    type Output = f64;

    fn cost(&self, x: &Vec<f64>) -> Result<f64, Error> {
        let is_inside = |(x, [low, high]): (&f64, &[f64; 2])| (low..=high).contains(&x);
        let inside = self.ranges.is_none_or(|ranges| x.iter().zip(ranges).all(is_inside));
        let value = self.recorder.value(x);
        Ok(if inside && !value.is_nan() { value } else { f64::INFINITY })
    }
}

/// One simplex, its edges a tenth of the ranges or of the coordinates as ours.
fn simplex(start: &[f64], ranges: Option<&[[f64; 2]]>, recorder: &Recorder) {
    let mut corners = vec![start.to_vec()];
    for axis in 0..start.len() {
        let mut corner = start.to_vec();
        corner[axis] += match ranges {
            Some(ranges) => 0.1 * (ranges[axis][1] - ranges[axis][0]),
            None if start[axis] == 0.0 => 0.1,
            None => 0.1 * start[axis].abs(),
        };
        if ranges.is_some_and(|ranges| corner[axis] > ranges[axis][1]) {
            corner[axis] = 2.0 * start[axis] - corner[axis];
        }
        corners.push(corner);
    }
    let solver = NelderMead::new(corners).with_sd_tolerance(1e-12).expect("a tolerance");
    let left = EVALUATIONS.saturating_sub(recorder.count());
    let cost = Cost { recorder, ranges };
    // A step takes two evaluations, hardly ever more.
    let executor = Executor::new(cost, solver).configure(|state| state.max_iters(left / 2));
    let _ = executor.run();
}

fn swarm(problem: &Problem, recorder: &Recorder) {
    let (low, high) = problem.ranges.iter().map(|[low, high]| (*low, *high)).unzip();
    let solver = ParticleSwarm::new((low, high), PARTICLES);
    let cost = Cost { recorder, ranges: None };
    let iterations = EVALUATIONS / PARTICLES as u64 - 1;
    let _ = Executor::new(cost, solver).configure(|state| state.max_iters(iterations)).run();
}

fn main() {
    println!("suite,problem,method,seed,reached,evaluations,best");
    for problem in multimodal::all() {
        for seed in 1..=50 {
            let recorder = Recorder::new(&problem);
            let mut random = Random(seed);
            while recorder.count() + 10 < EVALUATIONS {
                simplex(&random.point(&problem.ranges), Some(&problem.ranges), &recorder);
            }
            recorder.print("multimodal", "argmin_nm", seed);
            let recorder = Recorder::new(&problem);
            swarm(&problem, &recorder);
            recorder.print("multimodal", "argmin_pso", seed);
        }
    }
    for problem in mgh::all() {
        for seed in 0..20 {
            let recorder = Recorder::new(&problem);
            simplex(&problem.start_of(seed), None, &recorder);
            recorder.print("mgh", "argmin_nm", seed);
        }
    }
}
