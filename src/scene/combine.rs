//! Formulas over a dataset's columns as formulas over what a scene leaves of them.

use super::View;
use super::view::Input;
use crate::program::{Arg, Draft, Program, effective};
use crate::simplify::Simplifier;

impl View<'_> {
    /// A formula over the dataset's inputs, for the outputs of the dataset that are named, as one over
    /// the view's inputs for some of the view's outputs: fixed inputs folded, outputs combined.
    /// Nothing where it lacks an output that is needed.
    ///
    /// # Panics
    /// If the program has other numbers of inputs than the dataset or of outputs than `defined`.
    pub fn program(
        &self,
        program: &Program,
        defined: &[String],
        wanted: &[String],
    ) -> Option<Program> {
        let draft = self.substituted(program, defined, wanted)?;
        let unchanged = self.scene.fixed.is_empty() && self.scene.outputs.is_empty();
        if unchanged { Program::verify(draft).ok() } else { folded(&draft) }
    }

    /// [`View::program`] with nothing folded: fixed inputs are constants.
    pub(super) fn substituted(
        &self,
        program: &Program,
        defined: &[String],
        wanted: &[String],
    ) -> Option<Draft> {
        assert_eq!(program.inputs, self.whole.inputs.len(), "the dataset's inputs");
        assert_eq!(program.outputs.len(), defined.len(), "a name for each output");
        let mut draft = Draft { inputs: self.open_inputs().count(), ..Draft::default() };
        let mut open = 0;
        let mut arguments: Vec<Arg> = Vec::new();
        for input in &self.inputs {
            arguments.push(match input {
                Input::Fixed(value) => draft.constant(*value as f32),
                Input::Open(_) => {
                    open += 1;
                    Arg::Input(open - 1)
                }
            });
        }
        let values = draft.append(program, &arguments);
        // An argument that stands for an output that the formula lacks.
        let lacking = Arg::Input(u16::MAX);
        for column in &self.whole.outputs {
            let place = defined.iter().position(|name| *name == column.name);
            arguments.push(place.map_or(lacking, |place| values[place]));
        }
        for (_, value) in &self.values {
            arguments.push(draft.constant(*value as f32));
        }
        for name in wanted {
            let (_, expression) = self.outputs.iter().find(|(output, _)| output == name)?;
            let value = draft.append(expression, &arguments);
            draft.outputs.extend(value);
        }
        let reads = draft.instrs.iter().flat_map(|instr| instr.args()).chain(&draft.outputs);
        let complete = !reads.into_iter().any(|&arg| arg == lacking);
        complete.then_some(draft)
    }
}

/// A draft with constants folded, as any compiler would; nothing where it is no program.
pub(super) fn folded(draft: &Draft) -> Option<Program> {
    let mut simple = Draft::default();
    Simplifier::default().simplify(draft, &mut simple);
    Some(effective(&Program::verify(simple).ok()?))
}
