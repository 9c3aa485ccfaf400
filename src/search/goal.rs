//! The goal of a search: the error to make small, the requirements, and the cost budget.

use super::Requirement;
use crate::fit::Measure;
use crate::op::Op;
use crate::program::{Arg, Claim, Draft, Names, Outer, Program, Shape, Template};
use serde::{Deserialize, Serialize};
use std::fmt;
use std::str::FromStr;

/// The most cycles that [`Goal::max_cost`] may be.
pub const MAX_CYCLES: f64 = 1000.0;

/// The demands on formulas.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Goal {
    /// The loss measure that the search minimises.
    pub measure: Measure,
    /// The conditions that every formula must meet.
    pub requirements: Vec<Requirement>,
    /// The function of each output that is searched for: a spelling of an outer form
    /// ([`crate::program::Outer`]). An output without an entry is searched for itself.
    pub transforms: Vec<Option<Transform>>,
    /// The text of a formula whose holes are searched for ([`Template`]), in place of formulas of
    /// the outputs.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub template: Option<String>,
    /// What is costed.
    #[serde(skip_serializing_if = "CostOf::is_usual")]
    pub cost_of: CostOf,
    /// The most cycles that a formula may cost, from 0 to [`MAX_CYCLES`].
    pub max_cost: f64,
}

impl Default for Goal {
    /// Returns the goal of the least RMSE at up to 40 cycles.
    fn default() -> Goal {
        Goal {
            measure: Measure::Rmse,
            requirements: Vec::new(),
            transforms: Vec::new(),
            template: None,
            cost_of: CostOf::Whole,
            max_cost: 40.0,
        }
    }
}

/// What a formula's cost is counted of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum CostOf {
    /// All of it.
    #[default]
    Whole,
    /// What fills the holes of a template, once for each call.
    Holes,
}

impl CostOf {
    fn is_usual(&self) -> bool {
        *self == CostOf::Whole
    }
}

impl fmt::Display for CostOf {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            CostOf::Whole => "whole",
            CostOf::Holes => "holes",
        })
    }
}

impl FromStr for CostOf {
    type Err = String;

    fn from_str(text: &str) -> Result<CostOf, String> {
        match text {
            "whole" => Ok(CostOf::Whole),
            "holes" => Ok(CostOf::Holes),
            other => Err(format!("`{other}`: the cost is of the whole, or of holes")),
        }
    }
}

/// A function of an output to search for if it is the simpler surface (Pesce & Iwanicki 2015,
/// §4.3). The formula's cost includes the inverse, and its error is that of the output itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Transform {
    /// `1/y`, within a reciprocal.
    Rcp,
    /// `log2 y`, within `exp2`.
    Log2,
    /// `sqrt y`, within a square.
    Sqrt,
}

const TRANSFORMS: [(Transform, &str); 3] =
    [(Transform::Rcp, "rcp"), (Transform::Log2, "log2"), (Transform::Sqrt, "sqrt")];

impl FromStr for Transform {
    type Err = String;

    fn from_str(text: &str) -> Result<Transform, String> {
        let known = TRANSFORMS.iter().find(|(_, name)| *name == text);
        let (transform, _) =
            known.ok_or_else(|| format!("`{text}`: a transform is rcp, log2 or sqrt"))?;
        Ok(*transform)
    }
}

impl fmt::Display for Transform {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (_, name) = TRANSFORMS.iter().find(|(known, _)| known == self).expect("all are listed");
        f.write_str(name)
    }
}

impl Transform {
    fn apply(self, draft: &mut Draft, output: Arg) -> Arg {
        match self {
            Transform::Rcp => draft.push(Op::Rcp, &[output]),
            Transform::Log2 => draft.push(Op::Log2, &[output]),
            Transform::Sqrt => draft.push(Op::Sqrt, &[output]),
        }
    }

    fn invert(self, draft: &mut Draft, hole: Arg) -> Arg {
        match self {
            Transform::Rcp => draft.push(Op::Rcp, &[hole]),
            Transform::Log2 => draft.push(Op::Exp2, &[hole]),
            Transform::Sqrt => draft.push(Op::Mul, &[hole, hole]),
        }
    }
}

