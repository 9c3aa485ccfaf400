//! A chip's profile, from a `.ron` file: the costs of its instructions, and what its compiler
//! merges.

use super::form::Lowered;
use crate::grammar::{FileError, file};
use crate::op::Op;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

pub(super) const KIND: &str = "GPU profile";

/// The most pipes of a chip. By hand: the built-in chips have fewer.
pub(super) const PIPES: usize = 4;

/// The slots taken on each pipe.
pub(super) type Slots = [f64; PIPES];

/// The costs of one chip's operations.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Chip {
    pub name: String,
    pub description: String,
    /// The pipes' names; they work in parallel.
    pub pipes: Vec<String>,
    pub merges: Merges,
    /// The cost of each operation.
    costs: Vec<Timing>,
    /// The cost of a minimum of three.
    three: Timing,
    /// The slots of a constant that is not part of an instruction.
    pub literal: Option<Slots>,
    /// The file that all this was read from.
    pub file: File,
}

/// The slots, and the cycles until the result can be read.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Timing {
    pub slots: Slots,
    pub latency: f64,
}

/// The merges of a compiler, besides products with sums, signs of arguments, and square roots with
/// their inverse.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Merges {
    /// The instruction that is a minimum or maximum of three, or a clamp between constants.
    pub min3: Option<String>,
    /// True if a factor of 2, 4 or ½ on an arithmetic result is free.
    pub scaled_results: bool,
    /// True if the product of a quotient merges with a sum.
    pub quotients: bool,
    /// The operations whose results saturate for nothing.
    pub saturates: Saturates,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) enum Saturates {
    Every,
    Arithmetic,
}

/// The content of a chip's file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct File {
    name: String,
    #[serde(default)]
    description: String,
    pipes: Vec<String>,
    instructions: BTreeMap<String, Instruction>,
    merges: Merges,
    #[serde(default)]
    literal: Option<String>,
    /// The measurements that its ranking was checked against.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub evidence: Option<Evidence>,
    /// The instructions that each operation becomes.
    operations: BTreeMap<String, BTreeMap<String, u32>>,
}

/// The evidence for a profile: its ranking of formulas, compared with code from a compiler for the
/// chip.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Evidence {
    /// The columns of `tests/reference/gpu_corpus.csv`; of several, the largest value counts.
    pub columns: Vec<String>,
    /// The least rank correlation (Spearman) that the profile must have with them.
    pub rank_correlation: f64,
}

/// A kind of instruction.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Instruction {
    /// One number for each pipe.
    slots: Vec<f64>,
    latency: f64,
}

impl Chip {
    /// Parses the text of a `.ron` file at `path`.
    pub fn parse(path: &str, text: &str) -> Result<Chip, FileError> {
        let file: File = file::parse(KIND, path, text)?;
        Chip::of(file).map_err(|reason| FileError::Content {
            kind: KIND,
            path: path.to_owned(),
            reason,
        })
    }

    pub fn of(file: File) -> Result<Chip, String> {
        if file.pipes.is_empty() || file.pipes.len() > PIPES {
            return Err(format!("`pipes` must name 1 to {PIPES} pipes"));
        }
        for (name, instruction) in &file.instructions {
            instruction.check(name, &file.pipes)?;
        }
        for name in file.operations.keys() {
            file::operation(name)?;
        }
        let cost_of = |what: &str, parts: &BTreeMap<String, u32>| {
            let mut cost = Timing::default();
            for (kind, &count) in parts {
                let found = file.instructions.get(kind);
                let instruction =
                    found.ok_or_else(|| format!("{what}: no instruction is called \"{kind}\""))?;
                cost.add(instruction, f64::from(count));
            }
            Ok(cost)
        };
        let single = |what: &str, kind: &Option<String>| match kind {
            Some(kind) => cost_of(what, &BTreeMap::from([(kind.clone(), 1)])).map(Some),
            None => Ok(None),
        };
        let costs = Op::ALL.iter().map(|op| match file.operations.get(op.name()) {
            Some(parts) => cost_of(&format!("operation \"{op}\""), parts),
            None => Err(format!("operation \"{op}\" is missing")),
        });
        Ok(Chip {
            costs: costs.collect::<Result<_, String>>()?,
            three: single("`min3`", &file.merges.min3)?.unwrap_or_default(),
            literal: single("`literal`", &file.literal)?.map(|cost| cost.slots),
            name: file.name.clone(),
            description: file.description.clone(),
            pipes: file.pipes.clone(),
            merges: file.merges.clone(),
            file,
        })
    }

    /// Returns the file's content without name and description.
    pub fn nameless(&self) -> File {
        let (name, description) = (String::new(), String::new());
        File { name, description, evidence: None, ..self.file.clone() }
    }

    /// Returns the cost of an operation by itself, with nothing merged.
    pub fn of_op(&self, op: Op) -> &Timing {
        &self.costs[op as usize]
    }

    /// Returns the cost of an instruction.
    pub fn of_form(&self, form: Lowered) -> Timing {
        match form {
            Lowered::Merged => Timing::default(),
            Lowered::As(op) => *self.of_op(op),
            Lowered::Three => self.three,
            Lowered::Products(count) => self.of_op(Op::Mul).times(f64::from(count)),
            Lowered::Quotient { inverse, product } => {
                let mut cost = inverse.map_or(Timing::default(), |op| *self.of_op(op));
                if product {
                    cost = cost.plus(self.of_op(Op::Mul));
                }
                cost
            }
        }
    }
}

/// Returns the cycles for these slots: those of the busiest pipe.
pub(super) fn busiest(slots: &Slots) -> f64 {
    slots.iter().fold(0.0, |most, &slots| f64::max(most, slots))
}

impl Timing {
    fn add(&mut self, instruction: &Instruction, count: f64) {
        for (total, slots) in self.slots.iter_mut().zip(&instruction.slots) {
            *total += slots * count;
        }
        self.latency += instruction.latency * count;
    }

    fn plus(&self, other: &Timing) -> Timing {
        Timing {
            slots: std::array::from_fn(|pipe| self.slots[pipe] + other.slots[pipe]),
            latency: self.latency + other.latency,
        }
    }

    fn times(&self, count: f64) -> Timing {
        Timing { slots: self.slots.map(|slots| slots * count), latency: self.latency * count }
    }
}

impl Instruction {
    fn check(&self, name: &str, pipes: &[String]) -> Result<(), String> {
        let is_number = |number: f64| number.is_finite() && number >= 0.0;
        if self.slots.len() != pipes.len() {
            return Err(format!(
                "instruction \"{name}\": `slots` must have a number for each of the {} pipes",
                pipes.len()
            ));
        }
        if !self.slots.iter().all(|&slots| is_number(slots))
            || self.slots.iter().sum::<f64>() == 0.0
        {
            return Err(format!(
                "instruction \"{name}\": `slots` must be numbers of cycles, not all of them 0"
            ));
        }
        match is_number(self.latency) {
            true => Ok(()),
            false => Err(format!("instruction \"{name}\": `latency` must be a number of cycles")),
        }
    }
}
