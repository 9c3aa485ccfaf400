//! Errors of pages and pictures.

use super::plot::PlotError;
use crate::grammar::FileError;
use crate::run::{RecordError, SubjectError};

/// A page or a picture that was not made.
#[derive(Debug, thiserror::Error)]
#[allow(missing_docs, reason = "each message names its fields")]
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
    /// Columns without a known material, or samples that do not tell the truth in between.
    #[error("{run}: {reason}")]
    NoSphere { run: String, reason: String },
    /// The dataset, which formulas are timed on, is missing.
    #[error("formulas are timed on the dataset, which is not there")]
    NoData,
    /// No runs.
    #[error("there are no runs to compare")]
    NothingToCompare,
    /// Runs that are not of one problem.
    #[error("{one}: of another {what} than {other}; compare runs of one search problem")]
    Incomparable { one: String, other: String, what: &'static str },
}
