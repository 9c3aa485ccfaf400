//! The lines above a table's numbers: titles, names, units.

use super::Options;
use super::cells::{Content, Decimal};
use super::names::is_identifier;
use super::rows::{Cell, split_plainly};
use super::sample::{Kind, Reading, Sample, is_number};
use super::separator::Separator;
use super::units;
use crate::import::Error;
use std::path::Path;

/// What stands above the numbers.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Header {
    /// The columns' names as written; none if there are none.
    pub names: Vec<String>,
    /// The columns' units, if there is a row of them.
    pub units: Vec<String>,
    pub names_line: Option<usize>,
    /// True if the names stand in a comment.
    pub in_comment: bool,
    pub units_line: Option<usize>,
    /// Rows of other text above the table, and the first and last line of them.
    pub skipped: usize,
    pub skipped_lines: Option<[usize; 2]>,
    /// The line of the first row of numbers.
    pub first_line: usize,
}

/// Finds the header of a sample, which has a row of numbers.
///
/// The names are the last row of text above the numbers; a row between them, all of whose cells are
/// units, is one of units. What stands above is a title. Where there is no row of names, a comment
/// of as many words as there are columns, directly above the numbers, has them.
pub(super) fn header(
    path: &Path,
    text: &str,
    sample: &Sample,
    reading: &Reading,
    options: &Options,
) -> Result<Header, Error> {
    let place = match options.skip {
        Some(_) => place_at_start(sample, reading, options),
        None => place(sample, reading),
    };
    let line = |row: usize| sample.rows[row].line;
    let mut header = Header { first_line: line(place.first), ..Header::default() };
    let above = place.names.or(place.units).unwrap_or(place.first);
    header.skipped = above;
    if let Some(units) = place.units {
        let stated = |cell: &Cell| units::stated(&cell.text).unwrap_or_default();
        header.units = sample.rows[units].cells.iter().map(stated).collect();
        header.units_line = Some(line(units));
    }
    match place.names.filter(|_| !options.no_header) {
        Some(names) => {
            header.names = cells_of(sample, names);
            header.names_line = Some(line(names));
        }
        None if options.no_header => header.skipped = place.units.unwrap_or(place.first),
        None => find_odd_names(path, text, sample, reading, options, &mut header, place.first)?,
    }
    if options.skip.is_none() {
        check_above(path, sample, reading, &header, place.first)?;
    }
    if header.skipped > 0 {
        header.skipped_lines = Some([line(0), line(header.skipped - 1)]);
    }
    Ok(header)
}

/// Refuses rows of numbers that would count as a title: those of several numbers, and those below
/// names.
fn check_above(
    path: &Path,
    sample: &Sample,
    reading: &Reading,
    header: &Header,
    first: usize,
) -> Result<(), Error> {
    let mut below_names = false;
    for row in 0..header.skipped {
        let numbers = reading.contents[row].iter().filter(|content| is_number(content)).count();
        let other =
            reading.contents[row].iter().filter(|content| **content == Content::Text).count();
        if numbers > 0 && other == 0 && (numbers > 1 || below_names && header.names.is_empty()) {
            let (line, found) = (sample.rows[row].line, reading.contents[row].len());
            let (expected, table) = (reading.kinds.len(), sample.rows[first].line);
            let table = header.names_line.unwrap_or(table);
            return Err(Error::NumbersAbove { path: path.into(), line, found, expected, table });
        }
        below_names |= reading.is_of_text(row) && reading.fits(row);
    }
    Ok(())
}

fn cells_of(sample: &Sample, row: usize) -> Vec<String> {
    sample.rows[row].cells.iter().map(|cell| cell.text.to_string()).collect()
}

/// Rows of a sample.
struct Place {
    names: Option<usize>,
    units: Option<usize>,
    first: usize,
}

/// Where a table begins with the first row.
fn place_at_start(sample: &Sample, reading: &Reading, options: &Options) -> Place {
    let names = (!options.no_header && !reading.matches[0]).then_some(0);
    let below = usize::from(names.is_some());
    let is_units =
        names.is_some() && below + 1 < sample.rows.len() && is_of_units(sample, reading, below);
    Place {
        names,
        units: is_units.then_some(below),
        first: (below + usize::from(is_units)).min(sample.rows.len() - 1),
    }
}

fn place(sample: &Sample, reading: &Reading) -> Place {
    let matching = reading.matches.iter().position(|matches| *matches).unwrap_or(0);
    let is_names = |row: usize| reading.is_of_text(row) && reading.fits(row);
    // Rows with text amid numbers are rows with a mistake, where names stand above them.
    let mut first = matching;
    while first > 0 && is_mixed(reading, first - 1) && !is_of_units(sample, reading, first - 1) {
        first -= 1;
    }
    let has_names = |first: usize| first > 0 && is_names(first - 1);
    if first < matching && !has_names(first) {
        // `wavelength,1,2` is a header if nothing better stands above it.
        let is_numbered = matching == first + 1 && is_numbered_header(sample, reading, first);
        return match is_numbered {
            true => Place { names: Some(first), units: None, first: matching },
            false => Place { names: None, units: None, first },
        };
    }
    match first {
        2.. if is_of_units(sample, reading, first - 1) && is_names(first - 2) => {
            Place { names: Some(first - 2), units: Some(first - 1), first }
        }
        1.. if is_names(first - 1) => Place { names: Some(first - 1), units: None, first },
        _ => Place { names: None, units: None, first },
    }
}

