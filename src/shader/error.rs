//! The reasons why a shader cannot be a truth.

use std::path::PathBuf;

/// The reason why a shader cannot be a truth.
#[allow(missing_docs, reason = "each message names its fields")]
#[derive(Debug, thiserror::Error)]
pub enum Error {
    #[error("{path}: cannot be read: {source}", path = path.display())]
    Unread { path: PathBuf, source: std::io::Error },
    /// Text that is not understood.
    #[error("{path}, line {line}, column {column}: {message}\n{excerpt}", path = path.display())]
    At { path: PathBuf, line: usize, column: usize, message: String, excerpt: String },
    #[error("{path}: {message}", path = path.display())]
    Whole { path: PathBuf, message: String },
    #[error("--let {0}")]
    Let(String),
    #[error("--set {0}")]
    Set(String),
    #[error(transparent)]
    Truth(#[from] crate::truth::Error),
}
