//! JavaScript: a module's function of numbers, which are doubles.

use super::c_family;
use super::javascript;
use super::language::{Entry, Form};
use super::syntax::{
    Plain, Readable, Spelling, Style, Syntax, WrittenHead, atom, decimal, product, select, sum,
};
use crate::op::Op;

pub(super) const LANGUAGE: Entry = Entry {
    name: "js",
    aliases: &["javascript", "ecmascript", "es"],
    extension: "js",
    form: Form::Function(&SYNTAX),
    half: None,
};

pub(super) const SYNTAX: Syntax = Syntax {
    spelling,
    reserved: javascript::SYNTAX.reserved,
    literal: decimal,
    local: |_, name, value| format!("const {name} = {value};"),
    non_finite: javascript::SYNTAX.non_finite,
    open,
    close,
    readable: Readable {
        style: Style::Script,
        plain: Plain::Number,
        suffixes: &[],
        namespaces: &["Math."],
        of_functions: &["export"],
        ..c_family::SYNTAX.readable
    },
    ..c_family::SYNTAX
};

fn spelling(op: Op) -> Spelling {
    match op {
        Op::Add | Op::Sub | Op::Mul | Op::Div | Op::Neg => c_family::spelling(op),
        Op::Abs => atom("Math.abs({a})"),
        Op::Min => atom("Math.min({a}, {b})"),
        Op::Max => atom("Math.max({a}, {b})"),
        Op::Saturate => atom("Math.min(Math.max({a}, 0.0), 1.0)"),
        Op::Mad => sum("{a*}*{b-} + {c*}"),
        Op::Rcp => product("1.0/{a-}"),
        Op::Sqrt => atom("Math.sqrt({a})"),
        Op::Rsqrt => product("1.0/Math.sqrt({a})"),
        Op::Exp2 => atom("Math.pow(2.0, {a})"),
        Op::Log2 => atom("Math.log2({a})"),
        Op::Exp => atom("Math.exp({a})"),
        Op::Log => atom("Math.log({a})"),
        Op::Pow => atom("Math.pow({a}, {b})"),
        Op::Sin => atom("Math.sin({a})"),
        Op::Cos => atom("Math.cos({a})"),
        Op::Tan => atom("Math.tan({a})"),
        Op::Asin => atom("Math.asin({a})"),
        Op::Acos => atom("Math.acos({a})"),
        Op::Atan => atom("Math.atan({a})"),
        Op::Atan2 => atom("Math.atan2({a}, {b})"),
        Op::Tanh => atom("Math.tanh({a})"),
        Op::Lerp => sum("{a+} + ({b+} - {a*})*{c-}"),
        Op::Step => select("({b+} >= {a+}) ? 1.0 : 0.0"),
        Op::Select => select("({a+} < {b+}) ? {c+} : {d+}"),
        Op::Floor => atom("Math.floor({a})"),
        Op::Fract => sum("{a+} - Math.floor({a})"),
        Op::Sign => atom("Math.sign({a})"),
    }
}

fn open(_: &Syntax, head: &WrittenHead, lines: &mut Vec<String>) {
    let (qualifiers, inputs) = (head.qualified("export"), head.inputs.join(", "));
    lines.push(format!("{qualifiers}function {}({inputs}) {{", head.function));
}

fn close(_: &Syntax, head: &WrittenHead, lines: &mut Vec<String>) {
    lines.push(match head.outputs.as_slice() {
        [output] => format!("    return {output};"),
        outputs => format!("    return [{}];", outputs.join(", ")),
    });
    lines.push("}".to_owned());
}
