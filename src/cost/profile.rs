//! GPU profiles: cycles by operation, from `.ron` files.

use crate::op::Op;
use crate::suggest::did_you_mean;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::Path;

/// The profiles that come with the program, by name.
const BUILT_IN: [(&str, &str); 1] = [("gcn", include_str!("../../grammar/gpu/gcn.ron"))];

/// What a GPU's operations cost.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    pub name: String,
    pub description: String,
    cycles: Vec<f64>,
}

/// A profile that cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum ProfileError {
    #[error(
        "no GPU profile is called `{name}`{hint} (built in: {known}; or give the path of a .ron file)"
    )]
    Unknown { name: String, hint: String, known: String },
    #[error("GPU profile {path}: {reason}")]
    Unreadable { path: String, reason: std::io::Error },
    #[error("GPU profile {path}, line {line}, column {column}: {reason}")]
    Syntax { path: String, line: usize, column: usize, reason: String },
    #[error("GPU profile {path}: {reason}")]
    Content { path: String, reason: String },
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
    pub fn find(name_or_path: &str) -> Result<Profile, ProfileError> {
        if let Some((name, text)) = BUILT_IN.iter().find(|(name, _)| *name == name_or_path) {
            return Profile::parse(name, text);
        }
        let path = Path::new(name_or_path);
        if !path.exists() && path.extension().is_none() {
            let known: Vec<&str> = Profile::built_in().collect();
            return Err(ProfileError::Unknown {
                name: name_or_path.to_owned(),
                hint: did_you_mean(name_or_path, known.iter().copied()),
                known: known.join(", "),
            });
        }
        let text = std::fs::read_to_string(path)
            .map_err(|reason| ProfileError::Unreadable { path: name_or_path.to_owned(), reason })?;
        Profile::parse(name_or_path, &text)
    }

    /// A profile from the text of a `.ron` file at `path`.
    pub fn parse(path: &str, text: &str) -> Result<Profile, ProfileError> {
        let file: File = ron::from_str(text).map_err(|error| ProfileError::Syntax {
            path: path.to_owned(),
            line: error.span.start.line,
            column: error.span.start.col,
            reason: error.code.to_string(),
        })?;
        let refuse = |reason: String| ProfileError::Content { path: path.to_owned(), reason };
        for (what, rate) in [("full", file.full), ("transcendental", file.transcendental)] {
            if !(rate.is_finite() && rate > 0.0) {
                return Err(refuse(format!("`{what}` must be a positive number of cycles")));
            }
        }
        let unknown = file.operations.keys().find(|name| Op::from_name(name).is_none());
        if let Some(name) = unknown {
            let hint = did_you_mean(name, Op::ALL.iter().map(|op| op.name()));
            return Err(refuse(format!("unknown operation \"{name}\"{hint}")));
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
