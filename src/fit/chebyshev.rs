//! Linear approximation in the maximum norm: the step that a nonlinear one takes again and again.

/// An exchange that makes no headway any more is cut off after so many, times the unknowns.
const MAX_EXCHANGES: usize = 40;

/// Relative to the largest error: what counts as violated.
const TOLERANCE: f64 = 1e-10;

/// The smallest pivot.
const MIN_PIVOT: f64 = 1e-11;

/// The `x` with every `|x[j]| ≤ 1` that makes the largest `|errors[i] + Σ slopes[j][i]·x[j]|` least, and
/// that least value: the linear program's dual simplex, which for this problem is the exchange
/// of Stiefel (1959, "Über diskrete und lineare Tschebyscheff-Approximationen"), begun at a corner of
/// the box. Nothing where rounding defeats it.
///
/// # Panics
/// If a column of slopes is shorter than `errors`, or there are no errors.
pub(super) fn least_maximum(errors: &[f64], slopes: &[Vec<f64>]) -> Option<(Vec<f64>, f64)> {
    let mut exchange = Exchange::at_a_corner(errors, slopes);
    let mut residuals = Vec::new();
    for _ in 0..MAX_EXCHANGES * (slopes.len() + 1) {
        let point = exchange.point();
        let (x, least) = point.split_at(slopes.len());
        let Some(violated) = exchange.most_violated(x, least[0], &mut residuals) else {
            return Some((x.to_vec(), least[0]));
        };
        exchange.enter(violated)?;
    }
    None
}

/// A constraint `normal · (x, t) ≥ bound` of the program that makes `t` least.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Constraint {
    /// `t ≥ ±(error + slopes · x)` at one sample.
    Sample { index: usize, sign: f64 },
    /// `±x[j] ≥ −1`.
    Side { unknown: usize, sign: f64 },
}

/// The active constraints, as many as unknowns, and the inverse of the transpose of their normals.
struct Exchange<'a> {
    errors: &'a [f64],
    slopes: &'a [Vec<f64>],
    /// The largest error.
    scale: f64,
    active: Vec<Constraint>,
    inverse: Vec<Vec<f64>>,
}

impl<'a> Exchange<'a> {
    /// Where the sample of largest error is as good as the box allows.
    fn at_a_corner(errors: &'a [f64], slopes: &'a [Vec<f64>]) -> Exchange<'a> {
        let largest = |best: usize, i: usize| {
            if errors[i].abs() > errors[best].abs() { i } else { best }
        };
        let index = (0..errors.len()).reduce(largest).expect("at least one sample");
        let sample = Constraint::Sample { index, sign: errors[index].signum() };
        let unknowns = slopes.len();
        let normal = normal(sample, slopes);
        let mut active = Vec::new();
        let mut inverse = Vec::new();
        for (unknown, slope) in normal[..unknowns].iter().enumerate() {
            // The side that the sample's error pushes against.
            let sign = if *slope > 0.0 { -1.0 } else { 1.0 };
            active.push(Constraint::Side { unknown, sign });
            let mut row = vec![0.0; unknowns + 1];
            row[unknown] = sign;
            row[unknowns] = -sign * slope;
            inverse.push(row);
        }
        active.push(sample);
        inverse.push([vec![0.0; unknowns], vec![1.0]].concat());
        Exchange { errors, slopes, scale: errors[index].abs(), active, inverse }
    }

    fn bound(&self, constraint: Constraint) -> f64 {
        match constraint {
            Constraint::Sample { index, sign } => sign * self.errors[index],
            Constraint::Side { .. } => -1.0,
        }
    }

    /// The unknowns, then `t`, where all active constraints are met exactly.
    fn point(&self) -> Vec<f64> {
        let mut point = vec![0.0; self.active.len()];
        for (&constraint, row) in self.active.iter().zip(&self.inverse) {
            let bound = self.bound(constraint);
            point.iter_mut().zip(row).for_each(|(sum, entry)| *sum += bound * entry);
        }
        point
    }

    fn most_violated(&self, x: &[f64], least: f64, residuals: &mut Vec<f64>) -> Option<Constraint> {
        residuals.clear();
        residuals.extend_from_slice(self.errors);
        for (slope, x) in self.slopes.iter().zip(x) {
            residuals.iter_mut().zip(slope).for_each(|(sum, slope)| *sum += slope * x);
        }
        let mut most = (self.scale.max(f64::MIN_POSITIVE) * TOLERANCE, None);
        for (index, residual) in residuals.iter().enumerate() {
            if residual.abs() - least > most.0 {
                let sign = residual.signum();
                most = (residual.abs() - least, Some(Constraint::Sample { index, sign }));
            }
        }
        // A side weighs as much as all that there is to gain.
        for (unknown, x) in x.iter().enumerate() {
            let beyond = (x.abs() - 1.0) * self.scale;
            if beyond > most.0 {
                most = (beyond, Some(Constraint::Side { unknown, sign: -x.signum() }));
            }
        }
        most.1
    }

    /// Makes a constraint active, in place of the one whose multiplier comes to zero first.
    fn enter(&mut self, constraint: Constraint) -> Option<()> {
        let normal = normal(constraint, self.slopes);
        let last = normal.len() - 1;
        let dot = |row: &Vec<f64>| row.iter().zip(&normal).map(|(a, b)| a * b).sum::<f64>();
        let weights: Vec<f64> = self.inverse.iter().map(dot).collect();
        let ratio = |leaving: usize| self.inverse[leaving][last].max(0.0) / weights[leaving];
        let leaving = (0..=last)
            .filter(|&row| weights[row] > MIN_PIVOT)
            .min_by(|&a, &b| ratio(a).total_cmp(&ratio(b)))?;
        let entering: Vec<f64> =
            self.inverse[leaving].iter().map(|entry| entry / weights[leaving]).collect();
        for (row, weight) in self.inverse.iter_mut().zip(&weights) {
            row.iter_mut().zip(&entering).for_each(|(to, entry)| *to -= weight * entry);
        }
        self.inverse[leaving] = entering;
        self.active[leaving] = constraint;
        Some(())
    }
}

