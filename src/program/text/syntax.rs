//! Parses statements and expressions from tokens, by recursive descent.

use super::call::Written;
use super::definitions::Definitions;
use super::holes::Holes;
use super::lex::{Number, Token, Tokens};
use super::{Names, ParseError, Parsed, Scope};
use crate::op::Op;
use crate::program::{Arg, Program};
use std::collections::HashMap;

/// Parses a whole text.
pub(super) fn parse_text(text: &str, scope: Scope) -> Parse<Parsed> {
    let mut parser = Parser::new(text, Definitions::new(scope))?;
    parser.statements()?;
    let Parser { tokens, definitions, .. } = parser;
    tokens.placed(tokens.offset(), definitions.finish())
}

/// Parses a whole text that may call functions to be found.
pub(super) fn parse_text_with_holes(text: &str, names: &Names) -> Parse<(Parsed, Holes)> {
    let mut parser = Parser::new(text, Definitions::with_holes(names))?;
    parser.statements()?;
    let Parser { tokens, definitions, .. } = parser;
    tokens.placed(tokens.offset(), definitions.finish_with_holes())
}

/// Returns the outputs that such a text assigns.
pub(super) fn assigned_in(text: &str, names: &Names) -> Parse<Vec<String>> {
    let mut parser = Parser::new(text, Definitions::with_holes(names))?;
    parser.statements()?;
    Ok(parser.definitions.outputs_assigned())
}

/// Parses an expression over vectors, each with its number of components; these are the inputs, in
/// order.
pub(super) fn parse_expression(text: &str, vectors: &[(String, usize)]) -> Parse<Program> {
    let mut parser = Parser::new(text, Definitions::of_vectors(vectors))?;
    let value = parser.expression()?;
    parser.check_ended()?;
    let at = parser.tokens.offset();
    if parser.tokens.peek().is_some() {
        return parser.tokens.error(at, "expected one expression");
    }
    let Parser { tokens, definitions, .. } = parser;
    tokens.placed(at, definitions.finish_with(value))
}

/// The values of an expression: one, or those of a vector.
pub(super) type Value = Vec<Arg>;

pub(super) struct Parser<'a> {
    pub(super) tokens: Tokens<'a>,
    depth: usize,
    pub(super) definitions: Definitions,
    /// The functions that the text defines, by name.
    pub(super) written: HashMap<String, Written>,
    /// The calls of such functions that are being written out, the innermost last; first, none.
    pub(super) frames: Vec<Frame>,
    /// What calls of such functions returned, by name and arguments.
    pub(super) returned: HashMap<(String, Vec<Value>), Value>,
}

/// The names that mean something only where they stand: parameters, and values named within
/// parentheses.
#[derive(Default)]
pub(super) struct Frame {
    /// The function that is written out.
    pub(super) function: Option<String>,
    pub(super) values: Vec<(String, Value)>,
}

/// A comparison as the table has it: `less[0] < less[1]`, or not that.
struct Condition {
    less: [Value; 2],
    negated: bool,
}

/// The deepest nesting of parentheses, calls and signs: each level takes some of the stack.
const MAX_DEPTH: usize = 200;

pub(super) type Parse<T> = Result<T, ParseError>;

impl<'a> Parser<'a> {
    pub(super) fn new(text: &'a str, definitions: Definitions) -> Parse<Parser<'a>> {
        let mut parser = Parser {
            tokens: Tokens::new(text)?,
            depth: 0,
            definitions,
            written: HashMap::new(),
            frames: vec![Frame::default()],
            returned: HashMap::new(),
        };
        parser.collect_written()?;
        Ok(parser)
    }
}

impl Parser<'_> {
    /// Parses a sum, or a choice `a < b ? x : y`.
    pub(super) fn expression(&mut self) -> Parse<Value> {
        let condition = if self.tokens.open_condition() {
            self.tokens.skip(1);
            let left = self.sum()?;
            let condition = self.comparison(left)?;
            self.tokens.expect(')', "after the condition")?;
            condition
        } else {
            let value = self.sum()?;
            if !matches!(self.tokens.peek(), Some(Token::Symbol('<' | '>'))) {
                return Ok(value);
            }
            self.comparison(value)?
        };
        self.tokens.expect('?', "after the condition, as in `a < b ? x : y`")?;
        let yes = self.nested(Parser::expression)?;
        self.tokens.expect(':', "between the two values, as in `a < b ? x : y`")?;
        let no = self.nested(Parser::expression)?;
        self.choose(condition, yes, no)
    }

    /// Parses a comparison from its operator on.
    fn comparison(&mut self, left: Value) -> Parse<Condition> {
        let less = self.tokens.take_symbol('<');
        if !less {
            self.tokens
                .expect('<', "or `>` in the condition, as in `a < b`")
                .or_else(|e| if self.tokens.take_symbol('>') { Ok(()) } else { Err(e) })?;
        }
        let or_equal = self.tokens.take_symbol('=');
        let right = self.sum()?;
        // `a <= b` is read as not `b < a`: the same but for NaN.
        Ok(match less != or_equal {
            true => Condition { less: [left, right], negated: or_equal },
            false => Condition { less: [right, left], negated: or_equal },
        })
    }

