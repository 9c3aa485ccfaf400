//! How a function is called: its name, what it takes, and how its results leave it.

use super::call::component_of;
use crate::program::Names;

/// A parameter: a float or a vector of two to four.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Parameter {
    /// The name.
    pub name: String,
    /// The number of components.
    pub size: usize,
    /// True if results leave by it.
    pub out: bool,
    /// The words before it that change nothing: `const in`.
    pub qualifiers: String,
}

impl Parameter {
    /// Returns a float.
    pub(super) fn float(name: &str, out: bool) -> Parameter {
        Parameter { name: name.to_owned(), size: 1, out, qualifiers: String::new() }
    }

    /// Returns the names of its components: `uv.x` and `uv.y` of a vector `uv`.
    pub fn components(&self) -> Vec<String> {
        match self.size {
            1 => vec![self.name.clone()],
            size => COMPONENTS[..size].iter().map(|c| format!("{}.{c}", self.name)).collect(),
        }
    }
}

/// Returns the names of so many values that are returned: `return`, or `return.x` and so on, with
/// numbers where a vector has no letters.
pub(super) fn returned_names(count: usize) -> Vec<String> {
    match count {
        1 => vec!["return".to_owned()],
        0..=4 => COMPONENTS[..count].iter().map(|c| format!("return.{c}")).collect(),
        _ => (0..count).map(|i| format!("return.{i}")).collect(),
    }
}

/// Splits the name of a vector's component into the vector's and the component's place.
pub(super) fn vector_of(component: &str) -> Option<(&str, usize)> {
    let (vector, of) = component.rsplit_once('.')?;
    let place = COMPONENTS.iter().position(|letter| *letter == of);
    Some((vector, place.or_else(|| of.parse().ok())?))
}

/// Returns the vectors and values that components are of, each with its number of components.
pub(super) fn vectors(components: &[String]) -> Vec<(String, usize)> {
    let mut vectors: Vec<(String, usize)> = Vec::new();
    for component in components {
        match (vector_of(component), vectors.last_mut()) {
            (Some((vector, place)), Some((last, size))) if last == vector && *size == place => {
                *size += 1;
            }
            (Some((vector, 0)), _) => vectors.push((vector.to_owned(), 1)),
            _ => vectors.push((component.clone(), 1)),
        }
    }
    vectors
}

/// The components of a vector.
pub(super) const COMPONENTS: [&str; 4] = ["x", "y", "z", "w"];

/// A function's head, before it is known how many values it returns.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Head {
    /// The function's name.
    pub function: String,
    /// The words before it, if they are others than usual: `static inline`.
    pub qualifiers: Option<String>,
    /// Its parameters.
    pub parameters: Vec<Parameter>,
    /// The number of values that it returns; none if it returns what nothing else takes.
    pub returned: Option<usize>,
    /// Columns, each with the component that is known to be it; others are told by their names.
    pub columns: Vec<(String, String)>,
}

impl Head {
    /// Returns the names of the components that values come by, or that results leave by.
    pub(super) fn components(&self, out: bool) -> Vec<String> {
        let parameters = self.parameters.iter().filter(|parameter| parameter.out == out);
        parameters.flat_map(Parameter::components).collect()
    }

    /// Returns the component that is a column.
    pub fn component(&self, column: &str) -> Option<String> {
        let components = self.components(false);
        let known = self.columns.iter().find(|(known, _)| known == column);
        let named = || component_of(column, &components).map(|place| components[place].clone());
        known.map(|(_, component)| component.clone()).or_else(named)
    }
}

/// The head of a function. A program's inputs are the components of the parameters that values come
/// by, in order; its outputs are first those that are returned, then the components of the
/// parameters that results leave by.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Signature {
    /// The function's name.
    pub function: String,
    /// The words before it, if they are others than usual.
    pub qualifiers: Option<String>,
    /// The parameters.
    pub parameters: Vec<Parameter>,
    /// The number of outputs that are returned.
    pub returned: usize,
}

impl Signature {
    /// Returns the head of a function that takes a float for each input. Several outputs leave by
    /// parameters if `by_parameters`; else all are returned.
    pub(super) fn of(function: &str, names: &Names, by_parameters: bool) -> Signature {
        let parameter = |out| move |name: &String| Parameter::float(name, out);
        let mut parameters: Vec<Parameter> = names.inputs.iter().map(parameter(false)).collect();
        let by_parameters = by_parameters && names.outputs.len() > 1;
        if by_parameters {
            parameters.extend(names.outputs.iter().map(parameter(true)));
        }
        let returned = if by_parameters { 0 } else { names.outputs.len() };
        Signature { function: function.to_owned(), qualifiers: None, parameters, returned }
    }

    /// Returns the names of the components that values come by.
    pub fn inputs(&self) -> Vec<String> {
        self.components(false)
    }

    /// Returns the names of the components that results leave by; what is returned has none.
    pub fn out_components(&self) -> Vec<String> {
        self.components(true)
    }

    fn components(&self, out: bool) -> Vec<String> {
        let parameters = self.parameters.iter().filter(|parameter| parameter.out == out);
        parameters.flat_map(Parameter::components).collect()
    }
}
