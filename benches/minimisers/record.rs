//! What a run evaluates, and when it meets the minimum.

use crate::problems::Problem;
use std::sync::Mutex;

/// A function that counts its evaluations.
pub struct Recorder<'a> {
    problem: &'a Problem,
    state: Mutex<State>,
}

struct State {
    count: u64,
    best: f64,
    reached: Option<u64>,
}

impl<'a> Recorder<'a> {
    pub fn new(problem: &'a Problem) -> Recorder<'a> {
        let state = State { count: 0, best: f64::INFINITY, reached: None };
        Recorder { problem, state: Mutex::new(state) }
    }

    pub fn value(&self, x: &[f64]) -> f64 {
        let value = self.problem.value(x);
        let mut state = self.state.lock().expect("no evaluation panics");
        state.count += 1;
        state.best = state.best.min(value);
        if state.reached.is_none() && self.problem.is_reached(value) {
            state.reached = Some(state.count);
        }
        value
    }

    pub fn count(&self) -> u64 {
        self.state.lock().expect("no evaluation panics").count
    }

    pub fn print(&self, suite: &str, method: &str, seed: u64) {
        let state = self.state.lock().expect("no evaluation panics");
        let reached = state.reached.map_or(String::new(), |count| count.to_string());
        let (name, State { count, best, .. }) = (self.problem.name, &*state);
        println!("{suite},{name},{method},{seed},{reached},{count},{best:e}");
    }
}
