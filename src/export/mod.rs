//! Datasets as files for other programs.

mod csv;

pub use csv::to_csv;

use crate::dataset::{Dataset, Split};

/// The rows of a dataset to export.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Rows {
    /// Those that formulas are fitted to.
    Search,
    /// Those that a front is judged on.
    Validation,
    /// First those of the search split, then those of the validation split; once where both splits
    /// are the same, as they are in small tables.
    #[default]
    Both,
}

impl Rows {
    /// The splits of a dataset that have the rows.
    pub fn of(self, dataset: &Dataset) -> Vec<&Split> {
        match self {
            Rows::Search => vec![&dataset.search],
            Rows::Validation => vec![&dataset.validation],
            Rows::Both if dataset.search == dataset.validation => vec![&dataset.search],
            Rows::Both => vec![&dataset.search, &dataset.validation],
        }
    }
}
