//! The directional albedo of the Charlie sheen.

use crate::reference;
use lgp::quadrature::TanhSinh;
use lgp::targets::sheen_albedo::{ALLOWED_ERROR, Masking, integrate};
use lgp::targets::{Recipe, truth};

const MASKINGS: [Masking; 3] = [Masking::Neubelt, Masking::Charlie, Masking::Softened];

#[test]
fn it_agrees_with_integrals_over_the_directions_of_light() {
    let rule = TanhSinh::new();
    let rows = reference("sheen_albedo.csv");
    assert_eq!(rows.len(), 49);
    for row in rows {
        for (masking, expected) in MASKINGS.into_iter().zip(&row[2..]) {
            let albedo = integrate(&rule, row[0] * row[0], row[1], masking);
            let error = (albedo.value - expected).abs();
            assert!(error < 2e-9, "{masking:?} {row:?}: {albedo:?}, {error:e}");
            assert!(albedo.error <= ALLOWED_ERROR, "{masking:?} {row:?}: {albedo:?}");
        }
    }
}

/// Seen along the normal, with Neubelt's denominator, the cosine of h is √((1 + n·l)/2), and
/// `(2 + 1/α) ∫ (1 - c²)^(1/2α) (2 c² - 1) c dc` from √½ to 1 is elementary.
#[test]
fn it_is_elementary_along_the_normal() {
    let rule = TanhSinh::new();
    for alpha in [0.01_f64, 0.0625, 0.25, 0.7, 1.0] {
        let albedo = integrate(&rule, alpha, 1.0, Masking::Neubelt);
        // With s = 1 - c²: half of ∫ s^p (1 - 2 s) ds from 0 to ½, p = 1/2α.
        let p = 0.5 / alpha;
        let integral = 0.5_f64.powf(p + 2.0) * (1.0 / (p + 1.0) - 1.0 / (p + 2.0));
        let expected = (2.0 + 1.0 / alpha) * integral;
        assert!((albedo.value - expected).abs() < 1e-10, "{alpha}: {albedo:?}, {expected}");
    }
}

#[test]
fn narrow_bands_are_resolved() {
    let rule = TanhSinh::new();
    for masking in MASKINGS {
        for alpha in [1e-8, 1e-6, 1e-4, 1e-2] {
            for n_dot_v in [0.001, 0.005, 0.05, 0.3, 0.9] {
                let albedo = integrate(&rule, alpha, n_dot_v, masking);
                assert!(albedo.error <= ALLOWED_ERROR, "{masking:?} {alpha} {n_dot_v}: {albedo:?}");
                assert!(albedo.value >= 0.0);
            }
        }
        assert_eq!(integrate(&rule, 0.0, 0.5, masking).value, 0.0);
        assert!(integrate(&rule, 1e-6, 0.05, masking).value < 1e-12);
    }
}

#[test]
fn albedos_above_one_are_cut_or_kept() {
    let at = |text: &str, point: [f64; 2]| {
        truth(&Recipe::parse(text).unwrap()).unwrap().at(&point).unwrap()[0]
    };
    let (cut, kept) =
        ("(target: \"sheen_albedo\")", "(target: \"sheen_albedo\", above_one: \"kept\")");
    assert_eq!(at(cut, [0.1, 0.05]), 1.0);
    assert!((at(kept, [0.1, 0.05]) - 1.741_163_852_5).abs() < 1e-8);
    assert_eq!(at(cut, [0.5, 0.5]), at(kept, [0.5, 0.5]));
}
