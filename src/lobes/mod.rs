//! Reflections as spherical Gaussians: lobes that stand in for a GGX surface's response to light,
//! so that a prefiltered environment can be looked up in their place.
//!
//! Source: Pesce and Iwanicki, "Approximate Models for Physically Based Rendering" (SIGGRAPH 2015
//! course notes, §7). In their frame the normal is z, v is in the plane of x and z, and the lobe is
//! across the normal from it, at x ≥ 0; angles θ in that plane are measured from the normal.
//!
//! | | |
//! |---|---|
//! | [`Response`] | the GGX lobe that is approximated |
//! | [`SphericalGaussian`], [`AnisotropicGaussian`] | lobes, with their densities and samples |
//! | [`Fan`] | the multi-lobe model: Gaussians side by side with few parameters |
//! | [`Misfit`] | the integral of the squared error, by multiple importance sampling |
//! | [`fit`], [`Grid`] | parameters of least error, at a place and over a grid |
//!
//! ```
//! use lgp::lobes::{Fan, Misfit, Response, fit};
//!
//! let misfit = Misfit::new(Response::new(0.5, 0.09), 1000);
//! let fitted = fit::fan(&misfit, 8, fit::Amplitude::Free, &[]);
//! assert!(misfit.moments(&fitted.model.lobes()).relative_error() < 0.04);
//! ```

mod anisotropic;
mod fan;
pub mod fit;
mod gaussian;
mod grid;
mod misfit;
mod response;

pub use anisotropic::AnisotropicGaussian;
pub use fan::Fan;
pub use gaussian::SphericalGaussian;
pub use grid::Grid;
pub use misfit::{Misfit, Moments};
pub use response::Response;

use glam::{DMat3, DVec3};

/// A function on the sphere that directions can be drawn by, in 1/sr.
pub trait Lobe {
    /// Returns the value in a direction.
    fn value(&self, direction: DVec3) -> f64;

    /// Returns the density of [`Lobe::sample`] per unit solid angle.
    fn density(&self, direction: DVec3) -> f64;

    /// Draws a direction by uniform numbers in [0, 1)².
    fn sample(&self, point: [f64; 2]) -> DVec3;

    /// Returns [`Lobe::value`] and [`Lobe::density`], which may have terms in common.
    fn value_and_density(&self, direction: DVec3) -> [f64; 2] {
        [self.value(direction), self.density(direction)]
    }
}

/// Returns the direction at `theta` from the normal in the plane of x and z.
pub fn direction_at(theta: f64) -> DVec3 {
    let (sin, cos) = theta.sin_cos();
    DVec3::new(sin, 0.0, cos)
}

/// Returns an orthonormal frame about an axis, y as near as can be to the world's: one that follows
/// axes in the plane of x and z without a jump.
pub fn upright_frame(axis: DVec3) -> DMat3 {
    let x = DVec3::Y.cross(axis).try_normalize().unwrap_or(DVec3::X);
    DMat3::from_cols(x, axis.cross(x), axis)
}
