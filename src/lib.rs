//! Symbolic regression for shaders.

pub mod suggest;

pub mod num;
pub mod op;
pub mod program;
pub mod simplify;

pub mod dataset;
pub mod grammar;

pub mod cost;
pub mod eval;
pub mod fit;

pub mod archive;
pub mod search;

pub mod emit;

pub mod microfacet;
pub mod quadrature;
pub mod targets;

pub mod report;

pub mod cli;
