//! Claims that every formula must meet, as `scale + bias <= 1`: checked on samples, sought to be
//! refuted, and met by a bound on one output where the claim is linear in the outputs.

use crate::eval::{Evaluator, Samples, Tape};
use crate::grammar::Grammar;
use crate::num::Interval;
use crate::op::Op;
use crate::program::{Arg, Claim, Draft, Program};
use crate::stability::{Bounded, Limits, Rounding, Status, bounded, prove};

/// Returns true if the claim holds on the samples. One with a variable in which it is not linear is
/// left to the proof.
pub(super) fn holds_on(
    claim: &Claim,
    program: &Program,
    domain: &[Interval],
    samples: &Samples,
    evaluator: &mut Evaluator,
) -> bool {
    let Some(Bounded { program, domain: all, properties }) = bounded(program, domain, claim) else {
        return false;
    };
    if all.len() > domain.len() {
        return true;
    }
    let values = evaluator.outputs(&Tape::new(&program), samples);
    let slack = Limits::new(Rounding::Exact).slack;
    properties.iter().all(|property| {
        values[property.output].iter().all(|value| property.excess(*value, slack) <= 0.0)
    })
}

/// Returns true if some input of the domain is found where the claim does not hold.
pub(super) fn is_refuted(
    claim: &Claim,
    program: &Program,
    domain: &[Interval],
    boxes: usize,
) -> bool {
    let Some(Bounded { program, domain, properties }) = bounded(program, domain, claim) else {
        return true;
    };
    let limits = Limits { boxes, ..Limits::new(Rounding::Exact) };
    let refuted = |status: &Status| matches!(status, Status::Refuted { .. });
    properties.chunks(64).any(|some| prove(&program, &domain, some, &limits).iter().any(refuted))
}

/// Bounds an output of a draft so that the claim holds, in each case in which it is linear in the
/// outputs: `scale = min(scale, 1 - bias)`.
pub(super) fn bound(claim: &Claim, draft: &mut Draft, grammar: &Grammar) {
    if ![Op::Min, Op::Max, Op::Sub, Op::Mul].into_iter().all(|op| grammar.has(op)) {
        return;
    }
    for Linear { factors, rest } in cases(claim, draft.inputs, draft.outputs.len()) {
        let Some(bounded) = factors.iter().position(|factor| *factor != 0.0) else { continue };
        for (end, is_most) in claim.range.into_iter().zip([false, true]) {
            if !end.is_finite() {
                continue;
            }
            let factor = factors[bounded];
            // factor*output <= end - rest - the others.
            let mut limit = draft.constant(((end - rest) / factor) as f32);
            for (o, other) in factors.iter().enumerate().filter(|(o, _)| *o != bounded) {
                let share = (other / factor) as f32;
                if share == 0.0 {
                    continue;
                }
                let mut term = draft.outputs[o];
                if share != 1.0 {
                    let share = draft.constant(share);
                    term = draft.push(Op::Mul, &[share, term]);
                }
                limit = draft.push(Op::Sub, &[limit, term]);
            }
            let op = if is_most == (factor > 0.0) { Op::Min } else { Op::Max };
            draft.outputs[bounded] = draft.push(op, &[draft.outputs[bounded], limit]);
        }
    }
}

/// A claim's expression as a sum of the outputs, each with a factor, and a rest.
#[derive(Clone, Debug, PartialEq)]
struct Linear {
    factors: Vec<f64>,
    rest: f64,
}

impl Linear {
    fn constant(&self) -> Option<f64> {
        self.factors.iter().all(|factor| *factor == 0.0).then_some(self.rest)
    }

    fn scaled(&self, by: f64) -> Linear {
        let factors = self.factors.iter().map(|factor| by * factor).collect();
        Linear { factors, rest: by * self.rest }
    }

    fn plus(&self, other: &Linear) -> Linear {
        let factors = self.factors.iter().zip(&other.factors).map(|(a, b)| a + b).collect();
        Linear { factors, rest: self.rest + other.rest }
    }

    fn times(&self, other: &Linear) -> Option<Linear> {
        let by = |a: &Linear, b: &Linear| Some(b.scaled(a.constant()?));
        by(self, other).or_else(|| by(other, self))
    }
}

/// Returns the claim's expression for each combination of the ends of its variables' ranges, where
/// it is linear in the outputs and reads no input.
fn cases(claim: &Claim, inputs: usize, outputs: usize) -> Vec<Linear> {
    let variables = claim.variables.len();
    let combinations = (0..1usize << variables).filter_map(|combination| {
        let of = |arg: &Arg, results: &[Option<Linear>]| -> Option<Linear> {
            let mut linear = Linear { factors: vec![0.0; outputs], rest: 0.0 };
            match *arg {
                Arg::Const(i) => linear.rest = claim.program.consts[usize::from(i)].into(),
                Arg::Result(i) => return results[usize::from(i)].clone(),
                Arg::Input(i) => match usize::from(i).checked_sub(inputs)? {
                    o if o < outputs => linear.factors[o] = 1.0,
                    v => {
                        let (v, (_, ends)) = (v - outputs, claim.variables.get(v - outputs)?);
                        linear.rest = ends[combination >> v & 1].into();
                    }
                },
            }
            Some(linear)
        };
        let mut results: Vec<Option<Linear>> = Vec::new();
        for instr in &claim.program.instrs {
            let args: Option<Vec<Linear>> =
                instr.args().iter().map(|arg| of(arg, &results)).collect();
            results.push(args.and_then(|args| match (instr.op(), args.as_slice()) {
                (Op::Add, [a, b]) => Some(a.plus(b)),
                (Op::Sub, [a, b]) => Some(a.plus(&b.scaled(-1.0))),
                (Op::Neg, [a]) => Some(a.scaled(-1.0)),
                (Op::Mul, [a, b]) => a.times(b),
                (Op::Mad, [a, b, c]) => Some(a.times(b)?.plus(c)),
                (Op::Div, [a, b]) => Some(a.scaled(1.0 / b.constant()?)),
                _ => None,
            }));
        }
        of(&claim.program.outputs[0], &results)
    });
    let mut cases: Vec<Linear> = Vec::new();
    for case in combinations {
        if !cases.contains(&case) {
            cases.push(case);
        }
    }
    // Bounds on one output before those that read others.
    cases.sort_by_key(|case| case.factors.iter().filter(|factor| **factor != 0.0).count());
    cases
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::program::{Names, parse};

    #[test]
    fn an_output_is_bounded_where_a_claim_is_linear() {
        let names = Names::new(["x"], ["scale", "bias"]);
        let grammar = Grammar::find("shader").unwrap();
        let program = parse("scale = 2*x; bias = 0.75 - x", &names).unwrap();
        for (claim, at, expected) in [
            ("a: f0*scale + bias <= 1 for f0 in 0..1", 0.5, [0.75, 0.25]),
            ("a: f0*scale + bias <= 1 for f0 in 0..1", 0.125, [0.25, 0.625]),
            ("a: bias >= 0", 1.0, [2.0, 0.0]),
            ("a: 0.5 >= bias - scale", 0.0, [0.25, 0.75]),
            ("a: scale*bias <= 0", 0.5, [1.0, 0.25]),
        ] {
            let claim = Claim::parse(claim, &names).unwrap();
            let mut draft = program.clone().into_draft();
            bound(&claim, &mut draft, &grammar);
            let bounded = Program::verify(draft).unwrap();
            assert_eq!(bounded.evaluate(&[at]), expected, "{claim:?}");
        }
    }
}
