//! The list of languages; all other lists are made from it.

use super::naming::is_identifier;
use super::signature::{Head, Signature};
use super::syntax::Syntax;
use super::{
    c, cpp, cuda, glsl, glsl_es, hlsl, js, latex, materialx, msl, osl, python, rust, slang, tsl,
    wgsl,
};
use crate::program::Names;
use crate::suggest::did_you_mean;
use std::fmt;
use std::path::Path;

/// The facts of a language; each language's file has one.
pub(super) struct Entry {
    pub name: &'static str,
    pub aliases: &'static [&'static str],
    pub extension: &'static str,
    pub form: Form,
    /// The syntax of halves, if the language has them.
    pub half: Option<&'static Syntax>,
}

/// What a program is written as.
pub(super) enum Form {
    /// A function, by its syntax.
    Function(&'static Syntax),
    /// A graph of nodes.
    Graph,
}

/// `Variant: module;` A language's module has its `LANGUAGE`.
macro_rules! languages {
    ($($(#[$doc:meta])* $language:ident: $module:ident;)*) => {
        /// A language that programs can be written in.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum Language {
            $($(#[$doc])* $language,)*
        }

        impl Language {
            /// Every language.
            pub const ALL: &'static [Language] = &[$(Language::$language,)*];

            /// Those that a run's folder and page hold of each member: all would be thousands of
            /// files, and `lgp emit` writes them.
            pub const OF_RUNS: &'static [Language] = &[
                Language::Hlsl,
                Language::Wgsl,
                Language::Glsl,
                Language::Msl,
                Language::Slang,
                Language::C,
                Language::Rust,
                Language::Python,
                Language::Latex,
            ];

            const fn entry(self) -> &'static Entry {
                match self {
                    $(Language::$language => &$module::LANGUAGE,)*
                }
            }
        }
    };
}

languages! {
    /// Direct3D, Unity, Unreal; shader model 5 and later.
    Hlsl: hlsl;
    /// WebGPU.
    Wgsl: wgsl;
    /// OpenGL, Vulkan, WebGL2: the common part of `#version 300 es` and desktop GLSL.
    Glsl: glsl;
    /// OpenGL ES 3 and WebGL2, with precision qualifiers.
    GlslEs: glsl_es;
    /// Metal, with `using namespace metal`.
    Msl: msl;
    /// For `slangc`, which compiles it for most GPUs.
    Slang: slang;
    /// Open Shading Language: Cycles, Arnold, RenderMan.
    Osl: osl;
    /// A MaterialX document: a node and the graph that it is.
    MaterialX: materialx;
    /// three.js's node language.
    Tsl: tsl;
    /// Functions of `Number`.
    Js: js;
    /// CUDA C++, for device and host.
    Cuda: cuda;
    /// C++14; `constexpr` where it is arithmetic alone.
    Cpp: cpp;
    /// C99.
    C: c;
    /// Functions of `f32`.
    Rust: rust;
    /// Functions of numpy arrays.
    Python: python;
    /// An `align*`, for a paper.
    Latex: latex;
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

    /// Returns the language of a file, by the longest extension that its name ends with.
    pub(super) fn of_file(path: &Path) -> Option<Language> {
        let name = path.file_name()?.to_str()?.to_ascii_lowercase();
        let of = |language: &&Language| {
            name.strip_suffix(language.extension()).is_some_and(|name| name.ends_with('.'))
        };
        let known = Language::ALL.iter().filter(of);
        known.max_by_key(|language| language.extension().len()).copied()
    }

    /// Returns the head that a function over these columns usually has.
    pub fn head(self, function: &str, names: &Names) -> Head {
        let by_parameters = self.syntax().is_some_and(|syntax| syntax.outputs_by_parameters);
        let Signature { function, qualifiers, parameters, returned } =
            Signature::of(function, names, by_parameters);
        Head { function, qualifiers, parameters, returned: Some(returned), columns: Vec::new() }
    }

    /// Returns true if the language has numbers of half precision.
    pub fn has_halves(self) -> bool {
        self.entry().half.is_some()
    }

    /// Returns true if a head's types say whether it is of halves; elsewhere a qualifier may.
    pub fn tells_halves(self) -> bool {
        self.has_halves() && self != Language::GlslEs
    }

    /// Returns true if a function may have this name.
    pub fn can_be_called(self, name: &str) -> bool {
        let reserved = self.syntax().map_or(glsl::SYNTAX.reserved, |syntax| syntax.reserved);
        is_identifier(name) && !reserved(name)
    }

    /// Returns the languages that have numbers of half precision.
    pub fn with_halves() -> Vec<Language> {
        Language::ALL.iter().copied().filter(|language| language.has_halves()).collect()
    }

    /// Returns the syntax of functions; none where programs are written as something else.
    pub(super) fn syntax(self) -> Option<&'static Syntax> {
        match self.entry().form {
            Form::Function(syntax) => Some(syntax),
            Form::Graph => None,
        }
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
