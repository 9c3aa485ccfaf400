//! Microfacet terms, in forms that stay accurate at their stiff ends.
//!
//! Cosines such as `n_dot_v` are in [0, 1] and `alpha` is the width of the
//! distribution, in (0, 1] unless a function says otherwise; how it follows
//! from a perceptual roughness is the caller's convention (most engines:
//! `roughness * roughness`). The scalar terms exist in f32 and f64 ([`Real`]).
//!
//! Directions are unit vectors in f64 that point away from the surface, in a
//! frame whose z axis is the macrosurface's normal n. Samplers map uniform
//! numbers in [0, 1)² to directions.
//!
//! | module | holds |
//! |---|---|
//! | [`ggx`], [`beckmann`], [`blinn_phong`] | distributions of normals, and Smith's masking where it exists |
//! | [`charlie`] | the distribution of cloth, its masking |
//! | [`masking`] | cheaper masking and shadowing: Schlick, Hammon |
//! | [`fresnel`] | reflectance of a smooth interface, exact and approximate |
//! | [`half_vector`] | half-vectors of reflection and refraction, with their Jacobians |
//! | [`sampling`] | normals by their distribution, or by the visible part of it |
//! | [`specular`], [`diffuse`] | a BRDF, a BTDF and diffuse lobes |

pub mod beckmann;
pub mod blinn_phong;
pub mod charlie;
pub mod diffuse;
pub mod fresnel;
pub mod ggx;
pub mod half_vector;
pub mod masking;
mod real;
pub mod sampling;
pub mod specular;

pub use real::{Real, sine_squared};
