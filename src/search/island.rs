//! An island: a population, and the life of a candidate on it.

use super::population::{Individual, Population};
use super::vary::{Variation, random_draft};
use super::{Counts, Problem, Settings};
use crate::archive::{Archive, Member};
use crate::cost::CostScratch;
use crate::fit::{Fitter, Stop};
use crate::op::Op;
use crate::program::{Arg, Constants, Draft, effective_into, structural_hash};
use crate::simplify::Simplifier;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde::{Deserialize, Serialize};

/// Structures that an island remembers having fitted; a newer one takes the place of an older.
const MEMORY: usize = 1 << 17;

/// Fits of one structure, from different starting constants, before it counts as seen.
const TRIES: u32 = 2;

/// A first look at a candidate, and what a promising one is given.
const FIRST_STEPS: Stop = Stop { max_steps: 3, min_gain: 1e-3 };
const MORE_STEPS: Stop = Stop { max_steps: 14, min_gain: 1e-3 };
const ALL_SAMPLES: Stop = Stop { max_steps: 8, min_gain: 1e-3 };

/// After the first steps a candidate this many times worse (in mean square) than what it must beat is
/// hopeless.
const HOPELESS: f64 = 6.0;

/// The subset's error estimates the whole table's to within this share.
const SUBSET_TOLERANCE: f64 = 1.15;

/// What sets islands apart.
struct Way {
    /// Of the cost budget. A cheap formula is soon as good as it gets where nothing dearer competes;
    /// from there it migrates to islands that may spend more.
    share: f64,
    /// Individuals compete within their family only.
    by_family: bool,
}

const WAYS: [Way; 8] = [
    Way { share: 1.0, by_family: false },
    Way { share: 0.3, by_family: true },
    Way { share: 0.6, by_family: false },
    Way { share: 0.2, by_family: true },
    Way { share: 1.0, by_family: false },
    Way { share: 0.4, by_family: true },
    Way { share: 1.0, by_family: false },
    Way { share: 0.8, by_family: true },
];

/// Of the cost budget, for the number of candidates.
const LEAST_SHARE: f64 = 0.1;

/// Where families are kept apart, a bucket has this share of the size that it would have.
const FAMILY_BUCKET: f64 = 0.34;

#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Island {
    pub population: Population,
    /// As the last barrier left it, and what this island has found since.
    pub archive: Archive,
    pub counts: Counts,
    /// Hashes of structures, the low bits counting tries.
    seen: Vec<u32>,
    #[serde(skip)]
    workshop: Workshop,
}

/// The memory in which candidates are made; no state between candidates.
#[derive(Clone, Debug, Default)]
struct Workshop {
    variation: Variation,
    simplifier: Simplifier,
    fitter: Fitter,
    cost: CostScratch,
    hashes: Vec<u64>,
    uses: Vec<u32>,
    child: Draft,
    candidate: Draft,
}

impl Island {
    pub fn new(number: usize, settings: &Settings) -> Island {
        let Way { share, by_family } = WAYS[number % WAYS.len()];
        let max_cost = (settings.max_cost * share).ceil().min(settings.max_cost);
        // As many individuals on each island.
        let crowd = settings.bucket_size as f64 * (settings.max_cost + 1.0);
        let size = crowd / (max_cost + 1.0) * if by_family { FAMILY_BUCKET } else { 1.0 };
        Island {
            population: Population::new(max_cost, by_family, size.round().max(1.0) as usize),
            archive: Archive::default(),
            counts: Counts::default(),
            seen: vec![0; MEMORY],
            workshop: Workshop::default(),
        }
    }

    /// One generation, on a random stream of its own.
    pub fn generation(&mut self, problem: &Problem, settings: &Settings, stream: u64) {
        let mut rng = ChaCha8Rng::seed_from_u64(settings.seed);
        rng.set_stream(stream);
        for _ in 0..self.candidates(settings) {
            self.counts.considered += 1;
            self.conceive(&mut rng, problem, settings.immigrants);
            for (output, transform) in problem.transforms() {
                transform.undo(&mut self.workshop.child, output);
            }
            self.consider(problem);
        }
    }

    /// A fit takes a time that grows with instructions times constants, so about with the square of the
    /// cost: islands that spend less consider more, and none waits long for the others.
    fn candidates(&self, settings: &Settings) -> usize {
        let share = self.population.max_cost / settings.max_cost.max(1.0);
        (settings.candidates as f64 / share.clamp(LEAST_SHARE, 1.0).powi(2)) as usize
    }

    /// Makes a child of the population, or a random draft where there is none, or for an immigrant.
    fn conceive(&mut self, rng: &mut ChaCha8Rng, problem: &Problem, immigrants: f64) {
        let Workshop { variation, child, .. } = &mut self.workshop;
        let immigrates = immigrants > 0.0 && rng.random::<f64>() < immigrants;
        match (self.population.pick(rng), self.population.pick(rng)) {
            (Some(parent), Some(donor)) if !immigrates => {
                child.copy_from(&parent.draft);
                variation.vary(rng, child, &donor.draft, problem.grammar);
            }
            _ => {
                let (inputs, outputs) = (problem.all.inputs(), problem.all.outputs());
                random_draft(rng, inputs, outputs, problem.grammar, child);
            }
        }
    }

