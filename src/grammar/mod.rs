//! Grammars: the operations that a search may write and how often it tries each, lengths,
//! penalties.
//!
//! ```
//! use lgp::grammar::Grammar;
//! use lgp::op::Op;
//!
//! let mine = "(operations: {\"add\": 1, \"mul\": 2}, max_instructions: 8)";
//! assert!(Grammar::parse("mine.ron", mine)?.has(Op::Mul));
//! assert!(!Grammar::find("polynomial")?.has(Op::Sqrt));
//! # Ok::<(), lgp::grammar::FileError>(())
//! ```

pub(crate) mod file;

pub use file::FileError;

use crate::op::Op;
use crate::program::{Arg, Draft};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

const KIND: &str = "grammar";

/// The grammars that come with the program, by name: the files of `grammar`.
const BUILT_IN: &[(&str, &str)] = include!(concat!(env!("OUT_DIR"), "/grammars.rs"));

/// The most instructions that a grammar may allow. By hand.
pub const MAX_INSTRUCTIONS: usize = 128;

/// The programs that a search may write. Serialised as its name and its file's content, and read
/// back by the same rules.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(into = "(String, File)", try_from = "(String, File)")]
pub struct Grammar {
    /// The built-in name, or the file's path.
    pub name: String,
    /// A sentence about it; may be empty.
    pub description: String,
    /// The operations, each with how often it is tried relative to the others; not empty, all
    /// positive.
    pub operations: Vec<(Op, f64)>,
    /// From 1 to [`MAX_INSTRUCTIONS`].
    pub max_instructions: usize,
    /// Cycles that an operation is charged beyond its cost, to discourage it.
    pub penalties: Vec<(Op, f64)>,
    /// The deepest nesting of an operation inside itself.
    pub nesting: Vec<(Op, usize)>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    #[serde(default)]
    description: String,
    operations: BTreeMap<String, f64>,
    max_instructions: usize,
    #[serde(default)]
    penalties: BTreeMap<String, f64>,
    #[serde(default)]
    nesting: BTreeMap<String, usize>,
}

impl Grammar {
    /// Returns the built-in grammars' names.
    pub fn built_in() -> impl Iterator<Item = &'static str> {
        BUILT_IN.iter().map(|(name, _)| *name)
    }

    /// Returns a built-in grammar by name, or reads one from a `.ron` file.
    ///
    /// # Errors
    /// An unknown name; a file that cannot be read or is not a grammar.
    pub fn find(name_or_path: &str) -> Result<Grammar, FileError> {
        Grammar::parse(name_or_path, &file::find(KIND, name_or_path, BUILT_IN)?)
    }

    /// Returns a built-in grammar by name, without opening a file.
    ///
    /// # Errors
    /// A name that is not built in.
    pub fn find_built_in(name: &str) -> Result<Grammar, FileError> {
        match BUILT_IN.iter().find(|(known, _)| *known == name) {
            Some((_, text)) => Grammar::parse(name, text),
            None => Err(FileError::Content {
                kind: KIND,
                path: name.to_owned(),
                reason: "the run's record has only its name, and it is not built in".into(),
            }),
        }
    }

    /// Parses the text of a `.ron` file called `name`.
    ///
    /// # Errors
    /// A text that is not a grammar.
    pub fn parse(name: &str, text: &str) -> Result<Grammar, FileError> {
        Grammar::of(name, file::parse(KIND, name, text)?)
    }

    fn of(name: &str, file: File) -> Result<Grammar, FileError> {
        let refuse =
            |reason: String| FileError::Content { kind: KIND, path: name.to_owned(), reason };
        if file.operations.is_empty() {
            return Err(refuse(
                "`operations` is empty; name at least one, as in \"add\": 1".into(),
            ));
        }
        if !(1..=MAX_INSTRUCTIONS).contains(&file.max_instructions) {
            return Err(refuse(format!("`max_instructions` must be 1 to {MAX_INSTRUCTIONS}")));
        }
        let nesting: Result<Vec<(Op, usize)>, String> =
            file.nesting.iter().map(|(name, &most)| Ok((file::operation(name)?, most))).collect();
        let positive = |value: f64| value > 0.0 && value.is_finite();
        Ok(Grammar {
            name: name.to_owned(),
            description: file.description,
            operations: named_operations(file.operations, positive).map_err(refuse)?,
            max_instructions: file.max_instructions,
            penalties: named_operations(file.penalties, |value| value >= 0.0).map_err(refuse)?,
            nesting: nesting.map_err(refuse)?,
        })
    }

    /// Checks the rules that its file would have to keep.
    ///
    /// # Errors
    /// The first broken rule.
    pub fn check(&self) -> Result<(), FileError> {
        Grammar::try_from(<(String, File)>::from(self.clone())).map(|_| ())
    }

    /// Returns true if formulas may be written with the operation.
    pub fn has(&self, wanted: Op) -> bool {
        self.operations.iter().any(|(op, _)| *op == wanted)
    }

    /// Returns a hash of what is allowed, whatever the name.
    pub fn fingerprint(&self) -> String {
        let (_, file) = self.clone().into();
        file::fingerprint(&File { description: String::new(), ..file })
    }

    /// Returns true if no operation is nested inside itself more deeply than allowed: `exp2(a +
    /// exp2(b))` nests two `exp2`.
    pub fn allows_nesting(&self, draft: &Draft) -> bool {
        self.nesting.iter().all(|&(op, most)| {
            let mut depths: Vec<usize> = Vec::with_capacity(draft.instrs.len());
            draft.instrs.iter().all(|instr| {
                let depth = |arg: &Arg| match arg {
                    Arg::Result(i) => depths[usize::from(*i)],
                    _ => 0,
                };
                let inside = instr.args().iter().map(depth).max().unwrap_or(0);
                depths.push(inside + usize::from(instr.op() == op));
                depths[depths.len() - 1] <= most
            })
        })
    }

    /// Returns the cycles that the program's operations are charged beyond their cost.
    pub fn penalty(&self, draft: &Draft) -> f64 {
        let of = |op| self.penalties.iter().find(|(known, _)| *known == op).map_or(0.0, |p| p.1);
        draft.instrs.iter().map(|instr| of(instr.op())).sum()
    }
}

