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
//! let snippet = Snippet::new(&program, &names, "dfg");
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

mod arguments;
mod body;
mod c;
mod c_family;
mod call;
mod cpp;
mod cuda;
mod engine;
mod glsl;
mod glsl_es;
mod header;
mod hlsl;
mod javascript;
mod js;
mod language;
mod latex;
mod materialx;
mod mathml;
mod msl;
mod naming;
mod osl;
mod python;
mod read;
mod rust;
mod signature;
mod slang;
mod syntax;
mod tsl;
mod typeset;
mod wgsl;

pub use arguments::{Arguments, spread};
pub use call::{Call, CallError, Lets, call, column_called};
pub use engine::{Engine, UnknownEngine, emit_for};
pub use header::header_lines;
pub use language::{Language, UnknownLanguage};
pub use read::{
    MAX_SNIPPET, Over, Precision, ReadBack, ReadError, Stated, StatedError, derived_line,
    formula_line, language_of, read_back, read_file, read_head,
};
pub use signature::{Head, Parameter, Signature};

use crate::op::Op;
use crate::program::{Names, Program};
use body::Syntaxes;
use naming::Naming;
use syntax::Syntax;

/// A function to be written.
#[derive(Clone, Copy, Debug)]
pub struct Snippet<'a> {
    program: &'a Program,
    names: &'a Names,
    function: &'a str,
    signature: Option<&'a Signature>,
    header: Option<&'a [String]>,
}

impl<'a> Snippet<'a> {
    /// Makes a snippet of a program, with a name for each of its inputs and outputs. With a single
    /// output the function becomes `function_output`.
    pub fn new(program: &'a Program, names: &'a Names, function: &'a str) -> Snippet<'a> {
        Snippet { program, names, function, signature: None, header: Some(&[]) }
    }

    /// Gives the function a comment of these lines above it.
    pub fn header(self, header: &'a [String]) -> Snippet<'a> {
        Snippet { header: Some(header), ..self }
    }

    /// Takes all comments away.
    pub fn without_comments(self) -> Snippet<'a> {
        Snippet { header: None, ..self }
    }

    /// Gives the function another head, whose components are the program's inputs and outputs.
    pub fn signature(self, signature: &'a Signature) -> Snippet<'a> {
        Snippet { signature: Some(signature), ..self }
    }
}

/// Writes the snippet as a function of the language, ready to paste. A name that means something in
/// the language is written differently, and a comment says so.
///
/// # Panics
/// If the snippet does not have a name for each input and output of its program.
pub fn emit(language: Language, snippet: &Snippet) -> String {
    match language.syntax() {
        Some(syntax) => written(Syntaxes::one(syntax), snippet),
        None => materialx::written(snippet, &snippet.function_name()),
    }
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
    let single = language.syntax()?;
    Some(written(Syntaxes { function: syntax, single, stay_single }, snippet))
}

/// Writes the program as a JavaScript function from its inputs to an array of its outputs, for
/// pages. It calls `f32`, which must be `Math.fround`. It contains no name from outside.
pub fn javascript(program: &Program) -> String {
    let numbered = |letter: char, count| (0..count).map(move |i| format!("{letter}{i}"));
    let names = Names::new(numbered('x', program.inputs), numbered('y', program.outputs.len()));
    let snippet = Snippet::new(program, &names, "formula");
    written(Syntaxes::one(&javascript::SYNTAX), &snippet)
}

/// Writes the snippet as equations that browsers typeset, without its header.
///
/// # Panics
/// As [`emit`] does.
pub fn mathml(snippet: &Snippet) -> String {
    written(Syntaxes::one(&mathml::SYNTAX), &snippet.without_comments())
}

fn written(syntaxes: Syntaxes, snippet: &Snippet) -> String {
    let Code { mut comments, lines } = code(syntaxes, snippet);
    comments.extend(lines);
    comments.join("\n") + "\n"
}

/// A function, line by line.
struct Code {
    comments: Vec<String>,
    lines: Vec<String>,
}

fn code(syntaxes: Syntaxes, snippet: &Snippet) -> Code {
    let syntax = syntaxes.function;
    let Snippet { program, names, header, .. } = *snippet;
    assert_eq!(names.inputs.len(), program.inputs, "a name for each input");
    assert_eq!(names.outputs.len(), program.outputs.len(), "a name for each output");
    let usual = Signature::of(&snippet.function_name(), names, syntax.outputs_by_parameters);
    let signature = snippet.signature.unwrap_or(&usual);
    let mut naming = Naming::new(syntax.reserved, syntax.written, signature, &names.outputs);
    let head = naming.head(is_arithmetic(program));
    let mut comments: Vec<String> = Vec::new();
    if let Some(header) = header.filter(|_| !syntax.comment.is_empty()) {
        comments.extend(header::commented(syntax.comment, header));
        comments.extend(header::commented(syntax.comment, &naming.renamed()));
        if syntax.states_head {
            let [inputs, outputs] = [&head.inputs, &head.outputs].map(|names| names.join(", "));
            let head = format!("{} {inputs} -> {outputs}", latex::COLUMNS);
            comments.extend(header::commented(syntax.comment, &[head]));
        }
    }
    let mut lines = Vec::new();
    (syntax.open)(syntax, &head, &mut lines);
    let statements = body::statements(syntaxes, program, &head, &mut naming);
    lines.extend(statements.iter().map(|line| format!("    {line}")));
    (syntax.close)(syntax, &head, &mut lines);
    Code { comments, lines }
}

/// Returns true if the program computes no more than arithmetic, comparisons, minima and maxima.
fn is_arithmetic(program: &Program) -> bool {
    program.instrs.iter().all(|instr| {
        matches!(
            instr.op(),
            Op::Add
                | Op::Sub
                | Op::Mul
                | Op::Div
                | Op::Neg
                | Op::Mad
                | Op::Rcp
                | Op::Lerp
                | Op::Min
                | Op::Max
                | Op::Saturate
                | Op::Step
                | Op::Select
                | Op::Sign
        )
    })
}

impl Snippet<'_> {
    /// Returns the function's name: that of a signature, or else of its single output, too.
    fn function_name(&self) -> String {
        match (self.signature, self.names.outputs.as_slice()) {
            (Some(signature), _) => signature.function.clone(),
            (None, [output]) => of_output(self.function, output),
            (None, _) => self.function.to_owned(),
        }
    }
}

/// Returns `dfg_bias` for the output `bias` of `dfg`, unless the name says it already.
pub fn of_output(function: &str, output: &str) -> String {
    match function == output || function.ends_with(&format!("_{output}")) {
        true => function.to_owned(),
        false => format!("{function}_{output}"),
    }
}
