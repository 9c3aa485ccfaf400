//! The average albedo of GGX facets.

use crate::reference;
use lgp::quadrature::{Rule, TanhSinh};
use lgp::targets::average_albedo::{ALLOWED_ERROR, integrate};
use lgp::targets::dfg::{self, Masking};

const MASKINGS: [Masking; 2] = [Masking::Correlated, Masking::Separable];

#[test]
fn it_agrees_with_integrals_over_both_directions() {
    let rule = TanhSinh::new();
    let rows = reference("average_albedo.csv");
    assert!(!rows.is_empty());
    for row in rows {
        for (masking, expected) in MASKINGS.into_iter().zip(&row[1..]) {
            let [average, error] = integrate(&rule, row[0] * row[0], masking);
            let difference = (average - expected).abs();
            assert!(difference < 1e-9, "{masking:?} {row:?}: {average}, {difference:e}");
            assert!(error <= ALLOWED_ERROR, "{masking:?} {row:?}: {error:e}");
        }
    }
}

/// The same by facets' normals, not by angles of light.
#[test]
fn it_is_the_average_of_the_directional_albedo() {
    let rule = TanhSinh::new();
    let over_cosines = Rule::gauss_legendre(24);
    for alpha in [0.09, 0.36, 1.0] {
        for masking in MASKINGS {
            let weighted = |[cosine]: [f64; 1]| {
                let dfg = dfg::integrate_within(&rule, 1e-7, cosine, alpha, masking);
                2.0 * cosine * (dfg.scale + dfg.bias)
            };
            let expected = over_cosines.integrate([0.0], [1.0], weighted).value;
            let [average, _] = integrate(&rule, alpha, masking);
            assert!((average - expected).abs() < 2e-8, "{alpha} {masking:?}: {average} {expected}");
        }
    }
}

#[test]
fn it_tends_to_one_for_narrow_lobes() {
    let rule = TanhSinh::new();
    for masking in MASKINGS {
        assert_eq!(integrate(&rule, 0.0, masking), [1.0, 0.0]);
        let mut missing_before = 0.0;
        for alpha in [1e-9, 1e-6, 1e-4, 1e-3] {
            let [average, error] = integrate(&rule, alpha, masking);
            assert!(error <= ALLOWED_ERROR, "{masking:?} {alpha}: {error:e}");
            let missing = 1.0 - average;
            assert!(missing >= missing_before - 1e-8, "{masking:?} {alpha}: {missing:e}");
            missing_before = missing;
        }
        assert!((1e-7..1e-4).contains(&missing_before), "{masking:?}: {missing_before:e}");
    }
}
