//! Scenes over the committed datasets: what they leave, and what they refuse.

use lgp::cost::{CostScratch, Profile};
use lgp::dataset::{Dataset, Incumbent, Split, load_incumbents};
use lgp::eval::{Evaluator, Score, Tape};
use lgp::fit::{Fitter, Measure, Stop};
use lgp::program::parse;
use lgp::quadrature::TanhSinh;
use lgp::scene::Scene;
use lgp::targets::dfg::{Masking, integrate};
use std::path::{Path, PathBuf};

fn committed(file: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("datasets").join(file)
}

fn dfg() -> Dataset {
    Dataset::load(&committed("dfg.bin")).unwrap()
}

fn applied(text: &str, dataset: &Dataset) -> Dataset {
    Scene::parse("s", text).unwrap().over(dataset).unwrap().dataset().unwrap()
}

/// The published formula for non-metals has the errors and the cost of `tests/reference/README.md`.
#[test]
fn dielectrics_have_one_output_and_their_own_incumbent() {
    let whole = dfg();
    let scene = Scene::find("dielectric", &committed("dfg.bin")).unwrap();
    let data = scene.over(&whole).unwrap().dataset().unwrap();
    assert_eq!(data.names().outputs, ["specular"]);
    assert_eq!(data.search.grid, whole.search.grid);
    for (split, all) in [(&data.search, &whole.search), (&data.validation, &whole.validation)] {
        for row in 0..all.rows() {
            let specular = 0.04 * all.columns[2][row] + all.columns[3][row];
            assert!((split.columns[2][row] - specular).abs() < 1e-6);
        }
    }
    assert!(
        data.origin
            .to_string()
            .ends_with("// scene dielectric: f0 = 0.04; specular = f0*scale + bias")
    );
    assert_ne!(data.hash(), whole.hash());
    // Neither of the outputs that the claim is over is left.
    assert_eq!((whole.claims.len(), data.claims.len()), (1, 0));

    let own = load_incumbents(&committed("incumbents/dfg_dielectric.ron")).unwrap();
    let known = own[0].compared_on(&data).unwrap();
    let score = Score::of(&known.program, &data, &mut Evaluator::default()).search[0];
    assert_eq!(
        (format!("{:.4}", score.rmse), format!("{:.3}", score.max)),
        ("0.0232".into(), "0.084".into())
    );
    let gcn = Profile::find("gcn").unwrap();
    assert_eq!(gcn.cycles(&known.program, &mut CostScratch::default()), 10.0);
}

#[test]
fn ranges_leave_a_smaller_grid() {
    let whole = dfg();
    let data = applied("(ranges: {\"roughness\": (0.3, 0.9)})", &whole);
    // Of 64 cell centres those from 19.5/64 to 57.5/64.
    assert_eq!(data.search.grid, [64, 39]);
    assert_eq!(data.inputs[1].domain, [0.3, 0.9]);
    assert_eq!(data.claims, whole.claims);
    assert_eq!(data.inputs[0].domain, whole.inputs[0].domain);
    for split in [&data.search, &data.validation] {
        assert!(split.columns[1].iter().all(|r| (0.3..=0.9).contains(r)));
    }
    let row = |split: &Split, row: usize| split.columns.iter().map(|c| c[row]).collect::<Vec<_>>();
    assert_eq!(row(&data.search, 39), row(&whole.search, 64 + 19));
}

/// Between the table's planes, against the integral itself.
#[test]
fn a_fixed_input_is_interpolated() {
    let data = applied("(fixed: {\"roughness\": 0.4})", &dfg());
    assert_eq!(data.names().inputs, ["n_dot_v"]);
    assert_eq!(data.search.grid, [64]);
    let rule = TanhSinh::new();
    for row in [0, 7, 30, 63] {
        let n_dot_v = f64::from(data.search.columns[0][row]);
        let exact = integrate(&rule, n_dot_v, 0.16, Masking::Correlated);
        for (column, exact) in [(1, exact.scale), (2, exact.bias)] {
            let found = f64::from(data.search.columns[column][row]);
            assert!((found - exact).abs() < 1e-4, "{n_dot_v}: {found} for {exact}");
        }
    }
}

