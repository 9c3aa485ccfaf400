//! The highlight of a spherical light, seen from any side.

use crate::reference;
use lgp::microfacet::ggx;
use lgp::quadrature::TanhSinh;
use lgp::targets::sphere_light::{ALLOWED_ERROR, Place};

#[test]
fn it_agrees_with_integrals_over_the_directions_of_the_light() {
    let rule = TanhSinh::new();
    for row in reference("sphere_light.csv") {
        let &[omega, roughness, n_dot_v, offset, azimuth, lobe] = &row[..] else {
            panic!("{row:?}")
        };
        let alpha = roughness * roughness;
        let found = Place { omega, alpha, n_dot_v, offset, azimuth }.integrate(&rule);
        assert!((found.value - lobe).abs() < 1e-5 * (1.0 + lobe), "{row:?}: {found:?}");
        assert!(found.error <= ALLOWED_ERROR, "{row:?}: {found:?}");
    }
}

#[test]
fn a_small_light_is_a_point() {
    let rule = TanhSinh::new();
    for (alpha, n_dot_v) in [(0.05_f64, 0.3_f64), (0.4, 0.9)] {
        let (offset, sine) = (0.1_f64, (1.0 - n_dot_v * n_dot_v).sqrt());
        // Towards n: v, n and l in one plane.
        let n_dot_l = offset.cos() * n_dot_v + offset.sin() * sine;
        let n_dot_h = (0.5 * offset).cos();
        let d_over_peak = ggx::distribution(n_dot_h, alpha) / ggx::distribution(1.0, alpha);
        let expected = d_over_peak * ggx::g2_correlated(n_dot_v, n_dot_l, alpha);
        let found = Place { omega: 1e-4, alpha, n_dot_v, offset, azimuth: 0.0 }.integrate(&rule);
        assert!((found.value / expected - 1.0).abs() < 1e-5, "{found:?} {expected}");
    }
}