    fn choose(&mut self, condition: Condition, yes: Value, no: Value) -> Parse<Value> {
        let Condition { less: [a, b], negated } = condition;
        let [holds, fails] = if negated { [no, yes] } else { [yes, no] };
        self.apply(Op::Select, &[a, b, holds, fails])
    }

    fn sum(&mut self) -> Parse<Value> {
        let mut value = self.product()?;
        loop {
            let op = match self.tokens.peek() {
                Some(Token::Symbol('+')) => Op::Add,
                Some(Token::Symbol('-')) => Op::Sub,
                _ => return Ok(value),
            };
            self.tokens.skip(1);
            let right = self.product()?;
            value = self.apply(op, &[value, right])?;
        }
    }

    fn product(&mut self) -> Parse<Value> {
        let mut value = self.negation()?;
        loop {
            let op = match self.tokens.peek() {
                Some(Token::Symbol('*')) => Op::Mul,
                Some(Token::Symbol('/')) => Op::Div,
                _ => return Ok(value),
            };
            self.tokens.skip(1);
            let right = self.negation()?;
            value = self.apply(op, &[value, right])?;
        }
    }

    fn negation(&mut self) -> Parse<Value> {
        self.nested(Parser::signed_power)
    }

    /// Counts the depth: every nesting passes through here.
    pub(super) fn nested(&mut self, parse: impl FnOnce(&mut Self) -> Parse<Value>) -> Parse<Value> {
        if self.depth == MAX_DEPTH {
            return self.tokens.error(
                self.tokens.offset(),
                format!("nested more than {MAX_DEPTH} deep; give inner parts names of their own"),
            );
        }
        self.depth += 1;
        let value = parse(self);
        self.depth -= 1;
        value
    }

    fn signed_power(&mut self) -> Parse<Value> {
        if self.tokens.take_symbol('+') {
            return self.negation();
        }
        if !self.tokens.take_symbol('-') {
            return self.power();
        }
        // `-2` is a constant, but `-2^2` is the negation of a power.
        let number = match (self.tokens.peek(), self.tokens.peek_second()) {
            (_, Some(Token::Symbol('^'))) => None,
            (Some(Token::Number(value)), _) => Some(-*value),
            _ => None,
        };
        if let Some(value) = number {
            let at = self.tokens.offset();
            self.tokens.skip(1);
            return self.constant(value, at);
        }
        let value = self.negation()?;
        self.apply(Op::Neg, &[value])
    }

    fn power(&mut self) -> Parse<Value> {
        let base = self.atom()?;
        if !self.tokens.take_symbol('^') {
            return Ok(base);
        }
        let at = self.tokens.offset();
        let exponent = self.exponent()?;
        self.repeated_product(base, exponent, at)
    }

    /// Parses the literal after `^`, itself perhaps raised to a power: `^` is right-associative.
    fn exponent(&mut self) -> Parse<f32> {
        let mut tower = Vec::new();
        loop {
            let Some(Token::Number(value)) = self.tokens.peek().cloned() else {
                return self.tokens.error(
                    self.tokens.offset(),
                    "an exponent after `^` is 2, 3, 4, 5, 6 or 8; write `pow(x, y)` for others",
                );
            };
            self.tokens.skip(1);
            tower.push(value.rounded);
            if !self.tokens.take_symbol('^') {
                return Ok(tower.into_iter().rev().fold(1.0, |power, base| base.powf(power)));
            }
        }
    }

    fn repeated_product(&mut self, x: Value, exponent: f32, at: usize) -> Parse<Value> {
        let square = |p: &mut Self, x: &Value| p.apply(Op::Mul, &[x.clone(), x.clone()]);
        match exponent {
            2.0 => square(self, &x),
            3.0 => {
                let x2 = square(self, &x)?;
                self.apply(Op::Mul, &[x2, x])
            }
            4.0 => {
                let x2 = square(self, &x)?;
                square(self, &x2)
            }
            5.0 => {
                let x2 = square(self, &x)?;
                let x4 = square(self, &x2)?;
                self.apply(Op::Mul, &[x4, x])
            }
            6.0 => {
                let x2 = square(self, &x)?;
                let x3 = self.apply(Op::Mul, &[x2, x])?;
                square(self, &x3)
            }
            8.0 => {
                let x2 = square(self, &x)?;
                let x4 = square(self, &x2)?;
                square(self, &x4)
            }
            other => self.tokens.error(
                at,
                format!("`^` takes 2, 3, 4, 5, 6 or 8; write `pow(x, {other})` for this power"),
            ),
        }
    }

