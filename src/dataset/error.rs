//! The reasons why a dataset cannot be used.

use super::{MAX_COLUMNS, MAX_ROWS, NameFault};
use crate::printable::printable;
use crate::program::shortest;
use std::path::{Path, PathBuf};

/// The reason why a dataset cannot be read, written or used. `path` is the file, or the dataset's
/// name where there is none; `row` counts from 1 within its split, `line` from 1 within its file.
#[allow(missing_docs, reason = "each message names its fields")]
#[derive(Debug, thiserror::Error)]
pub enum Error {
    #[error("{path}: no such file; check the path (`lgp list` shows the targets that `lgp generate` can make)", path = path.display())]
    Missing { path: PathBuf },
    #[error("{path}: cannot be {action}: {source}; check that the path is a file in a folder you have access to", path = path.display())]
    Io { path: PathBuf, action: &'static str, source: std::io::Error },
    #[error("{path}: the file is empty; generate or import it again", path = path.display())]
    Empty { path: PathBuf },
    #[error("{path}: not an lgp dataset (it does not begin with LGPDATA1); if it is a table, convert it with `lgp import`", path = path.display())]
    Magic { path: PathBuf },
    #[error("{path}: {problem}", path = path.display())]
    Claim { path: PathBuf, problem: String },
    #[error("{path}: dataset format version {found}, but this program reads versions up to {supported}; generate or import it again with this program", path = path.display())]
    Version { path: PathBuf, found: u32, supported: u32 },
    #[error("{path}: truncated: {found} bytes of {expected}; copy, generate or import it again", path = path.display())]
    Truncated { path: PathBuf, expected: u64, found: u64 },
    #[error("{path}: {extra} bytes too many at the end; copy, generate or import it again", path = path.display())]
    Trailing { path: PathBuf, extra: u64 },
    #[error("{path}: damaged: the checksum does not match the content; copy, generate or import it again", path = path.display())]
    Checksum { path: PathBuf },
    #[error("{path}: unusable header: {problem}; generate or import it again", path = path.display())]
    Header { path: PathBuf, problem: String },

    #[error("{path}: a dataset cannot be called `{}`: {fault}; rename its file and make it again", printable(name), path = path.display())]
    Name { path: PathBuf, name: String, fault: NameFault },
    #[error("{path}: {columns} columns; at most {MAX_COLUMNS} are allowed; leave some out", path = path.display())]
    TooManyColumns { path: PathBuf, columns: usize },
    #[error("{path}: the {split} split has {rows} rows; at most {MAX_ROWS} are allowed; take some of them", path = path.display())]
    TooManyRows { path: PathBuf, split: &'static str, rows: usize },
    #[error("{path}: the unit of column `{column}` is unusable: {fault}; write one such as `nm`", path = path.display())]
    Unit { path: PathBuf, column: String, fault: NameFault },
    #[error("{path}: no input columns; name at least one", path = path.display())]
    NoInputs { path: PathBuf },
    #[error("{path}: no output columns are left; make fewer columns inputs", path = path.display())]
    NoOutputs { path: PathBuf },
    #[error("{path}: the {split} split has no rows; at least one is needed", path = path.display())]
    NoRows { path: PathBuf, split: &'static str },
    #[error("{path}{}: column name `{}` is not an identifier (at most 200 letters, digits and `_`, no digit first); rename it, for example to `{suggestion}`", at_line(*line), printable(column), path = path.display())]
    ColumnName { path: PathBuf, line: Option<usize>, column: String, suggestion: String },
    #[error("{path}: column `{column}` occurs more than once; name each column once", path = path.display())]
    DuplicateColumn { path: PathBuf, column: String },
    #[error("{path}: column `{column}` has the domain [{}, {}]; it must be in ascending order, within ±3.4e38 as 32-bit floats are", shortest(*low), shortest(*high), path = path.display())]
    Domain { path: PathBuf, column: String, low: f64, high: f64 },
    #[error("{path}: the {split} split has {found} columns, but {expected} are named; generate or import it again", path = path.display())]
    ColumnCount { path: PathBuf, split: &'static str, found: usize, expected: usize },
    #[error("{path}: column `{column}` of the {split} split has {found} rows, but the first column has {expected}; all must be equally long", path = path.display())]
    UnequalColumns {
        path: PathBuf,
        split: &'static str,
        column: String,
        found: usize,
        expected: usize,
    },
    #[error("{path}: column `{column}`, row {row} of the {split} split is {value}; remove the row or replace the value by a finite one", path = path.display())]
    NotFinite { path: PathBuf, split: &'static str, column: String, row: usize, value: f32 },
    #[error("{path}: the weight of row {row} of the {split} split is {value}; weights must be finite and not negative", path = path.display())]
    BadWeight { path: PathBuf, split: &'static str, row: usize, value: f32 },
    #[error("{path}: {called}: row {row} of the {split} split is {value}; it must not be negative", path = path.display())]
    Negative { path: PathBuf, split: &'static str, called: &'static str, row: usize, value: f32 },
    #[error("{path}: all weights of the {split} split are zero; give at least one row a positive weight", path = path.display())]
    ZeroWeights { path: PathBuf, split: &'static str },
    #[error("{path}: a grid of {grid:?} points does not describe the {rows} rows of the {split} split; it needs one factor per input, and the rows as their product", path = path.display())]
    Grid { path: PathBuf, split: &'static str, grid: Vec<usize>, rows: usize },

    #[error("{path}: no column is called `{column}`{}; the columns are {available}", did_you_mean(suggestion), path = path.display())]
    UnknownColumn { path: PathBuf, column: String, suggestion: Option<String>, available: String },
    #[error("{path}: column `{column}` is asked for as an input and as an output; leave it out of one of them", path = path.display())]
    InputIsOutput { path: PathBuf, column: String },

    #[error("{path}, line {line}: unusable incumbents: {problem}", path = path.display())]
    Incumbents { path: PathBuf, line: usize, problem: String },
}

impl Error {
    /// Wraps the error of a file that could not be read.
    pub(crate) fn unread(path: &Path, source: std::io::Error) -> Error {
        match source.kind() {
            std::io::ErrorKind::NotFound => Error::Missing { path: path.into() },
            _ => Error::Io { path: path.into(), action: "read", source },
        }
    }
}

fn at_line(line: Option<usize>) -> String {
    line.map(|line| format!(", line {line}")).unwrap_or_default()
}

fn did_you_mean(suggestion: &Option<String>) -> String {
    suggestion.as_ref().map(|name| format!(" (did you mean `{name}`?)")).unwrap_or_default()
}
