//! An island: a population, and the life of a candidate on it.

use super::polish::reads_only_constants;
use super::population::{Individual, Population};
use super::problem::FormulaScratch;
use super::vary::{Rates, Variation, random_draft};
use super::{Counts, Goal, Method, Problem, Rejection};
use crate::archive::{Archive, Member};
use crate::deadline::Deadline;
use crate::eval::Samples;
use crate::fit::{Fitter, Measure, Rounds, Stop, minimax_free};
use crate::op::Op;
use crate::program::{Constants, Draft, Shape, structural_hash};
use crate::simplify::Simplifier;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// The number of fitted structures that an island remembers; a newer one replaces an older. Half a
/// megabyte, which stays in a processor's cache.
const MEMORY: usize = 1 << 17;

/// The number of fits of a structure, from different starting constants, before it counts as seen.
/// By hand.
const TRIES: u32 = 2;

/// The ends of a candidate's first fit, of a promising one's second, and of the archive's. By hand.
const FIRST_STEPS: Stop = Stop { max_steps: 3, min_gain: 1e-3 };
const MORE_STEPS: Stop = Stop { max_steps: 14, min_gain: 1e-3 };
const ALL_SAMPLES: Stop = Stop { max_steps: 8, min_gain: 1e-3 };

/// The effort of a quick fit for the least maximum error, which takes as long as one of
/// [`MORE_STEPS`]. By hand.
const QUICK_MINIMAX: Rounds = Rounds {
    most: 3,
    steps: Stop { max_steps: 2, min_gain: 1e-3 },
    linear_programs: 4,
    wanted: f64::INFINITY,
};

/// A candidate is hopeless if its mean square after the first steps is more than so many times the
/// loss that it must beat, a mean square or a square of the maximum. By hand.
const HOPELESS: f64 = 6.0;

/// The factor to within which the subset's loss estimates that on all samples. By hand: 256 samples
/// give a mean square to about a tenth.
const SUBSET_TOLERANCE: f64 = 1.15;

/// The properties in which islands differ.
struct Kind {
    /// The share of the cost budget. A cheap formula improves fast if nothing costlier competes,
    /// and then migrates to islands that may spend more. Half of the islands have less than half
    /// of the budget, since most formulas that are used are cheap.
    share: f64,
    /// True if individuals compete within their family only.
    by_family: bool,
    /// True if individuals compete by the maximum error, should that be the one to make small. The
    /// other islands go by the RMSE, which is faster to fit, and send their best.
    by_maximum: bool,
}

/// The kinds of islands, in turn. The shares were chosen on the split-integral DFG: with half of
/// the islands under half of the budget, 20 seconds came to .0121 at 12 cycles, .0141 before.
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

/// The least share of the cost budget that counts for the number of candidates, which is thereby at
/// most a hundredfold. By hand.
const MIN_SHARE: f64 = 0.1;

/// The factor of the bucket size on islands that keep families apart. By hand.
const FAMILY_BUCKET: f64 = 0.34;

#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Island {
    pub population: Population,
    /// The archive that the last barrier left, with the island's finds since.
    pub archive: Archive,
    pub counts: Counts,
    /// True if losses in its population are squares of the maximum error, not mean squares.
    pub by_maximum: bool,
    rates: Rates,
    /// The cycles of the template, above which its budget is a share.
    floor: f64,
    /// Hashes of structures, whose low bits count fits.
    seen: Vec<u32>,
    under_way: Option<UnderWay>,
    #[serde(skip)]
    scratch: Scratch,
    /// The samples on which candidates race.
    #[serde(skip)]
    race: Arc<Samples>,
}

/// The state of an island within a generation, from which it continues as if never stopped.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct UnderWay {
    considered: usize,
    /// The position in the random stream.
    word: u128,
    /// The rates at the start of the generation.
    rates: Rates,
}

/// The memory in which candidates are made; it carries no state from one to the next.
#[derive(Clone, Debug, Default)]
struct Scratch {
    variation: Variation,
    simplifier: Simplifier,
    fitter: Fitter,
    formula: FormulaScratch,
    hashes: Vec<u64>,
    child: Draft,
    candidate: Draft,
}

