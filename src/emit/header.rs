//! The comment above a function: its lines are made once, and each language comments them out.

use super::Language;
use crate::printable::is_hidden;

/// Returns the header's lines, each harmless in a comment of any language.
pub fn header_lines(header: &[String]) -> Vec<String> {
    header.iter().flat_map(|line| line.lines()).map(plain).collect()
}

/// Makes one line of ASCII of any text: some compilers refuse other characters, even in comments.
/// In WGSL more characters than `\n` end a line, some turn its direction and show other code than
/// is compiled, and a backslash at its end continues it in HLSL, GLSL and C.
fn plain(text: &str) -> String {
    let text: String = text.replace(is_hidden, " ").chars().map(ascii).collect();
    let mut text = text.trim_end().to_owned();
    if text.ends_with('\\') {
        text.push_str(" .");
    }
    text
}

/// Writes a character in ASCII; `\u{e9}` where there is no usual way.
fn ascii(c: char) -> String {
    let usual = match c {
        _ if c.is_ascii() => return c.to_string(),
        '→' => "->",
        '±' => "+-",
        '−' | '–' | '—' => "-",
        '×' => "x",
        '·' => ".",
        '≤' => "<=",
        '≥' => ">=",
        '≈' => "~",
        '²' => "^2",
        '³' => "^3",
        '…' => "...",
        '“' | '”' => "\"",
        '‘' | '’' => "'",
        _ => return c.escape_unicode().to_string(),
    };
    usual.to_owned()
}

/// Puts the beginning of a comment before each line.
pub(super) fn commented(begin: &str, lines: &[String]) -> Vec<String> {
    let line = |line| format!("{begin} {line}").trim_end().to_owned();
    header_lines(lines).into_iter().map(line).collect()
}

impl Language {
    /// Returns the text that begins a comment to the end of its line.
    pub fn comment(self) -> &'static str {
        self.syntax().map_or("", |syntax| syntax.comment)
    }
}
