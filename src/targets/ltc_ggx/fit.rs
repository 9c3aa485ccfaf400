//! The least error of the third power, by Newton's method.

use super::lobe::{Light, Reflection, Sphere, Techniques, Transformed};
use glam::{DMat4, DVec4};

/// Newton's method takes about ten, damped ones included; by hand.
const MOST_STEPS: usize = 60;
/// The share of the error that a last step may promise to gain: Newton's method is then far closer.
const LEAST_GAIN: f64 = 1e-9;
/// Each divides the distance by ten or more; by hand.
const LAST_STEPS: usize = 4;

/// Descends from `start` to the inverse matrix of the transformed cosine that, times `magnitude`,
/// is nearest to the lobe.
pub(super) fn descend(
    sphere: &Sphere,
    seen: &Reflection,
    magnitude: f64,
    start: [f64; 4],
) -> [f64; 4] {
    let Some(cosine) = Transformed::of_inverse(start) else { return start };
    // The same directions for all steps: their sum is a function, whose minimum can be found
    // exactly.
    let lights = sphere.lights(seen, &cosine, Techniques::Both);
    let mut at = start;
    let Some(mut state) = State::of(&lights, magnitude, at) else { return at };
    // Levenberg's damping, of a Hessian whose diagonal is 1.
    let mut damping = 1e-3;
    for _ in 0..MOST_STEPS {
        let (step, gain) = state.step(damping);
        let next = moved(at, step);
        let tried = (gain > 0.0).then(|| State::of(&lights, magnitude, next)).flatten();
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

/// Steps from a matrix near the minimum to where the gradient is 0. The gradient's integrand jumps
/// where the transformed cosine ends, and so is integrated by the finer of the rules on directions
/// up to there; the Hessian of the coarser one is good enough.
pub(super) fn settle(
    [coarse, fine]: [&Sphere; 2],
    seen: &Reflection,
    magnitude: f64,
    start: [f64; 4],
) -> [f64; 4] {
    let settled = || {
        let state = |sphere: &Sphere, techniques, at| {
            let lights = sphere.lights(seen, &Transformed::of_inverse(at)?, techniques);
            State::of(&lights, magnitude, at)
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

fn moved(at: [f64; 4], step: DVec4) -> [f64; 4] {
    (DVec4::from(at) + step).into()
}

/// The error at a matrix, its gradient and its Hessian.
struct State {
    error: f64,
    gradient: DVec4,
    hessian: DMat4,
}

impl State {
    fn of(lights: &[Light], magnitude: f64, at: [f64; 4]) -> Option<State> {
        let cosine = Transformed::of_inverse(at)?;
        let [m11, m13, m31, m33] = at;
        let determinant = m11 * m33 - m13 * m31;
        // The logarithm of the determinant.
        let first_det = DVec4::new(m33, -m31, -m13, m11) / determinant;
        let mixed = DMat4::from_cols(
            DVec4::new(0.0, 0.0, 0.0, 1.0),
            DVec4::new(0.0, 0.0, -1.0, 0.0),
            DVec4::new(0.0, -1.0, 0.0, 0.0),
            DVec4::new(1.0, 0.0, 0.0, 0.0),
        );
        let second_det = mixed * (1.0 / determinant) - outer(first_det, first_det);
        let mut state = State { error: 0.0, gradient: DVec4::ZERO, hessian: DMat4::ZERO };
        for &Light { direction, value, weight } in lights {
            let lobe = cosine.at(direction);
            let difference = magnitude * lobe - value;
            let size = difference.abs();
            state.error += weight * size * size * size;
            if lobe == 0.0 {
                continue;
            }
            let w = cosine.back(direction);
            let (x, z) = (direction.x, direction.z);
            // ln lobe = ln det + ln w.z - 2 ln |w|², and w.x and w.z are linear in the entries.
            let inverse = 1.0 / w.length_squared();
            let along_x = DVec4::new(x, z, 0.0, 0.0);
            let along_z = DVec4::new(0.0, 0.0, x, z);
            let square = 2.0 * inverse * (w.x * along_x + w.z * along_z);
            let first = first_det + along_z / w.z - 2.0 * square;
            let second = second_det - outer(along_z, along_z) * (1.0 / (w.z * w.z))
                + outer(square, square) * 2.0
                - (outer(along_x, along_x) + outer(along_z, along_z)) * (4.0 * inverse);
            let slope = magnitude * lobe;
            let (linear, quadratic) =
                (3.0 * weight * size * difference * slope, 6.0 * weight * size);
            state.gradient += linear * first;
            state.hessian +=
                outer(first, first) * (quadratic * slope * slope + linear) + second * linear;
        }
        state.error.is_finite().then_some(state)
    }

    /// The step at a damping, and what it promises to gain.
    fn step(&self, damping: f64) -> (DVec4, f64) {
        let diagonal = DVec4::new(
            self.hessian.x_axis.x,
            self.hessian.y_axis.y,
            self.hessian.z_axis.z,
            self.hessian.w_axis.w,
        );
        let scale = diagonal.abs().max(DVec4::splat(f64::MIN_POSITIVE)).powf(-0.5);
        let scaling = DMat4::from_diagonal(scale);
        let hessian = scaling * self.hessian * scaling;
        let gradient = scale * self.gradient;
        let step = (hessian + DMat4::IDENTITY * damping).inverse() * -gradient;
        (scale * step, -0.5 * gradient.dot(step))
    }
}

fn outer(a: DVec4, b: DVec4) -> DMat4 {
    DMat4::from_cols(a * b.x, a * b.y, a * b.z, a * b.w)
}
