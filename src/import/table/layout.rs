//! How a table is written: what separates its columns, and where its rows begin.

use super::Options;
use super::cells::{Content, Decimal, Notation};
use super::header::{Header, header};
use super::names::is_identifier;
use super::sample::{Kind, Reading, Sample, is_number};
use super::separator::Separator;
use crate::import::Error;
use std::path::Path;

/// How a table is written.
pub(super) struct Layout {
    pub separator: Separator,
    pub notation: Notation,
    pub header: Header,
    /// What the columns hold, as far as the first rows show.
    pub columns: Vec<Holds>,
    /// Another separator that explains as many rows by other columns.
    pub other: Option<Separator>,
    /// A cell whose comma may group digits, if nothing shows that commas stand before decimals.
    pub unclear: Option<Unclear>,
}

/// A cell that two readings differ about.
pub(super) struct Unclear {
    pub column: usize,
    pub line: usize,
    pub text: String,
}

/// What a column holds.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Holds {
    Numbers,
    Nothing,
    /// Text, such as this in that line.
    Text {
        line: usize,
        text: String,
        is_quoted: bool,
    },
}

/// Finds how a table is written, as far as the options do not say it. Of all separators and decimal
/// signs those count that explain most rows, each row by the share of its columns that hold
/// numbers; of several, tabs come before semicolons, bars, commas, and blanks, and the decimal point
/// before the comma. More than one column comes before one.
pub(super) fn find(path: &Path, text: &str, options: &Options) -> Result<Layout, Error> {
    let separators = match options.separator {
        Some(separator) => vec![separator],
        None => Separator::KNOWN.to_vec(),
    };
    let decimals = match options.decimal {
        Some(decimal) => vec![decimal],
        None => vec![Decimal::Point, Decimal::Comma],
    };
    let skip = options.skip.unwrap_or(0);
    let samples: Vec<Sample> =
        separators.iter().map(|&separator| Sample::of(text, skip, separator)).collect();
    let mut best: Option<(&Sample, Reading)> = None;
    let mut other = None;
    for sample in &samples {
        for &decimal in &decimals {
            let reading = Reading::of(sample, decimal, options.decimal.is_some());
            let rank = |reading: &Reading| (reading.kinds.len() > 1, reading.score);
            let (more, score) = rank(&reading);
            let Some((chosen, known)) = best.as_ref() else {
                best = Some((sample, reading));
                continue;
            };
            if rank(&reading) > rank(known) {
                (best, other) = (Some((sample, reading)), None);
            } else if more
                && score > 0.999 * known.score
                && chosen.separator != sample.separator
                && reading.kinds.len() != known.kinds.len()
            {
                other = Some(sample.separator);
            }
        }
    }
    let Some((sample, reading)) = best else { return Err(empty(path)) };
    check_rows(path, &samples, sample, &reading)?;
    let header = header(path, text, sample, &reading, options)?;
    let columns = reading.kinds.iter().enumerate().map(|(column, kind)| match *kind {
        Kind::Numbers => Holds::Numbers,
        Kind::Empty => Holds::Nothing,
        Kind::Text { row } => {
            let (row, cell) = (&sample.rows[row], &sample.rows[row].cells[column]);
            Holds::Text { line: row.line, text: cell.text.to_string(), is_quoted: cell.quoted }
        }
    });
    let unclear = match options.decimal {
        None => unclear_comma(sample, &reading),
        Some(_) => None,
    };
    Ok(Layout {
        unclear,
        separator: sample.separator,
        notation: reading.notation,
        columns: columns.collect(),
        header,
        other,
    })
}

/// Returns the first cell with a comma if those of all cells may group digits, as in `1,234`.
fn unclear_comma(sample: &Sample, reading: &Reading) -> Option<Unclear> {
    if reading.notation.decimal == Decimal::Point {
        return None;
    }
    let grouping = Notation { decimal: Decimal::Point, groups: false };
    let mut first = None;
    for (row, contents) in sample.rows.iter().zip(&reading.contents) {
        for (column, (cell, content)) in row.cells.iter().zip(contents).enumerate() {
            if !is_number(content) || !cell.text.contains(',') {
                continue;
            }
            if grouping.content(&cell.text) != Content::Ambiguous {
                return None;
            }
            let text = || cell.text.to_string();
            first = first.or_else(|| Some(Unclear { column, line: row.line, text: text() }));
        }
    }
    first
}

fn empty(path: &Path) -> Error {
    crate::dataset::Error::Empty { path: path.into() }.into()
}

/// Checks that there is a row of numbers.
fn check_rows(
    path: &Path,
    samples: &[Sample],
    sample: &Sample,
    reading: &Reading,
) -> Result<(), Error> {
    if reading.matches.contains(&true) {
        return Ok(());
    }
    if let Some((line, fault)) = samples.iter().find_map(|sample| sample.fault) {
        return Err(Error::Row { path: path.into(), line, fault });
    }
    let is_header = |sample: &Sample| match &sample.rows[..] {
        [only] => only.cells.iter().all(|cell| is_identifier(&cell.text)),
        _ => false,
    };
    if samples.iter().any(is_header) {
        return Err(Error::HeaderOnly { path: path.into() });
    }
    match &sample.rows[..] {
        [] => Err(empty(path)),
        [first, ..] => {
            let text = first.cells.iter().map(|cell| &*cell.text).collect::<Vec<_>>().join(" ");
            Err(Error::NoNumbers { path: path.into(), line: first.line, text })
        }
    }
}
