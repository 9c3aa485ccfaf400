//! The error of an approximation, integrated.

use super::gaussian::depth_at;
use super::response::half_turn;
use super::{Fan, Lobe, Response, SphericalGaussian};
use glam::DVec3;
use std::f64::consts::TAU;

/// Integrals over the sphere of products of a response and a model of it.
///
/// Source: course notes, §7.3. The response and each lobe of the model are distributions of their
/// own, drawn at the same number of Halton points and combined by the balance heuristic
/// ([`crate::quadrature::multiple_importance`]). The points do not depend on the model, so that
/// the integrals are smooth functions of its parameters, and minima can be told from noise.
#[derive(Clone, Debug)]
pub struct Misfit {
    response: Response,
    integral: f64,
    points: Vec<[f64; 2]>,
    /// The sine and cosine of each point's azimuth.
    turns: Vec<(f64, f64)>,
    drawn: Vec<Drawn>,
}

/// A direction, and the response there.
#[derive(Clone, Copy, Debug)]
struct Drawn {
    direction: DVec3,
    value: f64,
    density: f64,
}

/// Integrals of the response R and the model M.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Moments {
    /// `∫ R²`.
    pub response_squared: f64,
    /// `∫ R M`.
    pub product: f64,
    /// `∫ M²`.
    pub model_squared: f64,
    /// `∫ M`.
    pub model: f64,
}

impl Moments {
    /// Returns `∫ (R - M)²`, eq. 8.
    pub fn error(&self) -> f64 {
        self.error_scaled(1.0)
    }

    /// Returns the error of the model times a factor.
    pub fn error_scaled(&self, factor: f64) -> f64 {
        self.response_squared - factor * (2.0 * self.product - factor * self.model_squared)
    }

    /// Returns the factor of the model at which the error is least.
    pub fn best_factor(&self) -> f64 {
        self.product / self.model_squared
    }

    /// Returns the error as a share of `∫ R²`, that of no model at all.
    pub fn relative_error(&self) -> f64 {
        self.error() / self.response_squared
    }
}

impl Misfit {
    /// Prepares for models of a response, with `points` from each distribution: the notes take 30
    /// 000 to 50 000 in all. Products of powers of 2 and 3 are spread best.
    pub fn new(response: Response, points: usize) -> Misfit {
        let points = half_turn(points);
        let drawn = |&point: &[f64; 2]| {
            let direction = response.sample(point)?;
            let [value, density] = response.value_and_density(direction);
            Some(Drawn { direction, value, density })
        };
        let drawn = points.iter().filter_map(drawn).collect();
        let turns = points.iter().map(|[u, _]| (TAU * u).sin_cos()).collect();
        Misfit { response, integral: response.integral(), points, turns, drawn }
    }

    /// Returns the response.
    pub fn response(&self) -> &Response {
        &self.response
    }

    /// Returns the integral of the response ([`Response::integral`]).
    pub fn integral(&self) -> f64 {
        self.integral
    }

    /// Integrates over the sphere for the model that is the sum of `lobes`, each of them symmetric
    /// about the plane of n and v.
    pub fn moments<L: Lobe>(&self, lobes: &[L]) -> Moments {
        let mut sums = Moments::default();
        let mut add = |drawn: &Drawn| {
            let [mut model, mut density] = [0.0; 2];
            for lobe in lobes {
                let [value, of_lobe] = lobe.value_and_density(drawn.direction);
                model += value;
                density += of_lobe;
            }
            sums.add(drawn, model, density);
        };
        self.drawn.iter().for_each(&mut add);
        for lobe in lobes {
            for &point in &self.points {
                let direction = lobe.sample(point);
                let [value, density] = self.response.value_and_density(direction);
                add(&Drawn { direction, value, density });
            }
        }
        sums.over(self.points.len())
    }

    /// As [`Misfit::moments`] of the fan's lobes, in a third of the time: seen from each lobe, the
    /// others are at the same angles.
    pub fn fan_moments(&self, fan: &Fan) -> Moments {
        let lobes = fan.lobes();
        let Some(first) = lobes.first() else { return self.moments(&lobes) };
        let amplitudes: Vec<f64> = lobes.iter().map(SphericalGaussian::amplitude).collect();
        let (lambda, peak) = (first.lambda(), first.peak_density());
        let count = lobes.len();
        let mut sums = Moments::default();
        for drawn in &self.drawn {
            let (mut model, mut shapes) = (0.0, 0.0);
            for lobe in &lobes {
                let shape = lobe.shape(drawn.direction);
                model += lobe.amplitude() * shape;
                shapes += shape;
            }
            sums.add(drawn, model, peak * shapes);
        }
        // Sines, and 1 - cosines, of the angles from a lobe to all that may be beside it.
        let step = fan.step();
        let angles: Vec<(f64, f64)> = (1..2 * count)
            .map(|index| (index as f64 - count as f64) * step)
            .map(|angle| (angle.sin(), 2.0 * (0.5 * angle).sin().powi(2)))
            .collect();
        let mut shapes = vec![0.0; angles.len()];
        for (&[_, w], &(sin, cos)) in self.points.iter().zip(&self.turns) {
            let depth = depth_at(lambda, w);
            let sine = (depth * (2.0 - depth)).sqrt();
            let local = DVec3::new(sine * cos, sine * sin, 1.0 - depth);
            for (shape, (sin, below)) in shapes.iter_mut().zip(&angles) {
                *shape = (-lambda * (depth + local.z * below - local.x * sin)).exp();
            }
            for (index, lobe) in lobes.iter().enumerate() {
                let seen = &shapes[count - 1 - index..][..count];
                let model =
                    seen.iter().zip(&amplitudes).map(|(shape, amplitude)| shape * amplitude);
                let direction = lobe.turned(local);
                let [value, density] = self.response.value_and_density(direction);
                let drawn = Drawn { direction, value, density };
                sums.add(&drawn, model.sum(), peak * seen.iter().sum::<f64>());
            }
        }
        sums.over(self.points.len())
    }
}

impl Moments {
    fn add(&mut self, drawn: &Drawn, model: f64, density_of_lobes: f64) {
        let density = drawn.density + density_of_lobes;
        if density <= 0.0 {
            return;
        }
        let weight = 1.0 / density;
        self.response_squared += weight * drawn.value * drawn.value;
        self.product += weight * drawn.value * model;
        self.model_squared += weight * model * model;
        self.model += weight * model;
    }

    fn over(self, points: usize) -> Moments {
        let share = 1.0 / points as f64;
        Moments {
            response_squared: self.response_squared * share,
            product: self.product * share,
            model_squared: self.model_squared * share,
            model: self.model * share,
        }
    }
}
