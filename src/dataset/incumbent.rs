//! Incumbents: published formulas for a dataset, scored on the same axes as a front's members.

use super::{Dataset, Error, check_text};
use crate::file::read_text;
use crate::program::{Names, Program, parse, parse_open};
use serde::Deserialize;
use std::path::{Path, PathBuf};

/// A published formula, as a file in `datasets/incumbents` lists it.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Incumbent {
    /// The name in tables and plots, unique in its file.
    pub name: String,
    /// The citation: author, title, venue, year.
    pub source: String,
    /// Formula text over the dataset's columns.
    pub formula: String,
    /// The joint cycles of all its outputs in the published form, if known.
    #[serde(default)]
    pub cost: Option<f64>,
    /// A remark; may be empty.
    #[serde(default)]
    pub note: String,
}

/// An incumbent parsed over a dataset's columns.
#[derive(Clone, Debug, PartialEq)]
pub struct ParsedIncumbent {
    /// The incumbent as its file lists it.
    pub incumbent: Incumbent,
    /// The formula over the dataset's inputs, with one output for each of `outputs`.
    pub program: Program,
    /// The outputs of the dataset that the formula defines, in the dataset's order: it is scored on
    /// these.
    pub outputs: Vec<String>,
}

impl Incumbent {
    /// Parses the formula over a dataset's columns; none if it uses other inputs or defines none of
    /// the outputs.
    pub fn compared_on(&self, dataset: &Dataset) -> Option<ParsedIncumbent> {
        let inputs: Vec<&str> = dataset.inputs.iter().map(|column| column.name.as_str()).collect();
        let over = |outputs: &[String]| {
            let outputs = outputs.iter().map(String::as_str);
            parse(&self.formula, &Names::new(inputs.iter().copied(), outputs)).ok()
        };
        let names = dataset.outputs.iter().map(|column| column.name.clone());
        let outputs: Vec<String> =
            names.filter(|name| over(std::slice::from_ref(name)).is_some()).collect();
        let program = over(&outputs).filter(|_| !outputs.is_empty())?;
        Some(ParsedIncumbent { incumbent: self.clone(), program, outputs })
    }
}

/// Reads a list of incumbents, in RON.
///
/// # Errors
/// A file that cannot be read or is not a list of incumbents, two incumbents of one name, or a text
/// that is not a formula.
pub fn load_incumbents(path: &Path) -> Result<Vec<Incumbent>, Error> {
    let text = read_text(path).map_err(|source| Error::unread(path, source))?;
    let refused = |line, problem| Error::Incumbents { path: path.into(), line, problem };
    let incumbents: Vec<Incumbent> = ron::from_str(&text)
        .map_err(|error| refused(error.span.start.line, error.code.to_string()))?;
    for (index, incumbent) in incumbents.iter().enumerate() {
        let name = &incumbent.name;
        if let Err(fault) = check_text(name) {
            let line = line_naming(&text, name, 0);
            return Err(refused(line, format!("a formula cannot be called {name:?}: {fault}")));
        }
        if incumbents[..index].iter().any(|earlier| earlier.name == *name) {
            let line = line_naming(&text, name, 1);
            return Err(refused(line, format!("`{name}` occurs twice; name each incumbent once")));
        }
        parse_open(&incumbent.formula, &[])
            .map_err(|error| refused(line_naming(&text, name, 0), format!("`{name}`: {error}")))?;
    }
    Ok(incumbents)
}

/// Returns the line on which a quoted name occurs, after `skipped` occurrences.
fn line_naming(text: &str, name: &str, skipped: usize) -> usize {
    let quoted = format!("{name:?}");
    let mut lines = (1..).zip(text.lines()).filter(|(_, line)| line.contains(&quoted));
    lines.nth(skipped).map_or(1, |(line, _)| line)
}

/// Returns the file that lists a dataset's incumbents, if there is one: `incumbents/<name>.ron`
/// beside the dataset's file, after its name, or else after the target of its rows.
pub fn incumbents_file(dataset_path: &Path, dataset: &Dataset) -> Option<PathBuf> {
    let folder = dataset_path.parent()?.join("incumbents");
    let names = [Some(dataset.name.clone()), dataset.origin.target()];
    let files = names.into_iter().flatten().map(|name| folder.join(name + ".ron"));
    files.into_iter().find(|file| file.is_file())
}

/// Returns the incumbents that are comparable on a dataset's columns: those of [`incumbents_file`],
/// none if there is no such file.
///
/// # Errors
/// As [`load_incumbents`].
pub fn incumbents_for(
    dataset_path: &Path,
    dataset: &Dataset,
) -> Result<Vec<ParsedIncumbent>, Error> {
    let Some(file) = incumbents_file(dataset_path, dataset) else {
        return Ok(Vec::new());
    };
    let incumbents = load_incumbents(&file)?;
    Ok(incumbents.iter().filter_map(|incumbent| incumbent.compared_on(dataset)).collect())
}
