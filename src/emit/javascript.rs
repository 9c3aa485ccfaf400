//! JavaScript for a page: f32 arithmetic, each result rounded by `Math.fround`. A multiply-add is
//! first rounded to f64, so it can differ from a fused one in the last place.

use super::c_family;
use super::syntax::{Spelling, Syntax, WrittenHead, atom, is_word, negation};
use crate::op::Op;

pub(super) const SYNTAX: Syntax = Syntax {
    spelling,
    width: 200,
    reserved: |name| is_word(WORDS, name),
    // The f64 with the f32's value: JavaScript reads the shorter decimal as another number.
    literal: |value| format!("{:?}", f64::from(value)),
    local: |_, name, value| format!("const {name} = {value};"),
    non_finite: |name, _, bits| vec![format!("const {name} = {};", non_finite(bits))],
    open,
    close,
    ..c_family::SYNTAX
};

fn spelling(op: Op) -> Spelling {
    match op {
        Op::Add => atom("f32({a} + {b})"),
        Op::Sub => atom("f32({a} - {b})"),
        Op::Mul => atom("f32({a}*{b})"),
        Op::Div => atom("f32({a}/{b})"),
        Op::Neg => negation("-{a!}"),
        Op::Abs => atom("Math.abs({a})"),
        Op::Min => atom("Math.min({a}, {b})"),
        Op::Max => atom("Math.max({a}, {b})"),
        Op::Saturate => atom("Math.min(Math.max({a}, 0), 1)"),
        Op::Mad => atom("f32({a}*{b} + {c})"),
        Op::Rcp => atom("f32(1/{a})"),
        Op::Sqrt => atom("f32(Math.sqrt({a}))"),
        Op::Rsqrt => atom("f32(1/f32(Math.sqrt({a})))"),
        Op::Exp2 => atom("f32(Math.pow(2, {a}))"),
        Op::Log2 => atom("f32(Math.log2({a}))"),
        Op::Exp => atom("f32(Math.exp({a}))"),
        Op::Log => atom("f32(Math.log({a}))"),
        Op::Pow => atom("f32(Math.pow(2, f32({b}*f32(Math.log2({a})))))"),
        Op::Sin => atom("f32(Math.sin({a}))"),
        Op::Cos => atom("f32(Math.cos({a}))"),
        Op::Tan => atom("f32(Math.tan({a}))"),
        Op::Asin => atom("f32(Math.asin({a}))"),
        Op::Acos => atom("f32(Math.acos({a}))"),
        Op::Atan => atom("f32(Math.atan({a}))"),
        Op::Atan2 => atom("f32(Math.atan2({a}, {b}))"),
        Op::Tanh => atom("f32(Math.tanh({a}))"),
        Op::Lerp => atom("f32({c}*f32({b} - {a}) + {a})"),
        Op::Step => atom("({b} >= {a} ? 1 : 0)"),
        Op::Select => atom("({a} < {b} ? {c} : {d})"),
        Op::Floor => atom("Math.floor({a})"),
        Op::Fract => atom("f32({a} - Math.floor({a}))"),
        Op::Sign => atom("Math.sign({a})"),
    }
}

fn non_finite(bits: u32) -> &'static str {
    match f32::from_bits(bits) {
        f32::INFINITY => "Infinity",
        f32::NEG_INFINITY => "-Infinity",
        _ => "NaN",
    }
}

fn open(_: &Syntax, head: &WrittenHead, lines: &mut Vec<String>) {
    let WrittenHead { function, inputs, .. } = head;
    lines.push(format!("function {function}({}) {{", inputs.join(", ")));
}

fn close(_: &Syntax, head: &WrittenHead, lines: &mut Vec<String>) {
    lines.push(format!("    return [{}];", head.outputs.join(", ")));
    lines.push("}".to_owned());
}

/// Reserved words of ECMAScript 2024, strict mode, and what the code above uses.
const WORDS: &str = "arguments await break case catch class const continue debugger default delete \
    do else enum eval export extends false finally for function if implements import in instanceof \
    interface let new null package private protected public return static super switch this throw \
    true try typeof var void while with yield f32 Math Infinity NaN undefined";
