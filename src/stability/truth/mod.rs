//! Proofs against a truth that is a formula itself: the largest error over a whole domain.

mod bound;
mod distance;
mod functions;
mod jet;
mod local;
mod record;
mod rounded;
mod search;

pub use bound::{ErrorBound, ErrorLimits};
pub use record::{ErrorRecord, TruthRecord};
pub use search::{largest_error, largest_error_until};
