//! What a session tells of itself while it runs, and what it leaves.

use super::{Census, Run, TracePoint, snippet};
use crate::emit::Language;
use crate::fit::Measure;
use crate::search::{Front, FrontMember, ScoredIncumbent};

/// The progress of a session after a step.
#[derive(Clone, Debug)]
pub struct Progress {
    /// The state of the search.
    pub point: TracePoint,
    /// The measure of the point's errors.
    pub measure: Measure,
    /// The share of the budget that is spent, in [0, 1].
    pub share: f64,
}

/// A phase after the search; they follow in this order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// The constants of the front are fitted.
    Polish,
    /// The constants of the front in maximum error are fitted.
    PolishForMaximum,
    /// The errors of both over the whole domain are integrated.
    Integrate,
    /// Verdicts on the front.
    Prove,
    /// Verdicts on the front in maximum error.
    ProveForMaximum,
}

/// The outcome of a search.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// The record of the run.
    pub run: Run,
    /// The front in the measure that was minimised.
    pub front: Front,
    /// The front in maximum error, constants fitted for that.
    pub minimax: Front,
    /// What [`super::Session::compared_with`] was given.
    pub published: Vec<ScoredIncumbent>,
    /// The text of `trace.csv`.
    pub trace: String,
    /// The census of its formulas.
    pub census: Census,
    /// The number of formulas in the search's archive.
    pub archived: usize,
}

impl Outcome {
    /// Returns a member as a function ready to paste.
    pub fn snippet(&self, member: &FrontMember, language: Language) -> String {
        snippet(&self.run, member, language)
    }
}
