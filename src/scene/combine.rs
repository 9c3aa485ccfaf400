//! Rewriting formulas over a dataset's columns as formulas over a view's.

use super::View;
use super::view::Input;
use crate::program::{Arg, Draft, Outer, Program, effective};
use crate::simplify::Simplifier;

impl View<'_> {
    /// Rewrites a formula over the dataset's inputs as one over the view's: fixed inputs are
    /// folded, outputs combined. `defined` names the dataset's outputs that it computes, `wanted`
    /// the view's outputs to return. None if the formula lacks an output that is needed.
    ///
    /// # Panics
    /// If the program's number of inputs is not the dataset's, or that of outputs not `defined`'s.
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

    /// As [`View::program`], but nothing is folded: fixed inputs are constants.
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

    /// Returns the wanted outputs as an outer form over the open inputs, whose holes are the
    /// defined outputs of the dataset; none if they need another output.
    fn outer(&self, defined: &[String], wanted: &[String]) -> Option<Outer> {
        let open = self.open_inputs().count();
        let mut form = Draft { inputs: open + defined.len(), ..Draft::default() };
        let mut arguments = self.arguments(&mut form);
        // A placeholder for outputs that are not defined.
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

    /// Returns the dataset's inputs as arguments: open inputs, or new constants of the draft.
    fn arguments(&self, draft: &mut Draft) -> Vec<Arg> {
        let mut open = (0..).map(Arg::Input);
        let argument = |input: &Input| match input {
            Input::Fixed(value) => draft.constant(*value as f32),
            Input::Open(_) => open.next().expect("as many as there are inputs"),
        };
        self.inputs.iter().map(argument).collect()
    }
}

/// Folds constants as any compiler would; none if the draft is then no program.
pub(super) fn folded(draft: &Draft) -> Option<Program> {
    let mut simple = Draft::default();
    Simplifier::default().simplify(draft, &mut simple);
    Some(effective(&Program::verify(simple).ok()?))
}
