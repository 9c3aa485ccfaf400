//! The enumeration of the shortest programs, so that the front at the lowest costs is not luck.
//!
//! It starts from every program without instructions and inserts an instruction at every edge in
//! every way that the grammar has, until no new program within the cost appears. Programs that
//! differ only in constants are one structure, whose constants are fitted from several starts. The
//! front is therefore exact except for local minima of the fits, and for programs that single
//! insertions cannot reach because of simplification.

use super::polish::reads_only_constants;
use super::problem::FormulaScratch;
use super::vary::{insertion_count, insertions, random_constant};
use super::{Problem, Search};
use crate::archive::{Member, near_the_least};
use crate::deadline::Deadline;
use crate::eval::Samples;
use crate::fit::{Fitter, Measure, Rounds, Stop, minimax_free};
use crate::program::{Arg, Constants, Draft, Reads, Shape, structural_hash};
use crate::simplify::Simplifier;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::cmp::Ordering;
use std::collections::HashSet;

/// The number of fits of each structure, from different constants. By hand.
const STARTS: u64 = 4;

/// The end of a fit on the subset, and on all samples. Chosen by hand, unmeasured.
const ON_SUBSET: Stop = Stop { max_steps: 20, min_gain: 1e-3 };
const ON_ALL: Stop = Stop { max_steps: 40, min_gain: 1e-4 };

/// The largest ratio of a structure's mean square on the subset to the least one at no more than
/// its cost. By hand.
const NEAR: f64 = 1.5;

/// The record that all programs up to a cost were enumerated.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Enumeration {
    /// The largest cost, in cycles.
    pub cost: f64,
    /// The number of programs that differ in more than constants.
    pub structures: usize,
}

impl Enumeration {
    /// The cost up to which `lgp search` enumerates by default, and the most structures for which
    /// it does. By hand.
    pub const USUAL: (f64, usize) = (1.0, 4000);
}

impl Search {
    /// Fits all programs of at most `cost` cycles, within the cost budget, and offers the best to
    /// the archive and the islands; does nothing if they have more than `most` structures.
    pub fn enumerate(&mut self, cost: f64, most: usize) {
        self.enumerate_until(cost, most, &Deadline::NEVER);
    }

    /// As [`Search::enumerate`], but stops at a deadline: what was fitted by then is kept, but does
    /// not count as an enumeration.
    pub fn enumerate_until(&mut self, cost: f64, most: usize, deadline: &Deadline) {
        let cost = cost.min(self.problem.goal.max_cost);
        let Some(structures) = structures(&self.problem, cost, most, deadline) else { return };
        let members = best_of(&structures, &self.problem, &self.race, deadline);
        let children: Vec<Draft> = members.iter().map(|member| member.draft.clone()).collect();
        for member in members {
            self.state.archive.offer(member);
        }
        let is_whole = !deadline.is_past();
        self.inject_children(&children, deadline);
        self.state.enumeration =
            is_whole.then_some(Enumeration { cost, structures: structures.len() });
    }

    /// Returns the record of a complete enumeration, if there was one.
    pub fn enumeration(&self) -> Option<Enumeration> {
        self.state.enumeration
    }
}

/// Returns the structures, as children, that come near the least error at their cost, fitted on all
/// samples.
fn best_of(
    structures: &[Draft],
    problem: &Problem,
    race: &Samples,
    deadline: &Deadline,
) -> Vec<Member> {
    let new_fitter = || Fitter::until(&deadline.moment_alone());
    let fitted: Vec<Option<Member>> = structures
        .par_iter()
        .map_init(Fitter::default, |fitter, draft| {
            if deadline.is_past() { None } else { fitted(fitter, draft, problem, race) }
        })
        .collect();
    let fitted: Vec<Member> = fitted.into_iter().flatten().collect();
    let near = near_the_least(fitted, NEAR, |one| (one.cost, one.loss), |_, _| Ordering::Equal);
    let finish = |fitter: &mut Fitter, mut member: Member| {
        if deadline.is_past() {
            return None;
        }
        member.loss = problem.on_formula(&mut member.draft, |formula, own| {
            let is_free = |i| i < own;
            let mut loss =
                fitter.fit_free(formula, &problem.all, ON_ALL, is_free) * problem.scale();
            if problem.goal.measure == Measure::Max {
                let rounds = Rounds::TO_CONVERGENCE;
                loss = minimax_free(fitter, formula, &problem.all, rounds, is_free).powi(2);
            }
            problem.archive_loss(formula, loss, &mut fitter.evaluator)
        });
        Some(member).filter(|member| problem.child_acceptable(&member.draft))
    };
    near.into_par_iter().map_init(new_fitter, finish).flatten().collect()
}

