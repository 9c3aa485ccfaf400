//! Models of least error.
//!
//! By the simplex of Nelder and Mead, as in the course notes, from several starts. The angle is
//! varied by its cosine, bandwidths by their logarithms, all in units of the lobe that is started
//! from. An amplitude is no coordinate: the error is quadratic in it, so that it follows from the
//! others.

use super::{AnisotropicGaussian, Fan, Misfit, Moments, Response, SphericalGaussian};
use super::{direction_at, upright_frame};
use crate::fit::{NelderMead, Range};
use std::f64::consts::FRAC_PI_2;

/// The amplitude of a model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Amplitude {
    /// The model's integral is the response's.
    Normalised,
    /// That of least error.
    Free,
}

/// A model and its error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fitted<M> {
    /// The model.
    pub model: M,
    /// `∫ (R - M)²` ([`Misfit`]).
    pub error: f64,
    /// That as a share of `∫ R²`.
    pub relative_error: f64,
}

/// By hand: parameters to a ten-thousandth of a lobe.
const SIMPLEX: NelderMead =
    NelderMead { size: 0.25, shrinkage: 4e-4, restarts: 1, max_evaluations: 600 };

/// Minimises from the origin, at steps of a quarter.
fn descend(coordinates: usize, f: impl Fn(&[f64]) -> f64) -> Vec<f64> {
    let origin = vec![0.0; coordinates];
    SIMPLEX.minimise(&origin, &vec![Range::ANY; coordinates], 0, f).at
}

/// Returns the factor that an amplitude asks for.
fn factor(misfit: &Misfit, amplitude: Amplitude, moments: &Moments, integral: f64) -> f64 {
    match amplitude {
        Amplitude::Normalised => misfit.integral() / integral,
        Amplitude::Free => moments.best_factor(),
    }
}

/// The angles of a lobe near `theta` whose width is `width`, over a coordinate of that size.
struct Angles {
    cosine: f64,
    unit: f64,
}

impl Angles {
    fn around(theta: f64, width: f64) -> Angles {
        // Near the normal, a cosine is flat: there a width is half its square.
        let unit = width * theta.sin().max(0.5 * width);
        Angles { cosine: theta.cos(), unit }
    }

    fn at(&self, coordinate: f64) -> f64 {
        (self.cosine + coordinate * self.unit).clamp(0.0, 1.0).acos()
    }
}

/// Fits a fan of `count` lobes, spread no further than its angle from the normal, which the notes
/// found to leave no marks in pictures; from `starts`, or if there are none, from where such lobes
/// usually are. A fan of one lobe is a spherical Gaussian.
pub fn fan(misfit: &Misfit, count: usize, amplitude: Amplitude, starts: &[Fan]) -> Fitted<Fan> {
    let usual = if starts.is_empty() { usual_fans(misfit.response(), count) } else { Vec::new() };
    let fitted = starts.iter().chain(&usual).map(|start| fan_from(misfit, amplitude, start));
    let least = fitted.min_by(|a, b| a.error.total_cmp(&b.error));
    least.expect("there is a start")
}

fn fan_from(misfit: &Misfit, amplitude: Amplitude, start: &Fan) -> Fitted<Fan> {
    let width = start.lambda.max(1.0).sqrt().recip();
    let angles = Angles::around(start.theta, width);
    let at = |coordinates: &[f64]| {
        let theta = angles.at(coordinates[0]);
        let spread = match start.count {
            1 => 0.0,
            _ => (start.spread + coordinates[2] * width).clamp(0.0, theta),
        };
        let lambda = start.lambda * coordinates[1].exp();
        Fan { theta, spread, lambda, amplitude: 1.0, ..*start }
    };
    let fitted = |coordinates: &[f64]| {
        let fan = at(coordinates);
        let moments = misfit.fan_moments(&fan);
        let factor = factor(misfit, amplitude, &moments, fan.integral());
        let error = moments.error_scaled(factor);
        let model = Fan { amplitude: factor, ..fan };
        Fitted { model, error, relative_error: error / moments.response_squared }
    };
    let coordinates = if start.count == 1 { 2 } else { 3 };
    fitted(&descend(coordinates, |coordinates| fitted(coordinates).error))
}

