//! The model: a formula with parameters.

use super::{Error, Settings};
use crate::fit::{Parameter, Scale};
use crate::program::{
    Arg, Draft, Names, Parsed, Program, Scope, Template, parse_template, use_counts,
};

/// The name of the column of errors.
pub(super) const RESIDUAL: &str = "residual";

/// A formula over a dataset's columns, some of whose constants are parameters.
#[derive(Clone, Debug)]
pub struct Model {
    text: String,
    outputs: Vec<String>,
    labels: Vec<String>,
    pub(super) program: Draft,
    pub(super) parameters: Vec<Parameter>,
}

impl Model {
    /// Parses a template, for those of the outputs that it assigns.
    ///
    /// # Errors
    /// [`Error`]: what is no formula over these columns; functions to be found; no parameter, or
    /// one that no output depends on; bounds, starts and scales that are not of the parameters.
    pub fn parse(text: &str, names: &Names, settings: &Settings) -> Result<Model, Error> {
        // A shell may have taken the parameters away, and left what is no formula.
        if !text.contains('$') {
            return Err(Error::NoParameter);
        }
        let parsed = assigned(text, names)?;
        let labels: Vec<String> = parsed.free.iter().map(|free| free.name.clone()).collect();
        if labels.is_empty() {
            return Err(Error::NoParameter);
        }
        let indices: Vec<usize> = parsed.free.iter().map(|free| free.index.into()).collect();
        if let Some(place) = indices.iter().position(|&index| !is_read(&parsed.program, index)) {
            return Err(Error::Unused { name: labels[place].clone() });
        }
        let mut model = Model {
            text: text.trim().to_owned(),
            outputs: parsed.names.outputs,
            labels,
            program: parsed.program.into_draft(),
            parameters: indices.into_iter().map(Parameter::unbounded).collect(),
        };
        model.set(settings)?;
        Ok(model)
    }

    fn set(&mut self, settings: &Settings) -> Result<(), Error> {
        for (name, bounds) in &settings.bounds {
            let place = self.place(name)?;
            self.parameters[place].bounds = *bounds;
        }
        for (name, value) in &settings.starts {
            let place = self.place(name)?;
            self.program.consts[self.parameters[place].index] = *value;
        }
        for name in &settings.logarithmic {
            let place = self.place(name)?;
            self.parameters[place].scale = Scale::Logarithmic;
        }
        for (parameter, name) in self.parameters.iter().zip(&self.labels) {
            let start = &mut self.program.consts[parameter.index];
            let range = parameter.range(*start);
            range.map_err(|error| Error::Range { name: name.clone(), error })?;
            *start = start.clamp(parameter.bounds[0], parameter.bounds[1]);
        }
        Ok(())
    }

    fn place(&self, name: &str) -> Result<usize, Error> {
        let known = self.labels.iter().position(|label| label == name);
        known.ok_or_else(|| Error::UnknownParameter {
            name: name.to_owned(),
            known: self.labels.clone(),
        })
    }

    /// Returns the text as it was given.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Returns the outputs that it assigns.
    pub fn outputs(&self) -> &[String] {
        &self.outputs
    }

    /// Returns the parameters' names, without the `$`.
    pub fn labels(&self) -> &[String] {
        &self.labels
    }

    /// Returns the parameters, in the order of their names.
    pub fn parameters(&self) -> &[Parameter] {
        &self.parameters
    }

    /// Returns the values from which fits start where nothing better is known.
    pub fn starts(&self) -> Vec<f32> {
        self.parameters.iter().map(|parameter| self.program.consts[parameter.index]).collect()
    }

    /// Checks that the parameters can stand as outputs beside inputs of these names.
    pub(super) fn check_names(&self, over: &[String]) -> Result<(), Error> {
        let taken = |name: &String| match name {
            name if name == RESIDUAL => Some("the column of errors"),
            name if over.contains(name) => Some("an input of --over"),
            _ => None,
        };
        let taken = self.labels.iter().find_map(|name| Some((name, taken(name)?)));
        taken.map_or(Ok(()), |(name, what)| Err(Error::NameTaken { name: name.clone(), what }))
    }

    /// Returns the template in which each parameter is a function of some inputs, to be found by a
    /// search, `p(alpha, size)` for `$p`, or stays a constant where it has none; and what each
    /// parameter is called in it. A name that is an operation's or the template's own gets an
    /// underscore.
    pub(super) fn with_functions(
        &self,
        arguments: &[Vec<String>],
        names: &Names,
    ) -> Option<(String, Vec<String>)> {
        let names = Names { inputs: names.inputs.clone(), outputs: self.outputs.clone() };
        let mut called = self.labels.clone();
        for _ in 0..MOST_UNDERSCORES {
            let text = self.rewritten(arguments, &called);
            let template = Template::parse(&text, &names).ok();
            let is_hole = |name: &String| {
                template.as_ref().and_then(|template| template.hole(name)).is_some()
            };
            if called.iter().all(is_hole) {
                return Some((text, called));
            }
            for (name, arguments) in called.iter_mut().zip(arguments) {
                if !arguments.is_empty() {
                    name.push('_');
                }
            }
        }
        None
    }

    fn rewritten(&self, arguments: &[Vec<String>], called: &[String]) -> String {
        let mut pieces = self.text.split('$');
        let mut text = pieces.next().unwrap_or_default().to_owned();
        for piece in pieces {
            let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
            let end = piece.find(|c| !is_part(c)).unwrap_or(piece.len());
            let (name, after) = piece.split_at(end);
            match self.labels.iter().position(|label| label == name) {
                Some(place) if !arguments[place].is_empty() => {
                    text += &format!("{}({})", called[place], arguments[place].join(", "));
                }
                _ => text += &format!("${name}"),
            }
            text += after;
        }
        text
    }
}

/// By hand: two more than any name has needed.
const MOST_UNDERSCORES: usize = 3;

/// Parses the template over the outputs that it assigns.
fn assigned(text: &str, names: &Names) -> Result<Parsed, Error> {
    let outputs = Template::assigned(text, names)?;
    let outputs = if outputs.is_empty() { names.outputs.clone() } else { outputs };
    let names = Names { inputs: names.inputs.clone(), outputs };
    parse_template(text, Scope::Dataset(&names)).map_err(|refusal| {
        let template = Template::parse(text, &names);
        let holes = template.as_ref().map(Template::holes).unwrap_or_default();
        let functions = holes.iter().filter(|hole| !hole.is_constant());
        let functions: Vec<String> = functions.map(|hole| hole.signature()).collect();
        match functions.is_empty() {
            true => refusal.into(),
            false => Error::Functions { functions: functions.join(", ") },
        }
    })
}

/// Returns true if an output depends on a constant.
fn is_read(program: &Program, constant: usize) -> bool {
    let mut counts = Vec::new();
    use_counts(program, &mut counts);
    let is_it = |arg: &Arg| matches!(arg, Arg::Const(index) if usize::from(*index) == constant);
    let used = program.instrs.iter().zip(&counts).filter(|(_, count)| **count > 0);
    program.outputs.iter().any(is_it) || used.flat_map(|(instr, _)| instr.args()).any(is_it)
}
