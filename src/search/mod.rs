//! The search: islands of programs, varied, costed, fitted, and kept where they are best.
//!
//! Each generation every island considers a fixed number of candidates on a random stream of its
//! own (seed, island, generation); archives are merged and migrants exchanged only between
//! generations, in the islands' order. So the number of threads changes nothing but the time.
//!
//! Islands differ in the cycles that a formula may cost there, and in who competes: on some only formulas
//! with the same families of operations, so that a root or an exponential, expensive at first, can grow. Where the
//! maximum error is to be small, it decides in the archive, and on every fourth island; on the others RMSE
//! does, which is found out sooner.

mod enumerate;
mod finish;
mod front;
mod goal;
mod island;
mod loaded;
mod method;
mod polish;
mod population;
mod problem;
mod require;
mod rounding;
mod scales;
mod vary;

pub use enumerate::Enumeration;
pub use finish::{Rehearsal, Work};
pub use front::{Front, FrontMember, ScoredIncumbent};
pub use goal::{Goal, MAX_CYCLES, Transform};
pub(crate) use loaded::not_negative;
pub use method::{MAX_ISLANDS, Method};
pub use problem::{Problem, ProblemBuilder, SetupError, USUAL_GPU, USUAL_GRAMMAR};
pub use require::Requirement;

use crate::archive::Archive;
use crate::deadline::Deadline;
use crate::eval::Samples;
use crate::fit::Measure;
use crate::program::{Constants, Draft, structural_hash};
use island::Island;
use population::Individual;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::collections::HashSet;
use std::sync::Arc;
use std::time::Duration;

/// For so long an island goes on before others have their turn: where a generation lasts long, none waits
/// until there is no time left. Short beside the second that a budget is long at least.
const TURN: Duration = Duration::from_millis(100);

/// How much worse in mean square than the archive's a contender may be. By hand.
const CONTENDING: f64 = 4.0;

/// Where the maximum error was searched for, the archive's losses are its squares: how much larger a
/// contender's may be, and how much of them its mean of squares, where that is its loss.
const CONTENDING_BY_MAXIMUM: f64 = 1.5;
const CONTENDING_BY_MEAN: f64 = 0.3;

/// What became of the candidates; each is counted once under `considered` and where it ended.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Counts {
    /// All candidates.
    pub considered: u64,
    /// More instructions than the grammar allows, or constants that are not finite.
    pub too_long: u64,
    /// Out of the cost budget.
    pub too_expensive: u64,
    /// Of a structure that was fitted before.
    pub seen: u64,
    /// Not built as required, or nested deeper than the grammar allows.
    pub inadmissible: u64,
    /// Constants fitted on the subset: the sum of the following five.
    pub fitted: u64,
    /// Infinite or NaN on a sample.
    pub not_finite: u64,
    /// Given up after the first steps of fitting.
    pub hopeless: u64,
    /// Fitted, and worse than the individuals that are there.
    pub no_better: u64,
    /// Good enough, its values not as required.
    pub unfulfilled: u64,
    /// Taken into a population.
    pub admitted: u64,
    /// Of those admitted, the ones fitted on all samples, since the archive may want them.
    pub fitted_on_all: u64,
}

/// Where a candidate ended that was not admitted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Rejection {
    TooLong,
    TooExpensive,
    Seen,
    Inadmissible,
    NotFinite,
    Hopeless,
    NoBetter,
    Unfulfilled,
}

impl Counts {
    fn note(&mut self, rejection: Rejection) {
        *match rejection {
            Rejection::TooLong => &mut self.too_long,
            Rejection::TooExpensive => &mut self.too_expensive,
            Rejection::Seen => &mut self.seen,
            Rejection::Inadmissible => &mut self.inadmissible,
            Rejection::NotFinite => &mut self.not_finite,
            Rejection::Hopeless => &mut self.hopeless,
            Rejection::NoBetter => &mut self.no_better,
            Rejection::Unfulfilled => &mut self.unfulfilled,
        } += 1;
    }

