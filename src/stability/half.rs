//! Half precision: the points at which it is tried, and its errors.

use super::points;
use super::variants::Variant;
use crate::eval::{Arithmetic, Double, Half};
use crate::num::Interval;
use crate::op::MAX_ARITY;
use crate::program::{Arg, Program};
use half::f16;
use serde::Serialize;

/// The least normal half, 2⁻¹⁴.
pub(super) const MIN_NORMAL: f64 = 6.103_515_625e-5;

/// Halves with denormals kept, and flushed to zero: a GPU may do either.
pub(super) const ARITHMETICS: [Half; 2] =
    [Half { flush_to_zero: false }, Half { flush_to_zero: true }];

/// The extent of a trial of half precision.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Tried {
    /// The number of points that were tried.
    pub points: usize,
    /// True if these are all inputs in the domain that halves hold, so that the worst of them is
    /// the worst there is.
    pub exhaustive: bool,
}

/// Inputs that halves hold.
pub(super) struct Points {
    pub points: Vec<Vec<f32>>,
    /// True if these are all such inputs in the domain.
    pub exhaustive: bool,
}

impl Points {
    pub fn tried(&self) -> Tried {
        Tried { points: self.points.len(), exhaustive: self.exhaustive }
    }
}

/// The most combinations of halves to try all of: enough for one input's, 63,488 at most.
const MOST: usize = 1 << 16;

/// Returns all points of a domain that halves hold if they are at most [`MOST`], else about
/// `total`, among them zeros, denormals and the neighbours of the domain's ends.
pub(super) fn points(domain: &[Interval], total: usize) -> Points {
    let counts = domain.iter().map(|&side| halves(side).count().max(1));
    let count = counts.fold(1usize, usize::saturating_mul);
    if count <= MOST {
        let axes: Vec<Vec<f32>> = domain.iter().map(|&side| all_or_nearest(side)).collect();
        let mut points = Vec::with_capacity(count);
        points::every(&axes, count, |point| points.push(point.to_vec()));
        return Points { points, exhaustive: true };
    }
    let spread = points::axes(domain, total, 14);
    let axes: Vec<Vec<f32>> =
        spread.into_iter().zip(domain).map(|(axis, &side)| halves_of(axis, side)).collect();
    let mut points = points::all(&axes);
    for (i, &side) in domain.iter().enumerate() {
        for x in halves_of(special(side), side) {
            points.extend(elsewhere(&axes, i).into_iter().map(|mut point| {
                point[i] = x;
                point
            }));
        }
    }
    Points { points, exhaustive: false }
}

/// Returns points with the other inputs at their ends and in the middle: in all combinations if
/// inputs are few, else all alike.
fn elsewhere(axes: &[Vec<f32>], along: usize) -> Vec<Vec<f32>> {
    // Chosen by hand, unmeasured.
    const FEW: usize = 3;
    let three = |axis: &Vec<f32>| vec![axis[0], axis[axis.len() / 2], axis[axis.len() - 1]];
    let others: Vec<Vec<f32>> = axes.iter().map(three).collect();
    if axes.len() > FEW {
        return (0..3).map(|k| others.iter().map(|axis| axis[k]).collect()).collect();
    }
    let one = |(i, axis): (usize, &Vec<f32>)| if i == along { vec![axis[0]] } else { axis.clone() };
    points::all(&others.iter().enumerate().map(one).collect::<Vec<_>>())
}

/// Returns the finite halves of an interval, with both zeros, in ascending order.
fn halves(side: Interval) -> impl Iterator<Item = f32> {
    const FINITE: u16 = 0x7c00;
    let negative = (0..FINITE).rev().map(|bits| f16::from_bits(0x8000 | bits));
    let all = negative.chain((0..FINITE).map(f16::from_bits)).map(f32::from);
    all.filter(move |&x| side.contains(x.into()))
}

/// Returns the halves of a side; if it holds none, the half nearest to its low end.
fn all_or_nearest(side: Interval) -> Vec<f32> {
    let all: Vec<f32> = halves(side).collect();
    if all.is_empty() { vec![rounded(side.low())] } else { all }
}

/// Rounds an axis's points to halves and keeps those within the side; if none is, the first.
fn halves_of(mut axis: Vec<f32>, side: Interval) -> Vec<f32> {
    axis.iter_mut().for_each(|x| *x = rounded(*x));
    let nearest = axis.first().copied();
    axis.retain(|&x| side.contains(x.into()));
    axis.sort_by(f32::total_cmp);
    axis.dedup_by_key(|x| x.to_bits());
    if axis.is_empty() { nearest.into_iter().collect() } else { axis }
}

