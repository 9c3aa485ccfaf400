//! Constants: how a program's are fitted to samples.

mod derivative;
mod levenberg_marquardt;
mod shorten;

pub use derivative::Differentiated;
pub use levenberg_marquardt::{Fitter, Stop};
pub use shorten::shorten;