    pub(crate) fn add(&mut self, other: &Counts) {
        // Destructured, so that none is forgotten.
        let Counts {
            considered,
            too_long,
            too_expensive,
            seen,
            inadmissible,
            fitted,
            not_finite,
            hopeless,
            no_better,
            unfulfilled,
            admitted,
            fitted_on_all,
        } = other;
        self.considered += considered;
        self.too_long += too_long;
        self.too_expensive += too_expensive;
        self.seen += seen;
        self.inadmissible += inadmissible;
        self.fitted += fitted;
        self.not_finite += not_finite;
        self.hopeless += hopeless;
        self.no_better += no_better;
        self.unfulfilled += unfulfilled;
        self.admitted += admitted;
        self.fitted_on_all += fitted_on_all;
    }
}

/// A search of a problem, under way.
#[derive(Clone, Debug)]
pub struct Search {
    problem: Arc<Problem>,
    method: Method,
    /// The samples on which candidates race.
    race: Arc<Samples>,
    state: State,
}

/// How far a search has come: what is needed to go on with it, beside its problem and method.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct State {
    generation: u64,
    islands: Vec<Island>,
    archive: Archive,
    enumeration: Option<Enumeration>,
}

impl State {
    /// Generations that are done.
    pub fn generation(&self) -> u64 {
        self.generation
    }

    /// The best found so far, on the whole search split.
    pub fn archive(&self) -> &Archive {
        &self.archive
    }

    /// What became of all candidates so far.
    pub fn counts(&self) -> Counts {
        let mut counts = Counts::default();
        self.islands.iter().for_each(|island| counts.add(&island.counts));
        counts
    }
}

impl Search {
    /// A search that has not begun.
    ///
    /// # Errors
    /// [`SetupError::Method`].
    pub fn new(problem: impl Into<Arc<Problem>>, method: Method) -> Result<Search, SetupError> {
        method.check().map_err(SetupError::Method)?;
        let problem = problem.into();
        let islands = (0..method.islands).map(|i| Island::new(i, &problem.goal, &method)).collect();
        let archive = Archive::default();
        let state = State { generation: 0, islands, archive, enumeration: None };
        Ok(Search::with(problem, method, state))
    }

    /// A search that goes on from where one for the same goal by the same method came.
    ///
    /// # Errors
    /// [`SetupError::Method`]; [`SetupError::State`] if no such search can have come there.
    pub fn resume(
        problem: impl Into<Arc<Problem>>,
        method: Method,
        state: State,
    ) -> Result<Search, SetupError> {
        let problem = problem.into();
        method.check().map_err(SetupError::Method)?;
        let (inputs, outputs) = (problem.all.inputs(), problem.all.outputs());
        state.check(&problem.goal, &method, inputs, outputs).map_err(SetupError::State)?;
        Ok(Search::with(problem, method, state))
    }

    fn with(problem: Arc<Problem>, method: Method, mut state: State) -> Search {
        let race = Arc::new(problem.race(method.subset));
        state.islands.iter_mut().for_each(|island| island.race_on(&race));
        Search { problem, method, race, state }
    }

    /// What is searched for.
    pub fn problem(&self) -> &Arc<Problem> {
        &self.problem
    }

    /// How.
    pub fn method(&self) -> &Method {
        &self.method
    }

    /// How far it has come.
    pub fn state(&self) -> &State {
        &self.state
    }

    /// Generations that are done.
    pub fn generation(&self) -> u64 {
        self.state.generation
    }

    /// The best found so far, on the whole search split; [`Problem::natural`] makes formulas of its drafts, and
    /// [`Problem::error`] errors of its losses.
    pub fn archive(&self) -> &Archive {
        &self.state.archive
    }

    /// The least error at no more than this cost, as [`FrontMember::search_error`] shows it; infinite where there is
    /// none.
    pub fn best_error(&self, cost: f64) -> f64 {
        self.problem.error(self.archive().best_loss(cost))
    }

    /// How much the archive gains on the best constant: [`Archive::hypervolume`].
    pub fn hypervolume(&self) -> f64 {
        self.archive().hypervolume(self.problem.goal.max_cost, self.problem.constant_loss)
    }

