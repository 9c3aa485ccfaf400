//! `search`, `front`, `emit` and `eval` on the real command line.

#![cfg(feature = "cli")]

mod command;

use command::{lgp, text};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::Output;
use tempfile::TempDir;

fn datasets() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("datasets")
}

/// A copy of the DFG data with its incumbents, and a short run on it.
fn short_run(extra: &[&str]) -> (TempDir, Output) {
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("incumbents")).unwrap();
    for file in ["dfg.bin", "incumbents/dfg.ron"] {
        std::fs::copy(datasets().join(file), folder.path().join(file)).unwrap();
    }
    let mut args = vec!["search", "dfg.bin", "--generations", "4", "--out", "run"];
    args.extend(extra);
    let output = lgp(folder.path(), &args);
    assert!(output.status.success(), "{}", text(&output.stderr));
    (folder, output)
}

#[test]
fn a_run_leaves_its_folder_and_shows_the_front() {
    let (folder, output) = short_run(&[]);
    let run = folder.path().join("run");
    for file in [
        "run.ron",
        "front.json",
        "trace.csv",
        "checkpoint.bin",
        "snippets/01.hlsl",
        "front.svg",
        "front.png",
    ] {
        assert!(run.join(file).is_file(), "{file}");
    }
    let shown = text(&output.stdout);
    for expected in
        ["cycles", "RMSE", "karis_2014: dominated by", "float2 dfg(float n_dot_v, float roughness)"]
    {
        assert!(shown.contains(expected), "{expected} is not in\n{shown}");
    }
    let leftovers = std::fs::read_dir(&run).unwrap().flatten();
    for entry in leftovers {
        assert!(!entry.file_name().to_string_lossy().starts_with('.'), "{entry:?}");
    }

    let json = lgp(folder.path(), &["front", "run", "--json"]).stdout;
    let members: Value = serde_json::from_slice(&json).unwrap();
    let members = members.as_array().unwrap();
    assert!(members.len() > 3);
    for member in members {
        for field in ["cost", "rmse", "max_error", "formula"] {
            assert!(!member[field].is_null(), "{field} in {member}");
        }
        assert!(member["registers"].is_u64());
        assert!(member["validation"]["rmse"].is_f64() && member["validation"]["max"].is_f64());
        assert!(member["errors"]["scale"]["rmse"].is_f64());
        for topic in ["finite", "range", "energy"] {
            let status = member["verdict"][topic]["status"].as_str().unwrap();
            assert!(["proved", "refuted", "open"].contains(&status), "{topic} of {member}");
        }
        // What the table says of a formula is what `eval` says of it.
        let formula = member["formula"].as_str().unwrap();
        let output = lgp(folder.path(), &["eval", formula, "dfg.bin", "--json"]);
        let scored: Value = serde_json::from_slice(&output.stdout).unwrap();
        for field in ["cost", "rmse", "max_error", "validation"] {
            assert_eq!(scored[field], member[field], "{field} of {formula}");
        }
    }

    for (language, expected) in
        [("hlsl", "float2 dfg("), ("wgsl", "fn dfg("), ("glsl", "vec2 dfg(")]
    {
        let output = lgp(folder.path(), &["emit", "run", "--lang", language, "--pick", "2"]);
        assert!(text(&output.stdout).contains(expected), "{}", text(&output.stdout));
    }
    let unmet = lgp(folder.path(), &["emit", "run", "--lang", "hlsl", "--max-error", "1e-9"]);
    assert_eq!(unmet.status.code(), Some(4), "{}", text(&unmet.stderr));
    let missing = lgp(folder.path(), &["emit", "run", "--lang", "hlsl", "--pick", "999"]);
    assert_eq!(missing.status.code(), Some(2), "{}", text(&missing.stderr));
}

#[test]
fn a_seed_gives_the_same_front_with_one_thread_and_with_two() {
    let front = |extra: &[&str]| {
        let (folder, _) = short_run(extra);
        std::fs::read(folder.path().join("run/front.json")).unwrap()
    };
    let one = front(&["--seed", "3", "--threads", "1"]);
    assert_eq!(one, front(&["--seed", "3", "--threads", "2"]));
    assert_ne!(one, front(&["--seed", "4", "--threads", "2"]));
}

#[test]
fn the_time_of_each_phase_is_told() {
    let (_, output) = short_run(&["--timings", "--time", "1h"]);
    let errors = text(&output.stderr);
    let line = errors.lines().find(|line| line.starts_with("timings: ")).expect(&errors);
    for phase in ["reading", "start", "search", "polishing", "verdicts", "files", "pictures"] {
        assert!(line.contains(phase), "{line}");
    }
}