    fn atom(&mut self) -> Parse<Value> {
        let at = self.tokens.offset();
        let Some(token) = self.tokens.peek().cloned() else {
            return self.tokens.error(at, "the formula ends where a value is expected");
        };
        self.tokens.skip(1);
        match token {
            Token::Number(value) => self.constant(value, at),
            Token::Free(name) if self.tokens.take_symbol('(') => self.matrix(&name, at, None),
            Token::Free(name) => {
                Ok(vec![self.tokens.placed(at, self.definitions.free_constant(name, None))?])
            }
            Token::Symbol('(') => self.parenthesised(),
            Token::Name(name) if self.tokens.take_symbol('(') => self.call(&name, at, 1),
            Token::Name(name) => self.name(name, at),
            Token::Symbol(symbol) => {
                self.tokens.error(at, format!("expected a value, found `{symbol}`"))
            }
            Token::End => self.tokens.error(at, "the statement ends where a value is expected"),
        }
    }

    /// Parses `x)`, a vector `x, y)`, or either after names of its own: `t = x*x; t + x)`.
    fn parenthesised(&mut self) -> Parse<Value> {
        let outside = self.frame().values.len();
        while let (Some(Token::Name(name)), Some(Token::Symbol('='))) =
            (self.tokens.peek().cloned(), self.tokens.peek_second())
        {
            self.tokens.skip(2);
            let value = self.expression()?;
            self.tokens.expect(';', "after a value that is named within parentheses")?;
            self.frame().values.push((name, value));
        }
        let mut value = self.expression()?;
        while self.tokens.take_symbol(',') {
            value.extend(self.expression()?);
        }
        self.tokens.expect(')', "to close the parenthesis")?;
        self.frame().values.truncate(outside);
        Ok(value)
    }

    /// Returns the innermost frame.
    pub(super) fn frame(&mut self) -> &mut Frame {
        self.frames.last_mut().expect("the outermost frame stays")
    }

    fn name(&mut self, name: String, at: usize) -> Parse<Value> {
        let local = self.frame().values.iter().rev().find(|(known, _)| *known == name);
        if let Some((_, value)) = local {
            return Ok(value.clone());
        }
        match name.split_once('.') {
            Some((vector, letters)) if !self.definitions.knows(&name) => {
                let value = self.name(vector.to_owned(), at)?;
                self.tokens.placed(at, swizzled(vector, &value, letters))
            }
            _ => self.tokens.placed(at, self.definitions.name(name)),
        }
    }

    /// Parses `a < b, x, y)`.
    pub(super) fn select(&mut self) -> Parse<Value> {
        let left = self.sum()?;
        let condition = self.comparison(left)?;
        self.tokens.expect(',', "after the condition of `select(a < b, x, y)`")?;
        let yes = self.expression()?;
        self.tokens.expect(',', "between the values of `select(a < b, x, y)`")?;
        let no = self.expression()?;
        self.tokens.expect(')', "after the arguments")?;
        self.choose(condition, yes, no)
    }

    fn constant(&mut self, value: Number, at: usize) -> Parse<Value> {
        Ok(vec![self.tokens.placed(at, self.definitions.constant(value))?])
    }

    /// Applies an operation to values, or to each component of vectors.
    pub(super) fn apply(&mut self, op: Op, args: &[Value]) -> Parse<Value> {
        let at = self.tokens.offset();
        let width = self.tokens.placed(at, common_width(args))?;
        let component = |place: usize| {
            let component: Vec<Arg> = args.iter().map(|value| value[place % value.len()]).collect();
            self.definitions.apply(op, &component)
        };
        let components = (0..width).map(component).collect();
        self.tokens.placed(at, components)
    }
}

/// The letters of a vector's components, as shading languages have them.
const LETTERS: [&str; 2] = ["xyzw", "rgba"];

/// Returns the components `vector.letters` of a value.
fn swizzled(vector: &str, value: &Value, letters: &str) -> Result<Value, String> {
    let places = LETTERS.iter().find_map(|known| {
        let places = letters.chars().map(|letter| known.find(letter));
        places.collect::<Option<Vec<usize>>>()
    });
    let components = places.and_then(|places| {
        places.iter().map(|&place| value.get(place).copied()).collect::<Option<Value>>()
    });
    components.filter(|_| value.len() > 1).ok_or_else(|| match value.len() {
        1 => format!("`{vector}` is one value, and has no components `{letters}`"),
        count => {
            let has = LETTERS[0].get(..count).unwrap_or(LETTERS[0]);
            format!("`{vector}` has the components `{has}`, and no `{letters}`")
        }
    })
}

/// Returns the number of components of what is computed of some values; single values go with each
/// component of the others.
pub(super) fn common_width(values: &[Value]) -> Result<usize, String> {
    let width = values.iter().map(Vec::len).max().unwrap_or(1);
    match values.iter().map(Vec::len).find(|&other| other != width && other != 1) {
        None => Ok(width),
        Some(other) => {
            Err(format!("values of {other} and of {width} components do not go together"))
        }
    }
}