/// Fans about the mirrored direction, as wide as the lobe is across the plane, and spread by what
/// it is wider along it, or by less.
fn usual_fans(response: &Response, count: usize) -> Vec<Fan> {
    let (cosine, alpha) = (response.n_dot_v(), response.alpha());
    let theta = cosine.acos();
    // Of exp(-2 (δ/2α)²), which D is near its peak; across the plane, the lobe is narrower by n·v.
    let along = 1.0 / (alpha * alpha);
    let start = |[narrower, share, lean]: [f64; 3]| {
        let lambda = 0.5 * along * cosine.max(0.5 * alpha).powf(-narrower);
        let theta = (theta * (1.0 - lean * alpha)).min(FRAC_PI_2);
        let spread = (share * alpha).min(theta);
        Fan { count, theta, spread, lambda, amplitude: 1.0 }
    };
    [[1.0, 0.7, 0.3], [1.5, 1.5, 0.1], [0.3, 0.3, 0.6]].map(start).to_vec()
}

/// Fits spherical Gaussians in the plane of n and v, each with its own angle, bandwidth and
/// amplitude (course notes, §7.2), from such lobes. All coordinates are free.
pub fn mixture(misfit: &Misfit, start: &[SphericalGaussian]) -> Fitted<Vec<SphericalGaussian>> {
    let at = |coordinates: &[f64]| -> Vec<SphericalGaussian> {
        let lobe = |(lobe, own): (&SphericalGaussian, &[f64])| {
            let width = lobe.lambda().max(1.0).sqrt().recip();
            let theta = lobe.axis().x.atan2(lobe.axis().z);
            let theta = Angles::around(theta, width).at(own[0]);
            let [lambda, amplitude] =
                [(lobe.lambda(), own[1]), (lobe.amplitude(), own[2])].map(|(of, by)| of * by.exp());
            SphericalGaussian::new(direction_at(theta), lambda, amplitude)
        };
        start.iter().zip(coordinates.chunks(3)).map(lobe).collect()
    };
    let thorough = NelderMead { max_evaluations: 1500 * start.len() as u64, ..SIMPLEX };
    let origin = vec![0.0; 3 * start.len()];
    let error = |coordinates: &[f64]| misfit.moments(&at(coordinates)).error();
    let found = thorough.minimise(&origin, &vec![Range::ANY; origin.len()], 0, error);
    let model = at(&found.at);
    let moments = misfit.moments(&model);
    Fitted { model, error: moments.error(), relative_error: moments.relative_error() }
}

/// Fits an anisotropic Gaussian whose axis is in the plane of n and v (course notes, §7.4).
pub fn anisotropic(misfit: &Misfit, amplitude: Amplitude) -> Fitted<AnisotropicGaussian> {
    let response = misfit.response();
    let (alpha, cosine) = (response.alpha(), response.n_dot_v());
    // The exponent of a spherical Gaussian is half of λ times the squared sine.
    let along = 0.25 / (alpha * alpha);
    let across = along / cosine.max(0.5 * alpha);
    let angles = Angles::around(cosine.acos() * (1.0 - 0.3 * alpha), alpha);
    let at = |coordinates: &[f64]| AnisotropicGaussian {
        frame: upright_frame(direction_at(angles.at(coordinates[0]))),
        lambda: along * coordinates[1].exp(),
        mu: across * coordinates[2].exp(),
        amplitude: 1.0,
    };
    let fitted = |coordinates: &[f64]| {
        let lobe = at(coordinates);
        let moments = misfit.moments(&[lobe]);
        let factor = factor(misfit, amplitude, &moments, moments.model);
        let error = moments.error_scaled(factor);
        let model = AnisotropicGaussian { amplitude: factor, ..lobe };
        Fitted { model, error, relative_error: error / moments.response_squared }
    };
    fitted(&descend(3, |coordinates| fitted(coordinates).error))
}
