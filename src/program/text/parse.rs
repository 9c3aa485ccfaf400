//! Parses tokens to a program, by recursive descent.

use super::Names;
use super::excerpt::{place, pointed};
use super::lex::{Token, tokens};
use crate::op::Op;
use crate::program::{Arg, Draft, Instr, Program};
use crate::suggest::did_you_mean;
use std::collections::{HashMap, HashSet};

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
    pub(super) fn at(text: &str, offset: usize, message: impl Into<String>) -> ParseError {
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
        /// The outputs' names; if empty, the last statement's name is the only output.
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

/// Parses a text that may hold free constants; these start at 1.
///
/// # Errors
/// As [`parse`].
pub fn parse_template(text: &str, scope: Scope) -> Result<Parsed, ParseError> {
    if text.len() > MAX_FORMULA {
        let message = format!("a formula of {} bytes is too long (at most 1 MiB)", text.len());
        return Err(ParseError::at(text, 0, message));
    }
    let names = match scope {
        Scope::Dataset(names) => names.clone(),
        Scope::Open { outputs } => Names { inputs: Vec::new(), outputs: outputs.to_vec() },
    };
    let mut parser = Parser {
        text,
        tokens: tokens(text)?,
        next: 0,
        depth: 0,
        draft: Draft::default(),
        inputs: first_places(&names.inputs),
        outputs: names.outputs.iter().cloned().collect(),
        names,
        open: matches!(scope, Scope::Open { .. }),
        assigned: HashMap::new(),
        last_assigned: None,
        free: Vec::new(),
        free_places: HashMap::new(),
        constants: HashMap::new(),
        results: HashMap::new(),
    };
    parser.statements()?;
    parser.finish()
}

/// The most bytes of a formula; longer text is refused unread. By hand.
pub const MAX_FORMULA: usize = 1 << 20;

fn first_places(names: &[String]) -> HashMap<String, usize> {
    let mut places = HashMap::new();
    for (place, name) in names.iter().enumerate() {
        places.entry(name.clone()).or_insert(place);
    }
    places
}

struct Parser<'a> {
    text: &'a str,
    tokens: Vec<(usize, Token)>,
    next: usize,
    depth: usize,
    draft: Draft,
    names: Names,
    /// The inputs' places in `names`.
    inputs: HashMap<String, usize>,
    outputs: HashSet<String>,
    open: bool,
    assigned: HashMap<String, Arg>,
    last_assigned: Option<String>,
    free: Vec<FreeConstant>,
    free_places: HashMap<String, Arg>,
    /// Numbers by their bits.
    constants: HashMap<u32, Arg>,
    /// Results by the instruction that computes them.
    results: HashMap<Instr, Arg>,
}

/// The deepest nesting of parentheses, calls and signs: each level takes some of the stack.
const MAX_DEPTH: usize = 200;

type Parse<T> = Result<T, ParseError>;

/// Lists the first few names.
fn listed(names: &[String]) -> String {
    const SHOWN: usize = 20;
    let shown = names[..names.len().min(SHOWN)].join(", ");
    if names.len() > SHOWN { format!("{shown}, …") } else { shown }
}

