//! Words, numbers and marks of a source file in any language with braces or brackets.

/// A piece of a source file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Token<'a> {
    /// A number without its sign.
    Number(f64),
    /// What begins as a number and is none.
    NoNumber(&'a str),
    /// An identifier or a keyword.
    Word(&'a str),
    /// What stands between quotes.
    Quoted(&'a str),
    /// `{`, `[` or `(`.
    Open(char),
    /// `}`, `]` or `)`.
    Close(char),
    /// Anything else: one character, or two that belong together.
    Mark(&'a str),
}

/// Marks of two characters that are not what their characters are.
const DOUBLE_MARKS: [&str; 8] = ["::", "==", "<=", ">=", "!=", "=>", "->", "+="];

/// The tokens of a text, each with its line, counted from 1. Comments are left out, and so are lines
/// of a preprocessor.
#[derive(Clone)]
pub(super) struct Tokens<'a> {
    rest: &'a str,
    line: usize,
}

impl<'a> Tokens<'a> {
    pub(super) fn new(text: &'a str) -> Tokens<'a> {
        Tokens { rest: text, line: 1 }
    }

    fn take(&mut self, bytes: usize) -> &'a str {
        let (taken, rest) = self.rest.split_at(bytes);
        self.rest = rest;
        self.line += taken.bytes().filter(|&byte| byte == b'\n').count();
        taken
    }

    fn skip_blanks_and_comments(&mut self) {
        loop {
            let blank = self.rest.len() - self.rest.trim_start().len();
            self.take(blank);
            let length = match self.rest {
                rest if rest.starts_with("//") => end_of_line(rest),
                rest if rest.starts_with('#') => end_of_directive(rest),
                rest if rest.starts_with("/*") => {
                    rest[2..].find("*/").map_or(rest.len(), |end| end + 4)
                }
                _ => return,
            };
            self.take(length);
        }
    }

    fn token(&mut self, first: char) -> Token<'a> {
        let rest = self.rest;
        let second = rest[first.len_utf8()..].chars().next().unwrap_or(' ');
        match first {
            '{' | '[' | '(' => {
                self.take(1);
                Token::Open(first)
            }
            '}' | ']' | ')' => {
                self.take(1);
                Token::Close(first)
            }
            '"' | '`' => self.quoted(first),
            '\'' if !is_lifetime(rest) => self.quoted(first),
            _ if first.is_ascii_digit() || (first == '.' && second.is_ascii_digit()) => {
                let text = self.take(end_of_number(rest));
                number(text).map_or(Token::NoNumber(text), Token::Number)
            }
            _ if is_letter(first) => {
                let end = rest.find(|c: char| !is_letter(c) && !c.is_ascii_digit());
                Token::Word(self.take(end.unwrap_or(rest.len())))
            }
            _ if DOUBLE_MARKS.iter().any(|mark| rest.starts_with(mark)) => {
                Token::Mark(self.take(2))
            }
            _ => Token::Mark(self.take(first.len_utf8())),
        }
    }

    /// A text between quotes; one that is not closed ends with its line.
    fn quoted(&mut self, quote: char) -> Token<'a> {
        let mut escaped = false;
        let end = self.rest.char_indices().skip(1).find(|&(_, c)| {
            let is_end = !escaped && c == quote || c == '\n';
            escaped = !escaped && c == '\\';
            is_end
        });
        let end = end.map_or(self.rest.len(), |(end, _)| end);
        let text = &self.take(end)[1..];
        if self.rest.starts_with(quote) {
            self.take(1);
        }
        Token::Quoted(text)
    }
}

