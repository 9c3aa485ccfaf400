//! Everything that is examined of one formula.

use super::{
    Extent, Precision, Questions, Smoothness, Spread, Tried, Verdict, extremes, half, mixed,
    must_stay_single, spreads,
};
use crate::program::{Program, effective};

/// Everything that `lgp check` says of a formula.
#[derive(Clone, Debug, PartialEq)]
pub struct Examination {
    /// The effective code, whose instructions the other fields index.
    pub program: Program,
    /// The verdict on its claims.
    pub verdict: Verdict,
    /// The losses of single precision.
    pub single: Precision,
    /// The losses of half precision.
    pub half: Precision,
    /// The instructions that must stay in single precision for the error to be at most
    /// `half_bound`; none if not even all of them are enough.
    pub stay_single: Option<Vec<usize>>,
    /// The largest absolute error allowed in half precision.
    pub half_bound: f64,
    /// The extent of the trial of `stay_single`.
    pub half_tried: Tried,
    /// The largest differences that the liberties of compilers make.
    pub spreads: Vec<Spread>,
    /// The outputs' extents at the edges of the domain, beyond, at zero and among denormals.
    pub extremes: Vec<Extent>,
    /// Jumps, kinks and trends.
    pub smoothness: Smoothness,
}

impl Examination {
    /// Examines a program; `half_bound` is the largest absolute error allowed in half precision.
    ///
    /// # Panics
    /// If the program does not have as many inputs and outputs as the questions.
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
