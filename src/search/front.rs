//! The front: the formulas that a search ends with.

use super::{Search, Work};
use crate::archive::undominated;
use crate::cost::{Cost, Profile};
use crate::dataset::Dataset;
use crate::eval::{Evaluator, OutputError, Score};
use crate::fit::Measure;
use crate::program::{Names, Program, parse, print};
use crate::simplify::folded;
use crate::stability::{Limits, Questions, Rounding, Stopped, Verdict, VerdictRecord};
use crate::truth::DomainError;
use rayon::prelude::*;

/// A formula of the front.
#[derive(Clone, Debug, PartialEq)]
pub struct FrontMember {
    /// The formula over the dataset's columns.
    pub program: Program,
    /// Its cycles on the search's GPU profile.
    pub cost: f64,
    /// Its registers on that profile; none if a run's record lacks them.
    pub registers: Option<u32>,
    /// Its errors on both splits.
    pub score: Score,
    /// Its errors over the whole domain, by output, if they were integrated ([`super::integrate`]).
    pub domain: Vec<DomainError>,
    /// Its verdict; unjudged until [`FrontMember::judge`].
    pub verdict: VerdictRecord,
    /// Its text.
    pub formula: String,
    /// What fills the holes of the template, if it was found by one.
    pub holes: Vec<String>,
}

impl FrontMember {
    /// Folds, costs and scores a program over the dataset's columns.
    ///
    /// # Panics
    /// If the program's numbers of inputs or outputs are not those of the dataset and `names`.
    pub fn new(
        program: Program,
        dataset: &Dataset,
        profile: &Profile,
        names: &Names,
    ) -> FrontMember {
        let program = folded(&program);
        let formula = print(&program, names);
        // The program scored and emitted is the one shown, operand by operand.
        let program = parse(&formula, names).unwrap_or(program);
        let score = Score::of(&program, dataset, &mut Evaluator::default());
        let Cost { cycles, registers, .. } = profile.cost(&program);
        let verdict = VerdictRecord::default();
        let (registers, domain) = (Some(registers), Vec::new());
        let holes = Vec::new();
        FrontMember { program, cost: cycles, registers, score, domain, verdict, formula, holes }
    }

    /// Judges the formula, unless it is judged already.
    pub fn judge(&mut self, questions: &Questions, names: &Names) {
        if !self.verdict.is_judged() {
            self.verdict = VerdictRecord::new(&Verdict::of(&self.program, questions), names);
        }
    }

    /// Returns true if its cost and its [`FrontMember::deciding_error`] do not exceed the other's,
    /// and one of them is smaller.
    pub fn dominates(&self, other: &FrontMember, measure: Measure) -> bool {
        let [mine, other_error] = [self, other].map(|member| member.deciding_error(measure));
        self.cost <= other.cost
            && mine <= other_error
            && (self.cost < other.cost || mine < other_error)
    }

    /// Returns the error that decides about a front: that over the whole domain, if it is known;
    /// else that on the validation split, which formulas are not fitted to; for the maximum error
    /// that on the search split, where it was made small.
    pub fn deciding_error(&self, measure: Measure) -> f64 {
        match measure {
            _ if self.is_integrated(measure) => self.error().of(measure),
            Measure::Max => self.search_error().max,
            _ => self.validation_error().of(measure),
        }
    }

    /// Returns the errors over all outputs on the search split.
    pub fn search_error(&self) -> OutputError {
        self.score.joint_search()
    }

    /// Returns the errors over all outputs on the validation split.
    pub fn validation_error(&self) -> OutputError {
        self.score.joint_validation()
    }
}

/// A published formula, scored as a member of a front would be.
#[derive(Clone, Debug, PartialEq)]
pub struct ScoredIncumbent {
    /// The name of the publication.
    pub name: String,
    /// The formula, scored.
    pub member: FrontMember,
}

/// The least error, as a share of the cheapest member's, that counts when logarithms are compared.
/// Chosen by hand, unmeasured.
const MIN_ERROR: f64 = 1e-9;

/// Formulas by rising cost, none dominated in cost and error ([`FrontMember::deciding_error`]).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Front {
    /// The measure of its errors.
    pub measure: Measure,
    /// The members, by rising cost and falling error.
    pub members: Vec<FrontMember>,
}

/// The boxes for each proof of a member in the first round: enough for most. Chosen by hand,
/// unmeasured.
const FEW_BOXES: usize = 1000;

impl Front {
    /// Polishes the archive's members for the search's measure: constants are fitted to convergence
    /// on the whole search split, then shortened. Then scores them, drops those that are not finite
    /// somewhere, refuted in a requirement, or dominated, and judges the rest.
    pub fn of(search: &Search) -> Front {
        Front::in_measure(search, search.problem().goal.measure)
    }

    /// As [`Front::of`], but for any measure. For the maximum error, which a search by another
    /// measure finds only indirectly, the islands' best compete as well.
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

    /// Judges the members that are not judged yet.
    pub fn judge(&mut self, questions: &Questions, names: &Names) {
        self.judge_until(questions, names, &|| false);
    }

    /// As [`Front::judge`], until `stopped` returns true: first all members with little work each,
    /// then those that are still open. Undecided questions stay open; a member whose turn did not
    /// come stays unjudged.
    pub fn judge_until(&mut self, questions: &Questions, names: &Names, stopped: Stopped) {
        let mut left: Vec<&mut FrontMember> =
            self.members.iter_mut().filter(|member| !member.verdict.is_judged()).collect();
        for boxes in [FEW_BOXES, Limits::new(Rounding::Exact).boxes] {
            let open = left.into_par_iter().filter_map(|member| {
                if stopped() {
                    return None;
                }
                let verdict = Verdict::within(&member.program, questions, boxes, stopped);
                // A round that was cut may know less than the one before it.
                if boxes == FEW_BOXES || !stopped() {
                    member.verdict = VerdictRecord::new(&verdict, names);
                }
                (!verdict.is_decided()).then_some(member)
            });
            left = open.collect();
        }
    }

    /// Makes a front of the members that are not dominated.
    pub fn from_members(members: Vec<FrontMember>, measure: Measure) -> Front {
        let place = |member: &FrontMember| (member.cost, member.deciding_error(measure));
        let members = undominated(members, place, |a, b| a.formula.cmp(&b.formula));
        Front { measure, members }
    }

    /// Returns the cheapest member whose [`FrontMember::error`] is at most `max_error`, or the
    /// most accurate one if that is not given, of those that cost at most `max_cost` cycles.
    pub fn within(&self, max_cost: Option<f64>, max_error: Option<f64>) -> Option<&FrontMember> {
        let (cost, error) = (max_cost.unwrap_or(f64::INFINITY), max_error.unwrap_or(f64::INFINITY));
        let mut suitable = self
            .members
            .iter()
            .filter(|member| member.cost <= cost && member.error().of(self.measure) <= error);
        // Errors fall along the front: the cheapest is first, the most accurate last.
        if max_error.is_some() { suitable.next() } else { suitable.next_back() }
    }

    /// Returns the member farthest below the straight line between the front's ends, in the
    /// logarithm of the error: beyond it, cycles gain less. None if the front is empty.
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
