//! The function that data are samples of, as it was given: the formula to beat.

use super::Subject;
use crate::cost::Profile;
use crate::dataset::Function;
use crate::program::{Names, Program};
use crate::search::{FrontMember, ScoredIncumbent};
use crate::truth::read_formula;

/// The name of the original in tables and plots.
pub const ORIGINAL: &str = "original";

impl Subject {
    /// Returns the original, scored as formulas are: in `f32`, against its own values in double
    /// precision. None if the data are no function's, or of a scene.
    ///
    /// # Errors
    /// The reason why the function is no formula.
    pub fn original(&self, profile: &Profile) -> Result<Option<ScoredIncumbent>, String> {
        let (None, Some((function, _))) = (&self.scene, self.dataset.origin.function()) else {
            return Ok(None);
        };
        let (program, defined) = match function {
            Function::Formula { text } => {
                let outputs: Vec<String> = self.whole.names().outputs;
                let parsed = read_formula(text, &outputs).map_err(|error| error.to_string())?;
                (parsed.program, parsed.names)
            }
            shader => self.of_shader(shader)?,
        };
        let names = self.dataset.names();
        Ok(program.over(&defined, &names).map(|program| ScoredIncumbent {
            name: ORIGINAL.to_owned(),
            member: FrontMember::new(program, &self.dataset, profile, &names),
        }))
    }

    #[cfg(feature = "shader")]
    fn of_shader(&self, function: &Function) -> Result<(Program, Names), String> {
        use crate::shader::Shader;
        use crate::truth::parse_domain;
        let domain = self.dataset.origin.function().map_or("", |(_, domain)| domain);
        let domain = parse_domain(domain).map_err(|error| error.to_string())?;
        let shader = Shader::of_origin(function, &domain).map_err(|error| error.to_string())?;
        let shader = shader.ok_or("it is no shader")?;
        let program = shader.program().map_err(|error| error.to_string())?;
        Ok((program, Names::new(shader.inputs().to_vec(), shader.outputs().to_vec())))
    }

    #[cfg(not(feature = "shader"))]
    fn of_shader(&self, _: &Function) -> Result<(Program, Names), String> {
        Err("this program was built without the reader of shaders".into())
    }
}
