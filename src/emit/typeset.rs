//! Names in typeset formulas.

/// The parts of a name: `n_dot_v` is a dot product; a Greek letter or a single one is a symbol;
/// what follows such a letter's underscore, and digits at a name's end, are an index.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Name<'a> {
    /// A dot product of the vectors of these names.
    Dot([&'a str; 2]),
    Word(&'a str),
    Indexed {
        word: &'a str,
        /// Empty where the index is a number.
        index: &'a str,
        /// Empty, or digits.
        number: &'a str,
    },
}

impl Name<'_> {
    pub fn of(name: &str) -> Name<'_> {
        if let Some((left, right)) = name.split_once("_dot_") {
            return Name::Dot([left, right]);
        }
        let stem = name.trim_end_matches(|c: char| c.is_ascii_digit());
        let number = &name[stem.len()..];
        let stem = stem.strip_suffix('_').unwrap_or(stem);
        match stem.split_once('_') {
            _ if stem.is_empty() => Name::Word(name),
            None if number.is_empty() => Name::Word(stem),
            None => Name::Indexed { word: stem, index: "", number },
            Some((word, index)) if word.len() == 1 || greek(word).is_some() => {
                Name::Indexed { word, index, number }
            }
            Some(_) => Name::Word(name),
        }
    }
}

/// Returns the Greek letter of this name, and its name in LaTeX.
pub(super) fn greek(word: &str) -> Option<(&'static str, &'static str)> {
    GREEK.iter().copied().find(|(name, _)| *name == word)
}

/// Letters by their names in LaTeX.
const GREEK: [(&str, &str); 34] = [
    ("alpha", "α"),
    ("beta", "β"),
    ("gamma", "γ"),
    ("delta", "δ"),
    ("epsilon", "ε"),
    ("zeta", "ζ"),
    ("eta", "η"),
    ("theta", "θ"),
    ("iota", "ι"),
    ("kappa", "κ"),
    ("lambda", "λ"),
    ("mu", "μ"),
    ("nu", "ν"),
    ("xi", "ξ"),
    ("pi", "π"),
    ("rho", "ρ"),
    ("sigma", "σ"),
    ("tau", "τ"),
    ("upsilon", "υ"),
    ("phi", "φ"),
    ("chi", "χ"),
    ("psi", "ψ"),
    ("omega", "ω"),
    ("Gamma", "Γ"),
    ("Delta", "Δ"),
    ("Theta", "Θ"),
    ("Lambda", "Λ"),
    ("Xi", "Ξ"),
    ("Pi", "Π"),
    ("Sigma", "Σ"),
    ("Upsilon", "Υ"),
    ("Phi", "Φ"),
    ("Psi", "Ψ"),
    ("Omega", "Ω"),
];
