//! Draws directions from distributions of normals, from the visible ones among them, and from
//! diffuse lobes. Each function maps uniform numbers in [0, 1)² to a direction and names its
//! density per unit solid angle.
//!
//! Sources: Walter, Marschner, Li, Torrance, "Microfacet Models for Refraction
//! through Rough Surfaces", 2007 (eqs. 28, 31, 35); Heitz and d'Eon, "Importance
//! Sampling Microfacet-Based BSDFs using the Distribution of Visible Normals",
//! 2014; Dupuy and Benyoub, "Sampling Visible GGX Normals with Spherical Caps",
//! 2023.

use super::fresnel::schlick_transmission;
use glam::DVec3;
use std::f64::consts::{PI, TAU};

/// GGX normals: density `D (n·h)`. `alpha` in (0, 1].
pub fn ggx([u, w]: [f64; 2], alpha: f64) -> DVec3 {
    slope_at(u, alpha * (w / (1.0 - w)).sqrt())
}

/// Beckmann normals: density `D (n·h)`. `alpha` in (0, 1].
pub fn beckmann([u, w]: [f64; 2], alpha: f64) -> DVec3 {
    slope_at(u, alpha * (-(-w).ln_1p()).sqrt())
}

/// Blinn–Phong normals: density `D (n·h)`. `exponent` ≥ 0.
pub fn blinn_phong([u, w]: [f64; 2], exponent: f64) -> DVec3 {
    let log_cosine = (-w).ln_1p() / (exponent + 2.0);
    // sin² without the cancellation of 1 - cos².
    let sine = (-(2.0 * log_cosine).exp_m1()).sqrt();
    at_azimuth(u, sine, log_cosine.exp())
}

/// GGX normals as v sees them: density [`visible_density`]. v may be below the
/// horizon, where it sees facets from below. `alpha` in (0, 1].
pub fn visible_ggx([u, w]: [f64; 2], v: DVec3, alpha: f64) -> DVec3 {
    // Stretched to α = 1, the visible facets mirror v to a uniform cap of directions c with c·n >
    // -v·n.
    let v = DVec3::new(alpha * v.x, alpha * v.y, v.z).normalize();
    let height = (1.0 - w) * (1.0 + v.z);
    let z = height - v.z;
    let cap = at_azimuth(u, (1.0 - z * z).max(0.0).sqrt(), z);
    let h = DVec3::new(alpha * (cap.x + v.x), alpha * (cap.y + v.y), height);
    h.try_normalize().unwrap_or(DVec3::Z)
}

/// Beckmann normals as v, above the horizon, sees them: density
/// [`visible_density`]. `alpha` in (0, 1].
pub fn visible_beckmann([u, w]: [f64; 2], v: DVec3, alpha: f64) -> DVec3 {
    // Stretched to α = 1, the slopes across v are Gaussian, and so are those along v, except for
    // the weight max(0, v·h).
    let v = DVec3::new(alpha * v.x, alpha * v.y, v.z).normalize();
    let sine = v.truncate().length();
    let along = if sine > 0.0 { v.truncate() / sine } else { glam::DVec2::X };
    let slope = -gaussian_slope(u, v.z, sine) * along + gaussian_slope(w, 1.0, 0.0) * along.perp();
    (alpha * slope).extend(1.0).normalize()
}

/// Density per unit solid angle of the normals h that v sees:
/// `<v·h> D / (n·v (1 + Λ(v)))`, from the values of D at h and of Λ at v.
/// v above the horizon.
pub fn visible_density(v: DVec3, h: DVec3, distribution: f64, lambda: f64) -> f64 {
    v.dot(h).max(0.0) * distribution / (v.z * (1.0 + lambda))
}

/// A Lambertian lobe: density `(n·l) / π`.
pub fn cosine([u, w]: [f64; 2]) -> DVec3 {
    at_azimuth(u, w.sqrt(), (1.0 - w).sqrt())
}

