//! Engines: a file that drops in where an engine's users put such functions, in its spelling and
//! with its names.

use super::body::Syntaxes;
use super::call::Call;
use super::signature::{Head, Parameter, Signature};
use super::syntax::Syntax;
use super::{Code, Language, Snippet, code, glsl, glsl_es, hlsl, osl, wgsl};
use crate::program::Names;
use crate::suggest::did_you_mean;
use std::fmt;

/// How words of a name are joined.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Case {
    Snake,
    Camel,
    Pascal,
}

/// How a dot product of two unit vectors is called.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Dot {
    /// `n_dot_v`
    Words,
    /// `NoV`
    O,
    /// `NdotV`
    Infix,
    /// `dotNV`
    Prefix,
}

/// An engine's conventions.
struct Conventions {
    name: &'static str,
    aliases: &'static [&'static str],
    extension: &'static str,
    language: Language,
    functions: Case,
    parameters: Case,
    dot: Dot,
    /// What perceptual roughness is called, and alpha, its square.
    roughness: [&'static str; 2],
    /// True if results leave by parameters even if there is one.
    by_parameters: bool,
    has_halves: bool,
    write: Writer,
}

/// Writes the lines of a file: of halves but for some instructions, where they are given.
type Writer = fn(&Snippet, half: Option<&[usize]>) -> Vec<String>;

