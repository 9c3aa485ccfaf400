//! An island: a population, and the life of a candidate on it.

use super::polish::reads_only_constants;
use super::population::{Individual, Population};
use super::vary::{Rates, Variation, random_draft};
use super::{Counts, Goal, Method, Problem, Rejection};
use crate::archive::{Archive, Member};
use crate::cost::CostScratch;
use crate::deadline::Deadline;
use crate::eval::Samples;
use crate::fit::{Fitter, Measure, Rounds, Stop, minimax_free};
use crate::op::Op;
use crate::program::{Constants, Draft, structural_hash};
use crate::simplify::Simplifier;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Structures that an island remembers having fitted; a newer one takes the place of an older. Half a megabyte, which
/// stays in a processor's cache.
const MEMORY: usize = 1 << 17;

/// Fits of one structure, from different starting constants, before it counts as seen. By hand.
const TRIES: u32 = 2;

/// A first look at a candidate, and what a promising one is given. By hand.
const FIRST_STEPS: Stop = Stop { max_steps: 3, min_gain: 1e-3 };
const MORE_STEPS: Stop = Stop { max_steps: 14, min_gain: 1e-3 };
const ALL_SAMPLES: Stop = Stop { max_steps: 8, min_gain: 1e-3 };

/// A quick look at the least maximum error, as long as a fit of [`MORE_STEPS`]. By hand.
const QUICK_MINIMAX: Rounds = Rounds {
    most: 3,
    steps: Stop { max_steps: 2, min_gain: 1e-3 },
    linear_programs: 4,
    wanted: f64::INFINITY,
};

/// After the first steps a candidate this many times worse (in mean square) than what it must beat is
/// hopeless; or its mean of squares, where it is the square of the maximum that must be beaten. By hand.
const HOPELESS: f64 = 6.0;

/// The share to within which the subset's error estimates the whole table's. By hand: 256 samples give a mean of
/// squares to about a tenth.
const SUBSET_TOLERANCE: f64 = 1.15;

/// What sets islands apart.
struct Kind {
    /// Of the cost budget. A cheap formula is soon as good as it gets where nothing costlier competes;
    /// from there it migrates to islands that may spend more. Half of the islands spend less than half: most
    /// formulas that are used are cheap.
    share: f64,
    /// Individuals compete within their family only.
    by_family: bool,
    /// Where the maximum error is to be small: individuals compete by it. The others go on by RMSE, which
    /// is found out sooner, and send what they find.
    by_maximum: bool,
}

/// The shares were chosen on the split-integral DFG: with half of the islands under half of the budget, 20 seconds came to
/// .0121 at 12 cycles, .0141 before.
const KINDS: [Kind; 8] = [
    Kind { share: 1.0, by_family: false, by_maximum: false },
    Kind { share: 0.3, by_family: true, by_maximum: false },
    Kind { share: 0.6, by_family: false, by_maximum: true },
    Kind { share: 0.2, by_family: true, by_maximum: false },
    Kind { share: 0.35, by_family: false, by_maximum: false },
    Kind { share: 0.4, by_family: true, by_maximum: false },
    Kind { share: 1.0, by_family: false, by_maximum: true },
    Kind { share: 0.8, by_family: true, by_maximum: false },
];

/// The least share of the cost budget that counts for the number of candidates: so at most a hundred times as
/// many. By hand.
const MIN_SHARE: f64 = 0.1;

/// Where families are kept apart, the share that a bucket has of its size. By hand.
const FAMILY_BUCKET: f64 = 0.34;

#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Island {
    pub population: Population,
    /// As the last barrier left it, and what this island has found since.
    pub archive: Archive,
    pub counts: Counts,
    /// Whether losses in its population are squares of the maximum error, not means of squares.
    pub by_maximum: bool,
    rates: Rates,
    /// Hashes of structures, the low bits counting tries.
    seen: Vec<u32>,
    under_way: Option<UnderWay>,
    #[serde(skip)]
    scratch: Scratch,
    /// The samples on which candidates race.
    #[serde(skip)]
    race: Arc<Samples>,
}

