//! Symbolic regression for shaders.

pub mod suggest;

pub mod num;
pub mod op;
pub mod program;

pub mod dataset;

pub mod eval;
pub mod fit;

pub mod microfacet;
pub mod quadrature;
pub mod targets;

pub mod cli;
