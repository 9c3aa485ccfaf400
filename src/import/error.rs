//! The reasons why another program's file cannot be imported.

use super::table::{Fault, LONGEST_ROW, MOST_CELLS};
use crate::dataset;
use crate::printable::printable;
use crate::program::shortest;
use std::path::PathBuf;

/// The reason why a file cannot be imported. `path` is the file, `line` counts from 1 within it.
#[allow(missing_docs, reason = "each message names its fields")]
#[derive(Debug, thiserror::Error)]
pub enum Error {
    #[error(transparent)]
    Dataset(#[from] dataset::Error),

    #[error("{path}: no text in UTF-8, Windows-1252, or UTF-16 with a byte-order mark (line {line}); save it as CSV in UTF-8", path = path.display())]
    NotText { path: PathBuf, line: usize },
    #[error("{path}, line {line}: {}", fault_text(*fault), path = path.display())]
    Row { path: PathBuf, line: usize, fault: Fault },
    #[error("{path}: no row of numbers below line {line} (`{}`); if it is a table, say how it is written with --separator, --decimal and --skip", start(text), path = path.display())]
    NoNumbers { path: PathBuf, line: usize, text: String },
    #[error("{path}: a header but no rows below it; add at least one row of numbers", path = path.display())]
    HeaderOnly { path: PathBuf },
    #[error("{path}, line {line}: a row of length {found} under a header of {expected} columns; make them equally long, or, if the line above is no header or lacks names, give all with {remedy}", path = path.display())]
    HeaderLength { path: PathBuf, line: usize, found: usize, expected: usize, remedy: String },
    #[error("{path}, line {line}: a row of length {found} above a table of {expected} columns; make them equally long, or skip it with --skip {}", table - 1, path = path.display())]
    NumbersAbove { path: PathBuf, line: usize, found: usize, expected: usize, table: usize },
    #[error("{path}, line {line}: a row of length {found} under a header of {expected} columns; make them equally long", path = path.display())]
    RaggedRow { path: PathBuf, line: usize, found: usize, expected: usize },
    #[error("{path}, line {line}: `{}` may be one number with a decimal comma under the one name above it, or two; write --decimal comma --separator blanks, or name both by --columns and --skip", start(text), path = path.display())]
    OneOrTwo { path: PathBuf, line: usize, text: String },
    #[error("{path}, line {line}: `{}` stands amid the rows of numbers; take the {rows} rows above it with --rows {rows}, those below it with --skip {}, or remove the line", start(text), line - 1, path = path.display())]
    TextAmid { path: PathBuf, line: usize, text: String, rows: usize },
    #[error("{path}: --columns gives {given} names, but there are {found} columns ({as_found}); give one name for each", path = path.display())]
    ColumnNames { path: PathBuf, given: usize, found: usize, as_found: String },

    #[error("{path}, line {line}, column `{column}`: {}; write a number such as 0.25, remove the row, or leave the column out with --drop {column}", cell(text), path = path.display())]
    Cell { path: PathBuf, line: usize, column: String, text: String },
    #[error("{path}, line {line}, column `{column}`: `{}` is not finite; remove the row, write a finite number, or leave the column out with --drop {column}", printable(text), path = path.display())]
    CellNotFinite { path: PathBuf, line: usize, column: String, text: String },
    #[error("{path}, line {line}, column `{column}`: `{}` is too large for 32-bit floats (largest: 3.4e38); use a smaller unit: --scale {column}={remedy} multiplies the column", printable(text), path = path.display())]
    CellOverflow { path: PathBuf, line: usize, column: String, text: String, remedy: String },
    #[error("{path}, line {line}, column `{column}`: `{}` may have decimals or grouped digits; say which sign stands before decimals: --decimal comma or --decimal point", printable(text), path = path.display())]
    AmbiguousCell { path: PathBuf, line: usize, column: String, text: String },
    #[error("{path}, line {line}, column `{column}`: `{}` holds several numbers, so that it is unclear what separates columns; say it with --separator, or leave the column out with --drop {column}", printable(text), path = path.display())]
    SeveralNumbers { path: PathBuf, line: usize, column: String, text: String },

    #[error("{path}: column `{column}` holds no numbers (line {line}: `{}`) and can be no input, output or weight; leave it out of the options, or write numbers", start(text), path = path.display())]
    NoNumberColumn { path: PathBuf, column: String, line: usize, text: String },
    #[error("{path}: column `{column}` is asked for and left out by --drop; write one of them", path = path.display())]
    Dropped { path: PathBuf, column: String },
    #[error("{path}: {asked} input columns were asked for, but there are only {columns} columns and at least one must be left as an output; ask for fewer", path = path.display())]
    TooManyInputs { path: PathBuf, asked: usize, columns: usize },
    #[error("{path}: no column is left as an input or output beside the others; left out are {left_out}", path = path.display())]
    TooFewColumns { path: PathBuf, left_out: String },
    #[error("{path}, line {line}, column `{column}`: {value} is negative; weights must not be (if the column is not a weight, name it among the inputs)", path = path.display())]
    NegativeWeight { path: PathBuf, line: usize, column: String, value: f32 },
    #[error("{path}, line {line}, column `{column}`: {value} is negative; standard errors must not be (if the column holds none, name it among the inputs)", path = path.display())]
    NegativeError { path: PathBuf, line: usize, column: String, value: f32 },

    #[error("{path}, line {line}, column `{column}`: {value} lies outside the domain [{}, {}] of --domain; widen it, or remove the row", shortest(*low), shortest(*high), path = path.display())]
    OutsideDomain { path: PathBuf, line: usize, column: String, value: f32, low: f64, high: f64 },
    #[error("{path}: column `{column}` is an output, and --domain is about inputs; leave it out", path = path.display())]
    DomainOfOutput { path: PathBuf, column: String },
    #[error("{path}: --domain {column} is [{}, {}] as the column is stored, which 32-bit floats do not hold; write one within ±3.4e38", shortest(*low), shortest(*high), path = path.display())]
    UnusableDomain { path: PathBuf, column: String, low: f64, high: f64 },
    #[error("{path}: --scale is about column `{column}`, which is not read; leave one of them out", path = path.display())]
    ScaleOfNothing { path: PathBuf, column: String },
    #[error("{path}: column `{column}` is {largest:e} at most, too small for 32-bit floats (smallest: 1.2e-38); use a larger unit: --scale {column}={remedy} multiplies the column", path = path.display())]
    TooSmall { path: PathBuf, column: String, largest: f64, remedy: String },
    #[error("{path}: {lost} of the {of} values of column `{column}` fall together in 32-bit floats, which count to 16777216 one by one; leave it out with --drop {column}, or subtract or divide it in the table", path = path.display())]
    FallTogether { path: PathBuf, column: String, lost: usize, of: usize },
}

fn fault_text(fault: Fault) -> String {
    match fault {
        Fault::OpenQuote => "a quote is opened and never closed; close or remove it".into(),
        Fault::Long => {
            format!("a row of more than {} MiB; is it a table?", LONGEST_ROW >> 20)
        }
        Fault::Cells => {
            format!("a row of more than {MOST_CELLS} cells; take fewer columns")
        }
    }
}

/// The beginning of a text from a file.
fn start(text: &str) -> String {
    match text.char_indices().nth(60) {
        None => printable(text).into_owned(),
        Some((end, _)) => format!("{}…", printable(&text[..end])),
    }
}

fn cell(text: &str) -> String {
    if text.is_empty() {
        "the cell is empty".into()
    } else {
        format!("`{}` is not a number", start(text))
    }
}
