//! Scenes on the real command line.

#![cfg(feature = "cli")]

mod command;

use command::{lgp, succeed, text};
use serde_json::Value;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

fn refused(folder: &Path, args: &[&str], expected: &str) {
    let output = lgp(folder, args);
    let message = text(&output.stderr);
    assert_eq!(output.status.code(), Some(3), "{args:?}: {message}");
    assert!(message.contains(expected), "{args:?}: {message}");
}

/// A folder with the DFG data, its incumbents and scenes.
fn project() -> TempDir {
    let datasets = Path::new(env!("CARGO_MANIFEST_DIR")).join("datasets");
    let folder = tempfile::tempdir().unwrap();
    for sub in ["incumbents", "scenes"] {
        std::fs::create_dir(folder.path().join(sub)).unwrap();
    }
    for file in [
        "dfg.bin",
        "incumbents/dfg.ron",
        "incumbents/dfg_dielectric.ron",
        "scenes/dielectric.ron",
        "scenes/satin.ron",
    ] {
        std::fs::copy(datasets.join(file), folder.path().join(file)).unwrap();
    }
    folder
}

const SHORT: [&str; 5] = ["search", "dfg.bin", "--quiet", "--generations", "2"];

#[test]
fn a_run_on_a_scene_knows_it() {
    let folder = project();
    let here = folder.path();
    let search = [&SHORT[..], &["--scene", "dielectric"]].concat();
    let shown = succeed(here, &search);
    for expected in ["env_brdf_nonmetal: ", "karis_2014: ", "float dfg_dielectric_specular("] {
        assert!(shown.contains(expected), "{expected} is not in\n{shown}");
    }
    let run = here.join("runs/dfg_dielectric");
    let snippet = succeed(here, &["emit", run.to_str().unwrap(), "--lang", "glsl"]);
    let scene = "// scene: dielectric: f0 = 0.04; specular = f0*scale + bias";
    assert!(snippet.contains(scene), "{snippet}");
    std::fs::write(here.join("mine.glsl"), &snippet).unwrap();
    let verify = ["verify", "mine.glsl", "dfg.bin", "--scene", "dielectric", "--max-error", "0.5"];
    succeed(here, &verify);
    let table = succeed(here, &["front", run.to_str().unwrap()]);
    assert!(table.contains("env_brdf_nonmetal: "), "{table}");

    // The file may change: the run has the scene as it was.
    std::fs::write(here.join("scenes/dielectric.ron"), "(ranges: {\"roughness\": (0, 0.5)})")
        .unwrap();
    assert_eq!(succeed(here, &["front", run.to_str().unwrap()]), table);
    let changed = "--scene dielectric, not dielectric as it is now";
    refused(here, &[&search[..], &["--resume"]].concat(), changed);
    succeed(here, &["search", "--resume", "--generations", "9", "--out", "runs/dfg_dielectric"]);
}

#[test]
fn a_scenes_run_is_repeated_and_resumed() {
    let folder = project();
    let here = folder.path();
    let run = |options: &[&str]| {
        let common = ["search", "dfg.bin", "--quiet", "--scene", "satin", "--outputs", "bias"];
        succeed(here, &[&common[..], options].concat());
    };
    let front = |name: &str| std::fs::read(here.join(name).join("front.json")).unwrap();
    run(&["--generations", "3", "--out", "one", "--threads", "1"]);
    run(&["--generations", "3", "--out", "two", "--threads", "2"]);
    assert_eq!(front("one"), front("two"));
    run(&["--generations", "1", "--out", "parts"]);
    run(&["--generations", "3", "--out", "parts", "--resume"]);
    assert_eq!(front("one"), front("parts"));
}

#[test]
fn runs_on_different_scenes_have_no_union() {
    let folder = project();
    let here = folder.path();
    succeed(here, &[&SHORT[..], &["--scene", "satin", "--out", "a"]].concat());
    succeed(here, &[&SHORT[..], &["--out", "b"]].concat());
    succeed(
        here,
        &[&SHORT[..], &["--seed", "2", "--require", "range=-1..2", "--out", "c"]].concat(),
    );
    refused(
        here,
        &["merge", "a", "b", "--out", "all"],
        "scene: satin (roughness in [0.3, 0.9]) and none",
    );
    refused(here, &["merge", "b", "c", "--out", "all"], "requirements: none and range=-1..2");
    assert!(!here.join("all").exists());
    succeed(here, &["merge", "a", "a", "--out", "all"]);
    let table = succeed(here, &["front", "all"]);
    assert!(table.contains("materialx_rational: "), "{table}");
}

