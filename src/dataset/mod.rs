//! Tables of samples that a search is fitted to and judged on.
//!
//! A [`Dataset`] names its input and output columns and holds two disjoint sets of rows, the search
//! split and the validation split. It is made from a function ([`Dataset::sampled`]) or a table
//! ([`crate::import`]), and stored in a checksummed binary file (`.bin`, see [`Dataset::save`]).
//!
//! ```
//! use lgp::dataset::{Dataset, axis};
//!
//! let data = Dataset::sampled([axis("x", 0.0..=2.0)], ["y"], |[x]| [x.sin()])?;
//! assert_eq!(data.search.rows(), 256);
//! let bytes = data.to_bytes("sine.bin".as_ref())?;
//! assert_eq!(Dataset::parse("sine.bin".as_ref(), &bytes)?, data);
//! # Ok::<(), lgp::dataset::Error>(())
//! ```

mod claims;
mod error;
mod format;
mod incumbent;
mod name;
mod origin;
mod prune;
mod sampled;
mod select;
mod unit;

pub use claims::check_claims;
pub(crate) use claims::claims_over;
pub use error::Error;
pub use incumbent::{Incumbent, ParsedIncumbent, incumbents_file, incumbents_for, load_incumbents};
pub use name::{LONGEST_NAME, NameFault, check_name, check_text};
pub use origin::{Function, Origin};
pub(crate) use sampled::combinations;
pub use sampled::{Axis, Spacing, axis, grid_weights};
pub(crate) use select::unknown_column;
pub use unit::{joint_unit, output_units, unit};

use crate::program::Names;
use serde::{Deserialize, Serialize};
use std::collections::HashSet;
use std::path::{Path, PathBuf};

/// One column of a dataset.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Column {
    /// An identifier, `[A-Za-z_][A-Za-z0-9_]*`. It may also be the name of an operation, or a
    /// keyword of some language.
    pub name: String,
    /// The unit; `""` or `"1"` if dimensionless.
    pub unit: String,
    /// The smallest and largest meaningful value; for an output, the range of its values.
    pub domain: [f64; 2],
}

impl Column {
    /// Makes a dimensionless column.
    pub fn new(name: &str, domain: [f64; 2]) -> Column {
        Column { name: name.to_owned(), unit: "1".to_owned(), domain }
    }
}

/// Rows of samples, column-major.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Split {
    /// The inputs, then the outputs, each of [`rows`](Split::rows) values.
    pub columns: Vec<Vec<f32>>,
    /// One weight per row; empty if all are one.
    pub weights: Vec<f32>,
    /// The error of each row that nobody sees ([`crate::scene::Quantisation`]), by output; empty if
    /// all errors count.
    pub dead_zone: Vec<Vec<f32>>,
    /// The standard error of each row's value, as a simulation or an instrument states it, by
    /// output; empty if values are exact to the rounding of `f32`. Smaller differences decide
    /// nothing.
    pub standard_errors: Vec<Vec<f32>>,
    /// The points along each input axis, the first input varying slowest, if the rows are a full
    /// regular grid; empty otherwise.
    pub grid: Vec<usize>,
}

impl Split {
    /// Returns the number of rows: the length of the first column.
    pub fn rows(&self) -> usize {
        self.columns.first().map_or(0, Vec::len)
    }

    /// Returns the weight of a row; one if the split is unweighted.
    pub fn weight(&self, row: usize) -> f32 {
        self.weights.get(row).copied().unwrap_or(1.0)
    }
}

/// Named samples of a function, in two disjoint splits.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Dataset {
    /// The name of its file and of runs on it ([`check_name`]).
    pub name: String,
    /// The source of its rows.
    pub origin: Origin,
    /// The input columns.
    pub inputs: Vec<Column>,
    /// The output columns.
    pub outputs: Vec<Column>,
    /// The claims of its outputs, as text ([`crate::program::Claim`]).
    pub claims: Vec<String>,
    /// The rows that formulas are fitted to.
    pub search: Split,
    /// The rows that a front is judged on.
    pub validation: Split,
}

