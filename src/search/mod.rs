//! The search: islands of programs that are varied, costed, fitted, and kept if they are the best.
//!
//! In a generation every island considers a fixed number of candidates on a random stream of its
//! own (seed, island, generation). Archives are merged and migrants exchanged only between
//! generations, in the islands' order, so the number of threads changes nothing but the time.
//!
//! Islands differ in the cycles that a formula may cost, and in who competes: on some, only
//! formulas with the same families of operations, so that a root or an exponential, expensive at
//! first, can grow. If the maximum error is to be small, it decides in the archive and on every
//! fourth island; on the others the RMSE decides, which is faster to fit.
//!
//! ```
//! use lgp::dataset::{Dataset, axis};
//! use lgp::search::{Front, Method, Problem, Search};
//!
//! let data = Dataset::sampled([axis("x", 0.0..=1.0)], ["y"], |[x]| [x * x])?;
//! let problem = Problem::of(data).max_cost(4.0).build()?;
//! let mut search = Search::new(problem, Method { islands: 2, ..Method::default() })?;
//! (0..5).for_each(|_| search.advance());
//! let front = Front::of(&search);
//! assert!(front.within(Some(4.0), Some(0.01)).is_some());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod claims;
mod common_factor;
mod curves;
mod domain;
mod enumerate;
mod finish;
mod follow;
mod front;
mod goal;
mod island;
mod loaded;
mod method;
mod polish;
mod population;
mod problem;
mod require;
mod requirement;
mod rounding;
mod scales;
mod template;
mod vary;

pub use domain::integrate;
pub use enumerate::Enumeration;
pub use finish::{Rehearsal, Work};
pub use front::{Front, FrontMember, ScoredIncumbent};
pub use goal::{CostOf, Goal, MAX_CYCLES, Transform};
pub(crate) use loaded::not_negative;
pub use method::{MAX_ISLANDS, Method};
pub use problem::{Problem, ProblemBuilder, SetupError, USUAL_GPU, USUAL_GRAMMAR};
pub use requirement::Requirement;

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

/// The longest turn of an island before the others': in a long generation none waits until no time
/// is left. Short beside one second, the shortest budget.
const TURN: Duration = Duration::from_millis(100);

/// The largest ratio of a contender's mean square to the archive's. By hand.
const CONTENDING: f64 = 4.0;

/// The largest ratios if the maximum error is to be small, so that the archive's losses are its
/// squares: of a contender's square of the maximum, and of its mean square if that is its loss.
/// Chosen by hand, unmeasured.
const CONTENDING_BY_MAXIMUM: f64 = 1.5;
const CONTENDING_BY_MEAN: f64 = 0.3;

/// The candidates by their fate; each counts under `considered` and where it ended.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Counts {
    /// All candidates.
    pub considered: u64,
    /// Those with more instructions than the grammar allows, or with constants that are not finite.
    pub too_long: u64,
    /// Those over the cost budget.
    pub too_expensive: u64,
    /// Those whose structure was fitted before.
    pub seen: u64,
    /// Those not built as required, or nested deeper than the grammar allows.
    pub inadmissible: u64,
    /// Those whose constants were fitted on the subset: the sum of the following five.
    pub fitted: u64,
    /// Those infinite or NaN on a sample.
    pub not_finite: u64,
    /// Those given up after the first steps of fitting.
    pub hopeless: u64,
    /// Those fitted but worse than the population's individuals.
    pub no_better: u64,
    /// Those good enough, but whose values are not as required.
    pub unfulfilled: u64,
    /// Those admitted to a population.
    pub admitted: u64,
    /// Those admitted that might be good enough for the archive, and so were fitted on all samples.
    pub fitted_on_all: u64,
}

/// The reason why a candidate was not admitted, as in [`Counts`].
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
        // Destructured, so that no field is forgotten.
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

/// A search for a problem's formulas, under way.
#[derive(Clone, Debug)]
pub struct Search {
    problem: Arc<Problem>,
    method: Method,
    /// The samples on which candidates race.
    race: Arc<Samples>,
    state: State,
}

/// The state of a search: with its problem and method, all that is needed to continue it.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct State {
    generation: u64,
    islands: Vec<Island>,
    archive: Archive,
    enumeration: Option<Enumeration>,
    /// The cycles of the template around what is searched: islands share what is above them.
    floor: f64,
}

impl State {
    /// Returns the number of generations done.
    pub fn generation(&self) -> u64 {
        self.generation
    }

    /// Returns the best drafts so far, judged on the whole search split.
    pub fn archive(&self) -> &Archive {
        &self.archive
    }