#[test]
fn a_formula_is_scored_on_a_scene() {
    let folder = project();
    let score = |formula: &str| {
        let eval = ["eval", formula, "dfg.bin", "--scene", "dielectric", "--json"];
        serde_json::from_str::<Value>(&succeed(folder.path(), &eval)).unwrap()
    };
    let direct = score("specular = 0.04 - 0.04*roughness + 0.5*n_dot_v");
    let combined = score("scale = 1 - roughness; bias = 0.5*n_dot_v");
    assert_eq!(direct["formula"], "specular = 0.04 - 0.04*roughness + 0.5*n_dot_v");
    let error = |scored: &Value| scored["errors"]["specular"]["rmse"].as_f64().unwrap();
    assert!((error(&direct) - error(&combined)).abs() < 1e-6);
    let eval = ["eval", "bias = n_dot_v", "dfg.bin", "--scene", "dielectric"];
    refused(folder.path(), &eval, "`specular` is never assigned");
}

#[test]
fn tiers_are_afforded_or_reported() {
    let folder = project();
    let here = folder.path();
    let scene = |tiers: &str| {
        let text = format!("(fixed: {{\"roughness\": 0.5}}, tiers: {{{tiers}}})");
        std::fs::write(here.join("tiered.ron"), text).unwrap();
    };
    let search = [&SHORT[..], &["--scene", "tiered.ron", "--outputs", "bias"]].concat();
    scene("\"low\": (max_cost: Some(3)), \"high\": (max_cost: Some(9), max_error: Some(0.1))");
    let shown = succeed(here, &search);
    assert!(shown.contains("low (at most 3 cycles): "), "{shown}");
    let emitted =
        succeed(here, &["emit", "runs/dfg_tiered", "--lang", "hlsl", "--tier", "low", "--json"]);
    let emitted: Value = serde_json::from_str(&emitted).unwrap();
    assert!(emitted["cost"].as_f64().unwrap() <= 3.0);
    let members = succeed(here, &["front", "runs/dfg_tiered", "--json"]);
    let members: Vec<Value> = serde_json::from_str(&members).unwrap();
    assert!(members.iter().all(|member| member["cost"].as_f64().unwrap() <= 9.0));
    let unknown = lgp(here, &["emit", "runs/dfg_tiered", "--lang", "hlsl", "--tier", "lwo"]);
    assert_eq!(unknown.status.code(), Some(2));
    assert!(text(&unknown.stderr).contains("did you mean `low`?"), "{}", text(&unknown.stderr));

    scene("\"none\": (max_cost: Some(0), max_error: Some(1e-9))");
    let unmet = lgp(here, &search);
    assert_eq!(unmet.status.code(), Some(4), "{}", text(&unmet.stderr));
    assert!(text(&unmet.stdout).contains("none (at most 0 cycles, error at most 1.0e-9): not met"));
    assert!(here.join("runs/dfg_tiered/run.ron").is_file());
}

#[test]
fn bad_scenes_are_refused_and_nothing_is_written() {
    let folder = project();
    let here = folder.path();
    let bad = |content: &str| -> PathBuf {
        std::fs::write(here.join("bad.ron"), content).unwrap();
        here.join("bad.ron")
    };
    for (content, expected) in [
        ("(ranges: {\"roughness\": (0.9, 0.3)})", "is empty"),
        ("(ranges: {\"roughness\": (0.5, 3)})", "reaches beyond dfg"),
        ("(ranges: {\"gloss\": (0, 1)})", "no input of dfg"),
        ("(fixed: {\"roughness\": 7})", "outside the domain"),
        ("(histograms: [(inputs: [\"roughness\"], counts: [0, 0])])", "all counts are zero"),
        ("(outputs: {\"specular\": \"f0*scale\"})", "unknown name `f0`"),
        ("(\nranges: 3)", "bad.ron, line 2"),
        ("", "bad.ron, line 1"),
    ] {
        bad(content);
        refused(here, &[&SHORT[..], &["--scene", "bad.ron"]].concat(), expected);
    }
    refused(here, &[&SHORT[..], &["--scene", "nowhere.ron"]].concat(), "nowhere.ron");
    refused(here, &[&SHORT[..], &["--scene", "satn"]].concat(), "did you mean `satin`?");
    assert!(!here.join("runs").exists());
}

