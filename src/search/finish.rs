//! The end of a search: its formulas are polished and judged, the most valuable first, while there
//! is time.

use super::common_factor::without_common_factors;
use super::polish::{as_found, polish, shortlist, with_short_laws};
use super::rounding::beyond_rounding;
use super::{Front, FrontMember, Search};
use crate::archive::Member;
use crate::deadline::Deadline;
use crate::fit::{Fitter, Measure, Stop};
use crate::program::Draft;
use crate::simplify::Simplifier;
use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

/// The limit of a piece of work, and the listener to its progress.
pub struct Work<'a> {
    /// The end of the work.
    pub deadline: Deadline,
    /// A function that is called with the share done, from 0 to 1.
    pub progress: &'a (dyn Fn(f64) + Sync),
}

impl Work<'_> {
    /// Work without a limit or a listener.
    pub const TO_THE_END: Work<'static> = Work { deadline: Deadline::NEVER, progress: &|_| {} };

    /// Runs the job in parallel for each place of a list, begun in the given order, and returns the
    /// results in the list's order.
    fn each<T: Send>(&self, order: &[usize], job: impl Fn(usize) -> T + Sync) -> Vec<T> {
        let (begun, done) = (AtomicUsize::new(0), AtomicUsize::new(0));
        let next = |_| {
            let place = order[begun.fetch_add(1, Ordering::Relaxed)];
            let result = job(place);
            let done = done.fetch_add(1, Ordering::Relaxed) + 1;
            (self.progress)(done as f64 / order.len() as f64);
            (place, result)
        };
        let mut results: Vec<(usize, T)> =
            (0..order.len()).into_par_iter().with_max_len(1).map(next).collect();
        results.sort_by_key(|(place, _)| *place);
        results.into_iter().map(|(_, result)| result).collect()
    }
}

impl Front {
    /// As [`Front::of`], but without verdicts, and cut at a deadline: members that are not polished
    /// by then stay as the search left them.
    pub fn polished(search: &Search, work: &Work) -> Front {
        let problem = search.problem();
        let measure = problem.goal.measure;
        let archived = archived(search);
        let drafts = match measure {
            Measure::Max => match contending(search, measure, work) {
                (drafts, false) => drafts,
                (drafts, true) => [drafts, archived].concat(),
            },
            _ => archived,
        };
        let names = problem.dataset.names();
        let samples = problem.all_in(measure);
        let order: Vec<usize> = (0..drafts.len()).collect();
        let members = work.each(&order, |place| {
            let draft = &drafts[place];
            match work.deadline.is_past() {
                true => as_found(draft, problem, &names),
                false => polish(draft, problem, &samples, &names, measure, &work.deadline),
            }
        });
        Front::affordable(members.into_iter().flatten(), search, measure)
    }

    /// As [`Front::in_measure`], but without verdicts, and cut at a deadline; if it was cut, the
    /// members of the front `known` compete as well.
    pub fn polished_in(search: &Search, measure: Measure, known: &Front, work: &Work) -> Front {
        let problem = search.problem();
        if measure == problem.goal.measure {
            return known.clone();
        }
        let (drafts, mut is_cut) = match measure {
            Measure::Max => contending(search, measure, work),
            _ => (archived(search), false),
        };
        let names = problem.dataset.names();
        let samples = problem.all_in(measure);
        let order: Vec<usize> = (0..drafts.len()).collect();
        let members = work.each(&order, |place| {
            let time_left = !work.deadline.is_past();
            time_left
                .then(|| polish(&drafts[place], problem, &samples, &names, measure, &work.deadline))
        });
        is_cut |= members.iter().any(Option::is_none);
        let mut members: Vec<FrontMember> = members.into_iter().flatten().flatten().collect();
        if is_cut {
            members.extend(known.members.iter().cloned());
        }
        Front::affordable(members.into_iter(), search, measure)
    }

    /// Makes a front of the members within the cost budget, which polishing may exceed when it
    /// brings a formula into its range.
    fn affordable(
        members: impl Iterator<Item = FrontMember>,
        search: &Search,
        measure: Measure,
    ) -> Front {
        let problem = search.problem();
        let most = problem.goal.max_cost;
        let members = members.filter(|member| member.cost <= most);
        let members = with_short_laws(members.collect(), problem, measure);
        Front::from_members(beyond_rounding(members, problem, measure), measure)
    }
}

