//! "Did you mean": finds the known name nearest to an unknown one.

/// Returns the candidate that a misspelt name was probably meant to be, if any is near: by edit
/// distance (insertions, deletions, substitutions and swaps of neighbours, ignoring case) up to a
/// third of the longer name, or else one that `name` abbreviates (`nv` for `n_dot_v`). Ties go to
/// the first. Names over 100 bytes, and candidates after the first ten thousand, are not compared.
///
/// ```
/// use lgp::suggest::nearest;
/// let columns = ["n_dot_v", "roughness", "scale", "bias"];
/// assert_eq!(nearest("rougness", columns), Some("roughness"));
/// assert_eq!(nearest("bais", columns), Some("bias"));
/// assert_eq!(nearest("nv", columns), Some("n_dot_v"));
/// assert_eq!(nearest("temperature", columns), None);
/// ```
pub fn nearest<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    if name.len() > LONGEST {
        return None;
    }
    let name = name.to_lowercase();
    let mut best: Option<(usize, &str)> = None;
    let mut abbreviated = None;
    for candidate in candidates.into_iter().take(MOST) {
        if candidate.len() > LONGEST {
            continue;
        }
        let letters = candidate.to_lowercase();
        let distance = strsim::damerau_levenshtein(&name, &letters);
        let longer = name.chars().count().max(letters.chars().count());
        if distance <= longer.div_ceil(3) && best.is_none_or(|(least, _)| distance < least) {
            best = Some((distance, candidate));
        }
        if abbreviated.is_none() && abbreviates(&name, &letters) {
            abbreviated = Some(candidate);
        }
    }
    best.map(|(_, candidate)| candidate).or(abbreviated)
}

/// A comparison takes time by the product of the lengths: longer names would be slow.
const LONGEST: usize = 100;
/// By hand: a file may hold any number of names.
const MOST: usize = 10_000;

fn abbreviates(short: &str, long: &str) -> bool {
    let mut rest = long.chars();
    short.chars().count() >= 2
        && short.chars().next() == long.chars().next()
        && short.chars().all(|c| rest.any(|d| d == c))
}

/// Returns ``"; did you mean `x`?"``, or an empty string.
pub fn did_you_mean<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> String {
    nearest(name, candidates).map_or_else(String::new, |n| format!("; did you mean `{n}`?"))
}
