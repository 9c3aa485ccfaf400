//! A search under way, with its budget: from its start to both fronts.

use super::following::Following;
use super::improvement::Improvement;
use super::journal::Journal;
use super::record::machine;
use super::{
    Budget, Checkpoint, Folder, FollowError, Followed, Outcome, Phase, Progress, RecordError, Run,
    Timetable, TracePoint,
};
use crate::deadline::{Deadline, Stop};
use crate::fit::Measure;
use crate::program::{Draft, Names, ParseError, Scope, Template, parse_template};
use crate::scene::Scene;
use crate::search::{
    Enumeration, Front, Method, Problem, ScoredIncumbent, Search, SetupError, Work,
};
use crate::truth::Truth;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// The longest time between two reports of a generation. By hand, unmeasured.
const PAUSE: Duration = Duration::from_secs(1);

/// The time between checkpoints: what a killed search loses. By hand, unmeasured.
const CHECKPOINT_INTERVAL: Duration = Duration::from_secs(15);

/// The most structures that are enumerated if all formulas up to some cost were asked for: a few
/// minutes.
const MAX_ENUMERATED: usize = 200_000;

/// A search under way, up to its outcome.
///
/// ```
/// use lgp::dataset::{Dataset, axis};
/// use lgp::run::{Budget, Session};
/// use lgp::search::{Method, Problem};
///
/// let schlick = |[v_dot_h]: [f64; 1]| [(1.0 - v_dot_h).powi(5)];
/// let data = Dataset::sampled([axis("v_dot_h", 0.0..=1.0)], ["weight"], schlick)?;
/// let problem = Problem::of(data).max_cost(8.0).build()?;
/// let mut session = Session::new(problem, Method { islands: 2, ..Method::default() })?
///     .budget(Budget { generations: Some(5), ..Budget::default() });
/// let outcome = session.run(|progress| eprintln!("{:.0} s", progress.point.seconds))?;
/// assert!(outcome.front.members.iter().any(|member| member.cost <= 3.0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Session {
    search: Search,
    run: Run,
    guesses: Vec<Draft>,
    start: Instant,
    stop: Stop,
    /// Seconds that the run took before it was resumed.
    before: f64,
    /// Set at the first step.
    times: Option<Timetable>,
    /// Set if there is no budget.
    improvement: Option<Improvement>,
    is_over: bool,
    journal: Journal,
    kept: Option<Kept>,
    warning: Option<RecordError>,
    /// The samples of a resumed run, before their truth is known.
    followed: Option<Followed>,
    following: Option<Following>,
    /// Formulas to compare with.
    published: Vec<ScoredIncumbent>,
    follow_error: Option<FollowError>,
}

/// The folder that a session is written to.
#[derive(Debug)]
struct Kept {
    folder: Folder,
    /// True if the folder still holds another run, which this one is to replace.
    replaces: bool,
    last_checkpoint: Instant,
}

impl Session {
    /// Returns a search that has not begun, without a budget: it goes on until little improves.
    ///
    /// # Errors
    /// [`SetupError::Method`].
    pub fn new(problem: impl Into<Arc<Problem>>, method: Method) -> Result<Session, SetupError> {
        let problem = problem.into();
        let run = Run::of(&problem, &method);
        let search = Search::new(problem, method)?;
        Ok(Session::with(search, run, Journal::default()))
    }

    /// Resumes a search from a checkpoint. One that was killed before its first candidate begins
    /// again.
    ///
    /// # Errors
    /// [`SetupError::State`]: no search of this problem reaches the checkpoint's state.
    pub fn resume(
        problem: impl Into<Arc<Problem>>,
        checkpoint: Checkpoint,
    ) -> Result<Session, SetupError> {
        let problem = problem.into();
        let Checkpoint { mut run, state, trace, census, followed } = checkpoint;
        (run.threads, run.machine) = (rayon::current_num_threads(), machine());
        let method = run.method.clone();
        if state.counts().considered == 0 {
            run.seconds = 0.0;
            let search = Search::new(problem, method)?;
            return Ok(Session::with(search, run, Journal::default()));
        }
        let search = Search::resume(problem, method, state)?;
        let before = run.seconds;
        let session = Session::with(search, run, Journal::resumed(trace, census));
        Ok(Session { before, followed, ..session })
    }

