//! Text of bytes, whatever program wrote them.

use crate::import::Error;
use serde::Serialize;
use std::borrow::Cow;
use std::path::Path;

/// The encoding of a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum Encoding {
    /// With or without a byte-order mark.
    #[serde(rename = "UTF-8")]
    Utf8,
    /// With a byte-order mark, of either byte order.
    #[serde(rename = "UTF-16")]
    Utf16,
    /// What is not UTF-8 and holds no control characters.
    #[serde(rename = "Windows-1252")]
    Windows1252,
}

/// The characters of the bytes 0x80 to 0x9f in Windows-1252; all above are those of Unicode.
const WINDOWS: [char; 32] = [
    '€', '\u{81}', '‚', 'ƒ', '„', '…', '†', '‡', 'ˆ', '‰', 'Š', '‹', 'Œ', '\u{8d}', 'Ž', '\u{8f}',
    '\u{90}', '‘', '’', '“', '”', '•', '–', '—', '˜', '™', 'š', '›', 'œ', '\u{9d}', 'ž', 'Ÿ',
];

/// Decodes a text; its lines end with `\n` or `\r\n`, those that ended with `\r` alone too.
///
/// # Errors
/// [`Error::NotText`]: a file that is no text, or in UTF-16 without a byte-order mark.
pub(super) fn decode(path: &Path, bytes: Vec<u8>) -> Result<(String, Encoding), Error> {
    let (mut text, encoding) = match &bytes[..] {
        [0xff, 0xfe, rest @ ..] => (utf16(rest, u16::from_le_bytes), Encoding::Utf16),
        [0xfe, 0xff, rest @ ..] => (utf16(rest, u16::from_be_bytes), Encoding::Utf16),
        _ => match String::from_utf8(bytes) {
            Ok(text) => (text, Encoding::Utf8),
            Err(error) => (windows_1252(error.as_bytes()), Encoding::Windows1252),
        },
    };
    if text.starts_with('\u{feff}') {
        text.drain(..'\u{feff}'.len_utf8());
    }
    // The end of a file, as some systems wrote it.
    if text.ends_with('\u{1a}') {
        text.pop();
    }
    let strange = |c: char| match encoding {
        Encoding::Windows1252 => c.is_control() && !matches!(c, '\t' | '\n' | '\r' | '\u{c}'),
        _ => c == '\0',
    };
    if let Some(place) = text.find(strange) {
        let line = 1 + text[..place].matches('\n').count();
        return Err(Error::NotText { path: path.into(), line });
    }
    Ok((with_line_feeds(text), encoding))
}

fn utf16(bytes: &[u8], unit: fn([u8; 2]) -> u16) -> String {
    let units = bytes.as_chunks::<2>().0.iter().map(|&pair| unit(pair));
    char::decode_utf16(units).map(|c| c.unwrap_or(char::REPLACEMENT_CHARACTER)).collect()
}

fn windows_1252(bytes: &[u8]) -> String {
    let character = |&byte: &u8| match byte {
        0x80..=0x9f => WINDOWS[usize::from(byte - 0x80)],
        _ => char::from(byte),
    };
    bytes.iter().map(character).collect()
}

fn with_line_feeds(text: String) -> String {
    let bytes = text.as_bytes();
    let mut returns = text.match_indices('\r').map(|(at, _)| at);
    if returns.all(|at| bytes.get(at + 1) == Some(&b'\n')) {
        return text;
    }
    let mut bytes = text.into_bytes();
    for at in 0..bytes.len() {
        if bytes[at] == b'\r' && bytes.get(at + 1) != Some(&b'\n') {
            bytes[at] = b'\n';
        }
    }
    match String::from_utf8_lossy(&bytes) {
        Cow::Borrowed(text) => text.to_owned(),
        Cow::Owned(text) => text,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn decoded(bytes: &[u8]) -> (String, Encoding) {
        decode(Path::new("x.csv"), bytes.to_vec()).unwrap()
    }

    #[test]
    fn encodings_and_line_ends_are_understood() {
        for (bytes, text, encoding) in [
            (&b"\xef\xbb\xbfx,y\r\n1,2"[..], "x,y\r\n1,2", Encoding::Utf8),
            (b"\xff\xfex\0,\0\xb5\0\n\0", "x,µ\n", Encoding::Utf16),
            (b"\xfe\xff\0x\0,\0\xb5\0\r\x001", "x,µ\n1", Encoding::Utf16),
            (b"T (\xb0C),\x80\n", "T (°C),€\n", Encoding::Windows1252),
            (b"x\r1\r\n\r2\r", "x\n1\r\n\n2\n", Encoding::Utf8),
            (b"x\n1\n\x1a", "x\n1\n", Encoding::Utf8),
        ] {
            assert_eq!(decoded(bytes), (text.to_owned(), encoding));
        }
    }

    #[test]
    fn what_is_no_text_is_refused() {
        for bytes in [&b"x\n\0"[..], b"\x89PNG\r\n\x1a\n", b"x\0,\0y\0", b"a\n\xff\x01"] {
            assert!(matches!(decode(Path::new("x"), bytes.to_vec()), Err(Error::NotText { .. })));
        }
    }
}
