//! Imports tables of comma-separated numbers.

use super::select::unknown_column;
use super::{Column, Dataset, Error, LARGEST_FILE, Origin, Split, check_identifier, domain_of};
use crate::file::read_file;
use std::collections::HashSet;
use std::path::Path;

/// The column that holds weights, unless it is named as an input.
const WEIGHT: &str = "weight";

/// The suffix of the name of a column of standard errors.
const STANDARD_ERROR: &str = "_se";

/// Tables with fewer rows are validated on the rows they are searched on. By hand: a validation
/// split of fewer than four rows says little.
const MIN_ROWS_TO_SPLIT: usize = 16;

/// The columns of a table that are inputs; the rest are outputs, in file order.
#[derive(Clone, Debug, PartialEq)]
pub enum InputColumns {
    /// The first columns, as many as this, not counting a column of weights.
    Count(usize),
    /// The columns of these names, in this order.
    Names(Vec<String>),
}

/// A table of numbers as its file has it, column-major.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// The columns' names.
    pub names: Vec<String>,
    /// The columns, each of as many values as there are rows.
    pub columns: Vec<Vec<f32>>,
    /// The line of each row in the file.
    pub lines: Vec<usize>,
}

impl Table {
    /// Reads a table as [`import_csv`] does; it has at least one row.
    ///
    /// # Errors
    /// As [`import_csv`], about the file and its cells.
    pub fn read(path: &Path) -> Result<Table, Error> {
        Table::parse(path, &read_text(path)?)
    }

    /// Parses the text of a table; errors name `path`.
    ///
    /// # Errors
    /// As [`Table::read`], about the content.
    pub fn parse(path: &Path, text: &str) -> Result<Table, Error> {
        parse(path, text)
    }

    /// Makes a dataset of a table, as [`import_csv`] does.
    ///
    /// # Errors
    /// As [`import_csv`], about the columns.
    pub fn dataset(self, path: &Path, inputs: &InputColumns) -> Result<Dataset, Error> {
        imported(path, self, inputs)
    }

    /// Returns the index of a column; errors name `path`.
    ///
    /// # Errors
    /// No column of this name, with a suggestion.
    pub fn index_of(&self, path: &Path, name: &str) -> Result<usize, Error> {
        let names = self.names.iter().map(String::as_str);
        let index = self.names.iter().position(|column| column == name);
        index.ok_or_else(|| unknown_column(path.into(), name, names))
    }
}

/// Imports a table: comma-separated numbers in UTF-8 under one line of column names, which must be
/// identifiers. Blank lines, a byte-order mark, and spaces and quotes around cells are ignored.
///
/// A column `weight` that is not among `inputs` holds the rows' weights, and is neither input nor
/// output; nor is `y_se` if `y` is an output: it holds the standard errors of `y`.
///
/// One row of each four consecutive ones, at a position scattered so that it does not follow the
/// axes of a grid, goes to the validation split. The first row at the minimum and at the maximum of
/// each input stays in the search split, so that validation never extrapolates. With fewer than 16
/// rows both splits hold them all.
///
/// # Errors
/// A file that cannot be read, is empty, or has no header or no rows; a name that is not an
/// identifier or occurs twice; a row of another length; a cell that is not a finite number in the
/// range of f32; an unknown input; no column left as an output.
pub fn import_csv(path: &Path, inputs: &InputColumns) -> Result<Dataset, Error> {
    imported(path, Table::read(path)?, inputs)
}

fn imported(path: &Path, mut table: Table, inputs: &InputColumns) -> Result<Dataset, Error> {
    let weights = take_weights(path, &mut table, inputs)?;
    let standard_errors = take_standard_errors(path, &mut table, inputs)?;
    let order = column_order(path, &table.names, inputs)?;
    let Table { names, mut columns, .. } = table;
    let columns: Vec<Vec<f32>> =
        order.columns.iter().map(|&index| std::mem::take(&mut columns[index])).collect();
    let outputs = order.columns[order.inputs..].iter().map(|&index| &names[index]);
    let errors_of = |name| standard_errors.iter().find(|(output, _)| output == name);
    let standard_errors = match standard_errors.is_empty() {
        true => Vec::new(),
        false => outputs
            .map(|name| errors_of(name).map_or(vec![0.0; columns[0].len()], |(_, e)| e.clone()))
            .collect(),
    };
    let whole = Split { columns, weights, standard_errors, ..Split::default() };
    let (search, validation) = split_rows(&whole, order.inputs);
    let described = order.columns.iter().enumerate().map(|(position, &index)| Column {
        name: names[index].clone(),
        unit: String::new(),
        domain: domain_of(&search, &validation, position),
    });
    let mut inputs: Vec<Column> = described.collect();
    let outputs = inputs.split_off(order.inputs);
    let lossy = |part: Option<&std::ffi::OsStr>| {
        part.map(|part| part.to_string_lossy().into_owned()).unwrap_or_default()
    };
    let dataset = Dataset {
        name: lossy(path.file_stem()),
        origin: Origin::Import { file: lossy(path.file_name()) },
        inputs,
        outputs,
        search,
        validation,
        ..Dataset::default()
    };
    dataset.validate_as(path)?;
    Ok(dataset)
}

