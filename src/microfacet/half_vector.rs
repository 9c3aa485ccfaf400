//! Half-vectors of reflection and refraction: the normals of the microfacets that
//! send light from one direction to another.
//!
//! Sources: Walter, Marschner, Li, Torrance, "Microfacet Models for Refraction
//! through Rough Surfaces", 2007 (§4 and eqs. 13–17, 40); Hammon, "PBR Diffuse
//! Lighting for GGX+Smith Microsurfaces", 2017 (the identities without h).

use super::{Real, sine_squared};
use glam::DVec3;

/// n·h without h: `(n·l + n·v) / |l + v|`. `l_dot_v` in (-1, 1].
pub fn n_dot_h<T: Real>(n_dot_l: T, n_dot_v: T, l_dot_v: T) -> T {
    (n_dot_l + n_dot_v) / (T::TWO + T::TWO * l_dot_v).sqrt()
}

/// l·h = v·h without h: `|l + v| / 2`. `l_dot_v` in [-1, 1].
pub fn l_dot_h<T: Real>(l_dot_v: T) -> T {
    (T::HALF + T::HALF * l_dot_v).max(T::ZERO).sqrt()
}

/// The direction halfway between two that are not opposite.
pub fn of_reflection(l: DVec3, v: DVec3) -> DVec3 {
    (l + v).normalize()
}

/// The normal, on the side of v, of the interface that refracts v to l on its
/// other side; `eta` ≠ 1 is the index of refraction at l over that at v.
pub fn of_refraction(l: DVec3, v: DVec3, eta: f64) -> DVec3 {
    let h = (v + eta * l).normalize();
    if h.dot(v) < 0.0 { -h } else { h }
}

/// v mirrored about h.
pub fn reflect(v: DVec3, h: DVec3) -> DVec3 {
    2.0 * v.dot(h) * h - v
}

/// v bent at an interface with normal h, v·h ≥ 0; `eta` > 0 is the index of
/// refraction behind it over that in front. `None` under total reflection.
pub fn refract(v: DVec3, h: DVec3, eta: f64) -> Option<DVec3> {
    let cosine = v.dot(h);
    let transmitted_squared = 1.0 - sine_squared(cosine) / (eta * eta);
    (transmitted_squared > 0.0).then(|| (cosine / eta - transmitted_squared.sqrt()) * h - v / eta)
}

/// Solid angle of half-vectors per solid angle of reflected directions:
/// `1 / (4 v·h)`.
pub fn reflection_jacobian<T: Real>(v_dot_h: T) -> T {
    T::ONE / (T::of(4.0) * v_dot_h.abs())
}

/// Solid angle of half-vectors per solid angle of refracted directions l:
/// `η² |l·h| / (v·h + η l·h)²`, with the signs of v·h and l·h opposite.
pub fn refraction_jacobian<T: Real>(v_dot_h: T, l_dot_h: T, eta: T) -> T {
    eta * eta * l_dot_h.abs() / (v_dot_h + eta * l_dot_h).squared()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn direction(theta: f64, phi: f64) -> DVec3 {
        DVec3::new(theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos())
    }

    #[test]
    fn identities_need_no_half_vector() {
        for (l, v) in [((0.3, 0.1), (1.2, 2.0)), ((1.5, 0.0), (1.5, 3.0)), ((0.7, 1.0), (0.7, 1.0))]
        {
            let (l, v) = (direction(l.0, l.1), direction(v.0, v.1));
            let h = of_reflection(l, v);
            assert!((n_dot_h(l.z, v.z, l.dot(v)) - h.z).abs() < 1e-13);
            assert!((l_dot_h(l.dot(v)) - l.dot(h)).abs() < 1e-13);
            assert!((reflect(v, h) - l).length() < 1e-14);
        }
    }

    #[test]
    fn refraction_follows_snell_and_its_half_vector() {
        for eta in [1.5, 1.0 / 1.5, 1.001, 2.42] {
            for theta in [0.0, 0.2, 0.6] {
                let (v, h) = (direction(0.4, 2.0), direction(theta, 0.5));
                let l = refract(v, h, eta).unwrap();
                assert!((l.length() - 1.0).abs() < 1e-14);
                assert!((v.cross(h).length() - eta * l.cross(h).length()).abs() < 1e-14);
                assert!((of_refraction(l, v, eta) - h).length() < 1e-11 / (eta - 1.0).abs());
            }
        }
        assert_eq!(refract(direction(1.2, 0.0), DVec3::Z, 1.0 / 1.5), None);
    }

    /// Area that a map of directions makes of a small square of half-vectors.
    fn stretched(h: DVec3, map: impl Fn(DVec3) -> DVec3) -> f64 {
        let step = 1e-4;
        let (a, b) = h.any_orthonormal_pair();
        let along = |t: DVec3| {
            (map((h + step * t).normalize()) - map((h - step * t).normalize())) / (2.0 * step)
        };
        along(a).cross(along(b)).length()
    }

    #[test]
    fn jacobians_are_ratios_of_areas() {
        let (v, h) = (direction(0.8, 0.3), direction(0.3, 1.0));
        let found = stretched(h, |h| reflect(v, h));
        assert!((found * reflection_jacobian(v.dot(h)) - 1.0).abs() < 1e-7, "{found}");
        for eta in [1.5, 0.8] {
            let l = refract(v, h, eta).unwrap();
            let found = stretched(h, |h| refract(v, h, eta).unwrap());
            let jacobian = refraction_jacobian(v.dot(h), l.dot(h), eta);
            assert!((found * jacobian - 1.0).abs() < 1e-7, "{eta}: {found}");
        }
    }
}
