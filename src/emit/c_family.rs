//! The syntax that C-like languages share; each language overrides what differs.

use super::syntax::{
    Readable, Signature, Spelling, Syntax, atom, decimal, negation, product, select, sum,
};
use crate::op::Op;

pub(super) const SYNTAX: Syntax = Syntax {
    comment: "//",
    types: &[],
    spelling,
    power: None,
    parentheses: ["(", ")"],
    signs: [" + ", " - "],
    // With the declaration around it a line stays within 100 columns.
    width: 72,
    reserved: |_| false,
    written: str::to_owned,
    half: false,
    literal: decimal,
    local: |syntax, name, value| format!("const {} {name} = {value};", syntax.types[0]),
    non_finite: |_, _, _| Vec::new(),
    open,
    close,
    float_of_bits: "",
    readable: Readable {
        of_locals: &[],
        of_functions: &[],
        of_parameters: &[],
        semantics: false,
        integer_sign: false,
    },
};

/// Returns an operation's spelling in most shading languages.
pub(super) fn spelling(op: Op) -> Spelling {
    match op {
        Op::Add => sum("{a+} + {b*}"),
        Op::Sub => sum("{a+} - {b*}"),
        Op::Mul => product("{a*}*{b-}"),
        Op::Div => product("{a*}/{b-}"),
        Op::Neg => negation("-{a!}"),
        Op::Abs => atom("abs({a})"),
        Op::Min => atom("min({a}, {b})"),
        Op::Max => atom("max({a}, {b})"),
        Op::Saturate => atom("saturate({a})"),
        Op::Mad => atom("fma({a}, {b}, {c})"),
        Op::Rcp => product("1.0/{a-}"),
        Op::Sqrt => atom("sqrt({a})"),
        Op::Rsqrt => atom("rsqrt({a})"),
        Op::Exp2 => atom("exp2({a})"),
        Op::Log2 => atom("log2({a})"),
        Op::Exp => atom("exp({a})"),
        Op::Log => atom("log({a})"),
        Op::Pow => atom("pow({a}, {b})"),
        Op::Sin => atom("sin({a})"),
        Op::Cos => atom("cos({a})"),
        Op::Tan => atom("tan({a})"),
        Op::Asin => atom("asin({a})"),
        Op::Acos => atom("acos({a})"),
        Op::Atan => atom("atan({a})"),
        Op::Atan2 => atom("atan2({a}, {b})"),
        Op::Tanh => atom("tanh({a})"),
        Op::Lerp => atom("mix({a}, {b}, {c})"),
        Op::Step => atom("step({a}, {b})"),
        Op::Select => select("({a+} < {b+}) ? {c+} : {d+}"),
        Op::Floor => atom("floor({a})"),
        Op::Fract => atom("fract({a})"),
        Op::Sign => atom("sign({a})"),
    }
}

/// Opens a function that returns a float, a vector, or a structure.
pub(super) fn open(syntax: &Syntax, signature: &Signature, lines: &mut Vec<String>) {
    let Signature { outputs, structure, .. } = signature;
    let returned = syntax.types.get(outputs.len() - 1).copied().unwrap_or(structure);
    if returned == structure {
        lines.push(format!("struct {structure} {{"));
        lines.extend(members(syntax, outputs));
        lines.push("};".to_owned());
    }
    lines.push(head(syntax, signature, returned));
}

/// Declares the outputs as members of a structure.
pub(super) fn members(syntax: &Syntax, outputs: &[String]) -> Vec<String> {
    outputs.iter().map(|name| format!("    {} {name};", syntax.types[0])).collect()
}

pub(super) fn head(syntax: &Syntax, signature: &Signature, returned: &str) -> String {
    let Signature { function, inputs, .. } = signature;
    let inputs: Vec<String> =
        inputs.iter().map(|name| format!("{} {name}", syntax.types[0])).collect();
    format!("{returned} {function}({}) {{", inputs.join(", "))
}

pub(super) fn close(syntax: &Syntax, signature: &Signature, lines: &mut Vec<String>) {
    let Signature { outputs, structure, result, .. } = signature;
    let values = outputs.join(", ");
    match syntax.types.get(outputs.len() - 1) {
        Some(_) if outputs.len() == 1 => lines.push(format!("    return {values};")),
        Some(vector) => lines.push(format!("    return {vector}({values});")),
        None => {
            lines.push(format!("    const {structure} {result} = {{ {values} }};"));
            lines.push(format!("    return {result};"));
        }
    }
    lines.push("}".to_owned());
}
