//! Verdicts: bounds that no value leaves, proofs and counterexamples.

mod enclosure;
mod incumbents;
mod sloppy;
