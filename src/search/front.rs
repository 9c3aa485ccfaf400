//! The front: what a search leaves behind.

use super::{Problem, Search};
use crate::cost::{CostScratch, Profile};
use crate::dataset::Dataset;
use crate::eval::{Evaluator, OutputError, Score, joint};
use crate::fit::{Fitter, Stop, shorten};
use crate::program::{Draft, Names, Program, effective, parse, print};
use crate::simplify::{Simplifier, tidy};
use rayon::prelude::*;

/// Fits of the front go on until nothing is gained.
const TO_CONVERGENCE: Stop = Stop { max_steps: 200, min_gain: 1e-7 };

/// The share by which constants of fewer digits may raise the sum of squares: half of it in RMSE.
const SHORTENING_ALLOWANCE: f64 = 0.004;

/// A formula of the front.
#[derive(Clone, Debug, PartialEq)]
pub struct FrontMember {
    pub program: Program,
    /// Cycles on the search's GPU profile.
    pub cost: f64,
    pub score: Score,
    pub formula: String,
}

impl FrontMember {
    /// A program over the dataset's columns, costed and scored.
    ///
    /// # Panics
    /// If the program has other numbers of inputs or outputs than the dataset and `names`.
    pub fn new(
        program: Program,
        dataset: &Dataset,
        profile: &Profile,
        names: &Names,
    ) -> FrontMember {
        let formula = print(&program, names);
        // What is shown is what is scored and emitted, operand by operand.
        let program = parse(&formula, names).unwrap_or(program);
        let score = Score::of(&program, dataset, &mut Evaluator::default());
        let cost = profile.cycles(&program, &mut CostScratch::default());
        FrontMember { program, cost, score, formula }
    }

    /// Whether it costs no more than the other and errs no more, on the search split.
    pub fn dominates(&self, other: &FrontMember) -> bool {
        let [mine, other_error] = [self, other].map(|member| member.search_error().rmse);
        self.cost <= other.cost
            && mine <= other_error
            && (self.cost < other.cost || mine < other_error)
    }

    /// Over all outputs, on the search split.
    pub fn search_error(&self) -> OutputError {
        joint(&self.score.search)
    }

    /// Over all outputs, on the validation split.
    pub fn validation_error(&self) -> OutputError {
        joint(&self.score.validation)
    }
}

/// Formulas by rising cost, none dominated in cost and validation RMSE.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Front {
    pub members: Vec<FrontMember>,
}

impl Front {
    /// The archive's members with their constants fitted to convergence on all of the search
    /// split, scored, those not finite somewhere or dominated dropped.
    pub fn of(search: &Search, problem: &Problem) -> Front {
        let names = problem.dataset.names();
        let archive = search.archive().members();
        let polished: Vec<FrontMember> = archive
            .par_iter()
            .filter_map(|member| polish(&member.draft, problem, &names))
            .collect();
        Front::from_members(polished)
    }

    /// Keeps the non-dominated members.
    pub fn from_members(mut members: Vec<FrontMember>) -> Front {
        let key = |member: &FrontMember| member.validation_error().rmse;
        members.sort_by(|a, b| {
            a.cost
                .total_cmp(&b.cost)
                .then(key(a).total_cmp(&key(b)))
                .then_with(|| a.formula.cmp(&b.formula))
        });
        let mut least = f64::INFINITY;
        members.retain(|member| {
            let kept = key(member) < least;
            least = least.min(key(member));
            kept
        });
        Front { members }
    }

    /// The member that gains most over a straight line between the ends, in the logarithm of the
    /// error: past it, cycles buy less.
    pub fn knee(&self) -> Option<&FrontMember> {
        let (first, last) = (self.members.first()?, self.members.last()?);
        let height = |member: &FrontMember| member.validation_error().rmse.max(1e-30).ln();
        let slope = (height(last) - height(first)) / (last.cost - first.cost).max(1.0);
        let gain = |member: &FrontMember| {
            height(first) + slope * (member.cost - first.cost) - height(member)
        };
        self.members.iter().max_by(|a, b| gain(a).total_cmp(&gain(b)))
    }
}

/// Fits to convergence, shortens the constants, and drops what a constant has made superfluous.
fn polish(draft: &Draft, problem: &Problem, names: &Names) -> Option<FrontMember> {
    let mut fitter = Fitter::default();
    let mut draft = draft.clone();
    fitter.fit(&mut draft, &problem.all, TO_CONVERGENCE);
    shorten(&mut fitter, &mut draft, &problem.all, SHORTENING_ALLOWANCE);
    let mut simple = Draft::default();
    Simplifier::default().simplify(&draft, &mut simple);
    let finished = [draft, simple].into_iter().filter_map(|draft| {
        let program = effective(&tidy(&Program::verify(draft).ok()?));
        Some(FrontMember::new(program, problem.dataset, problem.profile, names))
    });
    // The simpler form, where rounding has not made it worse.
    finished
        .filter(|member| member.score.is_finite())
        .reduce(|plain, simple| if simple.dominates(&plain) { simple } else { plain })
}
