//! What stands between columns.

use serde::{Serialize, Serializer};
use std::fmt;

/// What stands between the columns of a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Separator {
    /// One of this character.
    Character(char),
    /// One or more blanks or tabs.
    Blanks,
}

impl Separator {
    /// Those that are looked for, in the order in which the first is taken where several fit.
    pub const KNOWN: [Separator; 5] = [
        Separator::Character('\t'),
        Separator::Character(';'),
        Separator::Character('|'),
        Separator::Character(','),
        Separator::Blanks,
    ];

    /// Parses a separator: a character, or `comma`, `semicolon`, `tab`, `bar`, `blanks`.
    ///
    /// # Errors
    /// What can be written, in words.
    pub fn parse(text: &str) -> Result<Separator, String> {
        let mut characters = text.chars();
        let only = characters.next().filter(|_| characters.next().is_none());
        Ok(match (text, only) {
            ("comma", _) => Separator::Character(','),
            ("semicolon", _) => Separator::Character(';'),
            ("tab" | "\\t", _) => Separator::Character('\t'),
            ("bar", _) => Separator::Character('|'),
            ("blanks" | "blank" | "spaces" | "space", _) | (_, Some(' ')) => Separator::Blanks,
            (_, Some(c)) if c == '\t' || (c.is_ascii_punctuation() && !"\"+-._".contains(c)) => {
                Separator::Character(c)
            }
            _ => return Err("write a character as in \";\", or comma, tab, bar or blanks".into()),
        })
    }

    /// The separator as `--separator` takes it.
    pub(super) fn argument(self) -> String {
        match self {
            Separator::Character('\t') => "tab".into(),
            Separator::Blanks => "blanks".into(),
            Separator::Character(c) => format!("\"{c}\""),
        }
    }
}

impl fmt::Display for Separator {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Separator::Character('\t') => f.write_str("tabs"),
            Separator::Character(c) => write!(f, "`{c}`"),
            Separator::Blanks => f.write_str("blanks"),
        }
    }
}

impl Serialize for Separator {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Separator::Character(c) => serializer.serialize_char(*c),
            Separator::Blanks => serializer.serialize_str("blanks"),
        }
    }
}
