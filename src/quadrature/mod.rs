//! Integrates numerically, in f64; each result has an estimate of its error and the number of
//! evaluations.
//!
//! | the integrand is | take |
//! |---|---|
//! | smooth up to the ends | [`Rule::gauss_legendre`] |
//! | of unknown kind, one or two variables | [`Adaptive`] over [`Rule::gauss_kronrod`] |
//! | singular or steep at the ends | [`TanhSinh`] |
//! | periodic, over a whole period | [`Rule::midpoint`] |
//! | over a disc, a sphere, to infinity | one of the above, over a [`change`] of variable |
//! | of many variables, or an expectation | [`importance`], with points of [`crate::num::low_discrepancy`] |
//! | a product of peaks | [`multiple_importance`] |
//!
//! Limits and points are arrays, one number per variable, and integrands take such an array:
//! `|[x, y]| x * y`.
//!
//! ```
//! use lgp::quadrature::{Adaptive, Rule, change};
//! use std::f64::consts::PI;
//!
//! let line = Rule::gauss_legendre(8).integrate([0.0], [PI], |[x]| x.sin());
//! assert!((line.value - 2.0).abs() < 1e-12);
//!
//! let rule = Rule::gauss_kronrod(7);
//! let steep = |[x, y]: [f64; 2]| 1.0 / (1e-3 + x * x + y * y);
//! let square = Adaptive::new(&rule, 1e-9).global([0.0; 2], [1.0; 2], steep);
//! assert!(square.error <= 1e-9);
//!
//! let cosine = change::over(change::hemisphere, |w| w.z);
//! let hemisphere = rule.integrate([0.0; 2], [1.0; 2], cosine);
//! assert!((hemisphere.value - PI).abs() < 1e-12);
//! ```

mod adaptive;
pub mod change;
mod clenshaw_curtis;
mod gauss;
mod gauss_kronrod;
mod newton_cotes;
mod rule;
mod sampling;
mod tanh_sinh;

pub use adaptive::Adaptive;
pub use rule::{Point, Rule};
pub use sampling::{Technique, importance, multiple_importance};
pub use tanh_sinh::{Abscissa, TanhSinh};

/// An integral.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// The integral's value.
    pub value: f64,
    /// An estimate of the absolute error of `value`: for a rule, the distance from the result of
    /// a coarser one, usually far above the true error; for random samples, the standard error.
    /// Infinite if the value is not finite.
    pub error: f64,
    /// The number of evaluations of the integrand.
    pub evaluations: usize,
}

impl Estimate {
    /// Makes the error infinite if the value or the error is not finite.
    fn checked(value: f64, error: f64, evaluations: usize) -> Estimate {
        let usable = value.is_finite() && error.is_finite();
        Estimate { value, error: if usable { error } else { f64::INFINITY }, evaluations }
    }
}
