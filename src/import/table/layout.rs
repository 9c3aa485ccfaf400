//! How a table is written: what separates its columns, and where its rows begin.

use super::Options;
use super::cells::{Decimal, Notation};
use super::header::{Header, header};
use super::rows::Separator;
use super::sample::{Kind, Reading, Sample};
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
    check_rows(path, sample, &reading)?;
    let header = header(path, text, sample, &reading, options)?;
    let columns = reading.kinds.iter().enumerate().map(|(column, kind)| match *kind {
        Kind::Numbers => Holds::Numbers,
        Kind::Empty => Holds::Nothing,
        Kind::Text { row } => {
            let (row, cell) = (&sample.rows[row], &sample.rows[row].cells[column]);
            Holds::Text { line: row.line, text: cell.text.to_string(), is_quoted: cell.quoted }
        }
    });
    Ok(Layout {
        separator: sample.separator,
        notation: reading.notation,
        columns: columns.collect(),
        header,
        other,
    })
}

fn empty(path: &Path) -> Error {
    crate::dataset::Error::Empty { path: path.into() }.into()
}

/// Checks that there is a row of numbers.
fn check_rows(path: &Path, sample: &Sample, reading: &Reading) -> Result<(), Error> {
    if reading.matches.contains(&true) {
        return Ok(());
    }
    if let Some((line, fault)) = sample.fault {
        return Err(Error::Row { path: path.into(), line, fault });
    }
    match &sample.rows[..] {
        [] => Err(empty(path)),
        [_] => Err(Error::HeaderOnly { path: path.into() }),
        [first, ..] => {
            let text = first.cells.iter().map(|cell| &*cell.text).collect::<Vec<_>>().join(" ");
            Err(Error::NoNumbers { path: path.into(), line: first.line, text })
        }
    }
}
