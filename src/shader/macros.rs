//! How long a text becomes by its macros, before they are expanded: a few lines can become as many
//! tokens as there are atoms.

use super::glsl::without_comments;
use std::collections::HashMap;

/// The most words that macros may make of a text. By hand: those of the largest files.
const MOST_WORDS: u64 = 4_000_000;

/// The words of a macro: its own, and as many for each word that it is given.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Growth {
    own: u64,
    by_argument: u64,
}

/// Returns the place of the macro by which a text becomes too long, if one is.
pub(super) fn explosion(text: &str) -> Option<usize> {
    if !text.contains("define") {
        return None;
    }
    let code = without_comments(text);
    let mut macros: HashMap<&str, Growth> = HashMap::new();
    let mut total: u64 = 0;
    let mut last = 0;
    for (at, line) in logical_lines(&code) {
        let Some(directive) = line.trim_start().strip_prefix('#') else {
            let words = tokens(line);
            total = total.saturating_add(weight(&words, &macros, &[], 1));
            if total > MOST_WORDS {
                return Some(last);
            }
            continue;
        };
        let Some((name, parameters, body)) = definition(directive) else { continue };
        let words = tokens(body);
        let own = weight(&words, &macros, &parameters, 0);
        let by_argument = weight(&words, &macros, &parameters, 1).saturating_sub(own);
        if own.max(by_argument) > MOST_WORDS {
            return Some(at);
        }
        // Which of several definitions holds depends on conditions.
        let known = macros.entry(name).or_default();
        *known =
            Growth { own: known.own.max(own), by_argument: known.by_argument.max(by_argument) };
        last = at;
    }
    None
}

/// Returns name, parameters and body of `define NAME(…) …`.
fn definition(directive: &str) -> Option<(&str, Vec<&str>, &str)> {
    let rest = directive.trim_start().strip_prefix("define")?.trim_start();
    let length = rest.find(|c: char| !(c.is_ascii_alphanumeric() || c == '_'));
    let (name, rest) = rest.split_at(length.unwrap_or(rest.len()));
    let list = rest.strip_prefix('(').and_then(|rest| rest.split_once(')'));
    let (parameters, body) = list.unwrap_or(("", rest));
    Some((name, parameters.split(',').map(str::trim).collect(), body))
}

/// Returns the number of words that these become, parameters counting for so many.
fn weight(
    words: &[&str],
    macros: &HashMap<&str, Growth>,
    parameters: &[&str],
    of_parameter: u64,
) -> u64 {
    let mut sum: u64 = 0;
    let mut at = 0;
    while at < words.len() {
        let word = words[at];
        at += 1;
        let grown = match macros.get(word) {
            _ if parameters.contains(&word) => of_parameter,
            None => 1,
            Some(growth) => {
                let end = at + bracketed(&words[at..]);
                let given = weight(&words[at..end], macros, parameters, of_parameter);
                at = end;
                growth.own.saturating_add(growth.by_argument.saturating_mul(given)).max(given)
            }
        };
        sum = sum.saturating_add(grown);
    }
    sum
}

/// Returns the number of words of the bracket that these begin with, if they begin with one.
fn bracketed(words: &[&str]) -> usize {
    let mut depth = 0;
    for (at, word) in words.iter().enumerate() {
        match *word {
            "(" => depth += 1,
            ")" => depth -= 1,
            _ => {}
        }
        if depth <= 0 {
            return if at == 0 { 0 } else { at + 1 };
        }
    }
    words.len()
}

/// Returns words and round brackets.
fn tokens(text: &str) -> Vec<&str> {
    let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let mut found = Vec::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let length = match is_part(first) {
            true => rest.find(|c| !is_part(c)).unwrap_or(rest.len()),
            false => first.len_utf8(),
        };
        let (token, after) = rest.split_at(length);
        if is_part(first) || matches!(first, '(' | ')') {
            found.push(token);
        }
        rest = after;
    }
    found
}

/// Returns lines with their places; a `\` at the end of one has it go on.
fn logical_lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let mut at = 0;
    std::iter::from_fn(move || {
        let start = at;
        loop {
            let length = text[at..].find('\n').map_or(text.len() - at, |length| length + 1);
            at += length;
            let ended = text[start..at].trim_end_matches(['\r', '\n']);
            if length == 0 || !ended.ends_with('\\') {
                return (at > start).then(|| (start, &text[start..at]));
            }
        }
    })
}

#[cfg(test)]
mod tests {
    use super::explosion;

    #[test]
    fn macros_of_libraries_are_harmless() {
        let text = "#define PI 3.14159\n#define TAU (2.0*PI)\n#define SQ(x) ((x)*(x))\n\
            #define LONG(a, b) \\\n  (SQ(a) + \\\n SQ(b))\n#ifdef X\n#undef PI\n#endif\n\
            float f(float x) { return SQ(SQ(SQ(SQ(LONG(x, TAU))))); }\n";
        assert_eq!(explosion(text), None);
        assert_eq!(explosion(&text.repeat(1000)), None);
    }

    #[test]
    fn what_doubles_is_found() {
        let doubled: String =
            (1..40).map(|i| format!("#define A{i} A{} + A{}\n", i - 1, i - 1)).collect();
        assert!(explosion(&format!("{doubled}float x = A39;")).is_some());
        let nested = format!("{}x{}", "D(".repeat(60), ")".repeat(60));
        let text = format!("// define\n#define D(x) x + x\nfloat y = {nested};");
        assert_eq!(explosion(&text), Some(10));
        let by_bodies: String =
            (1..40).map(|i| format!("#define B{i}(x) B{}(x) B{}(x)\n", i - 1, i - 1)).collect();
        assert!(explosion(&format!("#define B0(x) x\n{by_bodies}float x = B39(1);")).is_some());
    }

    #[test]
    fn no_text_makes_it_fail() {
        let text = "#define A(x, y) ((x\\\n)) A(A(\n#define\n# define é(\n#define B() A\nA(B()(((";
        for end in 0..=text.len() {
            if text.is_char_boundary(end) {
                explosion(&text[..end]);
            }
        }
    }
}
