//! The search: islands of programs, varied, costed, fitted, and kept where they are best.
//!
//! Each generation every island considers a fixed number of candidates on a random stream of its
//! own (seed, island, generation); archives are merged and migrants exchanged only between
//! generations, in the islands' order. So the number of threads changes nothing but the time.
//!
//! Islands differ in the cycles that a formula may cost there, and in who competes: on some only formulas
//! with the same families of operations, so that a root or an exponential, dear at first, can grow. Where the
//! maximum error is to be small, it decides in the archive, and on every fourth island; on the others RMSE
//! does, which is found out sooner.

mod census;
mod checkpoint;
mod enumerate;
mod finish;
mod folder;
mod front;
mod island;
mod loaded;
mod merge;
mod polish;
mod population;
mod problem;
mod record;
mod require;
mod rounding;
mod scales;
mod timetable;
mod transform;
mod vary;

pub use census::{Census, Recurring};
pub use checkpoint::Checkpoint;
pub use enumerate::Enumeration;
pub use finish::{Rehearsal, Work};
pub use folder::{
    CENSUS, CHECKPOINT, FRONT, Holding, MINIMAX_FRONT, RunFolder, TRACE, in_the_way, load_front,
    load_run, load_text,
};
pub use front::{Front, FrontMember};
pub use loaded::{MOST_CYCLES, MOST_ISLANDS};
pub use merge::{Incompatible, merge};
pub use problem::Problem;
pub use record::{Budget, MemberRecord, RecordError, Run, TRACE_COSTS, TracePoint, trace_csv};
pub use require::Requirement;
pub use timetable::Timetable;
pub use transform::Transform;

use crate::archive::Archive;
use crate::deadline::Deadline;
use crate::fit::Measure;
use crate::program::{Constants, Draft, structural_hash};
use island::Island;
use population::Individual;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::collections::HashSet;
use std::time::Duration;

/// What decides the course of a search, given its problem.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Settings {
    pub seed: u64,
    /// Populations that evolve apart; not the number of threads.
    pub islands: usize,
    /// Candidates that an island with the whole cost budget considers in a generation; one with less
    /// considers more, up to a hundred times as many.
    pub candidates: usize,
    /// The share of candidates that are random rather than children; all of them make it a search by
    /// random restarts and fitting, to compare with.
    pub immigrants: f64,
    /// Individuals that an island keeps at each cost.
    pub bucket_size: usize,
    /// Cycles that a candidate may cost at most.
    pub max_cost: f64,
    /// Generations between migrations.
    pub migration_interval: u64,
    /// Samples on which candidates race; all of them where there are fewer.
    pub subset: usize,
    /// What is made small.
    pub measure: Measure,
    /// What every formula must be.
    pub requirements: Vec<Requirement>,
    /// By output: the function of it that is searched for; where there are fewer, the output itself.
    pub transforms: Vec<Option<Transform>>,
}

impl Default for Settings {
    fn default() -> Settings {
        Settings {
            seed: 1,
            islands: 8,
            candidates: 400,
            immigrants: 0.0,
            bucket_size: 3,
            max_cost: 40.0,
            migration_interval: 20,
            subset: 256,
            measure: Measure::Rmse,
            requirements: Vec::new(),
            transforms: Vec::new(),
        }
    }
}

/// By rising cost, those whose error is less than `within` times that of every cheaper one.
fn near_the_least<T>(
    mut all: Vec<T>,
    within: f64,
    cost_and_error: impl Fn(&T) -> (f64, f64),
) -> Vec<T> {
    let order = |(cost, error): (f64, f64), (other_cost, other_error): (f64, f64)| {
        cost.total_cmp(&other_cost).then(error.total_cmp(&other_error))
    };
    all.sort_by(|a, b| order(cost_and_error(a), cost_and_error(b)));
    let mut least = f64::INFINITY;
    all.retain(|one| {
        let (_, error) = cost_and_error(one);
        let near = error < least * within;
        least = least.min(error);
        near
    });
    all
}

