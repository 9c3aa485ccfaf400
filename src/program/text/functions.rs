//! Functions of shading languages beyond the table of operations: other names, and formulas.

use super::{Names, Parsed, Scope, parse_template};
use crate::op::Op;

/// Operations under the names that shading languages have for them.
const RENAMED: [(&str, Op); 4] =
    [("fma", Op::Mad), ("frac", Op::Fract), ("inversesqrt", Op::Rsqrt), ("mix", Op::Lerp)];

/// Functions that formulas are written out for: name, parameters, meaning. As in GLSL (GLSL 4.60
/// specification, §8.1 to 8.3); `log10` as in HLSL.
const FORMULAS: [(&str, &[&str], &str); 7] = [
    ("ceil", &["x"], "y = -floor(-x)"),
    ("clamp", &["x", "low", "high"], "y = min(max(x, low), high)"),
    ("degrees", &["x"], "y = 57.29577951308232*x"),
    ("log10", &["x"], "y = 0.3010299956639812*log2(x)"),
    ("mod", &["x", "m"], "y = x - m*floor(x/m)"),
    ("radians", &["x"], "y = 0.017453292519943295*x"),
    (
        "smoothstep",
        &["low", "high", "x"],
        "t = saturate((x - low)/(high - low)); y = t*t*(3 - 2*t)",
    ),
];

/// Functions of vectors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum OfVectors {
    Dot,
    Length,
    Normalize,
}

const OF_VECTORS: [(&str, OfVectors); 3] =
    [("dot", OfVectors::Dot), ("length", OfVectors::Length), ("normalize", OfVectors::Normalize)];

/// What a name before `(` means.
pub(super) enum Function {
    Operation(Op),
    /// A formula over the arguments.
    Formula(Parsed),
    OfVectors(OfVectors),
}

impl Function {
    /// Returns the function of this name.
    pub(super) fn find(name: &str) -> Option<Function> {
        if let Some((_, parameters, text)) = FORMULAS.iter().find(|(known, ..)| *known == name) {
            let names = Names::new(parameters.iter().copied(), ["y"]);
            let parsed = parse_template(text, Scope::Dataset(&names));
            return Some(Function::Formula(parsed.expect("a formula of the table")));
        }
        if let Some((_, function)) = OF_VECTORS.iter().find(|(known, _)| *known == name) {
            return Some(Function::OfVectors(*function));
        }
        let renamed = RENAMED.iter().find(|(known, _)| *known == name).map(|(_, op)| *op);
        renamed.or_else(|| Op::from_name(name)).map(Function::Operation)
    }

    /// Returns it as it is meant for so many arguments: `atan` of two is `atan2`, as in GLSL.
    pub(super) fn of_arguments(self, count: usize) -> Function {
        match (self, count) {
            (Function::Operation(Op::Atan), 2) => Function::Operation(Op::Atan2),
            (function, _) => function,
        }
    }

    pub(super) fn arity(&self) -> usize {
        match self {
            Function::Operation(op) => op.arity(),
            Function::Formula(formula) => formula.program.inputs,
            Function::OfVectors(OfVectors::Dot) => 2,
            Function::OfVectors(OfVectors::Length | OfVectors::Normalize) => 1,
        }
    }
}

/// Returns all names of functions.
pub(super) fn names() -> impl Iterator<Item = &'static str> {
    let operations = Op::ALL.iter().map(|op| op.name());
    let named =
        operations.chain(RENAMED.map(|(name, _)| name)).chain(FORMULAS.map(|(name, ..)| name));
    named.chain(OF_VECTORS.map(|(name, _)| name))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_means_one_function() {
        let mut known: Vec<&str> = names().collect();
        assert!(known.iter().all(|name| Function::find(name).is_some_and(|f| f.arity() > 0)));
        let count = known.len();
        known.sort_unstable();
        known.dedup();
        assert_eq!(known.len(), count);
    }
}
