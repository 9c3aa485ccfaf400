//! The contract in a snippet's comments: its formula, and the columns' names.

use super::lex::Comment;
use crate::program::{Names, ParseError, Program, parse};
use std::collections::HashMap;

/// The mark of the line with the formula.
const FORMULA: &str = "formula:";

/// The mark of a line with a name that is written differently, and the name.
const NAME: &str = "names:";

/// Returns the header line that says what the function computes.
pub fn formula_line(formula: &str) -> String {
    format!("{FORMULA} {formula}")
}

/// Returns the comment line that says how a name is written.
pub(in crate::emit) fn name_line(written: &str, name: &str) -> String {
    // In ASCII, and such that the name can be read again.
    let name: String = name
        .chars()
        .map(|c| match c {
            c if c.is_ascii() => c.to_string(),
            c => c.escape_unicode().to_string(),
        })
        .collect();
    format!("{NAME} {written} = {name}")
}

/// The mark of a line that says how a column is made of parameters, or a result of columns.
const LET: &str = "let:";

/// Returns the comment line of such a statement.
pub(in crate::emit) fn let_line(target: &str, expression: &str) -> String {
    format!("{LET} {target} = {expression}")
}

/// The mark of a line that says how the function is called.
const CALL: &str = "call:";

/// Returns the comment line of that: `dfg(roughness, nov)`.
pub(in crate::emit) fn call_line(function: &str, parameters: &[&str]) -> String {
    format!("{CALL} {function}({})", parameters.join(", "))
}

/// The mark of a line that says how an output is computed of the data's columns.
const DERIVED: &str = "derived:";

/// Returns the header line that says so: `total = scale + bias`.
pub fn derived_line(derived: &str) -> String {
    format!("{DERIVED} {derived}")
}

/// A formula in a comment.
#[derive(Clone, Debug)]
pub struct Stated {
    /// Its line in the snippet, from 1.
    pub line: usize,
    /// The formula itself.
    pub program: Program,
}

/// A comment that should be a formula and is not.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[allow(missing_docs, reason = "each message names its fields")]
pub enum StatedError {
    /// The formula cannot be parsed.
    #[error("line {line}: the formula in the comment cannot be read: {error}")]
    Unreadable { line: usize, error: Box<ParseError> },
    /// A comment without a mark gives one output a value.
    #[error(
        "line {line}: a comment gives `{output}` a value, but is no formula of all that is returned; \
         word it otherwise, or mark the comment with the formula by `{FORMULA}`: {error}"
    )]
    Unmarked { line: usize, output: String, error: Box<ParseError> },
    /// Two comments are the formula.
    #[error("lines {first} and {second} are both the formula; leave one, marked by `{FORMULA}`")]
    Twice { first: usize, second: usize },
}

/// Comments by purpose.
#[derive(Clone, Debug, Default)]
pub(super) struct Contract {
    /// Line numbers, and the text after the mark.
    formulas: Vec<(usize, String)>,
    /// Line numbers and texts of other comments.
    unmarked: Vec<(usize, String)>,
    /// Columns by their written names.
    columns: HashMap<String, String>,
    /// The statements about columns and results.
    lets: Vec<String>,
    /// How outputs are computed of the data's columns.
    derived: Vec<String>,
    /// The parameters in order, of the line that says how it is called.
    parameters: Vec<String>,
    /// The inputs and outputs in order, of the line that says what is computed of what.
    inputs: Vec<String>,
    outputs: Vec<String>,
}

impl Contract {
    pub fn of(text: &str, comments: &[Comment]) -> Contract {
        let mut contract = Contract::default();
        let (mut line, mut from) = (1, 0);
        for comment in comments {
            line += text[from..comment.offset].matches('\n').count();
            from = comment.offset;
            contract.take(line, comment.text);
        }
        contract
    }

