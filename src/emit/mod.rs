//! Programs as functions to paste into a shader, one file a language.
//!
//! Emitted code follows the program exactly: nothing is re-associated, a division stays a
//! division, and a result that is read more than once is computed once, as a named local.
//! Only what depends on no input is computed here, by the reference semantics: an infinite
//! constant expression is a compile error in WGSL.
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
mod glsl;
mod hlsl;
mod naming;
mod read;
mod wgsl;

pub use read::{ReadError, read_back};

use crate::op::Op;
use crate::program::{Names, Program, format_constant};
use crate::suggest::did_you_mean;
use naming::Naming;
use std::fmt;

/// A language that programs can be written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Language {
    /// Direct3D, Unity, Unreal; shader model 5 and later.
    Hlsl,
    /// WebGPU.
    Wgsl,
    /// OpenGL, Vulkan, WebGL2: what `#version 300 es` and desktop GLSL have in common.
    Glsl,
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
    pub const ALL: &'static [Language] = &[Language::Hlsl, Language::Wgsl, Language::Glsl];

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
    let Snippet { program, names, function, header } = *snippet;
    assert_eq!(names.inputs.len(), program.inputs, "a name for each input");
    assert_eq!(names.outputs.len(), program.outputs.len(), "a name for each output");
    let syntax = language.syntax();
    let function = function_name(function, names);
    let mut naming = Naming::new(syntax.reserved, &function, names);
    let signature = naming.signature();
    let mut lines: Vec<String> =
        header.iter().flat_map(|line| line.lines()).map(|line| comment(syntax, line)).collect();
    lines.extend(naming.renamed().iter().map(|line| comment(syntax, line)));
    lines.extend((syntax.open)(&signature));
    let statements = body::statements(syntax, program, &signature, &mut naming);
    lines.extend(statements.iter().map(|line| format!("    {line}")));
    lines.extend((syntax.close)(&signature));
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
/// and a backslash at its end continues it in HLSL and GLSL.
fn comment(syntax: &Syntax, text: &str) -> String {
    let separator = |c: char| c.is_control() || c == '\u{2028}' || c == '\u{2029}';
    let mut text = text.replace(separator, " ").trim_end().to_owned();
    if text.ends_with('\\') {
        text.push_str(" .");
    }
    format!("{} {text}", syntax.comment).trim_end().to_owned()
}

/// All that tells one language from another.
struct Syntax {
    name: &'static str,
    aliases: &'static [&'static str],
    extension: &'static str,
    /// What begins a comment that ends with its line.
    comment: &'static str,
    spelling: fn(Op) -> Spelling,
    /// Whether a name is a keyword, a type, a builtin function, or of a form that may not be
    /// declared. A plain identifier that ends in `_` or `_2` never is, so that each name can be
    /// replaced by one like it.
    reserved: fn(&str) -> bool,
    literal: fn(f32) -> String,
    /// The declaration of a local that is never changed.
    local: fn(name: &str, value: &str) -> String,
    /// The declaration of a local that is infinite or NaN, and perhaps of one for its bits.
    non_finite: fn(name: &str, bits_name: &str, bits: u32) -> Vec<String>,
    /// The lines above the function's body.
    open: fn(&Signature) -> Vec<String>,
    /// The lines that return the outputs and end the function.
    close: fn(&Signature) -> Vec<String>,
    /// The function that makes a float of its bits.
    float_of_bits: &'static str,
}

/// The names of a function's parts, as the language allows them.
struct Signature {
    function: String,
    inputs: Vec<String>,
    outputs: Vec<String>,
    /// The type and the local that hold more outputs than a vector can.
    structure: String,
    result: String,
}

/// How tightly a piece of code binds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Binding {
    Select,
    Sum,
    Product,
    Negation,
    Atom,
}

/// How an operation is written: `{a}`, `{b}`, `{c}`, `{d}` stand for its arguments, and a mark
/// says how tightly the argument must bind to need no parentheses: none anything, `+` a sum,
/// `*` a product, `-` a negation, `!` an atom.
struct Spelling {
    template: &'static str,
    binding: Binding,
}

const fn select(template: &'static str) -> Spelling {
    Spelling { template, binding: Binding::Select }
}

const fn sum(template: &'static str) -> Spelling {
    Spelling { template, binding: Binding::Sum }
}

const fn product(template: &'static str) -> Spelling {
    Spelling { template, binding: Binding::Product }
}

const fn negation(template: &'static str) -> Spelling {
    Spelling { template, binding: Binding::Negation }
}

const fn atom(template: &'static str) -> Spelling {
    Spelling { template, binding: Binding::Atom }
}

/// The shortest decimal that reads back as `value` and that no compiler takes for an integer.
fn decimal(value: f32) -> String {
    // The shortest decimal of the largest number, …35e38, lies above it: out of range where it
    // is read in higher precision first, as in WGSL.
    let text = format_constant(value).replace("3.4028235e38", "3.4028234e38");
    if text.contains(['.', 'e']) { text } else { text + ".0" }
}

/// Whether `name` is one of the words of `list`.
fn is_word(list: &str, name: &str) -> bool {
    list.split_ascii_whitespace().any(|word| word == name)
}
