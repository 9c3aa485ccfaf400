//! Constants: how a program's are fitted to samples.

mod derivative;
mod levenberg_marquardt;

pub use derivative::Differentiated;
pub use levenberg_marquardt::{Fitter, Stop};
