//! Reflection and refraction at a rough interface with GGX normals.
//!
//! Source: Walter, Marschner, Li, Torrance, "Microfacet Models for Refraction
//! through Rough Surfaces", 2007 (BRDF: eq. 20, BTDF: eq. 21).

use super::half_vector::{of_reflection, of_refraction, refraction_jacobian};
use super::{fresnel, ggx};
use glam::DVec3;

/// The reflected lobe `F D G2 / (4 n·l n·v)`, in 1/sr, with the
/// height-correlated G2; `fresnel` is the reflectance as a function of v·h.
/// 0 if l or v is below the horizon.
pub fn brdf(l: DVec3, v: DVec3, alpha: f64, fresnel: impl Fn(f64) -> f64) -> f64 {
    if l.z <= 0.0 || v.z <= 0.0 {
        return 0.0;
    }
    let h = of_reflection(l, v);
    let visibility = ggx::visibility_correlated(v.z, l.z, alpha);
    fresnel(v.dot(h).min(1.0)) * ggx::distribution(h.z.min(1.0), alpha) * visibility
}

/// The refracted lobe between dielectrics, in 1/sr; `eta` ≠ 1 is the index of
/// refraction at l over that at v, which are on different sides (else 0). Light
/// travels from v to l: the lobe is density of energy at l, and
/// `btdf(l, v, η) = η² btdf(v, l, 1/η)`. Masking on one side and shadowing on the
/// other are independent, as in the paper.
pub fn btdf(l: DVec3, v: DVec3, alpha: f64, eta: f64) -> f64 {
    if l.z * v.z >= 0.0 {
        return 0.0;
    }
    let h = of_refraction(l, v, eta);
    let (v_dot_h, l_dot_h) = (v.dot(h), l.dot(h));
    // Facets also face v's side of the macrosurface, and l passes through them.
    if h.z * v.z <= 0.0 || l_dot_h >= 0.0 {
        return 0.0;
    }
    let (n_dot_v, n_dot_l) = (v.z.abs(), l.z.abs());
    let transmitted = 1.0 - fresnel::dielectric(eta, v_dot_h.min(1.0));
    let lobe = ggx::distribution(h.z.abs().min(1.0), alpha)
        * ggx::g2_separable(n_dot_v, n_dot_l, alpha)
        * refraction_jacobian(v_dot_h, l_dot_h, eta);
    transmitted * lobe * v_dot_h / (n_dot_v * n_dot_l)
}
