//! The notes of a session: its trace, and what recurs in its formulas.

use super::{Census, TracePoint, trace_csv};
use crate::fit::Measure;
use crate::program::Names;
use crate::search::Search;

/// The ratio between the times of a trace's lines: a long run's trace stays short, and its
/// beginning is fine enough. By hand, unmeasured.
const TRACE_RATIO: f64 = 1.05;

/// The notes of a session.
#[derive(Clone, Debug, Default)]
pub(super) struct Journal {
    trace: Vec<TracePoint>,
    /// The trace of the run that this one goes on with.
    earlier: String,
    pub census: Census,
}

impl Journal {
    /// Continues the notes of an earlier run.
    pub fn resumed(trace: String, census: Census) -> Journal {
        Journal { trace: Vec::new(), earlier: trace, census }
    }

    /// Notes the state of the search, unless that was done just now.
    pub fn note(&mut self, point: &TracePoint, search: &Search, names: &Names) {
        let due = |last: &TracePoint| point.seconds >= last.seconds * TRACE_RATIO;
        if self.trace.last().is_none_or(due) {
            self.note_anyway(point, search, names);
        }
    }

    /// Notes the end of the search, unless nothing has been considered since the last note.
    pub fn note_the_end(&mut self, point: &TracePoint, search: &Search, names: &Names) {
        if self.trace.last().is_some_and(|last| last.counts != point.counts) {
            self.note_anyway(point, search, names);
        }
    }

    fn note_anyway(&mut self, point: &TracePoint, search: &Search, names: &Names) {
        for member in search.archive().members() {
            let formula = search.problem().formula_of(&member.draft);
            self.census.count(&formula, names, point.seconds);
        }
        self.trace.push(point.clone());
    }

    /// Returns the text of `trace.csv`.
    pub fn trace(&self, measure: Measure) -> String {
        let trace = trace_csv(&self.trace, measure);
        match self.earlier.is_empty() {
            true => trace,
            false => self.earlier.clone() + trace.split_once('\n').map_or("", |(_, lines)| lines),
        }
    }
}
