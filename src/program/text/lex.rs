//! Splits formula text into tokens, and steps through them.

use super::ParseError;
use super::excerpt::plain;

#[derive(Clone, Debug, PartialEq)]
pub(super) enum Token {
    Name(String),
    /// `$name`
    Free(String),
    Number(Number),
    /// One of `+ - * / ^ ( ) , = < > ? :`, or `;` within parentheses
    Symbol(char),
    /// `;` or a new line, outside of parentheses
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

/// A definition's name, parameters, and the index of its body's first token.
pub(super) type Definition = (String, Vec<String>, usize);

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

    /// Goes to the token of this index, and returns the index of the next one until now.
    pub(super) fn go_to(&mut self, index: usize) -> usize {
        std::mem::replace(&mut self.next, index)
    }

    /// Skips the rest of the statement.
    pub(super) fn skip_statement(&mut self) {
        while self.peek().is_some_and(|token| *token != Token::End) {
            self.next += 1;
        }
    }

    /// Returns the name, the parameters and the index of the body of the definition that begins
    /// with the next token, if one does: `name(parameter, …) = body`.
    pub(super) fn definition(&self) -> Option<Definition> {
        self.definition_at(self.next)
    }

    fn definition_at(&self, first: usize) -> Option<Definition> {
        let token = |index: usize| self.all.get(index).map(|(_, token)| token);
        let name_at = |index: usize| match token(index) {
            Some(Token::Name(name)) => Some(name.clone()),
            _ => None,
        };
        let is = |index: usize, symbol: char| token(index) == Some(&Token::Symbol(symbol));
        let name = name_at(first).filter(|_| is(first + 1, '('))?;
        let mut parameters = vec![name_at(first + 2)?];
        let mut at = first + 3;
        while is(at, ',') {
            parameters.push(name_at(at + 1)?);
            at += 2;
        }
        (is(at, ')') && is(at + 1, '=')).then_some((name, parameters, at + 2))
    }

    /// Returns all definitions, each with its byte offset.
    pub(super) fn definitions(&self) -> Vec<(usize, Definition)> {
        let begins = |index: &usize| match index.checked_sub(1) {
            Some(before) => self.all[before].1 == Token::End,
            None => true,
        };
        let starts = (0..self.all.len()).filter(begins);
        starts.filter_map(|at| Some((self.all[at].0, self.definition_at(at)?))).collect()
    }

    /// Returns the token after the call that is the whole of the next expression; none if another
    /// operation follows, or the next expression is no call. The end counts as [`Token::End`].
    pub(super) fn after_call(&self) -> Option<&Token> {
        let is_named = matches!(self.peek(), Some(Token::Name(_) | Token::Free(_)));
        if !is_named || self.peek_second() != Some(&Token::Symbol('(')) {
            return None;
        }
        let mut depth = 0;
        for (at, (_, token)) in self.all.iter().enumerate().skip(self.next) {
            match token {
                Token::Symbol('(') => depth += 1,
                Token::Symbol(')') => depth -= 1,
                _ => continue,
            }
            if depth == 0 {
                let after = self.all.get(at + 1).map_or(&Token::End, |(_, token)| token);
                let ends = matches!(after, Token::End | Token::Symbol(',' | ')'));
                return ends.then_some(after);
            }
        }
        None
    }

    /// Returns, for each argument from here to the closing parenthesis, its name if it is only one.
    pub(super) fn names_of_arguments(&self) -> Vec<Option<String>> {
        let mut names = Vec::new();
        let (mut depth, mut only, mut count) = (0, None, 0);
        for (_, token) in &self.all[self.next..] {
            match token {
                Token::Symbol(',' | ')') if depth == 0 => {
                    names.push(only.take().filter(|_| count == 1));
                    count = 0;
                    if *token == Token::Symbol(')') {
                        break;
                    }
                    continue;
                }
                Token::Symbol('(') => depth += 1,
                Token::Symbol(')') => depth -= 1,
                Token::Name(name) => only = Some(name.clone()),
                _ => {}
            }
            count += 1;
        }
        names
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
            ';' if depth > 0 => Token::Symbol(c),
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
                at += components_length(&text[at..]);
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

/// Returns the length of what names components of a vector, `.xyz`.
fn components_length(text: &str) -> usize {
    let begins = |name: &&str| name.starts_with(|c: char| c.is_ascii_alphabetic());
    text.strip_prefix('.').filter(begins).map_or(0, |name| 1 + name_length(name))
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
