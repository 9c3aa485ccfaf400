//! Half precision, and the least that must stay in single.

use super::points;
use super::variants::unfused;
use crate::eval::{Arithmetic, Double, Half};
use crate::num::Interval;
use crate::op::MAX_ARITY;
use crate::program::{Arg, Program, use_counts};
use half::f16;

/// The least half with all its digits, 2⁻¹⁴.
pub(super) const LEAST_NORMAL: f64 = 6.103_515_625e-5;

/// Points of a domain that halves can hold.
pub(super) fn points(domain: &[Interval], total: usize) -> Vec<Vec<f32>> {
    let mut axes = points::axes(domain, total, 14);
    for (axis, side) in axes.iter_mut().zip(domain) {
        axis.iter_mut().for_each(|x| *x = rounded(*x));
        // A side narrower than the halves there are keeps the nearest.
        let inside: Vec<f32> =
            axis.iter().copied().filter(|&x| side.contains(f64::from(x))).collect();
        if !inside.is_empty() {
            *axis = inside;
        }
        axis.dedup();
    }
    points::all(&axes)
}

fn rounded(x: f32) -> f32 {
    f32::from(f16::from_f32(x))
}

/// The outputs at a point, in half precision but for the instructions marked (none where the list
/// ends). A half that meets single precision is taken as it is, a single that meets halves is
/// rounded; outputs are halves.
pub(super) fn outputs(program: &Program, single: &[bool], point: &[f32]) -> Vec<f64> {
    let arithmetic = Half::default();
    let mut results: Vec<f32> = Vec::with_capacity(program.instrs.len());
    for (i, instr) in program.instrs.iter().enumerate() {
        let in_single = single.get(i).copied().unwrap_or(false);
        let mut arguments = [0.0; MAX_ARITY];
        for (to, &arg) in arguments.iter_mut().zip(instr.args()) {
            *to = match arg {
                Arg::Input(i) => point[usize::from(i)],
                Arg::Const(i) => program.consts[usize::from(i)],
                Arg::Result(i) => results[usize::from(i)],
            };
        }
        results.push(match in_single {
            true => instr.op().apply(arguments),
            false => arithmetic.apply(instr.op(), arguments.map(f16::from_f32)).into(),
        });
    }
    let value = |&arg: &Arg| match arg {
        Arg::Input(i) => rounded(point[usize::from(i)]),
        Arg::Const(i) => rounded(program.consts[usize::from(i)]),
        Arg::Result(i) => rounded(results[usize::from(i)]),
    };
    program.outputs.iter().map(|arg| value(arg).into()).collect()
}

/// The largest error of any output, absolute; infinite where one is no number in halves only. What is
/// no number in `f64` either is no fault of halves.
fn error(program: &Program, single: &[bool], point: &[f32], exact: &[f64]) -> f64 {
    let found = outputs(program, single, point);
    let errors = found.iter().zip(exact).map(|(found, exact)| match (found - exact).abs() {
        _ if found == exact || !exact.is_finite() => 0.0,
        error if error.is_nan() => f64::INFINITY,
        error => error,
    });
    errors.fold(0.0, f64::max)
}

/// Points on which sets are tried, before all.
const FEW: usize = 48;

/// Points that a set is held against.
const POINTS: usize = 8192;

/// The largest error of a program in half precision at the given points, fused or not.
pub fn half_error<'a>(program: &Program, inputs: impl Iterator<Item = &'a [f32]>) -> f64 {
    let forms = [program.clone(), unfused(program)];
    let worst_of = |point: &[f32]| {
        let point: Vec<f32> = point.iter().map(|&x| rounded(x)).collect();
        let exact = Double.evaluate(program, &point.iter().map(|&x| x.into()).collect::<Vec<_>>());
        let errors = forms.iter().map(|form| error(form, &[], &point, &exact));
        errors.fold(0.0, f64::max)
    };
    inputs.map(worst_of).fold(0.0, f64::max)
}

/// The instructions that must stay in single precision for the error over the domain to be at most
/// `bound`: the smallest set that was found, by adding what helps most and then taking away what is
/// not needed. None where not even single precision throughout is enough.
///
/// # Panics
/// If `domain` has not one interval for each input.
pub fn must_stay_single(program: &Program, domain: &[Interval], bound: f64) -> Option<Vec<usize>> {
    let mut used = Vec::new();
    use_counts(program, &mut used);
    let active: Vec<usize> = (0..program.instrs.len()).filter(|&i| used[i] > 0).collect();
    let with_exact = |point: Vec<f32>| {
        let exact = Double.evaluate(program, &point.iter().map(|&x| x.into()).collect::<Vec<_>>());
        (point, exact)
    };
    let all: Vec<(Vec<f32>, Vec<f64>)> =
        points(domain, POINTS).into_iter().map(with_exact).collect();
    let worst = |single: &[bool], points: &[usize]| {
        let errors = points.iter().map(|&i| error(program, single, &all[i].0, &all[i].1));
        errors.fold(0.0, f64::max)
    };
    let everywhere: Vec<usize> = (0..all.len()).collect();
    let mut single = vec![false; program.instrs.len()];
    let mut few: Vec<usize> = everywhere.clone();
    let at_first: Vec<f64> =
        all.iter().map(|(point, exact)| error(program, &single, point, exact)).collect();
    few.sort_by(|&a, &b| at_first[b].total_cmp(&at_first[a]));
    few.truncate(FEW);
    while worst(&single, &everywhere) > bound {
        let left: Vec<usize> = active.iter().copied().filter(|&i| !single[i]).collect();
        let mut tried = |i: usize| {
            single[i] = true;
            let error = worst(&single, &few);
            single[i] = false;
            error
        };
        let left: Vec<(f64, usize)> = left.iter().map(|&i| (tried(i), i)).collect();
        let best = left.into_iter().min_by(|a, b| a.0.total_cmp(&b.0))?.1;
        single[best] = true;
    }
    for &i in &active {
        if single[i] {
            single[i] = false;
            single[i] = worst(&single, &everywhere) > bound;
        }
    }
    Some(active.into_iter().filter(|&i| single[i]).collect())
}