    /// Returns the counts of all islands' candidates so far.
    pub fn counts(&self) -> Counts {
        let mut counts = Counts::default();
        self.islands.iter().for_each(|island| counts.add(&island.counts));
        counts
    }
}

impl Search {
    /// Makes a search that has not begun.
    ///
    /// # Errors
    /// [`SetupError::Method`] if the method is invalid.
    pub fn new(problem: impl Into<Arc<Problem>>, method: Method) -> Result<Search, SetupError> {
        method.check().map_err(SetupError::Method)?;
        let problem = problem.into();
        let floor = problem.floor();
        let island = |number| Island::new(number, &problem.goal, floor, &method);
        let islands = (0..method.islands).map(island).collect();
        let archive = Archive::default();
        let state = State { generation: 0, islands, archive, enumeration: None, floor };
        Ok(Search::with(problem, method, state))
    }

    /// Makes a search that continues from the state of one with the same goal and method.
    ///
    /// # Errors
    /// [`SetupError::Method`] as for [`Search::new`]; [`SetupError::State`] if no such search can
    /// have reached the state.
    pub fn resume(
        problem: impl Into<Arc<Problem>>,
        method: Method,
        state: State,
    ) -> Result<Search, SetupError> {
        let problem = problem.into();
        method.check().map_err(SetupError::Method)?;
        state.check(&problem.goal, &method, problem.shape()).map_err(SetupError::State)?;
        if state.floor != problem.floor() {
            let reason = "its template has another cost".to_owned();
            return Err(SetupError::State(reason));
        }
        Ok(Search::with(problem, method, state))
    }

    fn with(problem: Arc<Problem>, method: Method, mut state: State) -> Search {
        let race = Arc::new(problem.race(method.subset));
        state.islands.iter_mut().for_each(|island| island.race_on(&race));
        Search { problem, method, race, state }
    }

    /// Returns the problem.
    pub fn problem(&self) -> &Arc<Problem> {
        &self.problem
    }

    /// Returns the method.
    pub fn method(&self) -> &Method {
        &self.method
    }

    /// Returns the state, from which [`Search::resume`] continues.
    pub fn state(&self) -> &State {
        &self.state
    }

    /// Returns the number of generations done.
    pub fn generation(&self) -> u64 {
        self.state.generation
    }

    /// Returns the best drafts so far, judged on the whole search split. [`Problem::formula_of`] turns
    /// them into formulas over the dataset's columns, [`Problem::error`] their losses into errors.
    pub fn archive(&self) -> &Archive {
        &self.state.archive
    }

    /// Returns the least error at no more than this cost, as [`FrontMember::search_error`] shows
    /// it; infinite if no formula is that cheap.
    pub fn best_error(&self, cost: f64) -> f64 {
        self.problem.error(self.archive().best_loss(cost))
    }

    /// Returns the archive's gain over the best constant: [`Archive::hypervolume`].
    pub fn hypervolume(&self) -> f64 {
        self.archive().hypervolume(self.problem.goal.max_cost, self.problem.constant_loss)
    }

    /// Returns the islands' individuals whose structures the archive lacks and that are not much
    /// worse than its members.
    fn contenders(&self) -> Vec<Draft> {
        let archive = self.archive();
        let mut hashes = Vec::new();
        let mut structure = |child: &Draft| {
            structural_hash(&self.problem.formula(child), Constants::Ignored, &mut hashes)
        };
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
                    contenders.push(one.draft.clone());
                }
            }
        }
        contenders
    }

    /// Returns the counts of all islands' candidates so far.
    pub fn counts(&self) -> Counts {
        self.state.counts()
    }

    /// Runs one generation of every island, or the rest of one that was cut, in parallel on the
    /// current thread pool.
    pub fn advance(&mut self) {
        self.advance_until(&Deadline::NEVER);
    }

    /// As [`Search::advance`], but stops at a deadline and keeps what it has found; the next call
    /// continues as if there had been no stop. Returns true if the generation is done. (A moment
    /// may cut a fit on many samples, which is not repeated; pauses and requests to stop cut none.)
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

    /// Merges the islands' archives and, at every interval, lets the best individuals migrate.
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

    /// Sends each island's best to the next; as drafts, to be fitted anew, if that goes by another
    /// error.
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

    /// Offers drafts from elsewhere, over the dataset's columns, to every island.
    pub fn inject(&mut self, drafts: &[Draft]) {
        self.inject_until(drafts, &Deadline::NEVER);
    }

    /// As [`Search::inject`], for as many of the first drafts as the deadline leaves time for.
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
