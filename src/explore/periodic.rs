//! Periods, found by fits to a circle.

use super::departure::{Departure, Verdict};
use super::form::Form;
use super::output::Finding;
use super::shape::{Coordinate, Shape};
use super::tested::Tested;
use rayon::prelude::*;

/// The cycles within the rows' range that are tried: one has to be seen again to count, and of more
/// a plot says so. By hand.
const CYCLES: std::ops::RangeInclusive<f64> = 1.5..=8.0;
/// The step between those that are tried first. By hand: cycles that differ by half a step run
/// apart by a twentieth from one end of the range to the other.
const STEP: f64 = 0.1;
/// The points of each cycle at least. By hand: fewer say nothing of its shape.
const POINTS: f64 = 4.0;
/// The rows of the first fits. By hand, for tenths of a second.
const FEW_ROWS: usize = 512;
/// The residual of a first fit, relative to that without the input, that is worth a closer look;
/// and relative to the best, that is as good. By hand, unmeasured.
const PROMISING: f64 = 0.5;
const AS_GOOD: f64 = 2.0;
/// The golden sections of a step. By hand: the place is known to 1e-5 of a cycle.
const SECTIONS: usize = 24;

/// Tests each input for a period.
pub(super) fn findings(tested: &Tested, inputs: &[usize], names: &[String]) -> Vec<Finding> {
    inputs.par_iter().filter_map(|&input| finding(tested, input, names)).collect()
}

/// Returns a period along an input that holds, the shortest of several.
fn finding(tested: &Tested, input: usize, names: &[String]) -> Option<Finding> {
    let rows = tested.fitting.rows;
    let [low, high] = rows.range(input);
    let mut places = rows.inputs[input].clone();
    places.sort_by(f64::total_cmp);
    places.dedup();
    let most = CYCLES.end().min(places.len() as f64 / POINTS);
    let steps = ((most - CYCLES.start()) / STEP) as usize + 1;
    if most < *CYCLES.start() {
        return None;
    }
    let shape =
        |cycles: f64| circle(tested, input, (high - low) / cycles, places.len() as f64 / cycles);
    let residual = |cycles: f64| tested.fitting.fit(&shape(cycles), FEW_ROWS).residual;
    let tried: Vec<f64> = (0..steps).map(|step| CYCLES.start() + STEP * step as f64).collect();
    let left: Vec<f64> = tried.iter().map(|&cycles| residual(cycles)).collect();
    let without =
        tested.fitting.fit(&Form::Without(input).shape(&tested.inputs), FEW_ROWS).residual;
    let least = left.iter().copied().fold(f64::INFINITY, f64::min);
    if least > PROMISING * without {
        return None;
    }
    // Where a period holds, so do its multiples.
    let start = left.iter().rposition(|left| *left <= AS_GOOD * least)?;
    let start = nearest_dip(&left, start);
    let cycles = section(&residual, [tried[start] - STEP, tried[start] + STEP]);
    let fit = tested.fitting.fit(&shape(cycles), rows.len());
    let departure = Departure::of_fit(rows, &fit, &tested.full);
    let verdict = departure.verdict();
    let form = Form::Periodic(input, (high - low) / cycles);
    let found = Finding { text: form.text(names, &tested.inputs), form, verdict, departure };
    Some(found).filter(|_| matches!(verdict, Verdict::Holds | Verdict::Nearly))
}

/// A function of the place on a circle and of the other inputs, no rougher than the points of a
/// single turn bear.
fn circle(tested: &Tested, input: usize, period: f64, points: f64) -> Shape {
    let turn = [Coordinate::Cosine(input, period), Coordinate::Sine(input, period)];
    let others = tested.inputs.iter().filter(|other| **other != input);
    let others = others.copied().map(Coordinate::Input);
    let mut shape = Shape::joint(turn.into_iter().chain(others).collect());
    shape.highest_degree = Some(((points - 1.0) / 2.0) as usize);
    shape
}

/// Walks down from a place to where both neighbours are higher.
fn nearest_dip(left: &[f64], mut at: usize) -> usize {
    loop {
        let lower = |other: &usize| left[*other] < left[at];
        let next = [at.checked_sub(1), Some(at + 1).filter(|next| *next < left.len())];
        match next.into_iter().flatten().find(lower) {
            Some(next) => at = next,
            None => return at,
        }
    }
}

/// Returns the place of a minimum by golden sections (Kiefer 1953).
fn section(value: &impl Fn(f64) -> f64, [mut low, mut high]: [f64; 2]) -> f64 {
    let golden = (5f64.sqrt() - 1.0) / 2.0;
    for _ in 0..SECTIONS {
        let third = golden * (high - low);
        let [left, right] = [high - third, low + third];
        if value(left) < value(right) { high = right } else { low = left }
    }
    (low + high) / 2.0
}
