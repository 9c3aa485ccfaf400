//! The list of languages, of which everything else that lists them is made.

use super::syntax::Syntax;
use super::{c, glsl, hlsl, latex, msl, python, rust, slang, wgsl};
use crate::suggest::did_you_mean;
use std::fmt;

/// What is known of a language beside its syntax.
struct Entry {
    name: &'static str,
    aliases: &'static [&'static str],
    extension: &'static str,
    syntax: &'static Syntax,
    /// The syntax of its halves: of a shading language, which is read back.
    half: Option<&'static Syntax>,
}

/// `Variant: module, "name", [aliases], "extension";` A shading language's module has a `HALF`.
macro_rules! languages {
    (
        shading { $($(#[$shading_doc:meta])* $shading:ident: $s:ident, $s_name:literal,
            [$($s_alias:literal),*], $s_extension:literal;)* }
        others { $($(#[$other_doc:meta])* $other:ident: $o:ident, $o_name:literal,
            [$($o_alias:literal),*], $o_extension:literal;)* }
    ) => {
        /// A language that programs can be written in.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum Language {
            $($(#[$shading_doc])* $shading,)*
            $($(#[$other_doc])* $other,)*
        }

        impl Language {
            /// Every language.
            pub const ALL: &'static [Language] =
                &[$(Language::$shading,)* $(Language::$other,)*];

            /// The shading languages: those that have halves and that [`read_back`](super::read_back)
            /// understands.
            pub const SHADING: &'static [Language] = &[$(Language::$shading,)*];

            const fn entry(self) -> Entry {
                match self {
                    $(Language::$shading => Entry {
                        name: $s_name,
                        aliases: &[$($s_alias),*],
                        extension: $s_extension,
                        syntax: &$s::SYNTAX,
                        half: Some(&$s::HALF),
                    },)*
                    $(Language::$other => Entry {
                        name: $o_name,
                        aliases: &[$($o_alias),*],
                        extension: $o_extension,
                        syntax: &$o::SYNTAX,
                        half: None,
                    },)*
                }
            }
        }
    };
}

languages! {
    shading {
        /// Direct3D, Unity, Unreal; shader model 5 and later.
        Hlsl: hlsl, "hlsl", ["directx", "dx", "fx"], "hlsl";
        /// WebGPU.
        Wgsl: wgsl, "wgsl", ["webgpu", "wgpu"], "wgsl";
        /// OpenGL, Vulkan, WebGL2: what `#version 300 es` and desktop GLSL have in common.
        Glsl: glsl, "glsl", ["opengl", "webgl", "webgl2", "essl", "gl"], "glsl";
        /// Metal, with `using namespace metal`.
        Msl: msl, "msl", ["metal"], "metal";
        /// For `slangc`, which makes code for most GPUs of it.
        Slang: slang, "slang", [], "slang";
    }
    others {
        /// C99, and C++.
        C: c, "c", ["c99", "c++", "cpp"], "c";
        /// Of `f32`.
        Rust: rust, "rust", ["rs"], "rs";
        /// Of numpy arrays.
        Python: python, "python", ["py", "numpy"], "py";
        /// `align*`, for a paper.
        Latex: latex, "latex", ["tex"], "tex";
    }
}

/// A name that is no language's.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no language is called `{given}`{hint} (there are {known})")]
pub struct UnknownLanguage {
    pub given: String,
    hint: String,
    known: String,
}

impl Language {
    /// The language of this name or alias, in upper or lower case.
    ///
    /// # Errors
    /// [`UnknownLanguage`] says which names there are.
    pub fn from_name(name: &str) -> Result<Language, UnknownLanguage> {
        let lower = name.to_ascii_lowercase();
        let found = Language::ALL.iter().find(|language| {
            language.name() == lower || language.entry().aliases.contains(&lower.as_str())
        });
        found.copied().ok_or_else(|| {
            let known = Language::ALL.iter().map(|language| language.name());
            UnknownLanguage {
                given: name.to_owned(),
                hint: did_you_mean(&lower, known),
                known: Language::names(Language::ALL, "and"),
            }
        })
    }

    /// `hlsl, wgsl and glsl`: what is said of each language, before the last one with the `conjunction`.
    pub fn list(
        languages: &[Language],
        conjunction: &str,
        of: impl Fn(Language) -> String,
    ) -> String {
        let words: Vec<String> = languages.iter().map(|&language| of(language)).collect();
        match words.split_last() {
            Some((last, [])) => last.clone(),
            Some((last, others)) => format!("{} {conjunction} {last}", others.join(", ")),
            None => String::new(),
        }
    }

    /// Their names, as [`Language::list`] has them.
    pub fn names(languages: &[Language], conjunction: &str) -> String {
        Language::list(languages, conjunction, |language| language.name().to_owned())
    }

    /// The name on the command line.
    pub fn name(self) -> &'static str {
        self.entry().name
    }

    /// What the name of a file in this language ends in, without the dot.
    pub fn extension(self) -> &'static str {
        self.entry().extension
    }

    pub(super) fn syntax(self) -> &'static Syntax {
        self.entry().syntax
    }

    /// The syntax of its halves, if it has any.
    pub(super) fn half_syntax(self) -> Option<&'static Syntax> {
        self.entry().half
    }
}

impl fmt::Display for Language {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
