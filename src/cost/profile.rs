//! GPU profiles: cycles by operation, from `.ron` files.

use crate::grammar::{FileError, file};
use crate::op::Op;
use serde::Deserialize;
use std::collections::BTreeMap;

const KIND: &str = "GPU profile";

/// The profiles that come with the program, by name.
const BUILT_IN: [(&str, &str); 1] = [("gcn", include_str!("../../grammar/gpu/gcn.ron"))];

/// What a GPU's operations cost.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    pub name: String,
    pub description: String,
    cycles: Vec<f64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    name: String,
    #[serde(default)]
    description: String,
    /// Cycles of an instruction at full rate.
    full: f64,
    /// Cycles of a transcendental instruction.
    transcendental: f64,
    /// Instructions that each operation becomes: at full rate, transcendental.
    operations: BTreeMap<String, (u32, u32)>,
}

impl Profile {
    /// The built-in profiles' names.
    pub fn built_in() -> impl Iterator<Item = &'static str> {
        BUILT_IN.iter().map(|(name, _)| *name)
    }

    /// A built-in profile by name, or one from a `.ron` file.
    pub fn find(name_or_path: &str) -> Result<Profile, FileError> {
        Profile::parse(name_or_path, &file::find(KIND, name_or_path, &BUILT_IN)?)
    }

    /// A profile from the text of a `.ron` file at `path`.
    pub fn parse(path: &str, text: &str) -> Result<Profile, FileError> {
        let file: File = file::parse(KIND, path, text)?;
        let refuse =
            |reason: String| FileError::Content { kind: KIND, path: path.to_owned(), reason };
        for (what, rate) in [("full", file.full), ("transcendental", file.transcendental)] {
            if !(rate.is_finite() && rate > 0.0) {
                return Err(refuse(format!("`{what}` must be a positive number of cycles")));
            }
        }
        for name in file.operations.keys() {
            file::operation(name).map_err(refuse)?;
        }
        let cycles = Op::ALL.iter().map(|op| match file.operations.get(op.name()) {
            Some(&(full, transcendental)) => {
                Ok(f64::from(full) * file.full + f64::from(transcendental) * file.transcendental)
            }
            None => Err(refuse(format!("operation \"{op}\" is missing"))),
        });
        let cycles = cycles.collect::<Result<_, _>>()?;
        Ok(Profile { name: file.name, description: file.description, cycles })
    }

    /// The cycles of an operation by itself, with nothing fused or free.
    pub fn of(&self, op: Op) -> f64 {
        self.cycles[op as usize]
    }
}
