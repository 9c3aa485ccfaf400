//! The front: what a search leaves behind.

use super::{Search, Work};
use crate::archive::undominated;
use crate::cost::{Cost, Profile};
use crate::dataset::Dataset;
use crate::eval::{Evaluator, OutputError, Score};
use crate::fit::Measure;
use crate::program::{Names, Program, parse, print};
use crate::simplify::folded;
use crate::stability::{Limits, Questions, Rounding, Stopped, Verdict, VerdictRecord};
use rayon::prelude::*;

/// A formula of the front.
#[derive(Clone, Debug, PartialEq)]
pub struct FrontMember {
    /// The formula over the dataset's columns.
    pub program: Program,
    /// Cycles on the search's GPU profile.
    pub cost: f64,
    /// Registers on it; none where a run's record has none.
    pub registers: Option<u32>,
    /// Its errors on both splits.
    pub score: Score,
    /// Not judged where nobody asked.
    pub verdict: VerdictRecord,
    /// Its text.
    pub formula: String,
}

impl FrontMember {
    /// A program over the dataset's columns, folded, costed and scored.
    ///
    /// # Panics
    /// If the program has other numbers of inputs or outputs than the dataset and `names`.
    pub fn new(
        program: Program,
        dataset: &Dataset,
        profile: &Profile,
        names: &Names,
    ) -> FrontMember {
        let program = folded(&program);
        let formula = print(&program, names);
        // What is shown is what is scored and emitted, operand by operand.
        let program = parse(&formula, names).unwrap_or(program);
        let score = Score::of(&program, dataset, &mut Evaluator::default());
        let Cost { cycles, registers, .. } = profile.cost(&program);
        let verdict = VerdictRecord::default();
        FrontMember { program, cost: cycles, registers: Some(registers), score, verdict, formula }
    }

    /// Finds out what can be proved of it, unless that is known.
    pub fn judge(&mut self, questions: &Questions, names: &Names) {
        if !self.verdict.is_judged() {
            self.verdict = VerdictRecord::new(&Verdict::of(&self.program, questions), names);
        }
    }

    /// Whether it costs no more than the other and errs no more, where a front in that measure is judged.
    pub fn dominates(&self, other: &FrontMember, measure: Measure) -> bool {
        let [mine, other_error] = [self, other].map(|member| member.deciding_error(measure));
        self.cost <= other.cost
            && mine <= other_error
            && (self.cost < other.cost || mine < other_error)
    }

    /// What decides whether it is on a front: the error on the validation split, which formulas were not
    /// fitted to; but the maximum error where it was made small, on the search split.
    pub fn deciding_error(&self, measure: Measure) -> f64 {
        match measure {
            Measure::Max => self.search_error().max,
            _ => self.validation_error().of(measure),
        }
    }

    /// Over all outputs, on the search split.
    pub fn search_error(&self) -> OutputError {
        self.score.joint_search()
    }

    /// Over all outputs, on the validation split.
    pub fn validation_error(&self) -> OutputError {
        self.score.joint_validation()
    }
}

/// A published formula, scored as a member would be.
#[derive(Clone, Debug, PartialEq)]
pub struct ScoredIncumbent {
    /// The name of the publication.
    pub name: String,
    /// The formula, scored.
    pub member: FrontMember,
}

/// An error smaller than that of the cheapest member by more than this counts as none where logarithms are
/// compared.
const MIN_ERROR: f64 = 1e-9;

/// Formulas by rising cost, none dominated in cost and error: the validation split's, but for the
/// maximum error, which is judged where it was made small.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Front {
    /// What its errors are judged by.
    pub measure: Measure,
    /// The members by rising cost.
    pub members: Vec<FrontMember>,
}

/// Boxes for each proof of a member at first: enough for most.
const FEW_BOXES: usize = 1000;

impl Front {
    /// The archive's members, polished for what the search makes small: constants fitted to
    /// convergence on all of the search split and shortened; then scored, those not finite
    /// somewhere, refuted in what is required of them, or dominated dropped, and the rest judged.
    pub fn of(search: &Search) -> Front {
        Front::in_measure(search, search.problem().goal.measure)
    }

    /// [`Front::of`], polished and judged by any measure. For the maximum error, which other searches find
    /// only by way of theirs, the islands' best compete as well.
    pub fn in_measure(search: &Search, measure: Measure) -> Front {
        let work = &Work::TO_THE_END;
        let problem = search.problem();
        let mut front = match measure == problem.goal.measure {
            true => Front::polished(search, work),
            false => Front::polished_in(search, measure, &Front::default(), work),
        };
        front.judge(&problem.questions(), &problem.dataset.names());
        front
    }

    /// Judges the members that are not judged.
    pub fn judge(&mut self, questions: &Questions, names: &Names) {
        self.judge_until(questions, names, &|| false);
    }

    /// [`Front::judge`] until it is told to stop: first all members with little work each, then those
    /// that this leaves open. What is undecided in the end is open, and a member that nobody came to
    /// is not judged.
    pub fn judge_until(&mut self, questions: &Questions, names: &Names, stopped: Stopped) {
        let mut left: Vec<&mut FrontMember> =
            self.members.iter_mut().filter(|member| !member.verdict.is_judged()).collect();
        for boxes in [FEW_BOXES, Limits::new(Rounding::Exact).boxes] {
            let open = left.into_par_iter().filter_map(|member| {
                if stopped() {
                    return None;
                }
                let verdict = Verdict::within(&member.program, questions, boxes, stopped);
                // What was cut short may know less than the round before it.
                if boxes == FEW_BOXES || !stopped() {
                    member.verdict = VerdictRecord::new(&verdict, names);
                }
                (!verdict.is_decided()).then_some(member)
            });
            left = open.collect();
        }
    }

    /// Keeps the members that are not dominated.
    pub fn from_members(members: Vec<FrontMember>, measure: Measure) -> Front {
        let place = |member: &FrontMember| (member.cost, member.deciding_error(measure));
        let members = undominated(members, place, |a, b| a.formula.cmp(&b.formula));
        Front { measure, members }
    }

    /// The cheapest member whose error is at most `max_error`, if that is given, else the most
    /// accurate; of those that cost at most `max_cost`.
    pub fn within(&self, max_cost: Option<f64>, max_error: Option<f64>) -> Option<&FrontMember> {
        let (cost, error) = (max_cost.unwrap_or(f64::INFINITY), max_error.unwrap_or(f64::INFINITY));
        let mut suitable = self.members.iter().filter(|member| {
            member.cost <= cost && member.search_error().of(self.measure) <= error
        });
        // The front falls: the cheapest is the first, the most accurate the last.
        if max_error.is_some() { suitable.next() } else { suitable.next_back() }
    }

    /// The member that gains most over a straight line between the ends, in the logarithm of the
    /// error: past it, cycles buy less.
    pub fn knee(&self) -> Option<&FrontMember> {
        let (first, last) = (self.members.first()?, self.members.last()?);
        let least = first.deciding_error(self.measure) * MIN_ERROR;
        let height = |member: &FrontMember| {
            member.deciding_error(self.measure).max(least).max(f64::MIN_POSITIVE).ln()
        };
        let slope = (height(last) - height(first)) / (last.cost - first.cost).max(1.0);
        let gain = |member: &FrontMember| {
            height(first) + slope * (member.cost - first.cost) - height(member)
        };
        self.members.iter().max_by(|a, b| gain(a).total_cmp(&gain(b)))
    }
}