macro_rules! engines {
    ($($(#[$doc:meta])* $engine:ident: $conventions:ident;)*) => {
        /// An engine that functions can be written for.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum Engine {
            $($(#[$doc])* $engine,)*
        }

        impl Engine {
            /// Every engine.
            pub const ALL: &'static [Engine] = &[$(Engine::$engine,)*];

            const fn conventions(self) -> &'static Conventions {
                match self {
                    $(Engine::$engine => &$conventions,)*
                }
            }
        }
    };
}

engines! {
    /// Shader Graph's Custom Function node: HLSL with a function of floats and one of halves.
    Unity: UNITY;
    /// An `.ush` for materials and their Custom nodes.
    Unreal: UNREAL;
    /// A `.gdshaderinc` for Godot 4.
    Godot: GODOT;
    /// A chunk of GLSL for three.js, as a JavaScript module.
    Three: THREE;
    /// An include for Babylon.js, in GLSL and WGSL, as a JavaScript module.
    Babylon: BABYLON;
    /// A WGSL module to import in Bevy.
    Bevy: BEVY;
    /// GLSL to include in a Filament material.
    Filament: FILAMENT;
    /// OSL for Blender's Script node.
    Blender: BLENDER;
}

/// Unity 6: "Custom Function Node" of Shader Graph's manual; names as in the render pipelines'
/// `BSDF.hlsl` and `CommonMaterial.hlsl`, where `roughness` is alpha.
const UNITY: Conventions = Conventions {
    name: "unity",
    aliases: &["shadergraph"],
    extension: "unity.hlsl",
    language: Language::Hlsl,
    functions: Case::Pascal,
    parameters: Case::Camel,
    dot: Dot::Infix,
    roughness: ["perceptualRoughness", "roughness"],
    by_parameters: true,
    has_halves: true,
    write: unity,
};

/// Unreal Engine 5: "Custom Material Expressions" of its manual; names as in Karis' articles.
const UNREAL: Conventions = Conventions {
    name: "unreal",
    aliases: &["ue", "ue5"],
    extension: "ush",
    language: Language::Hlsl,
    functions: Case::Pascal,
    parameters: Case::Pascal,
    dot: Dot::O,
    roughness: ["Roughness", "Alpha"],
    by_parameters: false,
    has_halves: true,
    write: unreal,
};

/// Godot 4: "Shader preprocessor" of its manual; names as in `scene_forward_lights_inc.glsl`.
const GODOT: Conventions = Conventions {
    name: "godot",
    aliases: &["gdshader"],
    extension: "gdshaderinc",
    language: Language::Glsl,
    functions: Case::Snake,
    parameters: Case::Snake,
    dot: Dot::Infix,
    roughness: ["roughness", "alpha"],
    by_parameters: false,
    has_halves: true,
    write: godot,
};

/// three.js r187: names as in `lights_physical_pars_fragment.glsl.js`.
const THREE: Conventions = Conventions {
    name: "three",
    aliases: &["three.js", "threejs"],
    extension: "glsl.js",
    language: Language::Glsl,
    functions: Case::Camel,
    parameters: Case::Camel,
    dot: Dot::Prefix,
    roughness: ["roughness", "alpha"],
    by_parameters: false,
    has_halves: true,
    write: three,
};

/// Babylon.js 9: "Shader Code in Babylon.js" of its manual; names as in `pbrBRDFFunctions`.
const BABYLON: Conventions = Conventions {
    name: "babylon",
    aliases: &["babylon.js", "babylonjs"],
    extension: "fx.js",
    language: Language::Glsl,
    functions: Case::Camel,
    parameters: Case::Camel,
    dot: Dot::Infix,
    roughness: ["perceptualRoughness", "alphaG"],
    by_parameters: false,
    has_halves: true,
    write: babylon,
};

/// Bevy 0.19: names as in `pbr_lighting.wgsl`, where `roughness` is alpha.
const BEVY: Conventions = Conventions {
    name: "bevy",
    aliases: &[],
    extension: "bevy.wgsl",
    language: Language::Wgsl,
    functions: Case::Snake,
    parameters: Case::Snake,
    dot: Dot::Infix,
    roughness: ["perceptual_roughness", "roughness"],
    by_parameters: false,
    has_halves: true,
    write: bevy,
};

/// Filament 1.5x: names as in its documentation of materials, where `roughness` is alpha.
const FILAMENT: Conventions = Conventions {
    name: "filament",
    aliases: &["matc"],
    extension: "fs",
    language: Language::Glsl,
    functions: Case::Camel,
    parameters: Case::Camel,
    dot: Dot::O,
    roughness: ["perceptualRoughness", "roughness"],
    by_parameters: false,
    has_halves: true,
    write: filament,
};

/// Blender 4: "Open Shading Language" of its manual.
const BLENDER: Conventions = Conventions {
    name: "blender",
    aliases: &["cycles"],
    extension: "blender.osl",
    language: Language::Osl,
    functions: Case::Snake,
    parameters: Case::Snake,
    dot: Dot::Words,
    roughness: ["roughness", "alpha"],
    by_parameters: true,
    has_halves: false,
    write: blender,
};

/// A name that no engine has.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no engine is called `{given}`{hint} (there are {known})")]
pub struct UnknownEngine {
    /// The name that was given.
    pub given: String,
    hint: String,
    known: String,
}

impl Engine {
    /// Returns the engine of a name or alias, in upper or lower case.
    ///
    /// # Errors
    /// [`UnknownEngine`] lists the names there are.
    pub fn from_name(name: &str) -> Result<Engine, UnknownEngine> {
        let lower = name.to_ascii_lowercase();
        let found = Engine::ALL.iter().find(|engine| {
            engine.name() == lower || engine.conventions().aliases.contains(&lower.as_str())
        });
        found.copied().ok_or_else(|| UnknownEngine {
            given: name.to_owned(),
            hint: did_you_mean(&lower, Engine::ALL.iter().map(|engine| engine.name())),
            known: Engine::names("and"),
        })
    }

    /// Lists the names, as in `unity, unreal and godot`.
    pub fn names(conjunction: &str) -> String {
        let names: Vec<&str> = Engine::ALL.iter().map(|engine| engine.name()).collect();
        let (last, others) = names.split_last().expect("there are engines");
        format!("{} {conjunction} {last}", others.join(", "))
    }

    /// Returns the name on the command line.
    pub fn name(self) -> &'static str {
        self.conventions().name
    }

    /// Returns the file extension, without the first dot.
    pub fn extension(self) -> &'static str {
        self.conventions().extension
    }

    /// Returns the language of its functions.
    pub fn language(self) -> Language {
        self.conventions().language
    }

    /// Returns true if its functions may be of halves.
    pub fn has_halves(self) -> bool {
        self.conventions().has_halves
    }

    /// Returns true if a file has a function of floats and one of halves.
    pub fn has_both(self) -> bool {
        self == Engine::Unity
    }

    /// Returns the head that a function over these columns has by the engine's conventions.
    pub fn head(self, function: &str, names: &Names) -> Head {
        let Conventions { functions, by_parameters, .. } = *self.conventions();
        let parameter =
            |out| move |name: &String| Parameter::float(&self.parameter_name(name), out);
        let mut parameters: Vec<Parameter> = names.inputs.iter().map(parameter(false)).collect();
        if by_parameters {
            // What results are called stays: it is what is shown, and what comments say.
            let out = |name: &String| Parameter::float(name, true);
            parameters.extend(names.outputs.iter().map(out));
        }
        let returned = if by_parameters { Some(0) } else { None };
        let inputs = names.inputs.iter().zip(&parameters);
        let columns = inputs.map(|(column, parameter)| (column.clone(), parameter.name.clone()));
        let columns = columns.collect();
        let function = joined(function, functions);
        Head { function, qualifiers: None, parameters, returned, columns }
    }

    fn parameter_name(self, column: &str) -> String {
        let Conventions { parameters, dot, roughness, .. } = *self.conventions();
        let upper = |vector: &str| vector.to_ascii_uppercase();
        match (column, column.split_once("_dot_")) {
            ("roughness", _) => roughness[0].to_owned(),
            ("alpha", _) => roughness[1].to_owned(),
            (_, Some((a, b))) if a.len() == 1 && b.len() == 1 => match dot {
                Dot::Words => column.to_owned(),
                Dot::O => format!("{}o{}", upper(a), upper(b)),
                Dot::Infix => format!("{}dot{}", upper(a), upper(b)),
                Dot::Prefix => format!("dot{}{}", upper(a), upper(b)),
            },
            _ => joined(column, parameters),
        }
    }
}