/// Returns the archive's children, the most valuable first; the best constant if it is empty, so that
/// there always is a front.
fn archived(search: &Search) -> Vec<Draft> {
    let members = search.archive().members();
    if members.is_empty() {
        let problem = search.problem();
        let mut constant = Draft { inputs: problem.shape().inputs, ..Draft::default() };
        for hole in 0..problem.shape().outputs() {
            let value = constant.constant(0.5 + hole as f32);
            constant.outputs.push(value);
        }
        problem.on_formula(&mut constant, |formula, own| {
            Fitter::default().fit_free(formula, &problem.all, CONSTANT, |i| i < own)
        });
        return vec![constant];
    }
    let place = |member: &Member| (member.cost, member.loss);
    let order = by_value(&members.iter().map(place).collect::<Vec<_>>());
    order.into_iter().map(|place| members[place].draft.clone()).collect()
}

/// The end of a constant's fit. Least squares are linear in it: a step, and one more for rounding.
const CONSTANT: Stop = Stop { max_steps: 8, min_gain: 1e-12 };

/// Orders the places of a front's pairs of cost and error, given by rising cost: first those that
/// gain the most, in the logarithm of the error times the cycles up to the next.
fn by_value(front: &[(f64, f64)]) -> Vec<usize> {
    let value = |place: usize| {
        let (cost, error) = front[place];
        let width = front.get(place + 1).map_or(1.0, |next| next.0 - cost);
        match place.checked_sub(1).map(|before| front[before].1) {
            Some(before) => width * (before / error.max(f64::MIN_POSITIVE)).ln(),
            // The cheapest comes first: without it there may be no front.
            None => f64::INFINITY,
        }
    };
    let mut order: Vec<usize> = (0..front.len()).collect();
    order.sort_by(|&a, &b| value(b).total_cmp(&value(a)));
    order
}

/// Returns the children that may be on the front for the maximum error, and whether the deadline left
/// some out.
fn contending(search: &Search, measure: Measure, work: &Work) -> (Vec<Draft>, bool) {
    let mut drafts = archived(search);
    drafts.extend(search.contenders());
    let (mut simplifier, mut simple) = (Simplifier::default(), Draft::default());
    let problem = search.problem();
    let plain = drafts.iter().filter_map(|draft| {
        // Algebra multiplies out what then has a common factor.
        simplifier.simplify(draft, &mut simple);
        without_common_factors(&simple)
    });
    drafts.extend(plain.collect::<Vec<_>>());
    let samples = problem.all_in(measure);
    // Half of the time is left for polishing those that are worth it.
    let half = work.deadline.left().map(|left| left / 2);
    let look = half.map_or_else(|| work.deadline.clone(), |half| work.deadline.within(half));
    shortlist(drafts, problem, &samples, &look)
}

/// An estimate of the time that finishing a search takes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Rehearsal {
    /// The seconds to polish the front.
    pub polish: f64,
    /// The seconds to judge it.
    pub judge: f64,
}

impl Rehearsal {
    /// Finishes the costliest member, timed, and assumes that the others take a little less.
    pub fn of(search: &Search, deadline: &Deadline) -> Rehearsal {
        let members = search.archive().members();
        let Some(costliest) = members.last() else { return Rehearsal::default() };
        let problem = search.problem();
        let names = problem.dataset.names();
        let start = Instant::now();
        let samples = problem.all_in(problem.goal.measure);
        let polished =
            polish(&costliest.draft, problem, &samples, &names, problem.goal.measure, deadline);
        let polish = start.elapsed();
        let start = Instant::now();
        let mut front = Front::from_members(polished.into_iter().collect(), problem.goal.measure);
        front.judge_until(&problem.questions(), &names, &|| deadline.is_past());
        Rehearsal::scaled(polish, start.elapsed(), members.len(), rayon::current_num_threads())
    }

    fn scaled(polish: Duration, judge: Duration, members: usize, threads: usize) -> Rehearsal {
        let rounds = (members as f64 / threads as f64).ceil();
        let all = |one: Duration| one.as_secs_f64() * (1.0 + (rounds - 1.0).max(0.0) * OF_DEAREST);
        Rehearsal { polish: all(polish), judge: all(judge) }
    }
}

/// The average member's time as a share of the costliest one's. By hand.
const OF_DEAREST: f64 = 0.6;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_gains_most_comes_first_after_the_cheapest() {
        let front = [(0.0, 1.0), (1.0, 0.9), (5.0, 0.1), (6.0, 0.09), (9.0, 0.001)];
        assert_eq!(by_value(&front), [0, 4, 2, 1, 3]);
        assert_eq!(by_value(&[]), [0usize; 0]);
    }

    #[test]
    fn work_is_begun_in_order_and_given_back_in_place() {
        let begun = std::sync::Mutex::new(Vec::new());
        let order = [3, 0, 2, 1];
        let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
        let squares = pool.install(|| {
            Work::TO_THE_END.each(&order, |place| {
                begun.lock().unwrap().push(place);
                place * place
            })
        });
        assert_eq!(squares, [0, 1, 4, 9]);
        assert_eq!(begun.into_inner().unwrap(), order);
    }
}