    fn with(search: Search, run: Run, journal: Journal) -> Session {
        Session {
            search,
            run,
            guesses: Vec::new(),
            start: Instant::now(),
            stop: Stop::default(),
            before: 0.0,
            times: None,
            improvement: None,
            is_over: false,
            journal,
            kept: None,
            warning: None,
            followed: None,
            following: None,
            published: Vec::new(),
            follow_error: None,
        }
    }

    /// Sets the limits of the whole run.
    pub fn budget(mut self, budget: Budget) -> Session {
        self.run.budget = budget;
        self
    }

    /// Adds formulas to start from, as [`guess`] reads them.
    ///
    /// # Errors
    /// The first formula that cannot be parsed.
    pub fn guesses(mut self, texts: &[String]) -> Result<Session, ParseError> {
        let problem = self.search.problem();
        let names = problem.dataset().names();
        let read = |text: &String| guess(text, &names, problem.template());
        self.guesses = texts.iter().map(read).collect::<Result<_, ParseError>>()?;
        self.run.guesses = texts.to_vec();
        Ok(self)
    }

    /// Tries all formulas of at most so many cycles first.
    pub fn exhaustive(mut self, cycles: Option<f64>) -> Session {
        self.run.exhaustive = cycles;
        self
    }

    /// Records that the samples stay as they are, whatever they are samples of.
    pub fn fixed_samples(mut self, fixed: bool) -> Session {
        self.run.fixed_samples = fixed;
        self
    }

    /// Records the outputs that were computed of the dataset's columns.
    pub fn derived(mut self, derived: &[String]) -> Session {
        self.run.derived = derived.to_vec();
        self
    }

    /// Records where the data came from: a file, its hash, the scene that it was cut to.
    pub fn of_file(mut self, path: PathBuf, hash: String, scene: Option<Scene>) -> Session {
        (self.run.dataset, self.run.dataset_hash, self.run.scene) = (path, hash, scene);
        self
    }

    /// Records the name that the GPU profile was asked for by, and the command.
    pub fn asked_by(mut self, gpu: &str, command: Vec<String>) -> Session {
        (self.run.gpu, self.run.command) = (gpu.to_owned(), command);
        self
    }

    /// Lets the samples follow the search: they are chosen anew, now and then, where the formulas
    /// of its archive err most. The truth has the dataset's columns. Nothing follows a search by
    /// weights that somebody gave.
    ///
    /// # Errors
    /// If the samples that a resumed run had cannot be made again.
    pub fn following(mut self, truth: Truth) -> Result<Session, FollowError> {
        let problem = self.search.problem();
        if !problem.may_be_sampled_elsewhere() {
            return Ok(self);
        }
        if self.run.fixed_samples {
            self.following = Some(Following::never(truth, problem.dataset()));
            return Ok(self);
        }
        self.following = Some(match self.followed.take() {
            Some(followed) => Following::resumed(truth, followed, &mut self.search)?,
            None => Following::new(truth, problem.dataset()),
        });
        Ok(self)
    }

    /// Measures published formulas as those that are found, for [`Outcome::published`].
    pub fn compared_with(mut self, published: Vec<ScoredIncumbent>) -> Session {
        self.published = published;
        self
    }

    /// Writes checkpoints to this folder; `replaces` says that it holds a run to replace.
    pub fn kept_in(mut self, folder: Folder, replaces: bool) -> Session {
        self.kept = Some(Kept { folder, replaces, last_checkpoint: Instant::now() });
        self
    }

    /// Counts the budget's time from here.
    pub fn since(mut self, start: Instant) -> Session {
        self.start = start;
        self
    }

    /// Ends early on request: the first ends the search, the second what follows it.
    pub fn until_asked(mut self, stop: &Stop) -> Session {
        self.stop = stop.clone();
        self
    }

    /// Returns the search.
    pub fn search(&self) -> &Search {
        &self.search
    }

    /// Returns the record, as it was when something was last written.
    pub fn record(&self) -> &Run {
        &self.run
    }

    /// Returns the folder that it is written to.
    pub fn folder(&self) -> Option<&Path> {
        self.kept.as_ref().map(|kept| kept.folder.path())
    }

    /// Returns, once, why the last checkpoint could not be written. The search goes on all the
    /// same, since its end may still be written.
    pub fn take_warning(&mut self) -> Option<RecordError> {
        self.warning.take()
    }

    /// Returns, once, why the samples follow the search no longer.
    pub fn take_follow_error(&mut self) -> Option<FollowError> {
        self.follow_error.take()
    }

    /// Returns the time that is left for what is made of the outcome.
    pub fn time_left(&self) -> Deadline {
        self.times.as_ref().map_or(Deadline::NEVER, Timetable::writing)
    }

