//! Claims: `energy: f0*scale + bias <= 1 for f0 in 0..1`.

use super::{Names, ParseError, parse};
use crate::op::Op;
use crate::program::{Arg, Program};
use std::ops::Range;

/// An assertion about a formula's outputs, for all inputs in the domain.
#[derive(Clone, Debug, PartialEq)]
pub struct Claim {
    /// The word by which verdicts name it.
    pub name: String,
    /// The bounded expression, as text: one side of the comparison, or the difference of both.
    pub expression: String,
    /// The same over inputs, outputs and variables, in that order; one output.
    pub program: Program,
    /// The range that its value must not leave; one end is infinite.
    pub range: [f64; 2],
    /// Further variables, each with the range of its values.
    pub variables: Vec<(String, [f32; 2])>,
}

/// The names of the claims that every formula is checked for.
pub const ALWAYS_ASKED: [&str; 2] = ["finite", "range"];

/// The name of the bound on the error against a truth, in verdicts.
const TRUTH: &str = "truth";

/// In bytes. By hand: more than a comparison needs.
const LONGEST: usize = 1000;
/// By hand: proofs subdivide each variable's range.
const MAX_VARIABLES: usize = 4;
const SHAPE: &str = "a claim is `name: expression <= expression`, as in `energy: f0*scale + bias <= 1 for f0 in 0..1`";

impl Claim {
    /// Parses `name: expression <= expression` (or `>=`) over columns, and after it `for x in
    /// 0..1`, with commas between several, where it holds for each value of a variable.
    ///
    /// # Errors
    /// [`ParseError`] says where the text is wrong, and what may stand there.
    pub fn parse(text: &str, names: &Names) -> Result<Claim, ParseError> {
        let wrong = |at: usize, message: String| Err(ParseError::at(text, at, message));
        let colon = check_name(text)?;
        let end = text[colon..].find(" for ").map_or(text.len(), |at| colon + at);
        let variables = variables(text, end, names)?;
        let (sides, is_least) = comparison(text, colon + 1..end)?;
        let assigned = vec!["_".repeat(Claim::name_of(text).len())];
        let mut all = Names { outputs: assigned, ..names.clone() };
        let beside = names.outputs.iter().chain(variables.iter().map(|(name, _)| name));
        all.inputs.extend(beside.cloned());
        let [left, right] =
            [side(text, colon, &sides[0], &all)?, side(text, colon, &sides[1], &all)?];
        let outputs = names.inputs.len()..names.inputs.len() + names.outputs.len();
        if !reads(&left, &outputs) && !reads(&right, &outputs) {
            let outputs = names.outputs.join(", ");
            return wrong(colon + 1, format!("it is about no output; the outputs are {outputs}"));
        }
        let [left_text, right_text] = sides.each_ref().map(|side| text[side.clone()].trim());
        let (expression, program, limit, is_least) = match (constant(&left), constant(&right)) {
            (_, Some(limit)) => (left_text.to_owned(), left, limit, is_least),
            (Some(limit), _) => (right_text.to_owned(), right, limit, !is_least),
            (None, None) => {
                let difference = format!("{left_text} - ({right_text})");
                (difference, minus(left, &right), 0.0, is_least)
            }
        };
        if !limit.is_finite() {
            return wrong(sides[0].end, "the bound is not a finite number".into());
        }
        let name = Claim::name_of(text).to_owned();
        let range = if is_least { [limit, f64::INFINITY] } else { [f64::NEG_INFINITY, limit] };
        Ok(Claim { name, expression, program, range, variables })
    }

    /// Returns the name before the colon.
    pub fn name_of(text: &str) -> &str {
        text.split(':').next().unwrap_or_default().trim()
    }

    /// Adds a claim over these columns, in place of one of the same name.
    ///
    /// # Errors
    /// As [`Claim::parse`].
    pub fn add(claims: &mut Vec<String>, text: &str, names: &Names) -> Result<(), ParseError> {
        let Claim { name, .. } = Claim::parse(text, names)?;
        claims.retain(|other| Claim::name_of(other) != name);
        claims.push(text.trim().to_owned());
        Ok(())
    }
}

/// Checks the name, and returns the place of the colon after it.
fn check_name(text: &str) -> Result<usize, ParseError> {
    let wrong = |at: usize, message: String| Err(ParseError::at(text, at, message));
    if let Some(at) = text.find(['\n', ';', '#']).or((text.len() > LONGEST).then_some(0)) {
        return wrong(at, format!("a claim is one comparison of at most {LONGEST} bytes"));
    }
    let name = Claim::name_of(text);
    match text.find(':') {
        None => wrong(0, SHAPE.into()),
        Some(colon) if is_identifier(name) && !ALWAYS_ASKED.contains(&name) && name != TRUTH => {
            Ok(colon)
        }
        Some(_) => wrong(
            0,
            format!("`{name}` cannot name a claim: give a word other than finite, range and truth"),
        ),
    }
}

