//! Reading of emitted functions back to programs.
//!
//! A snippet is one function of floats, or of halves, without branches: locals, arithmetic, the
//! functions that spell operations, and a `return`. That is more than is emitted, so that a snippet
//! may be edited by hand and still be verified. Anything else that a compiler might understand is
//! refused, never skipped: a type, a number of another type, a preprocessor line.

mod agreement;
mod call;
mod contract;
mod declaration;
mod expression;
mod file;
mod latex;
mod lex;
mod materialx;
mod order;
mod over;
mod spelled;
mod statement;
mod types;

pub use contract::{Stated, StatedError, derived_line, formula_line};
pub(super) use contract::{call_line, let_line, name_line};
pub use file::{language_of, read_file};
pub use over::Over;

use super::signature::returned_names;
use super::{Head, Language, Parameter, Syntax};
use crate::eval::{Arithmetic, Half};
use crate::op::{MAX_ARITY, Op};
use crate::program::{Arg, Draft, Names, Program, effective, place, pointed, use_counts};
use contract::Contract;
use half::f16;
use lex::{Comment, Lexed, Token, lex};
use std::collections::{HashMap, HashSet};
use types::{Float, Type};

/// A text that is no function of the language, or more than can be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("snippet, line {line}, column {column}: {message}\n{}", pointed(.source_line, *.column))]
pub struct ReadError {
    /// The line, from 1.
    pub line: usize,
    /// The column in characters, from 1.
    pub column: usize,
    /// The reason.
    pub message: String,
    /// The text of the line.
    pub source_line: String,
}

impl ReadError {
    /// Describes an error in a text of one line that is no file.
    pub fn alone(&self) -> String {
        let ReadError { column, message, source_line, .. } = self;
        format!("column {column}: {message}\n{}", pointed(source_line, *column))
    }

    fn at(text: &str, offset: usize, message: impl Into<String>) -> ReadError {
        let (line, column, source_line) = place(text, offset);
        let (message, source_line) = (message.into(), source_line.to_owned());
        ReadError { line, column, message, source_line }
    }
}

/// The precision in which an instruction computes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Precision {
    /// Single precision throughout.
    Single,
    /// Arguments are rounded to halves before, the result after.
    Half,
    /// As in halves, but the result is the argument, rounded.
    Rounding,
}

/// A function that was read.
#[derive(Clone, Debug)]
pub struct ReadBack {
    /// The language.
    pub language: Language,
    /// The program that the function computes.
    pub program: Program,
    /// The names of the columns; those that are written differently are restored.
    pub names: Names,
    /// The names as they are written.
    pub written: Names,
    /// The precision of each instruction.
    pub precisions: Vec<Precision>,
    /// Where each output leaves: by `return`, `return.x` and so on, or by a parameter's component.
    pub places: Vec<String>,
    /// The parameters' names in order, also of those that results leave by.
    pub parameters: Vec<String>,
    /// True for a function of halves: its arguments and outputs are halves.
    pub in_half: bool,
    /// The same function in the other precision, where a file has both.
    pub variant: Option<Box<ReadBack>>,
    /// The function as it is written, where operations were found that it spells by several.
    pub literal: Option<Box<ReadBack>>,
    contract: Contract,
}

impl ReadBack {
    /// Returns the formula that the comments state, its outputs called `outputs`, or none if they
    /// state none.
    ///
    /// # Errors
    /// [`StatedError`] if a comment that is the formula of an output, or is marked as one, cannot
    /// be read; or if there are two.
    pub fn stated(&self, outputs: &[String]) -> Result<Option<Stated>, StatedError> {
        let names = Names { inputs: self.names.inputs.clone(), outputs: outputs.to_vec() };
        self.stated_over(&names)
    }

    /// Returns the formula that the comments state over these columns.
    ///
    /// # Errors
    /// As [`ReadBack::stated`].
    pub fn stated_over(&self, names: &Names) -> Result<Option<Stated>, StatedError> {
        self.contract.formula(names)
    }

    /// Returns what the comments say of outputs that are computed of the data's columns, as
    /// `total = scale + bias`.
    pub fn derived(&self) -> &[String] {
        self.contract.derived()
    }

