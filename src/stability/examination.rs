//! Everything that is looked into of one formula.

use super::{
    Extent, Precision, Questions, Smoothness, Spread, Tried, Verdict, extremes, half, mixed,
    must_stay_single, spreads,
};
use crate::program::{Program, effective};

/// All that `lgp check` says of a formula.
#[derive(Clone, Debug, PartialEq)]
pub struct Examination {
    /// The effective code: what the instructions of everything below are of.
    pub program: Program,
    /// The verdict on its claims.
    pub verdict: Verdict,
    /// Its losses in single precision.
    pub single: Precision,
    /// Its losses in half precision.
    pub half: Precision,
    /// The instructions that must stay in single precision for halves to err by `half_bound` at most;
    /// none where nothing helps.
    pub stay_single: Option<Vec<usize>>,
    /// The absolute error up to which half precision is good enough.
    pub half_bound: f64,
    /// Where that was tried.
    pub half_tried: Tried,
    /// How far results spread under the liberties of compilers.
    pub spreads: Vec<Spread>,
    /// Outputs at the edges of the domain and beyond.
    pub extremes: Vec<Extent>,
    /// Kinks, jumps and directions.
    pub smoothness: Smoothness,
}

impl Examination {
    /// # Panics
    /// If the program has other numbers of inputs and outputs than the questions.
    pub fn of(program: &Program, questions: &Questions, half_bound: f64) -> Examination {
        let program = effective(program);
        let domain = &questions.domain;
        Examination {
            verdict: Verdict::of(&program, questions),
            single: Precision::single(&program, domain),
            half: Precision::half(&program, domain),
            stay_single: must_stay_single(&program, domain, half_bound),
            half_bound,
            half_tried: half::points(domain, mixed::POINTS).tried(),
            spreads: spreads(&program, domain),
            extremes: extremes(&program, domain),
            smoothness: Smoothness::of(&program, domain),
            program,
        }
    }
}