/// How far an island is in a generation that it has begun: it goes on as if never stopped.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct UnderWay {
    considered: usize,
    /// Of the random stream.
    word: u128,
    /// As the generation began.
    rates: Rates,
}

/// The memory in which candidates are made; no state between candidates.
#[derive(Clone, Debug, Default)]
struct Scratch {
    variation: Variation,
    simplifier: Simplifier,
    fitter: Fitter,
    cost: CostScratch,
    hashes: Vec<u64>,
    child: Draft,
    candidate: Draft,
}

impl Island {
    pub fn new(number: usize, goal: &Goal, method: &Method) -> Island {
        let Kind { share, by_family, by_maximum } = KINDS[number % KINDS.len()];
        let max_cost = (goal.max_cost * share).ceil().min(goal.max_cost);
        // As many individuals on each island.
        let crowd = method.bucket_size as f64 * (goal.max_cost + 1.0);
        let size = crowd / (max_cost + 1.0) * if by_family { FAMILY_BUCKET } else { 1.0 };
        Island {
            population: Population::new(max_cost, by_family, size.round().max(1.0) as usize),
            archive: Archive::default(),
            counts: Counts::default(),
            by_maximum: by_maximum && goal.measure == Measure::Max,
            rates: Rates::default(),
            seen: vec![0; MEMORY],
            under_way: None,
            scratch: Scratch::default(),
            race: Arc::default(),
        }
    }

    /// Whether it could have come of a new one, for so many inputs and outputs.
    pub fn check(&self, new: &Island, inputs: usize, outputs: usize) -> Result<(), String> {
        if (self.seen.len(), self.by_maximum) != (new.seen.len(), new.by_maximum) {
            return Err("it is not as its settings make it".into());
        }
        self.rates.check()?;
        if let Some(under_way) = &self.under_way {
            under_way.rates.check()?;
        }
        self.archive.check(inputs, outputs)?;
        self.population.check(&new.population, inputs, outputs)
    }

    /// Goes on with a generation, on a random stream of its own, until it is done or the deadline is past;
    /// says which.
    pub fn generation(
        &mut self,
        problem: &Problem,
        method: &Method,
        stream: u64,
        deadline: &Deadline,
    ) -> bool {
        let mut rng = ChaCha8Rng::seed_from_u64(method.seed);
        rng.set_stream(stream);
        let begun = self.under_way.take();
        let mut under_way =
            begun.unwrap_or_else(|| UnderWay { considered: 0, word: 0, rates: self.rates.clone() });
        rng.set_word_pos(under_way.word);
        let candidates = self.candidates(problem.goal.max_cost, method.candidates);
        let was_done = under_way.considered >= candidates;
        self.scratch.variation.follow(&under_way.rates);
        self.scratch.fitter.deadline = deadline.moment_alone();
        while under_way.considered < candidates && !deadline.is_past() {
            let made_by = self.make_offspring(&mut rng, problem, method.immigrants);
            let Counts { fitted, admitted, .. } = self.counts;
            self.consider(problem);
            if self.counts.fitted > fitted {
                self.rates.note(made_by, self.counts.admitted > admitted);
            }
            under_way.considered += 1;
        }
        under_way.word = rng.get_word_pos();
        let is_done = under_way.considered >= candidates;
        if is_done && !was_done {
            self.rates.fade();
        }
        self.under_way = Some(under_way);
        is_done
    }

    /// Candidates race on these samples from now on.
    pub fn race_on(&mut self, samples: &Arc<Samples>) {
        self.race = Arc::clone(samples);
    }

    /// The next call of [`Island::generation`] begins one.
    pub fn end_generation(&mut self) {
        self.under_way = None;
    }

    /// A fit takes a time that grows with instructions times constants, so about with the square of the
    /// cost: islands that spend less consider more, and none waits long for the others.
    fn candidates(&self, max_cost: f64, with_all_of_it: usize) -> usize {
        let share = self.population.max_cost / max_cost.max(1.0);
        (with_all_of_it as f64 / share.clamp(MIN_SHARE, 1.0).powi(2)) as usize
    }