    /// Adds what the comments do not say of columns and results.
    pub fn add_lets(&mut self, lets: &[String]) {
        self.contract.add_lets(lets);
    }

    /// Returns the parameters' components that are none of these columns and that nothing reads.
    pub fn unread<'a>(&'a self, columns: &'a [String]) -> impl Iterator<Item = &'a String> {
        let args = self.program.instrs.iter().flat_map(|instr| instr.args());
        let read: HashSet<Arg> = args.chain(&self.program.outputs).copied().collect();
        let inputs = self.names.inputs.iter().enumerate();
        let unread = inputs.filter(move |(i, name)| {
            !read.contains(&Arg::Input(*i as u16)) && !columns.contains(name)
        });
        unread.map(|(_, name)| name)
    }

    /// Returns what the comments say of columns that are no parameters, and of results that are no
    /// columns.
    ///
    /// # Errors
    /// [`CallError`](super::CallError) if two say something of the same.
    pub fn lets(&self) -> Result<super::Lets, super::CallError> {
        super::Lets::parse(self.contract.lets())
    }

    /// Evaluates the function in its own precision, halves where it has them.
    ///
    /// # Panics
    /// If `inputs` does not have one value for each parameter.
    pub fn evaluate(&self, inputs: &[f32]) -> Vec<f32> {
        let program = &self.program;
        assert_eq!(inputs.len(), program.inputs, "one value for each input");
        let rounded = |x: f32| if self.in_half { f16::from_f32(x).to_f32() } else { x };
        let inputs: Vec<f32> = inputs.iter().map(|&x| rounded(x)).collect();
        let mut results: Vec<f32> = Vec::with_capacity(program.instrs.len());
        let value = |arg: Arg, results: &[f32]| match arg {
            Arg::Input(i) => inputs[usize::from(i)],
            Arg::Const(i) => program.consts[usize::from(i)],
            Arg::Result(i) => results[usize::from(i)],
        };
        for (instr, &precision) in program.instrs.iter().zip(&self.precisions) {
            let mut args = [0.0; MAX_ARITY];
            args.iter_mut().zip(instr.args()).for_each(|(to, &arg)| *to = value(arg, &results));
            results.push(applied(instr.op(), args, precision));
        }
        program.outputs.iter().map(|&arg| rounded(value(arg, &results))).collect()
    }
}

fn applied(op: Op, args: [f32; MAX_ARITY], precision: Precision) -> f32 {
    match precision {
        Precision::Single => op.apply(args),
        _ => Half::default().apply(op, args.map(f16::from_f32)).to_f32(),
    }
}

/// The longest text that is read, in bytes: far more than any emitted function.
pub const MAX_SNIPPET: usize = 1 << 20;

/// Reads an emitted function back.
///
/// # Errors
/// [`ReadError`] where the text is not understood, or could mean something else to a compiler.
pub fn read_back(language: Language, text: &str) -> Result<ReadBack, ReadError> {
    if text.len() > MAX_SNIPPET {
        let message = format!("{} bytes are more than a snippet has (at most 1 MiB)", text.len());
        return Err(ReadError::at(text, 0, message));
    }
    let literal = read_literal(language, text)?;
    Ok(match literal.with_operations() {
        Some(found) => ReadBack { literal: Some(Box::new(literal)), ..found },
        None => literal,
    })
}

/// Reads a function operation by operation.
fn read_literal(language: Language, text: &str) -> Read<ReadBack> {
    let syntax = match (language, language.syntax()) {
        (Language::Latex, _) => return latex::read(text),
        (_, Some(syntax)) => syntax,
        (_, None) => return materialx::read(text),
    };
    let lexed = lex(language, &syntax.readable, text)?;
    if language == Language::Tsl {
        all_imported(text, &lexed)?;
    }
    read_function(language, syntax, text, &lexed, 0)
}

