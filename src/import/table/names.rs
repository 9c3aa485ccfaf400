//! Columns' names made identifiers.

use super::units::is_unit;
use crate::dataset::LONGEST_NAME;
use std::collections::{HashMap, HashSet};

/// A column's heading.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Heading {
    /// As the file has it, on one line.
    pub written: String,
    /// An identifier.
    pub name: String,
    pub unit: String,
}

/// Letters that names are often made of, in ASCII.
const LETTERS: [(&str, &str); 44] = [
    ("α", "alpha"),
    ("β", "beta"),
    ("γ", "gamma"),
    ("δ", "delta"),
    ("ε", "epsilon"),
    ("ζ", "zeta"),
    ("η", "eta"),
    ("θ", "theta"),
    ("ϑ", "theta"),
    ("κ", "kappa"),
    ("λ", "lambda"),
    ("μ", "mu"),
    ("µ", "mu"),
    ("ν", "nu"),
    ("ξ", "xi"),
    ("π", "pi"),
    ("ρ", "rho"),
    ("σ", "sigma"),
    ("τ", "tau"),
    ("φ", "phi"),
    ("ϕ", "phi"),
    ("χ", "chi"),
    ("ψ", "psi"),
    ("ω", "omega"),
    ("δ", "delta"),
    ("ä", "ae"),
    ("ö", "oe"),
    ("ü", "ue"),
    ("ß", "ss"),
    ("å", "a"),
    ("à", "a"),
    ("á", "a"),
    ("â", "a"),
    ("ç", "c"),
    ("è", "e"),
    ("é", "e"),
    ("ê", "e"),
    ("í", "i"),
    ("ñ", "n"),
    ("ó", "o"),
    ("ô", "o"),
    ("ø", "o"),
    ("ú", "u"),
    ("²", "2"),
];

/// Makes headings of what a file calls its columns. An identifier stays as it is. Of other names
/// the unit is taken away, the rest is in lower case, and what is no letter or digit becomes `_`;
/// a number gets a `_` before it, and a name that occurs already a number after it.
pub(super) fn headings(written: &[String]) -> Vec<Heading> {
    // Identifiers first: another name may become one of them.
    let kept = written.iter().filter(|name| is_identifier(name)).cloned();
    let mut taken: HashSet<String> = kept.collect();
    let mut numbers = HashMap::new();
    let heading = |(place, written): (usize, &String)| {
        let on_a_line = written.split_whitespace().collect::<Vec<_>>().join(" ");
        if is_identifier(written) {
            return Heading { written: on_a_line, name: written.clone(), unit: String::new() };
        }
        let (name, unit) = without_unit(&on_a_line);
        let name = match identifier(name) {
            name if name.is_empty() => format!("column_{}", place + 1),
            name => name,
        };
        let name = free_name(name, &mut taken, &mut numbers);
        Heading { name, unit: unit.to_owned(), written: on_a_line }
    };
    written.iter().enumerate().map(heading).collect()
}

/// Returns the name, numbered where it is taken; `numbers` are the last ones by name.
fn free_name(
    name: String,
    taken: &mut HashSet<String>,
    numbers: &mut HashMap<String, usize>,
) -> String {
    let mut free = name.clone();
    while !taken.insert(free.clone()) {
        let number = numbers.entry(name.clone()).or_insert(1);
        *number += 1;
        free = format!("{name}_{number}");
    }
    free
}

/// Returns true for a name that stays as it is.
pub(super) fn is_identifier(name: &str) -> bool {
    let starts = name.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_');
    let fits = name.len() <= LONGEST_NAME;
    starts && fits && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
}

/// Takes a unit from the end of a name: in square brackets any, in round ones a known one, a `%`.
fn without_unit(name: &str) -> (&str, &str) {
    for (open, close, known) in [('[', ']', false), ('(', ')', true)] {
        let Some(inner) = name.strip_suffix(close) else { continue };
        let Some((before, unit)) = inner.split_once(open) else { continue };
        let unit = unit.trim();
        let usable = !unit.is_empty() && unit.len() <= LONGEST_NAME && !before.trim().is_empty();
        // As in `CO(GT)`, which is no giga-tesla.
        let is_initials = !before.ends_with(' ')
            && unit.len() > 1
            && unit.bytes().all(|byte| byte.is_ascii_uppercase());
        if usable && (!known || is_unit(unit) && !is_initials) {
            return (before.trim_end(), unit);
        }
    }
    match name.strip_suffix('%') {
        Some(before) if !before.trim().is_empty() => (before.trim_end(), "%"),
        _ => (name, ""),
    }
}

fn identifier(name: &str) -> String {
    let mut letters = name.to_lowercase();
    for (letter, ascii) in LETTERS {
        if letters.contains(letter) {
            letters = letters.replace(letter, ascii);
        }
    }
    let words = letters.split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| !word.is_empty());
    let joined = words.collect::<Vec<_>>().join("_");
    let joined: String = joined.chars().take(LONGEST_NAME / 2).collect();
    match joined.starts_with(|c: char| c.is_ascii_digit()) {
        true => format!("_{joined}"),
        false => joined,
    }
}

/// Names for columns that have none: `x0`, `x1`, … and `y`, or `y0`, `y1`, … for several outputs.
pub(super) fn numbered(columns: usize, inputs: usize) -> Vec<String> {
    let outputs = columns - inputs.min(columns);
    let output = |index: usize| if outputs == 1 { "y".into() } else { format!("y{index}") };
    let inputs = (0..columns - outputs).map(|index| format!("x{index}"));
    inputs.chain((0..outputs).map(output)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_become_identifiers_and_units() {
        for (written, name, unit) in [
            ("Albedo", "Albedo", ""),
            ("CO(GT)", "co_gt", ""),
            ("PT08.S1(CO)", "pt08_s1_co", ""),
            ("Wavelength (nm)", "wavelength", "nm"),
            ("E (W/m^2/nm)", "e", "W/m^2/nm"),
            ("T (°C)", "t", "°C"),
            ("λ[nm]", "lambda", "nm"),
            ("Δ θ", "delta_theta", ""),
            ("temp_Annual_%", "temp_annual", "%"),
            ("Result (mean)", "result_mean", ""),
            ("n·v", "n_v", ""),
            ("1", "_1", ""),
            ("Größe\n(mm)", "groesse", "mm"),
            ("", "column_1", ""),
            ("日本", "column_1", ""),
            ("Unnamed: 0", "unnamed_0", ""),
            ("%", "column_1", ""),
        ] {
            let [heading] = &headings(&[written.to_owned()])[..] else { panic!() };
            assert_eq!((heading.name.as_str(), heading.unit.as_str()), (name, unit), "{written}");
        }
        let alike = headings(&["a b", "a_b", "a-b", "A B"].map(String::from));
        let names: Vec<&str> = alike.iter().map(|heading| heading.name.as_str()).collect();
        assert_eq!(names, ["a_b_2", "a_b", "a_b_3", "a_b_4"]);
        assert_eq!(numbered(3, 2), ["x0", "x1", "y"]);
        assert_eq!(numbered(3, 1), ["x0", "y0", "y1"]);
    }
}
