//! Recipes: targets with values for their parameters.

use super::sampling::{SAMPLING, SAMPLING_SEED};
use super::{Choices, Error, Parameter, Target, targets};
use crate::dataset::Origin;
use crate::file::read_text;
use ron::value::{Map, Value};
use std::fmt;
use std::path::Path;

/// A target and a value for each of its parameters. As text it is RON: `(target: "dfg", masking:
/// "correlated", alpha: "roughness^2", points: 64)`; parameters left out have their defaults.
/// `claims: ["y: scale >= bias"]` adds claims of the outputs.
#[derive(Clone, Debug)]
pub struct Recipe {
    target: &'static Target,
    /// One value per parameter, in the target's order, each among its choices.
    values: Vec<String>,
    /// Claims of the outputs besides the target's own ([`crate::program::Claim`]).
    pub claims: Vec<String>,
}

impl PartialEq for Recipe {
    fn eq(&self, other: &Recipe) -> bool {
        let of =
            |recipe: &Recipe| (recipe.target.name, recipe.values.clone(), recipe.claims.clone());
        of(self) == of(other)
    }
}

impl Recipe {
    /// Makes a recipe of a target with the defaults of its parameters.
    ///
    /// # Errors
    /// [`Error::UnknownTarget`].
    pub fn new(target: &str) -> Result<Recipe, Error> {
        let known = targets().iter().find(|known| known.name == target);
        let target = known.ok_or_else(|| Error::unknown_target(target))?;
        let values = target.parameters.iter().map(|p| p.default.to_owned()).collect();
        Ok(Recipe { target, values, claims: Vec::new() })
    }

    /// Reads a recipe from RON; comments are allowed.
    ///
    /// # Errors
    /// Text that is not RON, or an unknown target, parameter or value.
    pub fn parse(text: &str) -> Result<Recipe, Error> {
        let fields: Map = match ron::from_str(text) {
            Ok(Value::Map(fields)) => fields,
            Ok(_) => return Err(syntax(1, 1, "it is not a list of fields in parentheses")),
            Err(error) => {
                let start = error.span.start;
                return Err(syntax(start.line, start.col, &error.code.to_string()));
            }
        };
        let target = fields.iter().find(|(key, _)| is_text(key, "target"));
        let Some((_, Value::String(target))) = target else {
            return Err(Error::no_target());
        };
        let mut recipe = Recipe::new(target)?;
        for (key, value) in fields.iter().filter(|(key, _)| !is_text(key, "target")) {
            match value {
                Value::Seq(claims) if is_text(key, "claims") => {
                    recipe.claims = claims.iter().map(plain).collect();
                }
                value => recipe.set(&plain(key), &plain(value))?,
            }
        }
        Ok(recipe)
    }

    /// Reads a recipe from a file.
    ///
    /// # Errors
    /// A file that cannot be read, or those of [`Recipe::parse`], with the path.
    pub fn load(path: &Path) -> Result<Recipe, Error> {
        let text = read_text(path).map_err(|source| Error::Read { path: path.into(), source })?;
        Recipe::parse(&text)
            .map_err(|error| Error::In { path: path.into(), error: Box::new(error) })
    }

    /// Sets a parameter.
    ///
    /// # Errors
    /// An unknown parameter, or a value that is not among its choices; both list what is known.
    pub fn set(&mut self, parameter: &str, value: &str) -> Result<(), Error> {
        let index = self.target.parameters.iter().position(|known| known.name == parameter);
        let Some(index) = index else {
            return Err(Error::unknown_parameter(self.target, parameter));
        };
        let known = &self.target.parameters[index];
        self.values[index] = accepted(known, value).ok_or_else(|| Error::value(known, value))?;
        Ok(())
    }

    /// Returns the target.
    pub fn target(&self) -> &'static Target {
        self.target
    }

    /// Returns the value of a parameter, if the target has one of that name.
    pub fn get(&self, parameter: &str) -> Option<&str> {
        let index = self.target.parameters.iter().position(|known| known.name == parameter)?;
        self.values.get(index).map(String::as_str)
    }

    /// Returns the origin of rows made by it, with the measured error.
    pub(super) fn origin(&self, error: impl Into<String>) -> Origin {
        Origin::Target { recipe: self.to_string(), error: error.into() }
    }

    /// Returns the value of a parameter that is a [`Choices::Count`]; 0 for any other.
    pub(super) fn count(&self, parameter: &str) -> usize {
        self.get(parameter).and_then(|text| text.parse().ok()).unwrap_or(0)
    }
}

/// Formats as RON that [`Recipe::parse`] reads back.
impl fmt::Display for Recipe {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "(target: {:?}", self.target.name)?;
        let pairs = self.target.parameters.iter().zip(&self.values);
        // Regular sampling is not mentioned: most recipes have it.
        let said = |(parameter, value): &(&Parameter, &String)| {
            ![SAMPLING.name, SAMPLING_SEED.name].contains(&parameter.name)
                || **value != parameter.default
        };
        for (parameter, value) in pairs.filter(said) {
            match parameter.choices {
                Choices::OneOf(_) => write!(f, ", {}: {value:?}", parameter.name)?,
                Choices::Count { .. } => write!(f, ", {}: {value}", parameter.name)?,
            }
        }
        if !self.claims.is_empty() {
            write!(f, ", claims: {:?}", self.claims)?;
        }
        write!(f, ")")
    }
}

fn accepted(parameter: &Parameter, value: &str) -> Option<String> {
    match parameter.choices {
        Choices::OneOf(choices) => choices.contains(&value).then(|| value.to_owned()),
        Choices::Count { least, most } => {
            let count: usize = value.parse().ok()?;
            (least..=most).contains(&count).then(|| count.to_string())
        }
    }
}

fn is_text(value: &Value, text: &str) -> bool {
    matches!(value, Value::String(string) if string == text)
}

/// Formats a scalar as on the command line.
fn plain(value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        Value::Bool(flag) => flag.to_string(),
        Value::Number(number) => number.into_f64().to_string(),
        other => format!("{other:?}"),
    }
}

fn syntax(line: usize, column: usize, problem: &str) -> Error {
    Error::Syntax { line, column, problem: problem.into() }
}
