//! The finish of a formula before it is shown: fits, short constants, guards.

use super::Problem;
use super::front::FrontMember;
use super::problem::FormulaScratch;
use super::rounding::Rounding;
use super::template::{polish_holes, shown};
use crate::archive::near_the_least;
use crate::dataset::Column;
use crate::deadline::Deadline;
use crate::eval::{Arithmetic, Bounds, Samples};
use crate::fit::{
    Fitter, Measure, Rounds, Stop, drop_negligible, drop_negligible_minimax, minimax, minimax_free,
    shorten, shorten_minimax,
};
use crate::num::{Interval, enclose};
use crate::op::{MAX_ARITY, Op};
use crate::program::{Arg, Draft, Names, Program, effective};
use crate::simplify::{Simplifier, tidy};
use rayon::prelude::*;
use std::cmp::Ordering;

/// The end of a front member's fit: next to no gain. Chosen by hand, unmeasured.
pub(super) const TO_CONVERGENCE: Stop = Stop { max_steps: 200, min_gain: 1e-7 };

/// The share by which constants of fewer digits may raise the sum of squares, which is half of it
/// in RMSE. By hand: no plot shows two thousandths.
const SHORTENING_ALLOWANCE: f64 = 0.004;

/// The share by which they may raise the maximum error. Chosen by hand, unmeasured.
const MINIMAX_ALLOWANCE: f64 = 0.01;

/// Returns the share by which shorter constants may raise the loss.
pub(super) fn allowance(measure: Measure) -> f64 {
    if measure == Measure::Max { MINIMAX_ALLOWANCE } else { SHORTENING_ALLOWANCE }
}

/// Finishes the formula that a child becomes: fits to convergence, drops constants that do nothing,
/// shortens the others, and drops what the constants or the domain have made superfluous. None if
/// no form of the formula is finite on every sample and as required.
pub(super) fn polish(
    child: &Draft,
    problem: &Problem,
    samples: &Samples,
    names: &Names,
    measure: Measure,
    deadline: &Deadline,
) -> Option<FrontMember> {
    match &problem.template {
        Some(template) => polish_holes(child, template, problem, samples, measure, deadline),
        None => {
            let draft = problem.formula(child);
            polish_formula(&draft, problem, samples, names, measure, deadline)
        }
    }
}

fn polish_formula(
    draft: &Draft,
    problem: &Problem,
    samples: &Samples,
    names: &Names,
    measure: Measure,
    deadline: &Deadline,
) -> Option<FrontMember> {
    let mut fitter = Fitter::until(deadline);
    let mut fitted = draft.clone();
    let mut smaller;
    if measure == Measure::Max {
        minimax(&mut fitter, &mut fitted, samples, Rounds::TO_CONVERGENCE);
        smaller = fitted.clone();
        drop_negligible_minimax(&mut fitter, &mut smaller, samples, MINIMAX_ALLOWANCE);
    } else {
        fitter.fit(&mut fitted, samples, TO_CONVERGENCE);
        smaller = fitted.clone();
        drop_negligible(&mut fitter, &mut smaller, samples, SHORTENING_ALLOWANCE);
    }
    let mut short = |mut draft: Draft| {
        if measure == Measure::Max {
            shorten_minimax(&mut fitter, &mut draft, samples, MINIMAX_ALLOWANCE);
        } else {
            shorten(&mut fitter, &mut draft, samples, SHORTENING_ALLOWANCE);
        }
        draft
    };
    let smaller = short(smaller);
    let found = finished(&smaller, problem, names, measure);
    // A dropped constant may have kept a divisor from zero between the samples.
    found.or_else(|| {
        let draft = short(fitted);
        finished(&draft, problem, names, measure).or_else(|| {
            // Perhaps all that is wrong is an output that leaves its range.
            let clamped = problem.clamped(&draft)?;
            finished(&clamped, problem, names, measure)
        })
    })
}

