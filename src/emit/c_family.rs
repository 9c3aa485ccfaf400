//! Functions in the languages that look like C.

use super::syntax::{Signature, Syntax};

/// A function that returns a float, a vector, or a structure.
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

/// The outputs as members of a structure.
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
