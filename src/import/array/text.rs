//! Lines of numbers of lookup tables.

use super::Fault;
use super::error::counted;
use super::scalar::narrow;

const UTF8: &str = "save it as text in UTF-8";

/// Returns the content as text.
pub(super) fn text(content: &[u8]) -> Result<&str, Fault> {
    let content = content.strip_prefix(b"\xef\xbb\xbf").unwrap_or(content);
    std::str::from_utf8(content).map_err(|error| {
        let before = &content[..error.valid_up_to()];
        let line = 1 + before.iter().filter(|&&byte| byte == b'\n').count();
        Fault::at(line, "it is not text", UTF8)
    })
}

/// Returns the lines that are neither blank nor comments, and their numbers.
pub(super) fn lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let lines = (1..).zip(text.lines().map(str::trim));
    lines.filter(|(_, line)| !line.is_empty() && !line.starts_with('#'))
}

/// Parses all words of a line as finite numbers or infinity or NaN.
pub(super) fn numbers(line: usize, text: &str) -> Result<Vec<f64>, Fault> {
    let number = |word: &str| {
        word.parse().map_err(|_| {
            let word = crate::printable::printable(word).into_owned();
            Fault::at(line, format!("`{word}` is not a number"), "write it as in 0.25")
        })
    };
    text.split_whitespace().map(number).collect()
}

/// Parses exactly so many numbers.
pub(super) fn exactly<const N: usize>(line: usize, text: &str) -> Result<[f64; N], Fault> {
    let found = numbers(line, text)?;
    let count = counted(found.len(), "number");
    found.try_into().map_err(|_| {
        Fault::at(line, format!("{count}, where there should be {N}"), "write it again")
    })
}

/// Parses so many numbers, rounded to f32.
pub(super) fn narrowed(line: usize, text: &str, count: usize) -> Result<Vec<f32>, Fault> {
    let found = numbers(line, text)?;
    if found.len() != count {
        let problem = format!("{}, where there should be {count}", counted(found.len(), "number"));
        return Err(Fault::at(line, problem, "write it again"));
    }
    let narrow = |value| {
        narrow(0, value).map_err(|_| {
            Fault::at(line, format!("{value} is too large for 32-bit floats"), "scale the values")
        })
    };
    found.into_iter().map(narrow).collect()
}

/// Parses a size, a whole number from 2.
pub(super) fn size(line: usize, text: &str) -> Result<usize, Fault> {
    let text = text.trim();
    text.parse().ok().filter(|&size| size >= 2).ok_or_else(|| {
        let text = crate::printable::printable(text).into_owned();
        Fault::at(line, format!("`{text}` is no size"), "write a whole number from 2")
    })
}
