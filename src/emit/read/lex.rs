//! Shader text as tokens and comments.

use super::ReadError;
use crate::emit::Language;
use crate::emit::syntax::{Plain, Readable, Style};
use crate::program::plain;
use std::collections::HashSet;

#[derive(Clone, Debug, PartialEq)]
pub(super) enum Token {
    Name(String),
    Number(Number),
    /// A hexadecimal integer.
    Bits(u32),
    Symbol(char),
}

/// A decimal number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Number {
    /// The written value, as exact as an `f64` can be.
    pub exact: f64,
    pub single: f32,
    pub kind: NumberKind,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum NumberKind {
    Integer,
    /// Without a suffix.
    Plain,
    Single,
    Half,
}

/// A line of a comment, without comment marks.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Comment<'a> {
    pub offset: usize,
    pub text: &'a str,
}

pub(super) struct Lexed<'a> {
    /// Tokens, each with the byte offset where it starts.
    pub tokens: Vec<(usize, Token)>,
    pub comments: Vec<Comment<'a>>,
}

pub(super) fn lex<'a>(
    language: Language,
    readable: &Readable,
    text: &'a str,
) -> Result<Lexed<'a>, ReadError> {
    refuse_other_line_ends(text)?;
    if language != Language::Wgsl {
        refuse_continued_lines(text)?;
    }
    let [line_comment, block_comment] = readable.comments;
    let is_python = readable.style == Style::Python;
    let mut lexed = Lexed { tokens: Vec::new(), comments: Vec::new() };
    let mut defined: Vec<(usize, String)> = Vec::new();
    let mut depth = 0usize;
    let mut at = 0;
    while let Some(c) = text[at..].chars().next() {
        let rest = &text[at..];
        let (token, length) = match c {
            '\n' if is_python && depth == 0 && lexed.ends_a_statement() => {
                (Some(Token::Symbol(';')), 1)
            }
            ' ' | '\t' | '\n' | '\r' => (None, 1),
            _ if rest.starts_with(line_comment) => {
                let length = rest.find('\n').unwrap_or(rest.len());
                let line = rest[line_comment.len()..length].trim();
                lexed.comments.push(Comment { offset: at, text: line });
                (None, length)
            }
            _ if rest.starts_with(block_comment) && !is_python => {
                let length = block_length(language, rest)
                    .ok_or_else(|| ReadError::at(text, at, "a comment without an end"))?;
                lexed.comments.extend(lines_of_block(at, &rest[..length]));
                (None, length)
            }
            _ if starts_a_line(text, at) && line_without_meaning(readable, rest).is_some() => {
                (None, line_without_meaning(readable, rest).unwrap_or(0))
            }
            _ if rest.starts_with("--") || rest.starts_with("++") => {
                let message = format!("`{}` changes a value; put a space between", &rest[..2]);
                return Err(ReadError::at(text, at, message));
            }
            '#' => {
                let (length, name) =
                    directive(language, rest).map_err(|m| ReadError::at(text, at, m))?;
                defined.extend(name.map(|name| (at, name)));
                (None, length)
            }
            _ if namespace(readable, rest).is_some() => {
                let before = namespace(readable, rest).unwrap_or("").len();
                let length =
                    before + count(&rest[before..], |b| b.is_ascii_alphanumeric() || b == b'_');
                (Some(Token::Name(rest[..length].to_owned())), length)
            }
            c if c.is_ascii_alphabetic() || c == '_' => {
                let length = count(rest, |b| b.is_ascii_alphanumeric() || b == b'_');
                (Some(Token::Name(rest[..length].to_owned())), length)
            }
            '.' if rest[1..].starts_with(|c: char| c.is_ascii_alphabetic()) => {
                (Some(Token::Symbol('.')), 1)
            }
            '0'..='9' | '.' => {
                let length = number_length(rest);
                let token = number(language, readable, &rest[..length])
                    .map_err(|message| ReadError::at(text, at, message))?;
                (Some(token), length)
            }
            c if c.is_ascii() => (Some(Token::Symbol(c)), 1),
            other => {
                let other = plain(other);
                return Err(ReadError::at(text, at, format!("`{other}` has no meaning here")));
            }
        };
        match token {
            Some(Token::Symbol('(' | '[')) => depth += 1,
            Some(Token::Symbol(')' | ']')) => depth = depth.saturating_sub(1),
            _ => {}
        }
        lexed.tokens.extend(token.map(|token| (at, token)));
        at += length;
    }
    if is_python && lexed.ends_a_statement() {
        lexed.tokens.push((text.len(), Token::Symbol(';')));
    }
    refuse_uses(text, &lexed, &defined)?;
    refuse_open_conditions(text)?;
    if is_python {
        refuse_indentation(text)?;
    }
    Ok(lexed)
}

impl Lexed<'_> {
    /// Returns true after the last token of a statement.
    fn ends_a_statement(&self) -> bool {
        !matches!(self.tokens.last(), None | Some((_, Token::Symbol(';' | ':' | ','))))
    }
}

