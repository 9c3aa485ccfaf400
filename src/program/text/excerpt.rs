//! Shows a place in a text to its author.

/// Characters of a line that are shown around a place: about a terminal's line.
const SHOWN: usize = 120;

/// Shows the part of the line around a column (from 1), with a mark below it. Characters that would
/// steer a terminal are shown as `�`.
pub(crate) fn pointed(line: &str, column: usize) -> String {
    let before = column.saturating_sub(1);
    let start = if before < SHOWN { 0 } else { before - SHOWN / 2 };
    let mut rest = line.chars().skip(start);
    let shown: String = rest.by_ref().take(SHOWN).map(plain).collect();
    let cut = |more: bool| if more { "…" } else { "" };
    let (left, right) = (cut(start > 0), cut(rest.next().is_some()));
    let indent = " ".repeat(before - start + usize::from(start > 0));
    format!("  {left}{}{right}\n  {indent}^", shown.trim_end())
}

/// Returns the character, or `�` if it ends the line or turns its direction.
pub(crate) fn plain(c: char) -> char {
    let turns =
        matches!(c, '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    match c {
        '\t' => ' ',
        c if c.is_control() || turns || c == '\u{2028}' || c == '\u{2029}' => '\u{fffd}',
        c => c,
    }
}

/// Returns the line and column, both from 1, of the byte `offset`, and the text of the line.
pub(crate) fn place(text: &str, offset: usize) -> (usize, usize, &str) {
    let before = &text[..offset];
    let line_start = before.rfind('\n').map_or(0, |i| i + 1);
    let line = text[line_start..].lines().next().unwrap_or("");
    (before.matches('\n').count() + 1, text[line_start..offset].chars().count() + 1, line)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mark_is_below_its_column_wherever_that_is() {
        let line: String = (0..200_000u32).map(|i| char::from(b'a' + (i % 26) as u8)).collect();
        for column in [1, 2, 119, 120, 121, 5000, 65_535, 65_536, 199_999, 200_000, 200_001] {
            let shown = pointed(&line, column);
            let (text, mark) = shown.split_once('\n').unwrap();
            assert!(text.chars().count() < SHOWN + 10, "{column}");
            let below = text.chars().nth(mark.chars().count() - 1);
            assert_eq!(below, line.chars().nth(column - 1), "{column}");
        }
    }

    #[test]
    fn a_terminal_is_not_steered() {
        assert_eq!(pointed("a\u{1b}[2Jb\u{202e}c\td", 7), "  a\u{fffd}[2Jb\u{fffd}c d\n        ^");
    }
}