impl Parser<'_> {
    fn peek(&self) -> Option<&Token> {
        self.tokens.get(self.next).map(|(_, token)| token)
    }

    fn offset(&self) -> usize {
        self.tokens.get(self.next).map_or(self.text.trim_end().len(), |(at, _)| *at)
    }

    fn error<T>(&self, offset: usize, message: impl Into<String>) -> Parse<T> {
        Err(ParseError::at(self.text, offset, message))
    }

    fn take_symbol(&mut self, symbol: char) -> bool {
        let found = self.peek() == Some(&Token::Symbol(symbol));
        self.next += usize::from(found);
        found
    }

    fn expect(&mut self, symbol: char, context: &str) -> Parse<()> {
        if self.take_symbol(symbol) {
            return Ok(());
        }
        self.error(self.offset(), format!("expected `{symbol}` {context}"))
    }

    fn statements(&mut self) -> Parse<()> {
        loop {
            while self.peek() == Some(&Token::End) {
                self.next += 1;
            }
            if self.peek().is_none() {
                return Ok(());
            }
            self.statement()?;
            match self.peek() {
                None | Some(Token::End) => {}
                Some(_) => {
                    return self.error(
                        self.offset(),
                        "expected an operator, or `;` before the next statement",
                    );
                }
            }
        }
    }

    fn statement(&mut self) -> Parse<()> {
        let start = self.offset();
        let name = match (self.peek().cloned(), self.tokens.get(self.next + 1)) {
            (Some(Token::Name(name)), Some((_, Token::Symbol('=')))) => {
                self.next += 2;
                name
            }
            _ => {
                let example = self.names.outputs.first().map_or("y", String::as_str);
                return self
                    .error(start, format!("expected `name = expression`, as in `{example} = …`"));
            }
        };
        if self.inputs.contains_key(&name) {
            return self.error(start, format!("`{name}` is an input, and cannot be assigned"));
        }
        if self.assigned.contains_key(&name) {
            return self.error(start, format!("`{name}` is assigned twice"));
        }
        let value = self.sum()?;
        self.assigned.insert(name.clone(), value);
        self.last_assigned = Some(name);
        Ok(())
    }

    fn sum(&mut self) -> Parse<Arg> {
        let mut value = self.product()?;
        loop {
            let op = match self.peek() {
                Some(Token::Symbol('+')) => Op::Add,
                Some(Token::Symbol('-')) => Op::Sub,
                _ => return Ok(value),
            };
            self.next += 1;
            let right = self.product()?;
            value = self.apply(op, &[value, right])?;
        }
    }

    fn product(&mut self) -> Parse<Arg> {
        let mut value = self.negation()?;
        loop {
            let op = match self.peek() {
                Some(Token::Symbol('*')) => Op::Mul,
                Some(Token::Symbol('/')) => Op::Div,
                _ => return Ok(value),
            };
            self.next += 1;
            let right = self.negation()?;
            value = self.apply(op, &[value, right])?;
        }
    }

    /// Counts the depth: every nesting passes through here.
    fn negation(&mut self) -> Parse<Arg> {
        if self.depth == MAX_DEPTH {
            return self.error(
                self.offset(),
                format!("nested more than {MAX_DEPTH} deep; give inner parts names of their own"),
            );
        }
        self.depth += 1;
        let value = self.signed_power();
        self.depth -= 1;
        value
    }

    fn signed_power(&mut self) -> Parse<Arg> {
        if self.take_symbol('+') {
            return self.negation();
        }
        if !self.take_symbol('-') {
            return self.power();
        }
        // `-2` is a constant, but `-2^2` is the negation of a power.
        let number = match (self.peek(), self.tokens.get(self.next + 1)) {
            (_, Some((_, Token::Symbol('^')))) => None,
            (Some(Token::Number(value)), _) => Some(-*value),
            _ => None,
        };
        if let Some(value) = number {
            let at = self.offset();
            self.next += 1;
            return self.constant(value, at);
        }
        let value = self.negation()?;
        self.apply(Op::Neg, &[value])
    }

    fn power(&mut self) -> Parse<Arg> {
        let base = self.atom()?;
        if !self.take_symbol('^') {
            return Ok(base);
        }
        let at = self.offset();
        let exponent = self.exponent()?;
        self.repeated_product(base, exponent, at)
    }

    /// Parses the literal after `^`, itself perhaps raised to a power: `^` is right-associative.
    fn exponent(&mut self) -> Parse<f32> {
        let mut tower = Vec::new();
        loop {
            let Some(Token::Number(value)) = self.peek().cloned() else {
                return self.error(
                    self.offset(),
                    "an exponent after `^` is 2, 3, 4, 5, 6 or 8; write `pow(x, y)` for others",
                );
            };
            self.next += 1;
            tower.push(value);
            if !self.take_symbol('^') {
                return Ok(tower.into_iter().rev().fold(1.0, |power, base| base.powf(power)));
            }
        }
    }

    fn repeated_product(&mut self, x: Arg, exponent: f32, at: usize) -> Parse<Arg> {
        let square = |p: &mut Self, x| p.apply(Op::Mul, &[x, x]);
        match exponent {
            2.0 => square(self, x),
            3.0 => {
                let x2 = square(self, x)?;
                self.apply(Op::Mul, &[x2, x])
            }
            4.0 => {
                let x2 = square(self, x)?;
                square(self, x2)
            }
            5.0 => {
                let x2 = square(self, x)?;
                let x4 = square(self, x2)?;
                self.apply(Op::Mul, &[x4, x])
            }
            6.0 => {
                let x2 = square(self, x)?;
                let x3 = self.apply(Op::Mul, &[x2, x])?;
                square(self, x3)
            }
            8.0 => {
                let x2 = square(self, x)?;
                let x4 = square(self, x2)?;
                square(self, x4)
            }
            other => self.error(
                at,
                format!("`^` takes 2, 3, 4, 5, 6 or 8; write `pow(x, {other})` for this power"),
            ),
        }
    }

    fn atom(&mut self) -> Parse<Arg> {
        let at = self.offset();
        let Some(token) = self.peek().cloned() else {
            return self.error(at, "the formula ends where a value is expected");
        };
        self.next += 1;
        match token {
            Token::Number(value) => self.constant(value, at),
            Token::Free(name) => self.free_constant(name, at),
            Token::Symbol('(') => {
                let value = self.sum()?;
                self.expect(')', "to close the parenthesis")?;
                Ok(value)
            }
            Token::Name(name) if self.take_symbol('(') => self.call(&name, at),
            Token::Name(name) => self.name(name, at),
            Token::Symbol(symbol) => self.error(at, format!("expected a value, found `{symbol}`")),
            Token::End => self.error(at, "the statement ends where a value is expected"),
        }
    }

    fn name(&mut self, name: String, at: usize) -> Parse<Arg> {
        if let Some(value) = self.assigned.get(&name) {
            return Ok(*value);
        }
        if let Some(&index) = self.inputs.get(&name) {
            return Ok(Arg::Input(index as u16));
        }
        if self.outputs.contains(&name) {
            return self.error(at, format!("output `{name}` is used before it is assigned"));
        }
        if self.open {
            let index = self.names.inputs.len();
            self.room(index, "inputs", at)?;
            self.inputs.insert(name.clone(), index);
            self.names.inputs.push(name);
            self.draft.inputs = index + 1;
            return Ok(Arg::Input(index as u16));
        }
        let candidates = self.names.inputs.iter().chain(self.assigned.keys());
        let hint = did_you_mean(&name, candidates.map(String::as_str));
        let inputs = listed(&self.names.inputs);
        self.error(at, format!("unknown name `{name}`{hint} (inputs: {inputs})"))
    }

    fn call(&mut self, name: &str, at: usize) -> Parse<Arg> {
        let op = match name {
            "fma" => Op::Mad,
            "add" | "sub" | "mul" | "div" | "neg" => {
                return self.error(at, format!("`{name}` has no function form; write + - * /"));
            }
            _ => match Op::from_name(name) {
                Some(op) => op,
                None => {
                    let hint = did_you_mean(name, Op::ALL.iter().map(|op| op.name()));
                    return self.error(at, format!("unknown operation `{name}`{hint}"));
                }
            },
        };
        let args = if op == Op::Select { self.select_arguments()? } else { self.arguments()? };
        if args.len() != op.arity() {
            let (given, wanted) = (args.len(), op.arity());
            let plural = if wanted == 1 { "" } else { "s" };
            return self.error(at, format!("`{op}` takes {wanted} argument{plural}, not {given}"));
        }
        self.apply(op, &args)
    }

    fn arguments(&mut self) -> Parse<Vec<Arg>> {
        let mut args = vec![self.sum()?];
        while self.take_symbol(',') {
            args.push(self.sum()?);
        }
        self.expect(')', "after the arguments")?;
        Ok(args)
    }

    /// `a < b, x, y)`, or with `>`.
    fn select_arguments(&mut self) -> Parse<Vec<Arg>> {
        let left = self.sum()?;
        let less = self.take_symbol('<');
        if !less {
            self.expect('<', "or `>` in the condition of `select(a < b, x, y)`")
                .or_else(|e| if self.take_symbol('>') { Ok(()) } else { Err(e) })?;
        }
        let right = self.sum()?;
        let mut args = if less { vec![left, right] } else { vec![right, left] };
        self.expect(',', "after the condition of `select(a < b, x, y)`")?;
        args.extend(self.arguments()?);
        Ok(args)
    }

    /// Checks that a program can hold one more.
    fn room(&self, count: usize, what: &str, at: usize) -> Parse<()> {
        if count < usize::from(u16::MAX) {
            return Ok(());
        }
        self.error(at, format!("too many {what}; a formula has at most {}", u16::MAX))
    }

    fn constant(&mut self, value: f32, at: usize) -> Parse<Arg> {
        if let Some(&known) = self.constants.get(&value.to_bits()) {
            return Ok(known);
        }
        self.room(self.draft.consts.len(), "numbers", at)?;
        let constant = self.draft.constant(value);
        self.constants.insert(value.to_bits(), constant);
        Ok(constant)
    }

    fn free_constant(&mut self, name: String, at: usize) -> Parse<Arg> {
        if let Some(&known) = self.free_places.get(&name) {
            return Ok(known);
        }
        self.room(self.draft.consts.len(), "constants", at)?;
        let arg = self.draft.constant(1.0);
        if let Arg::Const(index) = arg {
            self.free_places.insert(name.clone(), arg);
            self.free.push(FreeConstant { name, index });
        }
        Ok(arg)
    }

    /// Applies an operation, or returns the result if the formula has computed it already.
    fn apply(&mut self, op: Op, args: &[Arg]) -> Parse<Arg> {
        let instr = Instr::new(op, args);
        if let Some(&known) = self.results.get(&instr) {
            return Ok(known);
        }
        self.room(self.draft.instrs.len(), "operations", self.offset())?;
        let result = self.draft.push(op, args);
        self.results.insert(instr, result);
        Ok(result)
    }

    fn finish(mut self) -> Parse<Parsed> {
        let end = self.text.trim_end().len();
        if self.open && self.names.outputs.is_empty() {
            self.names.outputs.extend(self.last_assigned.clone());
        }
        if self.names.outputs.is_empty() {
            return self.error(end, "the formula has no statement");
        }
        self.draft.inputs = self.names.inputs.len();
        for output in &self.names.outputs {
            match self.assigned.get(output) {
                Some(value) => self.draft.outputs.push(*value),
                None => {
                    let hint = did_you_mean(output, self.assigned.keys().map(String::as_str));
                    return self.error(end, format!("output `{output}` is never assigned{hint}"));
                }
            }
        }
        let text = self.text;
        let program = Program::verify(self.draft)
            .map_err(|invalid| ParseError::at(text, end, invalid.to_string()))?;
        Ok(Parsed { program, names: self.names, free: self.free })
    }
}
