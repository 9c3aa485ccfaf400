//! What may be required of formulas, and how it is written.

use crate::op::Op;
use crate::program::{Claim, Hole, Names};
use crate::suggest::did_you_mean;
use serde::{Deserialize, Serialize};

/// A condition on formulas. Those on values are checked on samples; before a formula is shown, a
/// refutation of `Finite` and `Range` is also sought in the whole domain.
#[allow(missing_docs, reason = "the variants' docs name their fields")]
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Requirement {
    /// No output, or not this one, leaves the range.
    Range { output: Option<u16>, low: f32, high: f32 },
    /// All outputs, or this one, never fall, or never rise, as an input grows.
    Monotone { output: Option<u16>, input: u16, rising: bool },
    /// All outputs, or this one, meet the data to 1e-5 of the output's largest magnitude at samples
    /// with the input at either end of its domain.
    Ends { output: Option<u16>, input: u16 },
    /// The formula has this operation.
    Operation(Op),
    /// The formula reads this input.
    Input(u16),
    /// No output is infinite or NaN anywhere in the domain.
    Finite,
    /// In half precision no output has a larger absolute error.
    Half { error: f64 },
    /// No value of a template's hole leaves the range, wherever it is called.
    HoleRange { hole: String, low: f32, high: f32 },
    /// A comparison holds everywhere: the text of a [`Claim`].
    Claim { text: String },
}

impl Requirement {
    /// Parses `finite`, `range=0..1`, `half=1e-2`, `rising=INPUT`, `falling=INPUT`, `ends=INPUT`,
    /// `uses=OPERATION` or `uses=INPUT`; or a comparison as of a [`Claim`], with or without its
    /// name: `scale + bias <= 1`, `energy: f0*scale + bias <= 1 for f0 in 0..1`. A prefix of an
    /// output's name and a dot restricts a range, a direction or ends to that output.
    ///
    /// # Errors
    /// A message that says what is wrong with the text, and what may be written.
    pub fn parse(text: &str, names: &Names) -> Result<Requirement, String> {
        Requirement::parse_of(text, names, &[])
    }

    /// As [`Requirement::parse`]; before the dot of a range may stand the name of one of these
    /// holes, too.
    ///
    /// # Errors
    /// As [`Requirement::parse`].
    pub fn parse_of(text: &str, names: &Names, holes: &[Hole]) -> Result<Requirement, String> {
        if ["<=", ">=", "≤", "≥"].iter().any(|sign| text.contains(sign)) {
            let text = if text.contains(':') { text.to_owned() } else { named_claim(text) };
            let claim = Claim::parse(&text, names);
            return claim.map(|_| Requirement::Claim { text }).map_err(|error| error.to_string());
        }
        let named = text.split_once('.').map(|(name, _)| name.trim_start_matches('$'));
        let hole = holes.iter().find(|hole| Some(hole.name.as_str()) == named);
        if let Some(hole) = hole.filter(|hole| !names.outputs.contains(&hole.name)) {
            let alone = text.split_once('.').map_or("", |(_, condition)| condition);
            return match Requirement::parse(alone, names)? {
                Requirement::Range { low, high, .. } => {
                    Ok(Requirement::HoleRange { hole: hole.name.clone(), low, high })
                }
                _ => Err(format!("`{text}`: of a hole only a range can be required")),
            };
        }
        let wanted = "give finite, range=LOW..HIGH, half=ERROR, rising=INPUT, falling=INPUT, ends=INPUT, uses=NAME or a comparison as `scale + bias <= 1`, an output's name and a dot before it if it is for one output";
        if text == "finite" {
            return Ok(Requirement::Finite);
        }
        let (key, value) = text.split_once('=').ok_or_else(|| format!("`{text}`: {wanted}"))?;
        let (output, key) = match key.split_once('.') {
            Some((output, key)) => (Some(place(output, &names.outputs, "output")?), key),
            None => (None, key),
        };
        let input = || place(value, &names.inputs, "input");
        match key {
            "range" => {
                let ends = value.split_once("..").and_then(|(low, high)| {
                    Some((low.parse().ok()?, high.parse().ok()?)).filter(|(low, high)| low < high)
                });
                let (low, high) =
                    ends.ok_or_else(|| format!("`{text}`: a range is LOW..HIGH, as in 0..1"))?;
                Ok(Requirement::Range { output, low, high })
            }
            "rising" | "falling" => {
                Ok(Requirement::Monotone { output, input: input()?, rising: key == "rising" })
            }
            "half" if output.is_none() => {
                let error = value.parse().ok().filter(|error: &f64| *error > 0.0);
                let error = error
                    .ok_or_else(|| format!("`{text}`: an error is a number above 0, as 1e-2"))?;
                Ok(Requirement::Half { error })
            }
            "ends" => Ok(Requirement::Ends { output, input: input()? }),
            "uses" if output.is_none() => match Op::from_name(value) {
                Some(op) => Ok(Requirement::Operation(op)),
                None => Ok(Requirement::Input(input()?)),
            },
            _ => Err(format!("`{text}`: {wanted}")),
        }
    }
}

impl Requirement {
    /// Returns the text that [`Requirement::parse`] reads as this.
    pub fn text(&self, names: &Names) -> String {
        // A damaged record may name an output or input that does not exist.
        let named = |names: &[String], i: u16| {
            names.get(usize::from(i)).cloned().unwrap_or_else(|| format!("?{i}"))
        };
        let of = |output: Option<u16>| {
            output.map_or_else(String::new, |o| format!("{}.", named(&names.outputs, o)))
        };
        let input = |input: u16| named(&names.inputs, input);
        match *self {
            Requirement::Range { output, low, high } => {
                format!("{}range={low}..{high}", of(output))
            }
            Requirement::Monotone { output, input: along, rising } => {
                let direction = if rising { "rising" } else { "falling" };
                format!("{}{direction}={}", of(output), input(along))
            }
            Requirement::Ends { output, input: along } => {
                format!("{}ends={}", of(output), input(along))
            }
            Requirement::Operation(op) => format!("uses={}", op.name()),
            Requirement::Input(read) => format!("uses={}", input(read)),
            Requirement::HoleRange { ref hole, low, high } => format!("{hole}.range={low}..{high}"),
            Requirement::Claim { ref text } => text.clone(),
            Requirement::Finite => "finite".to_owned(),
            Requirement::Half { error } => format!("half={error}"),
        }
    }
}

/// Gives a comparison a name, of the names in it: `scale_bias_most: scale + bias <= 1`.
fn named_claim(text: &str) -> String {
    let comparison = text.split(" for ").next().unwrap_or(text);
    let words = comparison.split(|c: char| !c.is_ascii_alphanumeric() && c != '_');
    let is_name = |word: &&str| word.starts_with(|c: char| c.is_ascii_alphabetic());
    let mut name: String = words.filter(is_name).map(|word| format!("{word}_")).collect();
    name.push_str(if comparison.contains(['>', '≥']) { "least" } else { "most" });
    format!("{name}: {text}")
}

fn place(name: &str, names: &[String], kind: &str) -> Result<u16, String> {
    names.iter().position(|known| known == name).map(|at| at as u16).ok_or_else(|| {
        let meant = did_you_mean(name, names.iter().map(String::as_str));
        format!("there is no {kind} `{name}`{meant}")
    })
}
