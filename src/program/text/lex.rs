//! Splits formula text into tokens, and steps through them.

use super::ParseError;
use super::excerpt::plain;

#[derive(Clone, Debug, PartialEq)]
pub(super) enum Token {
    Name(String),
    /// `$name`
    Free(String),
    Number(Number),
    /// One of `+ - * / ^ ( ) , = < > ? :`
    Symbol(char),
    /// `;` or a new line
    End,
}

/// A number as it is written: rounded to a program's constant, and in double precision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Number {
    pub rounded: f32,
    pub exact: f64,
}

impl std::ops::Neg for Number {
    type Output = Number;

    fn neg(self) -> Number {
        Number { rounded: -self.rounded, exact: -self.exact }
    }
}

/// The tokens of a text, read from first to last.
pub(super) struct Tokens<'a> {
    text: &'a str,
    /// Each with its byte offset.
    all: Vec<(usize, Token)>,
    next: usize,
}

impl Tokens<'_> {
    pub(super) fn new(text: &str) -> Result<Tokens<'_>, ParseError> {
        Ok(Tokens { text, all: split(text)?, next: 0 })
    }

    pub(super) fn peek(&self) -> Option<&Token> {
        self.all.get(self.next).map(|(_, token)| token)
    }

    pub(super) fn peek_second(&self) -> Option<&Token> {
        self.all.get(self.next + 1).map(|(_, token)| token)
    }

    pub(super) fn skip(&mut self, count: usize) {
        self.next += count;
    }

    /// The byte offset of the next token, or of the end of the text.
    pub(super) fn offset(&self) -> usize {
        self.all.get(self.next).map_or(self.text.trim_end().len(), |(at, _)| *at)
    }

    pub(super) fn error<T>(
        &self,
        offset: usize,
        message: impl Into<String>,
    ) -> Result<T, ParseError> {
        Err(ParseError::at(self.text, offset, message))
    }

    /// Turns a message to an error at this offset.
    pub(super) fn placed<T>(
        &self,
        offset: usize,
        result: Result<T, String>,
    ) -> Result<T, ParseError> {
        result.or_else(|message| self.error(offset, message))
    }

    /// Returns true if the next token opens parentheses that hold a condition: a comparison within
    /// them, and `?` after them.
    pub(super) fn open_condition(&self) -> bool {
        if self.peek() != Some(&Token::Symbol('(')) {
            return false;
        }
        let (mut depth, mut compares) = (0, false);
        for (at, (_, token)) in self.all.iter().enumerate().skip(self.next) {
            match token {
                Token::Symbol('(') => depth += 1,
                Token::Symbol(')') => depth -= 1,
                Token::Symbol('<' | '>') if depth == 1 => compares = true,
                _ => {}
            }
            if depth == 0 {
                let after = self.all.get(at + 1).map(|(_, token)| token);
                return compares && after == Some(&Token::Symbol('?'));
            }
        }
        false
    }

    pub(super) fn take_symbol(&mut self, symbol: char) -> bool {
        let found = self.peek() == Some(&Token::Symbol(symbol));
        self.next += usize::from(found);
        found
    }

    pub(super) fn expect(&mut self, symbol: char, context: &str) -> Result<(), ParseError> {
        if self.take_symbol(symbol) {
            return Ok(());
        }
        self.error(self.offset(), format!("expected `{symbol}` {context}"))
    }
}

/// Returns the tokens, each with its byte offset.
fn split(text: &str) -> Result<Vec<(usize, Token)>, ParseError> {
    let mut tokens = Vec::new();
    let mut depth = 0usize;
    let mut at = 0;
    while let Some(c) = text[at..].chars().next() {
        let start = at;
        at += c.len_utf8();
        let token = match c {
            // Inside parentheses a statement goes on over line ends.
            '\n' if depth > 0 => continue,
            ';' | '\n' => Token::End,
            c if c.is_whitespace() => continue,
            c if c == '#' || text[start..].starts_with("//") => {
                at += text[at..].find('\n').unwrap_or(text.len() - at);
                continue;
            }
            '+' | '-' | '*' | '/' | '^' | ',' | '=' | '<' | '>' | '?' | ':' => Token::Symbol(c),
            '(' => {
                depth += 1;
                Token::Symbol(c)
            }
            ')' => {
                depth = depth.saturating_sub(1);
                Token::Symbol(c)
            }
            '0'..='9' | '.' => {
                let end = start + number_length(&text[start..]);
                at = end + suffix_length(&text[start..end], &text[end..]);
                Token::Number(number(text, start, end)?)
            }
            '$' => {
                at += name_length(&text[at..]);
                if at == start + 1 {
                    return Err(ParseError::at(text, start, "`$` needs a name, as in `$a`"));
                }
                Token::Free(text[start + 1..at].to_owned())
            }
            c if c.is_ascii_alphabetic() || c == '_' => {
                at = start + name_length(&text[start..]);
                Token::Name(text[start..at].to_owned())
            }
            other => {
                return Err(ParseError::at(
                    text,
                    start,
                    format!("`{}` has no meaning in a formula", plain(other)),
                ));
            }
        };
        tokens.push((start, token));
    }
    Ok(tokens)
}

fn name_length(text: &str) -> usize {
    text.bytes().take_while(|b| b.is_ascii_alphanumeric() || *b == b'_').count()
}

fn number_length(text: &str) -> usize {
    let bytes = text.as_bytes();
    let digits = |from: usize| bytes[from..].iter().take_while(|b| b.is_ascii_digit()).count();
    let mut length = digits(0);
    if bytes.get(length) == Some(&b'.') {
        length += 1;
        length += digits(length);
    }
    if matches!(bytes.get(length), Some(b'e' | b'E')) {
        let sign = usize::from(matches!(bytes.get(length + 1), Some(b'+' | b'-')));
        let exponent = digits(length + 1 + sign);
        if exponent > 0 {
            length += 1 + sign + exponent;
        }
    }
    length
}

/// Returns the length of the suffix that some shading languages want: `1.0f`, `1e-3h`. Not after
/// `2`, where a letter may be a column that someone meant to multiply.
fn suffix_length(number: &str, after: &str) -> usize {
    let is_float = number.contains(['.', 'e', 'E']);
    usize::from(is_float && name_length(after) == 1 && after.starts_with(['f', 'F', 'h', 'H']))
}

fn number(text: &str, start: usize, end: usize) -> Result<Number, ParseError> {
    let digits = &text[start..end];
    match (digits.parse::<f32>(), digits.parse()) {
        (Ok(rounded), Ok(exact)) if rounded.is_finite() => Ok(Number { rounded, exact }),
        (Ok(_), _) => Err(ParseError::at(
            text,
            start,
            format!("{digits} is too large for a 32-bit float (at most 3.4e38)"),
        )),
        (Err(_), _) => Err(ParseError::at(text, start, format!("`{digits}` is not a number"))),
    }
}