fn normal(constraint: Constraint, slopes: &[Vec<f64>]) -> Vec<f64> {
    match constraint {
        Constraint::Sample { index, sign } => {
            slopes.iter().map(|slope| -sign * slope[index]).chain([1.0]).collect()
        }
        Constraint::Side { unknown, sign } => {
            let mut normal = vec![0.0; slopes.len() + 1];
            normal[unknown] = sign;
            normal
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::{RngExt, SeedableRng};

    #[test]
    fn a_parabola_by_a_line_errs_by_an_eighth() {
        // Chebyshev: x² on [0, 1] is nearest x − 1/8.
        let xs: Vec<f64> = (0..=100).map(|i| f64::from(i) / 100.0).collect();
        let errors: Vec<f64> = xs.iter().map(|x| -x * x).collect();
        let slopes = [xs.iter().map(|x| 2.0 * x).collect(), vec![1.0; xs.len()]];
        let (x, least) = least_maximum(&errors, &slopes).unwrap();
        assert!((least - 0.125).abs() < 1e-12, "{least}");
        assert!((x[0] - 0.5).abs() < 1e-12 && (x[1] + 0.125).abs() < 1e-12, "{x:?}");
    }

    #[test]
    fn what_can_be_met_exactly_is_met_within_the_box() {
        let (x, least) = least_maximum(&[0.3], &[vec![0.1], vec![1.0]]).unwrap();
        assert!(x.iter().all(|x| x.abs() <= 1.0 + 1e-9) && least.abs() < 1e-9, "{x:?} {least}");
    }

    /// At the least maximum no step within the box lowers it, and the value claimed is the value there:
    /// with the best inside the box, at its sides, and where there are fewer samples than unknowns.
    #[test]
    fn no_step_within_the_box_is_better() {
        let mut rng = rand_chacha::ChaCha8Rng::seed_from_u64(1);
        let cases = [(200, 1.0), (200, 30.0), (4, 1.0), (4, 30.0)];
        for (unknowns, (samples, size)) in (1..12).flat_map(|n| cases.map(|case| (n, case))) {
            let mut draw = |n| (0..n).map(|_| rng.random_range(-1.0..1.0)).collect::<Vec<f64>>();
            let errors: Vec<f64> = draw(samples).iter().map(|error| error * size).collect();
            let slopes: Vec<Vec<f64>> = (0..unknowns).map(|_| draw(samples)).collect();
            let largest = |x: &[f64]| {
                let at = |i: usize| slopes.iter().zip(x).map(|(s, x)| s[i] * x).sum::<f64>();
                (0..samples).map(|i| (errors[i] + at(i)).abs()).fold(0.0, f64::max)
            };
            let (x, least) = least_maximum(&errors, &slopes).unwrap();
            assert!(x.iter().all(|x| x.abs() <= 1.0 + 1e-9), "{x:?}");
            assert!((largest(&x) - least).abs() < 1e-8 * size, "{least}");
            for scale in [1e-4, 1e-2, 1.0] {
                for _ in 0..200 {
                    let step = draw(unknowns);
                    let near: Vec<f64> =
                        x.iter().zip(step).map(|(x, d)| (x + scale * d).clamp(-1.0, 1.0)).collect();
                    assert!(largest(&near) >= least - 1e-8 * size, "{unknowns} unknowns");
                }
            }
        }
    }
}