impl Island {
    /// Makes one without individuals; formulas cost more than `floor` cycles.
    pub fn new(number: usize, goal: &Goal, floor: f64, method: &Method) -> Island {
        let Kind { share, by_family, by_maximum } = KINDS[number % KINDS.len()];
        let floor = floor.min(goal.max_cost);
        let all = goal.max_cost - floor;
        let max_cost = (floor + all * share).ceil().min(goal.max_cost);
        // All islands have about as many individuals.
        let crowd = method.bucket_size as f64 * (all + 1.0);
        let size = crowd / (max_cost - floor + 1.0) * if by_family { FAMILY_BUCKET } else { 1.0 };
        Island {
            population: Population::new(max_cost, by_family, size.round().max(1.0) as usize),
            archive: Archive::default(),
            counts: Counts::default(),
            by_maximum: by_maximum && goal.measure == Measure::Max,
            rates: Rates::default(),
            floor,
            seen: vec![0; MEMORY],
            under_way: None,
            scratch: Scratch::default(),
            race: Arc::default(),
        }
    }

    /// Checks that it can have evolved from a new one, by drafts of a shape.
    pub fn check(&self, new: &Island, shape: &Shape) -> Result<(), String> {
        let kind = |one: &Island| (one.seen.len(), one.by_maximum, one.floor);
        if kind(self) != kind(new) {
            return Err("its memory or error measure does not match its settings".into());
        }
        self.rates.check()?;
        if let Some(under_way) = &self.under_way {
            under_way.rates.check()?;
        }
        self.archive.check(shape)?;
        self.population.check(&new.population, shape)
    }

    /// Continues a generation, on a random stream of its own, until it is done or the deadline is
    /// past. Returns true if it is done.
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

    /// Sets the samples on which candidates race from now on.
    pub fn race_on(&mut self, samples: &Arc<Samples>) {
        self.race = Arc::clone(samples);
    }

    /// Ends the generation, so that the next call of [`Island::generation`] begins one.
    pub fn end_generation(&mut self) {
        self.under_way = None;
    }

    /// Returns the number of candidates of a generation. A fit's time grows with instructions times
    /// constants, so about with the square of the cost: islands with a smaller budget consider more
    /// candidates, and none waits long for the others.
    fn candidates(&self, max_cost: f64, with_all_of_it: usize) -> usize {
        let share = (self.population.max_cost - self.floor) / (max_cost - self.floor).max(1.0);
        (with_all_of_it as f64 / share.clamp(MIN_SHARE, 1.0).powi(2)) as usize
    }

    /// Makes a child of the population, or a random draft if that is empty or an immigrant is due.
    /// Returns the kinds of change that made it, a bit each.
    fn make_offspring(&mut self, rng: &mut ChaCha8Rng, problem: &Problem, immigrants: f64) -> u16 {
        let Scratch { variation, child, .. } = &mut self.scratch;
        let immigrates = immigrants > 0.0 && rng.random::<f64>() < immigrants;
        match (self.population.pick(rng), self.population.pick(rng)) {
            (Some(parent), Some(donor)) if !immigrates => {
                child.copy_from(&parent.draft);
                variation.vary(rng, child, &donor.draft, &problem.grammar, problem.shape())
            }
            _ => {
                random_draft(rng, problem.shape(), &problem.grammar, child);
                0
            }
        }
    }

    /// Simplifies, costs, fits and offers the child, unless it is rejected on the way.
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

    /// Returns the child as a fitted individual that the population may admit.
    fn evaluated(&mut self, problem: &Problem) -> Result<Individual, Rejection> {
        let scratch = &mut self.scratch;
        let cost = scratch.prepare(problem, self.population.max_cost)?;
        let hash = scratch.structure(problem);
        if !remember(&mut self.seen, hash) {
            return Err(Rejection::Seen);
        }
        if !problem.child_structure_ok(&scratch.candidate) {
            return Err(Rejection::Inadmissible);
        }
        self.counts.fitted += 1;
        let admission = self.population.admission(&scratch.candidate, cost);
        let loss = scratch.race(problem, &self.race, admission, self.by_maximum)?;
        if problem.can_clamp()
            || problem.child_holds(&scratch.candidate, &mut scratch.fitter.evaluator)
        {
            return Ok(Individual { draft: scratch.candidate.clone(), cost, loss, hash });
        }
        self.clamped(problem).ok_or(Rejection::Unfulfilled)
    }

