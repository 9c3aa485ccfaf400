//! Reads shader files to modules of naga's intermediate representation.

use super::interpreter::Stop;
use super::{Error, glsl};
use crate::file::read_file;
use crate::program::{place, pointed};
use naga::front::{spv, wgsl};
use naga::valid::{Capabilities, ValidationFlags, Validator};
use naga::{Module, Span};
use std::path::{Path, PathBuf};

/// The largest shader file, in bytes. By hand: generated shaders of 100,000 lines are smaller.
pub const LARGEST_SHADER: u64 = 16 << 20;
/// The most brackets within each other: parsers go as deep.
const DEEPEST_NESTING: usize = 256;
/// The stack of the thread that parses: chains of operators and of `else if` go as deep as they are
/// long. By hand; only what is used takes memory.
const STACK: usize = 1 << 30;

/// The languages that shaders are read in, by their files' extensions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Language {
    /// Through naga's front end.
    Wgsl,
    /// Through naga's front end; a bare function without version or main, too.
    Glsl,
    /// Through a compiler to SPIR-V, or by the reader of snippets.
    Hlsl,
    /// As HLSL.
    Slang,
    /// Binary.
    SpirV,
}

/// Extensions of files, and the language that each stands for.
const EXTENSIONS: [(&str, Language); 12] = [
    ("wgsl", Language::Wgsl),
    ("glsl", Language::Glsl),
    ("frag", Language::Glsl),
    ("vert", Language::Glsl),
    ("comp", Language::Glsl),
    ("fs", Language::Glsl),
    ("vs", Language::Glsl),
    ("hlsl", Language::Hlsl),
    ("fx", Language::Hlsl),
    ("hlsli", Language::Hlsl),
    ("slang", Language::Slang),
    ("spv", Language::SpirV),
];

impl Language {
    /// Returns the language of a file, by its extension; none if it is no shader's.
    pub fn of(path: &Path) -> Option<Language> {
        let extension = path.extension()?.to_str()?.to_ascii_lowercase();
        EXTENSIONS.iter().find(|(known, _)| *known == extension).map(|(_, language)| *language)
    }
}

/// A shader file that was read.
#[derive(Clone, Debug)]
pub(super) struct Source {
    pub path: PathBuf,
    /// The text that spans point into; empty for SPIR-V.
    text: String,
    /// The number of lines before the file's own.
    lines_before: usize,
    /// The names of global variables that are given from outside, though the module does not say so.
    pub given: Vec<String>,
    /// True if the file has no `main`, which was added.
    pub lacks_main: bool,
    /// True if names end in a number that the author did not write.
    pub numbers_names: bool,
    /// By parameter of the function: true if it may write to it; empty if types say so.
    pub is_out: Vec<bool>,
    pub module: Module,
}

/// Returns the bytes of a shader file.
pub(super) fn read(path: &Path) -> Result<Vec<u8>, Error> {
    read_file(path, LARGEST_SHADER)
        .map_err(|source| Error::Unread { path: path.to_owned(), source })
}

/// Returns the text of bytes.
pub(super) fn text_of(path: &Path, bytes: Vec<u8>) -> Result<String, Error> {
    String::from_utf8(bytes).map_err(|error| {
        let valid = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        let line = 1 + valid.iter().filter(|&&byte| byte == b'\n').count();
        let message = format!("line {line} is not UTF-8 text; save the file as UTF-8");
        Error::Whole { path: path.to_owned(), message }
    })
}

impl Source {
    pub fn wgsl(path: &Path, text: String) -> Result<Source, Error> {
        check_nesting(path, &text)?;
        let source = Source::without_module(path, text);
        let text = source.text.clone();
        let parsed = apart(path, move || wgsl::parse_str(&text))?;
        let module = parsed.map_err(|error| {
            let span = error.labels().next().map(|(span, _)| span).unwrap_or_default();
            let labels: Vec<&str> = error.labels().map(|(_, label)| label).collect();
            let label = labels.join(", ");
            let message = if label.is_empty() {
                error.message().to_owned()
            } else {
                format!("{} ({label})", error.message())
            };
            source.error(span, message)
        })?;
        source.checked(module)
    }

