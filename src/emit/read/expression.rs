//! Arithmetic, comparisons, and choices.

use super::lex::{Number, NumberKind, Token};
use super::types::{Float, Type};
use super::{Comparison, Read, Reader, Several, Value};
use crate::emit::Language;
use crate::emit::syntax::Style;
use crate::op::Op;
use crate::suggest::did_you_mean;

/// Deeper nesting is refused, before the parser's recursion can exhaust the stack.
const MAX_DEPTH: usize = 200;

impl Reader<'_> {
    pub(super) fn float(&mut self) -> Read<Float> {
        let at = self.offset();
        let value = self.expression()?;
        self.as_float(value, at)
    }

    pub(super) fn as_float(&self, value: Value, at: usize) -> Read<Float> {
        match value {
            Value::Float(value) => Ok(value),
            _ => self.error(at, "expected a float"),
        }
    }

    /// Reads a sum, a comparison of two, or a choice by one.
    pub(super) fn expression(&mut self) -> Read<Value> {
        self.deeper(|reader| {
            let at = reader.offset();
            if reader.syntax.readable.style == Style::Rust && reader.take_word("if") {
                return reader.rust_choice(at);
            }
            let value = reader.comparison()?;
            let question = reader.offset();
            if !reader.take_symbol('?') {
                return Ok(value);
            }
            if reader.language == Language::Wgsl {
                return reader.error(question, "WGSL has no `?`; write `select(y, x, a < b)`");
            }
            let Value::Compared(condition) = value else {
                return reader.error(at, "expected a comparison before `?`");
            };
            let x = reader.float()?;
            reader.expect(':', "between the values to choose from")?;
            let y = reader.float()?;
            reader.choice(condition, x, y, at)
        })
    }

    /// Reads `a < b { x } else { y }`, after `if`.
    fn rust_choice(&mut self, at: usize) -> Read<Value> {
        let Value::Compared(condition) = self.comparison()? else {
            return self.error(at, "expected a comparison after `if`");
        };
        self.expect('{', "and a value")?;
        let x = self.float()?;
        self.expect('}', "after a value")?;
        if !self.take_word("else") {
            return self.error(self.offset(), "expected `else`");
        }
        let from = self.offset();
        let y = match self.take_word("if") {
            true => {
                let y = self.deeper(|reader| reader.rust_choice(from))?;
                self.as_float(y, from)?
            }
            false => {
                self.expect('{', "and a value")?;
                let y = self.float()?;
                self.expect('}', "after a value")?;
                y
            }
        };
        self.choice(condition, x, y, at)
    }

    /// Chooses the first value if the condition holds, else the second.
    pub(super) fn choice(
        &mut self,
        condition: Comparison,
        x: Float,
        y: Float,
        at: usize,
    ) -> Read<Value> {
        let of = match [x.of, y.of] {
            [Type::Integer, Type::Integer] => Type::Integer,
            [x, y] => self.meeting(x, y, at)?,
        };
        let arg = match condition {
            Comparison::Less(a, b) => self.push(Op::Select, &[a, b, x.arg, y.arg], of)?,
            Comparison::AtLeast(a, b) => {
                if !self.is_constant(&x, 1.0) || !self.is_constant(&y, 0.0) {
                    return self.error(
                        at,
                        "`>=` chooses between other values than 1 and 0; compare by `<`",
                    );
                }
                self.push(Op::Step, &[b, a], of)?
            }
        };
        Ok(Value::Float(Float { arg, of, exact: None }))
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
        let or_equal = self.take_symbol('=');
        let left = self.as_float(left, at)?;
        let at = self.offset();
        let right = self.sum()?;
        let right = self.as_float(right, at)?;
        self.meeting(left.of, right.of, at)?;
        let (left, right) = (left.arg, right.arg);
        Ok(Value::Compared(match (less, or_equal) {
            (true, false) => Comparison::Less(left, right),
            (false, false) => Comparison::Less(right, left),
            (true, true) => Comparison::AtLeast(right, left),
            (false, true) => Comparison::AtLeast(left, right),
        }))
    }

    fn sum(&mut self) -> Read<Value> {
        self.chain([('+', Op::Add), ('-', Op::Sub)], Self::product)
    }

    fn product(&mut self) -> Read<Value> {
        self.chain([('*', Op::Mul), ('/', Op::Div)], Self::negation)
    }

    /// Reads operands between operators that associate to the left.
    fn chain(
        &mut self,
        operators: [(char, Op); 2],
        operand: fn(&mut Self) -> Read<Value>,
    ) -> Read<Value> {
        let at = self.offset();
        let mut value = operand(self)?;
        while let Some((_, op)) = operators.into_iter().find(|(s, _)| self.is_symbol(0, *s)) {
            let between = self.offset();
            self.next += 1;
            if self.syntax.readable.style == Style::Nodes {
                return self
                    .error(between, "nodes have no operators; write `add`, `sub`, `mul` or `div`");
            }
            let left = self.as_float(value, at)?;
            let at = self.offset();
            let right = operand(self)?;
            let right = self.as_float(right, at)?;
            value = Value::Float(self.arithmetic(op, [left, right], between)?);
        }
        Ok(value)
    }

    fn negation(&mut self) -> Read<Value> {
        if !self.take_symbol('-') {
            return self.atom();
        }
        if let Some(&Token::Number(number)) = self.peek() {
            self.next += 1;
            return self.literal(number, -1.0).map(Value::Float);
        }
        let at = self.offset();
        let value = self.deeper(Self::negation)?;
        let value = self.as_float(value, at)?;
        let arg = self.push(Op::Neg, &[value.arg], value.of)?;
        Ok(Value::Float(Float { arg, exact: value.exact.map(|exact| -exact), ..value }))
    }

    fn literal(&mut self, number: Number, sign: f32) -> Read<Float> {
        let of = match number.kind {
            NumberKind::Integer => Type::Integer,
            NumberKind::Plain => self.plain_type(),
            NumberKind::Single => Type::Single,
            NumberKind::Half => Type::Half,
        };
        // There is no integer -0.
        let zero = of == Type::Integer && number.single == 0.0;
        let value = if zero { 0.0 } else { sign * number.single };
        let exact = f64::from(sign) * number.exact;
        let float = Float { arg: self.number(value)?, of: Type::Single, exact: None };
        let float = if of == Type::Half { self.cast(float, of)? } else { float };
        Ok(Float { of, exact: Some(exact), ..float })
    }

    /// Returns true if infinities and NaNs have names.
    fn names_non_finite(&self) -> bool {
        self.syntax.float_of_bits.is_empty()
    }

    /// Reads `.x` or `.yx` after a vector.
    fn component_of(&mut self, value: Value) -> Read<Value> {
        let at = self.offset();
        if !self.take_symbol('.') {
            return Ok(value);
        }
        let (Value::Several(vector), Some(swizzle)) = (&value, self.take_name()) else {
            return self.error(at, "`.` after what is no vector");
        };
        let letters =
            |set: &str| -> Option<Vec<usize>> { swizzle.chars().map(|c| set.find(c)).collect() };
        let places = letters("xyzw").or_else(|| letters("rgba")).unwrap_or_default();
        let components: Option<Vec<_>> =
            places.iter().map(|&i| vector.components.get(i).cloned()).collect();
        match components.as_deref() {
            Some([(_, value)]) => Ok(Value::Float(*value)),
            Some(many @ [_, _, ..]) if many.len() <= 4 => {
                let components = many.iter().map(|(_, value)| (None, *value)).collect();
                Ok(Value::Several(Several { of: String::new(), components }))
            }
            _ => self.error(at, format!("`.{swizzle}` is no component of this vector")),
        }
    }

    fn atom(&mut self) -> Read<Value> {
        let at = self.offset();
        let Some(token) = self.peek().cloned() else {
            return self.error(at, "the text ends where a value is expected");
        };
        self.next += 1;
        match token {
            Token::Number(number) => self.literal(number, 1.0).map(Value::Float),
            Token::Bits(bits) => Ok(Value::Bits(bits)),
            Token::Symbol('(') => {
                let value = self.expression()?;
                self.expect(')', "to close the parenthesis")?;
                Ok(value)
            }
            Token::Name(name) if self.values.contains_key(&name) => {
                let value = self.values[&name].clone();
                self.component_of(value)
            }
            Token::Name(name) if non_finite(&name).is_some_and(|_| self.names_non_finite()) => {
                let value = non_finite(&name).unwrap_or(f32::NAN);
                Ok(Value::Float(Float::single(self.float_of_bits(value.to_bits())?)))
            }
            Token::Name(name) => {
                let called = self.with_element(name);
                if self.take_symbol('(') {
                    return self.call(called, at);
                }
                let hint = did_you_mean(&called, self.values.keys().map(String::as_str));
                self.error(at, format!("`{called}` is no parameter and no local{hint}"))
            }
            Token::Symbol(symbol) => self.error(at, format!("expected a value, found `{symbol}`")),
        }
    }
}

/// Returns the infinity or NaN of a name in C, JavaScript, Python or Rust.
fn non_finite(name: &str) -> Option<f32> {
    match name {
        "INFINITY" | "Infinity" | "np.inf" | "f32::INFINITY" => Some(f32::INFINITY),
        "f32::NEG_INFINITY" => Some(f32::NEG_INFINITY),
        "NAN" | "NaN" | "np.nan" | "f32::NAN" => Some(f32::NAN),
        _ => None,
    }
}
