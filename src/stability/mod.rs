//! Verdicts: what is proved of a formula over its whole domain, or refuted.
//!
//! [`prove`] decides properties ([`Property`]: finite, at least, at most) by branch and bound over
//! the domain, a box: each is proved, refuted with a counterexample, or left open. An [`Enclosure`]
//! bounds every instruction of a program on a box, for the interpreter's `f32` or for any
//! arithmetic that GPUs are allowed ([`Rounding`]). An [`Examination`] adds what shows at sampled
//! points: the losses of single and half precision, spreads, extremes, jumps, kinks and trends.
//!
//! Where the truth is a formula itself, [`largest_error`] bounds the distance from it:
//! ```
//! use lgp::num::Interval;
//! use lgp::program::{Names, parse};
//! use lgp::stability::{ErrorLimits, Rounding, largest_error};
//!
//! let names = Names::new(["x"], ["y"]);
//! let formula = parse("y = x*(1 - 0.16*x*x)", &names)?;
//! let truth = parse("y = sin(x)", &names)?;
//! let domain = [Interval::new(0.0, 1.0)];
//! let limits = ErrorLimits::new(Rounding::Gpu);
//! let error = largest_error(&formula, (&truth, &[]), 0, &domain, &limits);
//! assert!(error.proved < 1.01 * error.seen);
//! # Ok::<(), lgp::program::ParseError>(())
//! ```
//!
//! ```
//! use lgp::num::Interval;
//! use lgp::program::{Names, parse};
//! use lgp::stability::{Bound, Limits, Property, Rounding, Status, prove};
//!
//! let program = parse("y = x*(1 - x) + 0.1/x", &Names::new(["x"], ["y"]))?;
//! let bounds = [Bound::Finite, Bound::AtLeast(0.0), Bound::AtMost(0.3)];
//! let claims = bounds.map(|bound| Property::of(0, bound));
//! let prove = |low| {
//!     let domain = [Interval::new(low, 1.0)];
//!     prove(&program, &domain, &claims, &Limits::new(Rounding::Gpu))
//! };
//! let found = prove(0.5);
//! assert_eq!(found[..2], [Status::Proved, Status::Proved]);
//! assert!(matches!(found[2], Status::Refuted { .. }));
//! assert!(matches!(prove(0.0)[0], Status::Refuted { ref input, .. } if *input == [0.0]));
//! # Ok::<(), lgp::program::ParseError>(())
//! ```

// A wildcard arm might prove something of a new operation that nobody checked.
#![deny(clippy::wildcard_enum_match_arm)]

mod blame;
mod chord;
mod counterexample;
mod enclosure;
mod examination;
mod extremes;
mod form;
mod half;
mod mixed;
mod points;
mod precision;
mod prove;
mod record;
mod rounding;
mod smoothness;
mod truth;
mod variants;
mod verdict;

pub use blame::{Blame, Cause};
pub use enclosure::Enclosure;
pub use examination::Examination;
pub use extremes::{At, Extent, Extreme, extremes};
pub use half::{Tried, half_error};
pub use mixed::{Unheld, half_loss, must_stay_single, unheld};
pub use points::points_in;
pub use precision::{Precision, PrecisionLoss};
pub use prove::{Bound, Limits, Property, Status, Stopped, prove};
pub use record::{ClaimRecord, StatusRecord, Value, VerdictRecord};
pub use rounding::Rounding;
pub use smoothness::{Break, JUMP, Smoothness, Trend};
pub use truth::{
    ErrorBound, ErrorLimits, ErrorRecord, TruthRecord, largest_error, largest_error_until,
};
pub use variants::{Liberty, Spread, spreads};
pub use verdict::{Bounded, Case, Finding, Questions, Verdict, bounded};
