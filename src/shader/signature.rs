//! Finds the functions of HLSL and Slang text, as far as is needed to have one compiled.

use super::glsl::{without_comments, without_directives, words};
use std::collections::HashSet;

/// A function as its text declares it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Signature {
    pub name: String,
    pub parameters: Vec<Declared>,
    /// The place of its body.
    body: std::ops::Range<usize>,
}

/// A parameter as its text declares it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Declared {
    pub ty: String,
    /// What follows the name of an array.
    pub length: String,
    /// True if the function may write to it.
    pub is_out: bool,
}

/// Returns the functions that are defined at the top of a text.
pub(super) fn signatures(text: &str) -> Vec<Signature> {
    let code = without_directives(&without_comments(text));
    let bytes = code.as_bytes();
    let (mut found, mut at, mut start) = (Vec::new(), 0, 0);
    while at < bytes.len() {
        match bytes[at] {
            b';' | b'}' => start = at + 1,
            b'(' => {
                let close = closing(bytes, at);
                let after =
                    code[close..].trim_start_matches(|c: char| c == ')' || c.is_whitespace());
                let body = close + (code[close..].len() - after.len());
                // A semantic may stand between.
                let until =
                    code[body..].find(['{', ';']).map_or(bytes.len(), |length| body + length);
                if bytes.get(until) == Some(&b'{') {
                    let end = closing(bytes, until);
                    let parameters = code[at + 1..close].split(',').map(declared);
                    let parameters: Option<Vec<Declared>> = match code[at + 1..close].trim() {
                        "" | "void" => Some(Vec::new()),
                        _ => parameters.collect(),
                    };
                    let name = code[start..at].trim().rsplit(|c: char| !is_part(c)).next();
                    if let (Some(name), Some(parameters)) =
                        (name.filter(|n| !n.is_empty()), parameters)
                    {
                        found.push(Signature {
                            name: name.to_owned(),
                            parameters,
                            body: until..end,
                        });
                    }
                    (at, start) = (end, end + 1);
                } else {
                    at = close;
                }
            }
            b'{' => {
                at = closing(bytes, at);
                start = at + 1;
            }
            _ => {}
        }
        at += 1;
    }
    found
}

/// Returns the functions whose names occur in no other's body; of several of a name, the first.
pub(super) fn uncalled<'a>(text: &str, all: &'a [Signature]) -> Vec<&'a Signature> {
    let code = without_directives(&without_comments(text));
    let mut called: HashSet<&str> = HashSet::new();
    for function in all {
        let body = code.get(function.body.clone()).unwrap_or_default();
        let names = words(body).into_iter().map(|(_, word)| word);
        called.extend(names.filter(|name| *name != function.name));
    }
    let mut known = HashSet::new();
    let open = all.iter().filter(|signature| !called.contains(signature.name.as_str()));
    open.filter(|signature| known.insert(signature.name.as_str())).collect()
}

/// Returns an entry point that calls a function: compilers leave out what nobody calls.
pub(super) fn caller(signature: &Signature) -> String {
    let parameters = signature.parameters.iter().enumerate();
    let locals: String = parameters
        .map(|(i, Declared { ty, length, .. })| format!("{ty} lgp_{i}{length} = ({ty}{length})0; "))
        .collect();
    let arguments: Vec<String> =
        (0..signature.parameters.len()).map(|i| format!("lgp_{i}")).collect();
    format!(
        "\nfloat4 {CALLER}() : SV_Target {{ {locals}{}({}); return (float4)0; }}\n",
        signature.name,
        arguments.join(", ")
    )
}

/// The name of the entry point.
pub(super) const CALLER: &str = "lgp_caller";

fn declared(text: &str) -> Option<Declared> {
    // Neither the semantic nor the default value says anything of the type.
    let text = text.split([':', '=']).next()?.trim();
    let (text, length) = match text.find('[') {
        Some(at) => (text[..at].trim_end(), text[at..].to_owned()),
        None => (text, String::new()),
    };
    let at = text.rfind(|c: char| !is_part(c))?;
    let mut ty = text[..=at].trim();
    let mut is_out = false;
    loop {
        let (first, rest) = ty.split_once(char::is_whitespace).unwrap_or((ty, ""));
        match first {
            "out" | "inout" => is_out = true,
            "in" | "const" | "uniform" | "precise" | "nointerpolation" => {}
            _ => break,
        }
        ty = rest.trim();
    }
    (!ty.is_empty()).then(|| Declared { ty: ty.to_owned(), length, is_out })
}

fn is_part(c: char) -> bool {
    c.is_ascii_alphanumeric() || c == '_'
}

/// Returns the place of the bracket that closes the one at a place, or the end.
fn closing(bytes: &[u8], open: usize) -> usize {
    let mut depth = 0usize;
    for (at, byte) in bytes.iter().enumerate().skip(open) {
        match byte {
            b'(' | b'{' | b'[' => depth += 1,
            b')' | b'}' | b']' => {
                depth = depth.saturating_sub(1);
                if depth == 0 {
                    return at;
                }
            }
            _ => {}
        }
    }
    bytes.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "static const float PI = 3.14; // (not { this
#define HALF (0.5 * \\
    PI)
cbuffer C { float exposure; };
float3 fresnel(float3 f0, float u) { return f0 * u; }
[noinline] void shade(in float3 f0 : COLOR0, float weights[2], const float u = 0.5f,
                      out float3 result, inout Material m) : SV_Target
{ if (u > 0) { result = fresnel(f0, u); } }
float later(float x);
float4 fresnel(float4 f0) { return float4(fresnel(f0.xyz, f0.w), 1); }";

    #[test]
    fn functions_are_found_with_their_parameters() {
        let all = signatures(TEXT);
        let names: Vec<&str> = all.iter().map(|signature| signature.name.as_str()).collect();
        assert_eq!(names, ["fresnel", "shade", "fresnel"]);
        let types: Vec<&str> = all[1].parameters.iter().map(|p| p.ty.as_str()).collect();
        assert_eq!(types, ["float3", "float", "float", "float3", "Material"]);
        let out: Vec<bool> = all[1].parameters.iter().map(|p| p.is_out).collect();
        assert_eq!(out, [false, false, false, true, true]);
        assert_eq!(all[1].parameters[1].length, "[2]");
        assert_eq!(uncalled(TEXT, &all), [&all[1]]);
    }

    #[test]
    fn no_text_makes_it_fail() {
        for end in 0..TEXT.len() {
            if TEXT.is_char_boundary(end) {
                signatures(&TEXT[..end]).iter().for_each(|signature| drop(caller(signature)));
            }
        }
        signatures(")}](((");
    }
}
