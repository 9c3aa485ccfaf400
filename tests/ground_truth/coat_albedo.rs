//! The directional albedo of a clear coat.

use crate::reference;
use lgp::microfacet::fresnel;
use lgp::quadrature::TanhSinh;
use lgp::targets::coat_albedo::{ALLOWED_ERROR, integrate};
use lgp::targets::dfg::{self, Masking};

#[test]
fn it_agrees_with_integrals_over_the_directions_of_light() {
    let rule = TanhSinh::new();
    let rows = reference("coat_albedo.csv");
    assert_eq!(rows.len(), 36);
    for row in rows {
        let [albedo, error] = integrate(&rule, row[0] * row[0], row[1]);
        assert!((albedo - row[2]).abs() < 3e-9, "{row:?}: {albedo}");
        assert!(error <= ALLOWED_ERROR, "{row:?}: {error:e}");
    }
}

/// Exact and approximate reflectance differ by .036 at most.
#[test]
fn it_is_near_that_of_schlicks_reflectance() {
    let rule = TanhSinh::new();
    for alpha in [0.0, 0.01, 0.3, 1.0] {
        for n_dot_v in [0.01, 0.2, 0.7, 1.0] {
            let [albedo, _] = integrate(&rule, alpha, n_dot_v);
            let dfg = dfg::integrate(&rule, n_dot_v, alpha, Masking::Correlated);
            let schlick = 0.04 * dfg.scale + dfg.bias;
            assert!((albedo - schlick).abs() < 0.036, "{alpha} {n_dot_v}: {albedo} {schlick}");
        }
    }
}

#[test]
fn it_tends_to_the_reflectance_of_a_smooth_coat() {
    let rule = TanhSinh::new();
    for n_dot_v in [0.05, 0.3, 1.0] {
        let [albedo, _] = integrate(&rule, 1e-6, n_dot_v);
        let smooth = fresnel::dielectric(1.5, n_dot_v);
        assert!((albedo - smooth).abs() < 1e-8, "{n_dot_v}: {albedo} {smooth}");
        assert_eq!(integrate(&rule, 0.0, n_dot_v), [smooth, 0.0]);
    }
}