/// For so long an island goes on before others have their turn: where a generation lasts long, none waits
/// until there is no time left.
const TURN: Duration = Duration::from_millis(100);

/// In mean square, how much worse than the archive's a contender may be.
const CONTENDING: f64 = 4.0;

/// Where the maximum error was searched for, the archive's losses are its squares: how much larger a
/// contender's may be, and how much of them its mean of squares, where that is its loss.
const CONTENDING_BY_MAXIMUM: f64 = 1.5;
const CONTENDING_BY_MEAN: f64 = 0.3;

/// What became of the candidates; each is counted once under `considered` and where it ended.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Counts {
    pub considered: u64,
    /// More instructions than the grammar allows, or constants that are not finite.
    pub too_long: u64,
    /// Out of the cost budget.
    pub too_dear: u64,
    /// Of a structure that was fitted before.
    pub seen: u64,
    /// Not built as required, or nested deeper than the grammar allows.
    pub inadmissible: u64,
    /// Constants fitted on the subset: the sum of the following five.
    pub fitted: u64,
    pub not_finite: u64,
    /// Given up after the first steps of fitting.
    pub hopeless: u64,
    pub no_better: u64,
    /// Good enough, its values not as required.
    pub unfulfilled: u64,
    pub admitted: u64,
    /// Of those admitted, the ones fitted on all samples, since the archive may want them.
    pub fitted_on_all: u64,
}

/// Where a candidate ended that was not admitted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Fate {
    TooLong,
    TooDear,
    Seen,
    Inadmissible,
    NotFinite,
    Hopeless,
    NoBetter,
    Unfulfilled,
}

impl Counts {
    fn note(&mut self, fate: Fate) {
        *match fate {
            Fate::TooLong => &mut self.too_long,
            Fate::TooDear => &mut self.too_dear,
            Fate::Seen => &mut self.seen,
            Fate::Inadmissible => &mut self.inadmissible,
            Fate::NotFinite => &mut self.not_finite,
            Fate::Hopeless => &mut self.hopeless,
            Fate::NoBetter => &mut self.no_better,
            Fate::Unfulfilled => &mut self.unfulfilled,
        } += 1;
    }

    fn add(&mut self, other: &Counts) {
        self.considered += other.considered;
        self.too_long += other.too_long;
        self.too_dear += other.too_dear;
        self.seen += other.seen;
        self.fitted += other.fitted;
        self.not_finite += other.not_finite;
        self.hopeless += other.hopeless;
        self.no_better += other.no_better;
        self.inadmissible += other.inadmissible;
        self.unfulfilled += other.unfulfilled;
        self.admitted += other.admitted;
        self.fitted_on_all += other.fitted_on_all;
    }
}

/// A search under way; what is needed to go on with it, and nothing else.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Search {
    settings: Settings,
    generation: u64,
    islands: Vec<Island>,
    archive: Archive,
    enumeration: Option<Enumeration>,
}

impl Search {
    pub fn new(settings: Settings) -> Search {
        let islands = (0..settings.islands).map(|i| Island::new(i, &settings)).collect();
        Search { settings, generation: 0, islands, archive: Archive::default(), enumeration: None }
    }

    /// Generations that are done.
    pub fn generation(&self) -> u64 {
        self.generation
    }

    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// The best found so far, on the whole search split; [`Problem::natural`] makes formulas of its drafts, and
    /// [`Problem::error`] errors of its losses.
    pub fn archive(&self) -> &Archive {
        &self.archive
    }

