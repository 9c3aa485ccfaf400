//! Tables of numbers, as repositories, instruments and spreadsheets write them.
//!
//! How a table is written is found from its beginning: the encoding, what separates columns, the
//! sign before decimals, titles, names and units above the numbers. [`Understood`] says what was
//! found, and [`Options`] overrule it. Where two readings would give different numbers and nothing
//! decides between them, the table is refused, with the option that does.

mod assemble;
mod cells;
mod header;
mod layout;
mod names;
mod notes;
mod options;
mod precision;
mod read;
mod roles;
mod rows;
mod sample;
mod separator;
mod text;
mod understood;
mod units;

pub use cells::Decimal;
pub use options::{InputColumns, Options};
pub use rows::{Fault, LONGEST_ROW, MOST_CELLS};
pub use separator::Separator;
pub use text::Encoding;
pub use understood::{Role, Understood, UnderstoodColumn};

use super::{Error, STANDARD_INPUT, read_source};
use crate::dataset::{self, Dataset};
use cells::Content;
use layout::{Holds, Layout, Unclear};
use names::{Heading, headings, numbered};
use read::{Source, Wanted};
use roles::Columns;
use sample::is_number;
use std::collections::HashSet;
use std::path::Path;

/// Reads a table, or standard input where `path` is `-`, and makes a dataset of it.
///
/// A column `weight` that is asked for as nothing else holds the rows' weights; `y_se`, where `y`
/// is an output, the standard errors of `y`. Without options the last other column is the output.
/// Columns of text are left out. One row in four is held out for validation.
///
/// # Errors
/// A file that cannot be read or is no text; no rows of numbers; a row of another length; a cell
/// that is not a finite number in the range of f32; numbers that two readings differ about; an
/// option that names no column, or one that holds no numbers; no column left as input or output.
pub fn read(path: &Path, options: &Options) -> Result<(Dataset, Understood), Error> {
    parse(called(path), read_source(path)?, options)
}

/// Makes a dataset of the bytes of a table; errors name `path`.
///
/// # Errors
/// As [`read`], about the content.
pub fn parse(
    path: &Path,
    bytes: Vec<u8>,
    options: &Options,
) -> Result<(Dataset, Understood), Error> {
    let open = Open::new(path, bytes, options)?;
    assemble::dataset(&open)
}

/// A table of logged values: all columns of numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// The columns' names.
    pub names: Vec<String>,
    /// The columns, each of as many values as there are rows, of which there is at least one.
    pub columns: Vec<Vec<f32>>,
    /// The line of each row in the file.
    pub lines: Vec<usize>,
    /// How it was read.
    pub understood: Understood,
}

impl Table {
    /// Reads all columns of numbers of a table, or of standard input where `path` is `-`.
    ///
    /// # Errors
    /// As [`read`], about the file and its cells.
    pub fn read(path: &Path) -> Result<Table, Error> {
        let options = Options::default();
        let open = Open::new(called(path), read_source(path)?, &options)?;
        let wanted: Vec<Wanted> =
            open.columns().candidates().map(|place| open.wanted(place)).collect();
        let read = open.source().read(&wanted)?;
        let mut understood = open.understood(&read);
        for wanted in &wanted {
            open.set_role(&mut understood, wanted.place, Role::Logged);
        }
        let names = wanted.into_iter().map(|wanted| wanted.name).collect();
        Ok(Table { names, columns: read.columns, lines: read.lines, understood })
    }

    /// Returns the index of a column; errors name `path`.
    ///
    /// # Errors
    /// No column of this name, with a suggestion.
    pub fn index_of(&self, path: &Path, name: &str) -> Result<usize, Error> {
        let names = self.names.iter().map(String::as_str);
        let index = self.names.iter().position(|column| column == name);
        Ok(index.ok_or_else(|| dataset::unknown_column(path.into(), name, names))?)
    }
}

