/// The candidate a misspelt name was probably meant to be, if any is near:
/// by edit distance (insertions, deletions, substitutions and swaps of
/// neighbours, ignoring case) up to a third of the longer name, or else one
/// that `name` abbreviates (`nv` for `n_dot_v`). Ties go to the first.
pub fn nearest<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let name = lowercase(name);
    let mut best: Option<(usize, &str)> = None;
    let mut abbreviated = None;
    for candidate in candidates {
        let letters = lowercase(candidate);
        let distance = edit_distance(&name, &letters);
        let near = distance <= name.len().max(letters.len()).div_ceil(3);
        if near && best.is_none_or(|(least, _)| distance < least) {
            best = Some((distance, candidate));
        }
        if abbreviated.is_none() && abbreviates(&name, &letters) {
            abbreviated = Some(candidate);
        }
    }
    best.map(|(_, candidate)| candidate).or(abbreviated)
}

fn lowercase(text: &str) -> Vec<char> {
    text.chars().flat_map(char::to_lowercase).collect()
}

fn abbreviates(short: &[char], long: &[char]) -> bool {
    let mut rest = long.iter();
    short.len() >= 2 && short.first() == long.first() && short.iter().all(|c| rest.any(|d| d == c))
}

fn edit_distance(a: &[char], b: &[char]) -> usize {
    let mut before_last = vec![0; b.len() + 1];
    let mut last: Vec<usize> = (0..=b.len()).collect();
    for i in 1..=a.len() {
        let mut row = vec![i; b.len() + 1];
        for j in 1..=b.len() {
            let substituted = last[j - 1] + usize::from(a[i - 1] != b[j - 1]);
            row[j] = substituted.min(last[j] + 1).min(row[j - 1] + 1);
            let swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
            if swapped {
                row[j] = row[j].min(before_last[j - 2] + 1);
            }
        }
        before_last = std::mem::replace(&mut last, row);
    }
    last[b.len()]
}

#[cfg(test)]
mod tests {
    use super::nearest;

    const COLUMNS: [&str; 4] = ["n_dot_v", "roughness", "scale", "bias"];

    #[test]
    fn finds_misspellings_swaps_and_abbreviations() {
        for (typed, meant) in [
            ("roughnes", "roughness"),
            ("Roughness", "roughness"),
            ("bais", "bias"),
            ("ndotv", "n_dot_v"),
            ("nv", "n_dot_v"),
            ("rough", "roughness"),
        ] {
            assert_eq!(nearest(typed, COLUMNS), Some(meant), "{typed}");
        }
    }

    #[test]
    fn suggests_nothing_far_away() {
        assert_eq!(nearest("temperature", COLUMNS), None);
        assert_eq!(nearest("", COLUMNS), None);
        assert_eq!(nearest("bias", []), None);
    }
}