/// Splits a comparison into its two sides; true if the left one is the larger.
fn comparison(text: &str, whole: Range<usize>) -> Result<([Range<usize>; 2], bool), ParseError> {
    let signs = [("<=", false), (">=", true), ("≤", false), ("≥", true)].into_iter();
    let mut signs: Vec<(Range<usize>, bool)> = signs
        .flat_map(|(sign, is_least)| {
            let each = text[whole.clone()].match_indices(sign).map(|(at, _)| whole.start + at);
            each.map(move |at| (at..at + sign.len(), is_least))
        })
        .collect();
    signs.sort_unstable_by_key(|(sign, _)| sign.start);
    match signs.as_slice() {
        [(sign, is_least)] => Ok(([whole.start..sign.start, sign.end..whole.end], *is_least)),
        signs => {
            let at = signs.get(1).map_or(whole.end, |(sign, _)| sign.start);
            Err(ParseError::at(text, at, format!("{SHAPE}: one `<=` or `>=`")))
        }
    }
}

/// Parses one side as a formula in which everything stands where it does in the claim.
fn side(
    text: &str,
    colon: usize,
    side: &Range<usize>,
    names: &Names,
) -> Result<Program, ParseError> {
    if text[side.clone()].trim().is_empty() {
        return Err(ParseError::at(text, side.end, "expected an expression"));
    }
    let character = |(at, c): (usize, char)| match at {
        at if at == colon => '=',
        at if at < colon && !c.is_whitespace() => '_',
        at if side.contains(&at) => c,
        _ => ' ',
    };
    let formula: String = text.char_indices().map(character).collect();

    parse(&formula, names).map_err(|error| ParseError { source_line: text.to_owned(), ..error })
}

fn is_identifier(name: &str) -> bool {
    let starts = name.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_');
    starts && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
}

/// Parses the part after ` for `: variables and their ranges.
fn variables(text: &str, end: usize, names: &Names) -> Result<Vec<(String, [f32; 2])>, ParseError> {
    let mut variables: Vec<(String, [f32; 2])> = Vec::new();
    let Some(clause) = text[end..].strip_prefix(" for ") else { return Ok(variables) };
    let mut at = end + " for ".len();
    for part in clause.split(',') {
        let wrong = |message: String| Err(ParseError::at(text, at, message));
        let range = part.split_once(" in ").and_then(|(name, range)| {
            let (low, high) = range.split_once("..")?;
            let [low, high] = [low.trim().parse().ok()?, high.trim().parse().ok()?];
            let is_range = f32::is_finite(low) && high.is_finite() && low < high;
            (is_range && is_identifier(name.trim())).then(|| (name.trim().to_owned(), [low, high]))
        });
        let Some((name, range)) = range else {
            return wrong(
                "expected variables and their ranges after `for`, as in `f0 in 0..1`".into(),
            );
        };
        let columns = names.inputs.iter().chain(&names.outputs);
        if columns.chain(variables.iter().map(|(known, _)| known)).any(|known| *known == name) {
            return wrong(format!("`{name}` is already in use; give the variable another name"));
        }
        if variables.len() == MAX_VARIABLES {
            return wrong(format!("more than {MAX_VARIABLES} variables"));
        }
        variables.push((name, range));
        at += part.len() + 1;
    }
    Ok(variables)
}

fn reads(program: &Program, inputs: &Range<usize>) -> bool {
    let args = program.instrs.iter().flat_map(|instr| instr.args()).chain(&program.outputs);
    args.into_iter().any(|arg| matches!(arg, Arg::Input(i) if inputs.contains(&usize::from(*i))))
}

/// Returns the value of a program that reads no input.
fn constant(program: &Program) -> Option<f64> {
    let value = || program.evaluate(&vec![0.0; program.inputs])[0];
    (!reads(program, &(0..program.inputs))).then(|| value().into())
}

fn minus(left: Program, right: &Program) -> Program {
    let mut draft = left.into_draft();
    let inputs: Vec<Arg> = (0..draft.inputs as u16).map(Arg::Input).collect();
    let right = draft.append(right, &inputs)[0];
    draft.outputs = vec![draft.push(Op::Sub, &[draft.outputs[0], right])];
    Program::verify(draft).expect("two programs over the same inputs")
}
