//! The shortest programs, all of them: the front at the lowest costs is then not a matter of luck.
//!
//! From every program without instructions, an instruction is inserted at every edge in every way that
//! the grammar has, again and again, until nothing new of the cost comes about. Programs that are alike
//! but for their constants are one; its constants are fitted from several starts. So the front is
//! absolute up to local minima of the fits, and up to what simplification makes unreachable by single
//! insertions.

use super::polish::reads_only_constants;
use super::vary::{insertion_count, insertions, random_constant};
use super::{Problem, Search};
use crate::archive::{Member, near_the_least};
use crate::cost::CostScratch;
use crate::deadline::Deadline;
use crate::eval::Samples;
use crate::fit::{Fitter, Measure, Rounds, Stop, minimax_free};
use crate::program::{Arg, Constants, Draft, structural_hash};
use crate::simplify::Simplifier;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::cmp::Ordering;
use std::collections::HashSet;

/// Fits of each structure, from different constants. By hand.
const STARTS: u64 = 4;

const ON_SUBSET: Stop = Stop { max_steps: 20, min_gain: 1e-3 };
const ON_ALL: Stop = Stop { max_steps: 40, min_gain: 1e-4 };

/// In mean square, how near the best so far a structure must come on the subset. By hand.
const NEAR: f64 = 1.5;

/// All programs of at most some cycles.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Enumeration {
    /// Cycles.
    pub cost: f64,
    /// Programs that differ in more than constants.
    pub structures: usize,
}

impl Enumeration {
    /// The cost up to which `lgp search` enumerates unasked, if the structures are no more than this. By hand.
    pub const USUAL: (f64, usize) = (1.0, 4000);
}

impl Search {
    /// Takes in all programs of at most `cost` cycles, as far as the budget goes, fitted; nothing where
    /// they differ in more than `most` structures.
    pub fn enumerate(&mut self, cost: f64, most: usize) {
        self.enumerate_until(cost, most, &Deadline::NEVER);
    }

    /// [`Search::enumerate`], cut at a deadline: what was fitted by then is kept, and counts as any start, not
    /// as all programs.
    pub fn enumerate_until(&mut self, cost: f64, most: usize, deadline: &Deadline) {
        let cost = cost.min(self.problem.goal.max_cost);
        let Some(structures) = structures(&self.problem, cost, most, deadline) else { return };
        let members = best_of(&structures, &self.problem, &self.race, deadline);
        let children: Vec<Draft> = members.iter().map(|member| member.draft.clone()).collect();
        for member in members {
            let draft = self.problem.formula(&member.draft).into_owned();
            self.state.archive.offer(Member { draft, ..member });
        }
        let is_whole = !deadline.is_past();
        self.inject_children(&children, deadline);
        self.state.enumeration =
            is_whole.then_some(Enumeration { cost, structures: structures.len() });
    }

    /// What was enumerated before the first generation.
    pub fn enumeration(&self) -> Option<Enumeration> {
        self.state.enumeration
    }
}

/// The structures that come near the least error at their cost, fitted on all samples. Drafts are children.
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
        Some(member).filter(|member| problem.acceptable_on_samples(&problem.formula(&member.draft)))
    };
    near.into_par_iter().map_init(new_fitter, finish).flatten().collect()
}

/// Drafts that are grown together.
const PARENTS: usize = 1024;

/// Children that are looked at, at most, for each structure that may be found: with many inputs nearly all
/// are too expensive. By hand: forty inputs are given up in time.
const CHILDREN: usize = 600;

/// Every structure, or nothing where there are more than `most`, or no time to find out.
fn structures(
    problem: &Problem,
    cost: f64,
    most: usize,
    deadline: &Deadline,
) -> Option<Vec<Draft>> {
    let mut known = HashSet::new();
    let mut all: Vec<Draft> = Vec::new();
    let mut children = most.saturating_mul(CHILDREN);
    let mut latest = leaves(problem.all.inputs(), problem.holes(), most)?;
    latest.retain(|draft| known.insert(hash(draft)));
    while !latest.is_empty() {
        let mut next = Vec::new();
        // Of many a parent the children are known already: they are not kept for long.
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

/// Every choice of an input or a constant for each output; nothing where there are more than `most`.
fn leaves(inputs: usize, outputs: usize, most: usize) -> Option<Vec<Draft>> {
    let count = (inputs + 1).checked_pow(outputs as u32);
    if count.is_none_or(|count| count > most) {
        return None;
    }
    let mut drafts = vec![Draft { inputs, ..Draft::default() }];
    for _ in 0..outputs {
        let with = |draft: &Draft, input: Option<usize>| {
            let mut draft = draft.clone();
            let output = match input {
                Some(input) => Arg::Input(input as u16),
                None => draft.constant(0.5 + draft.consts.len() as f32),
            };
            draft.outputs.push(output);
            draft
        };
        drafts = drafts
            .iter()
            .flat_map(|draft| (0..inputs).map(Some).chain([None]).map(move |i| with(draft, i)))
            .collect();
    }
    Some(drafts)
}

/// What one more instruction makes of a draft, each structure once.
fn grown(draft: &Draft, problem: &Problem, cost: f64) -> Vec<(u64, Draft)> {
    let (mut simplifier, mut scratch) = (Simplifier::default(), CostScratch::default());
    let mut simple = Draft::default();
    let mut known = HashSet::new();
    let mut grown = Vec::new();
    insertions(draft, &problem.grammar, &mut |child| {
        simplifier.simplify(child, &mut simple);
        // An infinite constant is free to a compiler: there would be no end of formulas with one.
        if reads_only_constants(&simple) {
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

/// A structure with the best constants of several starts, on the subset.
fn fitted(fitter: &mut Fitter, draft: &Draft, problem: &Problem, race: &Samples) -> Option<Member> {
    if !problem.structure_ok(&problem.formula(draft)) {
        return None;
    }
    let cost = problem.cost_of_child(draft, &mut CostScratch::default());
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
            let cost = problem.cost(draft, &mut CostScratch::default());
            assert!(cost <= 1.0, "{}", print(&Program::verify(draft.clone()).unwrap(), &names));
        }
        assert_eq!(structures(&problem, 1.0, all.len() - 1, &Deadline::NEVER), None);
        let mut search = Search::new(problem, Method::default()).unwrap();
        search.enumerate(1.0, all.len());
        assert!(search.archive().best_loss(1.0) < 1e-12);
        assert_eq!(search.enumeration().map(|e| e.structures), Some(all.len()));
    }

    /// Two outputs, with a difference of equal values that may become a divisor: still few.
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
