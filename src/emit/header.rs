//! The comment above a function, as data: its lines are made once, and each language comments them.

use super::Language;
use crate::printable::is_hidden;

/// Each line of the header as it may stand in a comment of any language.
pub fn header_lines(header: &[String]) -> Vec<String> {
    header.iter().flat_map(|line| line.lines()).map(plain).collect()
}

/// One line whatever `text` holds: more characters than `\n` end a line in WGSL, those that turn its
/// direction show other code than is compiled, and a backslash at its end continues it in HLSL, GLSL and C.
fn plain(text: &str) -> String {
    let mut text = text.replace(is_hidden, " ").trim_end().to_owned();
    if text.ends_with('\\') {
        text.push_str(" .");
    }
    text
}

/// The lines behind what begins a comment.
pub(super) fn commented(begin: &str, lines: &[String]) -> Vec<String> {
    let line = |line| format!("{begin} {line}").trim_end().to_owned();
    header_lines(lines).into_iter().map(line).collect()
}

impl Language {
    /// What begins a comment that ends with its line.
    pub fn comment(self) -> &'static str {
        self.syntax().comment
    }
}