/// Refuses calls of functions that no line of imports names: a module has no others.
fn all_imported(text: &str, lexed: &Lexed) -> Read<()> {
    let imports = text.lines().filter(|line| line.starts_with("import "));
    let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let imported: HashSet<&str> = imports.flat_map(|line| line.split(|c| !is_part(c))).collect();
    let calls = lexed.tokens.windows(2).enumerate().filter_map(|(i, pair)| match pair {
        [(at, Token::Name(name)), (_, Token::Symbol('('))] if name != "return" => {
            Some((i, *at, name))
        }
        _ => None,
    });
    let is_method = |i: usize| i > 0 && lexed.tokens[i - 1].1 == Token::Symbol('.');
    for (i, at, name) in calls {
        if !imported.contains(name.as_str()) && !is_method(i) {
            let message = format!("`{name}` is not imported from 'three/tsl'");
            return Err(ReadError::at(text, at, message));
        }
    }
    Ok(())
}

/// Reads a function's head: `vec2 EnvDFG(float roughness, float nov)`. Returns it, and whether it is
/// of halves.
///
/// # Errors
/// [`ReadError`] where the text is no head in the language, or has a name that means something in
/// it.
pub fn read_head(language: Language, text: &str) -> Result<(Head, bool), ReadError> {
    let Some(syntax) = language.syntax().filter(|_| language != Language::Latex) else {
        let message = format!("{language} has no functions with heads");
        return Err(ReadError::at(text, 0, message));
    };
    let code = text.trim_end().trim_end_matches(['{', ';', ':']);
    let lexed = lex(language, &syntax.readable, code)?;
    let mut reader = Reader::new(language, syntax, code, &lexed, 0);
    reader.head_alone()?;
    let (of, qualifiers) = (reader.of, Some(reader.of_function.join(" ")));
    let Reader { function, parameters, returned, .. } = reader;
    let head = Head { function, qualifiers, parameters, returned, columns: Vec::new() };
    Ok((head, of == Type::Half))
}

/// Reads the function that begins with the token of this index, and its variant behind it.
fn read_function(
    language: Language,
    syntax: &'static Syntax,
    text: &str,
    lexed: &Lexed,
    first: usize,
) -> Read<ReadBack> {
    let mut reader = Reader::new(language, syntax, text, lexed, first);
    let names = reader.function()?;
    let variant = match reader.variant() {
        Some(_) => Some(Box::new(read_function(language, syntax, text, lexed, reader.next)?)),
        None => None,
    };
    Ok(ReadBack { variant, ..reader.finished(names, &lexed.comments)? })
}

/// The value of an expression.
#[derive(Clone)]
enum Value {
    Float(Float),
    Bits(u32),
    Compared(Comparison),
    Several(Several),
}

/// A condition.
#[derive(Clone, Copy)]
enum Comparison {
    /// The first is less than the second.
    Less(Arg, Arg),
    /// The first is not less than the second.
    AtLeast(Arg, Arg),
}

/// A parameter that results leave by.
struct Out {
    name: String,
    of: Type,
    size: usize,
    /// Its components once they are assigned, each with its local's name.
    value: Option<Vec<(Option<String>, Float)>>,
}

/// A vector or a structure: its components, and the locals that they are, if they are.
#[derive(Clone)]
struct Several {
    /// The name of its type.
    of: String,
    components: Vec<(Option<String>, Float)>,
}

/// A structure declared above the function.
struct Structure {
    name: String,
    members: Vec<String>,
    of: Type,
}

struct Reader<'a> {
    language: Language,
    syntax: &'static Syntax,
    half: Option<&'static Syntax>,
    text: &'a str,
    tokens: &'a [(usize, Token)],
    next: usize,
    depth: usize,
    draft: Draft,
    precisions: Vec<Precision>,
    /// Parameters and locals.
    values: HashMap<String, Value>,
    function: String,
    /// The words before the function.
    of_function: Vec<String>,
    /// The type of the function's parameters and outputs.
    of: Type,
    parameters: Vec<Parameter>,
    /// The type of the local whose value is read.
    local: Type,
    /// The number of outputs it returns, if its head says so.
    returned: Option<usize>,
    /// The parameters that results leave by.
    outs: Vec<Out>,
    /// True if the function stands in a call of `Fn`.
    closes_a_call: bool,
    structure: Option<Structure>,
}

type Read<T> = Result<T, ReadError>;

