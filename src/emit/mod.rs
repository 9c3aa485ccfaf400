//! Programs as functions to paste into a shader or a program, or an equation into a paper, one
//! file a language.
//!
//! Emitted code follows the program exactly: nothing is re-associated, a division stays a
//! division, and a result that is read more than once is computed once, as a named local.
//! Only what depends on no input is computed here, by the reference semantics: an infinite
//! constant expression is a compile error in WGSL. Signs are moved to where the fewest stand
//! (`x - 0.5` for `x + -0.5`), which is exact.
//!
//! Languages differ in the results of `min`, `max` and a clamp for NaN, and of `pow` for a negative
//! base. `pow(0, 0)` is NaN in a program, as in most shaders, where `pow(x, y)` is
//! `exp2(y*log2(x))`: GLSL leaves it undefined (like `pow(x, y)` for x < 0), HLSL and WGSL promise
//! no more than that expression gives; in MSL, C, Rust and Python it is 1, as in IEEE 754.
//!
//! ```
//! use lgp::emit::{Language, Snippet, emit};
//! use lgp::program::{Names, parse};
//! let names = Names::new(["n_dot_v", "roughness"], ["bias"]);
//! let program = parse("bias = exp2(-(7*n_dot_v + 4*roughness^2))", &names)?;
//! let snippet = Snippet { program: &program, names: &names, function: "dfg", header: &[] };
//! assert_eq!(
//!     emit(Language::Wgsl, &snippet),
//!     "fn dfg_bias(n_dot_v: f32, roughness: f32) -> f32 {
//!     let bias = exp2(-(7.0*n_dot_v + 4.0*(roughness*roughness)));
//!     return bias;
//! }
//! "
//! );
//! # Ok::<(), lgp::program::ParseError>(())
//! ```

mod body;
mod c;
mod c_family;
mod glsl;
mod header;
mod hlsl;
mod javascript;
mod language;
mod latex;
mod mathml;
mod msl;
mod naming;
mod python;
mod read;
mod rust;
mod slang;
mod syntax;
mod typeset;
mod wgsl;

pub use header::header_lines;
pub use language::{Language, UnknownLanguage};
pub use read::{
    MAX_SNIPPET, Precision, ReadBack, ReadError, Stated, StatedError, formula_line, read_back,
};

use crate::program::{Names, Program};
use body::Syntaxes;
use naming::Naming;
use syntax::Syntax;

/// A function to be written.
#[derive(Clone, Copy, Debug)]
pub struct Snippet<'a> {
    /// The program that the function computes.
    pub program: &'a Program,
    /// Names for each input and output of the program.
    pub names: &'a Names,
    /// The function's name; with a single output it becomes `function_output`.
    pub function: &'a str,
    /// Lines of the comment above the function.
    pub header: &'a [String],
}

/// Writes the snippet as a function of the language, ready to paste. A name that means something in
/// the language is written differently, and a comment says so.
///
/// # Panics
/// If `names` does not have a name for each input and output of the program.
pub fn emit(language: Language, snippet: &Snippet) -> String {
    written(Syntaxes::one(language.syntax()), snippet)
}

/// Writes the same function in half precision, including arguments, constants and outputs, except
/// for the instructions in `stay_single` (those of
/// [`stability::must_stay_single`](crate::stability::must_stay_single), or none). Returns none for
/// a language without halves. In WGSL and GLSL the text begins with the line that allows halves.
///
/// # Panics
/// As [`emit`] does.
pub fn emit_half(language: Language, snippet: &Snippet, stay_single: &[usize]) -> Option<String> {
    let syntax = language.half_syntax()?;
    let single = language.syntax();
    Some(written(Syntaxes { function: syntax, single, stay_single }, snippet))
}

/// Writes the program as a JavaScript function from its inputs to an array of its outputs, for
/// pages. It calls `f32`, which must be `Math.fround`. It contains no name from outside.
pub fn javascript(program: &Program) -> String {
    let numbered = |letter: char, count| (0..count).map(move |i| format!("{letter}{i}"));
    let names = Names::new(numbered('x', program.inputs), numbered('y', program.outputs.len()));
    let snippet = Snippet { program, names: &names, function: "formula", header: &[] };
    written(Syntaxes::one(&javascript::SYNTAX), &snippet)
}

/// Writes the snippet as equations that browsers typeset, without its header.
///
/// # Panics
/// As [`emit`] does.
pub fn mathml(snippet: &Snippet) -> String {
    written(Syntaxes::one(&mathml::SYNTAX), &Snippet { header: &[], ..*snippet })
}

fn written(syntaxes: Syntaxes, snippet: &Snippet) -> String {
    let syntax = syntaxes.function;
    let Snippet { program, names, function, header } = *snippet;
    assert_eq!(names.inputs.len(), program.inputs, "a name for each input");
    assert_eq!(names.outputs.len(), program.outputs.len(), "a name for each output");
    let function = function_name(function, names);
    let mut naming = Naming::new(syntax.reserved, &function, names);
    let signature = naming.signature();
    let mut lines: Vec<String> = Vec::new();
    // A language without comments would show them, or read them as code.
    if !syntax.comment.is_empty() {
        lines.extend(header::commented(syntax.comment, header));
        lines.extend(header::commented(syntax.comment, &naming.renamed()));
    }
    (syntax.open)(syntax, &signature, &mut lines);
    let statements = body::statements(syntaxes, program, &signature, &mut naming);
    lines.extend(statements.iter().map(|line| format!("    {line}")));
    (syntax.close)(syntax, &signature, &mut lines);
    lines.join("\n") + "\n"
}

/// Returns `dfg_bias` for the single output `bias` of `dfg`, unless the name says it already.
fn function_name(function: &str, names: &Names) -> String {
    match names.outputs.as_slice() {
        [output] if function != output && !function.ends_with(&format!("_{output}")) => {
            format!("{function}_{output}")
        }
        _ => function.to_owned(),
    }
}
