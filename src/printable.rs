//! Makes text from elsewhere harmless: nothing in it moves a terminal's cursor, ends a line, or
//! turns the direction of the text beside it.

use std::borrow::Cow;

/// Returns true for a character that acts on the text around it and is not seen itself: control
/// characters, line and paragraph separators, marks and overrides of direction, invisible
/// operators, tags.
pub fn is_hidden(character: char) -> bool {
    character.is_control()
        || matches!(
            character,
            '\u{ad}'
                | '\u{61c}'
                | '\u{180e}'
                | '\u{200b}'
                | '\u{200e}'
                | '\u{200f}'
                | '\u{2028}'..='\u{202e}'
                | '\u{2060}'..='\u{206f}'
                | '\u{feff}'
                | '\u{fff9}'..='\u{fffb}'
                | '\u{fffe}'
                | '\u{ffff}'
                | '\u{e0000}'..='\u{e007f}'
        )
}

/// Returns the text as one line, its hidden characters escaped.
///
/// ```
/// use lgp::printable::printable;
/// assert_eq!(printable("roughness"), "roughness");
/// assert_eq!(printable("a\u{1b}[31m\n\u{202e}"), r"a\u{1b}[31m\n\u{202e}");
/// ```
pub fn printable(text: &str) -> Cow<'_, str> {
    escaped(text, is_hidden, |c| c.escape_default().to_string())
}

/// Escapes the hidden characters of a text of several lines, except line ends and tabs.
///
/// ```
/// assert_eq!(lgp::printable::printable_lines("a\tb\n\u{7}"), "a\tb\n\\u{7}");
/// ```
pub fn printable_lines(text: &str) -> Cow<'_, str> {
    let hidden = |c| is_hidden(c) && c != '\n' && c != '\t';
    escaped(text, hidden, |c| c.escape_default().to_string())
}

/// Escapes the hidden characters in JSON's strings as JSON does; the JSON means the same.
///
/// ```
/// assert_eq!(lgp::printable::printable_json("[\n\"\u{202e}\"]"), "[\n\"\\u202e\"]");
/// ```
pub fn printable_json(json: &str) -> Cow<'_, str> {
    let units = |c: char| {
        let mut units = [0; 2];
        c.encode_utf16(&mut units).iter().map(|unit| format!("\\u{unit:04x}")).collect()
    };
    escaped(json, |c| is_hidden(c) && c != '\n' && c != '\t', units)
}

fn escaped(
    text: &str,
    hidden: impl Fn(char) -> bool,
    written: impl Fn(char) -> String,
) -> Cow<'_, str> {
    if !text.contains(&hidden) {
        return Cow::Borrowed(text);
    }
    let one = |c| if hidden(c) { written(c) } else { String::from(c) };
    Cow::Owned(text.chars().map(one).collect())
}
