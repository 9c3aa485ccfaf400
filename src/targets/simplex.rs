//! Minimises a function of one or two variables.

/// By hand, unmeasured.
const MOST_STEPS: usize = 300;
/// The size of the simplex at which it stops.
const PRECISION: f64 = 1e-10;

/// Minimises by the method of Nelder and Mead, "A Simplex Method for Function Minimization", 1965,
/// from `start` and points a `step` away along each axis.
pub(super) fn minimum<const D: usize>(
    start: [f64; D],
    step: f64,
    f: impl Fn([f64; D]) -> f64,
) -> [f64; D] {
    let mut corners = vec![(f(start), start)];
    for axis in 0..D {
        let mut corner = start;
        corner[axis] += step;
        corners.push((f(corner), corner));
    }
    for _ in 0..MOST_STEPS {
        corners.sort_by(|a, b| a.0.total_cmp(&b.0));
        let best = corners[0];
        if corners.iter().all(|corner| distance(&corner.1, &best.1) < PRECISION) {
            break;
        }
        let worst = corners[D];
        let centre: [f64; D] = std::array::from_fn(|axis| {
            corners[..D].iter().map(|corner| corner.1[axis]).sum::<f64>() / D as f64
        });
        let try_at = |factor: f64| {
            let point: [f64; D] =
                std::array::from_fn(|axis| centre[axis] + factor * (worst.1[axis] - centre[axis]));
            (f(point), point)
        };
        let reflected = try_at(-1.0);
        let second_worst = corners[D - 1].0;
        let replacement = if reflected.0 < best.0 {
            let expanded = try_at(-2.0);
            if expanded.0 < reflected.0 { expanded } else { reflected }
        } else if reflected.0 < second_worst {
            reflected
        } else {
            let outside = reflected.0 < worst.0;
            let contracted = try_at(if outside { -0.5 } else { 0.5 });
            if contracted.0 < worst.0.min(reflected.0) {
                contracted
            } else {
                for corner in &mut corners[1..] {
                    let halfway = std::array::from_fn(|axis| 0.5 * (corner.1[axis] + best.1[axis]));
                    *corner = (f(halfway), halfway);
                }
                continue;
            }
        };
        corners[D] = replacement;
    }
    corners.sort_by(|a, b| a.0.total_cmp(&b.0));
    corners[0].1
}

fn distance<const D: usize>(a: &[f64; D], b: &[f64; D]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::minimum;

    #[test]
    fn finds_minima() {
        let [x] = minimum([3.0], 0.5, |[x]| (x - 0.2) * (x - 0.2));
        assert!((x - 0.2).abs() < 1e-8, "{x}");
        // Rosenbrock's valley.
        let valley = |[x, y]: [f64; 2]| (1.0 - x).powi(2) + 100.0 * (y - x * x).powi(2);
        let [x, y] = minimum([-1.0, 1.0], 0.5, valley);
        assert!((x - 1.0).abs() < 1e-7 && (y - 1.0).abs() < 1e-7, "{x} {y}");
    }
}
