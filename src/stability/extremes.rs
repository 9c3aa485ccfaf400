//! A formula's outputs at the ends of its domain, just outside, at zero and among denormals.

use super::points;
use crate::num::Interval;
use crate::program::Program;
use serde::Serialize;

/// A kind of place where inputs go although nobody meant them to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Extreme {
    /// The corners, edges and faces of the domain.
    Edge,
    /// One ulp, or 1e-7 of the width, outside, as a normalised vector's cosine may be.
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

/// A value and the input that gives it.
#[derive(Clone, Debug, PartialEq)]
pub struct At {
    /// The value.
    pub value: f32,
    /// The input that gives it.
    pub input: Vec<f32>,
}

/// An output's extent at a kind of place.
#[derive(Clone, Debug, PartialEq)]
pub struct Extent {
    /// The kind of place.
    pub place: Extreme,
    /// The index of the output.
    pub output: usize,
    /// The least finite value; none if no value is finite.
    pub least: Option<At>,
    /// The largest finite value; none if no value is finite.
    pub largest: Option<At>,
    /// The first value that is infinite or NaN; none if every value is finite.
    pub not_finite: Option<At>,
}

/// Returns each output's extent at each kind of place that the domain has.
///
/// # Panics
/// If `domain` does not have one interval for each input.
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

/// Returns points with a special value for one input, and for all of them.
fn points_at(place: Extreme, domain: &[Interval]) -> Vec<Vec<f32>> {
    let special: Vec<Vec<f32>> = domain.iter().map(|&side| special(place, side)).collect();
    let ordinary: Vec<Vec<f32>> = domain
        .iter()
        .map(|side| vec![side.low(), side.low() / 2.0 + side.high() / 2.0, side.high()])
        .collect();
    // With more than six inputs, combinations are too many: the others stay at their low ends.
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
