//! TSL, the node language of three.js: a function of nodes, of which three.js makes GLSL or WGSL.

use super::c_family;
use super::javascript;
use super::language::{Entry, Form};
use super::syntax::{
    Plain, Readable, Spelling, Style, Syntax, WrittenHead, atom, decimal, is_word,
};
use crate::op::Op;

pub(super) const LANGUAGE: Entry = Entry {
    name: "tsl",
    aliases: &["threejs"],
    extension: "tsl.js",
    form: Form::Function(&SYNTAX),
    half: None,
};

pub(super) const SYNTAX: Syntax = Syntax {
    spelling,
    reserved: |name| (javascript::SYNTAX.reserved)(name) || is_word(IMPORTED, name),
    literal: decimal,
    local: |_, name, value| format!("const {name} = {value};"),
    non_finite: |name, _, bits| vec![format!("const {name} = {};", non_finite(bits))],
    open,
    close,
    float_of_bits: "uintBitsToFloat",
    readable: Readable {
        style: Style::Nodes,
        plain: Plain::Number,
        suffixes: &[],
        lines: &["import {*"],
        of_functions: &["export"],
        ..c_family::SYNTAX.readable
    },
    ..c_family::SYNTAX
};

fn spelling(op: Op) -> Spelling {
    match op {
        Op::Add => atom("add({a}, {b})"),
        Op::Sub => atom("sub({a}, {b})"),
        Op::Mul => atom("mul({a}, {b})"),
        Op::Div => atom("div({a}, {b})"),
        Op::Neg => atom("negate({a})"),
        Op::Mad => atom("add(mul({a}, {b}), {c})"),
        Op::Rcp => atom("div(1.0, {a})"),
        Op::Rsqrt => atom("inverseSqrt({a})"),
        Op::Atan2 => atom("atan({a}, {b})"),
        Op::Select => atom("select(lessThan({a}, {b}), {c}, {d})"),
        op => c_family::spelling(op),
    }
}

/// As in WGSL, what a variable holds is no constant expression, which would have to be finite.
fn non_finite(bits: u32) -> String {
    format!("uintBitsToFloat(uint({bits:#010x}).toVar())")
}

/// The line of imports is written last, when it is known what is used.
fn open(_: &Syntax, head: &WrittenHead, lines: &mut Vec<String>) {
    lines.extend([String::new(), String::new()]);
    let parameters: Vec<&str> = head.parameters.iter().map(|p| p.name.as_str()).collect();
    let (function, parameters) = (&head.function, parameters.join(", "));
    let qualifiers = head.qualified("export");
    lines.push(match returns_a_node(head) {
        true => format!("{qualifiers}const {function} = Fn(([{parameters}]) => {{"),
        false => format!("{qualifiers}const {function} = ({parameters}) => {{"),
    });
}

/// A function of nodes returns one: a float or a vector.
fn returns_a_node(head: &WrittenHead) -> bool {
    head.outputs.len() <= 4
}

fn close(_: &Syntax, head: &WrittenHead, lines: &mut Vec<String>) {
    let values = head.outputs.join(", ");
    lines.push(match head.outputs.len() {
        1 => format!("    return float({values});"),
        n @ 2..=4 => format!("    return vec{n}({values});"),
        _ => format!("    return [{values}];"),
    });
    lines.push(if returns_a_node(head) { "});" } else { "};" }.to_owned());
    let at = lines.iter().position(|line| line.contains("=> {")).expect("a first line");
    let code = lines[at..].join("\n");
    let called = |name: &&str| {
        code.match_indices(*name).any(|(i, _)| {
            let before = code[..i].chars().next_back();
            !before.is_some_and(|c| c.is_ascii_alphanumeric() || c == '_' || c == '.')
                && code[i + name.len()..].starts_with('(')
        })
    };
    let used: Vec<&str> = IMPORTED.split_ascii_whitespace().filter(called).collect();
    lines[at - 2] = format!("import {{ {} }} from 'three/tsl';", used.join(", "));
}

/// The functions of `three/tsl` (r187) that are written.
const IMPORTED: &str = "Fn float vec2 vec3 vec4 add sub mul div negate abs min max saturate sqrt \
    inverseSqrt exp2 log2 exp log pow sin cos tan asin acos atan tanh mix step select lessThan floor \
    fract sign uint uintBitsToFloat";
