//! Linear approximation in the maximum norm: one step of a nonlinear approximation.

/// The most exchanges per unknown, to end those that make no headway any more. Chosen by hand,
/// unmeasured.
const MAX_EXCHANGES: usize = 40;

/// The violation of a constraint that counts, relative to the largest error. Chosen by hand,
/// unmeasured.
const TOLERANCE: f64 = 1e-10;

/// The number of samples whose residuals are summed together. Of 8, 16 and 32 the fastest.
const CHUNK: usize = 16;

/// The smallest pivot. Chosen by hand, unmeasured.
const MIN_PIVOT: f64 = 1e-11;

/// Returns the `x`, every `|x[j]| ≤ 1`, that makes the largest `|errors[i] + Σ slopes[j][i]·x[j]|`
/// least, and that least value; none where rounding defeats it.
///
/// The method is the linear program's dual simplex, which for this problem is the exchange of
/// Stiefel (1959, "Über diskrete und lineare Tschebyscheff-Approximationen"), begun at a corner of
/// the box.
///
/// # Panics
/// If a column of slopes is shorter than `errors`, or there are no errors.
pub(super) fn least_maximum(errors: &[f64], slopes: &[Vec<f64>]) -> Option<(Vec<f64>, f64)> {
    let mut exchange = Exchange::at_a_corner(errors, slopes);
    for _ in 0..MAX_EXCHANGES * (slopes.len() + 1) {
        let point = exchange.point();
        let (x, least) = point.split_at(slopes.len());
        let Some(violated) = exchange.most_violated(x, least[0]) else {
            return Some((x.to_vec(), least[0]));
        };
        exchange.enter(violated)?;
    }
    None
}

/// A constraint `normal · (x, t) ≥ bound` of the linear program that makes `t` least.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Constraint {
    /// `t ≥ ±(error + slopes · x)` at one sample.
    Sample { index: usize, sign: f64 },
    /// `±x[j] ≥ −1`.
    Side { unknown: usize, sign: f64 },
}

/// The state of an exchange: as many active constraints as there are unknowns and `t`.
struct Exchange<'a> {
    errors: &'a [f64],
    slopes: &'a [Vec<f64>],
    /// The largest error.
    scale: f64,
    /// The errors and slopes of each chunk of samples, to sum residuals in registers.
    chunks: Vec<[f64; CHUNK]>,
    active: Vec<Constraint>,
    /// The inverse of the transpose of the active constraints' normals.
    inverse: Vec<Vec<f64>>,
}

impl<'a> Exchange<'a> {
    /// Starts at the corner of the box that lowers the largest error most.
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
            // The side towards which the sample's error falls.
            let sign = if *slope > 0.0 { -1.0 } else { 1.0 };
            active.push(Constraint::Side { unknown, sign });
            let mut row = vec![0.0; unknowns + 1];
            row[unknown] = sign;
            row[unknowns] = -sign * slope;
            inverse.push(row);
        }
        active.push(sample);
        inverse.push([vec![0.0; unknowns], vec![1.0]].concat());
        Exchange {
            errors,
            slopes,
            scale: errors[index].abs(),
            chunks: chunks(errors, slopes),
            active,
            inverse,
        }
    }

    fn bound(&self, constraint: Constraint) -> f64 {
        match constraint {
            Constraint::Sample { index, sign } => sign * self.errors[index],
            Constraint::Side { .. } => -1.0,
        }
    }

    /// Returns the unknowns, then `t`, at which all active constraints are met exactly.
    fn point(&self) -> Vec<f64> {
        let mut point = vec![0.0; self.active.len()];
        for (&constraint, row) in self.active.iter().zip(&self.inverse) {
            let bound = self.bound(constraint);
            point.iter_mut().zip(row).for_each(|(sum, entry)| *sum += bound * entry);
        }
        point
    }

    fn most_violated(&self, x: &[f64], least: f64) -> Option<Constraint> {
        let mut most = (self.scale.max(f64::MIN_POSITIVE) * TOLERANCE, None);
        for (chunk, columns) in self.chunks.chunks_exact(self.slopes.len() + 1).enumerate() {
            let residuals = residuals(columns, x);
            // All lanes at once, without a branch for each: hardly any chunk has one.
            if !residuals.iter().fold(false, |any, r| any | (r.abs() - least > most.0)) {
                continue;
            }
            for (lane, residual) in residuals.iter().enumerate() {
                if residual.abs() - least > most.0 {
                    let (index, sign) = (chunk * CHUNK + lane, residual.signum());
                    most = (residual.abs() - least, Some(Constraint::Sample { index, sign }));
                }
            }
        }
        // Violations of sides are weighed by the largest error: all that can be gained.
        for (unknown, x) in x.iter().enumerate() {
            let beyond = (x.abs() - 1.0) * self.scale;
            if beyond > most.0 {
                most = (beyond, Some(Constraint::Side { unknown, sign: -x.signum() }));
            }
        }
        most.1
    }

    /// Makes a constraint active in place of the one whose multiplier reaches zero first.
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

/// Returns the residuals of a chunk of samples, given its errors and slopes.
fn residuals(columns: &[[f64; CHUNK]], x: &[f64]) -> [f64; CHUNK] {
    let mut sums = columns[0];
    for (slopes, x) in columns[1..].iter().zip(x) {
        sums = std::array::from_fn(|lane| sums[lane] + slopes[lane] * x);
    }
    sums
}

/// Returns the errors and slopes chunk by chunk, the last chunk filled up with its last sample.
fn chunks(errors: &[f64], slopes: &[Vec<f64>]) -> Vec<[f64; CHUNK]> {
    let last = errors.len() - 1;
    let mut chunks = Vec::with_capacity(errors.len().div_ceil(CHUNK) * (slopes.len() + 1));
    for first in (0..errors.len()).step_by(CHUNK) {
        let of = |column: &[f64]| std::array::from_fn(|lane| column[(first + lane).min(last)]);
        chunks.push(of(errors));
        chunks.extend(slopes.iter().map(|slope| of(slope)));
    }
    chunks
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

    /// No step within the box lowers the least maximum, and the value returned is the value there:
    /// with the optimum inside the box, at its sides, and with fewer samples than unknowns.
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
