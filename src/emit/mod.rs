//! Programs as functions to paste into a shader or a program, or an equation into a paper, one
//! file a language.
//!
//! Emitted code follows the program exactly: nothing is re-associated, a division stays a
//! division, and a result that is read more than once is computed once, as a named local.
//! Only what depends on no input is computed here, by the reference semantics: an infinite
//! constant expression is a compile error in WGSL. Signs are moved to where the fewest stand
//! (`x - 0.5` for `x + -0.5`), which is exact.
//!
//! Where an argument is NaN, languages differ in what `min`, `max` and a clamp make of it, and where it
//! is negative in what `pow` does. `pow(0, 0)` is NaN in a program, as it is in most shaders, where `pow(x, y)`
//! is `exp2(y*log2(x))`: GLSL leaves it undefined (as it does `pow(x, y)` for x < 0), HLSL and WGSL
//! promise no more than that expression gives; in MSL, C, Rust and Python it is 1, as IEEE 754 has it.
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
mod hlsl;
mod javascript;
mod latex;
mod mathml;
mod msl;
mod naming;
mod python;
mod read;
mod rust;
mod syntax;
mod wgsl;

pub use read::{
    MAX_SNIPPET, Precision, ReadBack, ReadError, Stated, StatedError, formula_line, read_back,
};

use crate::printable::is_hidden;
use crate::program::{Names, Program};
use crate::suggest::did_you_mean;
use body::Syntaxes;
use naming::Naming;
use std::fmt;
use syntax::Syntax;

/// A language that programs can be written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Language {
    /// Direct3D, Unity, Unreal; shader model 5 and later.
    Hlsl,
    /// WebGPU.
    Wgsl,
    /// OpenGL, Vulkan, WebGL2: what `#version 300 es` and desktop GLSL have in common.
    Glsl,
    /// Metal, with `using namespace metal`.
    Msl,
    /// C99, and C++.
    C,
    Rust,
    /// Of numpy arrays.
    Python,
    /// `align*`, for a paper.
    Latex,
}

/// A name that is no language's.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no language is called `{given}`{hint} (there are {known})")]
pub struct UnknownLanguage {
    pub given: String,
    hint: String,
    known: String,
}

impl Language {
    pub const ALL: &'static [Language] = &[
        Language::Hlsl,
        Language::Wgsl,
        Language::Glsl,
        Language::Msl,
        Language::C,
        Language::Rust,
        Language::Python,
        Language::Latex,
    ];

    /// The shading languages: those that [`read_back`] understands.
    pub const SHADING: &'static [Language] =
        &[Language::Hlsl, Language::Wgsl, Language::Glsl, Language::Msl];

    /// The language of this name or alias, in upper or lower case.
    ///
    /// # Errors
    /// [`UnknownLanguage`] says which names there are.
    pub fn from_name(name: &str) -> Result<Language, UnknownLanguage> {
        let lower = name.to_ascii_lowercase();
        let found = Language::ALL.iter().find(|language| {
            language.name() == lower || language.syntax().aliases.contains(&lower.as_str())
        });
        found.copied().ok_or_else(|| {
            let known: Vec<&str> = Language::ALL.iter().map(|language| language.name()).collect();
            UnknownLanguage {
                given: name.to_owned(),
                hint: did_you_mean(&lower, known.iter().copied()),
                known: known.join(", "),
            }
        })
    }

    /// The name on the command line.
    pub fn name(self) -> &'static str {
        self.syntax().name
    }

    /// What the name of a file in this language ends in, without the dot.
    pub fn extension(self) -> &'static str {
        self.syntax().extension
    }

    fn syntax(self) -> &'static Syntax {
        match self {
            Language::Hlsl => &hlsl::SYNTAX,
            Language::Wgsl => &wgsl::SYNTAX,
            Language::Glsl => &glsl::SYNTAX,
            Language::Msl => &msl::SYNTAX,
            Language::C => &c::SYNTAX,
            Language::Rust => &rust::SYNTAX,
            Language::Python => &python::SYNTAX,
            Language::Latex => &latex::SYNTAX,
        }
    }

    /// The syntax of its halves, if it has any.
    fn half_syntax(self) -> Option<&'static Syntax> {
        match self {
            Language::Hlsl => Some(&hlsl::HALF),
            Language::Wgsl => Some(&wgsl::HALF),
            Language::Glsl => Some(&glsl::HALF),
            Language::Msl => Some(&msl::HALF),
            Language::C | Language::Rust | Language::Python | Language::Latex => None,
        }
    }
}

