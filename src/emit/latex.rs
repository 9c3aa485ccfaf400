//! LaTeX: an `align*` of amsmath, an equation a statement.

use super::c_family;
use super::syntax::{
    Signature, Spelling, Syntax, atom, is_word, negation, power, product, select, sum,
};
use crate::op::Op;
use crate::program::format_constant;

pub(super) const SYNTAX: Syntax = Syntax {
    comment: "%",
    spelling,
    power: Some("{a!}^{{n}}"),
    parentheses: [r"\left(", r"\right)"],
    width: 200,
    reserved: |_| false,
    written,
    literal,
    local: |_, name, value| format!(r"{name} &= {} \\", typeset(value)),
    non_finite: |name, _, bits| vec![format!(r"{} &= {} \\", written(name), non_finite(bits))],
    open: |_, _, lines| lines.push(r"\begin{align*}".to_owned()),
    close,
    ..c_family::SYNTAX
};

fn spelling(op: Op) -> Spelling {
    match op {
        Op::Add => sum("{a+} + {b*}"),
        Op::Sub => sum("{a+} - {b*}"),
        Op::Mul => product(r"{a*}\,{b^}"),
        Op::Div => atom(r"\frac{{a}}{{b}}"),
        Op::Neg => negation("-{a^}"),
        Op::Abs => atom(r"\left|{a}\right|"),
        Op::Min => atom(r"\min\left({a}, {b}\right)"),
        Op::Max => atom(r"\max\left({a}, {b}\right)"),
        Op::Saturate => atom(r"\operatorname{sat}\left({a}\right)"),
        Op::Mad => sum(r"{a*}\,{b^} + {c*}"),
        Op::Rcp => atom(r"\frac{1}{{a}}"),
        Op::Sqrt => atom(r"\sqrt{{a}}"),
        Op::Rsqrt => atom(r"\frac{1}{\sqrt{{a}}}"),
        Op::Exp2 => power("2^{{a}}"),
        Op::Log2 => atom(r"\log_2\left({a}\right)"),
        Op::Exp => power("e^{{a}}"),
        Op::Log => atom(r"\ln\left({a}\right)"),
        Op::Pow => power("{a!}^{{b}}"),
        Op::Sin => atom(r"\sin\left({a}\right)"),
        Op::Cos => atom(r"\cos\left({a}\right)"),
        Op::Tan => atom(r"\tan\left({a}\right)"),
        Op::Asin => atom(r"\arcsin\left({a}\right)"),
        Op::Acos => atom(r"\arccos\left({a}\right)"),
        Op::Atan => atom(r"\arctan\left({a}\right)"),
        Op::Atan2 => atom(r"\operatorname{atan2}\left({a}, {b}\right)"),
        Op::Tanh => atom(r"\tanh\left({a}\right)"),
        Op::Lerp => atom(r"\operatorname{lerp}\left({a}, {b}, {c}\right)"),
        Op::Step => atom(r"\operatorname{step}\left({a}, {b}\right)"),
        Op::Select => {
            select(r"\begin{cases} {c} & {a+} < {b+} \\ {d} & \text{otherwise} \end{cases}")
        }
        Op::Floor => atom(r"\left\lfloor {a} \right\rfloor"),
        Op::Fract => atom(r"\operatorname{fract}\left({a}\right)"),
        Op::Sign => atom(r"\operatorname{sgn}\left({a}\right)"),
    }
}

fn close(_: &Syntax, _: &Signature, lines: &mut Vec<String>) {
    // A break after the last row would leave an empty one.
    if let Some(last) = lines.last_mut() {
        *last = last.trim_end_matches(r" \\").to_owned();
    }
    lines.push(r"\end{align*}".to_owned());
}

/// A space between two numbers would join them.
fn typeset(value: &str) -> String {
    let mut factors = value.split(r"\,");
    let mut text = factors.next().unwrap_or("").to_owned();
    for factor in factors {
        let is_number = factor.starts_with(|c: char| c.is_ascii_digit());
        text.extend([if is_number { r" \cdot " } else { r"\," }, factor]);
    }
    text
}

fn literal(value: f32) -> String {
    match format_constant(value).split_once('e') {
        Some((mantissa, exponent)) => format!(r"{mantissa}\mathrm{{e}}{{{exponent}}}"),
        None => format_constant(value),
    }
}

fn non_finite(bits: u32) -> &'static str {
    match f32::from_bits(bits) {
        f32::INFINITY => r"\infty",
        f32::NEG_INFINITY => r"-\infty",
        _ => r"\mathrm{NaN}",
    }
}

/// `n_dot_v` as a dot product, a Greek letter or a single one as a symbol, what follows an
/// underscore and digits at the end as an index, and other words upright.
fn written(name: &str) -> String {
    if let Some((left, right)) = name.split_once("_dot_") {
        return format!(r"({} \cdot {})", vector(left), vector(right));
    }
    let digits = name.len() - name.trim_end_matches(|c: char| c.is_ascii_digit()).len();
    let (word, number) = name.split_at(name.len() - digits);
    let word = word.strip_suffix('_').unwrap_or(word);
    match (word.split_once('_'), number) {
        _ if word.is_empty() => format!(r"\mathrm{{{}}}", escaped(name)),
        (None, "") => symbol(word),
        (None, number) => format!("{}_{{{number}}}", symbol(word)),
        (Some(_), _) if symbol(word.split('_').next().unwrap_or("")).starts_with(r"\mathrm") => {
            format!(r"\mathrm{{{}}}", escaped(name))
        }
        (Some((word, index)), number) => {
            format!(r"{}_{{\mathrm{{{}{number}}}}}", symbol(word), escaped(index))
        }
    }
}

fn vector(name: &str) -> String {
    format!(r"\mathbf{{{}}}", escaped(name))
}

fn symbol(word: &str) -> String {
    match word {
        _ if is_word(GREEK, word) => format!(r"\{word}"),
        _ if word.len() == 1 => word.to_owned(),
        _ => format!(r"\mathrm{{{word}}}"),
    }
}

fn escaped(name: &str) -> String {
    name.replace('_', r"\_")
}

const GREEK: &str = "alpha beta gamma delta epsilon zeta eta theta iota kappa lambda mu nu xi pi \
    rho sigma tau upsilon phi chi psi omega Gamma Delta Theta Lambda Xi Pi Sigma Upsilon Phi Psi \
    Omega";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_typeset() {
        for (name, expected) in [
            ("n_dot_v", r"(\mathbf{n} \cdot \mathbf{v})"),
            ("alpha", r"\alpha"),
            ("r", "r"),
            ("t12", "t_{12}"),
            ("F0", "F_{0}"),
            ("f_0", "f_{0}"),
            ("theta_max", r"\theta_{\mathrm{max}}"),
            ("cos_theta", r"\mathrm{cos\_theta}"),
            ("roughness", r"\mathrm{roughness}"),
            ("_", r"\mathrm{\_}"),
        ] {
            assert_eq!(written(name), expected);
        }
    }

    #[test]
    fn numbers_side_by_side_have_a_dot_between() {
        assert_eq!(typeset(r"a\,2\,b\,\frac{1}{c}"), r"a \cdot 2\,b\,\frac{1}{c}");
    }
}