impl Dataset {
    /// Checks all that other modules rely on: a name that can name a file ([`check_name`]); at
    /// least one input, one output and one row in each split, at most [`MAX_COLUMNS`] and
    /// [`MAX_ROWS`]; unique identifiers as columns' names, units of one line; claims over them
    /// ([`check_claims`]); ordered domains within f32; columns of equal length holding finite
    /// values; weights that are finite, not negative, and not all zero; a grid that multiplies to
    /// the rows.
    ///
    /// # Errors
    /// The first violation. Its `path` is the dataset's name.
    pub fn validate(&self) -> Result<(), Error> {
        self.validate_as(Path::new(&self.name))
    }

    /// [`Dataset::validate`], for the file at `path`.
    pub(crate) fn validate_as(&self, path: &Path) -> Result<(), Error> {
        check_name(&self.name).map_err(|fault| Error::Name {
            path: path.into(),
            name: self.name.clone(),
            fault,
        })?;
        if self.inputs.is_empty() {
            return Err(Error::NoInputs { path: path.into() });
        }
        if self.outputs.is_empty() {
            return Err(Error::NoOutputs { path: path.into() });
        }
        check_columns(path, self.columns())?;
        check_claims(path, &self.claims, &self.names())?;
        self.validate_split(path, "search", &self.search)?;
        self.validate_split(path, "validation", &self.validation)
    }

    fn origin(&self) -> PathBuf {
        PathBuf::from(&self.name)
    }

    /// Returns the columns' names.
    pub fn names(&self) -> Names {
        let [inputs, outputs] = [&self.inputs, &self.outputs]
            .map(|columns| columns.iter().map(|column| column.name.clone()));
        Names::new(inputs, outputs)
    }

    fn columns(&self) -> impl Iterator<Item = &Column> {
        self.inputs.iter().chain(&self.outputs)
    }

    /// Validates the columns beside the outputs, one for each or none.
    fn validate_beside(
        &self,
        path: &Path,
        split: &'static str,
        (called, columns): (&'static str, &[Vec<f32>]),
        rows: usize,
    ) -> Result<(), Error> {
        if columns.is_empty() {
            return Ok(());
        }
        let (found, expected) = (columns.len(), self.outputs.len());
        if found != expected {
            return Err(Error::ColumnCount { path: path.into(), split, found, expected });
        }
        for column in columns {
            validate_values(path, split, called, column, rows)?;
            if let Some(row) = column.iter().position(|error| *error < 0.0) {
                let value = column[row];
                return Err(Error::Negative {
                    path: path.into(),
                    split,
                    called,
                    row: row + 1,
                    value,
                });
            }
        }
        Ok(())
    }

    fn validate_split(&self, path: &Path, split: &'static str, rows: &Split) -> Result<(), Error> {
        let expected = self.inputs.len() + self.outputs.len();
        let found = rows.columns.len();
        if found != expected {
            return Err(Error::ColumnCount { path: path.into(), split, found, expected });
        }
        match rows.rows() {
            0 => return Err(Error::NoRows { path: path.into(), split }),
            1..=MAX_ROWS => {}
            rows => return Err(Error::TooManyRows { path: path.into(), split, rows }),
        }
        for (column, values) in self.columns().zip(&rows.columns) {
            validate_values(path, split, &column.name, values, rows.rows())?;
        }
        validate_weights(path, split, rows)?;
        for beside in [("dead zones", &rows.dead_zone), ("standard errors", &rows.standard_errors)]
        {
            let (called, columns) = beside;
            self.validate_beside(path, split, (called, columns), rows.rows())?;
        }
        let points = rows.grid.iter().try_fold(1usize, |product, &n| product.checked_mul(n));
        let fits = rows.grid.len() == self.inputs.len() && points == Some(rows.rows());
        if !rows.grid.is_empty() && !fits {
            return Err(Error::Grid {
                path: path.into(),
                split,
                grid: rows.grid.clone(),
                rows: rows.rows(),
            });
        }
        Ok(())
    }
}

/// The most columns of a dataset. Formulas index them by 16 bits, and scenes add values to them.
pub const MAX_COLUMNS: usize = 4096;
/// The most bytes of a file of a dataset or table. By hand: it is read into memory.
pub const LARGEST_FILE: u64 = 1 << 30;
/// The most rows of a split: those of one column in the largest file.
pub const MAX_ROWS: usize = 1 << 28;

/// Checks that there are not too many columns, that their names are unique identifiers, units of
/// one line, and domains ordered and within f32.
///
/// # Errors
/// The first violation, at `path`.
pub fn check_columns<'a>(
    path: &Path,
    columns: impl Iterator<Item = &'a Column>,
) -> Result<(), Error> {
    let mut seen = HashSet::new();
    for column in columns {
        check_identifier(path, None, &column.name)?;
        if !seen.insert(column.name.as_str()) {
            return Err(Error::DuplicateColumn { path: path.into(), column: column.name.clone() });
        }
        check_text(&column.unit).map_err(|fault| Error::Unit {
            path: path.into(),
            column: column.name.clone(),
            fault,
        })?;
        let [low, high] = column.domain;
        let narrow = |end: f64| (end as f32).is_finite();
        if !(narrow(low) && narrow(high) && low <= high) {
            return Err(Error::Domain {
                path: path.into(),
                column: column.name.clone(),
                low,
                high,
            });
        }
    }
    match seen.len() {
        0..=MAX_COLUMNS => Ok(()),
        columns => Err(Error::TooManyColumns { path: path.into(), columns }),
    }
}

