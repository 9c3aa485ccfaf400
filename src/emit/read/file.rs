//! Files of languages and of engines: which language they hold, and where.

use super::{Read, ReadBack, ReadError, read_back};
use crate::emit::{Engine, Language};
use std::path::Path;

/// Reads the function of a file, whose name says what it is for: a language, or an engine.
///
/// # Errors
/// [`ReadError`] as [`read_back`]; none is returned for a name that says nothing.
pub fn read_file(path: &Path, text: &str) -> Option<Read<(Language, ReadBack)>> {
    let language = language_of(path)?;
    let is_script = matches!(language, Language::Js | Language::Tsl);
    if is_script && text.contains('`') {
        return Some(of_literals(text));
    }
    let language = match language {
        Language::Js if text.contains("three/tsl") => Language::Tsl,
        Language::Glsl if has_precision(text) => Language::GlslEs,
        other => other,
    };
    Some(read_back(language, text).map(|code| (language, code)))
}

/// Returns the language of a file by its name's end.
pub fn language_of(path: &Path) -> Option<Language> {
    let name = path.file_name()?.to_str()?.to_ascii_lowercase();
    let ends = |extension: &str| {
        name.strip_suffix(extension).is_some_and(|stem| stem.ends_with('.') && stem.len() > 1)
    };
    let engine = Engine::ALL.iter().find(|engine| ends(engine.extension()));
    let engine = engine.map(|engine| match ends("js") {
        true => Language::Js,
        false => engine.language(),
    });
    Language::of_file(path).or(engine)
}

/// Returns true if types of GLSL have precisions.
fn has_precision(text: &str) -> bool {
    text.split(|c: char| !c.is_ascii_alphanumeric() && c != '_').any(|word| word == "mediump")
}

/// Reads the shaders in a script's template literals: GLSL, and perhaps the same in WGSL.
fn of_literals(text: &str) -> Read<(Language, ReadBack)> {
    let marks: Vec<usize> = text.match_indices('`').map(|(at, _)| at).collect();
    let literals: Vec<[usize; 2]> = match marks.as_chunks::<2>() {
        (literals, []) => literals.to_vec(),
        (_, [open, ..]) => return Err(ReadError::at(text, *open, "a literal without an end")),
    };
    only_known(text, &literals)?;
    let mut found: Option<(Language, ReadBack)> = None;
    for [open, close] in literals {
        let escape = text[open..close].find(['\\', '$']).map(|at| open + at);
        let rest = text[close + 1..].lines().next().unwrap_or("");
        if let Some(at) = escape {
            return Err(ReadError::at(
                text,
                at,
                "an escape in a literal, which makes another text",
            ));
        }
        if rest.trim() != ";" {
            return Err(ReadError::at(text, close, "expected `;` after the literal"));
        }
        let shader = alone(text, open + 1, close);
        let is_wgsl = text[open..close].contains("fn ");
        let language = match (is_wgsl, has_precision(&text[open..close])) {
            (true, _) => Language::Wgsl,
            (false, true) => Language::GlslEs,
            (false, false) => Language::Glsl,
        };
        let code = read_back(language, &shader)?;
        let store = text[..open].lines().next_back().unwrap_or("");
        match &mut found {
            _ if is_wgsl != store.contains("StoreWGSL[") => {
                return Err(ReadError::at(
                    text,
                    open,
                    "a shader of another language than its place",
                ));
            }
            None => found = Some((language, code)),
            Some((_, first)) if is_wgsl && first.variant.is_none() => {
                first.variant = Some(Box::new(code));
            }
            Some(_) => return Err(ReadError::at(text, open, "a second shader of its language")),
        }
    }
    found.ok_or_else(|| ReadError::at(text, 0, "no shader stands in the script"))
}

/// Refuses a script that has more around its literals than engines' files have: an import, and what
/// the literals are. Anything else may change what they mean.
fn only_known(text: &str, literals: &[[usize; 2]]) -> Read<()> {
    let mut at = 0;
    for line in text.split_inclusive('\n') {
        let start = at;
        at += line.len();
        // Literals begin at the end of a line, and end at the beginning of one.
        let inside = literals.iter().any(|[open, close]| (*open + 1..*close).contains(&start));
        let code = line.trim();
        if inside || code.is_empty() || code.starts_with("//") || code == "`;" || is_known(code) {
            continue;
        }
        let message = "not read here: beside shaders a script has an import of `ShaderStore` and what the \
             shaders are, `export const dfg = /* glsl */` or `ShaderStore.IncludesShadersStore[\"dfg\"] =`";
        return Err(ReadError::at(text, start + line.len() - line.trim_start().len(), message));
    }
    Ok(())
}

fn is_known(code: &str) -> bool {
    let is_name = |name: &str| {
        !name.is_empty() && name.bytes().all(|b| b.is_ascii_alphanumeric() || b == b'_')
    };
    let between = |before: &str, after: &str| {
        code.strip_prefix(before).and_then(|rest| rest.strip_suffix(after)).is_some_and(is_name)
    };
    code == "import { ShaderStore } from \"@babylonjs/core/Engines/shaderStore\";"
        || between("export const ", " = /* glsl */`")
        || between("ShaderStore.IncludesShadersStore[\"", "\"] = `")
        || between("ShaderStore.IncludesShadersStoreWGSL[\"", "\"] = `")
}

/// Returns the text with blanks in place of all but a part and the comment lines before it, so that
/// places stay the same.
fn alone(text: &str, from: usize, to: usize) -> String {
    let mut at = 0;
    let mut kept = String::with_capacity(text.len());
    for line in text.split_inclusive('\n') {
        let is_comment = at + line.len() <= from && line.trim_start().starts_with("//");
        for (i, c) in line.char_indices() {
            let inside = (from..to).contains(&(at + i));
            kept.push(match c {
                '\n' => '\n',
                c if inside || is_comment => c,
                _ => ' ',
            });
            // A character of several bytes keeps its length.
            let more = if inside || is_comment || c == '\n' { 0 } else { c.len_utf8() - 1 };
            kept.extend(std::iter::repeat_n(' ', more));
        }
        at += line.len();
    }
    kept
}
