//! `merge`, `analyze` and `emit --half` on the real command line.

#![cfg(feature = "cli")]

mod command;

use command::{lgp, succeed, text};
use serde_json::Value;
use std::path::Path;
use tempfile::TempDir;

/// A table of `max(x, y)²`, and short searches on it with seeds 1, 2 and 3 in `run1` and so on.
fn searched() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let value = |i: usize| (i as f32 + 0.5) / 16.0;
    let row = |i: usize| {
        let (x, y) = (value(i % 16), value(i / 16));
        format!("{x},{y},{}\n", x.max(y).powi(2) + 0.1 * x)
    };
    let rows: String = (0..256).map(row).collect();
    std::fs::write(folder.path().join("d.csv"), format!("x,y,z\n{rows}")).unwrap();
    succeed(folder.path(), &["import", "d.csv", "-o", "d.bin", "--inputs", "2", "--quiet"]);
    for seed in ["1", "2", "3"] {
        let out = format!("run{seed}");
        let search =
            ["search", "d.bin", "--generations", "6", "--islands", "2", "--max-cost", "12"];
        let args = [&search[..], &["--seed", seed, "--out", &out, "--quiet"]].concat();
        succeed(folder.path(), &args);
    }
    folder
}

/// All files of a folder, by name.
fn content(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let mut files = Vec::new();
    for entry in std::fs::read_dir(folder).unwrap().flatten() {
        let name = entry.file_name().to_string_lossy().into_owned();
        if entry.path().is_dir() {
            let within = content(&entry.path()).into_iter();
            files.extend(within.map(|(file, bytes)| (format!("{name}/{file}"), bytes)));
        } else {
            files.push((name, std::fs::read(entry.path()).unwrap()));
        }
    }
    files.sort();
    files
}

#[test]
fn merging_is_associative_commutative_and_idempotent() {
    let folder = searched();
    let here = folder.path();
    let merged = |runs: &[&str], out: &str| {
        succeed(here, &[&["merge"], runs, &["--out", out, "--quiet"]].concat());
        content(&here.join(out))
    };
    let all = merged(&["run1", "run2", "run3"], "all");
    assert!(all.iter().any(|(file, _)| file == "snippets/01.hlsl"));
    assert_eq!(all, merged(&["run3", "run1", "run2"], "permuted"));
    merged(&["run1", "run2"], "first");
    assert_eq!(all, merged(&["first", "run3"], "left"));
    merged(&["run2", "run3"], "second");
    assert_eq!(all, merged(&["run1", "second"], "right"));
    assert_eq!(all, merged(&["all", "run2", "all"], "again"));
    assert_eq!(all, merged(&["all"], "all"));
}

#[test]
fn a_union_is_a_front_of_all_members_and_a_run_as_others() {
    let folder = searched();
    let here = folder.path();
    let members = |args: &[&str]| {
        let front: Vec<Value> = serde_json::from_str(&succeed(here, args)).unwrap();
        let number = |member: &Value, field: &str| member[field].as_f64().unwrap();
        let point = |m: &Value| (number(m, "cost"), number(&m["validation"], "rmse"));
        front.iter().map(point).collect::<Vec<_>>()
    };
    let union = members(&["merge", "run1", "run2", "run3", "--out", "all", "--json"]);
    for run in ["run1", "run2", "run3"] {
        for (cost, error) in members(&["front", run, "--json"]) {
            assert!(union.iter().any(|&(c, e)| c <= cost && e <= error), "{run}: {cost} {error}");
        }
    }
    assert!(union.windows(2).all(|pair| pair[0].0 < pair[1].0 && pair[0].1 > pair[1].1));
    assert_eq!(union, members(&["front", "all", "--json"]));
    let snippet = succeed(here, &["emit", "all", "--lang", "wgsl"]);
    assert!(snippet.contains("seeds 1, 2, 3"), "{snippet}");
}

