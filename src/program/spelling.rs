//! Spells expressions, in formula text and in languages: a template for each operation, and as few
//! signs as possible.

use crate::op::Op;

/// How tightly a piece of code binds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Binding {
    Select,
    Sum,
    Product,
    Negation,
    Power,
    Atom,
}

/// The spelling of an operation: `{a}`, `{b}`, `{c}`, `{d}` stand for its arguments, and a mark
/// says how tightly the argument must bind to need no parentheses: none anything, `+` a sum, `*` a
/// product, `-` a negation, `^` a power, `!` an atom. Other braces are the language's.
pub(crate) struct Spelling {
    pub template: &'static str,
    pub binding: Binding,
}

pub(crate) const fn select(template: &'static str) -> Spelling {
    Spelling { template, binding: Binding::Select }
}

pub(crate) const fn sum(template: &'static str) -> Spelling {
    Spelling { template, binding: Binding::Sum }
}

pub(crate) const fn product(template: &'static str) -> Spelling {
    Spelling { template, binding: Binding::Product }
}

pub(crate) const fn negation(template: &'static str) -> Spelling {
    Spelling { template, binding: Binding::Negation }
}

pub(crate) const fn power(template: &'static str) -> Spelling {
    Spelling { template, binding: Binding::Power }
}

pub(crate) const fn atom(template: &'static str) -> Spelling {
    Spelling { template, binding: Binding::Atom }
}

/// An argument in a template, and how tightly it must bind there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct ArgumentPlace {
    pub argument: usize,
    pub least: Binding,
}

/// Splits a template into its places, each after the text before it, and the text after the last.
pub(crate) fn pieces(template: &str) -> (Vec<(&str, ArgumentPlace)>, &str) {
    let mut pieces = Vec::new();
    let (mut start, mut from) = (0, 0);
    while let Some(brace) = template[from..].find('{').map(|i| from + i) {
        match place(&template[brace..]) {
            Some((place, length)) => {
                pieces.push((&template[start..brace], place));
                from = brace + length;
                start = from;
            }
            None => from = brace + 1,
        }
    }
    (pieces, &template[start..])
}

/// Reads the place at the start of the text; returns it and its length.
pub(crate) fn place(text: &str) -> Option<(ArgumentPlace, usize)> {
    let (name, end) = match text.as_bytes() {
        [b'{', name @ b'a'..=b'd', b'}', ..] => (*name, 2),
        [b'{', name @ b'a'..=b'd', _, b'}', ..] => (*name, 3),
        _ => return None,
    };
    let least = match &text[2..end] {
        "" => Binding::Select,
        "+" => Binding::Sum,
        "*" => Binding::Product,
        "-" => Binding::Negation,
        "^" => Binding::Power,
        "!" => Binding::Atom,
        _ => return None,
    };
    Some((ArgumentPlace { argument: usize::from(name - b'a'), least }, end + 1))
}

/// The text that a reader of a value writes for it.
#[derive(Clone, Debug)]
pub(crate) struct Written {
    pub text: String,
    pub binding: Binding,
    /// The negated value, where that takes a sign away.
    pub negated: Option<(String, Binding)>,
}

impl Written {
    pub fn new(text: String, binding: Binding) -> Written {
        Written { text, binding, negated: None }
    }

    pub fn name(text: String) -> Written {
        Written::new(text, Binding::Atom)
    }

    /// Writes a number, given the text of numbers without a sign.
    pub fn number(value: f32, literal: impl Fn(f32) -> String) -> Written {
        if !value.is_sign_negative() {
            return Written::name(literal(value));
        }
        let negated = Some((literal(-value), Binding::Atom));
        Written { text: literal(value), binding: Binding::Negation, negated }
    }

    /// Returns the negated value, where that takes a sign away.
    pub fn turned(&self) -> Option<Written> {
        let (text, binding) = self.negated.clone()?;
        Some(Written::new(text, binding))
    }
}

/// Reorders an operation's arguments so that the fewest signs are written. This is exact: a rounded
/// result is that of the negated arguments, negated, and a sum is the difference from the negated
/// term.
pub(crate) fn move_signs<T: Clone>(op: Op, args: &mut [T], turned: impl Fn(&T) -> Option<T>) {
    let [first, second] = args else { return };
    match (op, turned(first), turned(second)) {
        (Op::Add, Some(_), None) => std::mem::swap(first, second),
        (Op::Sub, Some(a), Some(b)) => (*first, *second) = (b, a),
        (Op::Mul | Op::Div, Some(a), Some(b)) => (*first, *second) = (a, b),
        _ => {}
    }
}

/// Negates a product or quotient, where that takes a sign away.
pub(crate) fn negated_product(
    spelling: &Spelling,
    args: &[&Written],
    parentheses: [&str; 2],
    signs: [&str; 2],
) -> Option<(String, Binding)> {
    let first = args.iter().position(|arg| arg.negated.is_some())?;
    let turned = args[first].turned()?;
    let mut args = args.to_vec();
    args[first] = &turned;
    Some((filled(spelling, &args, parentheses, signs), spelling.binding))
}

/// Fills a template with arguments; a plus or minus before an argument changes where that takes a
/// sign away.
pub(crate) fn filled(
    spelling: &Spelling,
    args: &[&Written],
    [open, close]: [&str; 2],
    signs: [&str; 2],
) -> String {
    let (places, rest) = pieces(spelling.template);
    let mut text = String::new();
    for (before, place) in places {
        let turned = args[place.argument].turned();
        let (before, arg) = match (&turned, other_sign(before, signs)) {
            (Some(turned), Some(before)) => (before, turned),
            _ => (before.to_owned(), args[place.argument]),
        };
        text.push_str(&before);
        if arg.binding >= place.least {
            text.push_str(&arg.text);
        } else {
            text.extend([open, &arg.text, close]);
        }
    }
    text + rest
}

/// Exchanges the plus or minus at the end of the text.
fn other_sign(before: &str, [plus, minus]: [&str; 2]) -> Option<String> {
    let exchanged = |from: &str, to: &str| Some(before.strip_suffix(from)?.to_owned() + to);
    exchanged(plus, minus).or_else(|| exchanged(minus, plus))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::op::MAX_ARITY;

    #[test]
    fn braces_around_no_argument_are_text() {
        let (places, rest) = pieces(r"\frac{{a}}{{b+}} {e} {a.} { d }");
        let [("\\frac{", a), ("}{", b)] = places[..] else { panic!("{places:?}") };
        assert_eq!(a, ArgumentPlace { argument: 0, least: Binding::Select });
        assert_eq!(b, ArgumentPlace { argument: 1, least: Binding::Sum });
        assert_eq!(rest, "} {e} {a.} { d }");
        assert_eq!(MAX_ARITY, ["a", "b", "c", "d"].len());
    }
}
