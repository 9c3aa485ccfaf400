//! A grammar, a GPU profile or a scene, by the first byte: what is read can be used.
#![no_main]

use lgp::cost::Profile;
use lgp::dataset::{Column, Dataset, Origin, Split};
use lgp::grammar::Grammar;
use lgp::program::{Names, Program, parse};
use lgp::scene::Scene;
use libfuzzer_sys::fuzz_target;
use std::sync::LazyLock;

static PROGRAM: LazyLock<Program> = LazyLock::new(|| {
    let names = Names::new(["a", "b"], ["y", "z"]);
    parse("y = mad(a, b, sqrt(a)); z = exp2(-a)*y", &names).expect("it is a formula")
});

static DATASET: LazyLock<Dataset> = LazyLock::new(|| {
    let places = vec![(0..5).map(|i| i as f32 / 4.0).collect(); 2];
    let split = Split::on_grid(&places, |p| [p[0], p[1]]);
    let (inputs, outputs) = (["a", "b"].map(|name| Column::new(name, [0.0, 1.0])), ["y", "z"]);
    let (outputs, splits) = (outputs.map(|name| (name, "1")), [split.clone(), split]);
    Dataset::of_splits("grid", Origin::default(), inputs.into(), outputs, splits).expect("numbers")
});

fuzz_target!(|content: &[u8]| {
    let Some((first, rest)) = content.split_first() else { return };
    let Ok(text) = std::str::from_utf8(rest) else { return };
    match first % 3 {
        0 => {
            let Ok(grammar) = Grammar::parse("fuzzed", text) else { return };
            let draft = PROGRAM.clone().into_draft();
            grammar.allows_nesting(&draft);
            assert!(!grammar.penalty(&draft).is_nan());
        }
        1 => {
            let Ok(profile) = Profile::parse("fuzzed", text) else { return };
            let cost = profile.cost(&PROGRAM).cycles;
            assert!(cost.is_finite() && cost >= 0.0, "{cost} cycles");
        }
        _ => {
            let Ok(scene) = Scene::parse("fuzzed", text) else { return };
            let again =
                Scene::parse("fuzzed", &scene.to_ron()).expect("what was written can be read");
            assert_eq!(
                Scene { description: String::new(), ..again },
                Scene { description: String::new(), ..scene.clone() }
            );
            let _ = scene.summary();
            let Ok(view) = scene.over(&DATASET) else { return };
            let Ok(dataset) = view.dataset() else { return };
            dataset.validate().expect("what a scene leaves is a dataset");
        }
    }
});
