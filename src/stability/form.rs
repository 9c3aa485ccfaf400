//! Affine forms: what a value owes to each input of a box, and what is left.

use crate::num::{Interval, enclose};

/// Inputs whose share is kept apart; that of others counts as left over.
pub(super) const TRACKED: usize = 8;

/// What `f64` arithmetic on forms may lose, relative to the magnitudes that met: a few dozen
/// roundings of 2⁻⁵³.
const LOSS: f64 = 1e-14;

/// `center + Σ slopes[i]·u[i] ± rest`, `u[i]` in [−1, 1] the place of input i within the box
/// (Stolfi & de Figueiredo, "Self-Validated Numerical Methods and Applications", 1997, chapter 3,
/// all but the inputs' noise symbols in one).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Form {
    center: f64,
    slopes: [f64; TRACKED],
    rest: f64,
}

impl Form {
    /// Any value of an interval; nothing where that is not bounded.
    pub fn around(bounds: Interval) -> Option<Form> {
        let (low, high) = (f64::from(bounds.low()), f64::from(bounds.high()));
        (low.is_finite() && high.is_finite() && low <= high)
            .then(|| Form::of(low / 2.0 + high / 2.0, high / 2.0 - low / 2.0))
    }

    /// An input.
    pub fn input(index: usize, bounds: Interval) -> Option<Form> {
        let mut form = Form::around(bounds)?;
        if index < TRACKED {
            form.slopes[index] = form.rest;
            form.rest = form.center.abs() * LOSS;
        }
        Some(form)
    }

    fn of(center: f64, rest: f64) -> Form {
        Form { center, slopes: [0.0; TRACKED], rest }
    }

    /// How far the values reach from the centre.
    pub fn radius(&self) -> f64 {
        self.slopes.iter().map(|slope| slope.abs()).sum::<f64>() + self.rest
    }

    /// What the place of an input changes.
    pub fn slope(&self, input: usize) -> f64 {
        self.slopes.get(input).map_or(0.0, |slope| slope.abs())
    }

    pub fn magnitude(&self) -> f64 {
        self.center.abs() + self.radius()
    }

    pub fn bounds(&self) -> Interval {
        let radius = self.radius() + self.magnitude() * LOSS;
        enclose(self.center - radius, self.center + radius)
    }

    fn padded(self, magnitude: f64) -> Form {
        self.widened(magnitude * LOSS)
    }

    #[must_use]
    pub fn widened(mut self, error: f64) -> Form {
        self.rest += error;
        self
    }

    #[must_use]
    pub fn negated(self) -> Form {
        Form { center: -self.center, slopes: self.slopes.map(|slope| -slope), rest: self.rest }
    }

    #[must_use]
    pub fn plus(self, other: Form) -> Form {
        Form {
            center: self.center + other.center,
            slopes: std::array::from_fn(|i| self.slopes[i] + other.slopes[i]),
            rest: self.rest + other.rest,
        }
        .padded(self.magnitude() + other.magnitude())
    }

    #[must_use]
    pub fn minus(self, other: Form) -> Form {
        self.plus(other.negated())
    }

    /// `factor·self` plus anything in `[low, high]`; `magnitude` is that of the numbers from which
    /// they were computed.
    #[must_use]
    pub fn mapped(self, factor: f64, low: f64, high: f64, magnitude: f64) -> Form {
        Form {
            center: factor * self.center + (low / 2.0 + high / 2.0),
            slopes: self.slopes.map(|slope| factor * slope),
            rest: factor.abs() * self.rest + (high / 2.0 - low / 2.0),
        }
        .padded(factor.abs() * self.magnitude() + magnitude)
    }

    #[must_use]
    pub fn times(self, other: Form) -> Form {
        let (a, b) = (&self, &other);
        let mut center = a.center * b.center;
        let mut rest = 0.0;
        for i in (0..TRACKED).filter(|&i| a.slopes[i] != 0.0 || b.slopes[i] != 0.0) {
            // A square of u is in [0, 1], a product of two different ones in [−1, 1].
            let square = a.slopes[i] * b.slopes[i] / 2.0;
            center += square;
            rest += square.abs();
            for j in i + 1..TRACKED {
                rest += (a.slopes[i] * b.slopes[j] + a.slopes[j] * b.slopes[i]).abs();
            }
        }
        rest += a.rest * b.magnitude() + b.rest * (a.magnitude() - a.rest);
        Form {
            center,
            slopes: std::array::from_fn(|i| a.center * b.slopes[i] + b.center * a.slopes[i]),
            rest,
        }
        .padded(a.magnitude() * b.magnitude())
    }

    /// Values of either.
    #[must_use]
    pub fn hull(self, other: Form) -> Form {
        let apart = self.minus(other).magnitude() / 2.0;
        self.plus(other).mapped(0.5, -apart, apart, apart)
    }
}
