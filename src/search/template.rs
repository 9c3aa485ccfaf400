//! Problems with a template: what is asked of its holes, and formulas finished hole by hole.

use super::polish::{guarded, reads_only_constants, without_idle};
use super::require::ranges_hold;
use super::{FrontMember, Problem, Requirement};
use crate::deadline::Deadline;
use crate::eval::{Evaluator, Samples};
use crate::fit::{
    Fitter, Measure, Rounds, drop_negligible_in, minimax_free, shorten_free, shorten_minimax_free,
};
use crate::program::{Draft, Names, Program, Template, effective};
use crate::simplify::{Simplifier, tidy};

impl Problem {
    /// Returns true if what a child becomes is built as required, and nested as the grammar allows:
    /// within a template, as the child is.
    pub(super) fn child_structure_ok(&self, child: &Draft) -> bool {
        let formula = self.formula(child);
        match &self.template {
            Some(_) => self.checks.structure_ok(&formula) && self.grammar.allows_nesting(child),
            None => self.structure_ok(&formula),
        }
    }

    /// Returns true if the values of what a child becomes are as required on the samples, and those
    /// of its holes.
    pub(super) fn child_holds(&self, child: &Draft, evaluator: &mut Evaluator) -> bool {
        self.holds_on_samples(&self.formula(child), evaluator) && self.holes_hold(child, evaluator)
    }

    /// Returns true if a child is built as required and its values are so on the samples.
    pub(super) fn child_acceptable(&self, child: &Draft) -> bool {
        self.child_structure_ok(child) && self.child_holds(child, &mut Evaluator::default())
    }

    /// Returns the values of each hole that must stay in a range, with the range.
    fn ranges_of_holes(&self, child: &Draft) -> Vec<(Program, [f32; 2])> {
        let Some(template) = &self.template else { return Vec::new() };
        let mut ranges = Vec::new();
        for requirement in &self.goal.requirements {
            let Requirement::HoleRange { hole, low, high } = requirement else { continue };
            let outputs = template.hole(hole).into_iter().flat_map(|hole| hole.outputs());
            for output in outputs {
                let values = Program::verify(template.outer().values_of(output, child));
                ranges.extend(values.ok().map(|values| (values, [*low, *high])));
            }
        }
        ranges
    }

    fn holes_hold(&self, child: &Draft, evaluator: &mut Evaluator) -> bool {
        let ranges = self.ranges_of_holes(child);
        ranges.is_empty() || ranges_hold(&ranges, &self.dataset, evaluator)
    }

    /// Returns true if no range of a hole is refuted anywhere in the domain.
    fn holes_are_not_refuted(&self, child: &Draft) -> bool {
        let ranges = self.ranges_of_holes(child);
        ranges.iter().all(|(values, range)| {
            super::require::range_is_not_refuted(values, *range, &self.dataset)
        })
    }
}

/// As [`super::polish::polish`], for a child of a template: what fills the holes stays apart from
/// the template around it.
pub(super) fn polish_holes(
    child: &Draft,
    template: &Template,
    problem: &Problem,
    samples: &Samples,
    measure: Measure,
    deadline: &Deadline,
) -> Option<FrontMember> {
    let by_maximum = measure == Measure::Max;
    let mut fitter = Fitter::until(deadline);
    let mut fitted = child.clone();
    problem.on_formula(&mut fitted, |formula, own| match by_maximum {
        true => {
            minimax_free(&mut fitter, formula, samples, Rounds::TO_CONVERGENCE, |i| i < own);
        }
        false => {
            fitter.fit_free(formula, samples, super::polish::TO_CONVERGENCE, |i| i < own);
        }
    });
    let mut smaller = fitted.clone();
    let allowance = super::polish::allowance(measure);
    let whole = |child: &Draft| template.outer().append(child);
    drop_negligible_in(&mut fitter, &mut smaller, samples, allowance, by_maximum, whole);
    let mut short = |mut child: Draft| {
        problem.on_formula(&mut child, |formula, own| match by_maximum {
            true => shorten_minimax_free(&mut fitter, formula, samples, allowance, |i| i < own),
            false => shorten_free(&mut fitter, formula, samples, allowance, |i| i < own),
        });
        child
    };
    let found = finished(&short(smaller), template, problem, measure);
    found.or_else(|| finished(&short(fitted), template, problem, measure))
}

/// Returns the formula with its holes simplified and guarded, or as they are if that makes it worse
/// or costlier; none if neither is finite and as required.
fn finished(
    child: &Draft,
    template: &Template,
    problem: &Problem,
    measure: Measure,
) -> Option<FrontMember> {
    let (mut simplifier, mut simple) = (Simplifier::default(), Draft::default());
    simplifier.simplify(child, &mut simple);
    let guarded = guarded(&simple, problem).map(|guarded| {
        let mut simple = Draft::default();
        simplifier.simplify(&guarded, &mut simple);
        simple
    });
    let children = [child.clone(), simple].into_iter().chain(guarded);
    let shown = children.filter_map(|child| shown(&child, template, problem));
    shown.reduce(|plain, other| super::polish::better(plain, other, problem, measure))
}

/// Returns a child's formula, as it is shown; none if it is not finite on every sample or not as
/// required.
pub(super) fn shown(child: &Draft, template: &Template, problem: &Problem) -> Option<FrontMember> {
    let names = problem.dataset.names();
    let whole = Program::verify(template.outer().append(child)).ok()?;
    let active = without_idle(&whole, &problem.dataset.inputs);
    let mut simple = Draft::default();
    Simplifier::default().simplify(&active, &mut simple);
    let smaller = Program::verify(simple).ok();
    let member = |program: Program| member_of(&program, child, template, problem, &names);
    let members = [Some(active), smaller].into_iter().flatten().filter_map(member);
    members.reduce(|plain, other| match other.cost < plain.cost {
        true => other,
        false => plain,
    })
}

fn member_of(
    whole: &Program,
    child: &Draft,
    template: &Template,
    problem: &Problem,
    names: &Names,
) -> Option<FrontMember> {
    let program = effective(&tidy(whole));
    let mut member = FrontMember::new(program, &problem.dataset, &problem.profile, names);
    if reads_only_constants(&member.program) || !member.score.is_finite() {
        return None;
    }
    member.holes = template.written(&effective(&Program::verify(child.clone()).ok()?));
    if let Some(alone) = &problem.calls_alone {
        let mut simple = Draft::default();
        Simplifier::default().simplify(&alone.append(child), &mut simple);
        member.cost = problem.profile.cycles(&simple, &mut Default::default());
    }
    let allowed = problem.may_show_values(&member.program)
        && problem.child_structure_ok(child)
        && problem.holes_hold(child, &mut Evaluator::default())
        && problem.holes_are_not_refuted(child);
    allowed.then_some(member)
}