#[test]
fn histograms_weigh_and_drop_rows() {
    let whole = dfg();
    let data = applied(
        "(histograms: [(inputs: [\"n_dot_v\"], counts: [0, 1, 3, 0]), (inputs: [\"roughness\"], over: [(0.5, 1)], counts: [2, 1])])",
        &whole,
    );
    let joint = applied(
        "(histograms: [(inputs: [\"roughness\", \"n_dot_v\"], over: [(0.5, 1), (0, 1)], bins: [2, 4], counts: [0, 2, 6, 0, 0, 1, 3, 0])])",
        &whole,
    );
    assert_eq!(data.search, joint.search);
    assert_eq!(data.search.grid, [32, 32]);
    assert_eq!(data.inputs[1].domain, [0.5, 1.0]);
    let mean = data.search.weights.iter().map(|w| f64::from(*w)).sum::<f64>() / 1024.0;
    assert!((mean - 1.0).abs() < 1e-6);
    // A corner of the least and one of the greatest counts: 1·1 and 3·2.
    let at = |n_dot_v: f32, roughness: f32| {
        let near = |row: &usize| {
            (data.search.columns[0][*row] - n_dot_v).abs() < 0.008
                && (data.search.columns[1][*row] - roughness).abs() < 0.008
        };
        data.search.weights[(0..1024).find(near).unwrap()]
    };
    assert!((at(0.6, 0.6) / at(0.4, 0.9) - 6.0).abs() < 1e-4);
    // The validation split's own weights count, too.
    assert!(data.validation.weights.iter().any(|w| *w != data.validation.weights[0]));
}

#[test]
fn formulas_follow_the_scene() {
    let whole = dfg();
    let text = "(fixed: {\"roughness\": 0.5, \"f0\": 0.04}, outputs: {\"specular\": \"f0*scale + bias\", \"sum\": \"scale + bias\"})";
    let scene = Scene::parse("s", text).unwrap();
    let view = scene.over(&whole).unwrap();
    let names = whole.names();
    let formula = "t = roughness*n_dot_v; scale = 1 - t; bias = t*t + roughness";
    let program = parse(formula, &names).unwrap();
    let defined = names.outputs.clone();
    let wanted = ["specular", "sum"].map(String::from);
    let taken = view.program(&program, &defined, &wanted).unwrap();
    assert_eq!(taken.inputs, 1);
    for n_dot_v in [0.1f32, 0.7] {
        let t = 0.5 * n_dot_v;
        let (scale, bias) = (1.0 - t, t * t + 0.5);
        let found = taken.evaluate(&[n_dot_v]);
        assert!((found[0] - (0.04 * scale + bias)).abs() < 1e-6);
        assert!((found[1] - (scale + bias)).abs() < 1e-6);
    }
    let alone =
        parse("bias = n_dot_v", &lgp::program::Names::new(["n_dot_v", "roughness"], ["bias"]));
    assert_eq!(view.program(&alone.unwrap(), &["bias".into()], &wanted), None);
}

/// Errors of less than half a step are no errors: a constant that is off by less is not seen, and of a
/// larger error only the rest counts.
#[test]
fn quantisation_hides_errors() {
    let whole = dfg();
    let data = applied("(outputs: {\"flat\": \"0*scale + 0.5\"}, quantisation: (bits: 8))", &whole);
    let half = 0.5 / 255.0;
    let names = data.names();
    let mut evaluator = Evaluator::default();
    for (text, visible) in [("flat = 0.5015", 0.0), ("flat = 0.496", 0.004 - half)] {
        let program = parse(text, &names).unwrap();
        let error = Score::of(&program, &data, &mut evaluator).search[0];
        assert!((error.visible.unwrap() - visible).abs() < 1e-7, "{text}: {error:?}");
        // What a search and its fits see.
        let samples = Measure::Visible.all_samples(&data.search, 2, &[1.0]);
        let seen = evaluator.loss(&Tape::new(&program), &samples, f64::INFINITY).total();
        let mean = seen / samples.total_weight();
        assert!((mean.sqrt() - visible).abs() < 1e-6, "{text}: {mean}");
        let plain = Measure::Rmse.all_samples(&data.search, 2, &[1.0]);
        let loss = evaluator.loss(&Tape::new(&program), &plain, f64::INFINITY).total();
        assert!((loss / plain.total_weight()).sqrt() > 0.0014);
        // A fit moves the constant no further than where its error is hidden.
        let mut draft = program.into_draft();
        let stop = Stop { max_steps: 50, min_gain: 1e-9 };
        let fitted = Fitter::default().fit(&mut draft, &samples, stop);
        assert!(fitted / samples.total_weight() < 1e-12, "{fitted}");
        assert!((f64::from(draft.consts[0]) - 0.5).abs() > 0.001, "{}", draft.consts[0]);
    }
    assert_eq!(Measure::usual(&data.search), Measure::Visible);
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("flat.bin");
    data.save(&file).unwrap();
    assert_eq!(Dataset::load(&file).unwrap(), data);
    let chosen = data.select(Some(&["roughness".into()]), None).unwrap();
    assert_eq!(chosen.search.dead_zone, data.search.dead_zone);
}

