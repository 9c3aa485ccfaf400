//! Runs: a search under way, its record, and the folder that keeps both.
//!
//! A [`Session`] does all of `lgp search` except reading arguments and printing: budget, start,
//! stopping rule, checkpoints, both fronts. It leaves an [`Outcome`], which a [`Folder`] keeps.
//! Only the folder knows the names and formats of its files, and each file is read where it is
//! written.
//!
//! A union of runs with different seeds:
//! ```
//! use lgp::dataset::{Dataset, axis};
//! use lgp::run::{Budget, Session, merge};
//! use lgp::search::{Method, Problem};
//! let data = Dataset::sampled([axis("x", 0.0..=1.0)], ["y"], |[x]: [f64; 1]| [x / (x + 1.0)])?;
//! let run = |seed| {
//!     let problem = Problem::of(data.clone()).max_cost(6.0).build()?;
//!     let method = Method { seed, islands: 1, ..Method::default() };
//!     let budget = Budget { generations: Some(2), ..Budget::default() };
//!     let outcome = Session::new(problem, method)?.budget(budget).run(|_| ())?;
//!     Ok::<_, Box<dyn std::error::Error>>((outcome.run, outcome.front))
//! };
//! let (union, front) = merge(vec![run(1)?, run(2)?])?.expect("two runs");
//! assert!(union.sources.len() == 2 && !front.members.is_empty());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod census;
mod checkpoint;
mod checks;
mod error;
mod folder;
mod following;
mod improvement;
mod journal;
mod member;
mod merge;
mod original;
mod outcome;
mod record;
mod session;
mod snippet;
mod subject;
mod timetable;
mod trace;

pub use census::{Census, Recurring};
pub use checkpoint::Checkpoint;
pub use error::RecordError;
pub use folder::{
    CHECKPOINT, FRONT_TABLE, Folder, Holding, front_files, in_the_way, load_front, load_run,
    load_trace,
};
pub use following::{FollowError, Followed};
pub use member::MemberRecord;
pub use merge::{Incompatible, merge};
pub use original::ORIGINAL;
pub use outcome::{Outcome, Phase, Progress};
pub use record::{Budget, Run};
pub use session::{Session, guess};
pub use snippet::{Called, Form, Target, domains, header, one_line, seeds, snippet};
pub use subject::{Subject, SubjectError, noted};
pub use timetable::Timetable;
pub use trace::{TRACE_COSTS, Trace, TracePoint, trace_csv};
