//! The front ends: naga's, each in a thread of its own, and a compiler where that for GLSL fails.

use super::depth::{check_depth, too_deep};
use super::external::{self, Rejected};
use super::interpreter::DEEPEST_BLOCK;
use super::order::{deepest, ordered};
use super::signature::signatures;
use super::source::Source;
use super::text::Text;
use super::{Error, glsl};
use naga::front::glsl::{ErrorKind, Frontend, Options};
use naga::front::{spv, wgsl};
use naga::valid::{Capabilities, ValidationFlags, Validator};
use naga::{Expression, Module, Span, Statement};
use std::path::Path;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::Duration;

/// The stack of the thread that parses: chains of operators and of `else if` go as deep as they are
/// long. By hand; only what is used takes memory.
const STACK: usize = 1 << 30;
/// The longest time that a parser may take: naga's is quadratic in the length of a function. By hand.
const PATIENCE: Duration = Duration::from_secs(60);

/// What to do where the module is found to be no valid one: usually the front end made a mistake.
const READER: &str = "if that is in order, the reader of shaders (naga) does not know it: write that expression otherwise";

/// What is wrong with `#include` where it is left.
const NOT_BESIDE: &str = "there is no such file beside this one";

/// Names that are given from outside, and their types in GLSL.
pub(super) type Given = [(String, String)];

impl Source {
    pub fn wgsl(path: &Path, written: &Text) -> Result<Source, Error> {
        check_depth(path, written, &written.text)?;
        let source = Source::without_module(path, written.text.clone());
        let source = Source { written: written.clone(), ..source };
        let text = source.text.clone();
        let parsed = apart(path, move || wgsl::parse_str(&text))?;
        let module = parsed.map_err(|error| {
            let span = error.labels().next().map(|(span, _)| span).unwrap_or_default();
            let labels: Vec<&str> = error.labels().map(|(_, label)| label).collect();
            let label = labels.join(", ");
            let at = span.to_range().and_then(|range| source.text.get(range.start..));
            let message = if at.is_some_and(|rest| rest.starts_with("#include")) {
                NOT_BESIDE.to_owned()
            } else if at.is_some_and(|rest| rest.starts_with('#')) {
                "WGSL has no preprocessor; give the text that yours makes of it".to_owned()
            } else if error.message() == "internal WGSL front end error" {
                "an expression is nested too deep for its parser; take it apart".to_owned()
            } else if label.is_empty() {
                error.message().to_owned()
            } else {
                format!("{} ({label})", error.message())
            };
            source.error(span, message)
        })?;
        source.checked(module)
    }

    /// Reads GLSL. What it uses and does not declare may be given from outside.
    pub fn glsl(path: &Path, written: &Text, outside: &Given) -> Result<Source, Error> {
        check_depth(path, written, &written.text)?;
        let (error, is_explained) = match Source::glsl_by_naga(path, written, outside) {
            Ok(source) => return Ok(source),
            Err(failed) => failed,
        };
        // naga reads a part of GLSL.
        match Source::glsl_compiled(path, written, outside) {
            Some(Ok(source)) => Ok(source),
            Some(Err(Some(other))) if !is_explained => Err(other),
            _ => Err(error),
        }
    }

    /// Returns what is wrong, too, and whether that says what to do.
    fn glsl_by_naga(path: &Path, written: &Text, outside: &Given) -> Result<Source, (Error, bool)> {
        let stage = glsl::stage_of(path);
        let mut defined: Vec<(String, String)> = Vec::new();
        loop {
            let source = Source::prepared(path, written, &defined);
            let text = source.text.clone();
            let parse = move || Frontend::default().parse(&Options::from(stage), &text);
            let error = match apart(path, parse).map_err(|error| (error, false))? {
                Ok(module) => return source.checked(module).map_err(|error| (error, false)),
                Err(errors) => errors.errors.into_iter().next(),
            };
            let Some(error) = error else {
                return Err((source.error(Span::default(), "it is not GLSL".into()), false));
            };
            let unknown = match &error.kind {
                ErrorKind::UnknownVariable(name) => Some(name.as_str()),
                _ => None,
            };
            if !define(unknown, outside, &mut defined) {
                let at = error.meta.to_range().and_then(|range| source.text.get(range.start..));
                let line = at.and_then(|rest| rest.split(';').next()).unwrap_or_default();
                let explained = glsl::explained(&error.kind, line);
                let message = explained.clone().unwrap_or_else(|| error.kind.to_string());
                return Err((source.error(error.meta, message), explained.is_some()));
            }
        }
    }

    /// Reads GLSL by way of a compiler; none if none is there. An inner error of none is not the
    /// text's.
    fn glsl_compiled(
        path: &Path,
        written: &Text,
        outside: &Given,
    ) -> Option<Result<Source, Option<Error>>> {
        let stage = glsl::stage_of(path);
        let mut defined: Vec<(String, String)> = Vec::new();
        loop {
            let source = Source::prepared(path, written, &defined);
            match external::glsl(path, stage, &source.text)? {
                Ok(code) => {
                    let read = Source::spir_v(path, code).map_err(|_| None);
                    return Some(read.map(|read| Source {
                        given: [source.given, read.given].concat(),
                        lacks_main: source.lacks_main,
                        declared: signatures(&written.text),
                        ..read
                    }));
                }
                Err(Rejected { line, message }) => {
                    let unknown = message.split_once("' : undeclared identifier");
                    let unknown = unknown.and_then(|(before, _)| before.rsplit('\'').next());
                    if !define(unknown, outside, &mut defined) {
                        let is_include = message.contains("'#include'");
                        let message = if is_include { NOT_BESIDE.to_owned() } else { message };
                        let error = line.map(|line| source.error_in_line(line, message));
                        return Some(Err(error));
                    }
                }
            }
        }
    }