#[test]
fn scenes_survive_being_written() {
    let text = "(description: \"d\", ranges: {\"b\": (0, 1), \"a\": (0.5, 2)}, fixed: {\"f0\": 0.04}, histograms: [(inputs: [\"a\"], counts: [1, 2])], outputs: {\"y\": \"a\"}, quantisation: (bits: 10, tone_map: \"y/(1 + y)\"), tiers: {\"low\": (max_cost: 4)})";
    let scene = Scene::parse("s", text).unwrap();
    assert_eq!(scene.ranges[0].0, "b");
    let again = Scene::parse("other", &ron::to_string(&scene).unwrap()).unwrap();
    assert_eq!(again, scene);
    let file = Scene::parse("other", &scene.to_ron()).unwrap();
    assert_eq!(file, Scene { description: String::new(), ..scene });
}

/// What is wrong with a scene for `dfg.bin`, and what the refusal says.
const REFUSED: [(&str, &str); 33] = [
    ("ranges: {\"roughness\": (0.9, 0.3)}", "range of `roughness`, (0.9, 0.3), is empty"),
    ("ranges: {\"roughness\": (0.5, 0.5)}", "a single value under `fixed`"),
    ("ranges: {\"roughness\": (NaN, 0.5)}", "ranges: NaN of `roughness`"),
    ("ranges: {\"roughness\": (0.5, 1.5)}", "reaches beyond dfg, whose domain is [0, 1]"),
    ("ranges: {\"roughness\": (2, 3)}", "reaches beyond dfg"),
    ("ranges: {\"roughness\": (0.5, 0.501)}", "no row of the search split of dfg lies within"),
    ("ranges: {\"rougness\": (0, 1)}", "no input of dfg; did you mean `roughness`?"),
    ("ranges: {\"scale\": (0, 1)}", "`scale`, which is no input of dfg"),
    ("ranges: {\"roughness\": (0, 1), \"roughness\": (0, 0.5)}", "`roughness` occurs twice"),
    ("fixed: {\"roughness\": 1.5}", "`roughness` is fixed at 1.5, outside the domain of dfg"),
    ("fixed: {\"f0\": 0.04}", "`f0`, which is no input of dfg, nor used in `outputs`"),
    ("fixed: {\"rougness\": 0.5}", "did you mean `roughness`?"),
    ("fixed: {\"roughness\": 0.5, \"n_dot_v\": 0.5}", "all inputs of dfg are fixed"),
    (
        "fixed: {\"roughness\": 0.5}, ranges: {\"roughness\": (0, 1)}",
        "stands in `fixed` and in `ranges`",
    ),
    (
        "fixed: {\"roughness\": 0.5}, histograms: [(inputs: [\"roughness\"], counts: [1])]",
        "stands in `fixed` and in a histogram",
    ),
    (
        "histograms: [(inputs: [\"roughness\"], counts: [0, 0])]",
        "histogram of roughness: all counts are zero",
    ),
    ("histograms: [(inputs: [\"roughness\"], counts: [])]", "0 counts"),
    ("histograms: [(inputs: [\"roughness\"], counts: [1, -1])]", "a count is -1"),
    ("histograms: [(inputs: [], counts: [1])]", "it has no inputs"),
    ("histograms: [(inputs: [\"alpha\"], counts: [1])]", "`alpha`, which is no input of dfg"),
    (
        "histograms: [(inputs: [\"roughness\", \"n_dot_v\"], bins: [2, 2], counts: [1, 2, 3])]",
        "3 counts, but bins along its inputs are [2, 2]",
    ),
    (
        "histograms: [(inputs: [\"roughness\"], over: [(0, 2)], counts: [1])]",
        "the histogram of `roughness`, (0, 2), reaches beyond dfg",
    ),
    (
        "histograms: [(inputs: [\"roughness\"], counts: [1]), (inputs: [\"roughness\"], counts: [1])]",
        "stands in a histogram and in another",
    ),
    (
        "outputs: {\"specular\": \"f0*scale + bias\"}",
        "output `specular`: formula, line 1, column 9: unknown name `f0`",
    ),
    ("outputs: {\"specular\": \"scale + bais\"}", "did you mean `bias`?"),
    ("outputs: {\"roughness\": \"scale\"}", "`roughness` has the name of an input"),
    (
        "outputs: {\"y\": \"log2(bias - 2)\"}",
        "output `y` is NaN on row 1 of the search split of dfg",
    ),
    ("quantisation: (bits: 0)", "quantisation: 0 bits; give 1 to 16"),
    ("quantisation: (bits: 8, tone_map: \"x/2\")", "quantisation: tone_map, over `y`"),
    ("quantisation: (bits: 8, tone_map: \"sqrt(y - 2)\")", "the tone map has no slope at"),
    ("fixed: {\"roughness\": NaN}", "fixed: NaN of `roughness` is no finite 32-bit float"),
    (
        "ranges: {\"roughness\": (0, 1e300)}",
        "ranges: 1e300 of `roughness` is no finite 32-bit float",
    ),
    ("tiers: {\"low\": ()}", "tier `low` needs a max_cost, a max_error or both"),
];

