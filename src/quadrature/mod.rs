//! Numerical integration, in f64, each result with an estimate of its error.

mod gauss_legendre;
mod tanh_sinh;

pub use gauss_legendre::GaussLegendre;
pub use tanh_sinh::{Abscissa, TanhSinh};

/// An integral.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    pub value: f64,
    /// Estimate of the absolute error of `value`: its distance from the result
    /// of a coarser rule, usually far above the true error.
    pub error: f64,
    /// How often the integrand was evaluated.
    pub evaluations: usize,
}
