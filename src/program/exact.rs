//! Programs whose constants count in double precision, and programs over other columns.

use super::{Arg, Draft, Names, Parsed, Program};

/// A program with its constants in double precision: a formula as it is meant, not as it is
/// evaluated in `f32`.
#[derive(Clone, Debug, PartialEq)]
pub struct ExactProgram {
    /// The program.
    pub program: Program,
    /// Its constants, one for each of its table.
    pub constants: Vec<f64>,
}

impl ExactProgram {
    /// Returns a text's program over other columns; none if they lack what it reads or defines.
    pub fn of(parsed: Parsed, names: &Names) -> Option<ExactProgram> {
        let program = parsed.program.over(&parsed.names, names)?;
        Some(ExactProgram { program, constants: parsed.exact })
    }
}

impl Program {
    /// Returns the program, whose columns are those of `own`, over the columns of `names`, its
    /// constants in the same order; none if they lack what it reads, or it defines not all of them.
    pub fn over(&self, own: &Names, names: &Names) -> Option<Program> {
        let place = |all: &[String], name: &String| all.iter().position(|other| other == name);
        let inputs: Vec<Option<usize>> =
            own.inputs.iter().map(|name| place(&names.inputs, name)).collect();
        let read = |arg: Arg| match arg {
            Arg::Input(index) => inputs[usize::from(index)].map(|index| Arg::Input(index as u16)),
            other => Some(other),
        };
        let (inputs, consts) = (names.inputs.len(), self.consts.clone());
        let mut draft = Draft { inputs, consts, ..Draft::default() };
        for instr in &self.instrs {
            let args: Option<Vec<Arg>> = instr.args().iter().map(|&arg| read(arg)).collect();
            draft.push(instr.op(), &args?);
        }
        for output in &names.outputs {
            let index = place(&own.outputs, output)?;
            draft.outputs.push(read(self.outputs[index])?);
        }
        Program::verify(draft).ok()
    }
}
