//! The average reflectance of a smooth dielectric, `2 ∫ F(μ) μ dμ`, lit from everywhere: energy
//! compensation (Kulla and Conty, "Revisiting Physically Based Shading at Imageworks", 2017) and
//! subsurface scattering need it, from outside and from within the denser medium.
//!
//! Definition: [`fresnel::dielectric`], of index `eta` for `outer` and 1/`eta` for `inner`, which
//! includes total internal reflection.
//!
//! Method: the double-exponential rule, whose nodes crowd at grazing angles, where a faint
//! interface begins to reflect. What crosses the interface is the same in both directions but for
//! the spread of radiance: `1 - inner = (1 - outer) / eta²`.

use super::sampling::{SAMPLING, SAMPLING_SEED};
use super::table::{Sample, Table};
use super::{Make, Recipe, Target, points};
use crate::dataset::Axis;
use crate::microfacet::fresnel;
use crate::quadrature::TanhSinh;

/// The largest estimated error that [`generate`](super::generate) accepts: far below the rounding
/// to f32.
pub const ALLOWED_ERROR: f64 = 1e-10;
const TOLERANCE: f64 = 1e-11;
/// Up to above diamond (2.42), and moissanite (2.65).
const INDICES: [f64; 2] = [1.0, 3.0];

pub(super) const TARGET: Target = Target {
    name: "average_fresnel",
    description: "average reflectance of a dielectric, from outside and from within",
    columns: "eta → outer, inner",
    parameters: &[points("256", 1024), SAMPLING, SAMPLING_SEED],
    make: Make::Table(table),
};

/// The two averages at an index of refraction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Average {
    /// The share of the light in front of the denser medium that is reflected.
    pub outer: f64,
    /// The share of the light within it.
    pub inner: f64,
    /// An estimate of the absolute error of either.
    pub error: f64,
}

/// Computes the averages for an index of refraction `eta` ≥ 1 of the denser medium over the other.
pub fn integrate(rule: &TanhSinh, eta: f64) -> Average {
    let outer = rule
        .integrate(0.0, 1.0, TOLERANCE, |mu| 2.0 * mu.from_a * fresnel::dielectric(eta, mu.from_a));
    let inner = 1.0 - (1.0 - outer.value) / (eta * eta);
    Average { outer: outer.value, inner, error: outer.error }
}

/// Returns the table on the indices of [`INDICES`].
fn table(recipe: &Recipe) -> Table {
    let rule = TanhSinh::new();
    let axes = vec![Axis { domain: INDICES, ..Axis::unit("eta") }];
    let outputs = &[("outer", "1"), ("inner", "1")];
    Table::new(recipe, axes, outputs, ALLOWED_ERROR, move |at| {
        let average = integrate(&rule, at[0]);
        Sample { values: [average.outer, average.inner], error: average.error }
    })
}