impl Goal {
    /// Returns the template over columns of these names, if there is one.
    ///
    /// # Errors
    /// A template that cannot be read over them; a requirement of a hole that it lacks.
    pub fn template(&self, names: &Names) -> Result<Option<Template>, String> {
        let parsed = |text: &String| {
            Template::parse(text, names).map_err(|error| format!("`template`: {error}"))
        };
        let template = self.template.as_ref().map(parsed).transpose()?;
        let lacks = |name: &str| template.as_ref().is_none_or(|one| one.hole(name).is_none());
        for requirement in &self.requirements {
            if let Requirement::Claim { text } = requirement {
                Claim::parse(text, names).map_err(|error| format!("`requirements`: {error}"))?;
            }
            if let Requirement::HoleRange { hole, .. } = requirement
                && lacks(hole)
            {
                return Err(format!(
                    "`requirements` name `{hole}`, which is no hole of a template"
                ));
            }
        }
        Ok(template)
    }

    /// Returns the shape of the drafts that are searched for, over columns of these names.
    ///
    /// # Errors
    /// As [`Goal::template`].
    pub fn shape(&self, names: &Names) -> Result<Shape, String> {
        Ok(match self.template(names)? {
            Some(template) => template.outer().shape().clone(),
            None => Shape::open(names.inputs.len(), names.outputs.len()),
        })
    }

    /// Returns the outer form, the transforms' inverses; none if there are no transforms.
    pub(super) fn outer(&self, inputs: usize, outputs: usize) -> Option<Outer> {
        self.around_outputs(inputs, outputs, Transform::invert)
    }

    /// Returns the form that turns outputs into the values searched for; none as for
    /// [`Goal::outer`].
    pub(super) fn inner(&self, inputs: usize, outputs: usize) -> Option<Outer> {
        self.around_outputs(inputs, outputs, Transform::apply)
    }

    fn around_outputs(
        &self,
        inputs: usize,
        outputs: usize,
        function: fn(Transform, &mut Draft, Arg) -> Arg,
    ) -> Option<Outer> {
        self.transforms.iter().flatten().next()?;
        let mut draft = Draft { inputs: inputs + outputs, ..Draft::default() };
        for output in 0..outputs {
            let value = Arg::Input((inputs + output) as u16);
            let transform = self.transforms.get(output).copied().flatten();
            let value = transform.map_or(value, |one| function(one, &mut draft, value));
            draft.outputs.push(value);
        }
        Some(Outer::new(Program::verify(draft).expect("a few instructions on inputs"), outputs))
    }

    /// Checks the goal for formulas of so many inputs and outputs.
    ///
    /// # Errors
    /// The first field that is invalid.
    pub fn check(&self, inputs: usize, outputs: usize) -> Result<(), String> {
        if !(0.0..=MAX_CYCLES).contains(&self.max_cost) {
            let max_cost = self.max_cost;
            return Err(format!("`max_cost` is {max_cost}; it must be 0 to {MAX_CYCLES} cycles"));
        }
        if self.transforms.len() > outputs {
            return Err("there are more `transforms` than outputs".into());
        }
        if self.template.is_some() && self.transforms.iter().any(Option::is_some) {
            return Err("`transforms` do not go with a `template`; write them in it".into());
        }
        if self.template.is_none() && self.cost_of == CostOf::Holes {
            return Err("`cost_of` holes needs a `template`".into());
        }
        let ends = self.requirements.iter().any(|one| matches!(one, Requirement::Ends { .. }));
        if ends && self.measure == Measure::Relative {
            let reason = "`requirements`: ends=… goes with rmse, max or weighted, not relative";
            return Err(reason.into());
        }
        self.requirements.iter().try_for_each(|one| one.check(inputs, outputs))
    }
}

impl Requirement {
    fn check(&self, inputs: usize, outputs: usize) -> Result<(), String> {
        let exists = |what: &str, index: u16, count: usize| match usize::from(index) < count {
            true => Ok(()),
            false => Err(format!("`requirements` name {what} {index}, but there are {count}")),
        };
        let of = |output: Option<u16>| output.map_or(Ok(()), |o| exists("output", o, outputs));
        match *self {
            Requirement::Range { output, low, high } => match low < high {
                true => of(output),
                false => Err(format!("`requirements`: {low}..{high} is no range; give LOW < HIGH")),
            },
            Requirement::Monotone { output, input, .. } | Requirement::Ends { output, input } => {
                of(output)?;
                exists("input", input, inputs)
            }
            Requirement::Input(input) => exists("input", input, inputs),
            Requirement::Half { error } if error.is_nan() || error <= 0.0 => {
                Err(format!("`requirements`: half={error}; it must be above 0"))
            }
            Requirement::HoleRange { ref hole, low, high } => match low < high {
                true => Ok(()),
                false => Err(format!("`requirements`: {hole}.range={low}..{high} is no range")),
            },
            Requirement::Half { .. }
            | Requirement::Operation(_)
            | Requirement::Claim { .. }
            | Requirement::Finite => Ok(()),
        }
    }
}
