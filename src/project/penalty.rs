//! The penalty on steps between neighbours, as further outputs of the model.
//!
//! Least squares know outputs and targets. Each parameter `p` that is pulled towards `m` therefore
//! becomes an output, `(p - m)*w`, whose target is 0, and which counts once
//! (`Samples::with_outputs`).

use super::bench::position;
use crate::fit::{Parameter, Scale};
use crate::op::Op;
use crate::program::{Arg, Draft};

/// What a group's parameters are pulled towards, and how strongly.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Pull {
    /// By parameter, on its scale.
    towards: Vec<f64>,
    /// By parameter: the penalty of a squared distance.
    strength: Vec<f64>,
}

impl Pull {
    /// Pulls towards each of some neighbours' values. The penalty of a step is `smooth` times its
    /// square, in each parameter's `spreads`.
    pub fn new(
        parameters: &[Parameter],
        neighbours: &[&[f32]],
        spreads: &[f64],
        smooth: f64,
    ) -> Pull {
        let count = neighbours.len().max(1) as f64;
        let towards = |(place, parameter): (usize, &Parameter)| {
            let positions = neighbours.iter().map(|values| position(parameter, values[place]));
            positions.sum::<f64>() / count
        };
        let strength = |spread: &f64| smooth * neighbours.len() as f64 / spread.powi(2);
        Pull {
            towards: parameters.iter().enumerate().map(towards).collect(),
            strength: spreads.iter().map(strength).collect(),
        }
    }

    /// Returns the penalty, but for what the neighbours' own distances add.
    pub fn penalty(&self, parameters: &[Parameter], values: &[f32]) -> f64 {
        let of = |((parameter, value), (towards, strength)): ((&Parameter, &f32), (&f64, &f64))| {
            strength * (position(parameter, *value) - towards).powi(2)
        };
        let pulls = self.towards.iter().zip(&self.strength);
        parameters.iter().zip(values).zip(pulls).map(of).sum()
    }
}

/// The model with the penalty.
pub(super) struct Pulled {
    draft: Draft,
    /// By parameter, the constants `m` and `w`.
    constants: Vec<[usize; 2]>,
}

impl Pulled {
    pub fn new(model: &Draft, parameters: &[Parameter]) -> Pulled {
        let mut draft = model.clone();
        let mut constants = Vec::new();
        for parameter in parameters {
            let own = Arg::Const(parameter.index as u16);
            let position = match parameter.scale {
                Scale::Linear => own,
                Scale::Logarithmic => draft.push(Op::Log2, &[own]),
            };
            let (towards, weight) = (draft.constant(0.0), draft.constant(1.0));
            constants.push([draft.consts.len() - 2, draft.consts.len() - 1]);
            let apart = draft.push(Op::Sub, &[position, towards]);
            let weighted = draft.push(Op::Mul, &[apart, weight]);
            draft.outputs.push(weighted);
        }
        Pulled { draft, constants }
    }

    /// Returns the model with its parameters at some values, whose least squares over a `total`
    /// weight are those of the pull, too.
    pub fn draft(
        &mut self,
        parameters: &[Parameter],
        from: &[f32],
        pull: &Pull,
        total: f64,
    ) -> &mut Draft {
        for (place, parameter) in parameters.iter().enumerate() {
            let [low, high] = parameter.bounds;
            let [towards, weight] = self.constants[place];
            self.draft.consts[parameter.index] = from[place].clamp(low, high);
            self.draft.consts[towards] = pull.towards[place] as f32;
            let strength = (pull.strength[place] * total).sqrt().min(f32::MAX.into());
            self.draft.consts[weight] = strength as f32;
        }
        &mut self.draft
    }
}