/// What a path is called in messages.
fn called(path: &Path) -> &Path {
    if path.as_os_str() == "-" { Path::new(STANDARD_INPUT) } else { path }
}

/// A table whose layout and columns are known.
struct Open<'a> {
    path: &'a Path,
    options: &'a Options,
    text: String,
    encoding: Encoding,
    layout: Layout,
    headings: Vec<Heading>,
    /// True for each column that `--drop` names.
    dropped: Vec<bool>,
}

impl<'a> Open<'a> {
    fn new(path: &'a Path, bytes: Vec<u8>, options: &'a Options) -> Result<Open<'a>, Error> {
        if bytes.is_empty() {
            return Err(dataset::Error::Empty { path: path.into() }.into());
        }
        let (text, encoding) = text::decode(path, bytes)?;
        let layout = layout::find(path, &text, options)?;
        let headings = open_headings(path, &layout, options)?;
        let dropped = vec![false; headings.len()];
        let mut open = Open { path, options, text, encoding, layout, headings, dropped };
        for name in &options.drop {
            let place = open.columns().place(name)?;
            let name = open.headings[place].name.clone();
            for (dropped, heading) in open.dropped.iter_mut().zip(&open.headings) {
                *dropped |= heading.name == name;
            }
        }
        open.check_columns()?;
        Ok(open)
    }

    fn columns(&self) -> Columns<'_> {
        Columns {
            path: self.path,
            headings: &self.headings,
            holds: &self.layout.columns,
            dropped: &self.dropped,
        }
    }

    fn source(&self) -> Source<'_> {
        Source {
            path: self.path,
            text: &self.text,
            layout: &self.layout,
            skip: self.options.skip.unwrap_or(0),
            rows: self.options.rows.unwrap_or(usize::MAX),
        }
    }

    fn wanted(&self, place: usize) -> Wanted {
        Wanted { place, name: self.headings[place].name.clone(), scale: None }
    }

    /// Refuses names that occur twice, and columns whose text may be numbers.
    fn check_columns(&self) -> Result<(), Error> {
        if let Some(Unclear { column, line, text }) = &self.layout.unclear
            && self.columns().candidates().any(|place| place == *column)
        {
            let (path, column) = (self.path.into(), self.headings[*column].name.clone());
            return Err(Error::AmbiguousCell { path, line: *line, column, text: text.clone() });
        }
        let mut seen = HashSet::new();
        for place in self.columns().candidates() {
            let name = &self.headings[place].name;
            if !seen.insert(name) {
                let (path, column) = (self.path.into(), name.clone());
                return Err(dataset::Error::DuplicateColumn { path, column }.into());
            }
        }
        let holds = self.layout.columns.iter().zip(&self.dropped).zip(&self.headings);
        for ((holds, dropped), heading) in holds {
            let Holds::Text { line, text, is_quoted } = holds else { continue };
            let (path, line, column) = (self.path.into(), *line, heading.name.clone());
            let text = text.clone();
            if *dropped {
                continue;
            }
            if self.may_be_number(&text) {
                return Err(Error::AmbiguousCell { path, line, column, text });
            }
            if !is_quoted && self.options.separator.is_none() && cells::is_several_numbers(&text) {
                return Err(Error::SeveralNumbers { path, line, column, text });
            }
        }
        Ok(())
    }

    /// Returns true for a text that is a number with the other decimal sign, or grouped digits.
    fn may_be_number(&self, text: &str) -> bool {
        let notation = self.layout.notation;
        let other = match (self.options.decimal, notation.decimal) {
            (Some(given), _) => given,
            (None, Decimal::Point) => Decimal::Comma,
            (None, Decimal::Comma) => Decimal::Point,
        };
        let by_other = cells::Notation { decimal: other, groups: false };
        notation.content(text) == Content::Ambiguous || is_number(&by_other.content(text))
    }

    fn understood(&self, read: &read::Read) -> Understood {
        let header = &self.layout.header;
        let holds = self.layout.columns.iter().zip(&self.dropped).zip(&self.headings);
        let column = |((holds, dropped), heading): ((&Holds, &bool), &Heading)| {
            let reason = match holds {
                _ if *dropped => "by --drop".into(),
                Holds::Numbers => "not asked for".into(),
                Holds::Nothing if heading.written.is_empty() => return None,
                Holds::Nothing => "it is empty".into(),
                Holds::Text { line, text, .. } => format!("it holds text (line {line}: `{text}`)"),
            };
            Some(UnderstoodColumn {
                written: heading.written.clone(),
                name: heading.name.clone(),
                unit: heading.unit.clone(),
                role: Role::LeftOut(reason),
            })
        };
        Understood {
            encoding: self.encoding,
            separator: self.layout.separator,
            decimal: self.layout.notation.decimal,
            names_line: header.names_line,
            units_line: header.units_line,
            first_line: read.lines.first().copied().unwrap_or(header.first_line),
            rows: read.lines.len(),
            rows_above: header.skipped,
            rows_below: read.after,
            comments: read.comments,
            empty_rows: read.empty,
            columns: holds.filter_map(column).collect(),
            notes: notes::of_reading(self, read),
            lines_above: header.skipped_lines,
            names_in_comment: header.in_comment,
        }
    }

    fn set_role(&self, understood: &mut Understood, place: usize, role: Role) {
        let name = &self.headings[place].name;
        let column = understood.columns.iter_mut().filter(|column| column.name == *name);
        let mut readable =
            column.filter(|column| column.role == Role::LeftOut("not asked for".into()));
        if let Some(column) = readable.next() {
            column.role = role;
        }
    }
}

