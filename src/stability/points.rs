//! Sample points: spread over a domain, crowded towards its faces.

use crate::num::Interval;

/// Returns some thousands of points, spread over a domain and crowded towards its faces.
pub fn points_in(domain: &[Interval]) -> Vec<Vec<f32>> {
    all(&axes(domain, 2048, 14))
}

/// Returns the points of each side, at least three, whose combinations are at most `total` if
/// possible: half of them evenly spaced from end to end, half of them ever nearer to both ends,
/// down to `2^-finest` of the width. A side that is a point has that point alone.
pub(super) fn axes(domain: &[Interval], total: usize, finest: u32) -> Vec<Vec<f32>> {
    let sides = domain.iter().filter(|side| side.low() < side.high()).count().max(1);
    // Where even three each are too many combinations to visit, more points cost nothing.
    let least = if sides > MOST.ilog(3) as usize { 17.0 } else { 3.0 };
    let count = (total as f64).powf(1.0 / sides as f64).floor().clamp(least, 257.0) as usize;
    domain.iter().map(|&side| axis(side, count, finest)).collect()
}

fn axis(side: Interval, count: usize, finest: u32) -> Vec<f32> {
    let (low, high) = (f64::from(side.low()), f64::from(side.high()));
    if low == high {
        return vec![side.low()];
    }
    let even = count.div_ceil(2).max(2);
    let near = (count - even.min(count)) / 2;
    let share = |i: usize| i as f64 / (even - 1) as f64;
    let mut points: Vec<f64> = (0..even).map(|i| low + (high - low) * share(i)).collect();
    for i in 0..near {
        // From 2^-2 down, evenly in the exponent.
        let exponent = 2.0 + (f64::from(finest) - 2.0) * (i + 1) as f64 / near as f64;
        let step = (high - low) * (-exponent).exp2();
        points.extend([low + step, high - step]);
    }
    let mut points: Vec<f32> =
        points.into_iter().map(|x| (x as f32).clamp(side.low(), side.high())).collect();
    points.sort_by(f32::total_cmp);
    points.dedup();
    points
}

/// The most combinations that are visited. Chosen by hand, unmeasured.
const MOST: usize = 1 << 14;

/// Calls `visit` at every combination of the axes' points. If these are more than [`MOST`], visits
/// the two corners of all first and all last points, the corners where one axis differs from those,
/// and combinations spread by irrational steps.
pub(super) fn each(axes: &[Vec<f32>], visit: impl FnMut(&[f32])) {
    let count = axes.iter().try_fold(1usize, |product, axis| product.checked_mul(axis.len()));
    let Some(count) = count.filter(|&count| count <= MOST) else {
        return some(axes, visit);
    };
    every(axes, count, visit);
}

/// Calls `visit` at all combinations, of which there are `count`.
pub(super) fn every(axes: &[Vec<f32>], count: usize, mut visit: impl FnMut(&[f32])) {
    let mut point = vec![0.0; axes.len()];
    for index in 0..count {
        let mut rest: usize = index;
        for (x, axis) in point.iter_mut().zip(axes) {
            *x = axis[rest % axis.len()];
            rest /= axis.len();
        }
        visit(&point);
    }
}

fn some(axes: &[Vec<f32>], mut visit: impl FnMut(&[f32])) {
    let end = |axis: &Vec<f32>, last: bool| axis[if last { axis.len() - 1 } else { 0 }];
    let corner = |last: bool| axes.iter().map(|axis| end(axis, last)).collect::<Vec<f32>>();
    let mut point = Vec::new();
    for last in [false, true] {
        point = corner(last);
        visit(&point);
        for i in 0..axes.len().min(MOST / 4) {
            let before = point[i];
            point[i] = end(&axes[i], !last);
            visit(&point);
            point[i] = before;
        }
    }
    for index in 0..MOST / 2 {
        for (k, (x, axis)) in point.iter_mut().zip(axes).enumerate() {
            let share =
                ((index + 1) as f64 * (0.618_033_988_75 + k as f64 * 0.414_213_562_37)).fract();
            *x = axis[((share * axis.len() as f64) as usize).min(axis.len() - 1)];
        }
        visit(&point);
    }
}

/// Returns the combinations of the axes' points that [`each`] visits.
pub(super) fn all(axes: &[Vec<f32>]) -> Vec<Vec<f32>> {
    let mut points = Vec::new();
    each(axes, |point| points.push(point.to_vec()));
    points
}
