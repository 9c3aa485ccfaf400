//! Claims: `energy: f0*scale + bias <= 1 for f0 in 0..1`.

use super::{Names, ParseError, parse};
use crate::op::Op;
use crate::program::{Arg, Program};

/// What is asserted of a formula's outputs, wherever its inputs are in their domain.
#[derive(Clone, Debug, PartialEq)]
pub struct Claim {
    pub name: String,
    /// What is bounded, as text: one side of the comparison, or the difference of both.
    pub expression: String,
    /// The same over inputs, outputs and variables: one output.
    pub program: Program,
    /// What it must not leave; one end is infinite.
    pub range: [f64; 2],
    /// What else it is of, each anything in a range.
    pub variables: Vec<(String, [f32; 2])>,
}

/// What every formula is asked, whatever else is claimed of it.
pub const ALWAYS_ASKED: [&str; 2] = ["finite", "range"];

const LONGEST: usize = 1000;
const MAX_VARIABLES: usize = 4;
const SHAPE: &str = "a claim is `name: expression <= expression`, as in `energy: f0*scale + bias <= 1 for f0 in 0..1`";

impl Claim {
    /// Reads `name: expression <= expression` (or `>=`) over columns, and behind it `for x in 0..1` with a
    /// comma between several where it holds for each value of a variable.
    ///
    /// # Errors
    /// [`ParseError`] says where the text is wrong, and what may stand there.
    pub fn parse(text: &str, names: &Names) -> Result<Claim, ParseError> {
        let wrong = |at: usize, message: String| ParseError::at(text, at, message);
        if let Some(at) = text.find(['\n', ';', '#']).or((text.len() > LONGEST).then_some(0)) {
            return Err(wrong(
                at,
                format!("a claim is one comparison, of {LONGEST} bytes at most"),
            ));
        }
        let colon = text.find(':').ok_or_else(|| wrong(0, SHAPE.into()))?;
        let name = Claim::name_of(text);
        if !is_identifier(name) || ALWAYS_ASKED.contains(&name) {
            let reason =
                format!("`{name}` is no name for a claim: give a word other than finite and range");
            return Err(wrong(0, reason));
        }
        let end = text[colon..].find(" for ").map_or(text.len(), |at| colon + at);
        let variables = variables(text, end, names)?;
        let signs = ["<=", ">=", "≤", "≥"].into_iter();
        let mut signs: Vec<(usize, &str)> =
            signs.flat_map(|sign| text[colon..end].match_indices(sign)).collect();
        signs.sort_unstable();
        let &[(sign, compared)] = signs.as_slice() else {
            let at = signs.get(1).map_or(end, |(at, _)| colon + at);
            return Err(wrong(at, format!("{SHAPE}: one `<=` or `>=`")));
        };
        let sign = colon + sign;
        let mut all = Names { outputs: vec!["_".repeat(name.len())], ..names.clone() };
        all.inputs
            .extend(names.outputs.iter().chain(variables.iter().map(|(name, _)| name)).cloned());
        let sides = [colon + 1..sign, sign + compared.len()..end];
        // Its place in the text is the place in the formula that is read.
        let read = |side: &std::ops::Range<usize>| {
            if text[side.clone()].trim().is_empty() {
                return Err(wrong(side.end, "expected an expression".into()));
            }
            let character = |(at, c): (usize, char)| match at {
                at if at == colon => '=',
                at if at < colon && !c.is_whitespace() => '_',
                at if side.contains(&at) => c,
                _ => ' ',
            };
            let formula: String = text.char_indices().map(character).collect();
            let in_claim = |error| ParseError { source_line: text.to_owned(), ..error };
            parse(&formula, &all).map_err(in_claim)
        };
        let [left, right] = [read(&sides[0])?, read(&sides[1])?];
        let outputs = names.inputs.len()..names.inputs.len() + names.outputs.len();
        if !reads(&left, &outputs) && !reads(&right, &outputs) {
            let outputs = names.outputs.join(", ");
            return Err(wrong(
                colon + 1,
                format!("it says nothing of an output; there is {outputs}"),
            ));
        }
        let [left_text, right_text] = sides.map(|side| text[side].trim());
        let (expression, program, limit, is_least) = match (constant(&left), constant(&right)) {
            (_, Some(limit)) => (left_text.to_owned(), left, limit, compared.contains(['>', '≥'])),
            (Some(limit), _) => {
                (right_text.to_owned(), right, limit, compared.contains(['<', '≤']))
            }
            (None, None) => {
                let difference = format!("{left_text} - ({right_text})");
                (difference, minus(left, &right), 0.0, compared.contains(['>', '≥']))
            }
        };
        if !limit.is_finite() {
            return Err(wrong(sign, "what it is compared with is no number".into()));
        }
        let range = if is_least { [limit, f64::INFINITY] } else { [f64::NEG_INFINITY, limit] };
        Ok(Claim { name: name.to_owned(), expression, program, range, variables })
    }

    /// The name before the colon.
    pub fn name_of(text: &str) -> &str {
        text.split(':').next().unwrap_or_default().trim()
    }

    /// Adds a claim over these columns to others, in place of one of the same name.
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

fn is_identifier(name: &str) -> bool {
    let starts = name.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_');
    starts && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
}

/// What stands behind ` for `: variables and their ranges.
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
                "behind `for` stand variables and their ranges, as in `f0 in 0..1`".into(),
            );
        };
        let columns = names.inputs.iter().chain(&names.outputs);
        if columns.chain(variables.iter().map(|(known, _)| known)).any(|known| *known == name) {
            return wrong(format!("`{name}` is there already; name the variable otherwise"));
        }
        if variables.len() == MAX_VARIABLES {
            return wrong(format!("more than {MAX_VARIABLES} variables"));
        }
        variables.push((name, range));
        at += part.len() + 1;
    }
    Ok(variables)
}

fn reads(program: &Program, inputs: &std::ops::Range<usize>) -> bool {
    let args = program.instrs.iter().flat_map(|instr| instr.args()).chain(&program.outputs);
    args.into_iter().any(|arg| matches!(arg, Arg::Input(i) if inputs.contains(&usize::from(*i))))
}

/// The value of what reads nothing.
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
