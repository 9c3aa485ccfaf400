//! The text of a shader, with the files that it includes, and the file and line of each place.

use super::Error;
use super::glsl::without_comments;
use crate::file::read_file;
use crate::program::{place, pointed};
use std::collections::HashSet;
use std::path::{Path, PathBuf};

/// The largest shader file, in bytes, what it includes among it. By hand: generated shaders of
/// 100,000 lines are smaller.
pub const LARGEST_SHADER: u64 = 16 << 20;
/// The most files that include each other. By hand: more include themselves.
const DEEPEST_INCLUDE: usize = 32;
/// The most files that are included in all. By hand: libraries have hundreds.
const MOST_INCLUDED: usize = 10_000;

/// A text that may be of several files.
#[derive(Clone, Debug, Default)]
pub(super) struct Text {
    pub text: String,
    /// In order; none if it is of one file.
    pieces: Vec<Piece>,
    lines: usize,
}

/// What comes from one file, up to the next piece.
#[derive(Clone, Debug)]
struct Piece {
    /// The index of its first line in the whole.
    at: usize,
    path: PathBuf,
    /// The index of that line in the file.
    line: usize,
}

/// The files that are not included again.
struct Seen {
    /// True if none is.
    once: bool,
    files: HashSet<PathBuf>,
}

impl Seen {
    fn contains(&mut self, file: &Path) -> bool {
        let Ok(file) = file.canonicalize() else { return false };
        if self.once { !self.files.insert(file) } else { self.files.contains(&file) }
    }
}

/// Returns the bytes of a shader file.
pub(super) fn read(path: &Path) -> Result<Vec<u8>, Error> {
    read_file(path, LARGEST_SHADER)
        .map_err(|source| Error::Unread { path: path.to_owned(), source })
}

/// Returns the text of bytes.
pub(super) fn text_of(path: &Path, bytes: Vec<u8>) -> Result<String, Error> {
    let text = String::from_utf8(bytes).map_err(|error| {
        let valid = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        let line = 1 + valid.iter().filter(|&&byte| byte == b'\n').count();
        let message = format!("line {line} is not UTF-8 text; save the file as UTF-8");
        Error::Whole { path: path.to_owned(), message }
    })?;
    // Editors of Windows begin files so.
    Ok(text.strip_prefix('\u{feff}').map(str::to_owned).unwrap_or(text))
}

impl Text {
    /// Takes a text as it is.
    pub fn of(text: String) -> Text {
        Text { text, ..Text::default() }
    }

    /// Puts the files that `#include` names in its place, as long as they are there; they are
    /// searched for from the including file's folder. With `once`, each only the first time.
    pub fn with_included(path: &Path, text: String, once: bool) -> Result<Text, Error> {
        if !text.contains("include") {
            return Ok(Text::of(text));
        }
        let mut whole = Text::default();
        let own = path.canonicalize().into_iter().filter(|_| once);
        let mut seen = Seen { once, files: own.collect() };
        whole.add(path, &text, &mut seen, 0)?;
        Ok(whole)
    }

    fn add(&mut self, path: &Path, text: &str, seen: &mut Seen, depth: usize) -> Result<(), Error> {
        self.begin(path, 0);
        let code = without_comments(text);
        for (index, (line, code)) in text.split_inclusive('\n').zip(code.split('\n')).enumerate() {
            if code.split_whitespace().eq(["#pragma", "once"]) {
                seen.files.extend(path.canonicalize());
                self.push("\n");
                continue;
            }
            let file = included(code).map(|name| beside(path, name));
            // What is not there may stand in a branch that is not taken.
            let Some((bytes, file)) = file.and_then(|file| Some((read(&file).ok()?, file))) else {
                self.push(line);
                continue;
            };
            if let Some(problem) = self.too_much(depth) {
                let message = format!("line {}: {problem}", index + 1);
                return Err(Error::Whole { path: path.to_owned(), message });
            }
            if !seen.contains(&file) {
                self.add(&file, &text_of(&file, bytes)?, seen, depth + 1)?;
            }
            if !self.text.ends_with('\n') {
                self.push("\n");
            }
            self.begin(path, index + 1);
        }
        Ok(())
    }

    fn too_much(&self, depth: usize) -> Option<String> {
        if depth == DEEPEST_INCLUDE {
            return Some(format!("files include each other {DEEPEST_INCLUDE} deep"));
        }
        if self.pieces.len() > MOST_INCLUDED {
            return Some(format!("more than {MOST_INCLUDED} files are included"));
        }
        let is_large = self.text.len() as u64 > LARGEST_SHADER;
        is_large.then(|| format!("more than {} MiB are included", LARGEST_SHADER >> 20))
    }

    fn push(&mut self, line: &str) {
        self.text += line;
        self.lines += usize::from(line.ends_with('\n'));
    }

    /// Begins a piece that comes from a line of a file.
    fn begin(&mut self, path: &Path, line: usize) {
        self.pieces.push(Piece { at: self.lines, path: path.to_owned(), line });
    }

    /// Reports a problem at a place of a text that has this one in it, after some lines.
    pub fn error(
        &self,
        path: &Path,
        text: &str,
        at: usize,
        lines_before: usize,
        message: String,
    ) -> Error {
        let (line, column, excerpt) = place(text, at);
        let line = line.saturating_sub(lines_before).max(1);
        let (path, line) = self.file(path, line);
        Error::At { path, line, column, message, excerpt: pointed(excerpt, column) }
    }

    /// Returns the file and the line of a line of the whole.
    fn file(&self, path: &Path, line: usize) -> (PathBuf, usize) {
        match self.pieces.iter().rev().find(|piece| piece.at < line) {
            Some(piece) => (piece.path.clone(), line - piece.at + piece.line),
            None => (path.to_owned(), line),
        }
    }
}

/// Returns the name in `#include "name"`.
fn included(line: &str) -> Option<&str> {
    let directive = line.trim_start().strip_prefix('#')?.trim_start().strip_prefix("include")?;
    let name = directive.trim_start().strip_prefix(['"', '<'])?;
    let name = name.split(['"', '>']).next()?;
    (!name.is_empty() && Path::new(name).is_relative()).then_some(name)
}

fn beside(path: &Path, name: &str) -> PathBuf {
    path.parent().unwrap_or(Path::new("")).join(name)
}
