//! Ground truths that have a closed form: masking, Fresnel, a stiff distribution;
//! what was published for them, with the errors of `tests/reference/README.md`.

use lgp::cost::{CostScratch, Profile};
use lgp::dataset::{Dataset, ParsedIncumbent, incumbents_for};
use lgp::microfacet::{beckmann, fresnel, ggx, masking};
use lgp::targets::{Recipe, generate};
use std::path::{Path, PathBuf};

const NAMES: [&str; 5] = ["smith_g1", "smith_g2", "beckmann_g1", "fresnel", "ggx_d"];

fn committed(file: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("datasets").join(file)
}

fn load(name: &str) -> Dataset {
    Dataset::load(&committed(&format!("{name}.bin"))).unwrap()
}

fn incumbents(name: &str) -> Vec<ParsedIncumbent> {
    incumbents_for(&committed(&format!("{name}.bin")), &load(name)).unwrap()
}

#[test]
fn committed_datasets_are_made_again() {
    for name in NAMES {
        let recipe = Recipe::load(&committed(&format!("{name}.ron"))).unwrap();
        let (made, again) = (load(name), generate(&recipe, &|_, _| {}).unwrap());
        assert_eq!((&again.inputs, &again.origin), (&made.inputs, &made.origin), "{name}");
        for (again, made) in [(&again.search, &made.search), (&again.validation, &made.validation)]
        {
            assert_eq!((&again.grid, &again.weights), (&made.grid, &made.weights), "{name}");
            let pairs = again.columns.iter().flatten().zip(made.columns.iter().flatten());
            for (again, made) in pairs {
                // The system's exponential may differ in the last bit.
                assert!((again - made).abs() <= 2.0 * f32::EPSILON * made.abs(), "{name}");
            }
        }
    }
}

#[test]
fn splits_are_moderate_denser_and_disjoint() {
    for name in NAMES {
        let data = load(name);
        assert!(data.search.rows() <= 4096 && data.search.rows() < data.validation.rows());
        let inputs = data.inputs.len();
        let row = |split: &lgp::dataset::Split, row: usize| -> Vec<u32> {
            split.columns[..inputs].iter().map(|column| column[row].to_bits()).collect()
        };
        let searched: std::collections::HashSet<Vec<u32>> =
            (0..data.search.rows()).map(|i| row(&data.search, i)).collect();
        assert!((0..data.validation.rows()).all(|i| !searched.contains(&row(&data.validation, i))));
        for (index, column) in data.inputs.iter().enumerate() {
            let values = &data.validation.columns[index];
            let [low, high] = column.domain.map(|end| end as f32);
            let least = values.iter().copied().fold(f32::INFINITY, f32::min);
            assert!(least - low <= 0.001 && values.contains(&high), "{name}: {}", column.name);
        }
    }
}

/// RMSE and largest absolute error of a formula on the search split.
fn errors(known: &ParsedIncumbent, data: &Dataset) -> [f64; 2] {
    let (inputs, columns) = (data.inputs.len(), &data.search.columns);
    let (mut squares, mut largest) = (0.0, 0.0_f64);
    for row in 0..data.search.rows() {
        let sample: Vec<f32> = columns.iter().map(|column| column[row]).collect();
        let found = known.program.evaluate(&sample[..inputs])[0];
        let error = f64::from(found) - f64::from(sample[inputs]);
        squares += error * error;
        largest = largest.max(error.abs());
    }
    [(squares / data.search.rows() as f64).sqrt(), largest]
}

#[test]
fn incumbents_cost_what_was_counted() {
    let profile = Profile::find("gcn").unwrap();
    for name in NAMES {
        for known in incumbents(name) {
            let cycles = profile.cycles(&known.program, &mut CostScratch::default());
            assert_eq!(Some(cycles), known.incumbent.cost, "{name}: {}", known.incumbent.name);
        }
    }
}

