//! Regular grids on the unit interval and square.

/// Centres of `points` equal cells of [0, 1].
pub(super) fn cell_centres(points: usize) -> Vec<f32> {
    (0..points).map(|i| ((i as f64 + 0.5) / points as f64) as f32).collect()
}

/// About a hundred equidistant nodes from 0 to 1, none of them among the
/// `cell_centres(points)`: k/100, which centres of 4m cells cannot meet, or
/// else k/101, whose odd denominator no centre has.
pub(super) fn nodes_between(points: usize) -> Vec<f32> {
    let intervals = if points.is_multiple_of(4) { 100 } else { 101 };
    (0..=intervals).map(|k| (f64::from(k) / f64::from(intervals)) as f32).collect()
}

/// The area each pair of nodes stands for (trapezoidal rule), the second axis
/// varying fastest, scaled to mean 1.
pub(super) fn area_weights(slow: &[f32], fast: &[f32]) -> Vec<f32> {
    let (slow, fast) = (lengths(slow), lengths(fast));
    slow.iter().flat_map(|a| fast.iter().map(move |b| (a * b) as f32)).collect()
}

fn lengths(nodes: &[f32]) -> Vec<f64> {
    let last = nodes.len().saturating_sub(1);
    let node = |index: usize| f64::from(nodes[index]);
    let lengths: Vec<f64> = (0..nodes.len())
        .map(|i| 0.5 * (node((i + 1).min(last)) - node(i.saturating_sub(1))))
        .collect();
    let mean = lengths.iter().sum::<f64>() / lengths.len() as f64;
    lengths.iter().map(|length| length / mean).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nodes_are_never_cell_centres() {
        for points in 1..=1024 {
            let (centres, nodes) = (cell_centres(points), nodes_between(points));
            assert!(centres.iter().all(|centre| !nodes.contains(centre)), "{points}");
            assert_eq!([nodes[0], nodes[nodes.len() - 1]], [0.0, 1.0]);
        }
    }

    #[test]
    fn edges_weigh_half_and_corners_a_quarter() {
        let nodes = nodes_between(64);
        let weights = area_weights(&nodes, &nodes);
        let inside = f64::from(weights[50 * 101 + 50]);
        assert!((f64::from(weights[50]) / inside - 0.5).abs() < 1e-6);
        assert!((f64::from(weights[0]) / inside - 0.25).abs() < 1e-6);
        let mean = weights.iter().copied().map(f64::from).sum::<f64>() / weights.len() as f64;
        assert!((mean - 1.0).abs() < 1e-7);
    }
}