/// The number of drafts that are grown together. Chosen by hand, unmeasured.
const PARENTS: usize = 1024;

/// The most children tried for each structure that may be found: with many inputs nearly all are
/// too expensive. By hand: with forty inputs the enumeration gives up in time.
const CHILDREN: usize = 600;

/// Returns every structure; none if there are more than `most`, too many children to try, or too
/// little time.
fn structures(
    problem: &Problem,
    cost: f64,
    most: usize,
    deadline: &Deadline,
) -> Option<Vec<Draft>> {
    let mut known = HashSet::new();
    let mut all: Vec<Draft> = Vec::new();
    let mut children = most.saturating_mul(CHILDREN);
    let mut latest = leaves(problem.shape(), most)?;
    latest.retain(|draft| known.insert(hash(draft)));
    while !latest.is_empty() {
        let mut next = Vec::new();
        // Most children are known already: in pieces, they do not take up memory for long.
        for parents in latest.chunks(PARENTS) {
            let count: usize =
                parents.iter().map(|draft| insertion_count(draft, &problem.grammar)).sum();
            children = children.checked_sub(count)?;
            let grow = |draft| {
                let growth = (!deadline.is_past()).then(|| grown(draft, problem, cost));
                growth.unwrap_or_default()
            };
            let grown: Vec<Vec<(u64, Draft)>> = parents.par_iter().map(grow).collect();
            if deadline.is_past() {
                return None;
            }
            let new = grown.into_iter().flatten().filter(|(hash, _)| known.insert(*hash));
            next.extend(new.map(|(_, draft)| draft));
            if known.len() > most {
                return None;
            }
        }
        all.append(&mut latest);
        latest = next;
    }
    Some(all)
}

fn hash(draft: &Draft) -> u64 {
    structural_hash(draft, Constants::Ignored, &mut Vec::new())
}

/// Returns every choice of an input or a constant for each output; none if there are more than
/// `most`.
fn leaves(shape: &Shape, most: usize) -> Option<Vec<Draft>> {
    let inputs = shape.inputs;
    let choices = |output: usize| {
        let inputs = (0..inputs).filter(move |&input| shape.may_read(output, input));
        inputs.map(Some).chain([None])
    };
    let counts = (0..shape.outputs()).map(|output| choices(output).count());
    let count = counts.fold(1usize, usize::saturating_mul);
    if count > most {
        return None;
    }
    let mut drafts = vec![Draft { inputs, ..Draft::default() }];
    for output in 0..shape.outputs() {
        let with = |draft: &Draft, input: Option<usize>| {
            let mut draft = draft.clone();
            let value = match (input, shape.reads()[output]) {
                (Some(input), _) => Arg::Input(input as u16),
                (None, Reads::Constant(Some(start))) => draft.constant(start),
                (None, _) => draft.constant(0.5 + draft.consts.len() as f32),
            };
            draft.outputs.push(value);
            draft
        };
        drafts = drafts
            .iter()
            .flat_map(|draft| choices(output).map(move |input| with(draft, input)))
            .collect();
    }
    Some(drafts)
}

/// Returns the drafts that one more instruction makes of a draft, with their hashes, each structure
/// once.
fn grown(draft: &Draft, problem: &Problem, cost: f64) -> Vec<(u64, Draft)> {
    let (mut simplifier, mut scratch) = (Simplifier::default(), FormulaScratch::default());
    let mut simple = Draft::default();
    let mut known = HashSet::new();
    let mut grown = Vec::new();
    insertions(draft, &problem.grammar, &mut |child| {
        simplifier.simplify(child, &mut simple);
        // An infinite constant is free to a compiler, so formulas with one would never end.
        if reads_only_constants(&simple) || problem.shape().violation(&simple).is_some() {
            return;
        }
        let affordable = problem.cost_of_child(&simple, &mut scratch) <= cost;
        let short = simple.instrs.len() <= problem.grammar.max_instructions;
        let hash = hash(&simple);
        if affordable && short && known.insert(hash) {
            grown.push((hash, simple.clone()));
        }
    });
    grown
}