    fn prepared(path: &Path, written: &Text, defined: &Given) -> Source {
        let prepared = glsl::prepared(&written.text, defined);
        Source {
            lines_before: prepared.lines_before,
            given: prepared.given,
            lacks_main: prepared.lacks_main,
            written: written.clone(),
            ..Source::without_module(path, prepared.text)
        }
    }

    pub fn spir_v(path: &Path, bytes: Vec<u8>) -> Result<Source, Error> {
        let source = Source::without_module(path, String::new());
        let points = entry_points(&bytes);
        let parsed = apart(path, move || {
            let options = spv::Options { strict_capabilities: false, ..spv::Options::default() };
            spv::parse_u8_slice(&bytes, &options).map_err(|error| error.to_string())
        })?;
        let module = parsed.map_err(|error| {
            source.error(Span::default(), format!("not SPIR-V that can be read: {error}"))
        })?;
        if module.entry_points.len() < points {
            let message = "the file is cut: a function is missing".to_owned();
            return Err(source.error(Span::default(), message));
        }
        let given = given_by_stage(&module);
        Ok(Source { given, ..source.checked(module)? })
    }

    /// Takes the module in, if it is a valid one: all that follows relies on its types, and goes as
    /// deep as its blocks.
    fn checked(self, module: Module) -> Result<Source, Error> {
        let checked = apart(&self.path, move || {
            if deepest(&module) > DEEPEST_BLOCK {
                return Err((Span::default(), too_deep()));
            }
            let module = ordered(module)?;
            let flags = ValidationFlags::all() & !ValidationFlags::BINDINGS;
            let checked = Validator::new(flags, Capabilities::all()).validate(&module);
            match checked {
                Ok(_) => Ok(module),
                Err(error) => {
                    let span = error.spans().next().map(|(span, _)| *span).unwrap_or_default();
                    Err((span, format!("{}; {READER}", causes(&error.into_inner()))))
                }
            }
        })?;
        match checked {
            Ok(module) => Ok(Source { module, ..self }),
            Err((span, message)) => Err(self.error(span, message)),
        }
    }
}

/// Returns the number of entry points that SPIR-V declares.
fn entry_points(bytes: &[u8]) -> usize {
    /// `OpEntryPoint`
    const ENTRY_POINT: u32 = 15;
    let word = |bytes: &[u8]| u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]);
    let words: Vec<u32> = bytes.chunks_exact(4).map(word).collect();
    let (mut count, mut at) = (0, 5);
    while let Some(first) = words.get(at) {
        count += usize::from(first & 0xffff == ENTRY_POINT);
        at += (first >> 16).max(1) as usize;
    }
    count
}

/// Returns the names of variables that entry points fill with what the stage gives them.
fn given_by_stage(module: &Module) -> Vec<String> {
    let mut given = Vec::new();
    for function in module.entry_points.iter().map(|point| &point.function) {
        for statement in function.body.iter() {
            let Statement::Store { pointer, value } = *statement else { continue };
            let is_given = matches!(function.expressions[value], Expression::FunctionArgument(_));
            if let (true, Expression::GlobalVariable(variable)) =
                (is_given, &function.expressions[pointer])
            {
                given.extend(module.global_variables[*variable].name.clone());
            }
        }
    }
    given
}

/// Defines what a file only uses, if it is given from outside; false if it is not.
fn define(unknown: Option<&str>, outside: &Given, defined: &mut Vec<(String, String)>) -> bool {
    let is_new = |name: &&str| defined.iter().all(|(known, _)| known != name);
    let given = unknown.filter(is_new).and_then(|name| outside.iter().find(|(n, _)| n == name));
    defined.extend(given.cloned());
    given.is_some()
}

fn causes(error: &dyn std::error::Error) -> String {
    let mut text = error.to_string();
    let mut cause = error.source();
    while let Some(error) = cause {
        text += &format!(": {error}");
        cause = error.source();
    }
    text
}

/// Runs a parser in a thread of its own, with a stack for deeply nested text; it may even panic, or
/// take too long: then it is left alone.
fn apart<T: Send + 'static>(
    path: &Path,
    parser: impl FnOnce() -> T + Send + 'static,
) -> Result<T, Error> {
    let whole = |message: String| Error::Whole { path: path.to_owned(), message };
    let (sender, receiver) = channel();
    let thread = std::thread::Builder::new().stack_size(STACK).name("shader".into());
    let parse = move || drop(sender.send(parser()));
    thread.spawn(parse).map_err(|error| whole(format!("cannot be read: {error}")))?;
    receiver.recv_timeout(PATIENCE).map_err(|error| match error {
        RecvTimeoutError::Timeout => whole(format!(
            "its parser takes more than {} s; give the function alone",
            PATIENCE.as_secs()
        )),
        RecvTimeoutError::Disconnected => {
            whole("its parser failed on it; simplify the file, or give the function alone".into())
        }
    })
}
