//! Numbers as people and programs write them.

use serde::Serialize;

/// The sign before a number's decimals.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Decimal {
    /// As in `0.5`.
    Point,
    /// As in `0,5`.
    Comma,
}

impl Decimal {
    pub(super) fn sign(self) -> char {
        match self {
            Decimal::Point => '.',
            Decimal::Comma => ',',
        }
    }

    fn other(self) -> char {
        match self {
            Decimal::Point => ',',
            Decimal::Comma => '.',
        }
    }
}

/// How a table's numbers are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Notation {
    pub decimal: Decimal,
    /// True if it is known that the other sign groups digits, as in `1,234`.
    pub groups: bool,
}

/// What a cell holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Content {
    Empty,
    /// A number; infinite where it is beyond f64.
    Number(f64),
    /// A number whose digits are grouped so that it cannot mean another one, as in `1,234.5`.
    Grouped(f64),
    /// A number by either sign: 1.234 or 1234.
    Ambiguous,
    /// What programs write for a number that there is not.
    Missing,
    Text,
}

/// What is written for a missing number, in lower case.
const MISSING: [&str; 21] = [
    "nan",
    "na",
    "n/a",
    "#n/a",
    "null",
    "none",
    "nil",
    "inf",
    "-inf",
    "+inf",
    "infinity",
    "-infinity",
    "+infinity",
    "#div/0!",
    "#num!",
    "#value!",
    "#ref!",
    "#name?",
    "#null!",
    "-nan",
    "1.#qnan",
];

/// The longest number that is read when written unusually. By hand.
const LONGEST_NUMBER: usize = 64;

impl Notation {
    /// Reads a cell.
    pub fn content(self, text: &str) -> Content {
        let plain = match self.decimal {
            Decimal::Point => text.parse().ok(),
            Decimal::Comma => None,
        };
        match plain {
            Some(value) if f64::is_finite(value) => Content::Number(value),
            _ => self.unusual(text),
        }
    }

    fn unusual(self, text: &str) -> Content {
        if text.is_empty() {
            return Content::Empty;
        }
        if text.len() <= LONGEST_NUMBER && MISSING.contains(&&*text.to_ascii_lowercase()) {
            return Content::Missing;
        }
        if text.len() > LONGEST_NUMBER || !text.contains(|c: char| c.is_ascii_digit()) {
            let number = text.parse().ok().filter(|_| self.decimal == Decimal::Point);
            let digits = text.contains(|c: char| c.is_ascii_digit());
            return number.filter(|_| digits).map_or(Content::Text, Content::Number);
        }
        self.rewritten(text)
    }

    /// Reads a number with another sign before its decimals, grouped digits, a minus that is no
    /// hyphen, or the exponent of Fortran.
    fn rewritten(self, text: &str) -> Content {
        let (sign, unsigned) = match text.strip_prefix(['-', '\u{2212}']) {
            Some(rest) => ("-", rest),
            None => ("", text.strip_prefix('+').unwrap_or(text)),
        };
        let exponent = unsigned.find(['e', 'E', 'd', 'D']).unwrap_or(unsigned.len());
        let (mantissa, exponent) = unsigned.split_at(exponent);
        let (whole, decimals) = match mantissa.rsplit_once(self.decimal.sign()) {
            Some((whole, decimals)) => (whole, Some(decimals)),
            None => (mantissa, None),
        };
        let Some(Groups { digits, by_other, certain }) = groups(whole, self.decimal.other()) else {
            return self.by_the_other_sign(text);
        };
        if by_other && !certain && decimals.is_none() && !self.groups {
            return Content::Ambiguous;
        }
        if !decimals.unwrap_or_default().bytes().all(|byte| byte.is_ascii_digit()) {
            return Content::Text;
        }
        let power = match exponent.get(1..) {
            None => String::new(),
            Some(power) => format!("e{}", power.replace('\u{2212}', "-")),
        };
        let written = format!("{sign}{digits}.{}{power}", decimals.unwrap_or_default());
        match written.parse() {
            Ok(value) if by_other => Content::Grouped(value),
            Ok(value) => Content::Number(value),
            Err(_) => Content::Text,
        }
    }

