//! Shaders as truths: a function of a file, sampled in double precision.
//!
//! Files are read to naga's intermediate representation: WGSL and GLSL by its front ends, HLSL and
//! Slang by way of SPIR-V. An interpreter evaluates the function that is asked for, in `f64`, or
//! writes it down as a [`Program`] over its inputs, loops unrolled, so that
//! the original is costed and scored as formulas are. The constants of a shader are those of its
//! own precision.
//!
//! ```
//! use lgp::shader::{Options, Shader};
//!
//! let text = "fn schlick(v_dot_h: f32) -> f32 {
//!     let c = 1.0 - v_dot_h;
//!     return c*c*c*c*c;
//! }";
//! let shader = Shader::parse("schlick.wgsl".as_ref(), text.into(), &Options::default())?;
//! assert_eq!(shader.inputs(), ["v_dot_h"]);
//! assert_eq!(shader.at(&[0.5])?, [0.03125]);
//! # Ok::<(), lgp::shader::Error>(())
//! ```

mod budget;
mod columns;
mod definition;
mod depth;
mod entry;
mod error;
mod expression;
mod external;
mod front;
mod function;
mod glsl;
mod integers;
mod interpreter;
mod language;
mod machine;
mod macros;
mod math;
mod matrices;
mod operators;
mod order;
mod parameters;
mod paths;
mod signature;
mod source;
mod straight;
mod symbols;
mod text;
mod value;

pub use error::Error;
pub use language::Language;
pub use text::LARGEST_SHADER;

use crate::dataset::{Axis, Function, Origin};
use crate::program::Program;
use crate::truth::{Truth, axes_of, write_domain};
use external::{Compiled, compiled};
use function::Subject;
use source::Source;
use std::path::Path;
use std::sync::Arc;
use straight::Straight;
use text::{Text, read, text_of};

/// Which function of a file is meant, and what its parameters are.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// The function's name; by default the only one that no other calls.
    pub entry: Option<String>,
    /// Values of parameters, of their components, and of uniforms: `exposure=1.0`, `n=vec3(0,0,1)`.
    pub set: Vec<String>,
    /// Definitions: of a parameter by new names, which become inputs (`v = vec3(sqrt(1 - c*c), 0,
    /// c)`); or of an input by parameters (`n_dot_v = dot(n, v)`).
    pub define: Vec<String>,
    /// The inputs that have a range: an `out` parameter among them is read, too.
    pub ranged: Vec<String>,
}

/// A function of a shader, over inputs that are numbers.
#[derive(Clone, Debug)]
pub struct Shader {
    body: Body,
    origin: Function,
}

#[derive(Clone, Debug)]
enum Body {
    Interpreted(Arc<Subject>),
    Straight(Arc<Straight>),
}

impl Shader {
    /// Reads a function of a file.
    ///
    /// # Errors
    /// A file that cannot be read or is not understood; no function, or several; definitions that
    /// do not fit its parameters.
    pub fn load(path: &Path, options: &Options) -> Result<Shader, Error> {
        let (language, bytes) = (Shader::language(path)?, read(path)?);
        match language {
            Language::SpirV => Shader::parse(path, bytes, options),
            _ => {
                // WGSL has nothing that would keep a file from being included twice.
                let once = language == Language::Wgsl;
                let text = Text::with_included(path, text_of(path, bytes)?, once)?;
                Shader::of_text(path, language, text, options)
            }
        }
    }

    /// Reads a function of a file's bytes; the path says the language by its extension. What the
    /// file includes is not read.
    ///
    /// # Errors
    /// As [`Shader::load`].
    pub fn parse(path: &Path, bytes: Vec<u8>, options: &Options) -> Result<Shader, Error> {
        let language = Shader::language(path)?;
        if language == Language::SpirV {
            let code = bytes.iter().map(|byte| format!("{byte:02x}")).collect();
            return Shader::of(path, Source::spir_v(path, bytes)?, code, options);
        }
        Shader::of_text(path, language, Text::of(text_of(path, bytes)?), options)
    }

    fn language(path: &Path) -> Result<Language, Error> {
        Language::of(path).ok_or_else(|| {
            let message = "not a shader, by its extension; the languages are .wgsl, .glsl, .frag, .comp, .hlsl, .slang and .spv".to_owned();
            Error::Whole { path: path.to_owned(), message }
        })
    }

    fn of_text(
        path: &Path,
        language: Language,
        text: Text,
        options: &Options,
    ) -> Result<Shader, Error> {
        match language {
            Language::Wgsl => {
                let source = Source::wgsl(path, &text)?;
                Shader::of(path, source, text.text, options)
            }
            Language::Glsl => {
                let given = glsl::given(&options.set, &options.ranged);
                Shader::of(path, Source::glsl(path, &text, &given)?, text.text, options)
            }
            _ => match compiled(path, &text, language, options.entry.as_deref())? {
                Some(Compiled { mut source, name }) => {
                    source.numbers_names = language == Language::Slang;
                    let options = Options { entry: Some(name), ..options.clone() };
                    Shader::of(path, source, text.text, &options)
                }
                None => {
                    let straight = Straight::read(path, &text.text, language, options)?;
                    let entry = straight.name.clone();
                    let body = Body::Straight(Arc::new(straight));
                    Ok(Shader { body, origin: origin(path, text.text, entry, options) })
                }
            },
        }
    }

