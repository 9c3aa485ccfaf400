//! The differences between languages, as data.

use super::signature::Parameter;
use crate::op::Op;
use crate::program::format_constant;
pub(super) use crate::program::spelling::{
    Binding, Spelling, Written, atom, negation, pieces, place, power, product, select, sum,
};
use half::f16;

/// The syntax of a language.
pub(super) struct Syntax {
    /// The beginning of a comment that ends with its line.
    pub comment: &'static str,
    /// True if a comment says what is a column of what, since the code does not.
    pub states_head: bool,
    /// The types of a float and of vectors, as far as there are any.
    pub types: &'static [&'static str],
    /// What makes a float and vectors of floats, where that is not their types.
    pub constructors: &'static [&'static str],
    pub conversion: Conversion,
    /// Writes a parameter that a value comes by.
    pub parameter: fn(of: &str, name: &str) -> String,
    /// Writes a parameter that a result leaves by, if there are any.
    pub out_parameter: Option<fn(of: &str, name: &str) -> String>,
    /// True if these are pointers: `*name = x;`.
    pub out_by_pointer: bool,
    /// True if several outputs leave by parameters unless asked otherwise.
    pub outputs_by_parameters: bool,
    pub spelling: fn(Op) -> Spelling,
    /// The notation of `{a}·{a}·…`, if there is one, with `{#}` factors.
    pub power: Option<&'static str>,
    pub parentheses: [&'static str; 2],
    /// The signs of a sum and of a difference.
    pub signs: [&'static str; 2],
    /// The longest expression in bytes, unless its names are longer.
    pub width: usize,
    /// Returns true for a keyword, a type, a builtin function, or a name of a form that may not be
    /// declared. A plain identifier that ends in `_` or `_2` is never reserved, so each name has a
    /// replacement.
    pub reserved: fn(&str) -> bool,
    /// Writes an allowed name.
    pub written: fn(&str) -> String,
    /// True if numbers are halves: constants are rounded, and folded, as such.
    pub half: bool,
    pub literal: fn(f32) -> String,
    /// Declares a local that is never changed.
    pub local: fn(&Syntax, name: &str, value: &str) -> String,
    /// Declares a local that is infinite or NaN, and perhaps one for its bits.
    pub non_finite: fn(name: &str, bits_name: &str, bits: u32) -> Vec<String>,
    /// Adds the lines above the function's body.
    pub open: fn(&Syntax, &WrittenHead, &mut Vec<String>),
    /// Adds the lines that return the outputs and end the function.
    pub close: fn(&Syntax, &WrittenHead, &mut Vec<String>),
    /// The function that makes a float of its bits.
    pub float_of_bits: &'static str,
    pub readable: Readable,
}

impl Syntax {
    /// Returns what makes a float, or a vector, of so many components.
    pub fn constructor(&self, size: usize) -> &'static str {
        self.constructors.get(size - 1).unwrap_or(&self.types[size - 1])
    }
}

/// The grammar of heads and statements.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Style {
    /// `float f(float x) { float t = x; return t; }`
    C,
    /// `fn f(x: f32) -> f32 { let t = x; return t; }`
    Wgsl,
    /// `pub fn f(x: f32) -> f32 { let t = x; t }`
    Rust,
    /// `export function f(x) { const t = x; return t; }`
    Script,
    /// `export const f = Fn(([x]) => { const t = x; return t; });`
    Nodes,
    /// `def f(x):`, a statement a line
    Python,
}

/// What a number without a suffix is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Plain {
    /// It takes the type of what it meets.
    Open,
    Single,
    /// It makes a double of what it meets, and is refused.
    Double,
    /// A float even without a point.
    Number,
}

/// What a function that is read back may contain although none is emitted with it.
pub(super) struct Readable {
    pub style: Style,
    pub plain: Plain,
    /// The endings of numbers, the longest first, each with whether it makes a half.
    pub suffixes: &'static [(&'static str, bool)],
    /// What a comment to the end of its line begins with, and one that ends by itself.
    pub comments: [&'static str; 2],
    /// Whole lines that mean nothing for the values, or the beginnings of such if they end in `*`.
    pub lines: &'static [&'static str],
    /// What functions' names begin with: `std::`.
    pub namespaces: &'static [&'static str],
    /// Words before the type of a local that do not change its value.
    pub of_locals: &'static [&'static str],
    pub of_functions: &'static [&'static str],
    pub of_parameters: &'static [&'static str],
    /// True if it may say where a value comes from or goes to: `: TEXCOORD0`.
    pub semantics: bool,
    /// True if `sign` is an integer.
    pub integer_sign: bool,
}

/// A function's head, and the names in its body, as the language allows them.
pub(super) struct WrittenHead {
    pub function: String,
    /// The words before it, if they are others than usual.
    pub qualifiers: Option<String>,
    pub parameters: Vec<Parameter>,
    /// What the body writes for each input.
    pub inputs: Vec<String>,
    /// The names of the outputs: locals, or parameters of one component.
    pub outputs: Vec<String>,
    /// The number of outputs that are returned; the others leave by parameters.
    pub returned: usize,
    /// The type and the local that hold more outputs than a vector can.
    pub structure: String,
    pub result: String,
    /// True if no more than arithmetic, comparisons, minima and maxima are computed.
    pub arithmetic: bool,
}

