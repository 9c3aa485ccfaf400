//! Parses statements and expressions from tokens, by recursive descent.

use super::definitions::Definitions;
use super::functions::{self, Function};
use super::lex::{Number, Token, Tokens};
use super::{ParseError, Parsed, Scope};
use crate::op::Op;
use crate::program::Arg;
use crate::suggest::did_you_mean;

/// Parses a whole text.
pub(super) fn parse_text(text: &str, scope: Scope) -> Parse<Parsed> {
    let tokens = Tokens::new(text)?;
    let mut parser = Parser { tokens, depth: 0, definitions: Definitions::new(scope) };
    parser.statements()?;
    let Parser { tokens, definitions, .. } = parser;
    tokens.placed(tokens.offset(), definitions.finish())
}

struct Parser<'a> {
    tokens: Tokens<'a>,
    depth: usize,
    definitions: Definitions,
}

/// A comparison as the table has it: `less[0] < less[1]`, or not that.
struct Condition {
    less: [Arg; 2],
    negated: bool,
}

/// The deepest nesting of parentheses, calls and signs: each level takes some of the stack.
const MAX_DEPTH: usize = 200;

type Parse<T> = Result<T, ParseError>;

impl Parser<'_> {
    fn statements(&mut self) -> Parse<()> {
        loop {
            while self.tokens.peek() == Some(&Token::End) {
                self.tokens.skip(1);
            }
            if self.tokens.peek().is_none() {
                return Ok(());
            }
            self.statement()?;
            match self.tokens.peek() {
                None | Some(Token::End) => {}
                Some(Token::Symbol('?')) => {
                    let message = "`?` needs a comparison before it, as in `a < b ? x : y`";
                    return self.tokens.error(self.tokens.offset(), message);
                }
                Some(_) => {
                    let message = "expected an operator, or `;` before the next statement";
                    return self.tokens.error(self.tokens.offset(), message);
                }
            }
        }
    }

    fn statement(&mut self) -> Parse<()> {
        let start = self.tokens.offset();
        let (Some(Token::Name(name)), Some(Token::Symbol('='))) =
            (self.tokens.peek().cloned(), self.tokens.peek_second())
        else {
            let example = self.definitions.example();
            let message = format!("expected `name = expression`, as in `{example} = …`");
            return self.tokens.error(start, message);
        };
        self.tokens.skip(2);
        self.tokens.placed(start, self.definitions.check_assignable(&name))?;
        let value = self.expression()?;
        self.definitions.assign(name, value);
        Ok(())
    }

    /// Parses a sum, or a choice `a < b ? x : y`.
    fn expression(&mut self) -> Parse<Arg> {
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
    fn comparison(&mut self, left: Arg) -> Parse<Condition> {
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

    fn choose(&mut self, condition: Condition, yes: Arg, no: Arg) -> Parse<Arg> {
        let Condition { less: [a, b], negated } = condition;
        let [holds, fails] = if negated { [no, yes] } else { [yes, no] };
        self.apply(Op::Select, &[a, b, holds, fails])
    }

    fn sum(&mut self) -> Parse<Arg> {
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

    fn product(&mut self) -> Parse<Arg> {
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

    fn negation(&mut self) -> Parse<Arg> {
        self.nested(Parser::signed_power)
    }

    /// Counts the depth: every nesting passes through here.
    fn nested(&mut self, parse: fn(&mut Self) -> Parse<Arg>) -> Parse<Arg> {
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

    fn signed_power(&mut self) -> Parse<Arg> {
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

    fn power(&mut self) -> Parse<Arg> {
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
            other => self.tokens.error(
                at,
                format!("`^` takes 2, 3, 4, 5, 6 or 8; write `pow(x, {other})` for this power"),
            ),
        }
    }

    fn atom(&mut self) -> Parse<Arg> {
        let at = self.tokens.offset();
        let Some(token) = self.tokens.peek().cloned() else {
            return self.tokens.error(at, "the formula ends where a value is expected");
        };
        self.tokens.skip(1);
        match token {
            Token::Number(value) => self.constant(value, at),
            Token::Free(name) => self.tokens.placed(at, self.definitions.free_constant(name)),
            Token::Symbol('(') => {
                let value = self.expression()?;
                self.tokens.expect(')', "to close the parenthesis")?;
                Ok(value)
            }
            Token::Name(name) if self.tokens.take_symbol('(') => self.call(&name, at),
            Token::Name(name) => self.tokens.placed(at, self.definitions.name(name)),
            Token::Symbol(symbol) => {
                self.tokens.error(at, format!("expected a value, found `{symbol}`"))
            }
            Token::End => self.tokens.error(at, "the statement ends where a value is expected"),
        }
    }

    fn call(&mut self, name: &str, at: usize) -> Parse<Arg> {
        if let "add" | "sub" | "mul" | "div" | "neg" = name {
            let message = format!("`{name}` has no function form; write + - * /");
            return self.tokens.error(at, message);
        }
        if name == Op::Select.name() {
            return self.select();
        }
        let Some(function) = Function::find(name) else {
            let hint = did_you_mean(name, functions::names());
            return self.tokens.error(at, format!("unknown operation `{name}`{hint}"));
        };
        let args = self.arguments()?;
        let function = function.of_arguments(args.len());
        if args.len() != function.arity() {
            let (given, wanted) = (args.len(), function.arity());
            let plural = if wanted == 1 { "" } else { "s" };
            let message = format!("`{name}` takes {wanted} argument{plural}, not {given}");
            return self.tokens.error(at, message);
        }
        match function {
            Function::Operation(op) => self.apply(op, &args),
            Function::Formula(formula) => {
                self.tokens.placed(at, self.definitions.write_out(&formula, &args))
            }
        }
    }

    fn arguments(&mut self) -> Parse<Vec<Arg>> {
        let mut args = vec![self.expression()?];
        while self.tokens.take_symbol(',') {
            args.push(self.expression()?);
        }
        self.tokens.expect(')', "after the arguments")?;
        Ok(args)
    }

    /// Parses `a < b, x, y)`.
    fn select(&mut self) -> Parse<Arg> {
        let left = self.sum()?;
        let condition = self.comparison(left)?;
        self.tokens.expect(',', "after the condition of `select(a < b, x, y)`")?;
        let yes = self.expression()?;
        self.tokens.expect(',', "between the values of `select(a < b, x, y)`")?;
        let no = self.expression()?;
        self.tokens.expect(')', "after the arguments")?;
        self.choose(condition, yes, no)
    }

    fn constant(&mut self, value: Number, at: usize) -> Parse<Arg> {
        self.tokens.placed(at, self.definitions.constant(value))
    }

    fn apply(&mut self, op: Op, args: &[Arg]) -> Parse<Arg> {
        self.tokens.placed(self.tokens.offset(), self.definitions.apply(op, args))
    }
}