    /// The islands' individuals of structures that the archive has left out, so far as they
    /// are not much worse than its own.
    fn contenders(&self) -> Vec<&Draft> {
        let archive = self.archive();
        let mut hashes = Vec::new();
        let mut structure = |draft| structural_hash(draft, Constants::Ignored, &mut hashes);
        let mut known: HashSet<u64> =
            archive.members().iter().map(|member| structure(&member.draft)).collect();
        let mut contenders = Vec::new();
        for island in &self.islands {
            let share = match (self.settings.measure, island.by_maximum) {
                (Measure::Max, true) => CONTENDING_BY_MAXIMUM,
                (Measure::Max, false) => CONTENDING_BY_MEAN,
                _ => CONTENDING,
            };
            for one in island.population.individuals() {
                if one.loss < share * archive.best_loss(one.cost) && known.insert(one.hash) {
                    contenders.push(&one.draft);
                }
            }
        }
        contenders
    }

    /// What became of all candidates so far.
    pub fn counts(&self) -> Counts {
        let mut counts = Counts::default();
        self.islands.iter().for_each(|island| counts.add(&island.counts));
        counts
    }

    /// One generation of every island, in parallel on the current thread pool; the rest of one that
    /// was cut.
    pub fn advance(&mut self, problem: &Problem) {
        self.advance_until(problem, &Deadline::NEVER);
    }

    /// [`Search::advance`], cut at a deadline: what was found by then is kept, and the next call goes on
    /// where this one stopped, as if nothing had been. Says whether the generation is done. (Fits on many
    /// samples that a moment cuts are not done again; pauses and requests to stop cut none.)
    pub fn advance_until(&mut self, problem: &Problem, deadline: &Deadline) -> bool {
        let (settings, generation) = (&self.settings, self.generation);
        loop {
            let done = self.islands.par_iter_mut().enumerate().map(|(i, island)| {
                let stream = generation * settings.islands as u64 + i as u64;
                island.generation(problem, settings, stream, &deadline.pausing_in(TURN))
            });
            if done.reduce(|| true, |a, b| a && b) {
                break;
            }
            if deadline.is_past() {
                self.islands.iter().for_each(|island| self.archive.merge(&island.archive));
                return false;
            }
        }
        self.islands.iter_mut().for_each(Island::end_generation);
        self.generation += 1;
        self.barrier(problem, &deadline.moment_alone());
        true
    }

    /// What islands learn of each other.
    fn barrier(&mut self, problem: &Problem, deadline: &Deadline) {
        for island in &self.islands {
            self.archive.merge(&island.archive);
        }
        for island in &mut self.islands {
            island.archive.clone_from(&self.archive);
        }
        if self.generation.is_multiple_of(self.settings.migration_interval) {
            self.migrate(problem, deadline);
        }
    }

    /// Each island's best go on to the next. Where that goes by another error, as drafts.
    fn migrate(&mut self, problem: &Problem, deadline: &Deadline) {
        let elites =
            |island: &Island| (island.by_maximum, island.population.elites().cloned().collect());
        let mut arriving: Vec<(bool, Vec<Individual>)> = self.islands.iter().map(elites).collect();
        arriving.rotate_right(1);
        self.islands.par_iter_mut().zip(arriving).for_each(|(island, (by_maximum, migrants))| {
            match by_maximum == island.by_maximum {
                true => island.welcome(migrants),
                false => {
                    island.settle_all(migrants.iter().map(|one| &one.draft), problem, deadline)
                }
            }
        });
    }

    /// Starts every island with drafts from elsewhere, over the dataset's columns.
    pub fn settle(&mut self, drafts: &[Draft], problem: &Problem) {
        self.settle_until(drafts, problem, &Deadline::NEVER);
    }

    /// [`Search::settle`] of the first drafts, as many as the deadline leaves time for.
    pub fn settle_until(&mut self, drafts: &[Draft], problem: &Problem, deadline: &Deadline) {
        let drafts: Vec<Draft> = drafts.iter().map(|draft| problem.over_searched(draft)).collect();
        self.settle_searched(&drafts, problem, deadline);
    }

    fn settle_searched(&mut self, drafts: &[Draft], problem: &Problem, deadline: &Deadline) {
        let islands = self.islands.par_iter_mut();
        islands.for_each(|island| island.settle_all(drafts, problem, deadline));
        self.barrier(problem, deadline);
    }
}