#[test]
fn a_run_without_time_is_whole() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::copy(datasets().join("dfg.bin"), folder.path().join("dfg.bin")).unwrap();
    let output =
        lgp(folder.path(), &["search", "dfg.bin", "--time", "0", "--out", "run", "--json"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let members: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(members[0]["cost"], 0.0);
    for file in ["front.json", "front-max.json", "checkpoint.bin", "run.ron", "report.html"] {
        assert!(folder.path().join("run").join(file).is_file(), "{file}");
    }
    let again = ["search", "dfg.bin", "--generations", "1", "--out", "run", "--resume", "--quiet"];
    let resumed = lgp(folder.path(), &again);
    assert!(resumed.status.success(), "{}", text(&resumed.stderr));
}

#[test]
fn a_resumed_run_ends_as_an_uninterrupted_one() {
    let (whole, _) = short_run(&[]);
    let folder = tempfile::tempdir().unwrap();
    std::fs::copy(datasets().join("dfg.bin"), folder.path().join("dfg.bin")).unwrap();
    let again = |args: &[&str]| {
        let output = lgp(folder.path(), args);
        assert!(output.status.success(), "{}", text(&output.stderr));
    };
    let own = folder.path().join("two/snippets/mine.hlsl");
    std::fs::create_dir_all(own.parent().unwrap()).unwrap();
    std::fs::write(&own, "not the program's").unwrap();
    again(&["search", "dfg.bin", "--generations", "2", "--out", "two", "--quiet"]);
    // As a search that is killed leaves its folder.
    for file in ["front.json", "front-max.json"] {
        std::fs::remove_file(folder.path().join("two").join(file)).unwrap();
    }
    let unfinished = lgp(folder.path(), &["report", "two"]);
    assert_eq!(unfinished.status.code(), Some(3));
    assert!(text(&unfinished.stderr).contains("--resume"), "{}", text(&unfinished.stderr));
    again(&["search", "dfg.bin", "--generations", "4", "--out", "two", "--resume", "--quiet"]);
    let read = |path: PathBuf| std::fs::read(path).unwrap();
    assert_eq!(
        read(whole.path().join("run/front.json")),
        read(folder.path().join("two/front.json"))
    );
    assert_eq!(std::fs::read_to_string(&own).unwrap(), "not the program's");
    let other = lgp(
        folder.path(),
        &["search", "dfg.bin", "--generations", "5", "--out", "two", "--resume", "--seed", "9"],
    );
    assert_eq!(other.status.code(), Some(3), "{}", text(&other.stderr));
}

#[test]
fn columns_and_budgets_are_taken() {
    let (folder, _) =
        short_run(&["--outputs", "scale", "--inputs", "n_dot_v,roughness,bias", "--max-cost", "6"]);
    let json = lgp(folder.path(), &["front", "run", "--json"]).stdout;
    let members: Value = serde_json::from_slice(&json).unwrap();
    for member in members.as_array().unwrap() {
        assert!(member["cost"].as_f64().unwrap() <= 6.0);
        assert!(member["errors"]["bias"].is_null() && !member["errors"]["scale"].is_null());
    }
}

#[test]
fn eval_scores_the_outputs_that_a_formula_assigns() {
    let data = datasets().join("dfg_paper.bin");
    let formula = "bias = exp2(-(7*n_dot_v + 4*roughness^2))";
    let output = lgp(&datasets(), &["eval", formula, data.to_str().unwrap(), "--json"]);
    let scored: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(scored["cost"], 7.0);
    assert!((scored["rmse"].as_f64().unwrap() - 0.03425).abs() < 1e-5);
}

#[test]
fn eval_shows_and_costs_what_compilers_leave_of_a_formula() {
    let data = datasets().join("dfg_paper.bin");
    let formula = "bias = 1*exp2(n_dot_v*(sqrt(4) - 9)) + (roughness - roughness)";
    let output = lgp(&datasets(), &["eval", formula, data.to_str().unwrap(), "--json"]);
    let scored: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(scored["formula"], "bias = exp2(-7*n_dot_v)");
    assert_eq!(scored["cost"], 5.0);
}

/// What is wrong on the command line, the exit code, and what the message says.
#[test]
fn bad_input_is_refused_and_nothing_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    std::fs::copy(datasets().join("dfg.bin"), here.join("dfg.bin")).unwrap();
    std::fs::write(here.join("empty.bin"), "").unwrap();
    std::fs::write(here.join("file"), "mine").unwrap();
    std::fs::write(here.join("bad.ron"), "(operations: {\"sqt\": 1}, max_instructions: 9)")
        .unwrap();
    std::fs::write(here.join("syntax.ron"), "(operations: ").unwrap();
    let mut bytes = std::fs::read(here.join("dfg.bin")).unwrap();
    bytes[3000] ^= 1;
    std::fs::write(here.join("flipped.bin"), &bytes).unwrap();
    for (args, code, expected) in [
        (&["search", "nowhere.bin"][..], 3, "nowhere.bin"),
        (&["search", "empty.bin"], 3, "empty.bin"),
        (&["search", "flipped.bin"], 3, "flipped.bin"),
        (&["search", "file"], 3, "file"),
        (&["search", "dfg.bin", "--grammar", "shadr"], 3, "did you mean `shader`?"),
        (
            &["search", "dfg.bin", "--grammar", "bad.ron"],
            3,
            "unknown operation \"sqt\"; did you mean `sqrt`?",
        ),
        (&["search", "dfg.bin", "--grammar", "syntax.ron"], 3, "line 1"),
        (&["search", "dfg.bin", "--gpu", "gnc"], 3, "did you mean `gcn`?"),
        (&["search", "dfg.bin", "--outputs", "bais"], 3, "bias"),
        (&["search", "dfg.bin", "--inputs", "rougness"], 3, "roughness"),
        (&["search", "dfg.bin", "--max-cost", "-1"], 2, "cost budget"),
        (&["search", "dfg.bin", "--time", "soon"], 2, "60s"),
        (&["search", "dfg.bin", "--guess", "bias = n_dot"], 3, "n_dot_v"),
        (&["search", "dfg.bin", "--out", "file/run"], 1, "file/run"),
        (&["search", "dfg.bin", "--out", "new", "--resume"], 3, "no such folder"),
        (&["front", "nowhere"], 3, "no such folder"),
        (&["front", "."], 3, "run.ron"),
        (&["emit", ".", "--lang", "hlls"], 2, "hlsl"),
        (&["eval", "bias = sqt(n_dot_v)", "dfg.bin"], 3, "did you mean `sqrt`?"),
        (&["eval", "bais = n_dot_v", "dfg.bin"], 3, "never assigned"),
        (&["eval", "bias = n_dot_v", "nowhere.bin"], 3, "nowhere.bin"),
    ] {
        let output = lgp(here, args);
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(code), "{args:?}: {message}");
        assert!(message.contains(expected), "{args:?}: {message}");
        assert!(!message.contains("panicked"), "{args:?}: {message}");
        assert!(output.stdout.is_empty(), "{args:?}");
    }
    assert!(!here.join("runs").exists(), "nothing was searched");
    assert_eq!(std::fs::read_to_string(here.join("file")).unwrap(), "mine");
}

