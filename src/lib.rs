//! Symbolic regression for shaders.

pub mod dataset;
pub mod eval;
pub mod fit;
pub mod num;
pub mod op;
pub mod program;
pub mod suggest;