    /// Simplifies, costs, fits and offers the child; drops it where it has no chance.
    fn consider(&mut self, problem: &Problem) {
        let Workshop { simplifier, fitter, cost: scratch, hashes, uses, child, candidate, .. } =
            &mut self.workshop;
        simplifier.simplify(child, candidate);
        if !is_written_in(candidate, problem) {
            effective_into(child, candidate, uses);
        }
        let constants_are_finite = candidate.consts.iter().all(|c| c.is_finite());
        if candidate.instrs.len() > problem.grammar.max_instructions || !constants_are_finite {
            self.counts.too_long += 1;
            return;
        }
        let cost = problem.cost(candidate, scratch);
        if cost > self.population.max_cost {
            self.counts.too_dear += 1;
            return;
        }
        let hash = structural_hash(candidate, Constants::Ignored, hashes);
        if !remember(&mut self.seen, hash) {
            self.counts.seen += 1;
            return;
        }
        if !problem.admits(candidate) {
            self.counts.inadmissible += 1;
            return;
        }
        let admission = self.population.admission(candidate, cost);
        let subset = &problem.subset;
        let scale = 1.0 / subset.total_weight();
        let loss = fitter.fit(candidate, subset, FIRST_STEPS) * scale;
        self.counts.fitted += 1;
        if !loss.is_finite() {
            self.counts.not_finite += 1;
            return;
        }
        if loss > admission * HOPELESS {
            self.counts.hopeless += 1;
            return;
        }
        let mut loss = fitter.go_on(candidate, subset, MORE_STEPS) * scale;
        if loss >= admission {
            self.counts.no_better += 1;
            return;
        }
        let (mut cost, mut hash) = (cost, hash);
        if !problem.checks.hold(candidate, &mut fitter.evaluator) {
            // Clamped outputs may be the cheapest way to what is required.
            let clamped = problem.checks.clamped(candidate, problem.grammar);
            let Some(mut clamped) = clamped.filter(|draft| problem.admits(draft)) else {
                self.counts.unfulfilled += 1;
                return;
            };
            cost = problem.cost(&clamped, scratch);
            hash = structural_hash(&clamped, Constants::Ignored, hashes);
            loss = fitter.fit(&mut clamped, subset, MORE_STEPS) * scale;
            let wanted = cost <= self.population.max_cost
                && clamped.instrs.len() <= problem.grammar.max_instructions
                && loss < self.population.admission(&clamped, cost);
            if !wanted || !problem.checks.hold(&clamped, &mut fitter.evaluator) {
                self.counts.unfulfilled += 1;
                return;
            }
            *candidate = clamped;
        }
        self.counts.admitted += 1;
        let newcomer = Individual { draft: candidate.clone(), cost, loss, hash };
        if self.population.offer(newcomer) && loss < self.archive.best_loss(cost) * SUBSET_TOLERANCE
        {
            self.counts.fitted_on_all += 1;
            let loss = fitter.fit(candidate, &problem.all, ALL_SAMPLES) * problem.scale();
            if problem.checks.hold(candidate, &mut fitter.evaluator) {
                self.archive.offer(Member { cost, loss, draft: candidate.clone() });
            }
        }
    }

    /// Takes in another island's best.
    pub fn welcome(&mut self, migrants: Vec<Individual>) {
        for migrant in migrants {
            self.population.offer(migrant);
        }
    }

    /// Takes a draft from elsewhere into the population, fitted; equal constants in it are fitted
    /// apart.
    pub fn settle(&mut self, draft: &Draft, problem: &Problem) {
        let child = &mut self.workshop.child;
        child.copy_from(draft);
        child.consts.clear();
        let Draft { instrs, consts, outputs, .. } = child;
        let args = instrs.iter_mut().flat_map(|instr| instr.args_mut()).chain(outputs);
        for arg in args {
            if let Arg::Const(i) = arg {
                consts.push(draft.consts[usize::from(*i)]);
                *i = (consts.len() - 1) as u16;
            }
        }
        self.consider(problem);
    }
}

/// Whether the grammar has each operation, negation apart, which is free.
fn is_written_in(draft: &Draft, problem: &Problem) -> bool {
    let known = |op: Op| problem.grammar.operations.iter().any(|(known, _)| *known == op);
    draft.instrs.iter().all(|instr| instr.op() == Op::Neg || known(instr.op()))
}

/// Notes a structure; false where it has been fitted often enough.
fn remember(seen: &mut [u32], hash: u64) -> bool {
    const COUNT: u32 = 3;
    let entry = &mut seen[(hash >> 40) as usize & (MEMORY - 1)];
    let mark = hash as u32 & !COUNT;
    if *entry & !COUNT != mark {
        *entry = mark;
    }
    if *entry & COUNT >= TRIES {
        return false;
    }
    *entry += 1;
    true
}
