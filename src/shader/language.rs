//! The languages of shader files.

use std::path::Path;

/// The languages that shaders are read in, by their files' extensions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Language {
    /// Through naga's front end.
    Wgsl,
    /// Through naga's front end, or a compiler where that fails; a bare function without version or
    /// main, too.
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
