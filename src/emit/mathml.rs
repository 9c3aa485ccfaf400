//! MathML Core, which browsers typeset by themselves: a table with an equation for each statement.

use super::c_family;
use super::syntax::{Spelling, Syntax, WrittenHead, atom, negation, power, product, select, sum};
use super::typeset::{Name, greek};
use crate::op::Op;
use crate::program::format_constant;

pub(super) const SYNTAX: Syntax = Syntax {
    comment: "",
    spelling,
    power: Some("<msup>{a!}<mn>{#}</mn></msup>"),
    parentheses: ["<mrow><mo>(</mo>", "<mo>)</mo></mrow>"],
    signs: ["<mo>+</mo>", "<mo>−</mo>"],
    // Tags are most of the text.
    width: 1100,
    reserved: |_| false,
    written,
    literal,
    local: |_, name, value| row(name, value),
    non_finite: |name, _, bits| vec![row(&written(name), non_finite(bits))],
    open: |_, _, lines| {
        lines.push("<math display=\"block\"><mtable class=\"equations\">".to_owned());
    },
    close: |_: &Syntax, _: &WrittenHead, lines| lines.push("</mtable></math>".to_owned()),
    ..c_family::SYNTAX
};

/// The space between two factors.
const TIMES: &str = "<mspace width=\"0.17em\"/>";

fn spelling(op: Op) -> Spelling {
    match op {
        Op::Add => sum("{a+}<mo>+</mo>{b*}"),
        Op::Sub => sum("{a+}<mo>−</mo>{b*}"),
        Op::Mul => product("{a*}<mspace width=\"0.17em\"/>{b^}"),
        Op::Div => power("<mfrac><mrow>{a}</mrow><mrow>{b}</mrow></mfrac>"),
        Op::Neg => negation("<mrow><mo>−</mo>{a^}</mrow>"),
        Op::Abs => atom("<mrow><mo>|</mo>{a}<mo>|</mo></mrow>"),
        Op::Min => atom("<mrow><mi>min</mi><mo>(</mo>{a}<mo>,</mo>{b}<mo>)</mo></mrow>"),
        Op::Max => atom("<mrow><mi>max</mi><mo>(</mo>{a}<mo>,</mo>{b}<mo>)</mo></mrow>"),
        Op::Saturate => atom("<mrow><mi>sat</mi><mo>(</mo>{a}<mo>)</mo></mrow>"),
        Op::Mad => sum("{a*}<mspace width=\"0.17em\"/>{b^}<mo>+</mo>{c*}"),
        Op::Rcp => power("<mfrac><mn>1</mn><mrow>{a}</mrow></mfrac>"),
        Op::Sqrt => atom("<msqrt>{a}</msqrt>"),
        Op::Rsqrt => power("<mfrac><mn>1</mn><msqrt>{a}</msqrt></mfrac>"),
        Op::Exp2 => power("<msup><mn>2</mn><mrow>{a}</mrow></msup>"),
        Op::Log2 => atom("<mrow><msub><mi>log</mi><mn>2</mn></msub><mo>(</mo>{a}<mo>)</mo></mrow>"),
        Op::Exp => power("<msup><mi>e</mi><mrow>{a}</mrow></msup>"),
        Op::Log => atom("<mrow><mi>ln</mi><mo>(</mo>{a}<mo>)</mo></mrow>"),
        Op::Pow => power("<msup>{a!}<mrow>{b}</mrow></msup>"),
        Op::Sin => atom("<mrow><mi>sin</mi><mo>(</mo>{a}<mo>)</mo></mrow>"),
        Op::Cos => atom("<mrow><mi>cos</mi><mo>(</mo>{a}<mo>)</mo></mrow>"),
        Op::Tan => atom("<mrow><mi>tan</mi><mo>(</mo>{a}<mo>)</mo></mrow>"),
        Op::Asin => atom("<mrow><mi>arcsin</mi><mo>(</mo>{a}<mo>)</mo></mrow>"),
        Op::Acos => atom("<mrow><mi>arccos</mi><mo>(</mo>{a}<mo>)</mo></mrow>"),
        Op::Atan => atom("<mrow><mi>arctan</mi><mo>(</mo>{a}<mo>)</mo></mrow>"),
        Op::Atan2 => atom("<mrow><mi>atan2</mi><mo>(</mo>{a}<mo>,</mo>{b}<mo>)</mo></mrow>"),
        Op::Tanh => atom("<mrow><mi>tanh</mi><mo>(</mo>{a}<mo>)</mo></mrow>"),
        Op::Lerp => {
            atom("<mrow><mi>lerp</mi><mo>(</mo>{a}<mo>,</mo>{b}<mo>,</mo>{c}<mo>)</mo></mrow>")
        }
        Op::Step => atom("<mrow><mi>step</mi><mo>(</mo>{a}<mo>,</mo>{b}<mo>)</mo></mrow>"),
        Op::Select => select(
            "<mrow><mo>{</mo><mtable class=\"cases\"><mtr><mtd>{c}</mtd><mtd>{a+}<mo>&lt;</mo>{b+}</mtd></mtr>\
             <mtr><mtd>{d}</mtd><mtd><mtext>otherwise</mtext></mtd></mtr></mtable></mrow>",
        ),
        Op::Floor => atom("<mrow><mo>⌊</mo>{a}<mo>⌋</mo></mrow>"),
        Op::Fract => atom("<mrow><mi>fract</mi><mo>(</mo>{a}<mo>)</mo></mrow>"),
        Op::Sign => atom("<mrow><mi>sgn</mi><mo>(</mo>{a}<mo>)</mo></mrow>"),
    }
}