    /// Returns the candidate with clamped outputs, which may be the cheapest way to meet the
    /// requirements; none within an outer form, around which no child can clamp.
    fn clamped(&mut self, problem: &Problem) -> Option<Individual> {
        let Scratch { fitter, formula, candidate, .. } = &mut self.scratch;
        *candidate = clamped(candidate, problem)?;
        let cost = problem.cost(candidate, &mut formula.cost);
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

    /// Fits the candidate, whose loss on the subset is given, on all samples and offers it to the
    /// archive, if it may be good enough; clamped, if it is not as required otherwise.
    fn offer_to_archive(&mut self, problem: &Problem, mut cost: f64, mut loss: f64) {
        let Scratch { fitter, formula, candidate, .. } = &mut self.scratch;
        let by_maximum = problem.goal.measure == Measure::Max;
        let mut wanted = self.archive.best_loss(cost) * SUBSET_TOLERANCE;
        let may_win = loss < wanted || by_maximum && !self.by_maximum;
        if may_win && problem.can_clamp() && !problem.child_holds(candidate, &mut fitter.evaluator)
        {
            let Some(draft) = clamped(candidate, problem) else { return };
            *candidate = draft;
            cost = problem.cost(candidate, &mut formula.cost);
            if cost > problem.goal.max_cost {
                return;
            }
            wanted = self.archive.best_loss(cost) * SUBSET_TOLERANCE;
        }
        let fitted = problem.on_formula(candidate, |formula, own| {
            if by_maximum && !self.by_maximum {
                loss = minimax_loss(fitter, formula, own, &self.race, wanted);
            }
            if loss >= wanted {
                return None;
            }
            self.counts.fitted_on_all += 1;
            let sum = fitter.fit_free(formula, &problem.all, ALL_SAMPLES, |i| i < own);
            let mut loss = sum * problem.scale();
            if by_maximum {
                loss = minimax_loss(fitter, formula, own, &problem.all, wanted);
            }
            Some(problem.archive_loss(formula, loss, &mut fitter.evaluator))
        });
        let Some(loss) = fitted else { return };
        if problem.child_holds(candidate, &mut fitter.evaluator) {
            self.archive.offer(Member { cost, loss, draft: candidate.clone() });
            return;
        }
        // Values that leave a range by little do so at other samples than those of the race. What is
        // cut off was an error.
        if let Some(draft) = clamped(candidate, problem).filter(|_| problem.can_clamp()) {
            let cost = problem.cost(&draft, &mut self.scratch.formula.cost);
            let holds = problem.holds_on_samples(&draft, &mut self.scratch.fitter.evaluator);
            if holds && cost <= problem.goal.max_cost {
                self.archive.offer(Member { cost, loss, draft });
            }
        }
    }

    /// Fits its individuals to the samples on which candidates race now, and forgets which
    /// structures were tried on others. Those that the deadline leaves no time for keep their
    /// losses.
    pub fn judge_anew(&mut self, problem: &Problem, deadline: &Deadline) {
        self.seen.fill(0);
        self.scratch.fitter.deadline = deadline.moment_alone();
        let Island { population, scratch, race, by_maximum, .. } = self;
        population.judge_anew(|one| {
            if !deadline.is_past() {
                one.loss = scratch.loss(&mut one.draft, problem, race, *by_maximum);
            }
        });
    }

    /// Offers another island's best to the population.
    pub fn immigrate(&mut self, migrants: Vec<Individual>) {
        for migrant in migrants {
            self.population.offer(migrant);
        }
    }

    /// Fits and offers drafts from elsewhere, as many as the deadline leaves time for.
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

    /// Fits and offers a draft from elsewhere; its equal constants are fitted separately.
    fn inject(&mut self, draft: &Draft, problem: &Problem) {
        let child = &mut self.scratch.child;
        child.copy_from(draft);
        child.unshare_constants();
        self.consider(problem);
    }
}

impl Scratch {
    /// Makes the child a candidate, effective code in the grammar's operations. Returns its cost.
    fn prepare(&mut self, problem: &Problem, max_cost: f64) -> Result<f64, Rejection> {
        let Scratch { simplifier, formula, child, candidate, .. } = self;
        simplifier.simplify(child, candidate);
        if !is_written_in(candidate, problem) {
            simplifier.fold_constants(child, candidate);
        }
        let constants_are_finite =
            candidate.consts.iter().all(|c| c.is_finite()) && !reads_only_constants(candidate);
        if candidate.instrs.len() > problem.grammar.max_instructions || !constants_are_finite {
            return Err(Rejection::TooLong);
        }
        let cost = problem.cost_of_child(candidate, formula);
        if cost > max_cost { Err(Rejection::TooExpensive) } else { Ok(cost) }
    }

