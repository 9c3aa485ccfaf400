//! The source of a dataset's rows.

use serde::{Deserialize, Serialize};
use std::fmt;

/// The source of a dataset's rows, and what was done to them since. `lgp info` shows it as text.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Origin {
    /// A target's generator.
    Target {
        /// In RON.
        recipe: String,
        /// The error that the generator measured, in words.
        error: String,
    },
    /// A table.
    Import {
        /// The file's name, without its folder.
        file: String,
        /// The columns whose names in the file are no identifiers, with those in the data.
        #[serde(default, skip_serializing_if = "Vec::is_empty")]
        renamed: Vec<(String, String)>,
    },
    /// A function.
    Formula {
        /// Its formula, or a description.
        text: String,
    },
    /// A function that can be evaluated anywhere (`lgp::truth`).
    Function {
        /// The function.
        function: Function,
        /// Its domain, as `--domain` has it.
        domain: String,
    },
    /// The rows that a scene left of others.
    View {
        /// The source of those.
        of: Box<Origin>,
        /// The scene's name.
        scene: String,
    },
    /// The rows that pruning of flat regions left.
    Pruned {
        /// The source of all rows.
        of: Box<Origin>,
        /// The share of an output's range that counted as flat.
        share: f64,
        /// The number of rows left.
        kept: usize,
        /// The number of rows before.
        rows: usize,
    },
}

/// A function, with all that is needed to evaluate it again.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Function {
    /// Formula text.
    Formula {
        /// The text.
        text: String,
    },
    /// A function of a shader.
    Shader {
        /// The file's name, without its folder.
        file: String,
        /// Its text; binary code in hexadecimal digits.
        text: String,
        /// The function's name.
        entry: String,
        /// The values that `--set` gave.
        set: Vec<String>,
        /// The definitions that `--let` gave.
        define: Vec<String>,
    },
}

impl fmt::Display for Function {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Function::Formula { text } => f.write_str(text),
            Function::Shader { file, entry, set, define, .. } => {
                write!(f, "{entry} of {file}")?;
                set.iter().try_for_each(|text| write!(f, ", {text}"))?;
                define.iter().try_for_each(|text| write!(f, ", {text}"))
            }
        }
    }
}

impl Default for Origin {
    fn default() -> Origin {
        Origin::Formula { text: String::new() }
    }
}

impl Origin {
    /// Returns the name of the target whose rows they are, in the end.
    pub fn target(&self) -> Option<String> {
        #[derive(Deserialize)]
        struct TargetOnly {
            target: String,
        }
        match self {
            Origin::Target { recipe, .. } => {
                let TargetOnly { target } = ron::from_str(recipe).ok()?;
                let is_name = |c: char| c.is_ascii_alphanumeric() || c == '_';
                target.chars().all(is_name).then_some(target)
            }
            Origin::View { of, .. } | Origin::Pruned { of, .. } => of.target(),
            Origin::Import { .. } | Origin::Formula { .. } | Origin::Function { .. } => None,
        }
    }

    /// Returns the function whose values they are in the end, if it can be evaluated again, and its
    /// domain.
    pub fn function(&self) -> Option<(&Function, &str)> {
        match self {
            Origin::Function { function, domain } => Some((function, domain)),
            Origin::View { of, .. } | Origin::Pruned { of, .. } => of.function(),
            Origin::Target { .. } | Origin::Import { .. } | Origin::Formula { .. } => None,
        }
    }

    /// Returns the error that a generator measured, the names that an import changed, and the shares
    /// that pruning left.
    pub fn notes(&self) -> Vec<String> {
        match self {
            Origin::Target { error, .. } => vec![error.clone()],
            Origin::Pruned { of, share, kept, rows } => {
                let pruned = format!("pruned at {share}: {kept} of {rows} rows");
                [of.notes(), vec![pruned]].concat()
            }
            Origin::Function { .. } => vec!["evaluated in double precision".to_owned()],
            Origin::Import { renamed, .. } => {
                renamed.iter().map(|(written, name)| format!("`{written}` is {name}")).collect()
            }
            Origin::Formula { .. } | Origin::View { .. } => Vec::new(),
        }
    }

    /// Returns the text without [`Origin::notes`]: a target's recipe, for example.
    pub fn source(&self) -> String {
        match self {
            Origin::Target { recipe, .. } => recipe.clone(),
            Origin::Import { file, .. } => format!("{IMPORTED}{file}"),
            Origin::Formula { text } => text.clone(),
            Origin::Function { function, domain } => format!("{function} over {domain}"),
            Origin::View { of, scene } => format!("{of}{SCENE}{scene}"),
            Origin::Pruned { of, .. } => of.source(),
        }
    }

    /// Parses the one text of a file of version 1.
    pub(super) fn of_text(text: &str) -> Origin {
        let origin = Origin::taken_apart(text);
        let kept = origin.as_ref().is_some_and(|origin| origin.to_string() == text);
        origin.filter(|_| kept).unwrap_or_else(|| Origin::Formula { text: text.to_owned() })
    }

    fn taken_apart(text: &str) -> Option<Origin> {
        if let Some((of, scene)) = text.split_once(SCENE) {
            let of = Box::new(Origin::of_text(of));
            return Some(Origin::View { of, scene: scene.to_owned() });
        }
        if let Some((of, pruned)) = text.split_once("pruned at ") {
            let of = of.strip_suffix(", ").or(of.strip_suffix(NOTE))?;
            let (share, rows) = pruned.strip_suffix(" rows")?.split_once(": ")?;
            let (kept, rows) = rows.split_once(" of ")?;
            return Some(Origin::Pruned {
                of: Box::new(Origin::of_text(of)),
                share: share.parse().ok()?,
                kept: kept.parse().ok()?,
                rows: rows.parse().ok()?,
            });
        }
        if let Some(file) = text.strip_prefix(IMPORTED) {
            return Some(Origin::Import { file: file.to_owned(), renamed: Vec::new() });
        }
        let (recipe, error) = text.split_once(NOTE)?;
        let target = Origin::Target { recipe: recipe.to_owned(), error: error.to_owned() };
        target.target().map(|_| target)
    }
}

const IMPORTED: &str = "imported from ";
const NOTE: &str = " // ";
const SCENE: &str = "\n// scene ";

impl fmt::Display for Origin {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(&self.source())?;
        match self.notes().join(", ") {
            notes if notes.is_empty() => Ok(()),
            notes => write!(f, "{NOTE}{notes}"),
        }
    }
}
