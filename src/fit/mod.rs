//! Constants: how a program's are fitted to samples.

mod chebyshev;
mod derivative;
mod levenberg_marquardt;
mod linear_programs;
mod measure;
mod minimax;
mod model;
mod negligible;
mod rounding;
mod shorten;

pub use derivative::Differentiated;
pub use levenberg_marquardt::{Fitter, Stop};
pub use measure::Measure;
pub use minimax::{Rounds, minimax, minimax_free, shorten_minimax};
pub use model::{Parameter, fit_model};
pub use negligible::{drop_negligible, drop_negligible_minimax};
pub use rounding::rounding_errors;
pub use shorten::shorten;