fn read_text(path: &Path) -> Result<String, Error> {
    let bytes = read_file(path, LARGEST_FILE).map_err(|source| Error::unread(path, source))?;
    String::from_utf8(bytes).map_err(|error| {
        let valid = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        let line = 1 + valid.iter().filter(|&&byte| byte == b'\n').count();
        Error::NotText { path: path.into(), line }
    })
}

fn parse(path: &Path, text: &str) -> Result<Table, Error> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut lines = (1..).zip(text.lines()).filter(|(_, line)| !line.trim().is_empty());
    let Some((header_line, header)) = lines.next() else {
        return Err(Error::Empty { path: path.into() });
    };
    let names = parse_header(path, header_line, header)?;
    let mut columns = vec![Vec::new(); names.len()];
    let mut row_lines = Vec::new();
    for (line, row) in lines {
        let found = row.split(',').count();
        if found != names.len() {
            let expected = names.len();
            return Err(Error::RaggedRow { path: path.into(), line, found, expected });
        }
        row_lines.push(line);
        for ((text, name), column) in row.split(',').map(unquoted).zip(&names).zip(&mut columns) {
            column.push(parse_cell(path, line, name, text)?);
        }
    }
    if row_lines.is_empty() {
        return Err(Error::HeaderOnly { path: path.into() });
    }
    Ok(Table { names, columns, lines: row_lines })
}

fn parse_header(path: &Path, line: usize, header: &str) -> Result<Vec<String>, Error> {
    let names: Vec<&str> = header.split(',').map(unquoted).collect();
    for (character, separator) in [(';', "semicolons"), ('\t', "tabs")] {
        if names.len() == 1 && header.trim().contains(character) {
            return Err(Error::Separator { path: path.into(), line, separator });
        }
    }
    if names.iter().all(|name| name.parse::<f64>().is_ok_and(f64::is_finite)) {
        return Err(Error::NoHeader { path: path.into(), line });
    }
    let mut seen = HashSet::new();
    for name in &names {
        check_identifier(path, Some(line), name)?;
        if !seen.insert(*name) {
            let column = (*name).into();
            return Err(Error::DuplicateColumn { path: path.into(), column });
        }
    }
    Ok(names.into_iter().map(Into::into).collect())
}

fn unquoted(cell: &str) -> &str {
    let cell = cell.trim();
    let inner = cell.strip_prefix('"').and_then(|cell| cell.strip_suffix('"'));
    inner.map_or(cell, str::trim)
}

fn parse_cell(path: &Path, line: usize, column: &str, text: &str) -> Result<f32, Error> {
    let (path, column, owned) = (path.to_path_buf(), column.to_owned(), text.to_owned());
    let Ok(value) = text.parse::<f64>() else {
        return Err(Error::Cell { path, line, column, text: owned });
    };
    let narrow = value as f32;
    if narrow.is_finite() {
        return Ok(narrow);
    }
    let written_in_digits = text.contains(|c: char| c.is_ascii_digit());
    Err(match written_in_digits {
        true => Error::CellOverflow { path, line, column, text: owned },
        false => Error::CellNotFinite { path, line, column, text: owned },
    })
}

fn take_weights(path: &Path, table: &mut Table, inputs: &InputColumns) -> Result<Vec<f32>, Error> {
    let named = matches!(inputs, InputColumns::Names(names) if names.iter().any(|n| n == WEIGHT));
    let weight = table.names.iter().position(|name| name == WEIGHT);
    let Some(index) = weight.filter(|_| !named) else {
        return Ok(Vec::new());
    };
    table.names.remove(index);
    let weights = table.columns.remove(index);
    match weights.iter().zip(&table.lines).find(|(weight, _)| **weight < 0.0) {
        None => Ok(weights),
        Some((&value, &line)) => {
            let (path, column) = (path.into(), WEIGHT.into());
            Err(Error::NegativeWeight { path, line, column, value })
        }
    }
}

