//! Emitted functions back to programs.
//!
//! What is read is one function of floats, straight through: locals, arithmetic, the functions
//! that operations are written as, and a `return`. That is more than what is emitted, so that
//! a snippet may be edited by hand and still be verified.

mod lex;

use super::body::argument_place;
use super::{Language, Syntax};
use crate::op::Op;
use crate::program::{Arg, Draft, Names, Program, effective};
use crate::suggest::did_you_mean;
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
/// [`ReadError`] says where the text is not understood.
pub fn read_back(language: Language, text: &str) -> Result<(Program, Names), ReadError> {
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

/// Expressions nested more deeply are refused.
const MAX_DEPTH: usize = 200;

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

    fn components(&mut self, close: char) -> Read<Vec<(Option<String>, Arg)>> {
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

    fn float(&mut self) -> Read<Arg> {
        let at = self.offset();
        let value = self.expression()?;
        self.as_float(value, at)
    }

    fn as_float(&self, value: Value, at: usize) -> Read<Arg> {
        match value {
            Value::Float(arg) => Ok(arg),
            _ => self.error(at, "expected a float"),
        }
    }

    /// A sum, a comparison of two, or a choice by one.
    fn expression(&mut self) -> Read<Value> {
        self.deeper(|reader| {
            let at = reader.offset();
            let value = reader.comparison()?;
            if !reader.take_symbol('?') {
                return Ok(value);
            }
            let Value::Less(a, b) = value else {
                return reader.error(at, "expected a comparison before `?`");
            };
            let x = reader.float()?;
            reader.expect(':', "between the values to choose from")?;
            let y = reader.float()?;
            Ok(Value::Float(reader.draft.push(Op::Select, &[a, b, x, y])))
        })
    }

    fn deeper<T>(&mut self, read: impl FnOnce(&mut Self) -> Read<T>) -> Read<T> {
        if self.depth == MAX_DEPTH {
            return self.error(
                self.offset(),
                format!("nested more than {MAX_DEPTH} deep; name a part of it as a local"),
            );
        }
        self.depth += 1;
        let result = read(self);
        self.depth -= 1;
        result
    }

    fn comparison(&mut self) -> Read<Value> {
        let at = self.offset();
        let left = self.sum()?;
        let less = self.take_symbol('<');
        if !less && !self.take_symbol('>') {
            return Ok(left);
        }
        let left = self.as_float(left, at)?;
        let at = self.offset();
        let right = self.sum()?;
        let right = self.as_float(right, at)?;
        Ok(if less { Value::Less(left, right) } else { Value::Less(right, left) })
    }

    fn sum(&mut self) -> Read<Value> {
        self.chain([('+', Op::Add), ('-', Op::Sub)], Self::product)
    }

    fn product(&mut self) -> Read<Value> {
        self.chain([('*', Op::Mul), ('/', Op::Div)], Self::negation)
    }

    /// Operands between operators that associate to the left.
    fn chain(
        &mut self,
        operators: [(char, Op); 2],
        operand: fn(&mut Self) -> Read<Value>,
    ) -> Read<Value> {
        let at = self.offset();
        let mut value = operand(self)?;
        while let Some((_, op)) = operators.into_iter().find(|(s, _)| self.take_symbol(*s)) {
            let left = self.as_float(value, at)?;
            let at = self.offset();
            let right = operand(self)?;
            let right = self.as_float(right, at)?;
            value = Value::Float(self.draft.push(op, &[left, right]));
        }
        Ok(value)
    }

    fn negation(&mut self) -> Read<Value> {
        if !self.take_symbol('-') {
            return self.atom();
        }
        if let Some(&Token::Number(number)) = self.peek() {
            self.next += 1;
            return self.constant(-number).map(Value::Float);
        }
        let at = self.offset();
        let value = self.deeper(Self::negation)?;
        let value = self.as_float(value, at)?;
        Ok(Value::Float(self.draft.push(Op::Neg, &[value])))
    }

    fn atom(&mut self) -> Read<Value> {
        let at = self.offset();
        let Some(token) = self.peek().cloned() else {
            return self.error(at, "the text ends where a value is expected");
        };
        self.next += 1;
        match token {
            Token::Number(number) => self.constant(number).map(Value::Float),
            Token::Bits(bits) => Ok(Value::Bits(bits)),
            Token::Symbol('(') => {
                let value = self.expression()?;
                self.expect(')', "to close the parenthesis")?;
                Ok(value)
            }
            Token::Name(name) if self.take_symbol('(') => self.call(&name, at),
            Token::Name(name) => match self.values.get(&name) {
                Some(value) => Ok(value.clone()),
                None => {
                    let hint = did_you_mean(&name, self.values.keys().map(String::as_str));
                    self.error(at, format!("`{name}` is no parameter and no local{hint}"))
                }
            },
            Token::Symbol(symbol) => self.error(at, format!("expected a value, found `{symbol}`")),
        }
    }

    fn constant(&mut self, value: f32) -> Read<Arg> {
        if self.draft.consts.len() >= usize::from(u16::MAX) {
            return self.error(self.offset(), "more than 65535 constants");
        }
        Ok(self.draft.constant(value))
    }

    fn call(&mut self, name: &str, at: usize) -> Read<Value> {
        let is_vector = ["float2", "float3", "float4", "vec2", "vec3", "vec4"].contains(&name);
        if is_vector || self.structure.as_deref() == Some(name) {
            return self.components(')').map(Value::Several);
        }
        let mut args = vec![self.expression()?];
        while self.take_symbol(',') {
            args.push(self.expression()?);
        }
        self.expect(')', "after the arguments")?;
        match args.as_slice() {
            [Value::Bits(bits)] if name == self.syntax.float_of_bits => {
                self.float_of_bits(*bits).map(Value::Float)
            }
            // A conversion, of what is a float here.
            [Value::Float(arg)] if name == "float" || name == "f32" => Ok(Value::Float(*arg)),
            _ => self.operation(name, &args, at),
        }
    }

    /// A constant of a program is finite; what is not is computed from such.
    fn float_of_bits(&mut self, bits: u32) -> Read<Arg> {
        let value = f32::from_bits(bits);
        if value.is_finite() {
            return self.constant(value);
        }
        let zero = self.constant(0.0f32.copysign(value))?;
        Ok(match value.is_nan() {
            true => self.draft.push(Op::Div, &[zero, zero]),
            false => self.draft.push(Op::Rcp, &[zero]),
        })
    }

    fn operation(&mut self, name: &str, args: &[Value], at: usize) -> Read<Value> {
        let calls = || Op::ALL.iter().filter_map(|&op| Some((op, call_of(self.syntax, op)?)));
        let named = calls().filter(|(_, call)| call.name == name);
        let found = named.clone().find_map(|(op, call)| Some((op, self.matched(&call, args)?)));
        match found {
            Some((op, args)) => Ok(Value::Float(self.draft.push(op, &args))),
            None if named.count() > 0 => {
                self.error(at, format!("`{name}` is not read with these arguments"))
            }
            None => {
                let known: Vec<&str> = calls().map(|(_, call)| call.name).collect();
                let hint = did_you_mean(name, known);
                self.error(at, format!("`{name}` is no function that can be read{hint}"))
            }
        }
    }

    /// The operation's arguments, in its order.
    fn matched(&self, call: &Call, values: &[Value]) -> Option<Vec<Arg>> {
        let mut args = [None; crate::op::MAX_ARITY];
        for (place, value) in call.places.iter().zip(values) {
            match (place, value) {
                (Place::Argument(i), Value::Float(arg)) => args[*i] = Some(*arg),
                (Place::Less(i, j), Value::Less(a, b)) => {
                    (args[*i], args[*j]) = (Some(*a), Some(*b));
                }
                (Place::Literal(literal), Value::Float(Arg::Const(i)))
                    if self.draft.consts[usize::from(*i)] == *literal => {}
                _ => return None,
            }
        }
        (call.places.len() == values.len()).then(|| args.into_iter().flatten().collect())
    }
}

/// An operation that is written as a function.
struct Call {
    name: &'static str,
    places: Vec<Place>,
}

/// What stands between two commas of a call.
enum Place {
    Argument(usize),
    Less(usize, usize),
    Literal(f32),
}

/// The operation's spelling, if that is a call.
fn call_of(syntax: &Syntax, op: Op) -> Option<Call> {
    let template = (syntax.spelling)(op).template;
    let template = match template.strip_prefix("float(") {
        Some(converted) => converted.strip_suffix(')')?,
        None => template,
    };
    let (name, rest) = template.split_once('(')?;
    let is_name = !name.is_empty() && name.bytes().all(|b| b.is_ascii_alphanumeric());
    let places = rest.strip_suffix(')').filter(|_| is_name)?;
    Some(Call { name, places: places.split(", ").map(place).collect::<Option<_>>()? })
}

fn place(text: &str) -> Option<Place> {
    let argument = |text: &str| Some(argument_place(text.strip_prefix('{')?.strip_suffix('}')?).0);
    match text.split_once(" < ") {
        Some((a, b)) => Some(Place::Less(argument(a)?, argument(b)?)),
        None => {
            argument(text).map(Place::Argument).or_else(|| Some(Place::Literal(text.parse().ok()?)))
        }
    }
}
