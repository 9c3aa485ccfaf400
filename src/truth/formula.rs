//! Formulas as truths: formula text, evaluated in double precision.

use super::{Error, Truth, axes_of, write_domain};
use crate::dataset::{Axis, Dataset, Function, Origin};
use crate::eval::Double;
use crate::program::{ExactProgram, Names, ParseError, Parsed, parse_open};
use std::sync::Arc;

impl Truth {
    /// Makes a truth of formula text. Unknown names are its inputs, in order of appearance, and need
    /// an axis each; its outputs, unless named, are the statements that no later one reads. Numbers
    /// count as they are written, not as rounded to `f32`.
    ///
    /// # Errors
    /// Text that is not a formula, `$name` in it, or a domain that is not that of its inputs.
    pub fn formula(text: &str, outputs: &[String], domain: &[Axis]) -> Result<Truth, Error> {
        let parsed = read_formula(text, outputs)?;
        let axes = axes_of(domain, &parsed.names.inputs)?;
        let outputs = parsed.names.outputs.clone();
        let function = Function::Formula { text: text.trim().to_owned() };
        let origin = Origin::Function { function, domain: write_domain(&axes) };
        let Parsed { program, exact, .. } = parsed;
        let function =
            Arc::new(move |point: &[f64]| Ok(Double.evaluate_exact(&program, &exact, point)));
        Truth::new(outputs.join("_"), axes, outputs, origin, function)
    }
}

/// Returns the formula that data are samples of, over their columns; none if they are not samples
/// of a formula, or have other columns.
pub fn formula_of(dataset: &Dataset) -> Option<String> {
    match &dataset.origin {
        Origin::Function { function: Function::Formula { text }, .. } => {
            exact_formula(text, &dataset.names()).map(|_| text.clone())
        }
        Origin::Pruned { of, .. } => {
            formula_of(&Dataset { origin: (**of).clone(), ..dataset.clone() })
        }
        _ => None,
    }
}

/// Parses a formula over columns; none if they lack what it reads, or it defines not all of them.
pub fn exact_formula(text: &str, names: &Names) -> Option<ExactProgram> {
    ExactProgram::of(read_formula(text, &names.outputs).ok()?, names)
}

/// Parses a formula over inputs that its text names; its outputs are those named, or the statements
/// that no later one reads.
///
/// # Errors
/// As [`Truth::formula`], about the text.
pub fn read_formula(text: &str, outputs: &[String]) -> Result<Parsed, Error> {
    let parsed = parse_open(text, outputs)?;
    if let Some(free) = parsed.free.first() {
        let at = text.find(&format!("${}", free.name)).unwrap_or(0);
        let message =
            format!("`${}` is a free constant; a truth has none: give its value", free.name);
        return Err(ParseError::at(text, at, message).into());
    }
    if parsed.names.inputs.is_empty() {
        return Err(Error::NoInputs);
    }
    Ok(parsed)
}