    /// `1.234.567` where points are decimal can only be grouped.
    fn by_the_other_sign(self, text: &str) -> Content {
        let sign = self.decimal.sign();
        let several = text.matches(sign).count() > 1;
        let unsigned = text.trim_start_matches(['-', '+', '\u{2212}']);
        match several && groups(unsigned, sign).is_some() {
            true => Content::Ambiguous,
            false => Content::Text,
        }
    }
}

struct Groups {
    digits: String,
    /// True if `other` groups them.
    by_other: bool,
    /// True if it can be nothing else.
    certain: bool,
}

/// Takes apart digits in groups of three; `None` if they are not.
fn groups(whole: &str, other: char) -> Option<Groups> {
    if whole.bytes().all(|byte| byte.is_ascii_digit()) {
        return Some(Groups { digits: whole.to_owned(), by_other: false, certain: true });
    }
    let signs = [other, '\u{a0}', '\u{202f}', '\u{2009}', '\''];
    let sign = whole.chars().find(|c| !c.is_ascii_digit())?;
    let parts: Vec<&str> = whole.split(sign).collect();
    let digits = |part: &&str| part.bytes().all(|byte| byte.is_ascii_digit());
    let first = (1..=3).contains(&parts[0].len()) && !parts[0].starts_with('0');
    let fits = first && parts.iter().all(digits) && parts[1..].iter().all(|part| part.len() == 3);
    (fits && signs.contains(&sign)).then(|| Groups {
        digits: parts.concat(),
        by_other: sign == other,
        certain: sign != other || parts.len() > 2,
    })
}

/// Returns true for a text of several numbers: what a wrong separator leaves together.
pub(super) fn is_several_numbers(text: &str) -> bool {
    let parts = text.split([',', ';', '\t', '|', ' ']).filter(|part| !part.is_empty());
    let numbers: Vec<bool> = parts.map(|part| part.parse::<f64>().is_ok()).collect();
    numbers.len() > 1 && numbers.iter().all(|is_number| *is_number)
}

#[cfg(test)]
mod tests {
    use super::*;
    use Content::*;

    #[test]
    fn numbers_are_read_by_the_decimal_sign() {
        let point = Notation { decimal: Decimal::Point, groups: false };
        let comma = Notation { decimal: Decimal::Comma, groups: false };
        for (text, by_point, by_comma) in [
            ("12", Number(12.0), Number(12.0)),
            ("-.5", Number(-0.5), Text),
            ("0,5", Text, Number(0.5)),
            ("-1,5E-3", Text, Number(-1.5e-3)),
            ("1,234", Ambiguous, Number(1.234)),
            ("1.234", Number(1.234), Ambiguous),
            ("1,234.5", Grouped(1234.5), Text),
            ("1.234,5", Text, Grouped(1234.5)),
            ("1,234,567", Grouped(1234567.0), Ambiguous),
            ("0,123", Text, Number(0.123)),
            ("1234,567.5", Text, Text),
            ("1\u{a0}234,5", Text, Number(1234.5)),
            ("1'234.5", Number(1234.5), Text),
            ("1.5D+03", Number(1500.0), Text),
            ("\u{2212}2e\u{2212}1", Number(-0.2), Number(-0.2)),
            ("1e999", Number(f64::INFINITY), Number(f64::INFINITY)),
            ("", Empty, Empty),
            ("NaN", Missing, Missing),
            ("-inf", Missing, Missing),
            ("0x10", Text, Text),
            ("2024-05-01", Text, Text),
            ("1.2.3", Text, Text),
            ("5.", Number(5.0), Text),
            ("e5", Text, Text),
            (".", Text, Text),
            ("1e", Text, Text),
            ("--1", Text, Text),
        ] {
            assert_eq!((point.content(text), comma.content(text)), (by_point, by_comma), "{text}");
        }
        let grouped = Notation { decimal: Decimal::Point, groups: true };
        assert_eq!(grouped.content("1,234"), Grouped(1234.0));
        assert_eq!(grouped.content("1,23"), Text);
        assert!(is_several_numbers("5;2") && is_several_numbers("1 2"));
        assert!(!is_several_numbers("5") && !is_several_numbers("band 0, narrow"));
    }
}