/// Mean square's root and largest of `error` at `points` cell centres along each
/// of `N` axes of [0, 1].
fn over_cells<const N: usize>(points: usize, error: impl Fn([f64; N]) -> f64) -> [f64; 2] {
    let (mut squares, mut largest) = (0.0, 0.0_f64);
    let cells = points.pow(N as u32);
    for cell in 0..cells {
        let coordinate = |axis| cell / points.pow(axis as u32) % points;
        let error =
            error(std::array::from_fn(|axis| (coordinate(axis) as f64 + 0.5) / points as f64));
        squares += error * error;
        largest = largest.max(error.abs());
    }
    [(squares / cells as f64).sqrt(), largest]
}

#[test]
fn schlick_masking_is_as_far_off_as_known() {
    let [rmse, largest] =
        over_cells(512, |[c, alpha]| masking::g1_schlick(c, alpha) - ggx::g1(c, alpha));
    assert!((rmse - 0.0461).abs() < 1e-4, "{rmse}");
    // .1624 is the supremum, at the horizon's edge of the domain.
    assert!((0.1610..0.1624).contains(&largest), "{largest}");
    let data = load("smith_g1");
    let [rmse, _] = errors(&incumbents("smith_g1")[0], &data);
    assert!((rmse - 0.0461).abs() < 1e-4, "{rmse}");
}

#[test]
fn hammons_masking_is_as_far_off_as_known_and_always_low() {
    let error = |[v, l, alpha]: [f64; 3]| {
        let error = masking::g2_hammon(v, l, alpha) - ggx::g2_correlated(v, l, alpha);
        assert!(error <= 0.0, "{v} {l} {alpha}");
        error
    };
    let [rmse, largest] = over_cells(64, error);
    assert!((rmse - 0.0651).abs() < 1e-4, "{rmse}");
    assert!((largest - 0.223).abs() < 1e-3, "{largest}");
    let [rmse, _] = errors(&incumbents("smith_g2")[0], &load("smith_g2"));
    assert!((rmse - 0.0658).abs() < 1e-4, "on 16 points an axis: {rmse}");
}

#[test]
fn walters_rational_masking_is_as_far_off_as_known() {
    let error = |a: f64| {
        // A direction of that slope at α = 1.
        let cosine = a / (1.0 + a * a).sqrt();
        (beckmann::g1_rational(cosine, 1.0) - beckmann::g1(cosine, 1.0)).abs()
    };
    let slopes = (1..16_000).map(|i| f64::from(i) * 1e-4);
    let worst = slopes.max_by(|a, b| error(*a).total_cmp(&error(*b))).unwrap();
    assert!((worst - 1.338).abs() < 1e-3, "{worst}");
    assert!((error(worst) - 0.00311).abs() < 5e-6, "{}", error(worst));
    let [_, largest] = errors(&incumbents("beckmann_g1")[0], &load("beckmann_g1"));
    assert!((largest - 0.00311).abs() < 5e-6, "{largest}");
}

#[test]
fn schlicks_fresnel_is_as_far_off_as_known() {
    for (eta, expected_largest, expected_rmse) in
        [(1.33, 0.060, 0.025), (1.5, 0.0357, 0.0163), (2.42, 0.0757, 0.0304)]
    {
        let f0 = fresnel::f0_of_eta(eta);
        let error = |[c]: [f64; 1]| fresnel::schlick(f0, c) - fresnel::dielectric(eta, c);
        let [rmse, largest] = over_cells(4096, error);
        assert!((rmse - expected_rmse).abs() < 6e-4, "{eta}: RMSE {rmse}");
        assert!((largest - expected_largest).abs() < 6e-4, "{eta}: {largest}");
    }
    let data = load("fresnel");
    for known in incumbents("fresnel") {
        let [rmse, largest] = errors(&known, &data);
        assert!((0.021..0.022).contains(&rmse) && largest < 0.082, "{}", known.incumbent.name);
    }
}

#[test]
fn only_the_factored_distribution_survives_single_precision() {
    let data = load("ggx_d");
    let known = incumbents("ggx_d");
    let errors: Vec<[f64; 2]> = known.iter().map(|known| errors(known, &data)).collect();
    let names: Vec<&str> = known.iter().map(|known| known.incumbent.name.as_str()).collect();
    assert_eq!(names, ["textbook", "filament", "factored"]);
    assert!(errors[0][1] > 0.01, "{errors:?}");
    assert!(errors[2][1] < 1e-6, "{errors:?}");
}
