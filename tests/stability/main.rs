//! Verdicts: bounds that no value leaves, proofs and counterexamples.

mod enclosure;
mod front;
mod incumbents;
mod sloppy;
mod stiff;