    /// Enumerates, and takes the guesses in: the first part of the first step, unless it is done.
    ///
    /// # Errors
    /// [`SetupError::TooMany`], if all formulas up to some cost were asked for.
    pub fn begin(&mut self) -> Result<(), SetupError> {
        if self.times.is_some() {
            return Ok(());
        }
        let data = self.search.problem().dataset();
        let rows = data.search.rows() + data.validation.rows();
        let left = |time: f64| Duration::from_secs_f64((time - self.before).max(0.0));
        let time = self.run.budget.time().map(left);
        let mut times = Timetable::new(self.start, time, rows, &self.stop);
        if let Some(following) = self.following.as_ref().filter(|_| time.is_some()) {
            times.integrating_takes(following.integrating_takes());
        }
        self.improvement = (self.run.budget == Budget::default()).then(Improvement::default);
        let (starting, searching) = (times.starting(), times.search());
        self.times = Some(times);
        if self.before > 0.0 {
            if self.followed.take().is_some_and(|followed| followed.has_begun()) {
                // Without the truth it goes on with the dataset's own rows.
                self.search.judge_anew(&searching.moment_alone());
            }
            return Ok(());
        }
        self.checkpoint();
        self.search.inject_curves_until(&starting);
        let asked = self.run.exhaustive;
        let (cost, most) = asked.map_or(Enumeration::USUAL, |cost| (cost, MAX_ENUMERATED));
        self.search.enumerate_until(cost, most, &starting);
        let is_known = self.search.enumeration().is_some() || starting.is_past();
        if asked.is_some() && !is_known {
            self.times = None;
            return Err(SetupError::TooMany { cost, most });
        }
        self.search.inject_until(&self.guesses, &searching);
        Ok(())
    }

    /// Goes on for a generation, or about a second of one; returns none if the search is over.
    ///
    /// # Errors
    /// Those of [`Session::begin`].
    pub fn step(&mut self) -> Result<Option<Progress>, SetupError> {
        self.begin()?;
        let budget = self.run.budget;
        let times = self.times.as_ref().expect("it has begun");
        let deadline = times.search();
        let is_done = budget.generations.is_some_and(|n| self.search.generation() >= n);
        if self.is_over || is_done || deadline.is_past() {
            return Ok(None);
        }
        self.follow(&deadline);
        self.search.advance_until(&deadline.pausing_in(PAUSE));
        let point = TracePoint::of(&self.search, self.seconds());
        let stalled = |improvement: &mut Improvement| improvement.stalled(&point);
        self.is_over = self.improvement.as_mut().is_some_and(stalled);
        self.note(&point);
        if !self.is_over {
            self.times.as_mut().expect("it has begun").rehearse(&self.search);
        }
        let share = budget.share(point.seconds, self.search.generation());
        Ok(Some(Progress { point, measure: self.search.problem().goal().measure, share }))
    }

    /// Chooses the samples anew, if that is due.
    fn follow(&mut self, deadline: &Deadline) {
        let due = |following: &&mut Following| following.is_due(&self.search);
        let Some(following) = self.following.as_mut().filter(due) else { return };
        if let Err(error) = following.follow(&mut self.search, deadline) {
            self.follow_error = Some(error);
        }
        if let Some(improvement) = &mut self.improvement {
            improvement.compare_with(self.search.hypervolume());
        }
    }

    /// Notes the state; writes a checkpoint now and then.
    fn note(&mut self, point: &TracePoint) {
        let names = self.run.names();
        self.journal.note(point, &self.search, &names);
        let due = |kept: &Kept| kept.last_checkpoint.elapsed() >= CHECKPOINT_INTERVAL;
        if self.kept.as_ref().is_some_and(due) {
            self.checkpoint();
        }
    }

    /// Brings the record up to date.
    fn bring_up_to_date(&mut self) {
        let search = &self.search;
        self.run.generations = search.generation();
        self.run.counts = search.counts();
        self.run.enumeration = search.enumeration();
        self.run.seconds = self.seconds();
    }

    /// Returns the seconds of the whole run.
    fn seconds(&self) -> f64 {
        self.before + self.times.as_ref().map_or(0.0, Timetable::seconds)
    }

    /// Writes what [`Session::resume`] needs, or notes a warning.
    fn checkpoint(&mut self) {
        self.bring_up_to_date();
        if let Err(error) = self.write_checkpoint() {
            self.warning = Some(error);
        }
    }

