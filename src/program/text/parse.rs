//! The ways to parse a text, and what they return.

use super::excerpt::{place, pointed};
use super::holes::Holes;
use super::{Names, syntax};
use crate::program::Program;

/// The reason why a text is not a formula, and the place.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("formula, line {line}, column {column}: {message}\n{}", pointed(.source_line, *.column))]
pub struct ParseError {
    /// From 1.
    pub line: usize,
    /// In characters, from 1.
    pub column: usize,
    /// The problem, and what may stand there.
    pub message: String,
    /// The line of text.
    pub source_line: String,
}

impl ParseError {
    /// Reports a problem at a byte offset of a text.
    pub(crate) fn at(text: &str, offset: usize, message: impl Into<String>) -> ParseError {
        let (line, column, source_line) = place(text, offset);
        let (message, source_line) = (message.into(), source_line.to_owned());
        ParseError { line, column, message, source_line }
    }
}

/// A constant that is left for fitting: `$name`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FreeConstant {
    /// The name after the `$`.
    pub name: String,
    /// Its index in the constant table.
    pub index: u16,
}

/// The names that a text may use.
#[derive(Clone, Debug)]
pub enum Scope<'a> {
    /// The inputs and outputs of a dataset.
    Dataset(&'a Names),
    /// Unknown names are inputs, in order of appearance.
    Open {
        /// The outputs' names; if empty, the statements that no later one reads are the outputs.
        outputs: &'a [String],
    },
}

/// A text's program and names.
#[derive(Clone, Debug)]
pub struct Parsed {
    /// The program, including statements that no output reads.
    pub program: Program,
    /// The names of its columns.
    pub names: Names,
    /// The program's constants as they are written, in double precision.
    pub exact: Vec<f64>,
    /// The names of the statements that no later one reads, in order.
    pub unread: Vec<String>,
    /// The `$name` constants, in order of appearance.
    pub free: Vec<FreeConstant>,
}

/// Parses a formula over the given columns.
///
/// # Errors
/// [`ParseError`] says where the text is wrong, and what was probably meant.
pub fn parse(text: &str, names: &Names) -> Result<Program, ParseError> {
    let parsed = parse_template(text, Scope::Dataset(names))?;
    match parsed.free.first() {
        None => Ok(parsed.program),
        Some(free) => Err(ParseError::at(
            text,
            text.find(&format!("${}", free.name)).unwrap_or(0),
            format!(
                "`${}` is a free constant; give it a value, or fit it with `lgp fit`",
                free.name
            ),
        )),
    }
}

/// Parses a formula in which unknown names are inputs; see [`Scope::Open`].
///
/// # Errors
/// As [`parse`].
pub fn parse_open(text: &str, outputs: &[String]) -> Result<Parsed, ParseError> {
    parse_template(text, Scope::Open { outputs })
}

/// Parses an expression over vectors, as `f0*scale + bias` or `dot(n, v.xyz)`. Each is a name with
/// its number of components, which are the next inputs; the outputs are the expression's
/// components.
///
/// # Errors
/// As [`parse`].
pub(crate) fn parse_expression(
    text: &str,
    vectors: &[(String, usize)],
) -> Result<Program, ParseError> {
    check_length(text)?;
    syntax::parse_expression(text, vectors)
}

/// Parses a text that may hold free constants; these start at 1.
///
/// # Errors
/// As [`parse`].
pub fn parse_template(text: &str, scope: Scope) -> Result<Parsed, ParseError> {
    check_length(text)?;
    syntax::parse_text(text, scope)
}

/// Parses a text that may call functions to be found.
pub(in crate::program) fn parse_with_holes(
    text: &str,
    names: &Names,
) -> Result<(Parsed, Holes), ParseError> {
    check_length(text)?;
    syntax::parse_text_with_holes(text, names)
}

/// Returns the outputs that a text, which may call functions to be found, assigns.
pub(in crate::program) fn assigned_by(
    text: &str,
    names: &Names,
) -> Result<Vec<String>, ParseError> {
    check_length(text)?;
    syntax::assigned_in(text, names)
}

fn check_length(text: &str) -> Result<(), ParseError> {
    if text.len() <= MAX_FORMULA {
        return Ok(());
    }
    let message = format!("a formula of {} bytes is too long (at most 1 MiB)", text.len());
    Err(ParseError::at(text, 0, message))
}

/// The most bytes of a formula; longer text is refused unread. By hand.
pub const MAX_FORMULA: usize = 1 << 20;
