//! Models' parameters, point by point.
//!
//! Data of many inputs are daunting to approximate at once. Pesce & Iwanicki (2015, course notes
//! §4.2) first look for a model of some of the inputs whose few parameters can be fitted for each
//! combination of the others, and then for formulas of these parameters. A [`Projection`] is the
//! step between: from data of `(x, alpha, size)` and the model `y = f(x; $p, $q)` to data of
//! `(alpha, size)` whose outputs are `p`, `q` and `residual`.
//!
//! # Semantics
//! Rows that have the same values of the inputs `over` are a **group**, its values a **place**. The
//! parameters of a group are the least squares of the model over its rows, in the outputs' units,
//! with the rows' weights; `residual` is the root of the mean square. Rows of no weight are in no
//! group.
//!
//! **Levels** (course notes §3.3, "running the minimization hierarchically"): on a grid, the group
//! in the middle comes first, and each level halves the distances; scattered groups come in a random
//! order, each level three times as many as all before it. A group is fitted locally from its coarser
//! neighbours' mean, and from the one of them that suits it best. Where these end apart, where the
//! error is out of line with the neighbours', and in the first levels, it is also fitted globally
//! ([`crate::fit::fit_globally`]). Then each group is compared with its neighbours: from optima far
//! from its own it is fitted again, until none gets better. Of optima that are equally good, but for
//! a thousandth, the neighbours' is kept.
//!
//! **Smoothing** ([`Settings::smooth`]) makes the mean square error, as a share of the outputs'
//! variance, plus `smooth` times the squared steps to the neighbours, in spreads of each parameter,
//! small: for optima that jump between lobes, or that noise makes uncertain. Levels come again from
//! coarse to fine, each group pulled towards those around it, then sweeps over all groups, no two
//! neighbours together. The `residual` is that of the error alone. A group with fewer values than
//! parameters is left out, unless it can be smoothed.
//!
//! **Validation**: the groups of the data's validation split are the projection's, fitted from the
//! search split's neighbours (and pulled towards them), if there are at least a quarter as many as
//! those of the search split, with rows enough, and at other places. Otherwise, as in a table
//! whose rows were held back one by one, they would tell nothing about places in between: then
//! every fourth group is held back, along the diagonals of a grid, which is none any more.
//!
//! ```
//! use lgp::dataset::{Dataset, axis};
//! use lgp::deadline::Deadline;
//! use lgp::project::{Projection, Settings};
//!
//! let axes = [axis("x", 0.0..=1.0), axis("alpha", 0.5..=1.0)];
//! let data = Dataset::sampled(axes, ["y"], |[x, alpha]| [(-3.0 * alpha * alpha * x).exp2()])?;
//! let over = ["alpha".to_owned()];
//! let projection = Projection::new(&data, "y = exp2(-$k*x)", &over, Settings::default())?;
//! let mut state = projection.begin();
//! projection.advance(&mut state, &Deadline::NEVER, &mut |_, _| {});
//! let surfaces = projection.surfaces(&state)?;
//! let parameters = surfaces.dataset(&projection)?;
//! assert_eq!(parameters.names().outputs, ["k", "residual"]);
//! let [alphas, ks] = [&parameters.search.columns[0], &parameters.search.columns[1]];
//! assert!(alphas.iter().zip(ks).all(|(alpha, k)| (3.0 * alpha * alpha - k).abs() < 1e-4));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod bench;
mod dependence;
mod error;
mod groups;
mod landscape;
mod layout;
mod model;
mod penalty;
mod plan;
mod projection;
mod proposal;
mod state;
mod surfaces;
mod work;

pub use dependence::Dependence;
pub use error::Error;
pub use landscape::{Landscape, PlaceGrid};
pub use model::Model;
pub use projection::Projection;
pub use proposal::Proposal;
pub use state::State;
pub use surfaces::{Place, Surfaces};

use crate::fit::Measure;

/// What is asked of a projection, beside the model and the inputs.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Settings {
    /// Bounds of parameters, by name.
    pub bounds: Vec<(String, [f32; 2])>,
    /// Values of parameters to start from, by name; 1 if not given.
    pub starts: Vec<(String, f32)>,
    /// The parameters that are searched and smoothed on a logarithmic scale.
    pub logarithmic: Vec<String>,
    /// The measure of errors: one of squares; [`Measure::usual`] if none.
    pub measure: Option<Measure>,
    /// The penalty of a step of one spread between neighbours, as a share of the outputs' variance;
    /// 0 for none.
    pub smooth: f64,
    /// Whether every group is fitted globally.
    pub everywhere: bool,
    /// The seed of random numbers.
    pub seed: u64,
}
