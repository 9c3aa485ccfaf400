//! Samples that follow a search: the schedule by which a mesh is refined between generations.

use crate::dataset::Dataset;
use crate::deadline::Deadline;
use crate::fit::Measure;
use crate::search::{Front, FrontMember, ScoredIncumbent, Search, SetupError, Work, integrate};
use crate::truth::{Error, Mesh, Norm, Tile, Truth};
use serde::{Deserialize, Serialize};
use std::time::Instant;

/// The generation after which samples are chosen anew first; from then on whenever the number of
/// generations has doubled. By hand: before, there is no front worth following; later, formulas
/// change less and less, and all must be fitted again each time.
const FIRST: u64 = 8;

/// The refinements at a time, each of which halves tiles once: what is narrow is soon reached. By
/// hand.
const ROUNDS: usize = 4;

/// The most of the time that is left that evaluating the truth may take at a time. By hand.
const SHARE_OF_TIME: u32 = 8;

/// The least number of evaluations of the truth that integrating errors may take; it may also take
/// as many as the dataset did. By hand: enough for error bars of less than a percent.
const EVALUATIONS: usize = 6000;

/// The state of what follows a search, for a checkpoint.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Followed {
    tiles: Vec<Tile>,
    next: u64,
    has_begun: bool,
}

impl Followed {
    /// Returns true if the search was not on the dataset's own samples any more.
    pub(super) fn has_begun(&self) -> bool {
        self.has_begun
    }
}

/// A mesh that follows a search.
#[derive(Clone, Debug)]
pub(super) struct Following {
    pub mesh: Mesh,
    /// The generation after which it is refined next.
    next: u64,
    /// True if the search goes on with the mesh's samples already.
    has_begun: bool,
    /// The evaluations of the truth that integrating errors at the end may take.
    evaluations: usize,
}

/// The reason why samples follow a search no longer.
#[derive(Debug, thiserror::Error)]
#[allow(missing_docs, reason = "each message names its fields")]
pub enum FollowError {
    #[error("the samples stay as they are: {0}")]
    Truth(#[from] Error),
    #[error("the samples stay as they are: {0}")]
    Setup(#[from] SetupError),
    #[error("the samples stay as they are: to choose others takes more time than there is")]
    Time,
    #[error("the samples of the run that is resumed do not cover the domain")]
    Damaged,
}

impl Following {
    /// Follows a search that has not begun.
    pub fn new(truth: Truth, dataset: &Dataset) -> Following {
        Following {
            mesh: Mesh::new(truth, dataset.search.rows()),
            next: FIRST,
            has_begun: false,
            evaluations: (dataset.search.rows() + dataset.validation.rows()).max(EVALUATIONS),
        }
    }

    /// Follows none: samples stay as they are, and only the errors at the end are integrated.
    pub fn never(truth: Truth, dataset: &Dataset) -> Following {
        Following { next: u64::MAX, ..Following::new(truth, dataset) }
    }

    /// Goes on to follow one, with the samples that it had.
    pub fn resumed(
        truth: Truth,
        followed: Followed,
        search: &mut Search,
    ) -> Result<Following, FollowError> {
        let Followed { tiles, next, has_begun } = followed;
        let new = Following::new(truth.clone(), search.problem().dataset());
        let rows = search.problem().dataset().search.rows();
        let mesh = Mesh::of_tiles(truth, rows, tiles).ok_or(FollowError::Damaged)?;
        // A record may be damaged: 0 would never double.
        let next = next.max(FIRST);
        let mut following = Following { mesh, next, has_begun, ..new };
        if has_begun {
            following.mesh.sample(&|| false)?;
            search.sample_on(following.mesh.rows())?;
        }
        Ok(following)
    }

    pub fn followed(&self) -> Followed {
        let (next, has_begun) = (self.next, self.has_begun);
        Followed { tiles: self.mesh.tiles().to_vec(), next, has_begun }
    }

    /// Estimates the seconds that integrating errors takes, by the time of a few evaluations.
    pub fn integrating_takes(&self) -> f64 {
        let (start, few) = (Instant::now(), 8);
        for index in 0..few {
            let place = (f64::from(index) + 0.5) / f64::from(few);
            let axes = self.mesh.truth().axes();
            let point: Vec<f64> = axes.iter().map(|axis| axis.inside(place).into()).collect();
            // What it cannot evaluate takes time, too.
            let _ = self.mesh.truth().at(&point);
        }
        let each = start.elapsed().as_secs_f64() / f64::from(few);
        each * self.evaluations as f64 / rayon::current_num_threads() as f64
    }

    /// Returns true if samples are to be chosen before the next generation.
    pub fn is_due(&self, search: &Search) -> bool {
        search.generation() >= self.next && !search.archive().members().is_empty()
    }

    /// Chooses samples by the errors of the search's archive, and lets the search go on with them;
    /// or, for good, with those that it has, if these cannot be had.
    pub fn follow(&mut self, search: &mut Search, deadline: &Deadline) -> Result<(), FollowError> {
        let before = self.mesh.clone();
        let chosen = self.choose(search, deadline);
        if chosen.is_err() {
            (self.mesh, self.next) = (before, u64::MAX);
            return chosen;
        }
        self.has_begun = true;
        search.judge_anew(&deadline.moment_alone());
        while self.next <= search.generation() && self.next < u64::MAX {
            self.next = self.next.saturating_mul(2);
        }
        Ok(())
    }

    fn choose(&mut self, search: &mut Search, deadline: &Deadline) -> Result<(), FollowError> {
        let share = deadline.left().map(|left| deadline.within(left / SHARE_OF_TIME));
        let limit = share.unwrap_or_else(|| deadline.clone()).moment_alone();
        let norm = norm(search.problem().goal().measure);
        self.sample(&limit)?;
        for _ in 0..ROUNDS {
            let squares = search.squares(&self.mesh.rows());
            if self.mesh.refine(&squares, norm) == 0 {
                break;
            }
            self.sample(&limit)?;
        }
        Ok(search.sample_on(self.mesh.rows())?)
    }

    /// Integrates the errors of the formulas of both fronts and of published ones over the domain,
    /// and drops those that turn out to be dominated.
    pub fn integrate(
        &self,
        front: &mut Front,
        minimax: &mut Front,
        published: &mut [ScoredIncumbent],
        work: &Work,
    ) -> Result<(), FollowError> {
        let mut members: Vec<&mut FrontMember> = front.members.iter_mut().collect();
        members.extend(&mut minimax.members);
        // The front is the same whatever is published.
        let deciding = members.len();
        members.extend(published.iter_mut().map(|known| &mut known.member));
        let limit = &work.deadline;
        if integrate(&mut members, deciding, &self.mesh, self.evaluations, &|| limit.is_past())? {
            for front in [front, minimax] {
                *front = Front::from_members(std::mem::take(&mut front.members), front.measure);
            }
        }
        Ok(())
    }

    fn sample(&mut self, limit: &Deadline) -> Result<(), FollowError> {
        match self.mesh.sample(&|| limit.is_past())? {
            true => Ok(()),
            false => Err(FollowError::Time),
        }
    }
}

/// Returns what is made small of errors in a measure.
pub(super) fn norm(measure: Measure) -> Norm {
    if measure == Measure::Max { Norm::Largest } else { Norm::Mean }
}
