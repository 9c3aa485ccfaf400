//! Rows of cells: separators, quotes, comments.
//!
//! The cells are split here, not by a crate for CSV: runs of blanks separate, too, blanks may stand
//! before a quote, and each row must know its line. A test holds it against the crate `csv`.

use super::separator::Separator;
use std::borrow::Cow;

/// A cell without the blanks and quotes around it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Cell<'a> {
    pub text: Cow<'a, str>,
    pub quoted: bool,
}

/// The reason why a row cannot be split.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// A quote is opened and not closed.
    OpenQuote,
    /// It is longer than [`LONGEST_ROW`].
    Long,
    /// It has more than [`MOST_CELLS`] cells.
    Cells,
}

/// The most bytes of a row. By hand: the most columns of a dataset need a tenth.
pub const LONGEST_ROW: usize = 1 << 20;

/// The most cells of a row: the most columns, their standard errors, and some to leave out.
pub const MOST_CELLS: usize = 1 << 14;

/// Marks at the beginning of a line that make it a comment.
const COMMENTS: [&str; 4] = ["#", "//", "%", "!"];

/// What spreadsheets write for a value that there is not.
const SPREADSHEET_ERRORS: [&str; 7] =
    ["#N/A", "#DIV/0!", "#NUM!", "#VALUE!", "#REF!", "#NAME?", "#NULL!"];

/// The rows of a text from one of its lines on; blank rows and comments are counted.
#[derive(Clone)]
pub(super) struct Rows<'a> {
    text: &'a str,
    at: usize,
    line: usize,
    separator: Separator,
    has_quotes: bool,
    /// Rows of separators or rules alone.
    pub empty: usize,
    /// Lines of comments.
    pub comments: usize,
    /// The last comment since the last row.
    pub comment: Option<(usize, &'a str)>,
}

impl<'a> Rows<'a> {
    /// The rows after the first `skip` lines.
    pub fn after(text: &'a str, skip: usize, separator: Separator) -> Rows<'a> {
        let mut rows = Rows {
            text,
            at: 0,
            line: 1,
            separator,
            has_quotes: text.contains('"'),
            empty: 0,
            comments: 0,
            comment: None,
        };
        for _ in 0..skip {
            let end = rows.line_end(rows.at);
            rows.go_to(end);
        }
        rows
    }

    /// Splits the next row that is not blank into `cells`; returns its line, or `None` at the end.
    pub fn next(&mut self, cells: &mut Vec<Cell<'a>>) -> Result<Option<usize>, (usize, Fault)> {
        while self.at < self.text.len() {
            let (start, line) = (self.at, self.line);
            let end = self.line_end(start);
            let whole = &self.text[start..end];
            if whole.len() > LONGEST_ROW {
                return Err((line, Fault::Long));
            }
            let begun = whole.trim_start();
            if begun.is_empty() {
                self.go_to(end);
                continue;
            }
            if is_rule(begun) {
                self.empty += 1;
                self.go_to(end);
                continue;
            }
            if let Some(comment) = comment(begun) {
                self.comments += 1;
                self.comment = Some((line, comment));
                self.go_to(end);
                continue;
            }
            cells.clear();
            let end = match self.has_quotes && whole.contains('"') {
                false => {
                    split_plainly(whole, self.separator, cells);
                    end
                }
                true => {
                    start
                        + split_quoted(&self.text[start..], self.separator, cells)
                            .map_err(|fault| (line, fault))?
                }
            };
            if cells.len() > MOST_CELLS {
                return Err((line, Fault::Cells));
            }
            self.go_to(end);
            if cells.iter().all(|cell| cell.text.is_empty()) {
                self.empty += 1;
                continue;
            }
            return Ok(Some(line));
        }
        Ok(None)
    }

    fn line_end(&self, from: usize) -> usize {
        let rest = self.text.get(from..).unwrap_or_default();
        rest.find('\n').map_or(self.text.len(), |length| from + length)
    }

    /// Goes to the line after the one that ends at `end`.
    fn go_to(&mut self, end: usize) {
        let passed = self.text.get(self.at..end).unwrap_or_default();
        if self.has_quotes {
            self.line += passed.matches('\n').count();
        }
        self.line += 1;
        self.at = (end + 1).min(self.text.len() + 1);
    }
}

/// Returns true for a line drawn below a header: `-----`, `|---|:---|`, `====  ====`.
fn is_rule(line: &str) -> bool {
    line.starts_with(['-', '=', '+', '|', ':', '_'])
        && ["---", "===", "___"].iter().any(|part| line.contains(part))
        && line.trim_end().bytes().all(|byte| b"-=_+|: \t".contains(&byte))
}

/// The text of a line that is a comment, without its mark.
fn comment(line: &str) -> Option<&str> {
    let mark = COMMENTS.iter().find(|mark| line.starts_with(**mark))?;
    let is_cell = SPREADSHEET_ERRORS.iter().any(|error| line.starts_with(error));
    (!is_cell).then(|| line.trim_start_matches(mark).trim())
}

/// Splits a text by a separator, without regard to quotes.
pub(super) fn split_plainly<'a>(line: &'a str, separator: Separator, cells: &mut Vec<Cell<'a>>) {
    let cell = |text: &'a str| Cell { text: Cow::Borrowed(text.trim()), quoted: false };
    match separator {
        Separator::Character(c) => cells.extend(line.split(c).map(cell)),
        Separator::Blanks => {
            let parts = line.split(is_blank).filter(|part| !part.is_empty());
            cells.extend(parts.map(cell));
        }
    }
}

fn is_blank(c: char) -> bool {
    matches!(c, ' ' | '\t' | '\r' | '\u{c}')
}