    /// Makes a child of the population, or a random draft where there is none, or for an immigrant. Gives
    /// the changes that made it.
    fn make_offspring(&mut self, rng: &mut ChaCha8Rng, problem: &Problem, immigrants: f64) -> u16 {
        let Scratch { variation, child, .. } = &mut self.scratch;
        let immigrates = immigrants > 0.0 && rng.random::<f64>() < immigrants;
        match (self.population.pick(rng), self.population.pick(rng)) {
            (Some(parent), Some(donor)) if !immigrates => {
                child.copy_from(&parent.draft);
                variation.vary(rng, child, &donor.draft, &problem.grammar)
            }
            _ => {
                let (inputs, holes) = (problem.all.inputs(), problem.holes());
                random_draft(rng, inputs, holes, &problem.grammar, child);
                0
            }
        }
    }

    /// Simplifies, costs, fits and offers the child; drops it where it has no chance.
    fn consider(&mut self, problem: &Problem) {
        self.counts.considered += 1;
        match self.evaluated(problem) {
            Err(rejection) => self.counts.note(rejection),
            Ok(newcomer) => {
                self.counts.admitted += 1;
                let Individual { cost, loss, .. } = newcomer;
                if self.population.offer(newcomer) {
                    self.offer_to_archive(problem, cost, loss);
                }
            }
        }
    }

    /// What the child has become, if the population may want it.
    fn evaluated(&mut self, problem: &Problem) -> Result<Individual, Rejection> {
        let scratch = &mut self.scratch;
        let cost = scratch.prepare(problem, self.population.max_cost)?;
        let hash = scratch.structure(problem);
        if !remember(&mut self.seen, hash) {
            return Err(Rejection::Seen);
        }
        if !problem.structure_ok(&problem.formula(&scratch.candidate)) {
            return Err(Rejection::Inadmissible);
        }
        self.counts.fitted += 1;
        let admission = self.population.admission(&scratch.candidate, cost);
        let loss = scratch.race(problem, &self.race, admission, self.by_maximum)?;
        let formula = problem.formula(&scratch.candidate);
        if problem.holds_on_samples(&formula, &mut scratch.fitter.evaluator) {
            return Ok(Individual { draft: scratch.candidate.clone(), cost, loss, hash });
        }
        self.clamped(problem).ok_or(Rejection::Unfulfilled)
    }

    /// Clamped outputs may be the cheapest way to what is required; around an outer form no child clamps.
    fn clamped(&mut self, problem: &Problem) -> Option<Individual> {
        let Scratch { fitter, cost: cost_scratch, candidate, .. } = &mut self.scratch;
        *candidate = problem.clamped(candidate).filter(|_| problem.outer.is_none())?;
        if !problem.structure_ok(candidate)
            || candidate.instrs.len() > problem.grammar.max_instructions
        {
            return None;
        }
        let cost = problem.cost(candidate, cost_scratch);
        let admission = self.population.admission(candidate, cost);
        let mut loss =
            fitter.fit(candidate, &self.race, MORE_STEPS) * (1.0 / self.race.total_weight());
        if loss < admission && self.by_maximum {
            loss = minimax_loss(fitter, candidate, usize::MAX, &self.race, admission);
        }
        let fulfils =
            loss < admission && problem.holds_on_samples(candidate, &mut fitter.evaluator);
        let hash = self.scratch.structure(problem);
        let draft = &self.scratch.candidate;
        fulfils.then(|| Individual { draft: draft.clone(), cost, loss, hash })
    }

    /// Offers the candidate, whose loss on the subset is given, to the archive, fitted on all samples, if
    /// it may be wanted there.
    fn offer_to_archive(&mut self, problem: &Problem, cost: f64, mut loss: f64) {
        let Scratch { fitter, candidate, .. } = &mut self.scratch;
        let wanted = self.archive.best_loss(cost) * SUBSET_TOLERANCE;
        let by_maximum = problem.goal.measure == Measure::Max;
        problem.on_formula(candidate, |formula, own| {
            if by_maximum && !self.by_maximum {
                loss = minimax_loss(fitter, formula, own, &self.race, wanted);
            }
            if loss >= wanted {
                return;
            }
            self.counts.fitted_on_all += 1;
            let sum = fitter.fit_free(formula, &problem.all, ALL_SAMPLES, |i| i < own);
            let mut loss = sum * problem.scale();
            if by_maximum {
                loss = minimax_loss(fitter, formula, own, &problem.all, wanted);
            }
            let loss = problem.archive_loss(formula, loss, &mut fitter.evaluator);
            if problem.holds_on_samples(formula, &mut fitter.evaluator) {
                self.archive.offer(Member { cost, loss, draft: formula.clone() });
            }
        });
    }