fn starts_a_line(text: &str, at: usize) -> bool {
    text[..at].rsplit('\n').next().is_some_and(|before| before.trim().is_empty())
}

/// Returns the length of a line that means nothing for the values, as an `#include` of functions.
fn line_without_meaning(readable: &Readable, text: &str) -> Option<usize> {
    let line = text.lines().next().unwrap_or("");
    let known = |known: &&str| match known.strip_suffix('*') {
        // An import by another name would be another function.
        Some(beginning) => {
            line.starts_with(beginning)
                && line.trim_end().ends_with("} from 'three/tsl';")
                && !line.contains(" as ")
        }
        None => line.split_whitespace().eq(known.split_whitespace()),
    };
    readable.lines.iter().any(known).then_some(line.len())
}

/// Returns the beginning of functions' names that the text starts with.
fn namespace<'a>(readable: &Readable, text: &'a str) -> Option<&'a str> {
    let known = readable.namespaces.iter().find(|namespace| text.starts_with(**namespace))?;
    Some(&text[..known.len()])
}

/// Refuses code in which a word stands that the preprocessor takes away.
fn refuse_uses(text: &str, lexed: &Lexed, defined: &[(usize, String)]) -> Result<(), ReadError> {
    let names: HashSet<&str> = lexed
        .tokens
        .iter()
        .filter_map(|(_, token)| match token {
            Token::Name(name) => Some(name.as_str()),
            _ => None,
        })
        .collect();
    match defined.iter().find(|(_, name)| names.contains(name.as_str())) {
        Some((at, name)) => {
            let message = format!("`{name}` stands in the code, too, which would be taken away");
            Err(ReadError::at(text, *at, message))
        }
        None => Ok(()),
    }
}

/// Refuses `#ifndef` without its `#endif`.
fn refuse_open_conditions(text: &str) -> Result<(), ReadError> {
    let count =
        |word: &str| text.lines().filter(|line| line.trim_start().starts_with(word)).count();
    match count("#ifndef") == count("#endif") {
        true => Ok(()),
        false => {
            let at = text.find("#ifndef").or(text.find("#endif")).unwrap_or(0);
            Err(ReadError::at(text, at, "not as many `#endif` as `#ifndef`"))
        }
    }
}

/// Refuses Python whose lines are not indented alike within a function, or are outside.
fn refuse_indentation(text: &str) -> Result<(), ReadError> {
    let (mut at, mut body, mut depth): (usize, Option<&str>, i32) = (0, None, 0);
    let mut in_function = false;
    for line in text.split_inclusive('\n') {
        let code = line.split('#').next().unwrap_or("").trim_end();
        let blank = &line[..line.len() - line.trim_start().len()];
        let is_statement = !code.trim().is_empty() && depth == 0;
        if is_statement && in_function {
            let first = *body.get_or_insert(blank);
            if blank != first || blank.is_empty() || blank.contains('\t') {
                let message = "a line of the function that is not indented as its first, by blanks";
                return Err(ReadError::at(text, at, message));
            }
        } else if is_statement && !blank.is_empty() {
            return Err(ReadError::at(text, at, "an indented line outside of a function"));
        }
        depth += code.matches(['(', '[']).count() as i32 - code.matches([')', ']']).count() as i32;
        in_function |= is_statement && code.starts_with("def ");
        at += line.len();
    }
    Ok(())
}

/// Refuses line ends that not all compilers take for one: comments would end differently.
fn refuse_other_line_ends(text: &str) -> Result<(), ReadError> {
    let mut characters = text.char_indices().peekable();
    while let Some((at, c)) = characters.next() {
        let next = characters.peek().map(|(_, c)| *c);
        let fine = match c {
            '\n' | '\t' => true,
            '\r' => next == Some('\n'),
            c => !c.is_control() && c != '\u{2028}' && c != '\u{2029}',
        };
        if !fine {
            let message = format!(
                "U+{:04X}, which ends a line for some compilers and not for others; take it out",
                u32::from(c)
            );
            return Err(ReadError::at(text, at, message));
        }
    }
    Ok(())
}

/// Refuses backslashes at a line's end, which continue the line, comments too.
fn refuse_continued_lines(text: &str) -> Result<(), ReadError> {
    let mut start = 0;
    for line in text.split_inclusive('\n') {
        let shown = line.trim_end();
        if line.ends_with('\n') && (shown.ends_with('\\') || shown.ends_with("??/")) {
            let message = "a backslash at the end of a line, which makes the next line a part of this one, \
                 of a comment, too; take it out";
            return Err(ReadError::at(text, start + shown.len() - 1, message));
        }
        start += line.len();
    }
    Ok(())
}

/// Returns the length of a block comment; those of WGSL and Rust nest.
fn block_length(language: Language, text: &str) -> Option<usize> {
    let nests = matches!(language, Language::Wgsl | Language::Rust);
    let (mut depth, mut at) = (0usize, 0);
    loop {
        let close = at + text[at..].find("*/")?;
        let open = text[at..].find("/*").map(|i| at + i).filter(|&open| open < close);
        match open {
            Some(open) if depth == 0 || nests => {
                depth += 1;
                at = open + 2;
            }
            _ => {
                depth -= 1;
                at = close + 2;
                if depth == 0 {
                    return Some(at);
                }
            }
        }
    }
}

