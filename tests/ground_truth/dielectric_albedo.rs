//! The directional albedo of rough dielectrics.

use crate::reference;
use lgp::microfacet::fresnel;
use lgp::quadrature::TanhSinh;
use lgp::targets::dielectric_albedo::{ALLOWED_ERROR, integrate};

#[test]
fn it_agrees_with_integrals_over_the_directions_of_light() {
    let rule = TanhSinh::new();
    for row in reference("dielectric_albedo.csv") {
        let &[f0, roughness, n_dot_v, reflected, transmitted] = &row[..] else { panic!("{row:?}") };
        let eta = fresnel::eta_of_f0(f0);
        let albedo = integrate(&rule, eta, roughness * roughness, n_dot_v);
        let errors = [albedo.reflected - reflected, albedo.transmitted - transmitted];
        assert!(errors.iter().all(|error| error.abs() < 1e-8), "{row:?}: {albedo:?}");
        assert!(albedo.error <= ALLOWED_ERROR, "{row:?}: {albedo:?}");
    }
}

#[test]
fn it_tends_to_its_limit_for_smooth_surfaces() {
    let rule = TanhSinh::new();
    for n_dot_v in [0.05, 0.3, 0.8, 1.0] {
        let limit = integrate(&rule, 1.5, 0.0, n_dot_v);
        assert_eq!(limit.reflected + limit.transmitted, 1.0);
        let narrow = integrate(&rule, 1.5, 1e-6, n_dot_v);
        assert!((narrow.reflected - limit.reflected).abs() < 1e-8, "{narrow:?}, {limit:?}");
        assert!((narrow.transmitted - limit.transmitted).abs() < 1e-8, "{narrow:?}, {limit:?}");
    }
}
