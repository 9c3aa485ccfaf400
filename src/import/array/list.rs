//! Lists of numbers in source files, nested or flat.

use super::Fault;
use super::error::times;
use super::scalar::narrow;
use super::tokens::{Token, Tokens};

/// The most braces within braces.
const DEEPEST: usize = 8;

const AN_ARRAY: &str = "write it as in `float t[2] = { 0.25, 0.5 };`";

/// The numbers of a list.
pub(super) struct Numbers {
    /// The slowest first.
    pub dimensions: Vec<usize>,
    pub values: Vec<f32>,
}

/// Reads one list, its values as they come.
pub(super) struct Reader<'a> {
    pub tokens: Tokens<'a>,
    pub values: Vec<f32>,
}

/// The dimensions of a list's elements; none of a number.
pub(super) type Dimensions = Vec<usize>;

impl<'a> Reader<'a> {
    pub(super) fn new(tokens: Tokens<'a>) -> Reader<'a> {
        Reader { tokens, values: Vec::new() }
    }

    /// Reads a file that is nothing but a list, with or without brackets.
    pub(super) fn all(mut self) -> Result<Numbers, Fault> {
        let nothing = || Fault::new("it holds no array of numbers", AN_ARRAY);
        let dimensions = self.elements(0).map_err(|fault| match self.values.len() {
            0 => nothing(),
            _ => fault,
        })?;
        match self.values.len() {
            0 | 1 => Err(nothing()),
            _ => Ok(Numbers { dimensions, values: self.values }),
        }
    }

    /// Reads elements up to the closing of a list, or the file's end at depth 0.
    pub(super) fn elements(&mut self, depth: usize) -> Result<Dimensions, Fault> {
        let (mut count, mut each): (usize, Option<Dimensions>) = (0, None);
        let mut separated = true;
        let mut last_line = 1;
        loop {
            let Some((line, token)) = self.tokens.next() else {
                return match depth {
                    0 => Ok(joined(count, each)),
                    _ => Err(Fault::at(last_line, "the file ends within a list", "write it again")),
                };
            };
            last_line = line;
            let element = match token {
                Token::Close(_) if depth > 0 => return Ok(joined(count, each)),
                Token::Mark(",") if !separated => {
                    separated = true;
                    continue;
                }
                Token::Mark(";") if depth == 0 => continue,
                _ if !separated => return Err(no_number(line, token)),
                Token::Open(_) if depth == DEEPEST => {
                    let problem = format!("more than {DEEPEST} lists within each other");
                    return Err(Fault::at(line, problem, "write it flat, and say --size"));
                }
                Token::Open(_) => self.elements(depth + 1)?,
                Token::Word(_) => self.constructed(line, token, depth)?,
                _ => self.number(line, token)?,
            };
            separated = false;
            count += 1;
            match &each {
                None => each = Some(element),
                Some(first) if *first == element => {}
                Some(first) => {
                    let size = |of: &Dimensions| if of.is_empty() { "1".into() } else { times(of) };
                    let problem = format!(
                        "an element of {} numbers, where those before have {}",
                        size(&element),
                        size(first)
                    );
                    return Err(Fault::at(line, problem, "make all of one size"));
                }
            }
        }
    }

    /// Reads `float2(0.1, 0.2)` after its first word.
    fn constructed(&mut self, line: usize, word: Token, depth: usize) -> Result<Dimensions, Fault> {
        loop {
            match self.tokens.next() {
                Some((_, Token::Mark("<"))) => {
                    skip_parameters(&mut self.tokens).ok_or_else(|| no_number(line, word))?;
                }
                Some((_, Token::Mark("::" | ".") | Token::Word(_))) => {}
                Some((_, Token::Open('(' | '{'))) if depth < DEEPEST => {
                    let dimensions = self.elements(depth + 1)?;
                    // `half(0.5)` is a number.
                    return Ok(if dimensions == [1] { Vec::new() } else { dimensions });
                }
                _ => return Err(no_number(line, word)),
            }
        }
    }

    /// Reads a number with its sign.
    fn number(&mut self, line: usize, mut token: Token<'a>) -> Result<Dimensions, Fault> {
        let mut sign = 1.0;
        if let Token::Mark(mark @ ("-" | "+")) = token {
            sign = if mark == "-" { -1.0 } else { 1.0 };
            token = self.tokens.next().map_or(token, |(_, token)| token);
        }
        let Token::Number(value) = token else { return Err(no_number(line, token)) };
        let value = narrow(self.values.len(), sign * value);
        let value =
            value.map_err(|fault| Fault::at(line, fault.to_string(), "check the number"))?;
        self.values.push(value);
        Ok(Vec::new())
    }
}

fn joined(count: usize, each: Option<Dimensions>) -> Dimensions {
    [vec![count], each.unwrap_or_default()].concat()
}

fn no_number(line: usize, token: Token) -> Fault {
    let text = match token {
        Token::Number(value) => format!("{value}"),
        Token::NoNumber(text) | Token::Word(text) | Token::Mark(text) => text.to_owned(),
        Token::Quoted(text) => format!("\"{text}\""),
        Token::Open(mark) | Token::Close(mark) => mark.to_string(),
    };
    let text: String = text.chars().take(40).collect();
    let problem = format!("`{}` among an array's numbers", crate::printable::printable(&text));
    Fault::at(line, problem, "write plain numbers separated by commas")
}

/// Skips `<f32, 4>` after its first mark.
pub(super) fn skip_parameters(tokens: &mut Tokens) -> Option<()> {
    let mut depth = 1;
    while depth > 0 {
        match tokens.next()?.1 {
            Token::Mark("<") => depth += 1,
            Token::Mark(">") => depth -= 1,
            Token::Word(_) | Token::Number(_) | Token::Mark("," | "::") => {}
            _ => return None,
        }
    }
    Some(())
}