impl WrittenHead {
    /// Returns the words before the function, and a space after them; `usual` ones unless the head
    /// says others.
    pub fn qualified(&self, usual: &str) -> String {
        match self.qualifiers.as_deref().unwrap_or(usual) {
            "" => String::new(),
            words => format!("{words} "),
        }
    }

    /// Returns true if the output is a parameter by itself, which its value is assigned to.
    pub fn is_parameter(&self, output: usize) -> bool {
        self.out_places()
            .iter()
            .any(|(parameter, outputs)| parameter.size == 1 && outputs.contains(&output))
    }

    /// Returns the parameters that results leave by, each with the outputs that it holds.
    pub fn out_places(&self) -> Vec<(&Parameter, std::ops::Range<usize>)> {
        let mut from = self.returned;
        let out = self.parameters.iter().filter(|parameter| parameter.out);
        out.map(|parameter| {
            from += parameter.size;
            (parameter, from - parameter.size..from)
        })
        .collect()
    }
}

/// How a value becomes one of the other precision.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Conversion {
    /// By the type's name: `half(x)`.
    Cast,
    /// By a local: precision is a qualifier.
    Local,
}

/// Returns the shortest decimal that reads back as `value` and that no compiler takes for an
/// integer.
pub(super) fn decimal(value: f32) -> String {
    // The shortest decimal of the largest number, …35e38, lies above it: out of range where it is
    // read in higher precision first, as in WGSL.
    let text = format_constant(value).replace("3.4028235e38", "3.4028234e38");
    if text.contains(['.', 'e']) { text } else { text + ".0" }
}

/// Returns the shortest decimal that reads back as `value`, which is a half.
pub(super) fn half_decimal(value: f32) -> String {
    let half = f16::from_f32(value);
    let digits = (0..8).map(|digits| format!("{value:.digits$e}").parse::<f32>());
    let mut same = digits.flatten().filter(|decimal| f16::from_f32(*decimal) == half);
    decimal(same.next().unwrap_or(value))
}

/// Returns a short decimal that reads back as `value`, which is a half, whether it is rounded or
/// truncated.
pub(super) fn half_decimal_outward(value: f32) -> String {
    let value = f64::from(value);
    let decimals = (0..8).map(|digits: usize| {
        let step = 10f64.powf(value.abs().log10().floor() - digits as f64);
        let outward = value + (0.499 * step).copysign(value);
        format!("{outward:.digits$e}").parse::<f64>()
    });
    let mut same = decimals.flatten().filter(|decimal| {
        decimal.abs() >= value.abs() && f16::from_f64(*decimal) == f16::from_f64(value)
    });
    // Eight digits are more than a half has.
    decimal(same.next().unwrap_or(value) as f32)
}

/// Returns true if `name` is one of the words of `list`.
pub(super) fn is_word(list: &str, name: &str) -> bool {
    list.split_ascii_whitespace().any(|word| word == name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::emit::{Language, javascript, mathml};

    #[test]
    fn every_spelling_writes_each_argument() {
        let pages = [("javascript", &javascript::SYNTAX), ("mathml", &mathml::SYNTAX)];
        let languages =
            Language::ALL.iter().filter_map(|known| Some((known.name(), known.syntax()?)));
        for (language, syntax) in languages.chain(pages) {
            for &op in Op::ALL {
                let template = (syntax.spelling)(op).template;
                let mut arguments: Vec<usize> =
                    pieces(template).0.iter().map(|(_, place)| place.argument).collect();
                arguments.sort_unstable();
                arguments.dedup();
                assert!(arguments.into_iter().eq(0..op.arity()), "{op} in {language}: {template}");
            }
        }
    }

    #[test]
    fn every_half_reads_back() {
        for bits in 0..=u16::MAX {
            let half = f16::from_bits(bits);
            if half.is_finite() {
                let text = half_decimal(half.to_f32());
                assert_eq!(f16::from_f32(text.parse().unwrap()), half, "{text}");
                assert!(text.len() <= 12, "{text}");
            }
        }
        assert_eq!(half_decimal(f16::from_f32(0.1).to_f32()), "0.1");
    }

    #[test]
    fn every_half_reads_back_truncated() {
        for bits in 0..0x7c00 {
            let [half, next] = [bits, bits + 1].map(|bits| f16::from_bits(bits).to_f64());
            for half in [half, -half] {
                let text = half_decimal_outward(half as f32);
                let decimal: f64 = text.parse().unwrap();
                assert_eq!(f16::from_f64(decimal).to_f64(), half, "{text}");
                assert!((half.abs()..next).contains(&decimal.abs()), "{text}");
                assert!(text.len() <= 12, "{text}");
            }
        }
        assert_eq!(half_decimal_outward(f16::from_f32(0.07).to_f32()), "0.07001");
    }
}
