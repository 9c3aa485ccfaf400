//! Splits formula text into tokens.

use super::ParseError;
use super::excerpt::plain;

#[derive(Clone, Debug, PartialEq)]
pub(super) enum Token {
    Name(String),
    /// `$name`
    Free(String),
    Number(f32),
    /// One of `+ - * / ^ ( ) , = < >`
    Symbol(char),
    /// `;` or a new line
    End,
}

/// Returns the tokens, each with its byte offset.
pub(super) fn tokens(text: &str) -> Result<Vec<(usize, Token)>, ParseError> {
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
            '#' => {
                at += text[at..].find('\n').unwrap_or(text.len() - at);
                continue;
            }
            '+' | '-' | '*' | '/' | '^' | ',' | '=' | '<' | '>' => Token::Symbol(c),
            '(' => {
                depth += 1;
                Token::Symbol(c)
            }
            ')' => {
                depth = depth.saturating_sub(1);
                Token::Symbol(c)
            }
            '0'..='9' | '.' => {
                at = start + number_length(&text[start..]);
                Token::Number(number(text, start, at)?)
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

fn number(text: &str, start: usize, end: usize) -> Result<f32, ParseError> {
    let digits = &text[start..end];
    match digits.parse::<f32>() {
        Ok(value) if value.is_finite() => Ok(value),
        Ok(_) => Err(ParseError::at(
            text,
            start,
            format!("{digits} is too large for a 32-bit float (at most 3.4e38)"),
        )),
        Err(_) => Err(ParseError::at(text, start, format!("`{digits}` is not a number"))),
    }
}
