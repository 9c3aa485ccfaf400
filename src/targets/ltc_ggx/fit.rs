//! The least squares, by Newton's method.

use super::Inverse;
use super::lobe::{Light, Reflection, Sphere, Techniques, Transformed};
use glam::{DMat3, DVec2, DVec3};

/// Newton's method takes about ten, damped ones included; by hand.
const MOST_STEPS: usize = 60;
/// The share of the error that a last step may promise to gain: Newton's method is then far closer.
const LEAST_GAIN: f64 = 1e-9;
/// Each divides the distance by ten or more; by hand.
const LAST_STEPS: usize = 4;

/// Transformed cosines whose third row is known but for its length: what is fitted is m11, m13 and
/// that length.
pub(super) struct Fit<'a> {
    pub seen: &'a Reflection,
    pub magnitude: f64,
    /// m31 and m33 of length 1.
    pub row: DVec2,
}

impl Fit<'_> {
    pub fn inverse(&self, [m11, m13, length]: [f64; 3]) -> Inverse {
        let [m31, m33] = (length * self.row).into();
        Inverse { m11, m13, m31, m33 }
    }

    /// The cosine; none if the matrix mirrors.
    fn cosine(&self, at: [f64; 3]) -> Option<Transformed> {
        Transformed::of_inverse(self.inverse(at).into())
    }

    /// Descends from `start` to the lobe that is nearest to what is seen.
    pub fn descend(&self, sphere: &Sphere, start: [f64; 3]) -> [f64; 3] {
        let Some(cosine) = self.cosine(start) else { return start };
        // The same directions for all steps: their sum is a function, whose minimum can be found
        // exactly.
        let lights = sphere.lights(self.seen, &cosine, Techniques::Both);
        let mut at = start;
        let Some(mut state) = self.state(&lights, at) else { return at };
        // Levenberg's damping, of a Hessian whose diagonal is 1.
        let mut damping = 1e-3;
        for _ in 0..MOST_STEPS {
            let (step, gain) = state.step(damping);
            let next = moved(at, step);
            let tried = (gain > 0.0).then(|| self.state(&lights, next)).flatten();
            match tried {
                Some(better) if better.error <= state.error => {
                    (at, state) = (next, better);
                    damping *= 0.1;
                    if gain <= LEAST_GAIN * state.error {
                        break;
                    }
                }
                _ if gain.abs() <= LEAST_GAIN * state.error => break,
                _ => damping = 10.0 * damping.max(1e-6),
            }
        }
        at
    }

    /// Steps from near the minimum to where the gradient is 0. The gradient's integrand jumps where
    /// the transformed cosine ends, and so is integrated by the finer of the rules on directions up
    /// to there; the Hessian of the coarser one is good enough.
    pub fn settle(&self, [coarse, fine]: [&Sphere; 2], start: [f64; 3]) -> [f64; 3] {
        let settled = || {
            let state = |sphere: &Sphere, techniques, at| {
                self.state(&sphere.lights(self.seen, &self.cosine(at)?, techniques), at)
            };
            let hessian = state(coarse, Techniques::Both, start)?.hessian;
            (0..LAST_STEPS).try_fold(start, |at, _| {
                let exact = state(fine, Techniques::Cosine, at)?;
                let (step, _) = State { hessian, ..exact }.step(0.0);
                Some(moved(at, step))
            })
        };
        settled().unwrap_or(start)
    }

    fn state(&self, lights: &[Light], at: [f64; 3]) -> Option<State> {
        let cosine = self.cosine(at)?;
        let [m11, m13, length] = at;
        // The logarithm of the determinant, length * (m11 row.y - m13 row.x).
        let linear =
            DVec3::new(self.row.y, -self.row.x, 0.0) / (m11 * self.row.y - m13 * self.row.x);
        let per_length = DVec3::new(0.0, 0.0, 1.0 / length);
        let first_det = linear + per_length;
        let second_det = -outer(linear, linear) - outer(per_length, per_length);
        let mut state = State { error: 0.0, gradient: DVec3::ZERO, hessian: DMat3::ZERO };
        for &Light { direction, value, weight } in lights {
            let lobe = cosine.at(direction);
            let difference = self.magnitude * lobe - value;
            state.error += weight * difference * difference;
            if lobe == 0.0 {
                continue;
            }
            let w = cosine.back(direction);
            // ln lobe = ln det + ln w.z - 2 ln |w|², and w.x and w.z are linear.
            let inverse = 1.0 / w.length_squared();
            let along_x = DVec3::new(direction.x, direction.z, 0.0);
            let along_z = w.z * per_length;
            let square = 2.0 * inverse * (w.x * along_x + w.z * along_z);
            let first = first_det + per_length - 2.0 * square;
            let second = second_det - outer(per_length, per_length) + outer(square, square) * 2.0
                - (outer(along_x, along_x) + outer(along_z, along_z)) * (4.0 * inverse);
            let slope = self.magnitude * lobe;
            let push = 2.0 * weight * difference * slope;
            state.gradient += push * first;
            state.hessian +=
                outer(first, first) * (push + 2.0 * weight * slope * slope) + second * push;
        }
        state.error.is_finite().then_some(state)
    }
}

fn moved(at: [f64; 3], step: DVec3) -> [f64; 3] {
    (DVec3::from(at) + step).into()
}

/// The error at a matrix, its gradient and its Hessian.
struct State {
    error: f64,
    gradient: DVec3,
    hessian: DMat3,
}

impl State {
    /// The step at a damping, and what it promises to gain.
    fn step(&self, damping: f64) -> (DVec3, f64) {
        let diagonal = self.hessian.diagonal();
        let scale = diagonal.abs().max(DVec3::splat(f64::MIN_POSITIVE)).powf(-0.5);
        let scaling = DMat3::from_diagonal(scale);
        let hessian = scaling * self.hessian * scaling;
        let gradient = scale * self.gradient;
        let step = (hessian + DMat3::IDENTITY * damping).inverse() * -gradient;
        (scale * step, -0.5 * gradient.dot(step))
    }
}

fn outer(a: DVec3, b: DVec3) -> DMat3 {
    DMat3::from_cols(a * b.x, a * b.y, a * b.z)
}
