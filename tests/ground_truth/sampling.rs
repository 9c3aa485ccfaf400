//! Where a search split samples its domain.

use lgp::dataset::{Dataset, Split};
use lgp::targets::{Recipe, generate};

fn zonal_harmonics(sampling: &str, seed: &str) -> Dataset {
    let mut recipe = Recipe::new("disney_zh").unwrap();
    for (parameter, value) in [("points", "24"), ("sampling", sampling), ("sampling_seed", seed)] {
        recipe.set(parameter, value).unwrap();
    }
    assert_eq!(Recipe::parse(&recipe.to_string()).unwrap(), recipe);
    generate(&recipe, &|_, _| {}).unwrap()
}

/// The weighted mean square of what 1.1 - n_dot_v is from zh0.
fn error(split: &Split) -> f64 {
    let square =
        |row: usize| f64::from(1.1 - split.columns[0][row] - split.columns[2][row]).powi(2);
    let weighted = |row: usize| f64::from(split.weight(row)) * square(row);
    let weights: f64 = (0..split.rows()).map(|row| f64::from(split.weight(row))).sum();
    (0..split.rows()).map(weighted).sum::<f64>() / weights
}

#[test]
fn every_sampling_measures_the_same_error() {
    let regular = zonal_harmonics("regular", "0");
    assert_eq!(regular.search.grid, [24, 24]);
    assert!(!regular.origin.source().contains("sampling"), "{}", regular.origin);
    for sampling in ["jittered", "low_discrepancy", "adaptive"] {
        let made = zonal_harmonics(sampling, "3");
        assert_eq!(made.search.rows(), 576, "{sampling}");
        assert!(made.search.grid.is_empty());
        assert_eq!(made.validation, regular.validation);
        assert_eq!(made.search.weights.is_empty(), sampling != "adaptive");
        for input in [0, 1] {
            let inside = |value: &f32| (0.0..=1.0).contains(value);
            assert!(made.search.columns[input].iter().all(inside), "{sampling}");
        }
        let ratio = error(&made.search) / error(&regular.validation);
        assert!((ratio - 1.0).abs() < 0.02, "{sampling}: {ratio}");
    }
    assert_eq!(zonal_harmonics("jittered", "3"), zonal_harmonics("jittered", "3"));
    assert_ne!(
        zonal_harmonics("jittered", "3").search.columns,
        zonal_harmonics("jittered", "4").search.columns
    );
}