#[test]
fn a_damaged_run_is_refused() {
    let (folder, _) = short_run(&[]);
    let run = folder.path().join("run");
    let front = std::fs::read_to_string(run.join("front.json")).unwrap();
    std::fs::write(run.join("front.json"), &front[..front.len() / 2]).unwrap();
    let output = lgp(folder.path(), &["front", "run"]);
    assert_eq!(output.status.code(), Some(3));
    assert!(text(&output.stderr).contains("front.json"), "{}", text(&output.stderr));

    let mut checkpoint = std::fs::read(run.join("checkpoint.bin")).unwrap();
    let middle = checkpoint.len() / 2;
    checkpoint[middle] ^= 1;
    std::fs::write(run.join("checkpoint.bin"), &checkpoint).unwrap();
    let resume = ["search", "dfg.bin", "--generations", "6", "--out", "run", "--resume"];
    let output = lgp(folder.path(), &resume);
    assert_eq!(output.status.code(), Some(3));
    assert!(text(&output.stderr).contains("checkpoint.bin"), "{}", text(&output.stderr));
}

#[test]
fn weights_count_unless_another_measure_is_asked_for() {
    let folder = TempDir::new().unwrap();
    // A constant's best value is the mean: 1/2, or 9/10 as the rows are weighted.
    let rows: String = (0..80).map(|i| format!("{i},{},{}\n", i % 2, 1 + 8 * (i % 2))).collect();
    std::fs::write(folder.path().join("steps.csv"), format!("x,y,weight\n{rows}")).unwrap();
    let imported = lgp(folder.path(), &["import", "steps.csv", "-o", "steps.bin", "--inputs", "x"]);
    assert!(imported.status.success(), "{}", text(&imported.stderr));
    for (options, mean) in [(&[][..], 0.9), (&["--loss", "rmse"], 0.5)] {
        let fit = [&["fit", "y = $c", "steps.bin", "--json"], options].concat();
        let fitted: Value = serde_json::from_slice(&lgp(folder.path(), &fit).stdout).unwrap();
        let c = fitted["constants"]["c"].as_f64().unwrap();
        assert!((c - mean).abs() < 0.05, "{options:?}: {c}");
    }
}