impl fmt::Display for Language {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// What is to be written.
#[derive(Clone, Copy, Debug)]
pub struct Snippet<'a> {
    pub program: &'a Program,
    pub names: &'a Names,
    /// What the function is called; that of a single output is `function_output`.
    pub function: &'a str,
    /// Lines of the comment above it.
    pub header: &'a [String],
}

/// The snippet as a function of the language, ready to paste. A name that means something in
/// the language is written differently, and a comment says so.
///
/// # Panics
/// If `names` does not have a name for each input and output of the program.
pub fn emit(language: Language, snippet: &Snippet) -> String {
    written(Syntaxes::one(language.syntax()), snippet)
}

/// The same function in half precision, arguments, constants and outputs too, but for the
/// instructions of the program that are to stay in single precision (those of
/// [`stability::must_stay_single`](crate::stability::must_stay_single), or none); of a language that has
/// no halves, nothing. What is emitted in WGSL and GLSL begins with the line that allows halves.
///
/// # Panics
/// As [`emit`] does.
pub fn emit_half(language: Language, snippet: &Snippet, stay_single: &[usize]) -> Option<String> {
    let syntax = language.half_syntax()?;
    let single = language.syntax();
    Some(written(Syntaxes { function: syntax, single, stay_single }, snippet))
}

/// The program as a function of JavaScript from its inputs to an array of its outputs, for pages; it
/// calls `f32`, which is to be `Math.fround`. No name stands in it that comes from elsewhere.
pub fn javascript(program: &Program) -> String {
    let numbered = |letter: char, count| (0..count).map(move |i| format!("{letter}{i}"));
    let names = Names::new(numbered('x', program.inputs), numbered('y', program.outputs.len()));
    let snippet = Snippet { program, names: &names, function: "formula", header: &[] };
    written(Syntaxes::one(&javascript::SYNTAX), &snippet)
}

/// The snippet as equations that browsers typeset, without its header.
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
    // What has no comments would show them, or take them for its own.
    if !syntax.comment.is_empty() {
        let header = header.iter().flat_map(|line| line.lines());
        lines.extend(header.map(|line| comment(syntax, line)));
        lines.extend(naming.renamed().iter().map(|line| comment(syntax, line)));
    }
    (syntax.open)(syntax, &signature, &mut lines);
    let statements = body::statements(syntaxes, program, &signature, &mut naming);
    lines.extend(statements.iter().map(|line| format!("    {line}")));
    (syntax.close)(syntax, &signature, &mut lines);
    lines.join("\n") + "\n"
}

/// `dfg_bias` for the single output `bias` of `dfg`, unless the name says it already.
fn function_name(function: &str, names: &Names) -> String {
    match names.outputs.as_slice() {
        [output] if function != output && !function.ends_with(&format!("_{output}")) => {
            format!("{function}_{output}")
        }
        _ => function.to_owned(),
    }
}

/// A comment of one line whatever `text` holds: more characters than `\n` end a line in WGSL,
/// those that turn its direction show other code than is compiled, and a backslash at its end continues it in HLSL, GLSL and C.
fn comment(syntax: &Syntax, text: &str) -> String {
    let mut text = text.replace(is_hidden, " ").trim_end().to_owned();
    if text.ends_with('\\') {
        text.push_str(" .");
    }
    format!("{} {text}", syntax.comment).trim_end().to_owned()
}
