//! The rows of numbers of a table.

use super::cells::{Content, Notation};
use super::layout::Layout;
use super::rows::{Cell, Fault, Rows};
use crate::import::Error;
use std::path::Path;

/// A column to read.
pub(super) struct Wanted {
    /// Its place in the file.
    pub place: usize,
    pub name: String,
    /// The power of ten that its values are multiplied by.
    pub scale: Option<i32>,
}

/// The columns that were asked for, as they were read.
#[derive(Default)]
pub(super) struct Read {
    pub columns: Vec<Vec<f32>>,
    /// The line of each row.
    pub lines: Vec<usize>,
    /// How many values of each column became zero, and are not.
    pub vanished: Vec<usize>,
    /// The first cell whose digits are grouped.
    pub grouped: Option<(usize, String, f64)>,
    /// Rows of separators or rules alone.
    pub empty: usize,
    pub comments: usize,
    /// Rows of text below the numbers.
    pub after: usize,
}

/// The text of a table that is read row by row.
pub(super) struct Source<'a> {
    pub path: &'a Path,
    pub text: &'a str,
    pub layout: &'a Layout,
    /// Lines before the table.
    pub skip: usize,
    /// The most rows to read.
    pub rows: usize,
}

impl<'a> Source<'a> {
    /// Reads columns.
    pub fn read(&self, wanted: &[Wanted]) -> Result<Read, Error> {
        let mut read = Read {
            columns: vec![Vec::new(); wanted.len()],
            vanished: vec![0; wanted.len()],
            ..Read::default()
        };
        let mut rows = self.begun();
        let mut cells = Vec::new();
        while read.lines.len() < self.rows
            && let Some(line) = self.next(&mut rows, &mut cells)?
        {
            if line < self.layout.header.first_line {
                continue;
            }
            if self.is_text(&cells) {
                self.check_end(rows.clone(), line, &cells, read.lines.len())?;
                read.after = 1 + self.count(&mut rows);
                break;
            }
            self.check_width(line, &cells)?;
            for (index, wanted) in wanted.iter().enumerate() {
                let text = &cells[wanted.place].text;
                let content = self.layout.notation.content(text);
                if let Content::Grouped(value) = content
                    && read.grouped.is_none()
                {
                    read.grouped = Some((line, text.to_string(), value));
                }
                let value = self.value(content, line, wanted, text)?;
                let narrow = value as f32;
                if narrow == 0.0 && value != 0.0 {
                    read.vanished[index] += 1;
                }
                read.columns[index].push(narrow);
            }
            read.lines.push(line);
        }
        (read.empty, read.comments) = (rows.empty, rows.comments);
        Ok(read)
    }

    /// Reads columns that have been read before, in double precision.
    pub fn read_wide(&self, wanted: &[&Wanted], rows: usize) -> Result<Vec<Vec<f64>>, Error> {
        let mut columns = vec![Vec::new(); wanted.len()];
        let mut left = self.begun();
        let mut cells = Vec::new();
        while columns.first().is_some_and(|column| column.len() < rows)
            && let Some(line) = self.next(&mut left, &mut cells)?
        {
            if line < self.layout.header.first_line {
                continue;
            }
            for (column, wanted) in columns.iter_mut().zip(wanted) {
                let text = cells.get(wanted.place).map_or("", |cell| &cell.text);
                let content = self.layout.notation.content(text);
                column.push(self.value(content, line, wanted, text)?);
            }
        }
        Ok(columns)
    }

    fn begun(&self) -> Rows<'a> {
        Rows::after(self.text, self.skip, self.layout.separator)
    }

    fn next(&self, rows: &mut Rows<'a>, cells: &mut Vec<Cell<'a>>) -> Result<Option<usize>, Error> {
        rows.next(cells).map_err(|(line, fault): (usize, Fault)| {
            let path = self.path.into();
            Error::Row { path, line, fault }
        })
    }

    /// Returns true for a row without a number; quick for rows that begin with one.
    fn is_text(&self, cells: &[Cell]) -> bool {
        let is_text = |cell: &Cell| {
            let begins = cell.text.as_bytes().first();
            !begins.is_some_and(u8::is_ascii_digit)
                && matches!(
                    self.layout.notation.content(&cell.text),
                    Content::Text | Content::Empty
                )
        };
        cells.iter().all(is_text) && cells.iter().any(|cell| !cell.text.is_empty())
    }

    /// Checks that no row of numbers follows a row of text.
    fn check_end(
        &self,
        mut rest: Rows<'a>,
        line: usize,
        text: &[Cell],
        rows: usize,
    ) -> Result<(), Error> {
        let mut cells = Vec::new();
        while self.next(&mut rest, &mut cells)?.is_some() {
            if !self.is_text(&cells) {
                let text = text.iter().map(|cell| &*cell.text).collect::<Vec<_>>().join(" ");
                return Err(Error::TextAmid { path: self.path.into(), line, text, rows });
            }
        }
        Ok(())
    }

    fn count(&self, rows: &mut Rows<'a>) -> usize {
        let mut cells = Vec::new();
        std::iter::from_fn(|| rows.next(&mut cells).ok().flatten()).count()
    }

    fn check_width(&self, line: usize, cells: &[Cell]) -> Result<(), Error> {
        let expected = self.layout.columns.len();
        if cells.len() >= expected && cells[expected..].iter().all(|cell| cell.text.is_empty()) {
            return Ok(());
        }
        Err(Error::RaggedRow { path: self.path.into(), line, found: cells.len(), expected })
    }

    fn value(
        &self,
        content: Content,
        line: usize,
        wanted: &Wanted,
        text: &str,
    ) -> Result<f64, Error> {
        let value = match content {
            Content::Number(value) | Content::Grouped(value) => value,
            _ => return Err(self.unusable(content, line, wanted, text)),
        };
        let value = match wanted.scale {
            None => value,
            Some(power) => scaled(self.layout.notation, text, power).unwrap_or(value),
        };
        if (value as f32).is_finite() {
            return Ok(value);
        }
        let (path, column, text) = (self.path.into(), wanted.name.clone(), text.to_owned());
        let power = match value.is_finite() {
            true => value.abs().log10().ceil() as i32,
            false => 300,
        };
        Err(Error::CellOverflow { path, line, column, text, remedy: format!("1e-{power}") })
    }

    fn unusable(&self, content: Content, line: usize, wanted: &Wanted, text: &str) -> Error {
        let (path, column, text) = (self.path.into(), wanted.name.clone(), text.to_owned());
        match content {
            Content::Missing => Error::CellNotFinite { path, line, column, text },
            Content::Ambiguous => Error::AmbiguousCell { path, line, column, text },
            _ => Error::Cell { path, line, column, text },
        }
    }
}

/// Reads a number times a power of ten, which is exact in decimals: `1e300` by `1e-300` is one.
fn scaled(notation: Notation, text: &str, power: i32) -> Option<f64> {
    let lower = text.to_ascii_lowercase();
    let (mantissa, exponent) = lower.split_once(['e', 'd']).unwrap_or((&lower, "0"));
    let exponent: i32 = exponent.parse().ok()?;
    let exponent = exponent.checked_add(power)?;
    match notation.content(&format!("{mantissa}e{exponent}")) {
        Content::Number(value) | Content::Grouped(value) => Some(value),
        _ => None,
    }
}
