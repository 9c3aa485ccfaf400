//! Microfacet terms in f64, in forms that stay accurate at their stiff ends.
//!
//! Cosines such as `n_dot_v` are in [0, 1] and `alpha` is the width of the
//! distribution, in (0, 1] unless a function says otherwise; how it follows
//! from a perceptual roughness is the caller's convention (most engines:
//! `roughness * roughness`).

pub mod fresnel;
pub mod ggx;