/// Returns a side's ends, the halves next to them, zeros, and the ends of the denormal halves.
fn special(side: Interval) -> Vec<f32> {
    let mut special = vec![side.low(), side.high()];
    special.extend(halves(side).take(3));
    let above = Interval::new(side.low().max(side.high() / 2.0).min(side.high()), side.high());
    let last: Vec<f32> = halves(above).collect();
    special.extend(last.iter().rev().take(3));
    for size in [0.0, 5.960_464_5e-8, 6.097_555e-5, MIN_NORMAL as f32] {
        special.extend([size, -size]);
    }
    special
}

pub(super) fn rounded(x: f32) -> f32 {
    f32::from(f16::from_f32(x))
}

/// Returns the outputs at a point, in half precision except for the instructions marked in `single`
/// (none beyond its end). Single precision takes a half as it is, half precision rounds a single;
/// outputs are halves.
pub(super) fn outputs(
    program: &Program,
    single: &[bool],
    arithmetic: Half,
    point: &[f32],
) -> Vec<f64> {
    let stored = |x: f32| f32::from(arithmetic.constant(x));
    let mut results: Vec<f32> = Vec::with_capacity(program.instrs.len());
    for (i, instr) in program.instrs.iter().enumerate() {
        let in_single = single.get(i).copied().unwrap_or(false);
        let mut arguments = [0.0; MAX_ARITY];
        for (to, &arg) in arguments.iter_mut().zip(instr.args()) {
            *to = match arg {
                Arg::Input(i) => stored(point[usize::from(i)]),
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
        Arg::Input(i) => stored(point[usize::from(i)]),
        Arg::Const(i) => stored(program.consts[usize::from(i)]),
        Arg::Result(i) => stored(results[usize::from(i)]),
    };
    program.outputs.iter().map(|arg| value(arg).into()).collect()
}

/// A program as it may be compiled, in half precision except for some instructions.
pub(super) struct Mixed {
    /// The variants, each with the marks of its instructions in single precision.
    variants: Vec<(Program, Vec<bool>)>,
}

impl Mixed {
    /// Makes it of variants of a program; `single` marks instructions of the program as written.
    pub fn new(variants: &[Variant], single: &[bool]) -> Mixed {
        let marked = |variant: &Variant| {
            let marks = variant.origin.iter().map(|&i| single.get(i).copied().unwrap_or(false));
            (variant.program.clone(), marks.collect())
        };
        Mixed { variants: variants.iter().map(marked).collect() }
    }

    /// Returns the outputs of every variant, with denormals kept and flushed.
    pub fn outputs<'a>(&'a self, point: &'a [f32]) -> impl Iterator<Item = Vec<f64>> + 'a {
        let each = |(program, single): &'a (Program, Vec<bool>)| {
            ARITHMETICS.map(|arithmetic| outputs(program, single, arithmetic, point))
        };
        self.variants.iter().flat_map(each)
    }

    /// Returns the largest absolute error of any output; infinite if one is finite in `f64` only.
    /// Outputs that are not finite in `f64` do not count.
    pub fn error(&self, point: &[f32], exact: &[f64]) -> f64 {
        let worst_of = |found: Vec<f64>| {
            let errors = found.iter().zip(exact).map(|(found, exact)| error(*found, *exact));
            errors.fold(0.0, f64::max)
        };
        self.outputs(point).map(worst_of).fold(0.0, f64::max)
    }
}

fn error(found: f64, exact: f64) -> f64 {
    match (found - exact).abs() {
        _ if found == exact || !exact.is_finite() => 0.0,
        error if error.is_nan() => f64::INFINITY,
        error => error,
    }
}

/// Returns the outputs in `f64`.
pub(super) fn exact(program: &Program, point: &[f32]) -> Vec<f64> {
    Double.evaluate(program, &point.iter().map(|&x| x.into()).collect::<Vec<_>>())
}

/// Returns the largest absolute error of a program in half precision at the given points, rounded
/// to halves, whether `mad` is fused or not, denormals kept or flushed.
pub fn half_error<'a>(program: &Program, inputs: impl Iterator<Item = &'a [f32]>) -> f64 {
    let mixed = Mixed::new(&Variant::fused_or_not(program), &[]);
    let worst_of = |point: &[f32]| {
        let point: Vec<f32> = point.iter().map(|&x| rounded(x)).collect();
        mixed.error(&point, &exact(program, &point))
    };
    inputs.map(worst_of).fold(0.0, f64::max)
}