/// Shortens the constants of laws once more, in the columns' own units, which may not be those of
/// the search, and merges constants that met when an idle operation between them was dropped. Laws
/// are formulas that err by hardly more than rounding; units must not change a bit of the others'
/// errors.
pub(super) fn with_short_laws(
    members: Vec<FrontMember>,
    problem: &Problem,
    measure: Measure,
) -> Vec<FrontMember> {
    let rounding = Rounding::of(problem);
    // A template's constants are its author's, and those of its holes are short already.
    let is_written = problem.template.is_some();
    if is_written || !members.iter().any(|member| rounding.covers(&member.score, measure)) {
        return members;
    }
    let (samples, names) = (problem.all_as_given(measure), problem.dataset.names());
    let shortened = |member: FrontMember| {
        let mut draft = member.program.clone().into_draft();
        let mut fitter = Fitter::default();
        if measure == Measure::Max {
            drop_negligible_minimax(&mut fitter, &mut draft, &samples, MINIMAX_ALLOWANCE);
            shorten_minimax(&mut fitter, &mut draft, &samples, MINIMAX_ALLOWANCE);
        } else {
            drop_negligible(&mut fitter, &mut draft, &samples, SHORTENING_ALLOWANCE);
            shorten(&mut fitter, &mut draft, &samples, SHORTENING_ALLOWANCE);
        }
        let Ok(program) = Program::verify(draft) else { return member };
        let program = effective(&tidy(&program));
        let short = FrontMember::new(program, &problem.dataset, &problem.profile, &names);
        let is_law = rounding.covers(&short.score, measure) && short.score.is_finite();
        let stays = is_law && short.cost <= member.cost && problem.may_show(&short.program);
        if stays { short } else { member }
    };
    let each = members.into_iter().map(|member| match rounding.covers(&member.score, measure) {
        true => shortened(member),
        false => member,
    });
    each.collect()
}

/// Returns the formula that a child becomes as the search left it, simplified; none if it is not
/// finite on every sample or not as required.
pub(super) fn as_found(child: &Draft, problem: &Problem, names: &Names) -> Option<FrontMember> {
    if let Some(template) = &problem.template {
        return shown(child, template, problem);
    }
    let mut simple = Draft::default();
    Simplifier::default().simplify(&problem.formula_of(child), &mut simple);
    let program = effective(&Program::verify(simple).ok()?);
    let member = FrontMember::new(program, &problem.dataset, &problem.profile, names);
    (member.score.is_finite() && problem.may_show(&member.program)).then_some(member)
}

/// Returns the formula with guards and without superfluous operations, or as it is if these make it
/// worse or costlier; none if neither is finite and as required.
fn finished(
    draft: &Draft,
    problem: &Problem,
    names: &Names,
    measure: Measure,
) -> Option<FrontMember> {
    let mut simplifier = Simplifier::default();
    let mut simple = Draft::default();
    simplifier.simplify(draft, &mut simple);
    let guarded = guarded(&simple, problem);
    let natural = [draft.clone(), simple].into_iter().chain(guarded).filter_map(|draft| {
        let program = Program::verify(problem.natural(&draft).into_owned()).ok()?;
        let active = without_idle(&program, &problem.dataset.inputs);
        // An idle operation may have separated two constants.
        let mut simple = Draft::default();
        simplifier.simplify(&active, &mut simple);
        let is_smaller = simple.instrs.len() < effective(&active).instrs.len();
        let smaller = Program::verify(simple).ok().filter(|_| is_smaller);
        Some([Some(active), smaller])
    });
    let finished = natural.flatten().flatten().filter_map(|program| {
        let program = effective(&tidy(&program));
        let member = FrontMember::new(program, &problem.dataset, &problem.profile, names);
        (!reads_only_constants(&member.program)).then_some(member)
    });
    let shown =
        finished.filter(|member| member.score.is_finite() && problem.may_show(&member.program));
    shown.reduce(|plain, other| better(plain, other, problem, measure))
}

