//! Errors of reading and writing a run's folder.

use std::path::PathBuf;

/// A run's folder that cannot be read or written.
#[derive(Debug, thiserror::Error)]
#[allow(missing_docs, reason = "each message names its fields")]
pub enum RecordError {
    #[error("{path}: cannot be read: {reason}")]
    Unreadable { path: PathBuf, reason: std::io::Error },
    #[error("{path}: cannot be written: {reason}")]
    Unwritable { path: PathBuf, reason: std::io::Error },
    #[error(
        "{path}, line {line}: {reason}; the folder is not one that `lgp search` wrote, or was damaged"
    )]
    Damaged { path: PathBuf, line: usize, reason: String },
    #[error("{path}: {reason}")]
    Checkpoint { path: PathBuf, reason: String },
    #[error("{path}: no such folder; give one that `lgp search` wrote", path = path.display())]
    NoFolder { path: PathBuf },
    #[error(
        "{path}: holds no whole run (run.ron and front.json); give a folder that `lgp search` or `lgp merge` wrote (a search that was killed at once has left nothing: start it anew)",
        path = path.display()
    )]
    NoRun { path: PathBuf },
    #[error(
        "{path}: holds no whole run: the search in it was killed or has not ended; go on with it by `lgp search --resume --out {path}`",
        path = path.display()
    )]
    Unfinished { path: PathBuf },
    #[error(
        "{path}: not the file that run.ron was written with: it was changed, or a search has just ended and exchanged it; try again, or make it anew by `lgp search --resume`",
        path = path.display()
    )]
    OfAnotherRun { path: PathBuf },
    #[error(
        "{path}: in use by {owner}; wait until that is done, or choose another folder",
        path = path.display()
    )]
    Busy { path: PathBuf, owner: String },
}