/// Takes the columns of standard errors out of the table, each with the name of its output.
fn take_standard_errors(
    path: &Path,
    table: &mut Table,
    inputs: &InputColumns,
) -> Result<Vec<(String, Vec<f32>)>, Error> {
    let mut taken = Vec::new();
    let is_input = |index: usize, name: &str| match inputs {
        InputColumns::Count(count) => index < *count,
        InputColumns::Names(names) => names.iter().any(|input| input == name),
    };
    for index in (0..table.names.len()).rev() {
        let name = &table.names[index];
        let of = name.strip_suffix(STANDARD_ERROR).map(str::to_owned);
        let of = of.filter(|_| !is_input(index, name)).and_then(|of| {
            let place = table.names.iter().position(|column| *column == of)?;
            (!is_input(place, &of)).then_some(of)
        });
        let Some(of) = of else { continue };
        let column = table.names.remove(index);
        let errors = table.columns.remove(index);
        if let Some((&value, &line)) =
            errors.iter().zip(&table.lines).find(|(error, _)| **error < 0.0)
        {
            return Err(Error::NegativeError { path: path.into(), line, column, value });
        }
        taken.push((of, errors));
    }
    Ok(taken)
}

/// Indices of the table's columns, inputs first.
struct Order {
    columns: Vec<usize>,
    inputs: usize,
}

fn column_order(path: &Path, names: &[String], inputs: &InputColumns) -> Result<Order, Error> {
    let mut columns = match inputs {
        InputColumns::Count(0) => return Err(Error::NoInputs { path: path.into() }),
        InputColumns::Count(asked) if *asked >= names.len() => {
            let columns = names.len();
            return Err(Error::TooManyInputs { path: path.into(), asked: *asked, columns });
        }
        InputColumns::Count(asked) => (0..*asked).collect(),
        InputColumns::Names(asked) => named_columns(path, names, asked)?,
    };
    let inputs = columns.len();
    if inputs == 0 {
        return Err(Error::NoInputs { path: path.into() });
    }
    if inputs == names.len() {
        return Err(Error::NoOutputs { path: path.into() });
    }
    let rest: Vec<usize> = (0..names.len()).filter(|index| !columns.contains(index)).collect();
    columns.extend(rest);
    Ok(Order { columns, inputs })
}

fn named_columns(path: &Path, names: &[String], asked: &[String]) -> Result<Vec<usize>, Error> {
    let mut columns = Vec::new();
    for name in asked {
        let Some(index) = names.iter().position(|column| column == name) else {
            return Err(unknown_column(path.into(), name, names.iter().map(String::as_str)));
        };
        if columns.contains(&index) {
            return Err(Error::DuplicateColumn { path: path.into(), column: name.clone() });
        }
        columns.push(index);
    }
    Ok(columns)
}

fn split_rows(whole: &Split, inputs: usize) -> (Split, Split) {
    let rows = whole.rows();
    if rows < MIN_ROWS_TO_SPLIT {
        return (whole.clone(), whole.clone());
    }
    let kept: HashSet<usize> =
        whole.columns.iter().take(inputs).flat_map(|c| extremes(c)).collect();
    let (validation, search): (Vec<usize>, Vec<usize>) =
        (0..rows).partition(|row| held_out(*row) && !kept.contains(row));
    if validation.is_empty() {
        let all = gather(whole, &search);
        return (all.clone(), all);
    }
    (gather(whole, &search), gather(whole, &validation))
}

fn extremes(values: &[f32]) -> [usize; 2] {
    let mut rows = [0, 0];
    for (row, &value) in values.iter().enumerate() {
        if value < values[rows[0]] {
            rows[0] = row;
        }
        if value > values[rows[1]] {
            rows[1] = row;
        }
    }
    rows
}

/// Returns true for the row of each block of four that goes to validation. Its position comes from
/// a hash of the block: every fourth row of a grid would be a few whole columns of the grid.
fn held_out(row: usize) -> bool {
    let block = (row / 4) as u64;
    // The output function of SplitMix64 (Steele, Lea, Flood 2014).
    let mut bits = block.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    bits ^= bits >> 31;
    bits % 4 == (row % 4) as u64
}

fn gather(whole: &Split, rows: &[usize]) -> Split {
    let pick = |values: &Vec<f32>| rows.iter().map(|&row| values[row]).collect::<Vec<f32>>();
    Split {
        columns: whole.columns.iter().map(pick).collect(),
        weights: if whole.weights.is_empty() { Vec::new() } else { pick(&whole.weights) },
        standard_errors: whole.standard_errors.iter().map(pick).collect(),
        ..Split::default()
    }
}
