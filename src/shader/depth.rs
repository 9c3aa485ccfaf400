//! Texts that are too deep for parsers.

use super::interpreter::DEEPEST_BLOCK;
use super::macros::explosion;
use super::text::Text;
use super::{Error, glsl};
use std::path::Path;

/// The most brackets within each other: parsers go as deep.
const DEEPEST_NESTING: usize = 256;
/// Refuses what parsers take too much stack or time for.
pub(super) fn check_depth(path: &Path, written: &Text, text: &str) -> Result<(), Error> {
    let refused = |at, message| Err(written.error(path, text, at, 0, message));
    let mut depth = 0usize;
    for (at, byte) in text.bytes().enumerate() {
        match byte {
            b'(' | b'[' | b'{' => depth += 1,
            b')' | b']' | b'}' => depth = depth.saturating_sub(1),
            _ => {}
        }
        if depth > DEEPEST_NESTING {
            let message = format!("brackets are nested more than {DEEPEST_NESTING} deep");
            return refused(at, message);
        }
    }
    if let Some(at) = longest_chain(text) {
        return refused(at, too_deep());
    }
    match explosion(text) {
        Some(at) => refused(at, "macros make too much of the text".into()),
        None => Ok(()),
    }
}

pub(super) fn too_deep() -> String {
    format!("blocks are nested more than {DEEPEST_BLOCK} deep, as in a chain of `else if` or `?`")
}

/// Returns the place where a chain of `else if`, or of choices by `?`, becomes too long, if one does:
/// each is a block in the one before.
fn longest_chain(text: &str) -> Option<usize> {
    let mut chains = vec![0usize];
    let (mut before, mut counted, mut choices) = ("", 0, 0);
    for (at, word) in glsl::words(text) {
        for byte in text[counted..at].bytes() {
            match byte {
                b'{' => chains.push(0),
                b'}' if chains.len() > 1 => drop(chains.pop()),
                b'?' => choices += 1,
                b';' => choices = 0,
                _ => {}
            }
        }
        counted = at;
        let chain = chains.last_mut()?;
        match (before, word) {
            ("else", "if") => *chain += 1,
            (_, "if") => *chain = 0,
            _ => {}
        }
        if *chain > DEEPEST_BLOCK || choices > DEEPEST_BLOCK {
            return Some(at);
        }
        before = word;
    }
    None
}
