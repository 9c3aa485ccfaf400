//! Why a page or a picture was not made.

use super::plot::PlotError;
use crate::grammar::FileError;
use crate::run::{RecordError, SubjectError};

/// A page or a picture that was not made.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The run's folder, or what is written into it.
    #[error(transparent)]
    Record(#[from] RecordError),
    /// The data.
    #[error(transparent)]
    Subject(#[from] SubjectError),
    /// A GPU profile.
    #[error(transparent)]
    File(#[from] FileError),
    /// A picture.
    #[error(transparent)]
    Plot(#[from] PlotError),
    /// Columns of which no sphere is known, or samples that do not tell the truth in between.
    #[error("{run}: {reason}")]
    NoSphere { run: String, reason: String },
    /// Without the dataset there is nothing to measure on.
    #[error("formulas are timed on the dataset, which is not there")]
    NoData,
    /// No runs.
    #[error("there are no runs to compare")]
    NothingToCompare,
    /// Runs that are not of one problem.
    #[error("{one}: of another {what} than {other}; compare runs of one search problem")]
    Incomparable { one: String, other: String, what: &'static str },
}
