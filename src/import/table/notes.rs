//! What the reader of a table should know of it.

use super::Open;
use super::read::Read;

/// Remarks about how a table was read.
pub(super) fn of_reading(open: &Open, read: &Read) -> Vec<String> {
    let mut notes = Vec::new();
    if let Some(other) = open.layout.other {
        notes.push(format!(
            "{other} could separate the columns, too: --separator {}",
            other.argument()
        ));
    }
    if let Some((line, text, value)) = &read.grouped {
        notes.push(format!("digits are grouped: `{text}` in line {line} is {value}"));
    }
    notes
}

/// Says of values that became zero.
pub(super) fn of_vanished(name: &str, count: usize) -> Option<String> {
    let values = if count == 1 { "value" } else { "values" };
    (count > 0).then(|| format!("{count} {values} of `{name}` are below 1e-45, and stored as 0"))
}

/// Says of an input that it counts the rows or never changes.
pub(super) fn of_input(name: &str, values: &[f32], is_first: bool) -> Option<String> {
    let (first, last) = (*values.first()?, *values.last()?);
    // By hand: three rows may count by chance.
    let counts = values.len() > 3
        && [0.0, 1.0].contains(&first)
        && values.windows(2).all(|pair| pair[1] - pair[0] == 1.0);
    if is_first && counts {
        return Some(format!(
            "`{name}` counts the rows ({first} to {last}); if that means nothing, --drop {name}"
        ));
    }
    let is_constant = values.len() > 1 && values.iter().all(|value| *value == first);
    is_constant.then(|| format!("`{name}` is {first} in every row; --drop {name} leaves it out"))
}
