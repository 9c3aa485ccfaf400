//! `info --explore` and `analyze --explore` on the real command line.

#![cfg(feature = "cli")]

mod command;

use command::{command, lgp, lgp_here, succeed, text};
use serde_json::Value;
use std::process::Command;
use tempfile::TempDir;

/// A table of a product of a function of `n_dot_v` and one of `roughness`, beside a column that does
/// not matter.
fn product() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let row = |i: usize| {
        let place = |root: f64| (0.5 + (i + 1) as f64 * root).fract();
        let [n_dot_v, roughness, depth] = [0.8191725, 0.6710436, 0.5497005].map(place);
        let value = (-3.0 * n_dot_v).exp() * (1.0 + roughness * roughness);
        format!("{n_dot_v},{roughness},{depth},{value}\n")
    };
    let rows: String = (0..2000).map(row).collect();
    let table = format!("n_dot_v,roughness,depth,y\n{rows}");
    std::fs::write(folder.path().join("d.csv"), table).unwrap();
    succeed(folder.path(), &["import", "d.csv", "-o", "d e.bin", "--quiet"]);
    folder
}

#[test]
fn a_page_says_what_matters_and_proposes_a_template() {
    let folder = product();
    let page = succeed(folder.path(), &["info", "d e.bin", "--explore"]);
    for expected in [
        "depth",
        "can be left out",
        "holds: f(n_dot_v)*g(roughness)",
        "template: y = f(n_dot_v)*g(roughness)",
        "2 functions of 1 argument at most in place of one of 3",
        "lgp search 'd e.bin' --template \"y = f(n_dot_v)*g(roughness)\"",
    ] {
        assert!(page.contains(expected), "{expected} is not in\n{page}");
    }
    assert!(!succeed(folder.path(), &["info", "d e.bin"]).contains("template"));
    // What is proposed is found as it is printed.
    let proposed = page.lines().map(str::trim).find(|line| line.starts_with("lgp search")).unwrap();
    let program = command(folder.path(), &[]).get_program().to_owned();
    let lgp = format!("lgp() {{ '{}' \"$@\"; }}", program.display());
    let script = format!("{lgp}; {proposed} --time 1s --out run");
    let shell = Command::new("sh").current_dir(folder.path()).args(["-c", &script]).output();
    assert!(shell.unwrap().status.success(), "{script}");
    assert!(succeed(folder.path(), &["front", "run"]).contains("with f(n_dot_v) = "));
}

#[test]
fn all_figures_are_data() {
    let folder = product();
    let json = succeed(folder.path(), &["info", "d e.bin", "--explore", "--json"]);
    let info: Value = serde_json::from_str(&json).unwrap();
    let output = &info["explored"]["outputs"][0];
    assert_eq!(output["inputs"][2]["needless"], true);
    let forms = output["forms"].as_array().unwrap();
    let form = |text: &str| forms.iter().find(|form| form["text"] == text).unwrap();
    assert_eq!(form("f(n_dot_v)*g(roughness)")["verdict"], "holds");
    assert_eq!(form("f(n_dot_v*roughness)")["verdict"], "fails");
    assert!(form("f(n_dot_v) + g(roughness)")["departure"]["estimate"].as_f64().unwrap() > 0.05);
    assert_eq!(output["templates"][0]["most_arguments"], 1);
    let plain: Value =
        serde_json::from_str(&succeed(folder.path(), &["info", "d e.bin", "--json"])).unwrap();
    assert!(plain.get("explored").is_none());
}

#[test]
fn a_run_says_it_of_its_data_and_of_its_front() {
    let folder = product();
    let here = folder.path();
    let search = ["search", "d e.bin", "--generations", "2", "--islands", "1", "--max-cost", "6"];
    succeed(
        here,
        &[&search[..], &["--inputs", "n_dot_v,depth", "--out", "run", "--quiet"]].concat(),
    );
    let page = succeed(here, &["analyze", "run", "--explore"]);
    assert!(page.contains("of the variance") && !page.contains("roughness"), "{page}");
    std::fs::remove_file(here.join("d e.bin")).unwrap();
    let missing = lgp(here, &["analyze", "run", "--explore"]);
    assert_eq!(missing.status.code(), Some(3), "{}", text(&missing.stderr));
    assert!(text(&missing.stderr).contains("d e.bin"), "{}", text(&missing.stderr));
    succeed(here, &["analyze", "run"]);
}

#[test]
fn committed_data_are_explored_without_trouble() {
    for dataset in ["smith_g2", "beckmann_g1"] {
        let output = lgp_here(&["info", &format!("datasets/{dataset}.bin"), "--explore"]);
        assert!(output.status.success(), "{dataset}: {}", text(&output.stderr));
        let page = text(&output.stdout);
        assert!(page.contains("of the variance"), "{page}");
        if dataset == "smith_g2" {
            assert!(page.contains("symmetric in n_dot_l and n_dot_v"), "{page}");
        }
    }
}
