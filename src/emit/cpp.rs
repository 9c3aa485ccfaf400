//! C++14: an inline function, `constexpr` where it is arithmetic alone.

use super::language::{Entry, Form};
use super::syntax::{Readable, Spelling, Syntax, WrittenHead, atom, is_word, product, sum};
use super::{c, c_family};
use crate::op::Op;

pub(super) const LANGUAGE: Entry = Entry {
    name: "cpp",
    aliases: &["c++", "cxx", "cc"],
    extension: "hpp",
    form: Form::Function(&SYNTAX),
    half: None,
};

pub(super) const SYNTAX: Syntax = Syntax {
    spelling,
    reserved: |name| (c::SYNTAX.reserved)(name) || is_word("std", name),
    out_parameter: Some(|of, name| format!("{of} &{name}")),
    out_by_pointer: false,
    open,
    readable: Readable {
        lines: &["#include <algorithm>", "#include <cmath>"],
        namespaces: &["std::"],
        of_locals: &["const", "constexpr"],
        of_functions: &["constexpr", "static", "inline"],
        ..c::SYNTAX.readable
    },
    ..c::SYNTAX
};

/// No `fma`: it is no constant expression before C++23, and where it is no instruction it is slow.
fn spelling(op: Op) -> Spelling {
    match op {
        Op::Abs => atom("std::abs({a})"),
        Op::Min => atom("std::min({a}, {b})"),
        Op::Max => atom("std::max({a}, {b})"),
        Op::Saturate => atom("std::min(std::max({a}, 0.0f), 1.0f)"),
        Op::Mad => sum("{a*}*{b-} + {c*}"),
        Op::Sqrt => atom("std::sqrt({a})"),
        Op::Rsqrt => product("1.0f/std::sqrt({a})"),
        Op::Exp2 => atom("std::exp2({a})"),
        Op::Log2 => atom("std::log2({a})"),
        Op::Exp => atom("std::exp({a})"),
        Op::Log => atom("std::log({a})"),
        Op::Pow => atom("std::pow({a}, {b})"),
        Op::Sin => atom("std::sin({a})"),
        Op::Cos => atom("std::cos({a})"),
        Op::Tan => atom("std::tan({a})"),
        Op::Asin => atom("std::asin({a})"),
        Op::Acos => atom("std::acos({a})"),
        Op::Atan => atom("std::atan({a})"),
        Op::Atan2 => atom("std::atan2({a}, {b})"),
        Op::Tanh => atom("std::tanh({a})"),
        Op::Lerp => sum("{a+} + ({b+} - {a*})*{c-}"),
        Op::Floor => atom("std::floor({a})"),
        Op::Fract => sum("{a+} - std::floor({a})"),
        op => (c::SYNTAX.spelling)(op),
    }
}

fn open(syntax: &Syntax, head: &WrittenHead, lines: &mut Vec<String>) {
    lines.extend(["algorithm", "cmath"].map(|name| format!("#include <{name}>")));
    lines.push(String::new());
    let from = lines.len();
    c_family::open(syntax, head, lines);
    let first = lines[from..].iter().position(|line| line.ends_with(") {")).expect("a first line");
    let kind = if head.arithmetic { "constexpr " } else { "inline " };
    let kind = if head.qualifiers.is_some() { "" } else { kind };
    lines[from + first].insert_str(0, kind);
}
