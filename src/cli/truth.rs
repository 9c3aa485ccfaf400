//! Functions as data: formulas, and functions of shaders, sampled where a command needs a dataset.

use super::{Common, Exit, Failure};
use crate::dataset::{Axis, Dataset, Function, Origin};
use crate::shader::{self, Language, Options, Shader};
use crate::targets::{self, Recipe};
use crate::truth::{self, Truth, parse_domain};
use std::path::Path;

/// The options that only a shader's function has, and those that all functions have.
const SHADERS: &[&str] = &["--entry", "--set", "--let"];
const SAMPLED: &[&str] = &["--domain", "--points"];

/// The options that say which function is sampled, and where.
#[derive(Clone, Debug, Default, clap::Args)]
pub struct Sampled {
    /// The formula to approximate, in place of a dataset, as in "y = 1/(1 + x*x)"; outputs are the
    /// statements that no later one reads, or as --outputs says
    #[arg(long, value_name = "FORMULA")]
    pub formula: Option<String>,
    /// The range of each input of the function, as in x=0..1,alpha=1e-3..1:log; `:log` spaces
    /// samples by the logarithm
    #[arg(long, value_name = "X=A..B,…", allow_hyphen_values = true)]
    domain: Option<String>,
    /// The samples along each input of the function, or in all if it has more than three [default:
    /// 1024, 64, 16 by inputs; 8192 in all]
    #[arg(long, value_name = "N")]
    points: Option<usize>,
    /// The function of the shader file that is meant [default: the one that no other calls]
    #[arg(long, value_name = "NAME")]
    entry: Option<String>,
    /// Fix a parameter of the shader's function, a component of one, or a uniform, as in
    /// exposure=1.0 or n=vec3(0,0,1); or a parameter of a target, as in points=32
    #[arg(long = "set", value_name = "NAME=VALUE")]
    pub set: Vec<String>,
    /// Define a parameter of the shader's function by inputs, as in
    /// "v = vec3(sqrt(1 - c*c), 0, c)", or an input by parameters, as in "n_dot_v = dot(n, v)"
    #[arg(long = "let", value_name = "NAME=EXPRESSION")]
    define: Vec<String>,
}

impl Sampled {
    /// Returns the function that is asked for: a formula, or the file if it is a shader's; none if
    /// it is a dataset's.
    pub fn truth(
        &self,
        file: Option<&Path>,
        outputs: Option<&[String]>,
    ) -> Result<Option<Truth>, Failure> {
        match (&self.formula, file) {
            (Some(_), Some(file)) => {
                let message = format!("give either {} or --formula, not both", file.display());
                Err(Failure::usage(message))
            }
            (Some(formula), None) => {
                self.refuse(&[SHADERS], "is for a function of a shader")?;
                let outputs = outputs.unwrap_or_default();
                Ok(Some(Truth::formula(formula, outputs, &self.axes()?)?))
            }
            (None, Some(file)) if Language::of(file).is_some() => {
                Ok(Some(self.shader(file, None)?.truth(&self.axes()?)?))
            }
            (None, _) => Ok(None),
        }
    }

    /// Refuses what is for functions: there is none.
    pub fn refuse_functions(&self) -> Result<(), Failure> {
        self.refuse(&[&["--set"]], "is for a function of a shader")?;
        self.refuse_all_but_set()
    }

    /// As [`Sampled::refuse_functions`], where `--let` has a meaning of its own.
    pub fn refuse_all_but_lets(&self) -> Result<(), Failure> {
        let kinds: [&[&str]; 2] = [&["--set", "--entry"], SAMPLED];
        self.refuse(&kinds, "is for a function of a shader")
    }

    /// Returns what `--let` says.
    pub fn lets(&self) -> &[String] {
        &self.define
    }

    /// As [`Sampled::refuse_functions`], where `--set` has a meaning of its own.
    pub fn refuse_all_but_set(&self) -> Result<(), Failure> {
        let kinds: [&[&str]; 2] = [&["--entry", "--let"], SAMPLED];
        self.refuse(&kinds, "is for a function, of a shader or by --formula")
    }

    /// Refuses options that mean nothing here.
    fn refuse(&self, kinds: &[&[&str]], what: &str) -> Result<(), Failure> {
        let given = |option: &&&str| match **option {
            "--domain" => self.domain.is_some(),
            "--points" => self.points.is_some(),
            "--entry" => self.entry.is_some(),
            "--set" => !self.set.is_empty(),
            _ => !self.define.is_empty(),
        };
        match kinds.iter().copied().flatten().find(given) {
            Some(option) => Err(Failure::usage(format!("{option} {what}; leave it out"))),
            None => Ok(()),
        }
    }

    /// Returns a function of a shader file, with the options' definitions.
    pub fn shader(&self, file: &Path, entry: Option<&str>) -> Result<Shader, Failure> {
        let ranged = self.axes()?.iter().map(|axis| axis.name.to_string()).collect();
        let entry = entry.map(str::to_owned).or(self.entry.clone());
        let options = Options { entry, set: self.set.clone(), define: self.define.clone(), ranged };
        Ok(Shader::load(file, &options)?)
    }

    /// As [`Sampled::shader`], without the definitions: its parameters are columns already.
    pub fn shader_over_columns(&self, file: &Path) -> Result<Shader, Failure> {
        let ranged = self.axes()?.iter().map(|axis| axis.name.to_string()).collect();
        Ok(Shader::load(file, &Options { ranged, ..Options::default() })?)
    }

    /// Returns the samples of the function.
    pub fn dataset(&self, truth: &Truth, common: &Common) -> Result<Dataset, Failure> {
        let bar = common.progress("evaluating");
        let dataset = truth.dataset(self.points, &|done, total| {
            bar.set_length(total as u64);
            // Reports arrive from several threads, and not in order.
            bar.set_position(bar.position().max(done as u64));
        });
        bar.finish_and_clear();
        Ok(dataset?)
    }

    /// Returns the domain.
    pub fn axes(&self) -> Result<Vec<Axis>, Failure> {
        let Some(domain) = &self.domain else {
            return Err(Failure::usage("say where the function is sampled, as in --domain x=0..1"));
        };
        Ok(parse_domain(domain)?)
    }
}

/// Returns the function that data are samples of; none if they are no function's, or only of a part
/// of it.
pub fn truth_of(data: &Dataset) -> Option<Truth> {
    let names = data.names();
    let truth = match &data.origin {
        Origin::Target { recipe, .. } => targets::truth(&Recipe::parse(recipe).ok()?)?,
        Origin::Function { function, domain } => {
            let axes = parse_domain(domain).ok()?;
            match function {
                Function::Formula { text } => Truth::formula(text, &names.outputs, &axes).ok()?,
                shader => Shader::of_origin(shader, &axes).ok()??.truth(&axes).ok()?,
            }
        }
        _ => return None,
    };
    let truth = truth.choose(&names.outputs)?;
    (truth.inputs() == names.inputs).then_some(truth)
}

impl From<truth::Error> for Failure {
    fn from(error: truth::Error) -> Failure {
        match error {
            truth::Error::Dataset(error) => error.into(),
            truth::Error::Domain(_) | truth::Error::Points { .. } => {
                Failure::new(Exit::Usage, error)
            }
            error => Failure::new(Exit::Input, error),
        }
    }
}

impl From<shader::Error> for Failure {
    fn from(error: shader::Error) -> Failure {
        match error {
            shader::Error::Truth(error) => error.into(),
            shader::Error::Let(_) | shader::Error::Set(_) => Failure::new(Exit::Usage, error),
            error => Failure::new(Exit::Input, error),
        }
    }
}