/// Writes a function in one precision or two.
fn function(
    snippet: &Snippet,
    [single, halves]: [&'static Syntax; 2],
    half: Option<&[usize]>,
) -> Code {
    match half {
        Some(stay_single) => code(Syntaxes { function: halves, single, stay_single }, snippet),
        None => code(Syntaxes::one(single), snippet),
    }
}

/// GLSL as it is, or with precisions where it is of halves.
fn of_glsl(snippet: &Snippet, half: Option<&[usize]>) -> Code {
    let single = if half.is_some() { &glsl_es::SYNTAX } else { &glsl::SYNTAX };
    function(snippet, [single, &glsl_es::HALF], half)
}

/// Returns the comments and notes, unless there are to be none.
fn opened(snippet: &Snippet, comments: Vec<String>, notes: &[String]) -> Vec<String> {
    match snippet.header {
        Some(_) => comments.into_iter().chain(notes.iter().map(|n| format!("// {n}"))).collect(),
        None => Vec::new(),
    }
}

/// Puts lines between those that keep a file from being included twice.
fn guarded(function: &str, lines: impl IntoIterator<Item = String>) -> Vec<String> {
    let guard = format!("{}_INCLUDED", function.to_ascii_uppercase());
    let mut guarded = vec![format!("#ifndef {guard}"), format!("#define {guard}"), String::new()];
    guarded.extend(lines);
    guarded.extend([String::new(), "#endif".to_owned()]);
    guarded
}

fn unity(snippet: &Snippet, half: Option<&[usize]>) -> Vec<String> {
    const SYNTAXES: [&Syntax; 2] = [&hlsl::SYNTAX, &hlsl::HALF_BY_CAST];
    // As it is, or as one of both functions is called.
    let name = snippet.function_name();
    let ending = ["_float", "_half"].iter().find_map(|ending| name.strip_suffix(ending));
    let name = ending.map_or(name.clone(), str::to_owned);
    let named = |ending: &str, half: Option<&[usize]>| {
        let signature = snippet.signature.map(|signature| Signature {
            function: format!("{name}_{ending}"),
            ..signature.clone()
        });
        function(&Snippet { signature: signature.as_ref(), ..*snippet }, SYNTAXES, half)
    };
    let (single, halves) = (named("float", None), named("half", Some(half.unwrap_or(&[]))));
    let note =
        format!("Custom Function node: type File, name {name}; its precision chooses the function");
    let mut lines = opened(snippet, single.comments, &[note]);
    let both = single.lines.into_iter().chain([String::new()]).chain(halves.lines);
    lines.extend(guarded(&name, both));
    lines
}

fn unreal(snippet: &Snippet, half: Option<&[usize]>) -> Vec<String> {
    let Code { comments, lines: body } =
        function(snippet, [&hlsl::SYNTAX, &hlsl::HALF_BY_CAST], half);
    let mut lines = opened(snippet, comments, &custom_node(snippet));
    lines.extend(["#pragma once".to_owned(), String::new()]);
    lines.extend(body);
    lines
}

fn godot(snippet: &Snippet, half: Option<&[usize]>) -> Vec<String> {
    let Code { comments, lines: body } = of_glsl(snippet, half);
    let mut lines = opened(snippet, comments, &[]);
    lines.extend(guarded(&snippet.function_name(), body));
    lines
}

fn three(snippet: &Snippet, half: Option<&[usize]>) -> Vec<String> {
    let Code { comments, lines: body } = of_glsl(snippet, half);
    let mut lines = opened(snippet, comments, &[]);
    lines.push(format!("export const {} = /* glsl */`", snippet.function_name()));
    lines.extend(body);
    lines.push("`;".to_owned());
    lines
}

fn babylon(snippet: &Snippet, half: Option<&[usize]>) -> Vec<String> {
    let name = snippet.function_name();
    let Code { comments, lines: body } = of_glsl(snippet, half);
    let mut lines = opened(snippet, comments, &[format!("in a shader: #include<{name}>")]);
    let import = "import { ShaderStore } from \"@babylonjs/core/Engines/shaderStore\";";
    lines.extend([import.to_owned(), String::new()]);
    lines.push(format!("ShaderStore.IncludesShadersStore[\"{name}\"] = `"));
    lines.extend(body);
    lines.extend(["`;".to_owned(), String::new()]);
    // WebGPU's halves are a feature that a device may lack.
    lines.push(format!("ShaderStore.IncludesShadersStoreWGSL[\"{name}\"] = `"));
    lines.extend(code(Syntaxes::one(&wgsl::SYNTAX), snippet).lines);
    lines.push("`;".to_owned());
    lines
}

fn bevy(snippet: &Snippet, half: Option<&[usize]>) -> Vec<String> {
    let Code { comments, lines: body } = function(snippet, [&wgsl::SYNTAX, &wgsl::HALF], half);
    let note = "after Bevy 0.19 leave out the next line".to_owned();
    let mut lines = opened(snippet, comments, &[note]);
    lines.push(format!("#define_import_path {}", snippet.function_name()));
    lines.push(String::new());
    lines.extend(body);
    lines
}

fn filament(snippet: &Snippet, half: Option<&[usize]>) -> Vec<String> {
    let Code { comments, lines: body } = of_glsl(snippet, half);
    let mut lines = opened(snippet, comments, &[]);
    lines.extend(body);
    lines
}

fn blender(snippet: &Snippet, _: Option<&[usize]>) -> Vec<String> {
    let Code { comments, lines: body } = code(Syntaxes::one(&osl::SHADER), snippet);
    let mut lines = opened(snippet, comments, &[]);
    lines.extend(body);
    lines
}

/// Returns how a Custom node calls the function.
fn custom_node(snippet: &Snippet) -> Vec<String> {
    let Some(signature) = snippet.signature else { return Vec::new() };
    let function = &signature.function;
    let inputs: Vec<&str> = signature.parameters.iter().map(|p| p.name.as_str()).collect();
    let inputs = inputs.join(", ");
    vec![
        format!(
            "Custom node: output CMOT Float {}, inputs {inputs}, include this file, code:",
            signature.returned
        ),
        format!("    return {function}({inputs});"),
    ]
}

/// Joins the words of a name in another way.
fn joined(name: &str, case: Case) -> String {
    if case == Case::Snake {
        return name.to_owned();
    }
    let capital = |word: &str| {
        let mut letters = word.chars();
        letters.next().map_or(String::new(), |c| c.to_ascii_uppercase().to_string())
            + letters.as_str()
    };
    let words = name.split('_').filter(|word| !word.is_empty()).enumerate();
    let words = words.map(|(i, word)| match (i, case) {
        (0, Case::Camel) => word.to_owned(),
        _ => capital(word),
    });
    let text: String = words.collect();
    if text.is_empty() { name.to_owned() } else { text }
}

impl fmt::Display for Engine {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Writes the file of a program as it is called, for an engine. Halves are used throughout but for
/// the instructions of `half`, where it is given, if the engine has them; Unity's file has both
/// functions in any case. Without `header` there are no comments.
pub fn emit_for(
    engine: Engine,
    called: &Call,
    header: Option<&[String]>,
    half: Option<&[usize]>,
) -> String {
    let function = called.signature.function.clone();
    let snippet = Snippet {
        program: &called.program,
        names: &called.names,
        function: &function,
        signature: Some(&called.signature),
        header,
    };
    let half = half.filter(|_| engine.has_halves());
    (engine.conventions().write)(&snippet, half).join("\n") + "\n"
}
