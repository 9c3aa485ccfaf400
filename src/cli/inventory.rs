//! The usable files in a project's folders.

use crate::cost::Profile;
use crate::dataset::{Column, Dataset, load_incumbents};
use crate::file::read_text;
use crate::grammar::Grammar;
use serde::Serialize;
use std::path::{Path, PathBuf};

/// A file that a command can take.
#[derive(Serialize)]
pub(super) struct Entry {
    #[serde(serialize_with = "crate::cli::output::readable")]
    pub path: PathBuf,
    /// One line.
    pub description: String,
    /// False for a file that its commands would refuse; the description says why.
    pub usable: bool,
}

pub(super) fn datasets() -> Vec<Entry> {
    entries("datasets", "bin", |path| {
        let dataset = Dataset::load(path).map_err(|error| error.to_string())?;
        let names = |columns: &[Column]| {
            columns.iter().map(|column| column.name.as_str()).collect::<Vec<_>>().join(", ")
        };
        let [inputs, outputs] = [names(&dataset.inputs), names(&dataset.outputs)];
        Ok(format!("{inputs} → {outputs}, {} rows", dataset.search.rows()))
    })
}

pub(super) fn incumbents() -> Vec<Entry> {
    entries("datasets/incumbents", "ron", |path| {
        let incumbents = load_incumbents(path).map_err(|error| error.to_string())?;
        let names: Vec<&str> = incumbents.iter().map(|known| known.name.as_str()).collect();
        Ok(names.join(", "))
    })
}

pub(super) fn scenes() -> Vec<Entry> {
    entries("datasets/scenes", "ron", first_comment)
}

pub(super) fn grammars() -> Vec<Entry> {
    let described = |name| Grammar::find(name).map(|grammar| grammar.description);
    let built_in = Grammar::built_in().map(|name| built_in(name, described(name).ok()));
    built_in.chain(entries("grammar", "ron", first_comment)).collect()
}

pub(super) fn gpu_profiles() -> Vec<Entry> {
    let described = |name| Profile::find(name).map(|profile| profile.description);
    let built_in = Profile::built_in().map(|name| built_in(name, described(name).ok()));
    built_in.chain(entries("grammar/gpu", "ron", first_comment)).collect()
}

/// Returns an entry that is built into the program, named without a path.
fn built_in(name: &str, description: Option<String>) -> Entry {
    let description = format!("built in: {}", description.unwrap_or_default());
    Entry { path: name.into(), description, usable: true }
}

fn entries(
    folder: &str,
    extension: &str,
    describe: impl Fn(&Path) -> Result<String, String>,
) -> Vec<Entry> {
    let found = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let mut paths: Vec<PathBuf> = found.map(|entry| entry.path()).collect();
    paths.retain(|path| path.is_file() && path.extension().is_some_and(|e| e == extension));
    paths.sort();
    let entry = |path: PathBuf| match describe(&path) {
        Ok(description) => Entry { path, description, usable: true },
        Err(description) => Entry { path, description, usable: false },
    };
    paths.into_iter().map(entry).collect()
}

/// Returns the first line of a `.ron` file if it is a comment.
fn first_comment(path: &Path) -> Result<String, String> {
    let text = read_text(path).map_err(|error| error.to_string())?;
    let first = text.lines().next().unwrap_or_default();
    Ok(first.strip_prefix("//").unwrap_or_default().trim().to_owned())
}
