//! Emitted functions back to programs.
//!
//! What is read is one function of floats, straight through: locals, arithmetic, the functions
//! that operations are written as, and a `return`. That is more than what is emitted, so that
//! a snippet may be edited by hand and still be verified.

mod call;
mod expression;
mod lex;

use super::{Language, Syntax};
use crate::program::{Arg, Draft, Names, Program, effective};
use lex::{Token, tokens};
use std::collections::HashMap;

/// Text that is no function of the language, or more than can be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("snippet, line {line}, column {column}: {message}\n  {source_line}\n  {:>column$}", "^")]
pub struct ReadError {
    /// From 1.
    pub line: usize,
    /// In characters, from 1.
    pub column: usize,
    pub message: String,
    /// The line of text in which it stands.
    pub source_line: String,
}

impl ReadError {
    fn at(text: &str, offset: usize, message: impl Into<String>) -> ReadError {
        let before = &text[..offset];
        let line_start = before.rfind('\n').map_or(0, |i| i + 1);
        let source_line = text[line_start..].lines().next().unwrap_or("");
        ReadError {
            line: before.matches('\n').count() + 1,
            column: text[line_start..offset].chars().count() + 1,
            message: message.into(),
            source_line: source_line.to_owned(),
        }
    }
}

/// Reads an emitted function back: its program, and the names of the columns, including those
/// that were written differently.
///
/// # Errors
/// [`ReadError`] says where the text is not understood. No language is but those of
/// [`Language::SHADING`].
pub fn read_back(language: Language, text: &str) -> Result<(Program, Names), ReadError> {
    if !Language::SHADING.contains(&language) {
        let known: Vec<&str> = Language::SHADING.iter().map(|known| known.name()).collect();
        let message = format!("{language} is not read back (but {} are)", known.join(", "));
        return Err(ReadError::at(text, 0, message));
    }
    let mut reader = Reader {
        syntax: language.syntax(),
        text,
        tokens: tokens(text)?,
        next: 0,
        depth: 0,
        draft: Draft::default(),
        values: HashMap::new(),
        function: String::new(),
        structure: None,
    };
    let mut names = reader.function()?;
    let program =
        Program::verify(reader.draft).map_err(|e| ReadError::at(text, 0, e.to_string()))?;
    let columns = renamed_columns(reader.syntax.comment, text);
    for name in names.inputs.iter_mut().chain(&mut names.outputs) {
        if let Some(column) = columns.get(name.as_str()) {
            *name = (*column).to_owned();
        }
    }
    Ok((effective(&program), names))
}

/// What the comments `// cos_ is the column cos` say.
fn renamed_columns<'a>(comment: &str, text: &'a str) -> HashMap<&'a str, &'a str> {
    let comments = text.lines().filter_map(|line| line.trim().strip_prefix(comment));
    comments.filter_map(|line| line.trim().split_once(" is the column ")).collect()
}

/// What an expression may be.
#[derive(Clone)]
enum Value {
    Float(Arg),
    Bits(u32),
    Less(Arg, Arg),
    /// A vector or a structure: its components, and the locals that they are, if they are.
    Several(Vec<(Option<String>, Arg)>),
}

struct Reader<'a> {
    syntax: &'static Syntax,
    text: &'a str,
    tokens: Vec<(usize, Token)>,
    next: usize,
    depth: usize,
    draft: Draft,
    /// Parameters and locals.
    values: HashMap<String, Value>,
    function: String,
    /// The name of the structure declared above the function.
    structure: Option<String>,
}

type Read<T> = Result<T, ReadError>;

