//! The errors of scenes.

use crate::dataset::{self, NameFault};
use crate::grammar::FileError;
use crate::printable::printable;
use crate::program::{ParseError, shortest};
use std::path::PathBuf;

/// The reason why a scene cannot be used. `scene` and `dataset` are the names of the scene and of
/// the dataset that it was applied to.
#[allow(missing_docs, reason = "each message names its fields")]
#[derive(Debug, thiserror::Error)]
pub enum Error {
    #[error(transparent)]
    File(#[from] FileError),
    #[error(
        "a scene or a tier of it cannot be called `{}`: {fault}; choose another name",
        printable(name)
    )]
    Name { name: String, fault: NameFault },
    #[error(
        "no scene is called `{name}`{hint} ({}; or give the path of a .ron file)",
        known_in(folder, known)
    )]
    NoSuchScene { name: String, hint: String, folder: PathBuf, known: String },

    #[error(
        "scene {scene}: {part}: {} of `{}` is no finite 32-bit float; write another number",
        shortest(*value),
        printable(name)
    )]
    Number { scene: String, part: &'static str, name: String, value: f64 },
    #[error("scene {scene}: {part} names `{name}`, which is no input of {dataset}{known}")]
    UnknownInput {
        scene: String,
        part: &'static str,
        name: String,
        dataset: String,
        /// The name probably meant, and the known names.
        known: String,
    },
    #[error(
        "scene {scene}: `fixed` names `{name}`, which is no input of {dataset}, nor used in `outputs`{known}"
    )]
    UnusedValue { scene: String, name: String, dataset: String, known: String },
    #[error("scene {scene}: `{input}` stands in {one} and in {other}; leave it out of one of them")]
    Twice { scene: String, input: String, one: &'static str, other: &'static str },
    #[error(
        "scene {scene}: the range of `{input}`, ({low}, {high}), is empty; give the lower end first, or a single value under `fixed`"
    )]
    EmptyRange { scene: String, input: String, low: f64, high: f64 },
    #[error("scene {scene}: the {what} of `{input}`, ({low}, {high}), reaches beyond {dataset}, whose domain is [{}, {}]; stay within it, or generate or import data there", shortest(domain[0]), shortest(domain[1]))]
    RangeOutside {
        scene: String,
        what: &'static str,
        input: String,
        low: f64,
        high: f64,
        dataset: String,
        domain: [f64; 2],
    },
    #[error("scene {scene}: `{input}` is fixed at {value}, outside the domain of {dataset}, [{}, {}]; stay within it, or generate or import data there", shortest(domain[0]), shortest(domain[1]))]
    FixedOutside { scene: String, input: String, value: f64, dataset: String, domain: [f64; 2] },
    #[error(
        "scene {scene}: no row of the {split} split of {dataset} has `{input}` = {value}, and the rows are no grid to interpolate on (nearest: {nearest}); fix it at a value that occurs, or give a range"
    )]
    NoSuchRows {
        scene: String,
        split: &'static str,
        dataset: String,
        input: String,
        value: f64,
        nearest: f64,
    },
    #[error("scene {scene}: all inputs of {dataset} are fixed; leave at least one open")]
    NoInputs { scene: String, dataset: String },
    #[error("scene {scene}: the histogram of {inputs}: {problem}")]
    Histogram { scene: String, inputs: String, problem: String },
    #[error(
        "scene {scene}: no row of the {split} split of {dataset} lies within its ranges and histograms; widen them"
    )]
    NoRows { scene: String, split: &'static str, dataset: String },
    #[error("scene {scene}: quantisation: {problem}")]
    Quantisation { scene: String, problem: String },
    #[error(
        "scene {scene}: the tone map has no slope at {value}, where output `{output}` is on row {row} of the {split} split of {dataset}; write one that has"
    )]
    ToneMap {
        scene: String,
        output: String,
        value: f32,
        row: usize,
        split: &'static str,
        dataset: String,
    },
    #[error("scene {scene}: output `{output}`: {error}")]
    Expression { scene: String, output: String, error: ParseError },
    #[error("scene {scene}: output `{output}` has the name of an input; choose another name")]
    OutputIsInput { scene: String, output: String },
    #[error(
        "scene {scene}: output `{output}` is {value} on row {row} of the {split} split of {dataset}; write an expression that is finite there, or leave the row out by a range"
    )]
    NotFinite {
        scene: String,
        output: String,
        value: f64,
        row: usize,
        split: &'static str,
        dataset: String,
    },
    #[error(
        "scene {scene}: tier `{tier}` needs a max_cost, a max_error or both, finite and not negative"
    )]
    Tier { scene: String, tier: String },
    #[error("scene {scene}: {error}")]
    Dataset { scene: String, error: Box<dataset::Error> },
}

fn known_in(folder: &std::path::Path, known: &str) -> String {
    match known {
        "" => format!("{} has none", folder.display()),
        known => format!("in {}: {known}", folder.display()),
    }
}