#[test]
fn runs_that_have_no_union_are_refused_and_nothing_is_written() {
    let folder = searched();
    let here = folder.path();
    let search = ["search", "d.bin", "--generations", "1", "--islands", "1", "--quiet"];
    succeed(here, &[&search[..], &["--grammar", "polynomial", "--out", "polynomial"]].concat());
    succeed(here, &[&search[..], &["--inputs", "x", "--out", "narrow"]].concat());
    let table = std::fs::read_to_string(here.join("d.csv")).unwrap();
    std::fs::write(here.join("d.csv"), table.replace("0.03125,0.03125", "0.03,0.03125")).unwrap();
    succeed(here, &["import", "d.csv", "-o", "d.bin", "--inputs", "2", "--quiet"]);
    succeed(here, &[&search[..], &["--out", "other"]].concat());
    std::fs::create_dir(here.join("empty")).unwrap();
    std::fs::write(here.join("file"), "").unwrap();
    let before = content(&here.join("run1"));
    for (args, code, expected) in [
        (&["merge", "--out", "all"][..], 2, "required"),
        (&["merge", "run1"], 2, "--out"),
        (&["merge", "run1", "polynomial", "--out", "all"], 3, "grammar: "),
        (&["merge", "run1", "narrow", "--out", "all"], 3, "columns: "),
        (&["merge", "run1", "other", "--out", "all"], 3, "dataset: "),
        (&["merge", "run1", "nowhere", "--out", "all"], 3, "nowhere"),
        (&["merge", "run1", "empty", "--out", "all"], 3, "run.ron"),
        (&["merge", "run1", "run2", "--out", "run1"], 2, "another --out"),
        (&["merge", "run1", "run2", "--out", "file/all"], 1, "file/all"),
        (&["analyze", "nowhere"], 3, "nowhere"),
        (&["analyze", "empty"], 3, "run.ron"),
    ] {
        let output = lgp(here, args);
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(code), "{args:?}: {message}");
        assert!(message.contains(expected), "{args:?}: {message}");
        assert!(output.stdout.is_empty(), "{args:?}");
    }
    assert!(!here.join("all").exists());
    assert_eq!(before, content(&here.join("run1")));

    succeed(here, &["merge", "run1", "run2", "--out", "all", "--quiet"]);
    let resumed = lgp(here, &["search", "d.bin", "--out", "all", "--resume"]);
    assert_eq!(resumed.status.code(), Some(3));
    assert!(text(&resumed.stderr).contains("--guess"), "{}", text(&resumed.stderr));
}

#[test]
fn what_recurs_is_shown_of_the_front_and_of_the_run() {
    let folder = searched();
    let here = folder.path();
    let shown = succeed(here, &["analyze", "run1"]);
    for expected in ["formulas in the front", "variable", "subexpression", "max(x, y)"] {
        assert!(shown.contains(expected), "{expected} is not in\n{shown}");
    }
    let analysis: Value =
        serde_json::from_str(&succeed(here, &["analyze", "run1", "--json"])).unwrap();
    let front: Vec<Value> =
        serde_json::from_str(&succeed(here, &["front", "run1", "--json"])).unwrap();
    assert_eq!(analysis["front"]["formulas"], front.len());
    let using = |name: &str| {
        front.iter().filter(|member| member["formula"].as_str().unwrap().contains(name)).count()
    };
    let variables = analysis["front"]["variables"].as_array().unwrap();
    for (variable, name) in variables.iter().zip(["x", "y"]) {
        assert_eq!((&variable["name"], &variable["count"]), (&name.into(), &using(name).into()));
    }
    let recurring = analysis["run"]["subexpressions"].as_array().unwrap();
    assert!(recurring.iter().any(|found| found["expression"] == "max(x, y)"), "{recurring:?}");
    assert!(analysis["run"]["formulas"].as_u64().unwrap() > front.len() as u64);

    let few = succeed(here, &["analyze", "run1", "--json", "--top", "1"]);
    let few: Value = serde_json::from_str(&few).unwrap();
    assert_eq!(few["front"]["subexpressions"].as_array().unwrap().len(), 1);

    succeed(here, &["merge", "run1", "run2", "--out", "all", "--quiet"]);
    let union: Value = serde_json::from_str(&succeed(here, &["analyze", "all", "--json"])).unwrap();
    assert!(union["run"].is_null() && union["front"]["formulas"].as_u64().unwrap() > 1);
    std::fs::write(here.join("run1/census.json"), "{").unwrap();
    let damaged = lgp(here, &["analyze", "run1"]);
    assert_eq!(damaged.status.code(), Some(3));
    assert!(
        text(&damaged.stderr).contains("census.json: not the file"),
        "{}",
        text(&damaged.stderr)
    );
}

