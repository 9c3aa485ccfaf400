//! The reasons why a model cannot be projected on data.

use crate::dataset;
use crate::fit::{Measure, RangeError};
use crate::program::ParseError;
use crate::suggest::did_you_mean;

/// A projection that was not made.
#[derive(Debug, thiserror::Error)]
#[allow(missing_docs, reason = "each message names its fields")]
pub enum Error {
    /// The template is no formula.
    #[error(transparent)]
    Formula(#[from] ParseError),
    /// The data, or what was to be made of them.
    #[error(transparent)]
    Dataset(#[from] dataset::Error),
    #[error(
        "the template has no parameter; write one as $name, in single quotes, since within double quotes a shell takes $name for its own; without parameters, `lgp eval`"
    )]
    NoParameter,
    #[error(
        "the template calls {functions}, which it does not define; `lgp search --template` finds functions, here only constants, written $name, are fitted"
    )]
    Functions { functions: String },
    #[error("no output depends on ${name}; leave it out of the template")]
    Unused { name: String },
    #[error(
        "no output changes with ${name} in any group, wherever it was tried; leave it out of the template, or give it other --bounds"
    )]
    NoInfluence { name: String },
    #[error("a parameter cannot be called `{name}`, as {what} is; rename it")]
    NameTaken { name: String, what: &'static str },
    #[error(
        "the template has no parameter ${name}{}",
        did_you_mean(name, known.iter().map(String::as_str))
    )]
    UnknownParameter { name: String, known: Vec<String> },
    #[error("${name}: {error}")]
    Range { name: String, error: RangeError },
    #[error("--over names no input; give some of {inputs}")]
    NothingOver { inputs: String },
    #[error(
        "--over {name}: no input is called so{}; the inputs are {inputs}",
        did_you_mean(name, inputs.split(", "))
    )]
    UnknownInput { name: String, inputs: String },
    #[error("--over {name}: it is given twice")]
    Twice { name: String },
    #[error(
        "--over names every input, so that each group would be one row; leave out those that the model is a function of"
    )]
    EveryInput,
    #[error("--over {over}: there is one group only; `lgp fit` fits one set of constants")]
    OneGroup { over: String },
    #[error(
        "all {groups} groups have fewer values than the model has parameters ({most} at most, {parameters} needed); leave inputs that differ in every row out of --over, or parameters out of the model"
    )]
    AllThin { groups: usize, most: usize, parameters: usize },
    #[error("a projection minimises squares; {measure} is none of rmse, weighted and visible")]
    Measure { measure: Measure },
    #[error("--smooth {smooth}: a penalty is a finite number, 0 or more")]
    Smooth { smooth: f64 },
    #[error(
        "the model is finite in too few of the {groups} groups, from no start that was tried; give other --start values, or --bounds"
    )]
    NotFinite { groups: usize },
    #[error("it is {problem}; remove it, and begin anew")]
    State { problem: &'static str },
    #[error(
        "it is of another projection (other data, template or options, or another version); repeat that one's command, or remove the file"
    )]
    OtherState,
    #[error("--surface {name}: it is none of --over, {over}")]
    UnknownPlace { name: String, over: String },
}

impl Error {
    /// Returns true if the request is wrong, and not what is in the data.
    pub fn is_usage(&self) -> bool {
        use Error::*;
        matches!(
            self,
            NoParameter
                | Functions { .. }
                | Unused { .. }
                | NameTaken { .. }
                | UnknownParameter { .. }
                | Range { .. }
                | NothingOver { .. }
                | UnknownInput { .. }
                | Twice { .. }
                | EveryInput
                | Measure { .. }
                | Smooth { .. }
                | UnknownPlace { .. }
        )
    }
}