    /// The islands' individuals of structures that the archive has left out, so far as they
    /// are not much worse than its own.
    fn contenders(&self) -> Vec<Draft> {
        let archive = self.archive();
        let mut hashes = Vec::new();
        let mut structure = |draft| structural_hash(draft, Constants::Ignored, &mut hashes);
        let mut known: HashSet<u64> =
            archive.members().iter().map(|member| structure(&member.draft)).collect();
        let mut contenders = Vec::new();
        for island in &self.state.islands {
            let share = match (self.problem.goal.measure, island.by_maximum) {
                (Measure::Max, true) => CONTENDING_BY_MAXIMUM,
                (Measure::Max, false) => CONTENDING_BY_MEAN,
                _ => CONTENDING,
            };
            for one in island.population.individuals() {
                if one.loss < share * archive.best_loss(one.cost) && known.insert(one.hash) {
                    contenders.push(self.problem.formula(&one.draft).into_owned());
                }
            }
        }
        contenders
    }

    /// What became of all candidates so far.
    pub fn counts(&self) -> Counts {
        self.state.counts()
    }

    /// One generation of every island, in parallel on the current thread pool; the rest of one that
    /// was cut.
    pub fn advance(&mut self) {
        self.advance_until(&Deadline::NEVER);
    }

    /// [`Search::advance`], cut at a deadline: what was found by then is kept, and the next call goes on
    /// where this one stopped, as if nothing had been. Says whether the generation is done. (Fits on many
    /// samples that a moment cuts are not done again; pauses and requests to stop cut none.)
    pub fn advance_until(&mut self, deadline: &Deadline) -> bool {
        let (problem, method, state) = (&*self.problem, &self.method, &mut self.state);
        loop {
            let generation = state.generation;
            let done = state.islands.par_iter_mut().enumerate().map(|(i, island)| {
                let stream = generation * method.islands as u64 + i as u64;
                island.generation(problem, method, stream, &deadline.pausing_in(TURN))
            });
            if done.reduce(|| true, |a, b| a && b) {
                break;
            }
            if deadline.is_past() {
                state.islands.iter().for_each(|island| state.archive.merge(&island.archive));
                return false;
            }
        }
        state.islands.iter_mut().for_each(Island::end_generation);
        state.generation += 1;
        self.barrier(&deadline.moment_alone());
        true
    }

    /// What islands learn of each other.
    fn barrier(&mut self, deadline: &Deadline) {
        let State { generation, islands, archive, .. } = &mut self.state;
        for island in islands.iter() {
            archive.merge(&island.archive);
        }
        for island in islands {
            island.archive.clone_from(archive);
        }
        if generation.is_multiple_of(self.method.migration_interval) {
            self.migrate(deadline);
        }
    }

    /// Each island's best go on to the next. Where that goes by another error, as drafts.
    fn migrate(&mut self, deadline: &Deadline) {
        let (problem, islands) = (&*self.problem, &mut self.state.islands);
        let elites =
            |island: &Island| (island.by_maximum, island.population.elites().cloned().collect());
        let mut arriving: Vec<(bool, Vec<Individual>)> = islands.iter().map(elites).collect();
        arriving.rotate_right(1);
        islands.par_iter_mut().zip(arriving).for_each(|(island, (by_maximum, migrants))| {
            match by_maximum == island.by_maximum {
                true => island.immigrate(migrants),
                false => {
                    island.inject_all(migrants.iter().map(|one| &one.draft), problem, deadline)
                }
            }
        });
    }

    /// Starts every island with drafts from elsewhere, over the dataset's columns.
    pub fn inject(&mut self, drafts: &[Draft]) {
        self.inject_until(drafts, &Deadline::NEVER);
    }

    /// [`Search::inject`] of the first drafts, as many as the deadline leaves time for.
    pub fn inject_until(&mut self, drafts: &[Draft], deadline: &Deadline) {
        let children: Vec<Draft> =
            drafts.iter().map(|draft| self.problem.searched_child(draft)).collect();
        self.inject_children(&children, deadline);
    }

    fn inject_children(&mut self, children: &[Draft], deadline: &Deadline) {
        let (problem, islands) = (&*self.problem, self.state.islands.par_iter_mut());
        islands.for_each(|island| island.inject_all(children, problem, deadline));
        self.barrier(deadline);
    }
}
