//! Verdicts: bounds that no value leaves, proofs and counterexamples.

mod enclosure;
mod front;
mod half;
mod incumbents;
mod random;
mod sloppy;
mod stiff;
