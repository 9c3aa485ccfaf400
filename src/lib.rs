//! Symbolic regression for shaders.

pub mod num;

pub mod dataset;
pub mod microfacet;
pub mod quadrature;
pub mod targets;