/// Returns the other form of a formula if it is no dearer and as good, else the plain one.
pub(super) fn better(
    plain: FrontMember,
    other: FrontMember,
    problem: &Problem,
    measure: Measure,
) -> FrontMember {
    let rounding = Rounding::of(problem);
    let error = |member: &FrontMember| rounding.at_least(&member.score).joint_search().of(measure);
    let as_good = other.cost <= plain.cost && error(&other) <= error(&plain) * WORSE;
    if as_good { other } else { plain }
}

/// Returns true if an operation reads constants alone. If simplification has not folded it, its
/// value is not finite, such as a quotient by a constant that has become zero.
pub(super) fn reads_only_constants(draft: &Draft) -> bool {
    let is_constant = |arg: &Arg| matches!(arg, Arg::Const(_));
    draft.instrs.iter().any(|instr| instr.args().iter().all(is_constant))
}

/// Guards roots, logarithms and powers by the absolute value of their argument, which avoids NaN
/// between samples and is free on most GPUs. None if there is nothing to guard or the grammar lacks
/// `abs`.
pub(super) fn guarded(draft: &Draft, problem: &Problem) -> Option<Draft> {
    if !problem.grammar.operations.iter().any(|(op, _)| *op == Op::Abs) {
        return None;
    }
    let guarded = draft.rewritten(|new, _, mut instr| {
        if instr.op().needs_positive() {
            instr.args_mut()[0] = new.push(Op::Abs, &instr.args()[..1]);
        }
        new.push_instr(instr)
    });
    (guarded.instrs.len() > draft.instrs.len()).then_some(guarded)
}

/// Returns the children that come near the least maximum error at their cost, first by a quick look,
/// then by a closer one; and whether the deadline left some out.
pub(super) fn shortlist(
    drafts: Vec<Draft>,
    problem: &Problem,
    samples: &Samples,
    deadline: &Deadline,
) -> (Vec<Draft>, bool) {
    let first = screened(drafts, problem, samples, FIRST_LOOK, 1.4, deadline);
    let second = screened(first, problem, samples, SECOND_LOOK, 1.1, deadline);
    (second, deadline.is_past())
}

/// The efforts of the two looks. Chosen by hand, unmeasured.
const FIRST_LOOK: Rounds = Rounds {
    most: 3,
    steps: Stop { max_steps: 2, min_gain: 1e-3 },
    linear_programs: 0,
    wanted: f64::INFINITY,
};
const SECOND_LOOK: Rounds = Rounds { most: 0, linear_programs: 4, ..FIRST_LOOK };

/// Fits the drafts and returns those whose maximum error is less than `within` times that of every
/// cheaper one.
fn screened(
    drafts: Vec<Draft>,
    problem: &Problem,
    samples: &Samples,
    look: Rounds,
    within: f64,
    deadline: &Deadline,
) -> Vec<Draft> {
    let tried: Vec<(f64, f64, Draft)> = drafts
        .into_par_iter()
        .map_init(
            || (Fitter::until(deadline), FormulaScratch::default()),
            |(fitter, scratch), mut child| {
                if deadline.is_past() {
                    return None;
                }
                let error = problem.on_formula(&mut child, |formula, own| {
                    minimax_free(fitter, formula, samples, look, |i| i < own)
                });
                Some((problem.cost_of_child(&child, scratch), error, child))
            },
        )
        .flatten()
        .collect();
    let near =
        near_the_least(tried, within, |(cost, error, _)| (*cost, *error), |_, _| Ordering::Equal);
    near.into_iter().map(|(_, _, draft)| draft).collect()
}

/// The factor by which a simpler form's error may be larger, by rounding. By hand.
const WORSE: f64 = 1.0005;

