//! Guesses for the holes of a template.

use super::definitions::Definitions;
use super::lex::Token;
use super::syntax::{Parse, Parser};
use super::{Names, Scope};
use crate::program::{Draft, Hole, Program};
use crate::suggest::did_you_mean;

/// Parses definitions of functions, `f(x) = …`, and constants, `$a = 0.5`; returns each hole that the
/// text fills in, with a program over its parameters.
pub(in crate::program) fn parse_guess<'h>(
    text: &str,
    holes: &'h [Hole],
) -> Parse<Vec<(&'h Hole, Program)>> {
    let mut parser = Parser::new(text, Definitions::new(Scope::Dataset(&Names::default())))?;
    let mut found = Vec::new();
    loop {
        while parser.tokens.peek() == Some(&Token::End) {
            parser.tokens.skip(1);
        }
        let at = parser.tokens.offset();
        if parser.tokens.peek().is_none() {
            break;
        }
        let (name, is_constant) = match (parser.tokens.definition(), parser.tokens.peek()) {
            (Some((name, ..)), _) => (name, false),
            (None, Some(Token::Free(name))) => (name.clone(), true),
            _ => {
                let message =
                    "a guess for a template is `f(x) = …` or `$a = 0.5`, by the names of its holes";
                return parser.tokens.error(at, message);
            }
        };
        let hole = holes.iter().find(|hole| hole.name == name && hole.is_constant() == is_constant);
        match hole {
            Some(hole) if is_constant => found.push((hole, parser.constant_guess(&name)?)),
            Some(hole) => {
                found.push((hole, function_guess(text, hole, at)?));
                parser.tokens.skip_statement();
            }
            // A function that guesses call.
            None if !is_constant && parser.written.len() > 1 => parser.tokens.skip_statement(),
            None => {
                let known: Vec<String> = holes.iter().map(Hole::signature).collect();
                let hint = did_you_mean(&name, holes.iter().map(|hole| hole.name.as_str()));
                let message = format!(
                    "the template has no hole `{name}`{hint} (it has {})",
                    known.join(", ")
                );
                return parser.tokens.error(at, message);
            }
        }
        parser.check_ended()?;
    }
    Ok(found)
}

impl Parser<'_> {
    /// Parses `$a = number`.
    fn constant_guess(&mut self, name: &str) -> Parse<Program> {
        self.tokens.skip(1);
        self.tokens.expect('=', &format!("as in `${name} = 0.5`"))?;
        let is_negative = self.tokens.take_symbol('-');
        let at = self.tokens.offset();
        let Some(&Token::Number(number)) = self.tokens.peek() else {
            return self.tokens.error(at, format!("expected a number, as in `${name} = 0.5`"));
        };
        self.tokens.skip(1);
        let mut draft = Draft::default();
        let value = draft.constant(if is_negative { -number.rounded } else { number.rounded });
        draft.outputs.push(value);
        Ok(Program::verify(draft).expect("a constant is a program"))
    }
}

/// Reads the definition of a hole as a program over its parameters.
fn function_guess(text: &str, hole: &Hole, at: usize) -> Parse<Program> {
    let names = Names { inputs: hole.parameters.clone(), outputs: Vec::new() };
    let mut parser = Parser::new(text, Definitions::new(Scope::Dataset(&names)))?;
    let width = hole.outputs().len();
    let arguments = hole.parameters.len();
    let given = parser.written[&hole.name].parameters.len();
    if given != arguments {
        let message = format!(
            "`{}` has {given} parameters here, but {} in the template",
            hole.name,
            hole.signature()
        );
        return parser.tokens.error(at, message);
    }
    let value = parser.defined(&hole.name, arguments)?;
    if value.len() != width {
        let message =
            format!("`{}` has {} values here, but {width} in the template", hole.name, value.len());
        return parser.tokens.error(at, message);
    }
    parser.tokens.placed(at, parser.definitions.finish_with(value))
}
