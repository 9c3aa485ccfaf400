//! Verdicts: bounds that no value leaves, proofs and counterexamples.

mod claims;
mod enclosure;
mod front;
mod half;
mod incumbents;
mod random;
mod sloppy;
mod stiff;
mod truth;
