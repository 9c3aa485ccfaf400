//! Arithmetic, comparisons, and choices.

use super::lex::Token;
use super::{Read, Reader, Value};
use crate::op::Op;
use crate::program::Arg;
use crate::suggest::did_you_mean;

/// Expressions nested more deeply are refused.
const MAX_DEPTH: usize = 200;

impl Reader<'_> {
    pub(super) fn float(&mut self) -> Read<Arg> {
        let at = self.offset();
        let value = self.expression()?;
        self.as_float(value, at)
    }

    pub(super) fn as_float(&self, value: Value, at: usize) -> Read<Arg> {
        match value {
            Value::Float(arg) => Ok(arg),
            _ => self.error(at, "expected a float"),
        }
    }

    /// A sum, a comparison of two, or a choice by one.
    pub(super) fn expression(&mut self) -> Read<Value> {
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
}
