//! Rust, on `f32`.

use super::c_family;
use super::language::{Entry, Form};
use super::syntax::{
    Readable, Spelling, Style, Syntax, WrittenHead, atom, is_word, product, select, sum,
};
use crate::op::Op;

pub(super) const LANGUAGE: Entry = Entry {
    name: "rust",
    aliases: &["rs"],
    extension: "rs",
    form: Form::Function(&SYNTAX),
    half: None,
};

pub(super) const SYNTAX: Syntax = Syntax {
    types: &["f32"],
    parameter: |of, name| format!("{name}: {of}"),
    out_parameter: Some(|of, name| format!("{name}: &mut {of}")),
    out_by_pointer: true,
    spelling,
    reserved,
    local: |_, name, value| format!("let {name} = {value};"),
    non_finite: |name, _, bits| vec![format!("let {name} = {};", non_finite(bits))],
    open,
    close,
    readable: Readable {
        style: Style::Rust,
        suffixes: &[("f32", false)],
        namespaces: &["f32::"],
        of_functions: &["pub", "const"],
        ..c_family::SYNTAX.readable
    },
    ..c_family::SYNTAX
};

/// Returns spellings by functions, not methods: `2.0.exp2()` has no type, and `-x.abs()` is not
/// what it seems.
fn spelling(op: Op) -> Spelling {
    match op {
        Op::Add | Op::Sub | Op::Mul | Op::Div | Op::Neg => c_family::spelling(op),
        Op::Abs => atom("f32::abs({a})"),
        Op::Min => atom("f32::min({a}, {b})"),
        Op::Max => atom("f32::max({a}, {b})"),
        Op::Saturate => atom("f32::clamp({a}, 0.0, 1.0)"),
        Op::Mad => atom("f32::mul_add({a}, {b}, {c})"),
        Op::Rcp => product("1.0/{a-}"),
        Op::Sqrt => atom("f32::sqrt({a})"),
        Op::Rsqrt => product("1.0/f32::sqrt({a})"),
        Op::Exp2 => atom("f32::exp2({a})"),
        Op::Log2 => atom("f32::log2({a})"),
        Op::Exp => atom("f32::exp({a})"),
        Op::Log => atom("f32::ln({a})"),
        Op::Pow => atom("f32::powf({a}, {b})"),
        Op::Sin => atom("f32::sin({a})"),
        Op::Cos => atom("f32::cos({a})"),
        Op::Tan => atom("f32::tan({a})"),
        Op::Asin => atom("f32::asin({a})"),
        Op::Acos => atom("f32::acos({a})"),
        Op::Atan => atom("f32::atan({a})"),
        Op::Atan2 => atom("f32::atan2({a}, {b})"),
        Op::Tanh => atom("f32::tanh({a})"),
        Op::Lerp => atom("f32::mul_add({c}, {b+} - {a*}, {a})"),
        Op::Step => select("if {b+} >= {a+} { 1.0 } else { 0.0 }"),
        Op::Select => select("if {a+} < {b+} { {c} } else { {d} }"),
        Op::Floor => atom("f32::floor({a})"),
        Op::Fract => sum("{a+} - f32::floor({a})"),
        Op::Sign => select("if {a+} > 0.0 { 1.0 } else if {a+} < 0.0 { -1.0 } else { {a} }"),
    }
}

fn non_finite(bits: u32) -> &'static str {
    match f32::from_bits(bits) {
        f32::INFINITY => "f32::INFINITY",
        f32::NEG_INFINITY => "f32::NEG_INFINITY",
        _ => "f32::NAN",
    }
}

fn open(syntax: &Syntax, head: &WrittenHead, lines: &mut Vec<String>) {
    let returned = match head.returned {
        0 => String::new(),
        1 => "-> f32 ".to_owned(),
        n => format!("-> ({}) ", vec!["f32"; n].join(", ")),
    };
    let (qualifiers, function) = (head.qualified("pub"), &head.function);
    let parameters = c_family::parameters(syntax, head);
    lines.push(format!("{qualifiers}fn {function}({parameters}) {returned}{{"));
}

fn close(_: &Syntax, head: &WrittenHead, lines: &mut Vec<String>) {
    let values = head.outputs[..head.returned].join(", ");
    match head.returned {
        0 => {}
        1 => lines.push(format!("    {values}")),
        _ => lines.push(format!("    ({values})")),
    }
    lines.push("}".to_owned());
}

fn reserved(name: &str) -> bool {
    name == "_" || is_word(WORDS, name)
}

/// Keywords and the words reserved for later (reference of the 2024 edition, §2.2), and names that
/// a pattern would match rather than bind.
const WORDS: &str = "Self abstract as async await become box break const continue crate do dyn \
    else enum extern false final fn for gen if impl in let loop macro match mod move mut override \
    priv pub ref return self static struct super trait true try type typeof union unsafe unsized \
    use virtual where while yield main f32 None Some Ok Err";