impl<'a> Iterator for Tokens<'a> {
    type Item = (usize, Token<'a>);

    fn next(&mut self) -> Option<Self::Item> {
        self.skip_blanks_and_comments();
        let first = self.rest.chars().next()?;
        let line = self.line;
        Some((line, self.token(first)))
    }
}

fn is_letter(c: char) -> bool {
    c.is_alphabetic() || c == '_' || c == '$'
}

fn end_of_line(text: &str) -> usize {
    text.find('\n').unwrap_or(text.len())
}

/// The end of a line that a backslash continues.
fn end_of_directive(text: &str) -> usize {
    let mut end = 0;
    loop {
        let line = end_of_line(&text[end..]);
        let continued = text[end..end + line].trim_end().ends_with('\\');
        end += line;
        if !continued || end == text.len() {
            return end;
        }
        end += 1;
    }
}

/// Whether a quote begins a lifetime of Rust: a word follows, and no quote after it.
fn is_lifetime(text: &str) -> bool {
    let word = &text[1..];
    let end = word.find(|c: char| !is_letter(c) && !c.is_ascii_digit()).unwrap_or(word.len());
    end > 0 && !word[end..].starts_with('\'')
}

fn end_of_number(text: &str) -> usize {
    let is_hex = text.starts_with("0x") || text.starts_with("0X");
    let mut last = ' ';
    let end = text.char_indices().find(|&(at, c)| {
        let exponent = if is_hex { matches!(last, 'p' | 'P') } else { matches!(last, 'e' | 'E') };
        let separator = c == '\'' && text[at + 1..].starts_with(|c: char| c.is_ascii_hexdigit());
        let belongs = c.is_ascii_alphanumeric()
            || matches!(c, '.' | '_')
            || (exponent && matches!(c, '+' | '-'))
            || separator;
        last = c;
        !belongs
    });
    end.map_or(text.len(), |(end, _)| end)
}

/// Suffixes of numbers in C, shading languages and Rust.
const SUFFIXES: [&str; 22] = [
    "f", "h", "l", "lf", "d", "m", "u", "ul", "ull", "lu", "llu", "ll", "z", "uz", "f16", "f32",
    "f64", "i32", "u8", "u16", "u32", "hf",
];

fn number(text: &str) -> Option<f64> {
    let plain: String = text.chars().filter(|c| !matches!(c, '_' | '\'')).collect();
    let plain = plain.to_ascii_lowercase();
    if let Some(digits) = plain.strip_prefix("0x") {
        return hexadecimal(digits);
    }
    let mut end = 0;
    let mut last = ' ';
    for c in plain.chars() {
        let belongs = c.is_ascii_digit()
            || c == '.'
            || (c == 'e' && last != 'e')
            || (last == 'e' && matches!(c, '+' | '-'));
        if !belongs {
            break;
        }
        last = c;
        end += 1;
    }
    let (digits, suffix) = plain.split_at(end);
    let known = suffix.is_empty() || SUFFIXES.contains(&suffix);
    digits.parse().ok().filter(|_| known)
}

/// Parses what follows `0x`: an integer, or digits with an exponent of two.
fn hexadecimal(text: &str) -> Option<f64> {
    let (digits, exponent) = match text.split_once('p') {
        Some((digits, exponent)) => {
            let end = exponent.find(|c: char| c.is_ascii_alphabetic()).unwrap_or(exponent.len());
            let (exponent, suffix) = exponent.split_at(end);
            let known = suffix.is_empty() || SUFFIXES.contains(&suffix);
            (digits, exponent.parse::<i32>().ok().filter(|_| known)?)
        }
        None => {
            let end = text.find(|c: char| !c.is_ascii_hexdigit()).unwrap_or(text.len());
            let (digits, suffix) = text.split_at(end);
            if !suffix.is_empty() && !SUFFIXES.contains(&suffix) {
                return None;
            }
            (digits, 0)
        }
    };
    let (whole, fraction) = digits.split_once('.').unwrap_or((digits, ""));
    if whole.is_empty() && fraction.is_empty() {
        return None;
    }
    let mut value = 0.0;
    for digit in whole.chars().chain(fraction.chars()) {
        value = 16.0 * value + f64::from(digit.to_digit(16)?);
    }
    let power = exponent.saturating_sub(4 * i32::try_from(fraction.len()).ok()?);
    // In two steps, since 2^power alone may be beyond f64 where the product is not.
    let half = power / 2;
    Some(value * f64::from(half).exp2() * f64::from(power - half).exp2())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_many_languages_are_read() {
        for (text, value) in [
            ("1", 1.0),
            ("1.", 1.0),
            (".5", 0.5),
            ("0.25f", 0.25),
            ("1.F", 1.0),
            ("1e-3", 1e-3),
            ("2.5E+2f", 250.0),
            ("0.5_f32", 0.5),
            ("0.5h", 0.5),
            ("1.0lf", 1.0),
            ("1'000.5", 1000.5),
            ("0x3c00", 15360.0),
            ("0xFFu", 255.0),
            ("0x1.8p-3f", 0.1875),
            ("0x1p3", 8.0),
            ("0x.8p0", 0.5),
            ("0x3c00_u16", 15360.0),
        ] {
            let tokens: Vec<_> = Tokens::new(text).collect();
            assert_eq!(tokens, [(1, Token::Number(value))], "{text}");
        }
        for text in ["1x", "1.2.3", "0x", "0xp1", "1e", "0b12q", "0..4", "0x1p"] {
            let tokens: Vec<_> = Tokens::new(text).collect();
            assert!(matches!(tokens[..], [(1, Token::NoNumber(_))]), "{text}: {tokens:?}");
        }
    }

    #[test]
    fn comments_quotes_and_directives_hold_no_numbers() {
        let text = "#define A \\\n 1\n/* 2\n */ a // 3\n\"4 \\\" 5\" '6' &'static b # 7\n= x";
        let words: Vec<_> = Tokens::new(text).collect();
        use Token::{Mark, Quoted, Word};
        assert_eq!(
            words,
            [
                (4, Word("a")),
                (5, Quoted("4 \\\" 5")),
                (5, Quoted("6")),
                (5, Mark("&")),
                (5, Mark("'")),
                (5, Word("static")),
                (5, Word("b")),
                (6, Mark("=")),
                (6, Word("x"))
            ]
        );
    }
}
