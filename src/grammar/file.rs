//! Reads settings in `.ron` files, some of which come with the program: grammars, GPU profiles.

use crate::file::read_text;
use crate::op::Op;
use crate::suggest::did_you_mean;
use ron::extensions::Extensions;
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::borrow::Cow;
use std::path::Path;

/// The reason why a settings file cannot be used; `kind` is what it should be.
#[allow(missing_docs, reason = "each message names its fields")]
#[derive(Debug, thiserror::Error)]
pub enum FileError {
    #[error(
        "no {kind} is called `{name}`{hint} (built in: {known}; or give the path of a .ron file)"
    )]
    Unknown { kind: &'static str, name: String, hint: String, known: String },
    #[error("{kind} {path}: {reason}")]
    Unreadable { kind: &'static str, path: String, reason: std::io::Error },
    #[error("{kind} {path}, line {line}, column {column}: {reason}")]
    Syntax { kind: &'static str, path: String, line: usize, column: usize, reason: String },
    #[error("{kind} {path}: {reason}")]
    Content { kind: &'static str, path: String, reason: String },
}

/// Returns the text of a built-in file, by name, or of the file at a path.
pub(crate) fn find<'a>(
    kind: &'static str,
    name_or_path: &str,
    built_in: &[(&str, &'a str)],
) -> Result<Cow<'a, str>, FileError> {
    if let Some((_, text)) = built_in.iter().find(|(name, _)| *name == name_or_path) {
        return Ok(Cow::Borrowed(text));
    }
    let path = Path::new(name_or_path);
    if !path.exists() && path.extension().is_none() {
        let known: Vec<&str> = built_in.iter().map(|(name, _)| *name).collect();
        return Err(FileError::Unknown {
            kind,
            name: name_or_path.to_owned(),
            hint: did_you_mean(name_or_path, known.iter().copied()),
            known: known.join(", "),
        });
    }
    read_text(path).map(Cow::Owned).map_err(|reason| FileError::Unreadable {
        kind,
        path: name_or_path.to_owned(),
        reason,
    })
}

/// Parses a file's content; `Some` may be left out.
pub(crate) fn parse<T: DeserializeOwned>(
    kind: &'static str,
    path: &str,
    text: &str,
) -> Result<T, FileError> {
    let lenient = ron::Options::default().with_default_extension(Extensions::IMPLICIT_SOME);
    lenient.from_str(text).map_err(|error| FileError::Syntax {
        kind,
        path: path.to_owned(),
        line: error.span.start.line,
        column: error.span.start.col,
        reason: error.code.to_string(),
    })
}

/// Returns 16 hexadecimal digits that are equal for equal contents.
pub(crate) fn fingerprint(content: &impl Serialize) -> String {
    let text = ron::to_string(content).expect("plain data");
    blake3::hash(text.as_bytes()).to_hex().as_str()[..16].to_owned()
}

/// Returns the operation of a name in a file.
pub(crate) fn operation(name: &str) -> Result<Op, String> {
    Op::from_name(name).ok_or_else(|| {
        let hint = did_you_mean(name, Op::ALL.iter().map(|op| op.name()));
        format!("unknown operation \"{name}\"{hint}")
    })
}
