//! Symbolic regression for shaders.

pub mod emit;
pub mod num;
pub mod op;
pub mod program;
pub mod suggest;