    fn of(path: &Path, source: Source, text: String, options: &Options) -> Result<Shader, Error> {
        let subject = Subject::new(source, options)?;
        let origin = origin(path, text, subject.name.clone(), options);
        Ok(Shader { body: Body::Interpreted(Arc::new(subject)), origin })
    }

    /// Reads the function that data are samples of again; none if it is a formula.
    ///
    /// # Errors
    /// As [`Shader::load`].
    pub fn of_origin(function: &Function, domain: &[Axis]) -> Result<Option<Shader>, Error> {
        let Function::Shader { file, text, entry, set, define } = function else {
            return Ok(None);
        };
        let path = Path::new(file);
        let bytes = match Language::of(path) {
            Some(Language::SpirV) => from_hexadecimal(text),
            _ => text.clone().into_bytes(),
        };
        let ranged = domain.iter().map(|axis| axis.name.to_string()).collect();
        let (set, define) = (set.clone(), define.clone());
        let options = Options { entry: Some(entry.clone()), set, define, ranged };
        Shader::parse(path, bytes, &options).map(Some)
    }

    /// Returns the function's name.
    pub fn name(&self) -> &str {
        match &self.body {
            Body::Interpreted(subject) => &subject.name,
            Body::Straight(straight) => &straight.name,
        }
    }

    /// Returns the names that need a range.
    pub fn inputs(&self) -> &[String] {
        match &self.body {
            Body::Interpreted(subject) => &subject.sampled,
            Body::Straight(straight) => &straight.names.inputs,
        }
    }

    /// Returns the names of what it returns.
    pub fn outputs(&self) -> &[String] {
        match &self.body {
            Body::Interpreted(subject) => &subject.outputs,
            Body::Straight(straight) => &straight.names.outputs,
        }
    }

    /// Evaluates the function at a value for each of its inputs: columns that are defined by its
    /// parameters, if any, then its outputs.
    ///
    /// # Errors
    /// What cannot be evaluated: a texture, a uniform without a value, a loop without end; a point of
    /// another length.
    pub fn at(&self, point: &[f64]) -> Result<Vec<f64>, Error> {
        let (given, inputs) = (point.len(), self.inputs().len());
        if given != inputs {
            let message = format!("{given} values are given for {inputs} inputs");
            return Err(Error::Whole { path: self.name().into(), message });
        }
        match &self.body {
            Body::Interpreted(subject) => subject.at(point),
            Body::Straight(straight) => Ok(straight.at(point)),
        }
    }

    /// Evaluates the function as [`Shader::at`] does, in single precision.
    ///
    /// # Errors
    /// As [`Shader::at`].
    pub fn at_in_single(&self, point: &[f32]) -> Result<Vec<f32>, Error> {
        match &self.body {
            Body::Interpreted(subject) => subject.at_in_single(point),
            Body::Straight(straight) => Ok(straight.program.evaluate(point)),
        }
    }

    /// Allows for so many steps in an evaluation: statements, expressions, iterations of loops. By
    /// default they are 100 million, which take seconds.
    pub fn within(mut self, steps: u64) -> Shader {
        if let Body::Interpreted(subject) = &mut self.body {
            Arc::make_mut(subject).steps = steps;
        }
        self
    }

    /// Returns the function as a program over its inputs: loops unrolled, branches as choices.
    ///
    /// # Errors
    /// What no program is: a loop whose count depends on the inputs, integers that do.
    pub fn program(&self) -> Result<Program, Error> {
        match &self.body {
            Body::Interpreted(subject) => subject.program(),
            Body::Straight(straight) => Ok(straight.program.clone()),
        }
    }

    /// Returns it as a truth over a domain.
    ///
    /// # Errors
    /// A domain that is not that of its inputs.
    pub fn truth(&self, domain: &[Axis]) -> Result<Truth, Error> {
        let axes = axes_of(domain, self.inputs())?;
        let shader = self.clone();
        let function = move |point: &[f64]| shader.at(point).map_err(|error| error.to_string());
        let origin =
            Origin::Function { function: self.origin.clone(), domain: write_domain(&axes) };
        let outputs = self.outputs().to_vec();
        let truth = Truth::new(self.name().to_owned(), axes, outputs, origin, Arc::new(function))?;
        Ok(match &self.body {
            Body::Interpreted(subject) if subject.columns != subject.sampled => {
                truth.over(&subject.columns)
            }
            _ => truth,
        })
    }
}

fn origin(path: &Path, text: String, entry: String, options: &Options) -> Function {
    let file = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let (set, define) = (options.set.clone(), options.define.clone());
    Function::Shader { file, text, entry, set, define }
}

fn from_hexadecimal(text: &str) -> Vec<u8> {
    let byte = |pair: &[u8]| {
        let digits = std::str::from_utf8(pair).ok()?;
        u8::from_str_radix(digits, 16).ok()
    };
    text.as_bytes().chunks(2).filter_map(byte).collect()
}
