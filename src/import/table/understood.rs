//! What was understood of a table, in words and as data.

use super::cells::Decimal;
use super::separator::Separator;
use super::text::Encoding;
use crate::printable::printable;
use serde::Serialize;

/// How a table was read: what was found, and what was left out or changed.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Understood {
    /// How the bytes were decoded.
    pub encoding: Encoding,
    /// What stands between columns.
    pub separator: Separator,
    /// The sign before decimals.
    pub decimal: Decimal,
    /// The line of the columns' names, from 1; `None` if there are none.
    pub names_line: Option<usize>,
    /// The line of the columns' units.
    pub units_line: Option<usize>,
    /// The line of the first row.
    pub first_line: usize,
    /// The rows that were read.
    pub rows: usize,
    /// Rows of other text above the names.
    pub rows_above: usize,
    /// Rows of text below the numbers.
    pub rows_below: usize,
    /// Lines of comments.
    pub comments: usize,
    /// Rows of separators or rules alone.
    pub empty_rows: usize,
    /// All columns of the file that are not empty, in its order.
    pub columns: Vec<UnderstoodColumn>,
    /// What else the reader of the data should know.
    pub notes: Vec<String>,
    #[serde(skip)]
    pub(super) lines_above: Option<[usize; 2]>,
    #[serde(skip)]
    pub(super) names_in_comment: bool,
}

/// A column of a table.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct UnderstoodColumn {
    /// The name as the file has it; empty if it has none.
    pub written: String,
    /// The name in the dataset: an identifier.
    pub name: String,
    /// The unit; empty if none is stated.
    pub unit: String,
    /// What it is read as.
    pub role: Role,
}

/// What a column of a table is read as.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Role {
    /// An input.
    Input,
    /// An output.
    Output,
    /// The weights of the rows.
    Weight,
    /// The standard errors of an output.
    StandardErrors,
    /// A column of a log, which has no roles.
    Logged,
    /// It is not read, for this reason.
    LeftOut(String),
}

impl Understood {
    /// Says what was understood, a sentence each; nothing where the table is plain: commas, decimal
    /// points, names in its first line that stay as they are, and nothing left out.
    pub fn sentences(&self) -> Vec<String> {
        let columns = self.columns.iter().filter_map(UnderstoodColumn::sentence);
        let said: Vec<String> =
            self.left_out().into_iter().chain(columns).chain(self.notes.iter().cloned()).collect();
        match said.is_empty() && self.is_plain() {
            true => said,
            false => [vec![self.layout()], said].concat(),
        }
    }

    fn is_plain(&self) -> bool {
        self.separator == Separator::Character(',')
            && self.decimal == Decimal::Point
            && self.encoding == Encoding::Utf8
            && self.names_line == Some(1)
            && self.units_line.is_none()
    }

    fn layout(&self) -> String {
        let decimal = match self.decimal {
            Decimal::Point => "point",
            Decimal::Comma => "comma",
        };
        let names = match self.names_line {
            None => "no names".into(),
            Some(line) if self.names_in_comment => format!("names in the comment in line {line}"),
            Some(line) => format!("names in line {line}"),
        };
        let units = self.units_line.map(|line| format!(", units in line {line}"));
        let encoding = match self.encoding {
            Encoding::Utf8 => "",
            Encoding::Utf16 => "text in UTF-16, ",
            Encoding::Windows1252 => "text in Windows-1252, ",
        };
        format!(
            "understood: {encoding}separator {}, decimal {decimal}, {names}{}, {} from line {}",
            self.separator,
            units.unwrap_or_default(),
            counted(self.rows, "row"),
            self.first_line
        )
    }

    /// The rows and lines left out.
    fn left_out(&self) -> Option<String> {
        let above = self.lines_above.map(|[first, last]| match first == last {
            true => format!(" (line {first})"),
            false => format!(" (lines {first} to {last})"),
        });
        let parts = [
            (self.rows_above, "row above the table", above.unwrap_or_default()),
            (self.comments - usize::from(self.names_in_comment), "comment", String::new()),
            (self.empty_rows, "empty row", String::new()),
            (self.rows_below, "row below the table", String::new()),
        ];
        let parts: Vec<String> = parts
            .into_iter()
            .filter(|(count, ..)| *count > 0)
            .map(|(count, what, place)| counted(count, what) + &place)
            .collect();
        (!parts.is_empty()).then(|| format!("left out: {}", parts.join(", ")))
    }

    /// The columns whose name in the data is another than in the file, as pairs of both.
    pub fn renamed(&self) -> Vec<(String, String)> {
        let read = self.columns.iter().filter(|column| !matches!(column.role, Role::LeftOut(_)));
        read.filter(|column| column.written != column.name && !column.written.is_empty())
            .map(|column| (printable(&column.written).into_owned(), column.name.clone()))
            .collect()
    }
}

impl UnderstoodColumn {
    fn sentence(&self) -> Option<String> {
        let called = match self.written.is_empty() {
            true => &self.name,
            false => &self.written,
        };
        if let Role::LeftOut(reason) = &self.role {
            return Some(format!("column `{}` left out: {reason}", printable(called)));
        }
        let unit = match &*self.unit {
            "" | "1" => String::new(),
            unit => format!(" in {unit}"),
        };
        if self.written.is_empty() {
            return Some(format!("column without a name → {}{unit}", self.name));
        }
        (self.written != self.name || !unit.is_empty())
            .then(|| format!("`{}` → {}{unit}", printable(called), self.name))
    }
}

/// A number of things, in words.
fn counted(count: usize, what: &str) -> String {
    match (count, what.split_once(' ')) {
        (1, _) => format!("1 {what}"),
        (_, Some(("row", rest))) => format!("{count} rows {rest}"),
        _ => format!("{count} {what}s"),
    }
}
