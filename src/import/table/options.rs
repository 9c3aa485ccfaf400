//! What the caller says of a table.

use super::{Decimal, Separator};

/// The columns of a table that are inputs.
#[derive(Clone, Debug, PartialEq)]
pub enum InputColumns {
    /// The first columns of numbers, as many as this, not counting one of weights.
    Count(usize),
    /// The columns of these names, in this order.
    Names(Vec<String>),
}

/// How a table is written and what of it is read, where the file does not say it or says it wrongly.
/// Columns are named as in the dataset or as in the file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Options {
    /// What stands between columns.
    pub separator: Option<Separator>,
    /// The sign before decimals; the other one then groups digits, as in `1,234.5`.
    pub decimal: Option<Decimal>,
    /// The lines before the table; its next line has the names, or the first row.
    pub skip: Option<usize>,
    /// The most rows to read.
    pub rows: Option<usize>,
    /// True if no line has names.
    pub no_header: bool,
    /// The names of all columns of the file.
    pub columns: Option<Vec<String>>,
    /// Columns to leave out.
    pub drop: Vec<String>,
    /// The inputs; without them all columns that are not `outputs`.
    pub inputs: Option<InputColumns>,
    /// The outputs; without them all columns that are not `inputs`, or the last one.
    pub outputs: Option<Vec<String>>,
    /// The column of weights; without it `weight`, if there is one.
    pub weights: Option<String>,
    /// Domains of inputs, in place of the range of their values.
    pub domains: Vec<(String, [f64; 2])>,
    /// Powers of ten that columns are multiplied by: `("y", 20)` for `y · 1e20`.
    pub scales: Vec<(String, i32)>,
}

impl Options {
    /// Takes these columns as inputs, and all else as the file says.
    pub fn of_inputs(inputs: InputColumns) -> Options {
        Options { inputs: Some(inputs), ..Options::default() }
    }
}
