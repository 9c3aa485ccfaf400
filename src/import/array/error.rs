//! The reasons why an array cannot be read or used.

use super::{MOST_TEXELS, MOST_VALUES};
use crate::dataset;
use crate::printable::printable;
use std::fmt;
use std::path::{Path, PathBuf};

/// The reason why a file is no usable array.
#[derive(Debug)]
pub struct Error {
    /// The file.
    pub path: PathBuf,
    /// What is wrong with it, and what to do.
    pub fault: Fault,
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match &self.fault {
            // It names the file itself.
            Fault::Dataset(error) => error.fmt(f),
            fault => write!(f, "{}: {fault}", self.path.display()),
        }
    }
}

impl std::error::Error for Error {}

/// What is wrong with an array, and what to do.
#[allow(missing_docs, reason = "each message names its fields")]
#[derive(Debug, thiserror::Error)]
pub enum Fault {
    #[error("no such file; check the path")]
    Missing,
    #[error("cannot be read: {0}; check that the path is a file that you have access to")]
    Unread(std::io::Error),
    #[error("the file is empty; write it again")]
    Empty,
    #[error(
        "it is named as {format}, but does not begin as one; check how it was written, or rename it"
    )]
    Magic { format: &'static str },
    #[error("truncated: {found} bytes of {expected}; copy or write it again")]
    Truncated { expected: u64, found: u64 },
    #[error("{} texels of {}; at most {MOST_TEXELS} texels (4096 × 4096) and {MOST_VALUES} values are read: scale it down (a search needs thousands of texels, not millions)", times(size), counted(*channels, "channel"))]
    TooLarge { size: Vec<usize>, channels: usize },
    #[error("it has no texels (its size is {}); write it again", times(size))]
    NoTexels { size: Vec<usize> },
    #[error("{problem}; {advice}")]
    Unusable { problem: String, advice: String },
    #[error("line {line}: {problem}; {advice}")]
    Line { line: usize, problem: String, advice: String },
    #[error("{count} of its values {} not finite: channel `{}` of texel {} is {value}, the first; repair them in the file, or leave the channel out (--channels)", if *count == 1 { "is" } else { "are" }, printable(channel), place(texel))]
    NotFinite { count: usize, channel: String, texel: Vec<usize>, value: f32 },
    #[error(
        "its value number {number} is {value:e}, too large for 32-bit floats (largest: 3.4e38); scale the values"
    )]
    Overflow { number: usize, value: f64 },
    #[error("{0}")]
    Dataset(dataset::Error),
}

impl Fault {
    /// A fault without a place.
    pub(super) fn new(problem: impl Into<String>, advice: impl Into<String>) -> Fault {
        Fault::Unusable { problem: problem.into(), advice: advice.into() }
    }

    /// A fault at a line of a text, counted from 1.
    pub(super) fn at(line: usize, problem: impl Into<String>, advice: impl Into<String>) -> Fault {
        Fault::Line { line, problem: problem.into(), advice: advice.into() }
    }

    /// Adds the file.
    pub(super) fn of(self, path: &Path) -> Error {
        Error { path: path.into(), fault: self }
    }
}

/// Returns a size as in `64 × 64`.
pub(super) fn times(size: &[usize]) -> String {
    size.iter().map(usize::to_string).collect::<Vec<_>>().join(" × ")
}

/// Returns a number of things, as in `2 channels`.
pub(super) fn counted(count: usize, what: &str) -> String {
    format!("{count} {what}{}", if count == 1 { "" } else { "s" })
}

/// Returns a texel's indices as in `(3, 5)`, counted from 0.
fn place(texel: &[usize]) -> String {
    format!("({})", texel.iter().map(usize::to_string).collect::<Vec<_>>().join(", "))
}
