//! The syntax that C-like languages share; each language overrides what differs.

use super::syntax::{
    Conversion, Plain, Readable, Spelling, Style, Syntax, WrittenHead, atom, decimal, negation,
    product, select, sum,
};
use crate::op::Op;

pub(super) const SYNTAX: Syntax = Syntax {
    comment: "//",
    states_head: false,
    types: &[],
    constructors: &[],
    conversion: Conversion::Cast,
    parameter: |of, name| format!("{of} {name}"),
    out_parameter: None,
    out_by_pointer: false,
    outputs_by_parameters: false,
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
        style: Style::C,
        plain: Plain::Single,
        suffixes: &[("f", false), ("F", false), ("h", true), ("H", true)],
        comments: ["//", "/*"],
        lines: &[],
        namespaces: &[],
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

/// Opens a function that returns nothing, a float, a vector, or a structure.
pub(super) fn open(syntax: &Syntax, head: &WrittenHead, lines: &mut Vec<String>) {
    let returned = returned_type(syntax, head);
    if returned == head.structure {
        lines.push(format!("struct {returned} {{"));
        lines.extend(members(syntax, &head.outputs[..head.returned]));
        lines.push("};".to_owned());
    }
    lines.push(first_line(syntax, head, &returned));
}

pub(super) fn returned_type(syntax: &Syntax, head: &WrittenHead) -> String {
    match head.returned.checked_sub(1) {
        None => "void".to_owned(),
        Some(last) => syntax.types.get(last).map_or(&head.structure[..], |of| of).to_owned(),
    }
}

/// Declares the outputs as members of a structure.
pub(super) fn members(syntax: &Syntax, outputs: &[String]) -> Vec<String> {
    outputs.iter().map(|name| format!("    {} {name};", syntax.types[0])).collect()
}

pub(super) fn first_line(syntax: &Syntax, head: &WrittenHead, returned: &str) -> String {
    let (qualifiers, function) = (head.qualified(""), &head.function);
    format!("{qualifiers}{returned} {function}({}) {{", parameters(syntax, head))
}

/// Lists the parameters.
pub(super) fn parameters(syntax: &Syntax, head: &WrittenHead) -> String {
    let parameters = head.parameters.iter().map(|parameter| {
        let of = syntax.types[parameter.size - 1];
        let written = match (parameter.out, syntax.out_parameter) {
            (true, Some(out_parameter)) => out_parameter(of, &parameter.name),
            _ => (syntax.parameter)(of, &parameter.name),
        };
        match parameter.qualifiers.as_str() {
            "" => written,
            words => format!("{words} {written}"),
        }
    });
    parameters.collect::<Vec<_>>().join(", ")
}

pub(super) fn close(syntax: &Syntax, head: &WrittenHead, lines: &mut Vec<String>) {
    lines.extend(assigned_vectors(syntax, head));
    if head.returned > syntax.types.len() {
        let WrittenHead { structure, result, .. } = head;
        let values = head.outputs[..head.returned].join(", ");
        lines.push(format!("    const {structure} {result} = {{ {values} }};"));
        lines.push(format!("    return {result};"));
    }
    lines.extend(returned_value(syntax, head));
    lines.push("}".to_owned());
}

/// Assigns vectors to the parameters that results leave by.
pub(super) fn assigned_vectors(syntax: &Syntax, head: &WrittenHead) -> Vec<String> {
    let vectors = head.out_places().into_iter().filter(|(parameter, _)| parameter.size > 1);
    let assigned = vectors.map(|(parameter, outputs)| {
        let (vector, values) =
            (syntax.constructor(parameter.size), head.outputs[outputs].join(", "));
        let sign = if syntax.out_by_pointer { "*" } else { "" };
        format!("    {sign}{} = {vector}({values});", parameter.name)
    });
    assigned.collect()
}

/// Returns the line that returns a float or a vector.
pub(super) fn returned_value(syntax: &Syntax, head: &WrittenHead) -> Option<String> {
    let values = head.outputs[..head.returned].join(", ");
    match head.returned {
        1 => Some(format!("    return {values};")),
        n if n > 0 && n <= syntax.types.len() => {
            Some(format!("    return {}({values});", syntax.constructor(n)))
        }
        _ => None,
    }
}
