//! Units of columns, as headers write them.

/// The symbols that count as units. By hand, of optics, photometry and laboratory tables: another
/// text in brackets may be a part of the name, as in `CO(GT)`.
const SYMBOLS: &str = "\
    m s g t K C F N J W V A Hz Pa bar mol l L cd lm lx sr rad deg min h d eV S ohm Ohm Ω T Wb H \
    px counts count cts arb a.u. au nit nits stop stops EV dB ppm ppb ppt rpm mph inch in ft lb psi \
    degree degrees degC degF percent dimensionless none seconds second sec ms hours days years year \
    °C °F ° % ‰ $ € £ Å angstrom Angstrom micron microns pixel pixels point points unitless units \
    unit 1/sr 1";

const PREFIXES: [&str; 13] = ["", "n", "u", "µ", "μ", "m", "c", "d", "k", "M", "G", "T", "p"];

/// Returns true for a unit such as `nm`, `W/m^2/nm`, `W m⁻² sr⁻¹`, `%` or `arb. units`.
pub(super) fn is_unit(text: &str) -> bool {
    let text = text.trim();
    if text.is_empty() || text.len() > 60 {
        return false;
    }
    let between = |c: char| matches!(c, '/' | '*' | '·' | '⋅' | ' ' | '.' | '(' | ')');
    SYMBOLS.split_whitespace().any(|symbol| symbol == text)
        || text.split(between).filter(|part| !part.is_empty()).all(is_factor)
            && text.chars().any(char::is_alphanumeric)
}

/// A symbol with a prefix and a power.
fn is_factor(factor: &str) -> bool {
    let power = |c: char| c.is_ascii_digit() || "^-+⁻⁰¹²³⁴⁵⁶⁷⁸⁹".contains(c);
    let symbol = factor.trim_end_matches(power);
    if symbol.is_empty() {
        return factor == "1";
    }
    PREFIXES.iter().any(|prefix| {
        let base = symbol.strip_prefix(prefix).filter(|base| !base.is_empty());
        base.is_some_and(|base| SYMBOLS.split_whitespace().any(|known| known == base))
    })
}

/// Returns the unit that a cell of a row of units states, empty for none; `None` if it is no unit.
pub(super) fn stated(cell: &str) -> Option<String> {
    let bare = cell.trim();
    if bare.chars().all(|c| matches!(c, '-' | '–' | '—' | ':' | '=')) {
        return Some(String::new());
    }
    for (open, close) in [('(', ')'), ('[', ']')] {
        let inner = bare.strip_prefix(open).and_then(|inner| inner.strip_suffix(close));
        if let Some(inner) = inner.filter(|inner| !inner.contains([open, close])) {
            return Some(inner.trim().to_owned());
        }
    }
    is_unit(bare).then(|| bare.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_are_known_from_words() {
        let units = "nm|µm|W/m^2/nm|W m⁻² sr⁻¹|%|°C|a.u.|arb. units|1/sr|kHz|mm^2|cm-1|deg";
        for unit in units.split('|') {
            assert!(is_unit(unit), "{unit}");
        }
        for word in ["red", "", "mean", "x", "two words", "()", "CO", "narrow", "a/b"] {
            assert!(!is_unit(word), "{word}");
        }
        assert_eq!(stated("[foo]"), Some("foo".into()));
        assert_eq!((stated("-"), stated("1")), (Some(String::new()), Some("1".into())));
        assert_eq!(stated("red"), None);
    }
}
