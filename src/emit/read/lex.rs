//! Shader text to tokens.

use super::ReadError;

#[derive(Clone, Debug, PartialEq)]
pub(super) enum Token {
    Name(String),
    Number(f32),
    /// A hexadecimal integer.
    Bits(u32),
    Symbol(char),
}

/// The tokens, each with the byte offset at which it starts. `<f32>` and `<float>` say nothing
/// that is not known: they are read as a space.
pub(super) fn tokens(text: &str) -> Result<Vec<(usize, Token)>, ReadError> {
    let mut tokens = Vec::new();
    let mut at = 0;
    while let Some(c) = text[at..].chars().next() {
        let rest = &text[at..];
        let (token, length) = match c {
            c if c.is_whitespace() => (None, c.len_utf8()),
            _ if rest.starts_with("//") => (None, rest.find('\n').unwrap_or(rest.len())),
            _ if rest.starts_with("/*") => (None, rest.find("*/").map_or(rest.len(), |i| i + 2)),
            _ if rest.starts_with("<f32>") => (None, "<f32>".len()),
            _ if rest.starts_with("<float>") => (None, "<float>".len()),
            c if c.is_ascii_alphabetic() || c == '_' => {
                let length = count(rest, |b| b.is_ascii_alphanumeric() || b == b'_');
                (Some(Token::Name(rest[..length].to_owned())), length)
            }
            '0'..='9' | '.' => {
                let length = number_length(rest);
                let token =
                    number(&rest[..length]).map_err(|message| ReadError::at(text, at, message))?;
                (Some(token), length)
            }
            c if c.is_ascii() => (Some(Token::Symbol(c)), 1),
            other => {
                return Err(ReadError::at(text, at, format!("`{other}` has no meaning here")));
            }
        };
        tokens.extend(token.map(|token| (at, token)));
        at += length;
    }
    Ok(tokens)
}

fn count(text: &str, belongs: fn(u8) -> bool) -> usize {
    text.bytes().take_while(|&b| belongs(b)).count()
}

/// Digits, letters and dots, and the sign after an exponent's `e`.
fn number_length(text: &str) -> usize {
    let length = count(text, |b| b.is_ascii_alphanumeric() || b == b'.');
    let is_exponent = text[..length].ends_with(['e', 'E']) && !text.starts_with("0x");
    match text[length..].starts_with(['+', '-']) && is_exponent {
        true => length + 1 + count(&text[length + 1..], |b| b.is_ascii_alphanumeric()),
        false => length,
    }
}

fn number(text: &str) -> Result<Token, String> {
    let wrong = || format!("`{text}` is no number");
    if let Some(digits) = text.strip_prefix("0x").or_else(|| text.strip_prefix("0X")) {
        let digits = digits.trim_end_matches(['u', 'U']);
        return u32::from_str_radix(digits, 16).map(Token::Bits).map_err(|_| wrong());
    }
    let digits = text.strip_suffix(['f', 'F', 'h', 'H']).unwrap_or(text);
    match digits.parse::<f32>() {
        Ok(value) if value.is_finite() => Ok(Token::Number(value)),
        Ok(_) => Err(format!("{digits} is too large for a 32-bit float (at most 3.4e38)")),
        Err(_) => Err(wrong()),
    }
}