/// Returns true for a row of the table's width with numbers and text where numbers are.
fn is_mixed(reading: &Reading, row: usize) -> bool {
    reading.fits(row) && reading.has_number(row) && !reading.matches[row]
}

/// Returns true for a row of units, some of them not `1`.
fn is_of_units(sample: &Sample, reading: &Reading, row: usize) -> bool {
    let cells = &sample.rows[row].cells;
    let is_unit = |cell: &Cell| cell.text.is_empty() || units::stated(&cell.text).is_some();
    reading.fits(row) && cells.iter().all(is_unit) && reading.contents[row].contains(&Content::Text)
}

/// Returns true for a row of text and whole numbers, such as `wavelength,1,2`.
fn is_numbered_header(sample: &Sample, reading: &Reading, row: usize) -> bool {
    let is_name = |(cell, content): (&Cell, &Content)| match content {
        Content::Number(_) => cell.text.bytes().all(|byte| byte.is_ascii_digit()),
        Content::Text => cell.text.starts_with(char::is_alphabetic),
        content => *content == Content::Empty,
    };
    sample.rows[row].cells.iter().zip(&reading.contents[row]).all(is_name)
}

/// Looks for names that are separated otherwise than the rows, or stand in a comment.
fn find_odd_names(
    path: &Path,
    text: &str,
    sample: &Sample,
    reading: &Reading,
    options: &Options,
    header: &mut Header,
    first: usize,
) -> Result<(), Error> {
    let columns = reading.kinds.len();
    let row = &sample.rows[first];
    if let Some(above) = first.checked_sub(1).filter(|above| !reading.has_number(*above)) {
        let line = sample.rows[above].line;
        let written = text.lines().nth(line - 1).unwrap_or_default();
        // Words between blanks are a title, unless blanks separate the rows, too.
        let by_words = usize::from(sample.separator == Separator::Blanks);
        let separators = &Separator::KNOWN[..Separator::KNOWN.len() - 1 + by_words];
        if let Some(names) = names_in(written, columns, separators) {
            (header.names, header.names_line) = (names, Some(line));
            header.skipped = above;
            return Ok(());
        }
        check_length(path, sample, reading, above, first)?;
    }
    let comment = row.comment.filter(|(line, _)| line + 1 == row.line && options.skip.is_none());
    if let Some((line, words)) = comment
        && let Some(names) = names_in(words, columns, &[sample.separator])
    {
        (header.names, header.names_line, header.in_comment) = (names, Some(line), true);
    }
    Ok(())
}

/// Refuses a row of text above the numbers that looks like names, but of other columns.
fn check_length(
    path: &Path,
    sample: &Sample,
    reading: &Reading,
    above: usize,
    first: usize,
) -> Result<(), Error> {
    let (found, line) = (reading.kinds.len(), sample.rows[first].line);
    let names = &sample.rows[above].cells;
    let expected = names.iter().rposition(|cell| !cell.text.is_empty()).map_or(0, |last| last + 1);
    let in_words = sample.separator == Separator::Blanks && expected > found;
    if expected > 1 && !in_words {
        let missing = (expected..found).map(|column| format!("column_{}", column + 1 - expected));
        let known = names.iter().take(expected.min(found)).map(|cell| cell.text.to_string());
        let names: Vec<String> = missing.chain(known).collect();
        let remedy = format!("--skip {} --columns \"{}\"", line - 1, names.join(","));
        return Err(Error::HeaderLength { path: path.into(), line, found, expected, remedy });
    }
    let is_one = expected == 1 && is_identifier(&names[0].text);
    let by_commas = sample.separator == Separator::Character(',')
        && reading.notation.decimal == Decimal::Point
        && found == 2
        && reading.kinds.iter().all(|kind| *kind == Kind::Numbers);
    if is_one && by_commas {
        let text = sample.rows[first].cells.iter().map(|cell| &*cell.text).collect::<Vec<_>>();
        return Err(Error::OneOrTwo { path: path.into(), line, text: text.join(",") });
    }
    Ok(())
}

/// Splits a line into as many names as there are columns, if one of the separators does.
fn names_in(line: &str, columns: usize, separators: &[Separator]) -> Option<Vec<String>> {
    if columns < 2 {
        return None;
    }
    separators.iter().find_map(|&separator| {
        let mut cells = Vec::new();
        split_plainly(line, separator, &mut cells);
        let names: Vec<String> = cells.into_iter().map(|cell| cell.text.into_owned()).collect();
        let names = match separator {
            Separator::Blanks => with_units(names),
            Separator::Character(_) => names,
        };
        let names = names.into_iter().map(|name| name.trim_matches('"').to_owned());
        let names: Vec<String> = names.collect();
        let is_name = |name: &String| name.parse::<f64>().is_err() && !name.is_empty();
        (names.len() == columns && names.iter().all(is_name)).then_some(names)
    })
}

/// Joins words in brackets to the name before them: `Wavelength (nm)` is one.
fn with_units(words: Vec<String>) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    let mut is_open = false;
    for word in words {
        let joins = is_open || word.starts_with(['(', '[']);
        is_open = match word.ends_with([')', ']']) {
            true => false,
            false => is_open || word.contains(['(', '[']),
        };
        match names.last_mut().filter(|_| joins) {
            Some(name) => *name = format!("{name} {word}"),
            None => names.push(word),
        }
    }
    names
}