impl Reader<'_> {
    fn peek(&self) -> Option<&Token> {
        self.tokens.get(self.next).map(|(_, token)| token)
    }

    fn offset(&self) -> usize {
        self.tokens.get(self.next).map_or(self.text.trim_end().len(), |(at, _)| *at)
    }

    fn error<T>(&self, offset: usize, message: impl Into<String>) -> Read<T> {
        Err(ReadError::at(self.text, offset, message))
    }

    fn is_symbol(&self, ahead: usize, symbol: char) -> bool {
        self.tokens.get(self.next + ahead).is_some_and(|(_, t)| *t == Token::Symbol(symbol))
    }

    fn take_symbol(&mut self, symbol: char) -> bool {
        let found = self.is_symbol(0, symbol);
        self.next += usize::from(found);
        found
    }

    fn expect(&mut self, symbol: char, context: &str) -> Read<()> {
        if self.take_symbol(symbol) {
            return Ok(());
        }
        self.error(self.offset(), format!("expected `{symbol}` {context}"))
    }

    fn take_name(&mut self) -> Option<String> {
        let Some(Token::Name(name)) = self.peek() else { return None };
        let name = name.clone();
        self.next += 1;
        Some(name)
    }

    /// The name after qualifiers and a type, or before a colon and a type.
    fn declared_name(&mut self) -> Option<String> {
        let mut name = self.take_name()?;
        while !self.is_symbol(0, ':')
            && let Some(later) = self.take_name()
        {
            name = later;
        }
        if self.take_symbol(':') {
            self.take_name()?;
        }
        Some(name)
    }

    fn function(&mut self) -> Read<Names> {
        self.structure()?;
        let Some(name) = self.declared_name() else {
            return self.error(self.offset(), "expected a function");
        };
        self.function = name;
        self.expect('(', "and the parameters of a function")?;
        let inputs = self.parameters()?;
        while !self.is_symbol(0, '{') && self.peek().is_some() {
            self.next += 1;
        }
        self.expect('{', "and the body of the function")?;
        loop {
            if let Some(outputs) = self.statement()? {
                self.expect('}', "after `return`, to end the function")?;
                if self.peek().is_some() {
                    return self.error(self.offset(), "expected no more than one function");
                }
                return Ok(Names { inputs, outputs });
            }
        }
    }

    /// The structure that the function may return; its members are told by the `return`.
    fn structure(&mut self) -> Read<()> {
        if self.peek() != Some(&Token::Name("struct".to_owned())) {
            return Ok(());
        }
        self.next += 1;
        self.structure = self.take_name();
        while !self.take_symbol('}') {
            if self.peek().is_none() {
                return self.error(self.offset(), "expected `}` after the structure");
            }
            self.next += 1;
        }
        self.take_symbol(';');
        Ok(())
    }

    fn parameters(&mut self) -> Read<Vec<String>> {
        let mut names = Vec::new();
        while !self.take_symbol(')') {
            let at = self.offset();
            let Some(name) = self.declared_name() else {
                return self.error(at, "expected a parameter");
            };
            self.values.insert(name.clone(), Value::Float(Arg::Input(names.len() as u16)));
            names.push(name);
            if names.len() > usize::from(u16::MAX) {
                return self.error(at, "a function has no more than 65535 parameters");
            }
            if !self.is_symbol(0, ')') {
                self.expect(',', "or `)` after a parameter")?;
            }
        }
        self.draft.inputs = names.len();
        Ok(names)
    }

    /// Gives the outputs' names after a `return`.
    fn statement(&mut self) -> Read<Option<Vec<String>>> {
        let at = self.offset();
        if self.peek() == Some(&Token::Name("return".to_owned())) {
            self.next += 1;
            return self.returned().map(Some);
        }
        let Some(name) = self.declared_name() else {
            return self.error(at, "expected a local, or `return`");
        };
        self.expect('=', "after the name of a local")?;
        let value = if self.take_symbol('{') {
            Value::Several(self.components('}')?)
        } else {
            self.expression()?
        };
        self.expect(';', "after a statement")?;
        self.values.insert(name, value);
        Ok(None)
    }

    fn returned(&mut self) -> Read<Vec<String>> {
        let at = self.offset();
        let local = self.component_name();
        let components = match self.expression()? {
            Value::Float(arg) => vec![(local.or(Some(self.function.clone())), arg)],
            Value::Several(components) => components,
            _ => return self.error(at, "expected a float or a vector to return"),
        };
        self.expect(';', "after `return`")?;
        self.draft.outputs = components.iter().map(|(_, arg)| *arg).collect();
        let names = components.into_iter().enumerate();
        Ok(names.map(|(i, (name, _))| name.unwrap_or_else(|| format!("output{i}"))).collect())
    }

    /// The name that is the whole of the expression ahead.
    fn component_name(&self) -> Option<String> {
        let ends = [',', ')', '}', ';'].iter().any(|&symbol| self.is_symbol(1, symbol));
        match self.peek() {
            Some(Token::Name(name)) if ends => Some(name.clone()),
            _ => None,
        }
    }

    pub(super) fn components(&mut self, close: char) -> Read<Vec<(Option<String>, Arg)>> {
        let mut components = Vec::new();
        loop {
            let name = self.component_name();
            components.push((name, self.float()?));
            if self.take_symbol(close) {
                return Ok(components);
            }
            self.expect(',', &format!("or `{close}` after a component"))?;
        }
    }
}
