//! The comparison of polished formulas beyond the data's rounding.

use super::{FrontMember, Problem};
use crate::archive::undominated;
use crate::eval::{OutputError, Score};
use crate::fit::{Measure, rounding_errors};
use crate::program::Arg;

/// Returns, by rising cost, the members whose error is less than that of every cheaper one and of
/// every simpler one of the same cost. Errors below the data's rounding, output by output, are
/// equal.
pub(super) fn beyond_rounding(
    members: Vec<FrontMember>,
    problem: &Problem,
    measure: Measure,
) -> Vec<FrontMember> {
    let rounding = Rounding::of(problem);
    let error = |member: &FrontMember| {
        let score = rounding.at_least(&member.score);
        FrontMember { score, ..member.clone() }.deciding_error(measure)
    };
    let ranked: Vec<(f64, FrontMember)> =
        members.into_iter().map(|member| (error(&member), member)).collect();
    let kept = undominated(
        ranked,
        |(error, member)| (member.cost, *error),
        |(_, a), (_, b)| size(a).cmp(&size(b)).then_with(|| a.formula.cmp(&b.formula)),
    );
    kept.into_iter().map(|(_, member)| member).collect()
}

/// The most roundings by which a law may err: they add up in a formula with differences of large
/// numbers. Chosen by hand, unmeasured.
const NEAR: f64 = 64.0;

/// The errors that rounding alone makes, by output, on the search split and the validation split.
pub(super) struct Rounding {
    errors: [Vec<OutputError>; 2],
    has_standard_errors: bool,
}

impl Rounding {
    pub fn of(problem: &Problem) -> Rounding {
        let dataset = &problem.dataset;
        let errors = [&dataset.search, &dataset.validation].map(|split| {
            let outputs = 0..dataset.outputs.len();
            outputs.map(|output| rounding_errors(split, dataset.inputs.len(), output)).collect()
        });
        Rounding { errors, has_standard_errors: !dataset.search.standard_errors.is_empty() }
    }

    /// Returns true if every output errs by hardly more than rounding on the search split; law and
    /// formula may round differently. Data with standard errors reveal no law.
    pub fn covers(&self, score: &Score, measure: Measure) -> bool {
        let mut pairs = score.search.iter().zip(&self.errors[0]);
        !self.has_standard_errors
            && pairs.all(|(error, least)| error.of(measure) <= NEAR * least.of(measure))
    }

    /// Returns the score with every error raised to at least rounding.
    pub fn at_least(&self, score: &Score) -> Score {
        let raised = |errors: &[OutputError], rounding: &[OutputError]| {
            errors.iter().zip(rounding).map(|(error, least)| larger(error, least)).collect()
        };
        let [search, validation] = &self.errors;
        Score {
            search: raised(&score.search, search),
            validation: raised(&score.validation, validation),
            units: score.units.clone(),
        }
    }
}

fn larger(error: &OutputError, least: &OutputError) -> OutputError {
    let some = |error: Option<f64>, least: Option<f64>| Some(error?.max(least.unwrap_or(0.0)));
    OutputError {
        rmse: error.rmse.max(least.rmse),
        max: error.max.max(least.max),
        relative: error.relative.max(least.relative),
        weighted: some(error.weighted, least.weighted),
        visible: some(error.visible, least.visible),
    }
}

/// Returns the number of instructions and constants, then that of characters.
fn size(member: &FrontMember) -> (usize, usize) {
    let args = member.program.instrs.iter().flat_map(|instr| instr.args());
    let constants = args.filter(|arg| matches!(arg, Arg::Const(_))).count();
    (member.program.instrs.len() + constants, member.formula.len())
}
