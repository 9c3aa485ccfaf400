//! The average reflectance of dielectrics.

use crate::reference;
use lgp::microfacet::fresnel;
use lgp::quadrature::TanhSinh;
use lgp::targets::average_fresnel::{ALLOWED_ERROR, integrate};

#[test]
fn it_agrees_with_the_closed_form_and_with_integrals_from_within() {
    let rule = TanhSinh::new();
    let rows = reference("average_fresnel.csv");
    assert_eq!(rows.len(), 10);
    for row in rows {
        let average = integrate(&rule, row[0]);
        let errors = [average.outer - row[1], average.inner - row[2]];
        assert!(errors.iter().all(|error| error.abs() < 1e-13), "{row:?}: {average:?}");
        assert!(average.error <= ALLOWED_ERROR, "{row:?}: {average:?}");
    }
    let nothing = integrate(&rule, 1.0);
    assert!(nothing.outer.abs().max(nothing.inner.abs()) < 1e-15, "{nothing:?}");
}

#[test]
fn what_is_totally_reflected_counts() {
    let rule = TanhSinh::new();
    for eta in [1.05_f64, 1.5, 2.5] {
        let critical = (1.0 - 1.0 / (eta * eta)).sqrt();
        let within = |mu: f64| 2.0 * mu * fresnel::dielectric(1.0 / eta, mu);
        let partial = rule.integrate(critical, 1.0, 1e-12, |mu| within(mu.x)).value;
        let expected = critical * critical + partial;
        assert!((integrate(&rule, eta).inner - expected).abs() < 1e-9, "{eta}: {expected}");
    }
}