#[test]
fn a_scene_is_made_of_logged_pixels() {
    let folder = project();
    let here = folder.path();
    // Roughness follows n_dot_v; the weights say that half of the pixels count thrice.
    let pixels: String = (0..400)
        .map(|i| {
            let n_dot_v = (i as f32 + 0.5) / 400.0;
            format!("{n_dot_v},{},0.04,{}\n", 0.2 + 0.5 * n_dot_v, 1 + 2 * (i / 200))
        })
        .collect();
    let log = format!("n_dot_v,roughness,f0,weight\n{pixels}");
    std::fs::write(here.join("frame.csv"), log).unwrap();
    succeed(here, &["scene", "from", "frame.csv", "--bins", "4"]);
    let text = std::fs::read_to_string(here.join("frame.ron")).unwrap();
    for part in ["\"f0\": 0.04", "\"n_dot_v\",", "over: ", "300.0"] {
        assert!(text.contains(part), "{part} is not in\n{text}");
    }
    // The log has a value that the data know nothing of: the scene must say what it is for.
    let search = [&SHORT[..], &["--scene", "frame.ron", "--outputs", "bias"]].concat();
    refused(here, &search, "`f0`, which is no input of dfg, nor used in `outputs`");
    let used =
        text.replacen("fixed:", "outputs: {\"specular\": \"f0*scale + bias\"},\n    fixed:", 1);
    std::fs::write(here.join("frame.ron"), used).unwrap();
    succeed(here, &[&SHORT[..], &["--scene", "frame.ron"]].concat());
    let run = std::fs::read_to_string(here.join("runs/dfg_frame/run.ron")).unwrap();
    assert!(run.contains("measure: Weighted"), "{run}");

    let apart = ["scene", "from", "frame.csv", "--separate", "--inputs", "n_dot_v,roughness"];
    succeed(here, &[&apart[..], &["-o", "apart.ron"]].concat());
    let text = std::fs::read_to_string(here.join("apart.ron")).unwrap();
    assert_eq!(text.matches("counts:").count(), 2, "{text}");
    refused(here, &["scene", "from", "frame.csv", "--weight", "wieght"], "did you mean `weight`?");
    std::fs::write(here.join("dark.csv"), "n_dot_v,weight\n0.5,0\n0.7,0\n").unwrap();
    refused(here, &["scene", "from", "dark.csv"], "no pixel has a weight above zero");
    std::fs::write(here.join("minus.csv"), "n_dot_v,weight\n0.5,1\n0.7,-1\n").unwrap();
    refused(here, &["scene", "from", "minus.csv"], "minus.csv, line 3, column `weight`: -1");
    assert!(!here.join("dark.ron").exists() && !here.join("minus.ron").exists());
}

#[test]
fn a_formula_is_cut_to_a_scene() {
    let folder = project();
    let here = folder.path();
    // The maximum never acts where roughness is at least .3, but on the whole domain it does.
    let formula = "bias = max(0.001, 1.1 - roughness)*saturate(0.9 - n_dot_v) + 0.001*n_dot_v";
    let specialize = ["specialize", formula, "dfg.bin", "--scene", "satin", "--outputs", "bias"];
    let json = succeed(here, &[&specialize[..], &["--json"]].concat());
    let found: Value = serde_json::from_str(&json).unwrap();
    let steps = found["steps"].as_array().unwrap();
    let change = |step: usize| steps[step]["change"].as_str().unwrap();
    assert_eq!(change(0), "as given");
    assert_eq!(change(1), "max dropped: it never acts (proved)");
    assert_eq!(change(2), "constants fitted to the scene");
    let cost = |member: &Value| member["cost"].as_f64().unwrap();
    let saved: f64 = steps[1..].iter().map(|step| step["saved"].as_f64().unwrap()).sum();
    assert_eq!(cost(&steps[0]) - saved, cost(&steps[steps.len() - 1]));
    assert!(steps[1]["added"].as_f64().unwrap().abs() < 1e-9);
    let error = |member: &Value| member["rmse"].as_f64().unwrap();
    assert!(error(&steps[2]) < error(&steps[1]));
    let front = found["front"].as_array().unwrap();
    for pair in front.windows(2) {
        assert!(cost(&pair[0]) < cost(&pair[1]) && error(&pair[0]) > error(&pair[1]), "{pair:?}");
    }
    let table = succeed(here, &specialize);
    assert!(table.contains("max dropped: it never acts (proved)"), "{table}");
    let limited = succeed(here, &[&specialize[..], &["--json", "--max-error", "0.05"]].concat());
    let limited: Value = serde_json::from_str(&limited).unwrap();
    let members = limited["front"].as_array().unwrap();
    assert!(!members.is_empty() && members.iter().all(|member| error(member) <= 0.05));

    let on = |formula: &'static str| ["specialize", formula, "dfg.bin", "--scene", "satin"];
    refused(here, &on("karis_2013"), "did you mean `karis_2014`?");
    refused(here, &on("bias = n_dot_v"), "defines bias, which is not all that scale, bias needs");
    refused(here, &on("bias = $a*n_dot_v; scale = 1"), "`$a` is a free constant");
    refused(here, &on("bias = gloss"), "unknown name `gloss`");
}

#[test]
fn a_runs_front_is_cut_to_a_scene() {
    let folder = project();
    let here = folder.path();
    succeed(
        here,
        &[&SHORT[..], &["--max-cost", "4", "--outputs", "bias", "--out", "run"]].concat(),
    );
    let cut = ["specialize", "run", "dfg.bin", "--scene", "satin", "--outputs", "bias"];
    let json = succeed(here, &[&cut[..], &["--json"]].concat());
    let found: Value = serde_json::from_str(&json).unwrap();
    assert!(found["front"].as_array().unwrap().len() > 2);
    succeed(
        here,
        &[&SHORT[..], &["--max-cost", "4", "--scene", "satin", "--out", "satin"]].concat(),
    );
    let again = ["specialize", "satin", "dfg.bin", "--scene", "satin"];
    refused(here, &again, "give a run on the whole dataset");
}
