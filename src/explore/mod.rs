//! What data say before a search: which inputs matter, and which separations hold.
//!
//! A search finds formulas faster where it is told what they look like. Pesce & Iwanicki (2015,
//! §5.1) look for that by hand: variables that are rarely used may not matter, subexpressions that
//! are often present may be a change of variable. [`explore`] asks the data, output by output.
//!
//! # What is measured
//! The unit of all residuals is the output's **spread**, its standard deviation over the rows,
//! weighted as they are. A residual of 0.01 is one per cent of the spread; the square of a residual
//! is a share of the variance.
//!
//! The **smooth fit** is a polynomial in all inputs: products of Legendre polynomials up to a total
//! degree, each input on the scale (plain, logarithmic, a root towards one end) that suits it best.
//! The degree is the one that errs least on rows left out (five-fold cross-validation), and so is
//! every residual. What the smooth fit leaves is noise, or structure that polynomials miss: kinks,
//! peaks. Nothing below it can be told, unless the rows are a full grid.
//!
//! An input's **shares** of the variance ([`Influence`]) are those of Sobol (1993, "Sensitivity
//! Estimates for Nonlinear Mathematical Models"): the first is what a function of this input alone
//! explains, the total what is lost without it, that is its own share and that of all interactions
//! that it takes part in. Where inputs are not independent of each other in the data, they mean
//! just that, and no longer add up to one.
//!
//! A **form** ([`Form`]) is tested by fitting the best function of that form, in the same way, and
//! comparing both on the same rows left out: `f(x*y)` is a polynomial of `x*y`. (Udrescu & Tegmark
//! 2020, "AI Feynman", test a fitted network for these separations; residuals of rivals that are
//! fitted need no derivatives, and say how much a form would cost.) On full grids sums, products,
//! symmetry and parity are compared value by value instead, however rough the function; there the
//! best function of a form is a table. Either way the [`Departure`] has an estimate, an interval,
//! and the residual that a formula of the form can reach, from which the [`Verdict`] follows.
//!
//! A **template** ([`Template`]) is a formula with holes, for `lgp search`: the form, or the few
//! together, with the fewest inputs in a hole and the fewest terms, which is then fitted itself.
//!
//! Units ([`combinations_by_unit`]) are a hint from columns' units alone, not from values.
//!
//! ```
//! use lgp::dataset::{Dataset, axis};
//! use lgp::explore::explore;
//!
//! let axes = [axis("x", 0.0..=1.0), axis("roughness", 0.1..=1.0)];
//! let data = Dataset::sampled(axes, ["y"], |[x, r]| [(-3.0 * x * r).exp()])?;
//! let found = explore(&data);
//! assert_eq!(found.outputs[0].templates[0].formula, "y = f(x*roughness)");
//! # Ok::<(), lgp::dataset::Error>(())
//! ```
//!
//! # Limits
//! At most a fixed number of rows is fitted to, always the same ones ([`Exploration::fitted`]). Of
//! more than [`MOST_TOGETHER`] inputs those that explain most by themselves are looked at, and
//! pairs are looked for among the [`MOST_PAIRED`] with the largest totals. Periods are looked for only
//! where the rows span one and a half of them.

mod candidate;
mod candidates;
mod departure;
mod design;
mod fitting;
mod form;
mod groups;
mod linear;
mod output;
mod periodic;
mod product;
mod rows;
mod shape;
mod smooth;
mod suggested;
mod table;
mod template;
mod tested;
mod units;

pub use departure::{Departure, Verdict};
pub use form::Form;
pub(crate) use linear::Cholesky;
pub use output::{Finding, Influence, OutputReport, SmoothFit};
pub use shape::Pairing;
pub use template::Template;
pub use units::{Combination, combinations_by_unit};

use crate::dataset::Dataset;
use serde::Serialize;

/// The most inputs of a smooth fit. By hand: a quadratic polynomial in all of them.
pub const MOST_TOGETHER: usize = 20;

/// The most inputs of which all pairs are looked at. By hand, for seconds: there are 15 pairs.
pub const MOST_PAIRED: usize = 6;

/// What the search split of a dataset says of its outputs.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Exploration {
    /// The number of rows.
    pub rows: usize,
    /// The number of rows that smooth fits were made to.
    pub fitted: usize,
    /// Whether the rows are a full grid.
    pub grid: bool,
    /// Output by output.
    pub outputs: Vec<OutputReport>,
    /// Products of powers of inputs that have no unit, or an output's.
    pub units: Vec<Combination>,
}

/// Looks at the search split of a dataset. The same data give the same result.
pub fn explore(dataset: &Dataset) -> Exploration {
    let counted =
        (0..dataset.search.rows()).filter(|&row| dataset.search.weight(row) > 0.0).count();
    let outputs = 0..dataset.outputs.len();
    Exploration {
        rows: dataset.search.rows(),
        fitted: counted.min(rows::most_rows(dataset)),
        grid: !dataset.search.grid.is_empty(),
        outputs: outputs.map(|output| output::explore_output(dataset, output)).collect(),
        units: combinations_by_unit(&dataset.inputs, &dataset.outputs),
    }
}
