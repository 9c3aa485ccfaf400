//! Fitting the constants of a program to samples.
//!
//! A [`Fitter`] makes the sum of squared errors small, [`minimax`] the largest error. [`shorten`]
//! and [`drop_negligible`] then remove digits and constants that make no difference. [`fit_model`]
//! fits the user's own model, and a [`Measure`] says which error is to be small.
//!
//! All these are local: they go down from where they start. [`fit_globally`] searches the whole
//! range of each constant first, as [`GlobalSettings`] have it: by [`DifferentialEvolution`], and
//! where derivatives lead nowhere by [`NelderMead`]. Both minimise any other function, too.
//!
//! ```
//! use lgp::dataset::Split;
//! use lgp::eval::Samples;
//! use lgp::fit::{Fitter, Stop};
//! use lgp::program::{Names, parse};
//!
//! let columns = vec![vec![0.0, 1.0, 2.0], vec![1.0, 3.0, 5.0]];
//! let samples = Samples::new(&Split { columns, ..Split::default() }, 1);
//! let mut draft = parse("y = 1.5*x + 0.5", &Names::new(["x"], ["y"]))?.into_draft();
//! let stop = Stop { max_steps: 50, min_gain: 1e-9 };
//! assert!(Fitter::default().fit(&mut draft, &samples, stop) < 1e-9);
//! assert!((draft.consts[0] - 2.0).abs() < 1e-4 && (draft.consts[1] - 1.0).abs() < 1e-4);
//! # Ok::<(), lgp::program::ParseError>(())
//! ```

mod chebyshev;
mod derivative;
mod differential_evolution;
mod global;
mod global_fit;
mod levenberg_marquardt;
mod linear_programs;
mod measure;
mod minimax;
mod model;
mod negligible;
mod nelder_mead;
mod objective;
mod parameter;
mod population;
mod range;
mod round;
mod rounding;
mod rows;
mod shorten;
mod simplex;
mod within;

pub use derivative::Differentiated;
pub use differential_evolution::{DifferentialEvolution, End, Minimum, Outside, Start, Strategy};
pub use global::GlobalSettings;
pub use global_fit::{Finish, GlobalFit, fit_globally};
pub use levenberg_marquardt::{Fitter, Stop};
pub use measure::Measure;
pub(crate) use minimax::shorten_minimax_free;
pub use minimax::{Rounds, minimax, minimax_free, shorten_minimax};
pub use model::{LocalFit, fit_model};
pub(crate) use negligible::drop_negligible_in;
pub use negligible::{drop_negligible, drop_negligible_minimax};
pub use nelder_mead::NelderMead;
pub use parameter::{Bound, Parameter};
pub use range::{Range, RangeError, Scale};
pub use rounding::rounding_errors;
pub use shorten::shorten;
pub(crate) use shorten::shorten_free;
pub(crate) use within::squares_within;
