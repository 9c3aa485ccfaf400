//! What a formula gives at the ends of its domain, and just outside.

use super::points;
use crate::num::Interval;
use crate::program::Program;
use serde::Serialize;

/// Where inputs go although nobody meant them to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Extreme {
    /// The corners, edges and faces of the domain.
    Edge,
    /// One ulp, or 1e-7 of the width, outside: as a normalised vector's cosine may be.
    JustOutside,
    /// 5 % of the width outside.
    Outside,
    /// +0 and −0.
    Zero,
    /// Numbers that GPUs may flush to zero, of either sign.
    Denormal,
}

const EXTREMES: [Extreme; 5] =
    [Extreme::Edge, Extreme::JustOutside, Extreme::Outside, Extreme::Zero, Extreme::Denormal];

/// A value, and where.
#[derive(Clone, Debug, PartialEq)]
pub struct At {
    /// The value.
    pub value: f32,
    /// The input that gives it.
    pub input: Vec<f32>,
}

/// What an output gives at a kind of place.
#[derive(Clone, Debug, PartialEq)]
pub struct Extent {
    /// The kind of points.
    pub place: Extreme,
    /// The index of the output.
    pub output: usize,
    /// The least and the largest number; none where there is none.
    pub least: Option<At>,
    /// The largest finite value.
    pub largest: Option<At>,
    /// Where it is no finite number.
    pub not_finite: Option<At>,
}

/// Each output's extent at each place that the domain has.
///
/// # Panics
/// If `domain` has not one interval for each input.
pub fn extremes(program: &Program, domain: &[Interval]) -> Vec<Extent> {
    let mut extents = Vec::new();
    for place in EXTREMES {
        let points = points_at(place, domain);
        if points.is_empty() {
            continue;
        }
        let values: Vec<Vec<f32>> = points.iter().map(|point| program.evaluate(point)).collect();
        for output in 0..program.outputs.len() {
            let all = || values.iter().map(|values| values[output]).zip(&points);
            let finite = || all().filter(|(value, _)| value.is_finite());
            let at = |(value, input): (f32, &Vec<f32>)| At { value, input: input.clone() };
            extents.push(Extent {
                place,
                output,
                least: finite().min_by(|a, b| a.0.total_cmp(&b.0)).map(at),
                largest: finite().max_by(|a, b| a.0.total_cmp(&b.0)).map(at),
                not_finite: all().find(|(value, _)| !value.is_finite()).map(at),
            });
        }
    }
    extents
}

/// Points with a special value on one side, and on all.
fn points_at(place: Extreme, domain: &[Interval]) -> Vec<Vec<f32>> {
    let special: Vec<Vec<f32>> = domain.iter().map(|&side| special(place, side)).collect();
    let ordinary: Vec<Vec<f32>> = domain
        .iter()
        .map(|side| vec![side.low(), side.low() / 2.0 + side.high() / 2.0, side.high()])
        .collect();
    // Beyond six inputs only the corners that all share.
    let few = domain.len() > 6;
    let mut points =
        if few || special.iter().any(Vec::is_empty) { Vec::new() } else { points::all(&special) };
    for i in (0..domain.len()).filter(|&i| !special[i].is_empty()) {
        let mut axes = ordinary.clone();
        if few {
            axes.iter_mut().for_each(|axis| axis.truncate(1));
        }
        axes[i].clone_from(&special[i]);
        points.extend(points::all(&axes));
    }
    points
}

fn special(place: Extreme, side: Interval) -> Vec<f32> {
    let (low, high) = (side.low(), side.high());
    let width = high - low;
    if width == 0.0 {
        return Vec::new();
    }
    let within = |values: &[f32]| -> Vec<f32> {
        values.iter().copied().filter(|&x| side.contains(f64::from(x))).collect()
    };
    match place {
        Extreme::Edge => vec![low, high],
        Extreme::JustOutside => {
            vec![low.next_down(), low - 1e-7 * width, high.next_up(), high + 1e-7 * width]
        }
        Extreme::Outside => vec![low - 0.05 * width, high + 0.05 * width],
        Extreme::Zero => within(&[0.0, -0.0]),
        Extreme::Denormal => within(&[1e-40, 1e-45, -1e-40]),
    }
}
