//! LaTeX as it is emitted: an `align*` with an equation a line, under a comment that names the
//! columns. It becomes formula text, which is then read as such.

use super::lex::Comment;
use super::{Contract, Precision, Read, ReadBack, ReadError};
use crate::emit::Language;
use crate::emit::latex::{self, COLUMNS};
use crate::emit::signature::returned_names;
use crate::program::{Names, effective, parse};
use std::collections::HashMap;

/// Reads the equations of a text.
pub(super) fn read(text: &str) -> Read<ReadBack> {
    let failed = |at: usize, message: &str| Err(ReadError::at(text, at, message));
    let mut comments = Vec::new();
    let mut equations = Vec::new();
    let mut at = 0;
    for line in text.split_inclusive('\n') {
        let (start, code) = (at, line.trim());
        at += line.len();
        match code.strip_prefix('%') {
            Some(comment) => comments.push(Comment { offset: start, text: comment.trim() }),
            None if code.is_empty() || code == r"\begin{align*}" || code == r"\end{align*}" => {}
            None => equations.push((start, code.strip_suffix(r"\\").unwrap_or(code).trim())),
        }
    }
    let Some(names) = comments.iter().find_map(|comment| names_of_head(comment.text)) else {
        return failed(0, "no comment says what is computed of what, as `% columns: x, y -> a, b`");
    };
    let mut reader = Equations { text, names: HashMap::new(), rest: "", start: 0, depth: 0 };
    // Columns may be called as no formula can call them.
    let numbered = |letter: char, names: &[String]| -> Vec<String> {
        (0..names.len()).map(|i| format!("{letter}{i}")).collect()
    };
    let plain =
        Names { inputs: numbered('x', &names.inputs), outputs: numbered('y', &names.outputs) };
    for (name, plain) in names.inputs.iter().zip(&plain.inputs) {
        reader.names.insert(latex::written(name), plain.clone());
    }
    let mut formula = String::new();
    for (start, equation) in equations {
        let Some((left, right)) = equation.split_once("&=") else {
            return failed(start, "expected an equation, `y &= x`");
        };
        let left = left.trim();
        let output = names.outputs.iter().position(|name| latex::written(name) == left);
        let name = match output {
            Some(output) => plain.outputs[output].clone(),
            None => format!("t{}", reader.names.len()),
        };
        reader.rest = right.trim();
        reader.start = start + equation.len() + 1;
        let value = reader.sum()?;
        if !reader.rest.is_empty() {
            return reader.failed("expected the end of the equation");
        }
        formula += &format!("{name} = {value}\n");
        reader.names.insert(left.to_owned(), name);
    }
    let program = parse(&formula, &plain)
        .map_err(|error| ReadError::at(text, 0, format!("its formula cannot be read: {error}")))?;
    let program = effective(&program);
    let precisions = vec![Precision::Single; program.instrs.len()];
    let contract = Contract::of(text, &comments);
    let mut names = names;
    let written = names.clone();
    contract.restore(&mut names);
    let (variant, literal, language) = (None, None, Language::Latex);
    Ok(ReadBack {
        language,
        places: returned_names(names.outputs.len()),
        parameters: written.inputs.clone(),
        program,
        names,
        written,
        precisions,
        in_half: false,
        variant,
        literal,
        contract,
    })
}

/// Reads `columns: x, y -> a, b`.
fn names_of_head(comment: &str) -> Option<Names> {
    let (inputs, outputs) = comment.strip_prefix(COLUMNS)?.split_once("->")?;
    let list = |text: &str| -> Vec<String> {
        text.split(',').map(|name| name.trim().to_owned()).filter(|name| !name.is_empty()).collect()
    };
    Some(Names { inputs: list(inputs), outputs: list(outputs) })
}

/// What is left of an equation's right side, which becomes formula text from left to right.
struct Equations<'a> {
    text: &'a str,
    /// Names by the way that they are typeset.
    names: HashMap<String, String>,
    rest: &'a str,
    /// The offset of the equation's end.
    start: usize,
    depth: usize,
}

/// Deeper nesting is refused, before the recursion can exhaust the stack.
const MAX_DEPTH: usize = 200;

/// Functions, each with its name in formula text.
const FUNCTIONS: [(&str, &str); 17] = [
    (r"\min", "min"),
    (r"\max", "max"),
    (r"\operatorname{sat}", "saturate"),
    (r"\operatorname{atan2}", "atan2"),
    (r"\operatorname{lerp}", "lerp"),
    (r"\operatorname{step}", "step"),
    (r"\operatorname{fract}", "fract"),
    (r"\operatorname{sgn}", "sign"),
    (r"\log_2", "log2"),
    (r"\ln", "log"),
    (r"\sin", "sin"),
    (r"\cos", "cos"),
    (r"\tanh", "tanh"),
    (r"\tan", "tan"),
    (r"\arcsin", "asin"),
    (r"\arccos", "acos"),
    (r"\arctan", "atan"),
];

impl<'a> Equations<'a> {
    fn failed<T>(&self, message: &str) -> Read<T> {
        let at = self.start.saturating_sub(self.rest.len() + 1).min(self.text.len());
        let at = (0..=at).rev().find(|&at| self.text.is_char_boundary(at)).unwrap_or(0);
        Err(ReadError::at(self.text, at, message))
    }

    fn take(&mut self, beginning: &str) -> bool {
        match self.rest.strip_prefix(beginning) {
            Some(rest) => {
                self.rest = rest.trim_start();
                true
            }
            None => false,
        }
    }

    fn expect(&mut self, beginning: &str) -> Read<()> {
        if self.take(beginning) {
            return Ok(());
        }
        self.failed(&format!("expected `{beginning}`"))
    }