    /// Takes in another island's best.
    pub fn immigrate(&mut self, migrants: Vec<Individual>) {
        for migrant in migrants {
            self.population.offer(migrant);
        }
    }

    /// Takes drafts from elsewhere into the population, as many as the deadline leaves time for.
    pub fn inject_all<'a>(
        &mut self,
        drafts: impl IntoIterator<Item = &'a Draft>,
        problem: &Problem,
        deadline: &Deadline,
    ) {
        self.scratch.fitter.deadline = deadline.moment_alone();
        for draft in drafts {
            if deadline.is_past() {
                return;
            }
            self.inject(draft, problem);
        }
    }

    /// Takes a draft from elsewhere into the population, fitted; equal constants in it are fitted
    /// apart.
    fn inject(&mut self, draft: &Draft, problem: &Problem) {
        let child = &mut self.scratch.child;
        child.copy_from(draft);
        child.unshare_constants();
        self.consider(problem);
    }
}

impl Scratch {
    /// Makes the child a candidate, effective code as the grammar writes it, and costs it.
    fn prepare(&mut self, problem: &Problem, max_cost: f64) -> Result<f64, Rejection> {
        let Scratch { simplifier, cost: cost_scratch, child, candidate, .. } = self;
        simplifier.simplify(child, candidate);
        if !is_written_in(candidate, problem) {
            simplifier.fold_constants(child, candidate);
        }
        let constants_are_finite =
            candidate.consts.iter().all(|c| c.is_finite()) && !reads_only_constants(candidate);
        if candidate.instrs.len() > problem.grammar.max_instructions || !constants_are_finite {
            return Err(Rejection::TooLong);
        }
        let cost = problem.cost_of_child(candidate, cost_scratch);
        if cost > max_cost { Err(Rejection::TooExpensive) } else { Ok(cost) }
    }

    fn structure(&mut self, problem: &Problem) -> u64 {
        let formula = problem.formula(&self.candidate);
        structural_hash(&formula, Constants::Ignored, &mut self.hashes)
    }

    /// Fits the candidate on the subset, as long as it may come below what it must beat; its loss.
    fn race(
        &mut self,
        problem: &Problem,
        subset: &Samples,
        admission: f64,
        by_maximum: bool,
    ) -> Result<f64, Rejection> {
        let Scratch { fitter, candidate, .. } = self;
        let scale = 1.0 / subset.total_weight();
        problem.on_formula(candidate, |formula, own| {
            let first = fitter.fit_free(formula, subset, FIRST_STEPS, |i| i < own) * scale;
            if !first.is_finite() {
                return Err(Rejection::NotFinite);
            }
            if first > admission * HOPELESS {
                return Err(Rejection::Hopeless);
            }
            let mut loss = fitter.go_on(formula, subset, MORE_STEPS) * scale;
            // The mean of the squares is a lower bound of the square of the maximum.
            if loss < admission && by_maximum {
                loss = minimax_loss(fitter, formula, own, subset, admission);
            }
            if loss < admission { Ok(loss) } else { Err(Rejection::NoBetter) }
        })
    }
}

/// The square of the maximum error, made small by the first `own` constants so long as it may come below what is
/// wanted.
fn minimax_loss(
    fitter: &mut Fitter,
    draft: &mut Draft,
    own: usize,
    samples: &Samples,
    wanted: f64,
) -> f64 {
    let rounds = Rounds { wanted: wanted.sqrt(), ..QUICK_MINIMAX };
    minimax_free(fitter, draft, samples, rounds, |i| i < own).powi(2)
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
