//! The beginning of a table under one reading: a separator and a decimal sign.

use super::cells::{Content, Decimal, Notation};
use super::rows::{Cell, Fault, Rows};
use super::separator::Separator;
use std::collections::BTreeMap;

/// The most rows and cells that a reading is chosen by. By hand: enough for any header, and quick.
const ROWS: usize = 1000;
const CELLS: usize = 200_000;

/// Rows, split by one separator.
pub(super) struct Sample<'a> {
    pub separator: Separator,
    pub rows: Vec<SampleRow<'a>>,
    /// Where and why the rows end, if they cannot be split on.
    pub fault: Option<(usize, Fault)>,
}

pub(super) struct SampleRow<'a> {
    pub line: usize,
    pub cells: Vec<Cell<'a>>,
    /// The last comment between this row and the one before, and its line.
    pub comment: Option<(usize, &'a str)>,
}

impl<'a> Sample<'a> {
    pub fn of(text: &'a str, skip: usize, separator: Separator) -> Sample<'a> {
        let mut sample = Sample { separator, rows: Vec::new(), fault: None };
        let mut rows = Rows::after(text, skip, separator);
        let mut count = 0;
        while sample.rows.len() < ROWS && count < CELLS {
            let mut cells = Vec::new();
            match rows.next(&mut cells) {
                Ok(Some(line)) => {
                    count += cells.len();
                    let comment = rows.comment.take();
                    sample.rows.push(SampleRow { line, cells, comment });
                }
                Ok(None) => break,
                Err(fault) => {
                    sample.fault = Some(fault);
                    break;
                }
            }
        }
        sample
    }
}

/// What a column of a sample holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Kind {
    Numbers,
    Empty,
    /// Text, for example in this row.
    Text {
        row: usize,
    },
}

/// A sample under one notation of numbers.
pub(super) struct Reading {
    pub notation: Notation,
    /// What each cell of each row holds.
    pub contents: Vec<Vec<Content>>,
    /// What each column holds; none at the end are empty throughout.
    pub kinds: Vec<Kind>,
    /// The rows of numbers.
    pub matches: Vec<bool>,
    /// How many rows it explains, each by the share of its cells that are numbers.
    pub score: f64,
}

impl Reading {
    /// Reads a sample; the other sign groups digits if `groups`, or if some cell shows it.
    pub fn of(sample: &Sample, decimal: Decimal, groups: bool) -> Reading {
        let reading = Reading::in_notation(sample, Notation { decimal, groups });
        let shown = |content: &Content| matches!(content, Content::Grouped(_));
        let other = match decimal {
            Decimal::Point => ',',
            Decimal::Comma => '.',
        };
        let by_other = |(row, contents): (&SampleRow, &Vec<Content>)| {
            row.cells.iter().zip(contents).any(|(cell, c)| shown(c) && cell.text.contains(other))
        };
        match !groups && sample.rows.iter().zip(&reading.contents).any(by_other) {
            true => Reading::in_notation(sample, Notation { decimal, groups: true }),
            false => reading,
        }
    }

    fn in_notation(sample: &Sample, notation: Notation) -> Reading {
        let content = |cell: &Cell| notation.content(&cell.text);
        let contents: Vec<Vec<Content>> =
            sample.rows.iter().map(|row| row.cells.iter().map(content).collect()).collect();
        let width = width(&contents);
        let kinds = kinds(&contents, width);
        let mut reading = Reading { notation, contents, kinds, matches: Vec::new(), score: 0.0 };
        reading.matches = (0..sample.rows.len()).map(|row| reading.is_of_numbers(row)).collect();
        let rows = reading.matches.iter().filter(|matches| **matches).count();
        let count = |kind: fn(&Kind) -> bool| reading.kinds.iter().filter(|k| kind(k)).count();
        let [numbers, empty] = [count(|k| *k == Kind::Numbers), count(|k| *k == Kind::Empty)];
        let share = numbers as f64 / (reading.kinds.len() - empty).max(1) as f64;
        reading.score = rows as f64 * share;
        reading
    }

    /// Returns true for a row with a cell for each column, and none beyond.
    pub fn fits(&self, row: usize) -> bool {
        let contents = &self.contents[row];
        let columns = self.kinds.len();
        contents.len() >= columns && contents[columns..].iter().all(|c| *c == Content::Empty)
    }

    /// The cells of a row in columns of numbers.
    fn in_number_columns(&self, row: usize) -> impl Iterator<Item = &Content> {
        let cells = self.kinds.iter().zip(&self.contents[row]);
        cells.filter(|(kind, _)| **kind == Kind::Numbers).map(|(_, content)| content)
    }

    fn is_of_numbers(&self, row: usize) -> bool {
        self.fits(row)
            && self.in_number_columns(row).all(|c| !matches!(c, Content::Text | Content::Ambiguous))
            && self.has_number(row)
    }

    /// Returns true for a row with a number where numbers are.
    pub fn has_number(&self, row: usize) -> bool {
        self.in_number_columns(row).any(is_number)
    }

    /// Returns true for a row of names: text, and no number where numbers are.
    pub fn is_of_text(&self, row: usize) -> bool {
        let some = self.contents[row].iter().any(|c| matches!(c, Content::Text | Content::Missing));
        some && !self.has_number(row)
    }
}

pub(super) fn is_number(content: &Content) -> bool {
    matches!(content, Content::Number(_) | Content::Grouped(_))
}

/// The usual number of cells of rows with a number, or, of several, that of most other rows.
fn width(contents: &[Vec<Content>]) -> usize {
    let mut counts = BTreeMap::new();
    for row in contents {
        let (numbers, all) = counts.entry(row.len()).or_insert((0, 0));
        *numbers += usize::from(row.iter().any(is_number));
        *all += 1;
    }
    let usual = counts.into_iter().max_by_key(|&(width, count)| (count, width));
    usual.map_or(0, |(width, _)| width)
}

/// What most cells of each column hold, in the rows with a number or in the second half of them:
/// the first may belong to a header.
fn kinds(contents: &[Vec<Content>], width: usize) -> Vec<Kind> {
    let usual = |row: &usize| contents[*row].len() >= width && contents[*row].iter().any(is_number);
    let all: Vec<usize> = (0..contents.len()).filter(usual).collect();
    let later = &all[all.len() / 2..];
    let kind = |column: usize| {
        let count = |rows: &[usize], held: fn(&Content) -> bool| {
            rows.iter().filter(|row| held(&contents[**row][column])).count()
        };
        let is_text = |c: &Content| matches!(c, Content::Text | Content::Ambiguous);
        let is_missing = |c: &Content| *c == Content::Missing;
        let mostly_numbers = |rows: &[usize]| {
            let numbers = count(rows, is_number);
            numbers > 0 && numbers + count(rows, is_missing) >= count(rows, is_text)
        };
        let first = |held: fn(&Content) -> bool| {
            later.iter().copied().find(|row| held(&contents[*row][column]))
        };
        match first(is_text).or(first(is_missing)) {
            _ if mostly_numbers(later) || mostly_numbers(&all) => Kind::Numbers,
            Some(row) => Kind::Text { row },
            None => Kind::Empty,
        }
    };
    let mut kinds: Vec<Kind> = (0..width).map(kind).collect();
    let is_blank = |column: usize| {
        contents.iter().all(|row| row.get(column).is_none_or(|c| *c == Content::Empty))
    };
    while kinds.last() == Some(&Kind::Empty) && is_blank(kinds.len() - 1) {
        kinds.pop();
    }
    kinds
}
