//! The time that the phases of a run took.

use std::fmt;
use std::time::Instant;

pub struct Timings {
    start: Instant,
    last: Instant,
    phases: Vec<(&'static str, f64)>,
}

impl Timings {
    /// Begins the first phase.
    pub fn new() -> Timings {
        let start = Instant::now();
        Timings { start, last: start, phases: Vec::new() }
    }

    /// Returns when the first phase began.
    pub fn start(&self) -> Instant {
        self.start
    }

    /// Ends a phase, and begins the next.
    pub fn note(&mut self, phase: &'static str) {
        let now = Instant::now();
        self.phases.push((phase, (now - self.last).as_secs_f64()));
        self.last = now;
    }
}

impl fmt::Display for Timings {
    /// `timings: reading 0.12 s, search 9.30 s; 9.42 s in all`
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let phases: Vec<String> =
            self.phases.iter().map(|(phase, seconds)| format!("{phase} {seconds:.2} s")).collect();
        let all: f64 = self.phases.iter().map(|(_, seconds)| seconds).sum();
        write!(f, "timings: {}; {all:.2} s in all", phases.join(", "))
    }
}