fn row(name: &str, value: &str) -> String {
    format!("<mtr><mtd>{name}</mtd><mtd><mo>=</mo>{}</mtd></mtr>", typeset(value))
}

/// Typesets a number; a space between two numbers would join them.
fn typeset(value: &str) -> String {
    value.replace(&format!("{TIMES}<mn>"), "<mo>·</mo><mn>")
}

fn literal(value: f32) -> String {
    let text = format_constant(value.abs());
    let number = match text.split_once('e') {
        Some((mantissa, exponent)) => format!(
            "<mrow><mn>{mantissa}</mn><mo>·</mo><msup><mn>10</mn><mn>{}</mn></msup></mrow>",
            exponent.replace('-', "−")
        ),
        None => format!("<mn>{text}</mn>"),
    };
    if value.is_sign_negative() { format!("<mrow><mo>−</mo>{number}</mrow>") } else { number }
}

fn non_finite(bits: u32) -> &'static str {
    match f32::from_bits(bits) {
        f32::INFINITY => "<mi>∞</mi>",
        f32::NEG_INFINITY => "<mrow><mo>−</mo><mi>∞</mi></mrow>",
        _ => "<mi>NaN</mi>",
    }
}

/// Typesets a name as in LaTeX; other words are written as they are.
fn written(name: &str) -> String {
    let vector = |name| format!("<mi class=\"vector\" mathvariant=\"normal\">{name}</mi>");
    let symbol = |word| greek(word).map_or(word, |(_, letter)| letter);
    match Name::of(name) {
        Name::Dot([left, right]) => {
            format!("<mrow><mo>(</mo>{}<mo>·</mo>{}<mo>)</mo></mrow>", vector(left), vector(right))
        }
        Name::Word(word) => format!("<mi>{}</mi>", symbol(word)),
        Name::Indexed { word, index: "", number } => {
            format!("<msub><mi>{}</mi><mn>{number}</mn></msub>", symbol(word))
        }
        Name::Indexed { word, index, number } => {
            format!("<msub><mi>{}</mi><mi>{index}{number}</mi></msub>", symbol(word))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_typeset() {
        for (name, expected) in [
            ("alpha", "<mi>α</mi>"),
            ("t12", "<msub><mi>t</mi><mn>12</mn></msub>"),
            ("theta_max", "<msub><mi>θ</mi><mi>max</mi></msub>"),
            ("cos_theta", "<mi>cos_theta</mi>"),
            ("roughness", "<mi>roughness</mi>"),
            ("_", "<mi>_</mi>"),
        ] {
            assert_eq!(written(name), expected);
        }
    }

    #[test]
    fn numbers_have_a_dot_between() {
        let product = format!("<mn>2</mn>{TIMES}<mn>3</mn>");
        assert_eq!(typeset(&product), "<mn>2</mn><mo>·</mo><mn>3</mn>");
        assert!(literal(1e-9).contains("<mn>−9</mn>"));
    }
}
