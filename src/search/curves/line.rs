//! Bent lines, and bumps on them.

use crate::op::Op;
use crate::program::{Arg, Draft};

/// Writes a line down, at first `x` itself: its value at zero, its slope, and how much that changes
/// at each bend. Notes which of the constants may change: the bends stay where they are.
pub(super) fn write_line(child: &mut Draft, x: Arg, bends: &[f32], is_free: &mut Vec<bool>) -> Arg {
    let mut constant = |child: &mut Draft, value: f32, free: bool| {
        is_free.push(free);
        child.constant(value)
    };
    let [slope, zero] = [1.0, 0.0].map(|value| constant(child, value, true));
    let mut line = child.push(Op::Mad, &[x, slope, zero]);
    for &bend in &bends[1..bends.len() - 1] {
        let [bend, change] = [(bend, false), (0.0, true)].map(|(v, free)| constant(child, v, free));
        let beyond = child.push(Op::Sub, &[x, bend]);
        let zero = constant(child, 0.0, false);
        let beyond = child.push(Op::Max, &[beyond, zero]);
        line = child.push(Op::Mad, &[beyond, change, line]);
    }
    line
}

/// Writes a value plus a bump: nothing up to `left` and from `right` on, its height at `top`.
pub(super) fn write_bump(
    child: &mut Draft,
    value: Arg,
    x: Arg,
    [left, top, right]: [f32; 3],
    height: f32,
) -> Arg {
    let side = |child: &mut Draft, from: f32| {
        let [from, slope] = [from, 1.0 / (top - from)].map(|number| child.constant(number));
        let way = child.push(Op::Sub, &[x, from]);
        child.push(Op::Mul, &[way, slope])
    };
    let sides = [left, right].map(|from| if from == top { None } else { Some(side(child, from)) });
    let both = match sides {
        [Some(left), Some(right)] => child.push(Op::Min, &[left, right]),
        [one, other] => one.or(other).unwrap_or(x),
    };
    let within = child.push(Op::Saturate, &[both]);
    let height = child.constant(height);
    child.push(Op::Mad, &[within, height, value])
}

/// Returns so many of some values in ascending order, from the least to the largest, without equal
/// ones.
pub(super) fn spread(values: &[f32], count: usize) -> Vec<f32> {
    let last = values.len().saturating_sub(1);
    let places = (0..count.min(values.len())).map(|i| values[i * last / (count - 1).max(1)]);
    let mut spread: Vec<f32> = places.collect();
    spread.dedup();
    spread
}