/// Fits a structure on the subset from several starts and returns the best; none if the structure
/// is not as required or never finite.
fn fitted(fitter: &mut Fitter, draft: &Draft, problem: &Problem, race: &Samples) -> Option<Member> {
    if !problem.child_structure_ok(draft) {
        return None;
    }
    let cost = problem.cost_of_child(draft, &mut FormulaScratch::default());
    if cost > problem.goal.max_cost {
        return None;
    }
    let mut rng = ChaCha8Rng::seed_from_u64(hash(draft));
    let mut best: Option<Member> = None;
    for start in 0..STARTS {
        let mut draft = draft.clone();
        if start > 0 {
            draft.consts.iter_mut().for_each(|c| *c = random_constant(&mut rng));
        }
        let sum = problem.on_formula(&mut draft, |formula, own| {
            fitter.fit_free(formula, race, ON_SUBSET, |i| i < own)
        });
        let loss = sum / race.total_weight();
        if loss.is_finite() && best.as_ref().is_none_or(|known| loss < known.loss) {
            best = Some(Member { cost, loss, draft });
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dataset::{Column, Dataset, axis};
    use crate::grammar::Grammar;
    use crate::program::{Names, Program, parse, print};
    use crate::search::Method;

    fn line() -> Dataset {
        Dataset::sampled([axis("x", 0.0..=1.0)], ["y"], |[x]| [0.3 - 0.7 * x]).unwrap()
    }

    #[test]
    fn every_structure_of_one_multiply_add_is_found() {
        let data = line();
        let text = "(operations: {\"add\": 1, \"sub\": 1, \"mul\": 1}, max_instructions: 8)";
        let grammar = Grammar::parse("linear", text).unwrap();
        let problem = Problem::of(data).grammar(grammar).build().unwrap();
        let names = Names::new(["x"], ["y"]);
        let found: HashSet<u64> =
            structures(&problem, 1.0, 1000, &Deadline::NEVER).unwrap().iter().map(hash).collect();
        let by_hand = [
            "y = x",
            "y = 2",
            "y = x + 2",
            "y = 3 - x",
            "y = 3*x",
            "y = x*x",
            "y = 3*x + 2",
            "y = x*x + 2",
            "y = x*x + x",
            "y = x - x*x",
            "y = 2 - x*x",
        ];
        for text in by_hand {
            let draft = parse(text, &names).unwrap().into_draft();
            let mut simple = Draft::default();
            Simplifier::default().simplify(&draft, &mut simple);
            assert!(found.contains(&hash(&simple)), "{text} is missing");
        }
        let all = structures(&problem, 1.0, 1000, &Deadline::NEVER).unwrap();
        for draft in &all {
            let cost = problem.cost_of_child(draft, &mut FormulaScratch::default());
            assert!(cost <= 1.0, "{}", print(&Program::verify(draft.clone()).unwrap(), &names));
        }
        assert_eq!(structures(&problem, 1.0, all.len() - 1, &Deadline::NEVER), None);
        let mut search = Search::new(problem, Method::default()).unwrap();
        search.enumerate(1.0, all.len());
        assert!(search.archive().best_loss(1.0) < 1e-12);
        assert_eq!(search.enumeration().map(|e| e.structures), Some(all.len()));
    }

    /// With two outputs, a difference of equal values may become a divisor.
    #[test]
    fn infinite_constants_make_no_structures() {
        let mut data = line();
        let other = Column { name: "z".into(), ..data.outputs[0].clone() };
        data.outputs.push(other);
        for split in [&mut data.search, &mut data.validation] {
            split.columns.push(split.columns[1].clone());
        }
        let problem = Problem::of(data).build().unwrap();
        let all = structures(&problem, 1.0, 3000, &Deadline::NEVER).unwrap();
        assert!(all.len() > 1000 && !all.iter().any(reads_only_constants), "{}", all.len());
    }
}