/// Drops each `abs`, `saturate`, `min` and `max` that, by interval arithmetic, never acts in the
/// inputs' domain.
pub(super) fn without_idle(program: &Program, inputs: &[Column]) -> Program {
    let domain = |column: &Column| enclose(column.domain[0], column.domain[1]);
    let inputs: Vec<Interval> = inputs.iter().map(domain).collect();
    let mut results: Vec<Interval> = Vec::new();
    let draft = program.rewritten(|new, _, instr| {
        let bounds = |arg: Arg| match arg {
            Arg::Input(i) => inputs[usize::from(i)],
            Arg::Const(i) => Bounds.constant(new.consts[usize::from(i)]),
            Arg::Result(i) => results[usize::from(i)],
        };
        let mut arguments = [bounds(instr.args()[0]); MAX_ARITY];
        for (to, &arg) in arguments.iter_mut().zip(instr.args()) {
            *to = bounds(arg);
        }
        results.push(Bounds.apply(instr.op(), arguments));
        let [only, ..] = arguments;
        let negates = only.high() <= 0.0 && !only.may_be_nan() && !only.is_empty();
        let kept = match instr.op() {
            Op::Abs if negates => new.push(Op::Neg, instr.args()),
            _ => new.push_instr(instr),
        };
        passes_through(instr.op(), arguments).map_or(kept, |place| instr.args()[place])
    });
    Program::verify(draft).expect("as many instructions, of values that were there")
}

/// Returns the place of the argument that the result always equals, if there is one.
fn passes_through(op: Op, [a, b, ..]: [Interval; MAX_ARITY]) -> Option<usize> {
    if a.may_be_nan() || a.is_empty() || (op.arity() > 1 && (b.may_be_nan() || b.is_empty())) {
        return None;
    }
    let below = |x: Interval, y: Interval| x.high() <= y.low();
    match op {
        Op::Abs => (a.low() >= 0.0).then_some(0),
        Op::Saturate => (a.low() >= 0.0 && a.high() <= 1.0).then_some(0),
        Op::Min if below(a, b) => Some(0),
        Op::Min if below(b, a) => Some(1),
        Op::Max if below(b, a) => Some(0),
        Op::Max if below(a, b) => Some(1),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::program::{parse, print};

    #[test]
    fn of_every_operation_of_pieces_it_is_known_where_it_passes_a_value_on() {
        let boxes = [[1.0, 2.0, 3.0, 4.0], [3.0, 4.0, 1.0, 2.0], [0.2, 0.4, 0.6, 0.8]];
        for &op in Op::ALL {
            // Roundings to whole numbers, signs and angles act nearly everywhere; a step returns a
            // number, and a selection does not return the values that it compares.
            let always_acts =
                matches!(op, Op::Floor | Op::Fract | Op::Sign | Op::Atan2 | Op::Step | Op::Select);
            let passes = boxes.iter().any(|&[a, b, c, d]| {
                let (first, second) = (enclose(a, b), enclose(c, d));
                passes_through(op, [first, second, first, second]).is_some()
            });
            assert_eq!(passes, op.is_piecewise() && !always_acts, "{op}");
        }
    }

    #[test]
    fn what_does_nothing_in_the_domain_is_left_out() {
        let names = Names::new(["x"], ["y"]);
        let inputs = [Column::new("x", [0.0, 1.0])];
        for (text, left) in [
            ("y = abs(x) + saturate(x)", "y = x + x"),
            ("y = abs(x - 0.5)", "y = abs(x - 0.5)"),
            ("y = max(x, -0.5)*saturate(2*x)", "y = x*saturate(2*x)"),
            ("y = min(abs(x + 1), 0.75)", "y = 0.75"),
            ("y = 2*abs(-0.5 - x)", "y = 2*-(-0.5 - x)"),
        ] {
            let program = without_idle(&parse(text, &names).unwrap(), &inputs);
            assert_eq!(print(&effective(&program), &names), left);
        }
    }
}
