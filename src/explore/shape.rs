//! Shapes of functions: which coordinates they depend on, and how these come together.

use super::rows::{Rows, range};
use serde::Serialize;
use std::f64::consts::TAU;

/// What two inputs may come together as.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Pairing {
    /// `x*y`
    Product,
    /// `x/y`
    Quotient,
    /// `x + y`
    Sum,
    /// `x - y`
    Difference,
    /// `x^2 + y^2`
    SumOfSquares,
}

impl Pairing {
    pub(super) const ALL: [Pairing; 5] = [
        Pairing::Product,
        Pairing::Quotient,
        Pairing::Sum,
        Pairing::Difference,
        Pairing::SumOfSquares,
    ];

    /// Returns it as formula text.
    pub(super) fn text(self, x: &str, y: &str) -> String {
        match self {
            Pairing::Product => format!("{x}*{y}"),
            Pairing::Quotient => format!("{x}/{y}"),
            Pairing::Sum => format!("{x} + {y}"),
            Pairing::Difference => format!("{x} - {y}"),
            Pairing::SumOfSquares => format!("{x}^2 + {y}^2"),
        }
    }

    pub(super) fn of(self, x: f64, y: f64) -> f64 {
        match self {
            Pairing::Product => x * y,
            Pairing::Quotient => x / y,
            Pairing::Sum => x + y,
            Pairing::Difference => x - y,
            Pairing::SumOfSquares => x * x + y * y,
        }
    }
}

/// What a function depends on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Coordinate {
    Input(usize),
    Pair(Pairing, usize, usize),
    /// `(x - centre)^2`
    Folded(usize, f64),
    /// `cos(2*pi*x/period)`
    Cosine(usize, f64),
    /// `sin(2*pi*x/period)`
    Sine(usize, f64),
}

impl Coordinate {
    /// Returns its value in each of the first rows.
    pub fn values(self, rows: &Rows, count: usize) -> Vec<f64> {
        let column = |input: usize| &rows.inputs[input][..count];
        match self {
            Coordinate::Input(input) => column(input).to_vec(),
            Coordinate::Pair(pairing, x, y) => {
                let (x, y) = (column(x), column(y));
                let pairs = || x.iter().zip(y);
                let values: Vec<f64> = pairs().map(|(&x, &y)| pairing.of(x, y)).collect();
                if values.iter().all(|value| value.is_finite()) {
                    return values;
                }
                // Only a quotient is infinite somewhere. The direction says as much.
                pairs().map(|(x, y)| x.atan2(*y)).collect()
            }
            Coordinate::Folded(input, centre) => {
                column(input).iter().map(|x| (x - centre) * (x - centre)).collect()
            }
            Coordinate::Cosine(input, period) => {
                column(input).iter().map(|x| (TAU * x / period).cos()).collect()
            }
            Coordinate::Sine(input, period) => {
                column(input).iter().map(|x| (TAU * x / period).sin()).collect()
            }
        }
    }
}

/// How the parts of a function come together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Join {
    Sum,
    Product,
}

/// A function of parts, each of some coordinates; parts may share coordinates.
#[derive(Clone, Debug)]
pub(super) struct Shape {
    pub coordinates: Vec<Coordinate>,
    /// Indices into the coordinates.
    pub parts: Vec<Vec<usize>>,
    pub join: Join,
    /// An input, and the centre about which the function is odd in it.
    pub odd: Option<(usize, f64)>,
    /// Two coordinates that may be exchanged.
    pub symmetric: Option<(usize, usize)>,
    /// The highest total degree of polynomials, if not the usual one.
    pub highest_degree: Option<usize>,
}

impl Shape {
    /// Makes a function of coordinates without any structure.
    pub fn joint(coordinates: Vec<Coordinate>) -> Shape {
        let parts = vec![(0..coordinates.len()).collect()];
        Shape {
            coordinates,
            parts,
            join: Join::Sum,
            odd: None,
            symmetric: None,
            highest_degree: None,
        }
    }

    /// Makes a function of inputs without any structure.
    pub fn of_inputs(inputs: &[usize]) -> Shape {
        Shape::joint(inputs.iter().copied().map(Coordinate::Input).collect())
    }

    /// The same function, of parts.
    pub fn split(self, join: Join, parts: Vec<Vec<usize>>) -> Shape {
        Shape { join, parts, ..self }
    }
}

/// How a coordinate is stretched before polynomials of it are taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Scale {
    Linear,
    Logarithm,
    /// The root of the distance from the low end.
    RootLow,
    /// The root of the distance from the high end.
    RootHigh,
    /// The arctangent, in units of a typical magnitude.
    Arctangent(f64),
}

/// The ratio of a coordinate's ends from which its logarithm is tried. By hand, unmeasured.
const MANY_TIMES: f64 = 8.0;

impl Scale {
    /// Returns the scales that make sense for values, the plain one first.
    pub fn suitable(values: &[f64]) -> Vec<Scale> {
        let [low, high] = range(values);
        let mut scales = vec![Scale::Linear, Scale::RootLow, Scale::RootHigh];
        if low > 0.0 && high > MANY_TIMES * low {
            scales.push(Scale::Logarithm);
        }
        let mut magnitudes: Vec<f64> = values.iter().map(|value| value.abs()).collect();
        magnitudes.sort_by(f64::total_cmp);
        let typical = magnitudes.get(magnitudes.len() / 2).copied().unwrap_or(0.0);
        if typical > 0.0 && low.abs().max(high.abs()) > MANY_TIMES * typical {
            scales.push(Scale::Arctangent(typical));
        }
        scales
    }

    /// Stretches values within a range onto [-1, 1].
    pub fn stretched(self, values: &[f64], [low, high]: [f64; 2]) -> Vec<f64> {
        let extent = if high > low { high - low } else { 1.0 };
        let place = |value: f64| match self {
            Scale::Linear => (value - low) / extent,
            Scale::Logarithm => (value / low).ln() / (high / low).ln(),
            Scale::RootLow => ((value - low) / extent).max(0.0).sqrt(),
            Scale::Arctangent(typical) => {
                let [low, value, high] = [low, value, high].map(|at| (at / typical).atan());
                (value - low) / (high - low)
            }
            Scale::RootHigh => 1.0 - ((high - value) / extent).max(0.0).sqrt(),
        };
        values.iter().map(|&value| (2.0 * place(value) - 1.0).clamp(-1.0, 1.0)).collect()
    }
}