fn lines_of_block(offset: usize, block: &str) -> impl Iterator<Item = Comment<'_>> {
    let inner = &block[2..block.len() - 2];
    let mut start = offset + 2;
    inner.split_inclusive('\n').map(move |line| {
        let comment = Comment { offset: start, text: line.trim().trim_start_matches('*').trim() };
        start += line.len();
        comment
    })
}

/// Returns the length of a line that keeps a file from being included twice, and the name that it
/// defines.
fn directive(language: Language, text: &str) -> Result<(usize, Option<String>), String> {
    let line = text.lines().next().unwrap_or("");
    let words: Vec<&str> =
        line.split_once("//").map_or(line, |(code, _)| code).split_whitespace().collect();
    let is_name = |name: &str| {
        count(name, |b| b.is_ascii_alphanumeric() || b == b'_') == name.len()
            && name.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
    };
    match words.as_slice() {
        ["#pragma", "once"] | ["#endif"] => Ok((line.len(), None)),
        ["#ifndef" | "#define", name] if is_name(name) => {
            Ok((line.len(), Some((*name).to_owned())))
        }
        ["#define_import_path", _] if language == Language::Wgsl => Ok((line.len(), None)),
        _ => Err("a line of the preprocessor, which may change what any other means; \
             verify what it leaves instead"
            .to_owned()),
    }
}

fn count(text: &str, belongs: fn(u8) -> bool) -> usize {
    text.bytes().take_while(|&b| belongs(b)).count()
}

/// Returns the length of a number: digits, letters and dots, and the sign after an exponent's `e`.
fn number_length(text: &str) -> usize {
    let length = count(text, |b| b.is_ascii_alphanumeric() || b == b'.');
    let is_exponent = text[..length].ends_with(['e', 'E']) && !text.starts_with("0x");
    match text[length..].starts_with(['+', '-']) && is_exponent {
        true => length + 1 + count(&text[length + 1..], |b| b.is_ascii_alphanumeric()),
        false => length,
    }
}

fn number(language: Language, readable: &Readable, text: &str) -> Result<Token, String> {
    let wrong = || format!("`{text}` is no number");
    if let Some(digits) = text.strip_prefix("0x").or_else(|| text.strip_prefix("0X")) {
        let digits = digits.trim_end_matches(['u', 'U']);
        return u32::from_str_radix(digits, 16).map(Token::Bits).map_err(|_| wrong());
    }
    let (digits, kind) = without_suffix(readable, text);
    let kind = match (kind, digits.bytes().all(|b| b.is_ascii_digit())) {
        (NumberKind::Plain, _) if readable.plain == Plain::Double => {
            let point = if digits.contains(['.', 'e', 'E']) { "" } else { ".0" };
            return Err(format!("`{text}` is no float; write `{digits}{point}f`"));
        }
        (NumberKind::Plain, true) if readable.plain == Plain::Number => NumberKind::Plain,
        (NumberKind::Plain, true) => NumberKind::Integer,
        (_, true) if language != Language::Wgsl => {
            return Err(format!("`{text}` is a suffix on an integer; write `{digits}.0`"));
        }
        (kind, _) => kind,
    };
    if digits.ends_with(|c: char| c.is_ascii_alphabetic()) {
        let integer = digits.trim_end_matches(|c: char| c.is_ascii_alphabetic());
        return Err(match integer.parse::<f64>() {
            Ok(_) => format!("`{text}` is no number of single or half precision in {language}"),
            Err(_) => wrong(),
        });
    }
    let single = digits.parse::<f32>().map_err(|_| wrong())?;
    if !single.is_finite() {
        return Err(format!("{digits} is too large for a 32-bit float (at most 3.4e38)"));
    }
    let exact: f64 = digits.parse().map_err(|_| wrong())?;
    let is_whole = digits.bytes().all(|b| b.is_ascii_digit());
    if is_whole && digits.len() > 1 && digits.starts_with('0') {
        return Err(format!("`{text}` is octal to some compilers; write a float"));
    }
    if kind == NumberKind::Integer && exact > f64::from(i32::MAX) {
        return Err(format!("`{text}` is too large for an integer; write `{text}.0`"));
    }
    Ok(Token::Number(Number { exact, single, kind }))
}

/// Splits a number into its digits and the kind that its suffix says.
fn without_suffix<'a>(readable: &Readable, text: &'a str) -> (&'a str, NumberKind) {
    let found = readable.suffixes.iter().find_map(|(suffix, half)| {
        let kind = if *half { NumberKind::Half } else { NumberKind::Single };
        Some((text.strip_suffix(suffix)?, kind))
    });
    found.unwrap_or((text, NumberKind::Plain))
}