/// The lobe of light that leaves a Lambertian interior through a Fresnel
/// interface: density `21/(20π) (1 - (1 - n·l)^5) (n·l)`, independent of the
/// index of refraction (Hammon, "PBR Diffuse Lighting for GGX+Smith
/// Microsurfaces", 2017, appendix "Transmission Direction").
pub fn transmitted([u, w]: [f64; 2]) -> DVec3 {
    // Below, the cumulative distribution is 7/2 c³ to first order; elsewhere
    // Hammon's rational guess is near.
    let mut c = if w < 0.01 {
        (w / 3.5).cbrt()
    } else {
        let numerator = 0.011_481_3 + w * (154.4 + w * (13_002.4 + w * 38_295.9));
        numerator / (1.0 + w * (1_483.57 + w * (33_596.4 + w * 16_520.2)))
    };
    for _ in 0..8 {
        let polynomial = 3.5 - c * (5.25 - c * (4.2 - c * (1.75 - c * 0.3)));
        let slope = 2.1 * schlick_transmission(c) * c;
        if slope <= 0.0 {
            break;
        }
        let step = (c * c * c * polynomial - w) / slope;
        c = (c - step).clamp(0.0, 1.0);
        if step.abs() < 1e-9 {
            break;
        }
    }
    at_azimuth(u, (1.0 - c * c).sqrt(), c)
}

/// Returns the slope x whose cumulative density is `u`, for the density `max(0, cosine - sine x)
/// exp(-x²)`, not normalised.
fn gaussian_slope(u: f64, cosine: f64, sine: f64) -> f64 {
    // exp(-x²) is below f64's rounding from here on.
    const FURTHEST: f64 = 6.5;
    let cumulative = |x: f64| 0.5 * (cosine * libm::erfc(-x) + sine * (-x * x).exp() / PI.sqrt());
    let end = if cosine < FURTHEST * sine { cosine / sine } else { FURTHEST };
    let (mut low, mut high) = (-FURTHEST, end);
    let wanted = u * cumulative(end);
    let mut x = 0.5 * (low + high);
    // Newton's method, kept inside the bracket that it narrows.
    for _ in 0..100 {
        let excess = cumulative(x) - wanted;
        if excess > 0.0 {
            high = x
        } else {
            low = x
        }
        let next = x - excess * PI.sqrt() / ((cosine - sine * x) * (-x * x).exp());
        let next = if next > low && next < high { next } else { 0.5 * (low + high) };
        if (next - x).abs() < 1e-13 || high - low < 1e-13 {
            break;
        }
        x = next;
    }
    x
}

fn slope_at(u: f64, tangent: f64) -> DVec3 {
    let cosine = 1.0 / (1.0 + tangent * tangent).sqrt();
    at_azimuth(u, tangent * cosine, cosine)
}

fn at_azimuth(u: f64, sine: f64, cosine: f64) -> DVec3 {
    let (sin_phi, cos_phi) = (TAU * u).sin_cos();
    DVec3::new(sine * cos_phi, sine * sin_phi, cosine)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn transmitted_inverts_its_cumulative_distribution() {
        for i in 0..1000 {
            let w = (f64::from(i) / 1000.0).powi(4);
            let c = transmitted([0.0, w]).z;
            let exact = |c: f64| {
                3.5 * c.powi(3) - 5.25 * c.powi(4) + 4.2 * c.powi(5) - 1.75 * c.powi(6)
                    + 0.3 * c.powi(7)
            };
            assert!((exact(c) - w).abs() < 1e-12, "{w}: {c}");
        }
    }

    #[test]
    fn gaussian_slopes_stay_on_the_visible_side() {
        for (cosine, sine) in [(1.0, 0.0), (0.6, 0.8), (1e-4, 1.0)] {
            let mut before = f64::NEG_INFINITY;
            for i in 1..1000 {
                let x = gaussian_slope(f64::from(i) / 1000.0, cosine, sine);
                assert!(x > before && cosine - sine * x > 0.0, "{cosine} {i}: {x}");
                before = x;
            }
        }
    }

    #[test]
    fn narrow_lobes_and_ends_of_the_range_give_unit_vectors() {
        let last = 1.0 - f64::EPSILON / 2.0;
        for u in [0.0, 0.5, last] {
            for w in [0.0, 0.5, last] {
                for alpha in [1e-6, 0.1, 1.0] {
                    let v = DVec3::new(1.0, 0.0, 1e-5).normalize();
                    let below = DVec3::new(0.6, 0.0, -0.8);
                    let directions = [
                        ggx([u, w], alpha),
                        beckmann([u, w], alpha),
                        blinn_phong([u, w], 1e6),
                        visible_ggx([u, w], v, alpha),
                        visible_ggx([u, w], below, alpha),
                        visible_beckmann([u, w], v, alpha),
                        visible_beckmann([u, w], DVec3::Z, alpha),
                        cosine([u, w]),
                        transmitted([u, w]),
                    ];
                    for (index, h) in directions.into_iter().enumerate() {
                        assert!((h.length() - 1.0).abs() < 1e-9, "{index}: {u} {w} {alpha} {h}");
                        assert!(h.z >= 0.0, "{index}: {h}");
                    }
                }
            }
        }
    }
}