fn validate_values(
    path: &Path,
    split: &'static str,
    column: &str,
    values: &[f32],
    expected: usize,
) -> Result<(), Error> {
    if values.len() != expected {
        return Err(Error::UnequalColumns {
            path: path.into(),
            split,
            column: column.into(),
            found: values.len(),
            expected,
        });
    }
    match values.iter().position(|value| !value.is_finite()) {
        None => Ok(()),
        Some(row) => Err(Error::NotFinite {
            path: path.into(),
            split,
            column: column.into(),
            row: row + 1,
            value: values[row],
        }),
    }
}

fn validate_weights(path: &Path, split: &'static str, rows: &Split) -> Result<(), Error> {
    if rows.weights.is_empty() {
        return Ok(());
    }
    if rows.weights.len() != rows.rows() {
        return Err(Error::UnequalColumns {
            path: path.into(),
            split,
            column: "weight".into(),
            found: rows.weights.len(),
            expected: rows.rows(),
        });
    }
    if let Some(row) = rows.weights.iter().position(|w| !(w.is_finite() && *w >= 0.0)) {
        let value = rows.weights[row];
        return Err(Error::BadWeight { path: path.into(), split, row: row + 1, value });
    }
    if rows.weights.iter().all(|&w| w == 0.0) {
        return Err(Error::ZeroWeights { path: path.into(), split });
    }
    Ok(())
}

fn check_identifier(path: &Path, line: Option<usize>, name: &str) -> Result<(), Error> {
    let mut chars = name.chars();
    let starts = chars.next().is_some_and(|c| c.is_ascii_alphabetic() || c == '_');
    if starts && name.len() <= LONGEST_NAME && chars.all(|c| c.is_ascii_alphanumeric() || c == '_')
    {
        return Ok(());
    }
    Err(Error::ColumnName {
        path: path.into(),
        line,
        column: name.into(),
        suggestion: identifier_of(name),
    })
}

/// Makes an identifier of a name that is not one: `n·v (1)` becomes `n_v_1`.
pub(crate) fn identifier_of(name: &str) -> String {
    let words: Vec<&str> =
        name.split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| !word.is_empty()).collect();
    let joined = words.join("_");
    let joined: String = joined.chars().take(LONGEST_NAME / 2).collect();
    match joined.chars().next() {
        None => "value".into(),
        Some(first) if first.is_ascii_digit() => format!("_{joined}"),
        Some(_) => joined,
    }
}

/// Returns the smallest and largest of finite values, or `[0, 0]` if there are none.
fn range(values: impl IntoIterator<Item = f32>) -> [f64; 2] {
    let [low, high] = values
        .into_iter()
        .map(f64::from)
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| [low.min(v), high.max(v)]);
    if low <= high { [low, high] } else { [0.0, 0.0] }
}

/// Returns the domain of column `index`: the range of its values in both splits.
pub(crate) fn domain_of(search: &Split, validation: &Split, index: usize) -> [f64; 2] {
    let column = |split: &Split| split.columns.get(index).cloned().unwrap_or_default();
    range(column(search).into_iter().chain(column(validation)))
}
