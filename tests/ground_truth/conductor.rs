//! The index of refraction of metals.

use crate::reference;
use lgp::quadrature::TanhSinh;
use lgp::targets::conductor::{ALLOWED_ERROR, Index, METALS};
use lgp::targets::{Recipe, truth};

#[test]
fn the_integrals_agree_with_the_faddeeva_function() {
    let rule = TanhSinh::new();
    let rows = reference("conductor.csv");
    for row in &rows {
        for (metal, expected) in METALS.iter().zip(row[1..].chunks(2)) {
            let Index { n, k, error } = metal.index(&rule, row[0]);
            let errors = [n - expected[0], k - expected[1]];
            let place = (metal.name, row[0], n, k);
            assert!(errors.iter().all(|error| error.abs() < 3e-9), "{place:?}: {errors:?}");
            assert!(error <= ALLOWED_ERROR, "{place:?}: {error}");
        }
    }
    assert_eq!((rows.len(), rows[0].len()), (11, 1 + 2 * METALS.len()));
}

#[test]
fn a_recipe_names_the_metal_and_gold_reflects_red() {
    let at = |recipe: &str, wavelength: f64| {
        let truth = truth(&Recipe::parse(recipe).unwrap()).unwrap();
        truth.at(&[wavelength]).unwrap()
    };
    for metal in &METALS {
        let recipe = format!("(target: \"conductor\", metal: \"{}\")", metal.name);
        let Index { n, k, .. } = metal.index(&TanhSinh::new(), 0.55);
        assert_eq!(at(&recipe, 0.55), [n, k], "{}", metal.name);
    }
    let reflectance =
        |wavelength| at("(target: \"conductor\", of: \"reflectance\")", wavelength)[0];
    assert!((reflectance(0.65) - 0.944).abs() < 1e-3 && (reflectance(0.45) - 0.374).abs() < 1e-3);
}