    /// Reads GLSL; `set` are the names that `--set` gives, with their values as GLSL.
    pub fn glsl(path: &Path, text: &str, set: &[(String, String)]) -> Result<Source, Error> {
        check_nesting(path, text)?;
        let stage = glsl::stage_of(path);
        let mut defined: Vec<(String, String)> = Vec::new();
        loop {
            let prepared = glsl::prepared(text, &defined);
            let mut source = Source::without_module(path, prepared.text);
            (source.lines_before, source.given) = (prepared.lines_before, prepared.given);
            source.lacks_main = prepared.lacks_main;
            let text = source.text.clone();
            let parsed = apart(path, move || {
                let options = naga::front::glsl::Options::from(stage);
                naga::front::glsl::Frontend::default().parse(&options, &text)
            })?;
            let error = match parsed {
                Ok(module) => return source.checked(module),
                Err(errors) => errors.errors.into_iter().next(),
            };
            let Some(error) = error else {
                return Err(source.error(Span::default(), "it is not GLSL".into()));
            };
            // What the file only uses may be given from outside.
            let unknown = match &error.kind {
                naga::front::glsl::ErrorKind::UnknownVariable(name) => Some(name.clone()),
                _ => None,
            };
            let is_new = |name: &String| defined.iter().all(|(known, _)| known != name);
            match unknown.filter(is_new).and_then(|name| set.iter().find(|(n, _)| *n == name)) {
                Some(given) => defined.push(given.clone()),
                None => return Err(source.error(error.meta, glsl::explained(&error.kind))),
            }
        }
    }

    pub fn spir_v(path: &Path, bytes: Vec<u8>) -> Result<Source, Error> {
        let source = Source::without_module(path, String::new());
        let parsed = apart(path, move || {
            let options = spv::Options { strict_capabilities: false, ..spv::Options::default() };
            spv::parse_u8_slice(&bytes, &options).map_err(|error| error.to_string())
        })?;
        let module = parsed.map_err(|error| {
            source.error(Span::default(), format!("not SPIR-V that can be read: {error}"))
        })?;
        source.checked(module)
    }

    fn without_module(path: &Path, text: String) -> Source {
        let (path, module) = (path.to_owned(), Module::default());
        Source {
            path,
            text,
            lines_before: 0,
            given: Vec::new(),
            lacks_main: false,
            numbers_names: false,
            is_out: Vec::new(),
            module,
        }
    }

    /// Takes the module in, if it is a valid one: all that follows relies on its types.
    fn checked(self, module: Module) -> Result<Source, Error> {
        let (module, checked) = apart(&self.path.clone(), move || {
            let flags = ValidationFlags::all() & !ValidationFlags::BINDINGS;
            let checked = Validator::new(flags, Capabilities::all()).validate(&module);
            let checked = checked.map(|_| ()).map_err(|error| {
                let span = error.spans().next().map(|(span, _)| *span).unwrap_or_default();
                (span, causes(&error.into_inner()))
            });
            (module, checked)
        })?;
        match checked {
            Ok(()) => Ok(Source { module, ..self }),
            Err((span, message)) => Err(self.error(span, message)),
        }
    }

    /// Reports a stop of the interpreter.
    pub fn stopped(&self, stop: &Stop) -> Error {
        self.error(stop.span.unwrap_or_default(), stop.reason.clone())
    }

    /// Reports a problem at a place of the text.
    pub fn error(&self, span: Span, message: String) -> Error {
        let path = self.path.clone();
        let at = span.to_range().map(|range| range.start);
        let Some(at) = at.filter(|at| self.text.is_char_boundary(*at) && !self.text.is_empty())
        else {
            return Error::Whole { path, message };
        };
        let (line, column, excerpt) = place(&self.text, at);
        let line = line.saturating_sub(self.lines_before).max(1);
        Error::At { path, line, column, message, excerpt: pointed(excerpt, column) }
    }
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

/// Runs a parser in a thread of its own, with a stack for deeply nested text; it may even panic.
fn apart<T: Send + 'static>(
    path: &Path,
    parser: impl FnOnce() -> T + Send + 'static,
) -> Result<T, Error> {
    let whole = |message: &str| Error::Whole { path: path.to_owned(), message: message.to_owned() };
    let thread = std::thread::Builder::new().stack_size(STACK).name("shader".into());
    let thread =
        thread.spawn(parser).map_err(|error| whole(&format!("cannot be read: {error}")))?;
    thread.join().map_err(|_| {
        whole("its parser failed on it; simplify the file, or give the function alone")
    })
}

fn check_nesting(path: &Path, text: &str) -> Result<(), Error> {
    let mut depth = 0usize;
    for (at, byte) in text.bytes().enumerate() {
        match byte {
            b'(' | b'[' | b'{' => depth += 1,
            b')' | b']' | b'}' => depth = depth.saturating_sub(1),
            _ => {}
        }
        if depth > DEEPEST_NESTING {
            let source = Source::without_module(path, text.to_owned());
            let message = format!("brackets are nested more than {DEEPEST_NESTING} deep");
            return Err(source.error(Span::from(at..at + 1), message));
        }
    }
    Ok(())
}
