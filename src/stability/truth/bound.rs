//! The largest error of a formula against the truth.

use crate::stability::{Rounding, Status};

/// The arithmetic and effort of a bound on the error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ErrorLimits {
    /// The arithmetic that the formula is evaluated in; the truth is in real numbers.
    pub rounding: Rounding,
    /// The bound need not be less than this times the largest error seen; above 1.
    pub ratio: f64,
    /// The most boxes to examine.
    pub boxes: usize,
}

impl ErrorLimits {
    /// Returns limits of half a percent above what is seen, chosen by hand, and as many boxes as
    /// take some seconds; errors above 1e-6 of formulas of one input took 1000 at most.
    pub fn new(rounding: Rounding) -> ErrorLimits {
        ErrorLimits { rounding, ratio: 1.005, boxes: 200_000 }
    }
}

/// The largest error of one output over a whole domain: at least what is seen, at most what is
/// proved.
#[derive(Clone, Debug, PartialEq)]
pub struct ErrorBound {
    /// No `f32` input of the domain has a larger error, but for the gaps; infinite if nothing is
    /// proved.
    pub proved: f64,
    /// The largest error found in the interpreter's arithmetic: infinite where the formula's value
    /// is infinite or NaN and the truth is a number.
    pub seen: f64,
    /// The input where it was found.
    pub at: Vec<f32>,
    /// The interpreter's value there.
    pub value: f32,
    /// What finer boxes could prove at best: the largest distance found in real numbers, plus all
    /// that rounding may do there for all that is known. Above what was seen where errors are of
    /// the order of rounding.
    pub reach: f64,
    /// The share of the domain's volume where more than `ratio` times what was seen is not ruled
    /// out.
    pub volume: f64,
    /// An input of the part where the bound is largest.
    pub worst: Vec<f32>,
    /// An input for which nothing is said, since the truth may have no value there; the last found
    /// of `gaps`.
    pub gap: Option<Vec<f32>>,
    /// The number of such inputs.
    pub gaps: usize,
    /// The boxes that were examined.
    pub boxes: usize,
}

impl ErrorBound {
    /// Decides the claim that the error is at most `most` everywhere: proved, or refuted by the
    /// input seen, or open.
    pub fn decided(&self, most: f64) -> Status {
        if self.proved <= most {
            Status::Proved
        } else if self.seen > most {
            Status::Refuted { input: self.at.clone(), value: self.value }
        } else {
            Status::Open { volume: self.volume }
        }
    }
}
