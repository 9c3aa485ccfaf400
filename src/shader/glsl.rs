//! Makes GLSL as people have it readable for naga, which wants a version, a `main` and bindings.
//! Places stay: what is left out becomes blanks.

use super::definition::split;
use naga::ShaderStage;
use naga::front::glsl::ErrorKind;
use std::path::Path;

/// The binding of the first block that has none. By hand: above those that files give.
const FIRST_BINDING: usize = 1000;
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

/// Prepares a text; `defined` are variables that it uses and does not declare, with their types.
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
    for (index, &(at, word)) in words.iter().enumerate() {
        let next = words.get(index + 1).map_or("", |(_, next)| next);
        let is_precision = matches!(word, "lowp" | "mediump" | "highp");
        // naga knows either of `const in`.
        if is_precision || word == "const" && next == "in" {
            blank(&mut bytes, at..at + word.len());
        }
    }
    let Outside { mut given, blocks } = taken_out(&mut bytes, &code, &words);
    let built_in = words.iter().map(|(_, word)| *word).filter(|word| word.starts_with("gl_"));
    given.extend(built_in.map(str::to_owned));
    let mut text = String::from_utf8(bytes).unwrap_or_default();
    // naga wants a binding of each; the others' are not known.
    for (number, at) in blocks.iter().enumerate().rev() {
        text.insert_str(*at, &format!("layout(binding = {}) ", FIRST_BINDING + number));
    }
    let variables = defined.iter().map(|(name, ty)| format!("{ty} {name};\n"));
    // As OpenGL ES 2 calls it.
    let older =
        ["texture2D", "textureCube"].into_iter().filter(|name| code.contains(&format!("{name}(")));
    let older: String = older.map(|name| format!("#define {name} texture\n")).collect();
    let before = format!("#version 450\n{older}{}", variables.collect::<String>());
    given.extend(defined.iter().map(|(name, _)| name.clone()));
    let has_main = words.windows(2).any(|pair| pair[0].1 == "void" && pair[1].1 == "main");
    let main = if has_main { "" } else { "\nvoid main() {}\n" };
    let lines_before = before.matches('\n').count();
    let (text, lacks_main) = (format!("{before}{text}{main}"), !has_main);
    Prepared { text, lines_before, given, lacks_main }
}

/// What a text has from outside.
#[derive(Default)]
struct Outside {
    /// Variables.
    given: Vec<String>,
    /// The places of blocks without a binding.
    blocks: Vec<usize>,
}

/// Makes plain variables of those that are given from outside (uniforms, inputs of the stage). Blocks
/// keep their form, and textures what makes them such.
fn taken_out(bytes: &mut [u8], code: &str, words: &[(usize, &str)]) -> Outside {
    let mut outside = Outside::default();
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
        let is_from_outside = matches!(word, "uniform" | "buffer" | "varying" | "attribute" | "in");
        if !is_from_outside || depth > 0 {
            continue;
        }
        let rest = code[at..].bytes().take(LONGEST_DECLARATION);
        let length = rest.take_while(|byte| !b";{)".contains(byte)).count();
        let end = at + length;
        if code[end..].starts_with(';') && word != "buffer" {
            let names = words[index + 1..].iter().take_while(|(place, _)| *place < end);
            let names: Vec<&str> = names.map(|(_, name)| *name).collect();
            if names.first().is_some_and(|ty| is_texture(ty)) {
                continue;
            }
            // The type comes first, and what follows `=` or stands in `[ ]` is no name; a name too
            // many harms nobody.
            outside.given.extend(names.iter().skip(1).map(|name| (*name).to_owned()));
            blank(bytes, at..at + word.len());
            blank_layout_before(bytes, code, at);
        } else if code[end..].starts_with('{') && matches!(word, "uniform" | "buffer") {
            let start = code[..at].rfind([';', '}']).map_or(0, |place| place + 1);
            if !code[start..at].contains("binding") {
                outside.blocks.push(at);
            }
        }
    }
    outside
}

/// Returns true for the type of a texture in GLSL.
fn is_texture(ty: &str) -> bool {
    let ty = ty.trim_start_matches(['i', 'u']);
    ["sampler", "image", "mage", "texture", "subpassInput"].iter().any(|kind| ty.starts_with(kind))
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

/// Says what is wrong and what to do, where that is known; `statement` begins at the place of the
/// error.
pub(super) fn explained(kind: &ErrorKind, statement: &str) -> Option<String> {
    if let ErrorKind::UnknownVariable(name) = kind {
        return Some(format!(
            "`{name}` is declared nowhere; if it is a uniform, fix it, as in --set {name}=1.0; if it is a texture, import that as data (`lgp import`)"
        ));
    }
    let texture = words(statement).into_iter().find(|(_, word)| is_texture(word))?.1;
    Some(format!(
        "`{texture}` is a texture, of which there is no value; import it as data (`lgp import`), or leave its declaration out if the function does without"
    ))
}

/// Returns what `--set` and `--domain` give, which a text need not declare, with their types.
pub(super) fn given(set: &[String], ranged: &[String]) -> Vec<(String, String)> {
    let set = set.iter().filter_map(|text| split(text).ok());
    let mut given: Vec<(String, String)> =
        set.map(|(name, value)| (name.to_owned(), type_of(value))).collect();
    for column in ranged {
        // Of components that are named, a variable of as many.
        let component = column.rsplit_once('_').and_then(|(name, component)| {
            Some((name, "xyzw".find(component).filter(|_| component.len() == 1)?))
        });
        if let Some((name, place)) = component {
            let size = place.max(1) + 1;
            match given.iter_mut().find(|(known, _)| known == name) {
                Some((_, ty)) if ty.starts_with("vec") && !ty.ends_with('4') => {
                    *ty = format!("vec{}", size.max(ty[3..].parse().unwrap_or(size)));
                }
                Some(_) => {}
                None => given.push((name.to_owned(), format!("vec{size}"))),
            }
        }
        if given.iter().all(|(known, _)| known != column) {
            given.push((column.clone(), "float".to_owned()));
        }
    }
    given
}

/// Returns the type in GLSL of a value as WGSL writes it.
fn type_of(value: &str) -> String {
    let value = value.trim();
    let of_number = if matches!(value, "true" | "false") { "bool" } else { "float" };
    let Some(end) = value.find(['(', '<']).filter(|end| *end > 0) else {
        return of_number.to_owned();
    };
    let name = value[..end].trim().trim_end_matches('f');
    match name {
        "i32" => "int".to_owned(),
        "u32" => "uint".to_owned(),
        _ if name.starts_with("vec") || name.starts_with("mat") => name.to_owned(),
        _ => of_number.to_owned(),
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

/// Returns the text with the preprocessor's lines blanked.
pub(super) fn without_directives(text: &str) -> String {
    let mut bytes = text.as_bytes().to_vec();
    let mut goes_on = false;
    for (start, line) in lines(text) {
        if goes_on || line.trim_start().starts_with('#') {
            blank(&mut bytes, start..start + line.len());
            goes_on = line.trim_end().ends_with('\\');
        }
    }
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
