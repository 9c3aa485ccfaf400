//! Ground truths against reference values that were computed by other programs
//! (`tests/reference/README.md`), and committed datasets against their recipes.

use lgp::dataset::Dataset;
use lgp::quadrature::TanhSinh;
use lgp::targets::dfg::{self, Masking};
use lgp::targets::{Error, Recipe, generate};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

const ACCURACY: f64 = 1e-6;

fn reference(name: &str) -> Vec<Vec<f64>> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/reference").join(name);
    let text = std::fs::read_to_string(path).unwrap();
    let rows = text.lines().skip(1);
    rows.map(|row| row.split(',').map(|cell| cell.parse().unwrap()).collect()).collect()
}

fn committed(file: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("datasets").join(file)
}

/// Largest absolute difference between a search split and a table whose rows
/// are in the same order.
fn largest_difference(dataset: &Dataset, table: &[Vec<f64>]) -> f64 {
    assert_eq!(dataset.search.rows(), table.len());
    let mut largest = 0.0_f64;
    for (row, expected) in table.iter().enumerate() {
        let found: Vec<f64> =
            dataset.search.columns.iter().map(|column| f64::from(column[row])).collect();
        assert!((found[0] - expected[0]).abs() < 1e-9 && (found[1] - expected[1]).abs() < 1e-9);
        for output in [2, 3] {
            largest = largest.max((found[output] - expected[output]).abs());
        }
    }
    largest
}

#[test]
fn committed_dfg_agrees_with_the_reference() {
    for (file, table) in [("dfg.bin", "dfg_a_corr_r2.csv"), ("dfg_paper.bin", "dfg_p_sep_r4.csv")] {
        let dataset = Dataset::load(&committed(file)).unwrap();
        let largest = largest_difference(&dataset, &reference(table));
        println!("{file}: largest difference {largest:e}");
        assert!(largest <= ACCURACY, "{file}: {largest:e}");
    }
}

#[test]
fn dfg_agrees_with_the_reference_up_to_the_edges() {
    let rule = TanhSinh::new();
    let mut largest = [0.0_f64; 2];
    let mut claimed = 0.0_f64;
    for row in reference("dfg_nodes33.csv") {
        let (n_dot_v, alpha) = (row[0], row[1] * row[1]);
        for (index, masking) in [Masking::Correlated, Masking::Separable].into_iter().enumerate() {
            let dfg = dfg::integrate(&rule, n_dot_v, alpha, masking);
            let [scale, bias] = [row[2 + 2 * index], row[3 + 2 * index]];
            let error = (dfg.scale - scale).abs().max((dfg.bias - bias).abs());
            assert!(error <= ACCURACY, "{masking:?} at {n_dot_v}, {alpha}: {dfg:?}, {error:e}");
            largest[index] = largest[index].max(error);
            claimed = claimed.max(dfg.error);
        }
    }
    println!("correlated {:e}, separable {:e}, claimed {claimed:e}", largest[0], largest[1]);
    assert!(claimed <= dfg::ALLOWED_ERROR);
}

#[test]
fn dfg_tends_to_its_limit_for_narrow_lobes() {
    let rule = TanhSinh::new();
    for masking in [Masking::Correlated, Masking::Separable] {
        for n_dot_v in [0.001, 0.0078125, 0.25, 0.75, 1.0] {
            let limit = dfg::integrate(&rule, n_dot_v, 0.0, masking);
            assert!((limit.bias - (1.0 - n_dot_v).powi(5)).abs() < 1e-15);
            assert!((limit.scale + limit.bias - 1.0).abs() < 1e-15);
            let mut before = f64::INFINITY;
            for alpha in [1e-4, 1e-6, 3.7e-9, 1e-12] {
                let dfg = dfg::integrate(&rule, n_dot_v, alpha, masking);
                let error = (dfg.scale - limit.scale).abs().max((dfg.bias - limit.bias).abs());
                assert!(error <= before.max(1e-9), "{masking:?} {n_dot_v} {alpha}: {dfg:?}");
                assert!(dfg.error <= dfg::ALLOWED_ERROR, "{masking:?} {n_dot_v} {alpha}: {dfg:?}");
                before = error;
            }
            assert!(before < 1e-9, "{masking:?} {n_dot_v}: {before:e}");
        }
    }
}

/// Equal but for the last bits: the sine and exponential of the system may
/// differ from those of the machine that made the files.
fn assert_near(found: f32, expected: f32, place: &str) {
    let allowed = 2.0 * f32::EPSILON * expected.abs();
    assert!((found - expected).abs() <= allowed, "{place}: {found} and {expected}");
}

#[test]
fn committed_datasets_are_what_their_recipes_define() {
    let rule = TanhSinh::new();
    for (name, masking, power) in
        [("dfg", Masking::Correlated, 2), ("dfg_paper", Masking::Separable, 4)]
    {
        let recipe = Recipe::load(&committed(&format!("{name}.ron"))).unwrap();
        let made = Dataset::load(&committed(&format!("{name}.bin"))).unwrap();
        assert_eq!(made.name, name);
        assert_eq!(Recipe::parse(&made.recipe).unwrap(), recipe, "{name}");
        for split in [&made.search, &made.validation] {
            for row in (0..split.rows()).step_by(17) {
                let [n_dot_v, roughness] = [0, 1].map(|input| f64::from(split.columns[input][row]));
                let dfg = dfg::integrate(&rule, n_dot_v, roughness.powi(power), masking);
                assert_near(dfg.scale as f32, split.columns[2][row], name);
                assert_near(dfg.bias as f32, split.columns[3][row], name);
            }
        }
    }
}