    fn sum(&mut self) -> Read<String> {
        if self.depth == MAX_DEPTH {
            return self.failed(&format!("nested more than {MAX_DEPTH} deep"));
        }
        self.depth += 1;
        let mut value = self.product()?;
        loop {
            if self.take("+") {
                value = format!("{value} + {}", self.product()?);
            } else if self.take("-") {
                value = format!("{value} - {}", self.product()?);
            } else {
                self.depth -= 1;
                return Ok(value);
            }
        }
    }

    fn product(&mut self) -> Read<String> {
        let mut value = self.negation()?;
        while self.take(r"\,") || self.take(r"\cdot ") {
            value = format!("{value}*{}", self.negation()?);
        }
        Ok(value)
    }

    fn negation(&mut self) -> Read<String> {
        let mut negative = false;
        while self.take("-") {
            negative = !negative;
        }
        let value = self.power()?;
        Ok(if negative { format!("(-{value})") } else { value })
    }

    fn power(&mut self) -> Read<String> {
        let base = self.atom()?;
        if !self.take("^{") {
            return Ok(base);
        }
        let exponent = self.sum()?;
        self.expect("}")?;
        Ok(match (base.as_str(), exponent.parse::<usize>()) {
            ("2", _) => format!("exp2({exponent})"),
            ("e", _) => format!("exp({exponent})"),
            (_, Ok(n @ (2..=6 | 8))) => format!("({base})^{n}"),
            (_, Ok(n @ 7..=64)) => format!("({})", vec![base; n].join("*")),
            _ => format!("pow({base}, {exponent})"),
        })
    }

    fn atom(&mut self) -> Read<String> {
        let known =
            self.names.iter().filter(|(typeset, _)| self.rest.starts_with(typeset.as_str()));
        if let Some((typeset, name)) = known.max_by_key(|(typeset, _)| typeset.len()) {
            let name = name.clone();
            self.rest = self.rest[typeset.len()..].trim_start();
            return Ok(name);
        }
        if let Some((typeset, name)) =
            FUNCTIONS.into_iter().find(|(typeset, _)| self.rest.starts_with(typeset))
        {
            self.take(typeset);
            self.expect(r"\left(")?;
            return Ok(format!("{name}({})", self.arguments()?));
        }
        if self.take(r"\left(") {
            let value = self.sum()?;
            self.expect(r"\right)")?;
            return Ok(format!("({value})"));
        }
        if self.take(r"\left|") {
            let value = self.sum()?;
            self.expect(r"\right|")?;
            return Ok(format!("abs({value})"));
        }
        if self.take(r"\left\lfloor") {
            let value = self.sum()?;
            self.expect(r"\right\rfloor")?;
            return Ok(format!("floor({value})"));
        }
        if self.is_reciprocal_root() && self.take(r"\frac{1}{\sqrt{") {
            let value = self.sum()?;
            self.expect("}}")?;
            return Ok(format!("rsqrt({value})"));
        }
        if self.take(r"\frac{") {
            let above = self.sum()?;
            self.expect("}{")?;
            let below = self.sum()?;
            self.expect("}")?;
            return Ok(format!("(({above})/({below}))"));
        }
        if self.take(r"\sqrt{") {
            let value = self.sum()?;
            self.expect("}")?;
            return Ok(format!("sqrt({value})"));
        }
        if self.take(r"\begin{cases}") {
            return self.cases();
        }
        if self.take(r"\infty") {
            return Ok("(1/0)".to_owned());
        }
        if self.take(r"\mathrm{NaN}") {
            return Ok("(0/0)".to_owned());
        }
        if self.take("e") {
            return Ok("e".to_owned());
        }
        self.number()
    }

    /// Returns true if a root is all that 1 is divided by.
    fn is_reciprocal_root(&self) -> bool {
        let Some(root) = self.rest.strip_prefix(r"\frac{1}{\sqrt{") else { return false };
        let mut depth = 1usize;
        for (at, c) in root.char_indices() {
            match c {
                '{' => depth += 1,
                '}' => depth -= 1,
                _ => {}
            }
            if depth == 0 {
                return root[at + 1..].trim_start().starts_with('}');
            }
        }
        false
    }

    fn arguments(&mut self) -> Read<String> {
        let mut arguments = vec![self.sum()?];
        while self.take(",") {
            arguments.push(self.sum()?);
        }
        self.expect(r"\right)")?;
        Ok(arguments.join(", "))
    }

    /// Reads `c & a < b \\ d & \text{otherwise} \end{cases}`.
    fn cases(&mut self) -> Read<String> {
        let first = self.sum()?;
        self.expect("&")?;
        let left = self.sum()?;
        self.expect("<")?;
        let right = self.sum()?;
        self.expect(r"\\")?;
        let second = self.sum()?;
        self.expect(r"& \text{otherwise}")?;
        self.expect(r"\end{cases}")?;
        Ok(format!("select({left} < {right}, {first}, {second})"))
    }

    fn number(&mut self) -> Read<String> {
        let length = self.rest.find(|c: char| !c.is_ascii_digit() && c != '.');
        let (digits, rest) = self.rest.split_at(length.unwrap_or(self.rest.len()));
        if digits.is_empty() {
            return self.failed("expected a value");
        }
        self.rest = rest;
        let mut number = digits.to_owned();
        if self.take(r"\mathrm{e}{") {
            let Some((exponent, rest)) = self.rest.split_once('}') else {
                return self.failed("expected `}` after an exponent");
            };
            self.rest = rest;
            number += &format!("e{exponent}");
        }
        self.rest = self.rest.trim_start();
        Ok(number)
    }
}