    fn take(&mut self, line: usize, text: &str) {
        // The form from before lines were marked.
        let renamed = (text.strip_prefix(NAME).and_then(|text| text.split_once(" = ")))
            .or_else(|| text.split_once(" is the column "));
        let listed = |names: &str| names.split(", ").map(|name| name.trim().to_owned()).collect();
        if let Some(statement) = text.strip_prefix(LET) {
            self.lets.push(statement.trim().to_owned());
        } else if let Some(call) = text.strip_prefix(CALL) {
            let names = call.split_once('(').and_then(|(_, names)| names.strip_suffix(')'));
            self.parameters = names.map_or_else(Vec::new, listed);
        } else if let Some(derived) = text.strip_prefix(DERIVED) {
            self.derived.push(derived.trim().to_owned());
        } else if let Some(formula) = text.strip_prefix(FORMULA) {
            self.formulas.push((line, formula.trim().to_owned()));
        } else if let Some((written, column)) = renamed {
            self.columns.insert(written.trim().to_owned(), unescaped(column));
        } else {
            if let Some((inputs, outputs)) =
                text.split_once(" -> ").filter(|_| self.outputs.is_empty())
            {
                (self.inputs, self.outputs) = (listed(inputs), listed(outputs));
            }
            self.unmarked.push((line, text.to_owned()));
        }
    }

    pub fn parameters(&self) -> &[String] {
        &self.parameters
    }

    pub fn inputs(&self) -> &[String] {
        &self.inputs
    }

    pub fn outputs(&self) -> &[String] {
        &self.outputs
    }

    pub fn add_lets(&mut self, lets: &[String]) {
        self.lets.extend_from_slice(lets);
    }

    pub fn derived(&self) -> &[String] {
        &self.derived
    }

    pub fn lets(&self) -> &[String] {
        &self.lets
    }

    /// Restores the names of columns that are written differently.
    pub fn restore(&self, names: &mut Names) {
        for name in names.inputs.iter_mut().chain(&mut names.outputs) {
            if let Some(column) = self.columns.get(name) {
                name.clone_from(column);
            }
        }
    }

    /// Returns the marked formula; without marks, the comment that gives outputs their values.
    pub fn formula(&self, names: &Names) -> Result<Option<Stated>, StatedError> {
        let mut found: Option<Stated> = None;
        for (line, text) in &self.formulas {
            let unreadable =
                |error| StatedError::Unreadable { line: *line, error: Box::new(error) };
            let program = parse(text, names).map_err(unreadable)?;
            once(&mut found, Stated { line: *line, program })?;
        }
        if found.is_some() {
            return Ok(found);
        }
        for (line, text) in &self.unmarked {
            let Some(output) = names.outputs.iter().find(|output| assigns(text, output)) else {
                continue;
            };
            let unmarked = |error| StatedError::Unmarked {
                line: *line,
                output: output.clone(),
                error: Box::new(error),
            };
            let program = parse(text, names).map_err(unmarked)?;
            once(&mut found, Stated { line: *line, program })?;
        }
        Ok(found)
    }
}

/// Reads `\u{b7}` as the character that it stands for.
fn unescaped(text: &str) -> String {
    let mut parts = text.split("\\u{");
    let mut name = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let character = part.split_once('}').and_then(|(digits, rest)| {
            Some((u32::from_str_radix(digits, 16).ok().and_then(char::from_u32)?, rest))
        });
        match character {
            Some((character, rest)) => name.extend([&character.to_string(), rest]),
            None => name.extend(["\\u{", part]),
        }
    }
    name
}

fn once(found: &mut Option<Stated>, stated: Stated) -> Result<(), StatedError> {
    match found {
        Some(first) => Err(StatedError::Twice { first: first.line, second: stated.line }),
        None => {
            *found = Some(stated);
            Ok(())
        }
    }
}

/// Returns true if `name =` stands in the text.
fn assigns(text: &str, name: &str) -> bool {
    let is_part = |c: char| c.is_alphanumeric() || c == '_';
    !name.is_empty()
        && text.match_indices(name).any(|(at, _)| {
            let value = text[at + name.len()..].trim_start().strip_prefix('=');
            !text[..at].ends_with(is_part) && value.is_some_and(|rest| !rest.starts_with('='))
        })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_assignment_is_of_the_whole_name() {
        for (text, expected) in [
            ("y = x", true),
            ("t = x; y=t", true),
            ("formul: y = x", true),
            ("my = x", false),
            ("y == x", false),
            ("y2 = x", false),
            ("y is x", false),
            ("y my y = 2", true),
        ] {
            assert_eq!(assigns(text, "y"), expected, "{text}");
        }
    }
}