impl From<Grammar> for (String, File) {
    fn from(grammar: Grammar) -> (String, File) {
        let named = |values: &[(Op, f64)]| {
            values.iter().map(|(op, value)| (op.name().to_owned(), *value)).collect()
        };
        let nesting = grammar.nesting.iter().map(|(op, most)| (op.name().to_owned(), *most));
        let file = File {
            operations: named(&grammar.operations),
            max_instructions: grammar.max_instructions,
            penalties: named(&grammar.penalties),
            nesting: nesting.collect(),
            description: grammar.description,
        };
        (grammar.name, file)
    }
}

impl TryFrom<(String, File)> for Grammar {
    type Error = FileError;

    fn try_from((name, file): (String, File)) -> Result<Grammar, FileError> {
        Grammar::of(&name, file)
    }
}

/// Converts names to operations, in table order.
fn named_operations(
    values: BTreeMap<String, f64>,
    valid: impl Fn(f64) -> bool,
) -> Result<Vec<(Op, f64)>, String> {
    let mut operations = Vec::new();
    for (name, value) in values {
        let op = file::operation(&name)?;
        if !valid(value) {
            return Err(format!("\"{name}\": {value} must be a positive number"));
        }
        operations.push((op, value));
    }
    operations.sort_by_key(|(op, _)| *op);
    Ok(operations)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::program::{Names, parse};

    #[test]
    fn nesting_counts_operations_inside_their_like() {
        let text = "(operations: {\"exp2\": 1}, max_instructions: 8, nesting: {\"exp2\": 1})";
        let grammar = Grammar::parse("nested.ron", text).unwrap();
        let names = Names::new(["x"], ["y"]);
        let allowed = |text| grammar.allows_nesting(&parse(text, &names).unwrap());
        assert!(allowed("y = exp2(x) + exp2(2*x)"));
        assert!(allowed("t = exp2(x); y = t*t"));
        assert!(!allowed("y = exp2(x + exp2(x))"));
        assert!(
            Grammar::parse("n.ron", &text.replace("nesting: {\"exp2\"", "nesting: {\"ex2\""))
                .is_err()
        );
    }
}