    fn write_checkpoint(&mut self) -> Result<(), RecordError> {
        let Some(kept) = &mut self.kept else { return Ok(()) };
        kept.last_checkpoint = Instant::now();
        let trace = self.journal.trace(self.run.goal.measure);
        let state = self.search.state();
        let followed = self.following.as_ref().map(Following::followed);
        let census = &self.journal.census;
        let bytes = Checkpoint::bytes(&self.run, state, &trace, census, followed.as_ref());
        if kept.replaces {
            kept.folder.begin_anew(&bytes)?;
            kept.replaces = false;
            return Ok(());
        }
        kept.folder.checkpoint(&bytes)
    }

    /// Returns both fronts, polished and judged as well as time permits. `hear` is called from any
    /// thread with each phase's progress, and with `None` when it is over.
    pub fn finish(&mut self, hear: &(dyn Fn(Phase, Option<f64>) + Sync)) -> Outcome {
        self.bring_up_to_date();
        let end = TracePoint::of(&self.search, self.run.seconds);
        self.journal.note_the_end(&end, &self.search, &self.run.names());
        let mut times =
            self.times.take().unwrap_or_else(|| Timetable::new(self.start, None, 0, &self.stop));
        times.begin_finishing();
        let search = &self.search;
        let mut front =
            heard(hear, Phase::Polish, times.polishing(), |work| Front::polished(search, work));
        let mut minimax = heard(hear, Phase::PolishForMaximum, times.polishing(), |work| {
            Front::polished_in(search, Measure::Max, &front, work)
        });
        let mut published = self.published.clone();
        if let Some(following) = &self.following {
            heard(hear, Phase::Integrate, times.integrating(), |work| {
                let integrated =
                    following.integrate(&mut front, &mut minimax, &mut published, work);
                self.follow_error = integrated.err();
            });
        }
        let (questions, names) = (search.problem().questions(), search.problem().dataset().names());
        heard(hear, Phase::Prove, times.judging(), |work| {
            front.judge_until(&questions, &names, &|| work.deadline.is_past());
        });
        if front.measure == minimax.measure {
            minimax.clone_from(&front);
        } else {
            heard(hear, Phase::ProveForMaximum, times.judging(), |work| {
                minimax.judge_until(&questions, &names, &|| work.deadline.is_past());
            });
        }
        self.times = Some(times);
        Outcome {
            run: self.run.clone(),
            front,
            minimax,
            published,
            trace: self.journal.trace(self.run.goal.measure),
            census: self.journal.census.clone(),
            archived: self.search.archive().members().len(),
        }
    }

    /// Steps until the budget is spent, and finishes.
    ///
    /// # Errors
    /// Those of [`Session::step`].
    pub fn run(&mut self, mut hear: impl FnMut(&Progress)) -> Result<Outcome, SetupError> {
        while let Some(progress) = self.step()? {
            hear(&progress);
        }
        Ok(self.finish(&|_, _| {}))
    }

    /// Writes the outcome, and files that were made of it, in place of what its folder holds.
    ///
    /// # Errors
    /// [`RecordError::Unwritable`]: as [`Folder::exchange`], or of the last checkpoint, if all else
    /// is written.
    pub fn write(
        &mut self,
        outcome: &Outcome,
        made_of_it: Vec<(String, Vec<u8>)>,
    ) -> Result<(), RecordError> {
        let checkpointed = self.write_checkpoint();
        if let Some(kept) = &self.kept {
            kept.folder.exchange(&outcome.run, &[outcome.files(), made_of_it].concat())?;
        }
        checkpointed
    }
}

/// Parses a formula to start from: over the dataset's columns, its free constants starting at 1; or,
/// if there is a template, one of its holes or several ([`Template::guess`]).
///
/// # Errors
/// Text that is no such formula.
pub fn guess(text: &str, names: &Names, template: Option<&Template>) -> Result<Draft, ParseError> {
    match template {
        Some(template) => template.guess(text),
        None => Ok(parse_template(text, Scope::Dataset(names))?.program.into_draft()),
    }
}

fn heard<T>(
    hear: &(dyn Fn(Phase, Option<f64>) + Sync),
    phase: Phase,
    deadline: Deadline,
    job: impl FnOnce(&Work) -> T,
) -> T {
    hear(phase, Some(0.0));
    let done = job(&Work { deadline, progress: &|share| hear(phase, Some(share)) });
    hear(phase, None);
    done
}
