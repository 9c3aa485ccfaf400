//! Makes GLSL as people have it readable for naga, which wants a version, a `main` and bindings.
//! Places stay: what is left out becomes blanks.

use naga::ShaderStage;
use naga::front::glsl::ErrorKind;
use std::path::Path;

/// In bytes. By hand: longer ones are none.
const LONGEST_DECLARATION: usize = 1000;

/// A text for naga.
pub(super) struct Prepared {
    pub text: String,
    /// The number of lines before the file's own.
    pub lines_before: usize,
    /// The variables that are given from outside.
    pub given: Vec<String>,
    /// True if the file has no `main`.
    pub lacks_main: bool,
}

/// Returns the stage that a file's extension stands for.
pub(super) fn stage_of(path: &Path) -> ShaderStage {
    match path.extension().and_then(|extension| extension.to_str()) {
        Some("vert" | "vs") => ShaderStage::Vertex,
        Some("comp") => ShaderStage::Compute,
        _ => ShaderStage::Fragment,
    }
}

/// Prepares a text; `defined` are constants that it uses and does not declare.
pub(super) fn prepared(text: &str, defined: &[(String, String)]) -> Prepared {
    let mut bytes = text.as_bytes().to_vec();
    let code = without_comments(text);
    for (start, line) in lines(&code) {
        let directive = line.trim_start();
        let is_version =
            directive.strip_prefix('#').is_some_and(|d| d.trim_start().starts_with("version"));
        if is_version || directive.starts_with("precision ") {
            blank(&mut bytes, start..start + line.len());
        }
    }
    let words = words(&code);
    for &(at, word) in &words {
        if let "lowp" | "mediump" | "highp" = word {
            blank(&mut bytes, at..at + word.len());
        }
    }
    let given = taken_out(&mut bytes, &code, &words);
    let text = String::from_utf8(bytes).unwrap_or_default();
    let constants = defined.iter().map(|(name, value)| {
        let ty = type_of(value);
        format!("const {ty} {name} = {value};\n")
    });
    let before = format!("#version 450\n{}", constants.collect::<String>());
    let has_main = words.windows(2).any(|pair| pair[0].1 == "void" && pair[1].1 == "main");
    let main = if has_main { "" } else { "\nvoid main() {}\n" };
    let lines_before = before.matches('\n').count();
    let (text, lacks_main) = (format!("{before}{text}{main}"), !has_main);
    Prepared { text, lines_before, given, lacks_main }
}

/// Makes plain variables of those that are given from outside (uniforms, inputs of the stage), and
/// returns their names. Blocks keep their form.
fn taken_out(bytes: &mut [u8], code: &str, words: &[(usize, &str)]) -> Vec<String> {
    let mut given = Vec::new();
    let (mut depth, mut counted) = (0usize, 0);
    for (index, &(at, word)) in words.iter().enumerate() {
        for byte in code[counted..at].bytes() {
            match byte {
                b'(' | b'{' | b'[' => depth += 1,
                b')' | b'}' | b']' => depth = depth.saturating_sub(1),
                _ => {}
            }
        }
        counted = at;
        if !matches!(word, "uniform" | "varying" | "attribute" | "in") || depth > 0 {
            continue;
        }
        let rest = code[at..].bytes().take(LONGEST_DECLARATION);
        let length = rest.take_while(|byte| !b";{)".contains(byte)).count();
        let end = at + length;
        if code[end..].starts_with(';') {
            let names = words[index + 1..].iter().take_while(|(place, _)| *place < end);
            let names: Vec<&str> = names.map(|(_, name)| *name).collect();
            // The type comes first, and what follows `=` or stands in `[ ]` is no name; a name too
            // many harms nobody.
            given.extend(names.iter().skip(1).map(|name| (*name).to_owned()));
            blank(bytes, at..at + word.len());
            blank_layout_before(bytes, code, at);
        }
    }
    given
}

/// Blanks `layout(…)` and interpolation qualifiers before a place.
fn blank_layout_before(bytes: &mut [u8], code: &str, at: usize) {
    let start = code[..at].rfind([';', '}', '\n']).map_or(0, |place| place + 1);
    let between = &code[start..at];
    let is_qualifier = |word: &str| matches!(word, "layout" | "flat" | "smooth" | "noperspective");
    if words(between).first().is_some_and(|(_, word)| is_qualifier(word)) {
        blank(bytes, start..at);
    }
}

/// Says what is wrong, and what to do where it is usual.
pub(super) fn explained(kind: &ErrorKind) -> String {
    match kind {
        ErrorKind::UnknownVariable(name) => format!(
            "`{name}` is declared nowhere; if it is a uniform, fix it, as in --set {name}=1.0; if it is a texture, import that as data (`lgp import`)"
        ),
        ErrorKind::UnknownType(name) if name.contains("sampler") => format!(
            "`{name}` is a texture, of which there is no value; import it as data (`lgp import`), or leave its declaration out if the function does without"
        ),
        kind => kind.to_string(),
    }
}

/// Returns the type of a value as `--set` has it.
fn type_of(value: &str) -> &str {
    let value = value.trim();
    match value.find('(') {
        Some(end) => value[..end].trim(),
        None if matches!(value, "true" | "false") => "bool",
        None => "float",
    }
}

/// Returns the text with comments blanked, byte for byte.
pub(super) fn without_comments(text: &str) -> String {
    let mut bytes = text.as_bytes().to_vec();
    let mut at = 0;
    while at + 1 < bytes.len() {
        let length = match &bytes[at..at + 2] {
            b"//" => bytes[at..].iter().take_while(|byte| **byte != b'\n').count(),
            b"/*" => {
                let end = text.as_bytes()[at + 2..].windows(2).position(|pair| pair == b"*/");
                end.map_or(bytes.len() - at, |length| length + 4)
            }
            _ => {
                at += 1;
                continue;
            }
        };
        blank(&mut bytes, at..at + length);
        at += length;
    }
    // Blanked are whole comments, so that characters stay whole.
    String::from_utf8(bytes).unwrap_or_default()
}

fn blank(bytes: &mut [u8], range: std::ops::Range<usize>) {
    bytes[range].iter_mut().filter(|byte| **byte != b'\n').for_each(|byte| *byte = b' ');
}

fn lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    text.split_inclusive('\n').scan(0, |start, line| {
        let at = *start;
        *start += line.len();
        Some((at, line.trim_end_matches('\n')))
    })
}

/// Returns the identifiers of a text, with their places.
pub(super) fn words(text: &str) -> Vec<(usize, &str)> {
    let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let mut found = Vec::new();
    let mut start = None;
    for (at, c) in text.char_indices().chain([(text.len(), ' ')]) {
        match (start, is_part(c)) {
            (None, true) => start = Some(at),
            (Some(from), false) => {
                let word = &text[from..at];
                if !word.starts_with(|c: char| c.is_ascii_digit()) {
                    found.push((from, word));
                }
                start = None;
            }
            _ => {}
        }
    }
    found
}
