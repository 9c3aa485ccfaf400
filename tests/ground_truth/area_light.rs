//! The lobe integrated over a spherical light.

use glam::DVec3;
use lgp::microfacet::ggx::distribution;
use lgp::quadrature::{Rule, TanhSinh, change};
use lgp::targets::area_light::{ALLOWED_ERROR, integrate};
use std::f64::consts::{FRAC_PI_2, PI};

/// The definition, direction by direction: the mean over the cone about the light.
fn by_directions(omega: f64, alpha: f64, theta: f64) -> f64 {
    let (sin, cos) = theta.sin_cos();
    let lobe = |local: DVec3| {
        // From the light's axis to the reflected direction's.
        let cosine = cos * local.z - sin * local.x;
        if cosine <= 0.0 {
            return 0.0;
        }
        let n_dot_h = (0.5 * (1.0 + cosine)).sqrt();
        PI * alpha * alpha * distribution(n_dot_h, alpha) * cosine
    };
    let solid_angle = 4.0 * PI * (0.25 * omega).sin().powi(2);
    let rule = Rule::gauss_legendre(300);
    let cone = change::over(change::cone(0.5 * omega), lobe);
    rule.integrate([0.0; 2], [1.0; 2], cone).value / solid_angle
}

#[test]
fn is_the_mean_over_the_light() {
    let rule = TanhSinh::new();
    let mut largest = 0.0_f64;
    for omega in [0.01, 0.3, 1.0] {
        for alpha in [0.05, 0.3, 1.0] {
            for theta in [0.0, 0.02, 0.15, 0.3, 0.5, 1.0, 1.5, FRAC_PI_2] {
                let found = integrate(&rule, omega, alpha, theta);
                let expected = by_directions(omega, alpha, theta);
                let error = (found.value - expected).abs();
                // The horizon is an edge for the other rule.
                let allowed = if theta + 0.5 * omega > FRAC_PI_2 { 1e-5 } else { 1e-9 };
                assert!(error <= allowed, "{omega} {alpha} {theta}: {found:?} {expected}");
                assert!(found.error <= ALLOWED_ERROR);
                if allowed == 1e-9 {
                    largest = largest.max(error);
                }
            }
        }
    }
    println!("largest difference {largest:e}");
}

#[test]
fn tends_to_the_point_light() {
    let rule = TanhSinh::new();
    for alpha in [1e-3, 0.1, 1.0] {
        for theta in [0.0, 1e-3, 0.2, 1.2] {
            let point = integrate(&rule, 0.0, alpha, theta).value;
            for omega in [1e-6, 1e-9, 1e-12] {
                let small = integrate(&rule, omega, alpha, theta);
                let allowed = 1e-9 + 10.0 * omega / alpha;
                assert!(
                    (small.value - point).abs() < allowed,
                    "{omega} {alpha} {theta}: {small:?}"
                );
            }
        }
    }
}

/// A lobe much narrower than the light lies in it or not: ∫ D(ψ/2) dΩ = 4.
#[test]
fn a_narrow_lobe_is_inside_or_outside() {
    let rule = TanhSinh::new();
    let (omega, alpha) = (0.5, 1e-7);
    let solid_angle = 4.0 * PI * (0.25_f64 * omega).sin().powi(2);
    let inside = 4.0 * PI * alpha * alpha / solid_angle;
    for theta in [0.0, 0.1, 0.249] {
        let found = integrate(&rule, omega, alpha, theta).value;
        assert!((found / inside - 1.0).abs() < 1e-3, "{theta}: {found:e} {inside:e}");
    }
    let edge = integrate(&rule, omega, alpha, 0.25).value;
    assert!((edge / inside - 0.5).abs() < 1e-3, "{edge:e}");
    assert!(integrate(&rule, omega, alpha, 0.3).value < 1e-6 * inside);
}

#[test]
fn is_finite_and_no_more_than_the_peak() {
    let rule = TanhSinh::new();
    for omega in [0.0, 1e-9, 0.01, 1.0, 3.0] {
        for alpha in [1e-9, 1e-6, 0.01, 1.0] {
            for theta in [0.0, 1e-9, 0.005, 0.5, 1.5, FRAC_PI_2] {
                let found = integrate(&rule, omega, alpha, theta);
                assert!((0.0..=1.0 + 1e-9).contains(&found.value), "{omega} {alpha} {theta}");
                assert!(found.error <= ALLOWED_ERROR, "{omega} {alpha} {theta}: {found:?}");
            }
        }
    }
}
