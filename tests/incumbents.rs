//! Published formulas against the figures of `tests/reference/README.md`.

use lgp::dataset::{Dataset, Error, Incumbent, incumbents_for, load_incumbents};
use lgp::quadrature::TanhSinh;
use lgp::targets::dfg::{Masking, integrate};
use std::path::{Path, PathBuf};

fn committed(file: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("datasets").join(file)
}

/// RMSE and largest absolute error of `scale` and `bias` on the search split.
fn errors(incumbent: &Incumbent, dataset: &Dataset) -> [f64; 4] {
    let comparable = incumbent.compared_on(dataset).unwrap();
    assert_eq!(comparable.outputs, ["scale", "bias"]);
    let columns = &dataset.search.columns;
    let mut squares = [0.0; 2];
    let mut largest = [0.0_f64; 2];
    for row in 0..dataset.search.rows() {
        let sample: Vec<f32> = columns.iter().map(|column| column[row]).collect();
        let values = comparable.program.evaluate(&sample[..2]);
        for output in [0, 1] {
            let error = f64::from(values[output]) - f64::from(sample[2 + output]);
            squares[output] += error * error;
            largest[output] = largest[output].max(error.abs());
        }
    }
    let [scale, bias] = squares.map(|sum: f64| (sum / dataset.search.rows() as f64).sqrt());
    [scale, largest[0], bias, largest[1]]
}

