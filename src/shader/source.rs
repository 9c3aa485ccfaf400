//! Shader files that were read: modules of naga's intermediate representation, and where they come
//! from.

use super::Error;
use super::interpreter::Stop;
use super::signature::{Declared, Signature};
use super::text::Text;
use naga::{Module, Span};
use std::path::{Path, PathBuf};

/// A shader file that was read.
#[derive(Clone, Debug)]
pub(super) struct Source {
    pub path: PathBuf,
    /// The text as it was written.
    pub written: Text,
    /// The text that spans point into; empty for SPIR-V.
    pub text: String,
    /// The number of lines before the file's own.
    pub lines_before: usize,
    /// The names of global variables that are given from outside, though the module does not say so.
    pub given: Vec<String>,
    /// True if the file has no `main`, which was added.
    pub lacks_main: bool,
    /// True if names end in a number that the author did not write.
    pub numbers_names: bool,
    /// The functions as their text declares them, where the module's types do not say which
    /// parameters are written to.
    pub declared: Vec<Signature>,
    pub module: Module,
}

impl Source {
    pub fn without_module(path: &Path, text: String) -> Source {
        let (path, module) = (path.to_owned(), Module::default());
        Source {
            path,
            written: Text::default(),
            text,
            lines_before: 0,
            given: Vec::new(),
            lacks_main: false,
            numbers_names: false,
            declared: Vec::new(),
            module,
        }
    }

    /// Returns the declaration of a function of so many parameters, if the text is known.
    pub fn declaration(&self, name: &str, parameters: usize) -> Option<&[Declared]> {
        let is_it = |s: &&Signature| s.name == name && s.parameters.len() == parameters;
        self.declared.iter().find(is_it).map(|signature| signature.parameters.as_slice())
    }

    /// Reports a stop of the interpreter.
    pub fn stopped(&self, stop: &Stop) -> Error {
        self.error(stop.span.unwrap_or_default(), stop.reason.clone())
    }

    /// Reports a problem at a place of the text.
    pub fn error(&self, span: Span, message: String) -> Error {
        let at = span.to_range().map(|range| range.start);
        let is_place = |at: &usize| self.text.is_char_boundary(*at) && !self.text.is_empty();
        match at.filter(is_place) {
            Some(at) => self.written.error(&self.path, &self.text, at, self.lines_before, message),
            None => Error::Whole { path: self.path.clone(), message },
        }
    }

    /// Reports a problem in a line of the text, counted from 1.
    pub fn error_in_line(&self, line: usize, message: String) -> Error {
        let start =
            self.text.split_inclusive('\n').take(line.saturating_sub(1)).map(str::len).sum();
        let blank = self.text.get(start..).unwrap_or_default();
        let blank = blank.len() - blank.trim_start_matches([' ', '\t']).len();
        let at = u32::try_from(start + blank).unwrap_or(0);
        self.error(Span::new(at, at + 1), message)
    }
}