impl<'a> Reader<'a> {
    fn new(
        language: Language,
        syntax: &'static Syntax,
        text: &'a str,
        lexed: &'a Lexed,
        first: usize,
    ) -> Reader<'a> {
        Reader {
            language,
            syntax,
            half: language.half_syntax(),
            text,
            tokens: &lexed.tokens,
            next: first,
            depth: 0,
            draft: Draft::default(),
            precisions: Vec::new(),
            values: HashMap::new(),
            function: String::new(),
            of_function: Vec::new(),
            of: Type::Single,
            local: Type::Single,
            parameters: Vec::new(),
            returned: None,
            outs: Vec::new(),
            closes_a_call: false,
            structure: None,
        }
    }
}

impl Reader<'_> {
    fn finished(self, mut names: Names, comments: &[Comment]) -> Read<ReadBack> {
        let text = self.text;
        let program =
            Program::verify(self.draft).map_err(|e| ReadError::at(text, 0, e.to_string()))?;
        let mut counts = Vec::new();
        use_counts(&program, &mut counts);
        let kept = self.precisions.iter().zip(&counts).filter(|(_, count)| **count > 0);
        let precisions = kept.map(|(precision, _)| *precision).collect();
        let contract = Contract::of(text, comments);
        let written = names.clone();
        contract.restore(&mut names);
        let in_half = self.of == Type::Half;
        let (program, language) = (effective(&program), self.language);
        let out = self.parameters.iter().filter(|parameter| parameter.out);
        let out: Vec<String> = out.flat_map(Parameter::components).collect();
        let mut places = returned_names(names.outputs.len() - out.len());
        places.extend(out);
        let parameters = self.parameters.iter().map(|parameter| parameter.name.clone()).collect();
        let (variant, literal) = (None, None);
        Ok(ReadBack {
            language,
            places,
            parameters,
            program,
            names,
            written,
            precisions,
            in_half,
            variant,
            literal,
            contract,
        })
    }

    fn peek(&self) -> Option<&Token> {
        self.tokens.get(self.next).map(|(_, token)| token)
    }

    fn offset(&self) -> usize {
        self.tokens.get(self.next).map_or(self.text.trim_end().len(), |(at, _)| *at)
    }

    fn error<T>(&self, offset: usize, message: impl Into<String>) -> Read<T> {
        Err(ReadError::at(self.text, offset, message))
    }

    fn is_symbol(&self, ahead: usize, symbol: char) -> bool {
        self.tokens.get(self.next + ahead).is_some_and(|(_, t)| *t == Token::Symbol(symbol))
    }

    fn take_symbol(&mut self, symbol: char) -> bool {
        let found = self.is_symbol(0, symbol);
        self.next += usize::from(found);
        found
    }

    fn expect(&mut self, symbol: char, context: &str) -> Read<()> {
        if self.take_symbol(symbol) {
            return Ok(());
        }
        self.error(self.offset(), format!("expected `{symbol}` {context}"))
    }

    fn take_name(&mut self) -> Option<String> {
        let Some(Token::Name(name)) = self.peek() else { return None };
        let name = name.clone();
        self.next += 1;
        Some(name)
    }

    fn take_word(&mut self, word: &str) -> bool {
        let found = matches!(self.peek(), Some(Token::Name(name)) if name == word);
        self.next += usize::from(found);
        found
    }

    /// Adds an instruction of halves or of floats, and returns its result.
    fn push(&mut self, op: Op, args: &[Arg], of: Type) -> Read<Arg> {
        if self.draft.instrs.len() >= usize::from(u16::MAX) {
            return self.error(self.offset(), "more than 65535 operations");
        }
        // Numbers alone have no precision in GLSL ES: they have that of the local.
        let open_half =
            of == Type::Open && self.language == Language::GlslEs && self.local == Type::Half;
        let is_half = of == Type::Half || open_half;
        self.precisions.push(if is_half { Precision::Half } else { Precision::Single });
        Ok(self.draft.push(op, args))
    }

    fn number(&mut self, value: f32) -> Read<Arg> {
        if self.draft.consts.len() >= usize::from(u16::MAX) {
            return self.error(self.offset(), "more than 65535 numbers");
        }
        Ok(self.draft.constant(value))
    }
}