/// Name, and the errors printed for the convention that each formula was made for and for
/// today's; `None` where the page prints none, or where the convention's data are not ours.
type Printed = (&'static str, Option<[&'static str; 4]>, Option<[&'static str; 4]>);

const PRINTED: [Printed; 10] = [
    ("blender_workbench", None, Some([".240", ".684", ".051", ".298"])),
    ("lazarov_2013", None, Some([".139", ".490", ".053", ".484"])),
    // The page cuts off the last, .08485, to .084.
    ("karis_2014", None, Some([".128", ".462", ".021", ".085"])),
    (
        "pesce_iwanicki_2015",
        Some([".047", ".136", ".034", ".141"]),
        Some([".110", ".423", ".065", ".346"]),
    ),
    ("narkowicz_2014_exp", Some([".039", ".162", ".017", ".078"]), None),
    ("narkowicz_2014_poly", Some([".018", ".091", ".017", ".088"]), None),
    (
        "narkowicz_2014_poly_r2",
        Some([".019", ".091", ".018", ".088"]),
        Some([".041", ".311", ".022", ".111"]),
    ),
    ("rtg_ch32", None, Some([".0254", ".114", ".0079", ".068"])),
    ("ue5_ggx_energy", None, Some([".0131", ".056", ".0054", ".087"])),
    ("materialx_rational", None, Some([".0131", ".114", ".0034", ".050"])),
];

fn assert_printed(name: &str, found: [f64; 4], printed: [&str; 4]) {
    for (found, printed) in found.into_iter().zip(printed) {
        let digits = printed.len() - 1;
        let rounded = format!("{found:.digits$}");
        assert_eq!(rounded.trim_start_matches('0'), printed, "{name}: {found}");
    }
}

/// `dfg.bin` with separable masking in place of the correlated one.
fn separable(today: &Dataset) -> Dataset {
    let rule = TanhSinh::new();
    let mut dataset = today.clone();
    let columns = &mut dataset.search.columns;
    for row in 0..columns[0].len() {
        let [n_dot_v, roughness] = [0, 1].map(|input| f64::from(columns[input][row]));
        let dfg = integrate(&rule, n_dot_v, roughness * roughness, Masking::Separable);
        columns[2][row] = dfg.scale as f32;
        columns[3][row] = dfg.bias as f32;
    }
    dataset
}

#[test]
fn errors_are_those_of_the_reference_page() {
    let incumbents = load_incumbents(&committed("incumbents/dfg.ron")).unwrap();
    let today = Dataset::load(&committed("dfg.bin")).unwrap();
    let paper = Dataset::load(&committed("dfg_paper.bin")).unwrap();
    let separable = separable(&today);
    assert_eq!(incumbents.len(), PRINTED.len());
    for (incumbent, (name, own, against_today)) in incumbents.iter().zip(PRINTED) {
        assert_eq!(incumbent.name, name);
        let convention = if name.ends_with("_r2") { &separable } else { &paper };
        if let Some(printed) = own {
            assert_printed(name, errors(incumbent, convention), printed);
        }
        if let Some(printed) = against_today {
            assert_printed(name, errors(incumbent, &today), printed);
        }
    }
}

/// RMSE and largest error over the rows of a reference table whose columns are those of a dataset,
/// found by what each row's inputs and expected value are.
fn errors_over(
    name: &str,
    target: &str,
    output: &str,
    row: impl Fn(&[f64]) -> ([f32; 2], f64),
    table: &str,
) -> [f64; 2] {
    let file = committed(&format!("{target}.bin"));
    let dataset = Dataset::load(&file).unwrap();
    let found = incumbents_for(&file, &dataset).unwrap();
    let known = found.iter().find(|known| known.incumbent.name == name).unwrap();
    let index = known.outputs.iter().position(|known| known == output).unwrap();
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/reference").join(table);
    let text = std::fs::read_to_string(path).unwrap();
    let errors: Vec<f64> = text
        .lines()
        .skip(1)
        .map(|line| {
            let cells: Vec<f64> = line.split(',').map(|cell| cell.parse().unwrap()).collect();
            let (inputs, expected) = row(&cells);
            f64::from(known.program.evaluate(&inputs)[index]) - expected
        })
        .collect();
    let squares: f64 = errors.iter().map(|error| error * error).sum();
    let largest = errors.iter().map(|error| error.abs()).fold(0.0, f64::max);
    [(squares / errors.len() as f64).sqrt(), largest]
}

#[test]
fn errors_of_the_other_targets_are_those_of_the_reference_page() {
    let zh = |output: &str, column: usize| {
        let row = |cells: &[f64]| ([cells[0] as f32, cells[1] as f32], cells[column]);
        errors_over("pesce_iwanicki_2015", "disney_zh", output, row, "disney_zh.csv")
    };
    let norm = |name: &str, column: usize| {
        let row = |cells: &[f64]| ([cells[0] as f32, cells[1] as f32], cells[column]);
        errors_over(name, "area_norm", "norm", row, "area_norm.csv")
    };
    let cases = [
        (zh("zh0", 2), [".0039", ".0112"]),
        (zh("zh1", 3), [".0052", ".0174"]),
        (zh("zh2", 4), [".0045", ".0273"]),
        (zh("beta", 5), [".0175", ".069"]),
        (norm("karis_2013", 4), [".151", ".322"]),
    ];
    for (found, printed) in cases {
        for (found, printed) in found.into_iter().zip(printed) {
            let digits = printed.len() - 1;
            assert_eq!(format!("{found:.digits$}").trim_start_matches('0'), printed, "{found}");
        }
    }
}

/// "Max fit error: 0.0138", and what it is an error from.
#[test]
fn a_fit_of_the_tone_curve_errs_by_what_its_author_states() {
    let file = committed("tone_curve.bin");
    let dataset = Dataset::load(&file).unwrap();
    let found = incumbents_for(&file, &dataset).unwrap();
    let known = found.iter().find(|known| known.incumbent.name == "narkowicz_2016").unwrap();
    let [stops, display] = [0, 1].map(|column| &dataset.validation.columns[column]);
    let errors = stops
        .iter()
        .zip(display)
        .map(|(&stops, &display)| f64::from((known.program.evaluate(&[stops])[0] - display).abs()));
    assert_eq!(format!("{:.4}", errors.fold(0.0, f64::max)), "0.0138");
}

/// Every committed dataset has a published formula beside it that is finite on all of it.
#[test]
fn every_dataset_has_an_incumbent() {
    let text = std::fs::read_to_string(committed("checksums.txt")).unwrap();
    for file in text.lines().map(|line| line.split_once("  ").unwrap().1) {
        let dataset = Dataset::load(&committed(file)).unwrap();
        let incumbents = incumbents_for(&committed(file), &dataset).unwrap();
        assert!(!incumbents.is_empty(), "{file}");
        for known in incumbents.iter().filter(|known| known.incumbent.note != NAN_AT_A_CORNER) {
            for split in [&dataset.search, &dataset.validation] {
                for row in 0..split.rows() {
                    let inputs: Vec<f32> =
                        (0..dataset.inputs.len()).map(|index| split.columns[index][row]).collect();
                    let values = known.program.evaluate(&inputs);
                    let name = &known.incumbent.name;
                    assert!(values.iter().all(|v| v.is_finite()), "{file}: {name} {inputs:?}");
                }
            }
        }
    }
}

const NAN_AT_A_CORNER: &str = "NaN at roughness = n_dot_v = 0.";

#[test]
fn both_datasets_find_the_incumbents_of_their_target() {
    for file in ["dfg.bin", "dfg_paper.bin"] {
        let dataset = Dataset::load(&committed(file)).unwrap();
        assert_eq!(incumbents_for(&committed(file), &dataset).unwrap().len(), 10, "{file}");
        let elsewhere = tempfile::tempdir().unwrap();
        assert!(incumbents_for(&elsewhere.path().join(file), &dataset).unwrap().is_empty());
    }
}

#[test]
fn incumbents_are_scored_on_the_outputs_they_define() {
    let dataset = Dataset::load(&committed("dfg.bin")).unwrap();
    let incumbent = |formula: &str| Incumbent {
        name: "made_up".into(),
        source: String::new(),
        formula: formula.into(),
        cost: None,
        note: String::new(),
    };
    let outputs = |formula: &str, dataset: &Dataset| {
        incumbent(formula).compared_on(dataset).map(|comparable| comparable.outputs)
    };
    let both = "bias = n_dot_v; scale = 1 - bias";
    assert_eq!(outputs(both, &dataset).unwrap(), ["scale", "bias"]);
    assert_eq!(outputs("bias = n_dot_v", &dataset).unwrap(), ["bias"]);
    assert_eq!(outputs("other = n_dot_v", &dataset), None);
    assert_eq!(outputs("bias = metalness", &dataset), None);
    let alone = dataset.select(None, Some(&["scale".into()])).unwrap();
    assert_eq!(outputs(both, &alone).unwrap(), ["scale"]);
    let given = ["n_dot_v", "roughness", "bias"].map(String::from);
    assert_eq!(outputs(both, &dataset.select(Some(&given), None).unwrap()), None);
}

#[test]
fn unusable_incumbents_say_where() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("dfg.ron");
    let refusal = |text: &str| {
        std::fs::write(&file, text).unwrap();
        let error = load_incumbents(&file).unwrap_err();
        assert!(matches!(error, Error::Incumbents { .. }), "{error}");
        error.to_string()
    };
    let one = "(name: \"a\", source: \"b\", formula: \"y = x\"),\n";
    let cases = [
        ("[\n(nane: \"a\")]".to_owned(), "dfg.ron, line 2"),
        (format!("[\n{one}{one}]"), "dfg.ron, line 3: unusable incumbents: `a` occurs twice"),
        (format!("[\n{}]", one.replace("x\"", "sqt(x)\"")), "line 2: unusable incumbents: `a`"),
        (String::new(), "line 1"),
    ];
    for (text, expected) in cases {
        let message = refusal(&text);
        assert!(message.contains(expected), "{text}: {message}");
    }
    let missing = load_incumbents(&folder.path().join("no.ron")).unwrap_err();
    assert!(matches!(missing, Error::Missing { .. }));
}

/// The cycles that the reference page counts for each formula.
#[test]
fn incumbents_cost_what_was_counted() {
    use lgp::cost::{CostScratch, Profile};
    let dataset = Dataset::load(&committed("dfg.bin")).unwrap();
    let profile = Profile::find("gcn").unwrap();
    let incumbents = incumbents_for(&committed("dfg.bin"), &dataset).unwrap();
    assert_eq!(incumbents.len(), 10);
    for known in incumbents {
        let cycles = profile.cycles(&known.program, &mut CostScratch::default());
        assert_eq!(Some(cycles), known.incumbent.cost, "{}", known.incumbent.name);
    }
}
