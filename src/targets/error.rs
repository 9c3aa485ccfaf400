//! The reasons why a ground truth cannot be made.

use super::{Choices, Parameter, Target, targets};
use crate::dataset;
use crate::suggest::nearest;
use std::path::PathBuf;

/// The reason why a ground truth cannot be made.
#[allow(missing_docs, reason = "each message names its fields")]
#[derive(Debug, thiserror::Error)]
pub enum Error {
    #[error("{path}: cannot be read: {source}; check the path of the recipe", path = path.display())]
    Read { path: PathBuf, source: std::io::Error },
    #[error("{path}: {error}", path = path.display())]
    In { path: PathBuf, error: Box<Error> },
    #[error(
        "line {line}, column {column}: not a recipe: {problem}; write one like (target: \"dfg\", points: 64)"
    )]
    Syntax { line: usize, column: usize, problem: String },
    #[error(
        "the recipe names no target; begin it with (target: \"dfg\", …); the targets are {available}"
    )]
    NoTarget { available: String },
    #[error(
        "no target is called `{name}`{}; the targets are {available}",
        did_you_mean(suggestion)
    )]
    UnknownTarget { name: String, suggestion: Option<String>, available: String },
    #[error(
        "target `{target}` has no parameter `{name}`{}; its parameters are {available}",
        did_you_mean(suggestion)
    )]
    UnknownParameter { target: String, name: String, suggestion: Option<String>, available: String },
    #[error(
        "`{value}` is not a value of parameter `{parameter}`{}; write {choices}",
        did_you_mean(suggestion)
    )]
    Value { parameter: String, value: String, suggestion: Option<String>, choices: String },
    #[error(
        "target `{target}` could not be integrated to {allowed:e} at {point}: the estimated error is {error:e}; please report it with the recipe"
    )]
    Accuracy { target: String, point: String, error: f64, allowed: f64 },
    #[error(transparent)]
    Dataset(#[from] dataset::Error),
}

impl Error {
    pub(super) fn no_target() -> Error {
        Error::NoTarget { available: names_of_targets() }
    }

    pub(super) fn unknown_target(name: &str) -> Error {
        Error::UnknownTarget {
            name: name.into(),
            suggestion: nearest(name, targets().iter().map(|t| t.name)).map(Into::into),
            available: names_of_targets(),
        }
    }

    pub(super) fn unknown_parameter(target: &Target, name: &str) -> Error {
        let names: Vec<&str> = target.parameters.iter().map(|p| p.name).collect();
        Error::UnknownParameter {
            target: target.name.into(),
            name: name.into(),
            suggestion: nearest(name, names.iter().copied()).map(Into::into),
            available: names.join(", "),
        }
    }

    pub(super) fn value(parameter: &Parameter, value: &str) -> Error {
        let (suggestion, choices) = match parameter.choices {
            Choices::OneOf(choices) => {
                let quoted: Vec<String> = choices.iter().map(|c| format!("`{c}`")).collect();
                (nearest(value, choices.iter().copied()), quoted.join(" or "))
            }
            Choices::Count { least, most } => {
                (None, format!("a whole number from {least} to {most}"))
            }
        };
        Error::Value {
            parameter: parameter.name.into(),
            value: value.into(),
            suggestion: suggestion.map(Into::into),
            choices,
        }
    }
}

fn names_of_targets() -> String {
    targets().iter().map(|target| target.name).collect::<Vec<_>>().join(", ")
}

fn did_you_mean(suggestion: &Option<String>) -> String {
    suggestion.as_ref().map(|name| format!(" (did you mean `{name}`?)")).unwrap_or_default()
}