#[test]
fn committed_datasets_are_generated_again() {
    for name in ["dfg", "dfg_paper"] {
        let recipe = Recipe::load(&committed(&format!("{name}.ron"))).unwrap();
        let made = Dataset::load(&committed(&format!("{name}.bin"))).unwrap();
        let done = AtomicUsize::new(0);
        let again = generate(&recipe, &|_, total| {
            assert!(done.fetch_add(1, Ordering::Relaxed) < total);
        });
        let again = again.unwrap();
        assert_eq!(done.into_inner(), 64 + 101);
        assert_eq!((&again.inputs, &again.recipe), (&made.inputs, &made.recipe), "{name}");
        for (again, made) in [(&again.search, &made.search), (&again.validation, &made.validation)]
        {
            assert_eq!((&again.grid, &again.weights), (&made.grid, &made.weights), "{name}");
            let pairs = again.columns.iter().flatten().zip(made.columns.iter().flatten());
            pairs.for_each(|(&again, &made)| assert_near(again, made, name));
        }
    }
}

#[test]
fn committed_datasets_have_their_checksums() {
    let text = std::fs::read_to_string(committed("checksums.txt")).unwrap();
    let mut listed = Vec::new();
    for line in text.lines() {
        let (expected, file) = line.split_once("  ").unwrap();
        let bytes = std::fs::read(committed(file)).unwrap();
        assert_eq!(blake3::hash(&bytes).to_hex().as_str(), expected, "{file}");
        listed.push(file.to_owned());
    }
    let mut files: Vec<String> = std::fs::read_dir(committed(""))
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .filter(|file| file.ends_with(".bin"))
        .collect();
    files.sort();
    assert_eq!(listed, files);
}

#[test]
fn dfg_splits_are_as_documented() {
    let dataset = Dataset::load(&committed("dfg.bin")).unwrap();
    let [search, validation] = [&dataset.search, &dataset.validation];
    assert_eq!((&search.grid[..], &validation.grid[..]), (&[64, 64][..], &[101, 101][..]));
    assert!(search.weights.is_empty());
    assert!(search.columns[1].iter().all(|r| !validation.columns[1].contains(r)));
    let [n_dot_v, roughness] = [&validation.columns[0], &validation.columns[1]];
    assert_eq!([n_dot_v[0], n_dot_v[101], n_dot_v[10_200]], [0.001, 0.01, 1.0]);
    assert_eq!([roughness[0], roughness[1], roughness[100]], [0.0, 0.01, 1.0]);
    let [edge, inside] = [validation.weight(50), validation.weight(50 * 101 + 50)];
    assert!((edge / inside - 0.45).abs() < 1e-5, "{edge} {inside}");
    let names: Vec<&str> =
        dataset.inputs.iter().chain(&dataset.outputs).map(|column| &column.name[..]).collect();
    assert_eq!(names, ["n_dot_v", "roughness", "scale", "bias"]);
    assert!(dataset.inputs.iter().all(|column| column.domain == [0.0, 1.0]));
}

#[test]
fn recipes_read_back_and_explain_themselves() {
    let recipe = Recipe::parse(
        "// the paper's\n(target: \"dfg\", masking: \"separable\", alpha: \"roughness^4\", points: 32)",
    )
    .unwrap();
    assert_eq!(recipe.get("masking"), Some("separable"));
    assert_eq!(recipe.get("points"), Some("32"));
    assert_eq!(Recipe::parse(&recipe.to_string()).unwrap(), recipe);
    let defaults = Recipe::parse("(target: \"dfg\")").unwrap();
    assert_eq!(defaults, Recipe::new("dfg").unwrap());

    let mut recipe = defaults;
    recipe.set("masking", "separable").unwrap();
    let refusals = [
        (recipe.set("masking", "seperable"), "did you mean `separable`?"),
        (recipe.set("masking", "none"), "write `correlated` or `separable`"),
        (recipe.set("point", "3"), "did you mean `points`?"),
        (recipe.set("points", "1"), "a whole number from 2 to 1024"),
        (recipe.set("points", "many"), "a whole number from 2 to 1024"),
    ];
    for (refusal, expected) in refusals {
        let error = refusal.unwrap_err().to_string();
        assert!(error.contains(expected), "{error}");
    }
    assert_eq!(recipe.get("masking"), Some("separable"));
}

#[test]
fn unusable_recipes_are_refused() {
    let cases = [
        ("", "line 1"),
        ("(target: \"dfg\",\n masking: )", "line 2"),
        ("12", "not a list of fields"),
        ("(points: 3)", "names no target; begin it with"),
        ("(target: 3)", "names no target"),
        ("(target: \"dgf\")", "did you mean `dfg`?"),
        ("(target: \"dfg\", points: 2.5)", "`2.5` is no value of parameter `points`"),
        ("(target: \"dfg\", points: [2])", "is no value of parameter `points`"),
        ("(target: \"dfg\", colour: 1)", "its parameters are masking, alpha, points"),
    ];
    for (text, expected) in cases {
        let error = Recipe::parse(text).unwrap_err().to_string();
        assert!(error.contains(expected), "{text:?}: {error}");
    }
    let missing = Recipe::load(Path::new("no_such_recipe.ron")).unwrap_err();
    assert!(matches!(missing, Error::Read { .. }), "{missing}");
}