    /// Fits a child on the subset, and returns its loss.
    fn loss(
        &mut self,
        child: &mut Draft,
        problem: &Problem,
        subset: &Samples,
        by_maximum: bool,
    ) -> f64 {
        let fitter = &mut self.fitter;
        problem.on_formula(child, |formula, own| {
            let sum = fitter.fit_free(formula, subset, MORE_STEPS, |i| i < own);
            match by_maximum {
                true => minimax_loss(fitter, formula, own, subset, f64::INFINITY),
                false => sum / subset.total_weight(),
            }
        })
    }

    fn structure(&mut self, problem: &Problem) -> u64 {
        let formula = problem.formula(&self.candidate);
        structural_hash(&formula, Constants::Ignored, &mut self.hashes)
    }

    /// Fits the candidate on the subset while it may come below the loss that it must beat, and
    /// returns its loss.
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
            // The mean square is a lower bound of the square of the maximum.
            if loss < admission && by_maximum {
                loss = minimax_loss(fitter, formula, own, subset, admission);
            }
            if loss < admission { Ok(loss) } else { Err(Rejection::NoBetter) }
        })
    }
}

/// Returns a child with clamped outputs, if it can be clamped, is as required, and not too long.
fn clamped(child: &Draft, problem: &Problem) -> Option<Draft> {
    let clamped = problem.clamped(child).filter(|_| problem.outer.is_none())?;
    let is_short = clamped.instrs.len() <= problem.grammar.max_instructions;
    (is_short && problem.structure_ok(&clamped)).then_some(clamped)
}

/// Fits a child of the archive to all samples, and returns it with its loss; none if its values are
/// not as required.
pub(super) fn refitted(member: &Member, problem: &Problem, fitter: &mut Fitter) -> Option<Member> {
    let mut draft = member.draft.clone();
    let loss = problem.on_formula(&mut draft, |formula, own| {
        let sum = fitter.fit_free(formula, &problem.all, ALL_SAMPLES, |i| i < own);
        let mut loss = sum * problem.scale();
        if problem.goal.measure == Measure::Max {
            loss = minimax_loss(fitter, formula, own, &problem.all, f64::INFINITY);
        }
        problem.archive_loss(formula, loss, &mut fitter.evaluator)
    });
    let holds = problem.child_holds(&draft, &mut fitter.evaluator);
    holds.then_some(Member { cost: member.cost, loss, draft })
}

/// Fits the first `own` constants for the least maximum error while its square may come below
/// `wanted`, and returns that square.
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

/// Returns true if the grammar has each operation except negation, which is free.
fn is_written_in(draft: &Draft, problem: &Problem) -> bool {
    let known = |op: Op| problem.grammar.operations.iter().any(|(known, _)| *known == op);
    draft.instrs.iter().all(|instr| instr.op() == Op::Neg || known(instr.op()))
}

/// Notes a structure. Returns false if it has been fitted often enough.
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
