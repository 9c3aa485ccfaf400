//! Proofs against a truth that is a formula itself: the largest error over a whole domain.

mod distance;
mod jet;
mod local;
mod rounded;
mod search;

pub use search::{ErrorBound, ErrorLimits, largest_error, largest_error_until};
