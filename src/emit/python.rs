//! Python, on numpy arrays of any shape, or on numbers.

use super::c_family;
use super::language::{Entry, Form};
use super::syntax::{
    Plain, Readable, Spelling, Style, Syntax, WrittenHead, atom, is_word, product, sum,
};
use crate::op::Op;

pub(super) const LANGUAGE: Entry = Entry {
    name: "python",
    aliases: &["py", "numpy"],
    extension: "py",
    form: Form::Function(&SYNTAX),
    half: None,
};

pub(super) const SYNTAX: Syntax = Syntax {
    comment: "#",
    spelling,
    reserved,
    local: |_, name, value| format!("{name} = {value}"),
    non_finite: |name, _, bits| vec![format!("{name} = {}", non_finite(bits))],
    open,
    close,
    readable: Readable {
        style: Style::Python,
        plain: Plain::Number,
        suffixes: &[],
        comments: ["#", "\"\"\""],
        lines: &["import numpy as np"],
        namespaces: &["np."],
        ..c_family::SYNTAX.readable
    },
    ..c_family::SYNTAX
};

fn spelling(op: Op) -> Spelling {
    match op {
        Op::Add | Op::Sub | Op::Mul | Op::Div | Op::Neg => c_family::spelling(op),
        Op::Abs => atom("np.abs({a})"),
        Op::Min => atom("np.minimum({a}, {b})"),
        Op::Max => atom("np.maximum({a}, {b})"),
        Op::Saturate => atom("np.clip({a}, 0.0, 1.0)"),
        Op::Mad => sum("{a*}*{b-} + {c*}"),
        Op::Rcp => product("1.0/{a-}"),
        Op::Sqrt => atom("np.sqrt({a})"),
        Op::Rsqrt => product("1.0/np.sqrt({a})"),
        Op::Exp2 => atom("np.exp2({a})"),
        Op::Log2 => atom("np.log2({a})"),
        Op::Exp => atom("np.exp({a})"),
        Op::Log => atom("np.log({a})"),
        Op::Pow => atom("np.power({a}, {b})"),
        Op::Sin => atom("np.sin({a})"),
        Op::Cos => atom("np.cos({a})"),
        Op::Tan => atom("np.tan({a})"),
        Op::Asin => atom("np.arcsin({a})"),
        Op::Acos => atom("np.arccos({a})"),
        Op::Atan => atom("np.arctan({a})"),
        Op::Atan2 => atom("np.arctan2({a}, {b})"),
        Op::Tanh => atom("np.tanh({a})"),
        Op::Lerp => sum("{a+} + ({b+} - {a*})*{c-}"),
        Op::Step => atom("np.float32(np.where({b+} >= {a+}, 1.0, 0.0))"),
        // `where` would make doubles of two plain numbers.
        Op::Select => atom("np.float32(np.where({a+} < {b+}, {c}, {d}))"),
        Op::Floor => atom("np.floor({a})"),
        Op::Fract => sum("{a+} - np.floor({a})"),
        Op::Sign => atom("np.sign({a})"),
    }
}

fn non_finite(bits: u32) -> &'static str {
    match f32::from_bits(bits) {
        f32::INFINITY => "np.inf",
        f32::NEG_INFINITY => "-np.inf",
        _ => "np.nan",
    }
}

fn open(_: &Syntax, head: &WrittenHead, lines: &mut Vec<String>) {
    let WrittenHead { function, inputs, .. } = head;
    lines.extend(["import numpy as np", "", ""].map(str::to_owned));
    lines.push(format!("def {function}({}):", inputs.join(", ")));
}

fn close(_: &Syntax, head: &WrittenHead, lines: &mut Vec<String>) {
    lines.push(format!("    return {}", head.outputs.join(", ")));
}

fn reserved(name: &str) -> bool {
    is_word(WORDS, name)
}

/// Keywords of Python 3.14 (reference, §2.3.1); the soft ones may name a variable.
const WORDS: &str = "False None True and as assert async await break class continue def del elif \
    else except finally for from global if import in is lambda nonlocal not or pass raise return \
    try while with yield np";