/// Splits the row at the beginning of `text`, and returns its length. A cell that begins with a
/// quote ends with the next one that is not doubled; what follows that makes it no quoted cell.
fn split_quoted<'a>(
    text: &'a str,
    separator: Separator,
    cells: &mut Vec<Cell<'a>>,
) -> Result<usize, Fault> {
    let between = |c: char| match separator {
        Separator::Character(separator) => c == separator,
        Separator::Blanks => is_blank(c),
    };
    let mut at = 0;
    loop {
        let rest = &text[at..];
        let blank =
            |c: char| is_blank(c) && !matches!(separator, Separator::Character(s) if s == c);
        let start = at + (rest.len() - rest.trim_start_matches(blank).len());
        let quoted = text[start..].starts_with('"');
        let inside = match quoted {
            true => start + quoted_length(&text[start..])?,
            false => start,
        };
        let end = text[inside..].find(|c| c == '\n' || between(c));
        let end = end.map_or(text.len(), |length| inside + length);
        let pure = quoted && text[inside..end].trim().is_empty();
        let ends_row = end == text.len() || text[end..].starts_with('\n');
        let is_last_blank = separator == Separator::Blanks && start == end;
        if pure {
            let inner = &text[start + 1..inside - 1];
            let inner = match inner.contains("\"\"") {
                true => Cow::Owned(inner.replace("\"\"", "\"").trim().to_owned()),
                false => Cow::Borrowed(inner.trim()),
            };
            cells.push(Cell { text: inner, quoted });
        } else if !is_last_blank {
            cells.push(Cell { text: Cow::Borrowed(text[start..end].trim()), quoted: false });
        }
        if ends_row {
            return Ok(end);
        }
        if end > LONGEST_ROW || cells.len() > MOST_CELLS {
            return Err(if end > LONGEST_ROW { Fault::Long } else { Fault::Cells });
        }
        at = end + text[end..].chars().next().map_or(0, char::len_utf8);
    }
}

/// The bytes of a quoted cell with its quotes; `text` begins with one.
fn quoted_length(text: &str) -> Result<usize, Fault> {
    let bytes = &text.as_bytes()[..text.len().min(LONGEST_ROW)];
    let mut at = 1;
    while at < bytes.len() {
        if bytes[at] == b'"' {
            match bytes.get(at + 1) {
                Some(b'"') => at += 1,
                _ => return Ok(at + 1),
            }
        }
        at += 1;
    }
    Err(Fault::OpenQuote)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn split(text: &str, separator: Separator) -> Vec<(usize, Vec<String>)> {
        let mut rows = Rows::after(text, 0, separator);
        let (mut cells, mut found) = (Vec::new(), Vec::new());
        while let Some(line) = rows.next(&mut cells).unwrap() {
            found.push((line, cells.iter().map(|cell| cell.text.to_string()).collect()));
        }
        found
    }

    #[test]
    fn quotes_blanks_and_comments() {
        let text = "a, \"b, \"\"c\"\"\" ,\"d\ne\"\r\n# no\n\n ,,\n1,\"2\"3,4\n#N/A,5\n";
        let rows = split(text, Separator::Character(','));
        assert_eq!(rows[0], (1, ["a", "b, \"c\"", "d\ne"].map(String::from).to_vec()));
        assert_eq!(rows[1], (6, ["1", "\"2\"3", "4"].map(String::from).to_vec()));
        assert_eq!(rows[2], (7, ["#N/A", "5"].map(String::from).to_vec()));
        let rows = split("  1 \t2  \"3 4\" \n5 \"\" \r\n", Separator::Blanks);
        assert_eq!(rows[0].1, ["1", "2", "3 4"]);
        assert_eq!(rows[1].1, ["5", ""]);
        let open = Rows::after("a,\"b\n1,2\n", 0, Separator::Character(',')).next(&mut Vec::new());
        assert_eq!(open, Err((1, Fault::OpenQuote)));
    }

    #[test]
    fn rows_are_those_of_the_crate_csv() {
        let parts = ["a", "1", "\"", "\"\"", ",", "\n", "\"b,c\"", "\"x\ny\"", " "];
        let mut seed = 1u64;
        let mut below = |n: usize| {
            seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (seed >> 33) as usize % n
        };
        let mut compared = 0;
        for _ in 0..20_000 {
            let text: String = (0..1 + below(12)).map(|_| parts[below(parts.len())]).collect();
            let mut rows = Rows::after(&text, 0, Separator::Character(','));
            let (mut cells, mut ours) = (Vec::new(), Vec::new());
            let whole = loop {
                match rows.next(&mut cells) {
                    Ok(Some(_)) => ours
                        .push(cells.iter().map(|cell| cell.text.to_string()).collect::<Vec<_>>()),
                    Ok(None) => break true,
                    Err(_) => break false,
                }
            };
            // What is no CSV by RFC 4180 differs by intent: quotes amid a cell, or left open.
            let proper =
                !ours.iter().flatten().any(|cell| cell.contains('"')) && !text.contains(" \"");
            if !whole || !proper || text.contains("\" ") {
                continue;
            }
            let mut reader = csv::ReaderBuilder::new();
            let reader = reader.has_headers(false).flexible(true).trim(csv::Trim::All);
            let theirs: Vec<Vec<String>> = reader
                .from_reader(text.as_bytes())
                .records()
                .map(|record| record.unwrap().iter().map(|cell| cell.trim().into()).collect())
                .filter(|row: &Vec<String>| row.iter().any(|cell| !cell.is_empty()))
                .collect();
            assert_eq!(ours, theirs, "{text:?}");
            compared += 1;
        }
        assert!(compared > 3_000, "{compared}");
    }
}
