//! LaTeX: an amsmath `align*` with an equation for each statement.

use super::c_family;
use super::language::{Entry, Form};
use super::syntax::{Spelling, Syntax, WrittenHead, atom, negation, power, product, select, sum};
use super::typeset::{Name, greek};
use crate::op::Op;
use crate::program::format_constant;

pub(super) const LANGUAGE: Entry = Entry {
    name: "latex",
    aliases: &["tex"],
    extension: "tex",
    form: Form::Function(&SYNTAX),
    half: None,
};

/// The mark of the comment that says what is computed of what, which equations do not.
pub(super) const COLUMNS: &str = "columns:";

pub(super) const SYNTAX: Syntax = Syntax {
    comment: "%",
    states_head: true,
    spelling,
    power: Some("{a!}^{{#}}"),
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

fn close(_: &Syntax, _: &WrittenHead, lines: &mut Vec<String>) {
    // A break after the last row would leave an empty one.
    if let Some(last) = lines.last_mut() {
        *last = last.trim_end_matches(r" \\").to_owned();
    }
    lines.push(r"\end{align*}".to_owned());
}

/// Typesets a number; a space between two numbers would join them.
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

/// Typesets a name by the parts that [`Name`] finds; words of several letters are upright.
pub(super) fn written(name: &str) -> String {
    let upright = |word: &str| format!(r"\mathrm{{{}}}", word.replace('_', r"\_"));
    let symbol = |word: &str| match greek(word) {
        Some((name, _)) => format!(r"\{name}"),
        None if word.len() == 1 && word != "_" => word.to_owned(),
        None => upright(word),
    };
    match Name::of(name) {
        Name::Dot(vectors) => {
            let [left, right] = vectors.map(|name| upright(name).replace("mathrm", "mathbf"));
            format!(r"({left} \cdot {right})")
        }
        Name::Word(word) => symbol(word),
        Name::Indexed { word, index: "", number } => format!("{}_{{{number}}}", symbol(word)),
        Name::Indexed { word, index, number } => {
            format!("{}_{{{}}}", symbol(word), upright(&format!("{index}{number}")))
        }
    }
}

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
