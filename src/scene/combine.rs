//! Formulas over a dataset's columns as formulas over what a scene leaves of them.

use super::View;
use super::view::Input;
use crate::program::{Arg, Draft, Outer, Program, effective};
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
        let mut child = Draft { inputs: self.open_inputs().count(), ..Draft::default() };
        let arguments = self.arguments(&mut child);
        child.outputs = child.append(program, &arguments);
        Some(self.outer(defined, wanted)?.append(&child))
    }

    /// The outputs that are wanted, over the open inputs and, as holes, the dataset's outputs that are defined.
    fn outer(&self, defined: &[String], wanted: &[String]) -> Option<Outer> {
        let open = self.open_inputs().count();
        let mut form = Draft { inputs: open + defined.len(), ..Draft::default() };
        let mut arguments = self.arguments(&mut form);
        // An argument that stands for an output that is not defined.
        let lacking = Arg::Input(u16::MAX);
        for column in &self.whole.outputs {
            let hole = defined.iter().position(|name| *name == column.name);
            arguments.push(hole.map_or(lacking, |hole| Arg::Input((open + hole) as u16)));
        }
        for (_, value) in &self.values {
            arguments.push(form.constant(*value as f32));
        }
        for name in wanted {
            let (_, expression) = self.outputs.iter().find(|(output, _)| output == name)?;
            let value = form.append(expression, &arguments);
            form.outputs.extend(value);
        }
        let mut reads = form.instrs.iter().flat_map(|instr| instr.args()).chain(&form.outputs);
        let complete = !reads.any(|&arg| arg == lacking);
        complete
            .then(|| Program::verify(form).ok())
            .flatten()
            .map(|form| Outer::new(form, defined.len()))
    }

    /// What the dataset's inputs are: open, or constants of a draft.
    fn arguments(&self, draft: &mut Draft) -> Vec<Arg> {
        let mut open = (0..).map(Arg::Input);
        let argument = |input: &Input| match input {
            Input::Fixed(value) => draft.constant(*value as f32),
            Input::Open(_) => open.next().expect("as many as there are inputs"),
        };
        self.inputs.iter().map(argument).collect()
    }
}

/// A draft with constants folded, as any compiler would; nothing where it is no program.
pub(super) fn folded(draft: &Draft) -> Option<Program> {
    let mut simple = Draft::default();
    Simplifier::default().simplify(draft, &mut simple);
    Some(effective(&Program::verify(simple).ok()?))
}
