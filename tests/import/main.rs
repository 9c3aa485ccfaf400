//! Tables as people have them: how they are written is found, shown and can be overruled; what
//! could mean something else is refused.

mod export;
mod limits;
mod mutations;
mod options;
mod plain;
mod tables;

use lgp::dataset::{Column, Dataset};
use lgp::import::Error;
use lgp::import::table::{Options, Understood, parse, read};
use std::path::{Path, PathBuf};

pub fn names(columns: &[Column]) -> Vec<&str> {
    columns.iter().map(|column| column.name.as_str()).collect()
}

pub fn strings(names: &[&str]) -> Vec<String> {
    names.iter().map(|&name| name.into()).collect()
}

/// A table in the folder beside this file.
pub fn table(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/import/tables").join(name)
}

/// Reads a table without options.
pub fn read_table(name: &str) -> (Dataset, Understood) {
    read(&table(name), &Options::default()).unwrap_or_else(|error| panic!("{error}"))
}

/// Reads a text as a table.
pub fn read_text(text: &str, options: &Options) -> Result<(Dataset, Understood), Error> {
    parse(Path::new("table.csv"), text.as_bytes().to_vec(), options)
}

/// Returns what is said of a table that is refused.
pub fn refusal(text: &str, options: &Options) -> String {
    match read_text(text, options) {
        Ok((_, understood)) => panic!("{text:?} is read: {:?}", understood.sentences()),
        Err(error) => error.to_string(),
    }
}

/// All rows of a small dataset's column, in the order of their first input.
pub fn sorted(data: &Dataset, column: usize) -> Vec<f32> {
    let splits = match data.search == data.validation {
        true => vec![&data.search],
        false => vec![&data.search, &data.validation],
    };
    let rows = splits.iter().flat_map(|split| {
        split.columns[0].iter().copied().zip(split.columns[column].iter().copied())
    });
    let mut rows: Vec<(f32, f32)> = rows.collect();
    rows.sort_by(|a, b| a.0.total_cmp(&b.0));
    rows.into_iter().map(|(_, value)| value).collect()
}
