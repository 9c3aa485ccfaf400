//! The comment above a function: its lines are made once, and each language comments them out.

use super::Language;
use crate::printable::is_hidden;

/// Returns the header's lines, each harmless in a comment of any language.
pub fn header_lines(header: &[String]) -> Vec<String> {
    header.iter().flat_map(|line| line.lines()).map(plain).collect()
}

/// Makes one line of any text. In WGSL more characters than `\n` end a line, some turn its
/// direction and show other code than is compiled, and a backslash at its end continues it in HLSL,
/// GLSL and C.
fn plain(text: &str) -> String {
    let mut text = text.replace(is_hidden, " ").trim_end().to_owned();
    if text.ends_with('\\') {
        text.push_str(" .");
    }
    text
}

/// Puts the beginning of a comment before each line.
pub(super) fn commented(begin: &str, lines: &[String]) -> Vec<String> {
    let line = |line| format!("{begin} {line}").trim_end().to_owned();
    header_lines(lines).into_iter().map(line).collect()
}

impl Language {
    /// Returns the text that begins a comment to the end of its line.
    pub fn comment(self) -> &'static str {
        self.syntax().comment
    }
}
