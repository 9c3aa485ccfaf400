//! Changes of variable, from the unit interval or square to other domains.
//!
//! `∫ f(x) dx = ∫ f(x(u)) |dx/du| du`. The maps are smooth, as rules need; the second of two
//! coordinates is the azimuth. [`over`] turns an integrand on a domain into one on the unit square,
//! for any rule.

use glam::{DVec2, DVec3};
use std::f64::consts::PI;

/// The image of a point of the unit interval or square.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mapped<X> {
    /// The point of the domain.
    pub point: X,
    /// Length, area or solid angle there over that of the unit square here.
    pub jacobian: f64,
}

/// Returns the integrand on the unit interval or square whose integral is that of `f` over the
/// map's domain.
pub fn over<U, X>(map: impl Fn(U) -> Mapped<X>, f: impl Fn(X) -> f64) -> impl Fn(U) -> f64 {
    move |u| {
        let Mapped { point, jacobian } = map(u);
        jacobian * f(point)
    }
}

/// The unit disc, in polar coordinates: dx dy = r dr dφ.
pub fn disc([radius, turn]: [f64; 2]) -> Mapped<DVec2> {
    let (sin, cos) = (2.0 * PI * turn).sin_cos();
    Mapped { point: radius * DVec2::new(cos, sin), jacobian: 2.0 * PI * radius }
}

/// Directions of the sphere: dω = dz dφ (Archimedes).
pub fn sphere([u, turn]: [f64; 2]) -> Mapped<DVec3> {
    Mapped { point: direction(2.0 * u, turn), jacobian: 4.0 * PI }
}

/// Directions with z ≥ 0.
pub fn hemisphere([u, turn]: [f64; 2]) -> Mapped<DVec3> {
    Mapped { point: direction(u, turn), jacobian: 2.0 * PI }
}

/// Directions within an angle of the z axis, in [0, π]; accurate for the narrowest.
pub fn cone(half_angle: f64) -> impl Fn([f64; 2]) -> Mapped<DVec3> {
    // 1 - cos, without cancellation.
    let height = 2.0 * (0.5 * half_angle).sin().powi(2);
    move |[u, turn]| Mapped { point: direction(u * height, turn), jacobian: 2.0 * PI * height }
}

/// The direction `depth` = 1 - z below the pole.
fn direction(depth: f64, turn: f64) -> DVec3 {
    let sine = (depth * (2.0 - depth)).sqrt();
    let (sin, cos) = (2.0 * PI * turn).sin_cos();
    DVec3::new(sine * cos, sine * sin, 1.0 - depth)
}

/// [0, ∞) by x = u / (1 - u): for integrands that fall at least like x⁻².
/// Take a rule without the end u = 1.
pub fn half_line([u]: [f64; 1]) -> Mapped<f64> {
    let rest = 1.0 - u;
    Mapped { point: u / rest, jacobian: 1.0 / (rest * rest) }
}

/// (-∞, ∞) by x = t / (1 - t²), t = 2u - 1. Take a rule without the ends.
pub fn line([u]: [f64; 1]) -> Mapped<f64> {
    let t = 2.0 * u - 1.0;
    // (1 - t)(1 + t) = 4u(1 - u)
    let rest = 4.0 * u * (1.0 - u);
    Mapped { point: t / rest, jacobian: 2.0 * (1.0 + t * t) / (rest * rest) }
}

#[cfg(test)]
mod tests {
    use super::super::{Adaptive, Rule};
    use super::*;

    fn integral<X>(map: impl Fn([f64; 2]) -> Mapped<X>, f: impl Fn(X) -> f64) -> f64 {
        Rule::gauss_legendre(40).integrate([0.0; 2], [1.0; 2], over(map, f)).value
    }

    #[test]
    fn areas_and_solid_angles() {
        assert!((integral(disc, |_| 1.0) - PI).abs() < 1e-13);
        assert!((integral(sphere, |_| 1.0) - 4.0 * PI).abs() < 1e-12);
        assert!((integral(hemisphere, |_| 1.0) - 2.0 * PI).abs() < 1e-12);
        for angle in [1e-9_f64, 0.1, 1.0, PI] {
            let expected = 4.0 * PI * (0.5 * angle).sin().powi(2);
            assert!((integral(cone(angle), |_| 1.0) / expected - 1.0).abs() < 1e-13);
        }
    }

    #[test]
    fn moments() {
        // ∫ x² over the disc is π/4, over the sphere 4π/3; ∫ cos θ over a cone π sin².
        assert!((integral(disc, |p| p.x * p.x) - PI / 4.0).abs() < 1e-12);
        for second in [|w: DVec3| w.x * w.x, |w: DVec3| w.y * w.y, |w: DVec3| w.z * w.z] {
            assert!((integral(sphere, second) - 4.0 * PI / 3.0).abs() < 1e-11);
            assert!((integral(hemisphere, second) - 2.0 * PI / 3.0).abs() < 1e-11);
        }
        let expected = PI * 0.3_f64.sin().powi(2);
        assert!((integral(cone(0.3), |w| w.z) - expected).abs() < 1e-13);
    }

    #[test]
    fn points_lie_in_their_domain() {
        for u in [[0.0, 0.0], [0.3, 0.9], [1.0, 0.5]] {
            assert!(disc(u).point.length() <= 1.0 + 1e-15);
            for w in [sphere(u).point, hemisphere(u).point, cone(1e-8)(u).point] {
                assert!((w.length() - 1.0).abs() < 1e-15, "{w}");
            }
            assert!(hemisphere(u).point.z >= 0.0);
            let narrow = cone(1e-8)(u).point;
            assert!(narrow.truncate().length() <= 1e-8 * (1.0 + 1e-12), "{narrow}");
        }
    }

    #[test]
    fn infinite_ranges() {
        let rule = Rule::gauss_kronrod(10);
        let adaptive = Adaptive::new(&rule, 1e-10);
        let cauchy = adaptive.global([0.0], [1.0], over(half_line, |x: f64| 1.0 / (1.0 + x * x)));
        assert!((cauchy.value - 0.5 * PI).abs() < 1e-10);
        let gauss = adaptive.global([0.0], [1.0], over(line, |x: f64| (-x * x).exp()));
        assert!((gauss.value - PI.sqrt()).abs() < 1e-10);
        let even = adaptive.global([0.0], [1.0], over(line, |x: f64| 1.0 / (1.0 + x * x)));
        assert!((even.value - PI).abs() < 1e-10);
    }
}
