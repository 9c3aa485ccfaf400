//! Symbolic regression for shaders.

pub mod num;
pub mod op;
pub mod program;
pub mod suggest;