/// The headings of all columns, of the options, the file, or made up.
fn open_headings(path: &Path, layout: &Layout, options: &Options) -> Result<Vec<Heading>, Error> {
    let columns = &layout.columns;
    let header = &layout.header;
    let mut written = header.names.clone();
    written.resize(columns.len(), String::new());
    let full: Vec<usize> = (0..columns.len())
        .filter(|&c| columns[c] != Holds::Nothing || !written[c].is_empty())
        .collect();
    let given = match (&options.columns, header.names.is_empty()) {
        (Some(names), _) => Some(names.clone()),
        (None, true) => {
            let numbers: Vec<usize> =
                full.iter().copied().filter(|&c| columns[c] == Holds::Numbers).collect();
            let inputs = match &options.inputs {
                Some(InputColumns::Count(count)) => *count,
                _ => numbers.len().saturating_sub(1),
            };
            let mut made = numbered(numbers.len(), inputs).into_iter();
            let name = |&c: &usize| match columns[c] {
                Holds::Numbers => made.next().unwrap_or_default(),
                _ => format!("column_{}", c + 1),
            };
            Some(full.iter().map(name).collect())
        }
        (None, false) => None,
    };
    if let Some(given) = given {
        let places = match given.len() {
            all if all == columns.len() => (0..columns.len()).collect(),
            some if some == full.len() => full,
            _ => {
                let (given, found) = (given.len(), full.len());
                let as_found: Vec<&str> = full
                    .iter()
                    .map(|&c| if written[c].is_empty() { "without a name" } else { &*written[c] })
                    .take(8)
                    .collect();
                let as_found = as_found.join(", ");
                return Err(Error::ColumnNames { path: path.into(), given, found, as_found });
            }
        };
        for (place, name) in places.into_iter().zip(given) {
            written[place] = name;
        }
    }
    let mut headings = headings(&written);
    for (heading, unit) in headings.iter_mut().zip(&header.units) {
        if !unit.is_empty() && dataset::check_text(unit).is_ok() {
            heading.unit.clone_from(unit);
        }
    }
    for heading in headings.iter_mut().filter(|heading| dataset::check_text(&heading.unit).is_err())
    {
        heading.unit.clear();
    }
    Ok(headings)
}
