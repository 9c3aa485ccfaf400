//! The list of languages; all other lists are made from it.

use super::syntax::Syntax;
use super::{c, glsl, hlsl, latex, msl, python, rust, slang, wgsl};
use crate::suggest::did_you_mean;
use std::fmt;

/// The facts of a language beside its syntax.
struct Entry {
    name: &'static str,
    aliases: &'static [&'static str],
    extension: &'static str,
    syntax: &'static Syntax,
    /// The syntax of halves; only shading languages, which are read back, have it.
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

            /// The shading languages: they have halves, and [`read_back`](super::read_back)
            /// understands them.
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
        /// OpenGL, Vulkan, WebGL2: the common part of `#version 300 es` and desktop GLSL.
        Glsl: glsl, "glsl", ["opengl", "webgl", "webgl2", "essl", "gl"], "glsl";
        /// Metal, with `using namespace metal`.
        Msl: msl, "msl", ["metal"], "metal";
        /// For `slangc`, which compiles it for most GPUs.
        Slang: slang, "slang", [], "slang";
    }
    others {
        /// C99 and C++.
        C: c, "c", ["c99", "c++", "cpp"], "c";
        /// Functions of `f32`.
        Rust: rust, "rust", ["rs"], "rs";
        /// Functions of numpy arrays.
        Python: python, "python", ["py", "numpy"], "py";
        /// An `align*`, for a paper.
        Latex: latex, "latex", ["tex"], "tex";
    }
}

/// A name that no language has.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no language is called `{given}`{hint} (there are {known})")]
pub struct UnknownLanguage {
    /// The name that was given.
    pub given: String,
    hint: String,
    known: String,
}

impl Language {
    /// Returns the language of a name or alias, in upper or lower case.
    ///
    /// # Errors
    /// [`UnknownLanguage`] lists the names there are.
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

    /// Lists what `text` says of each language, as in `hlsl, wgsl and glsl`, with the `conjunction`
    /// before the last one.
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

    /// Lists names as [`Language::list`] does.
    pub fn names(languages: &[Language], conjunction: &str) -> String {
        Language::list(languages, conjunction, |language| language.name().to_owned())
    }

    /// Returns the name on the command line.
    pub fn name(self) -> &'static str {
        self.entry().name
    }

    /// Returns the file extension, without the dot.
    pub fn extension(self) -> &'static str {
        self.entry().extension
    }

    pub(super) fn syntax(self) -> &'static Syntax {
        self.entry().syntax
    }

    /// Returns the syntax of halves, if there is one.
    pub(super) fn half_syntax(self) -> Option<&'static Syntax> {
        self.entry().half
    }
}

impl fmt::Display for Language {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