#[test]
fn scenes_that_cannot_be_meant_are_refused() {
    let whole = dfg();
    for (text, expected) in REFUSED {
        let scene = Scene::parse("s", &format!("({text})"));
        let refused = scene.and_then(|scene| scene.over(&whole)?.dataset().map(drop));
        let message = refused.expect_err(text).to_string();
        assert!(message.contains(expected), "{text}: {message}");
    }
    let syntax = Scene::parse("s.ron", "(\nrangs: {})").unwrap_err().to_string();
    assert!(syntax.contains("s.ron, line 2"), "{syntax}");
    let unknown = Scene::find("dielectrc", &committed("dfg.bin")).unwrap_err().to_string();
    assert!(unknown.contains("did you mean `dielectric`?"), "{unknown}");
}

/// Every scene beside the committed datasets can be used on one, and its incumbents are comparable.
#[test]
fn committed_scenes_are_usable() {
    for entry in std::fs::read_dir(committed("scenes")).unwrap() {
        let path = entry.unwrap().path();
        let scene = Scene::find(path.to_str().unwrap(), &committed("dfg.bin")).unwrap();
        let whole = dfg();
        let data = scene.over(&whole).unwrap().dataset().unwrap();
        let own = committed("incumbents").join(&data.name).with_extension("ron");
        let known: Vec<Incumbent> =
            if own.is_file() { load_incumbents(&own).unwrap() } else { vec![] };
        assert!(known.iter().all(|known| known.compared_on(&data).is_some()), "{path:?}");
    }
}

/// What outputs are combined to errs as they do, independently.
#[test]
fn standard_errors_are_combined() {
    let mut whole = dfg();
    for split in [&mut whole.search, &mut whole.validation] {
        split.standard_errors = vec![vec![0.02; split.rows()], vec![0.03; split.rows()]];
    }
    let text = "(ranges: {\"roughness\": (0.5, 1)}, outputs: {\"y\": \"2*scale - bias\", \"bias\": \"bias\"})";
    let scene = Scene::parse("s", text).unwrap();
    let dataset = scene.over(&whole).unwrap().dataset().unwrap();
    let [both, alone] = &dataset.search.standard_errors[..] else { panic!("one for each output") };
    assert_eq!(both.len(), dataset.search.rows());
    assert!(both.iter().all(|error| (error - 0.05).abs() < 1e-6), "{:?}", &both[..3]);
    assert!(alone.iter().all(|error| (error - 0.03).abs() < 1e-6), "{:?}", &alone[..3]);
}
