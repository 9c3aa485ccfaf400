//! Functions without branches, read as `lgp verify` reads snippets: where no compiler is installed.

use super::language::Language;
use super::{Error, Options};
use crate::emit::{self, read_back};
use crate::eval::{Arithmetic, Double};
use crate::program::{Names, Program};
use std::path::Path;

/// A function that is a program.
#[derive(Clone, Debug)]
pub(super) struct Straight {
    pub name: String,
    pub program: Program,
    pub names: Names,
}

impl Straight {
    /// Reads the only function of a text.
    pub fn read(
        path: &Path,
        text: &str,
        language: Language,
        options: &Options,
    ) -> Result<Straight, Error> {
        let whole = |message: String| Error::Whole { path: path.to_owned(), message };
        if let Some(option) = options.set.first().or(options.define.first()) {
            return Err(whole(format!("without a compiler, `{option}` cannot be; {TO_INSTALL}")));
        }
        let language = match language {
            Language::Slang => emit::Language::Slang,
            _ => emit::Language::Hlsl,
        };
        let read =
            read_back(language, text).map_err(|error| whole(format!("{error}\n{TO_INSTALL}")))?;
        let names = read.names;
        let name = options.entry.clone().unwrap_or_else(|| names.outputs.join("_"));
        Ok(Straight { name, program: read.program, names })
    }

    pub fn at(&self, point: &[f64]) -> Vec<f64> {
        Double.evaluate(&self.program, point)
    }
}

const TO_INSTALL: &str = "only a function without branches can be read; for others install slangc, glslangValidator or dxc";