/// A run on 64 rows of a function of one input.
fn searched_for(low: f32, high: f32, function: impl Fn(f32) -> f32) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let row = |i: u8| {
        let t = low + (high - low) * f32::from(i) / 63.0;
        format!("{t},{}\n", function(t))
    };
    let rows: String = (0..64).map(row).collect();
    std::fs::write(folder.path().join("d.csv"), format!("t,y\n{rows}")).unwrap();
    succeed(folder.path(), &["import", "d.csv", "-o", "d.bin", "--inputs", "1", "--quiet"]);
    let search = ["search", "d.bin", "--generations", "12", "--islands", "2", "--max-cost", "8"];
    succeed(folder.path(), &[&search[..], &["--out", "run", "--quiet"]].concat());
    folder
}

#[test]
fn halves_that_cannot_hold_a_formula_are_refused_and_say_where() {
    for folder in [
        searched_for(0.0, 1.0, |t| 80_000.0 * t + 100_000.0),
        searched_for(1000.0, 24_880.0, |t| 3000.0 * t * t),
    ] {
        let here = folder.path();
        let knee = ["emit", "run", "--lang", "wgsl", "--max-error", "1e9"];
        let most_accurate = ["emit", "run", "--lang", "wgsl", "--max-cost", "8"];
        for which in [&knee[..], &most_accurate] {
            for how in [&["--half"][..], &["--half-error", "1e-2"]] {
                let output = lgp(here, &[which, how].concat());
                let errors = text(&output.stderr);
                assert_eq!(output.status.code(), Some(4), "{errors}");
                assert_eq!(text(&output.stdout), "");
                assert!(errors.contains("infinite as a half"), "{errors}");
            }
        }
        assert!(succeed(here, &most_accurate).contains("f32"));
    }
}

#[test]
fn the_comment_of_halves_states_their_own_error() {
    let folder = searched_for(0.0, 1.0, |t| 1.0 / (1.0 + 3.0 * t * t));
    let shown =
        succeed(folder.path(), &["emit", "run", "--lang", "wgsl", "--max-cost", "8", "--half"]);
    let said = shown.lines().find_map(|line| line.split_once("adds an error of ")).unwrap().1;
    let (error, tried) = said.split_once(" at most (all ").unwrap();
    assert!(tried.starts_with("15362 inputs"), "{tried}");
    let error: f64 = error.parse().unwrap();
    assert!(error > 1e-5 && error < 0.05, "{error}");
    assert!(shown.contains("verdicts above are those of single precision"));
}

#[test]
fn ends_are_printed_as_single_precision_has_them() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let rows: String =
        (1..=66).map(|i| format!("{},{}\n", i as f32 / 66.0, 66.0 / i as f32)).collect();
    std::fs::write(here.join("d.csv"), format!("x,y\n{rows}")).unwrap();
    succeed(here, &["import", "d.csv", "-o", "d.bin", "--inputs", "1", "--quiet"]);
    let search = ["search", "d.bin", "--generations", "1", "--islands", "1", "--out", "run"];
    let searched = succeed(here, &search);
    let emitted = succeed(here, &["emit", "run", "--lang", "hlsl"]);
    assert!(emitted.contains("x in [0.015151516, 1]"), "{emitted}");
    let checked = text(&lgp(here, &["check", "run"]).stdout);
    let info = succeed(here, &["info", "d.bin"]);
    for said in [searched, emitted, checked, info] {
        assert!(!said.contains("0.01515151560"), "{said}");
    }
}
