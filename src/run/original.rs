//! The function that data are samples of, as it was given: the formula to beat.

use super::Subject;
use crate::cost::Profile;
use crate::dataset::Function;
use crate::program::{Arg, Draft, Names, Program};
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
        Ok(over(&program, &defined, &names).map(|program| ScoredIncumbent {
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

/// Returns a program over other columns, which must have all that it reads and defines.
fn over(program: &Program, defined: &Names, names: &Names) -> Option<Program> {
    let place = |all: &[String], name: &String| all.iter().position(|other| other == name);
    let inputs: Vec<Option<usize>> =
        defined.inputs.iter().map(|name| place(&names.inputs, name)).collect();
    let read = |arg: Arg| match arg {
        Arg::Input(index) => inputs[usize::from(index)].map(|index| Arg::Input(index as u16)),
        other => Some(other),
    };
    let mut draft =
        Draft { inputs: names.inputs.len(), consts: program.consts.clone(), ..Draft::default() };
    for instr in &program.instrs {
        let args: Option<Vec<Arg>> = instr.args().iter().map(|&arg| read(arg)).collect();
        draft.push(instr.op(), &args?);
    }
    for output in &names.outputs {
        let index = place(&defined.outputs, output)?;
        draft.outputs.push(read(program.outputs[index])?);
    }
    Program::verify(draft).ok()
}
