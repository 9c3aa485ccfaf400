//! Runs: a search under way, the record of it, and the folder that keeps both.
//!
//! A [`Session`] does all that `lgp search` does but read arguments and print: budget, start, stopping rule,
//! checkpoints, both fronts. What it leaves behind is an [`Outcome`]. A [`Folder`] keeps it; nothing else knows
//! the names and formats of its files, and each is read where it is written.

mod census;
mod checkpoint;
mod checks;
mod error;
mod folder;
mod improvement;
mod journal;
mod member;
mod merge;
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
pub use member::MemberRecord;
pub use merge::{Incompatible, merge};
pub use record::{Budget, Run};
pub use session::{Outcome, Phase, Progress, Session};
pub use snippet::{domains, half_snippet, header, seeds, snippet};
pub use subject::{Subject, SubjectError, noted};
pub use timetable::Timetable;
pub use trace::{TRACE_COSTS, Trace, TracePoint, trace_csv};
