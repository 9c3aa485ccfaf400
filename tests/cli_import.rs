//! `lgp import` and `lgp export` on the command line.

#![cfg(feature = "cli")]

mod command;

use command::{lgp, text};
use serde_json::Value;
use std::io::Write;
use std::path::Path;
use std::process::{Command, Output, Stdio};

const LAB: &str = "Bench 3;;\nWinkel (°);CO(GT);Bemerkung\n0,5;1,25;gut\n0,75;2,5;gut\n";

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("lab.csv"), LAB).unwrap();
    folder
}

fn from_input(folder: &Path, words: &[&str], input: &str) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_lgp"));
    command.current_dir(folder).args(words).stdin(Stdio::piped());
    let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    child.stdin.take().unwrap().write_all(input.as_bytes()).unwrap();
    child.wait_with_output().unwrap()
}

#[test]
fn what_was_understood_is_shown() {
    let folder = folder();
    let said = lgp(folder.path(), &["import", "lab.csv", "-o", "lab.bin"]);
    let shown = text(&said.stdout);
    for part in [
        "lab.bin: winkel → co_gt, 2 search",
        "separator `;`, decimal comma, names in line 2",
        "1 row above the table (line 1)",
        "`Winkel (°)` → winkel in °",
        "column `Bemerkung` left out",
    ] {
        assert!(shown.contains(part), "{part}: {shown}");
    }
    let said = lgp(folder.path(), &["import", "lab.csv", "-o", "lab.bin", "--json"]);
    let json: Value = serde_json::from_slice(&said.stdout).unwrap();
    let understood = &json["understood"];
    assert_eq!((&understood["separator"], &understood["decimal"]), (&";".into(), &"comma".into()));
    assert_eq!(understood["columns"][1]["written"], "CO(GT)");
    assert_eq!(understood["columns"][1]["role"], "output");
    assert!(understood["columns"][2]["role"]["left_out"].as_str().unwrap().contains("gut"));
    let info = text(&lgp(folder.path(), &["info", "lab.bin"]).stdout);
    assert!(info.contains("`CO(GT)` is co_gt"), "{info}");
}

#[test]
fn options_overrule_what_is_found() {
    let folder = folder();
    let words = [
        "import",
        "lab.csv",
        "-o",
        "lab.bin",
        "--json",
        "--separator",
        ";",
        "--decimal",
        ",",
        "--skip",
        "1",
        "--columns",
        "a,b,note",
        "--domain",
        "a=-1..2",
        "--outputs",
        "b",
        "--rows",
        "1",
        "--scale",
        "b=1e3",
    ];
    let said = lgp(folder.path(), &words);
    let json: Value =
        serde_json::from_slice(&said.stdout).unwrap_or_else(|_| panic!("{}", text(&said.stderr)));
    assert_eq!((&json["inputs"][0], &json["outputs"][0]), (&"a".into(), &"b_times_1e3".into()));
    assert_eq!(json["search_rows"], 1);
    let info = lgp(folder.path(), &["info", "lab.bin", "--json"]);
    let info: Value = serde_json::from_slice(&info.stdout).unwrap();
    assert_eq!(info["inputs"][0]["domain"], serde_json::json!([-1.0, 2.0]));
    for (option, value, part) in [
        ("--separator", "ab", "comma, tab, bar or blanks"),
        ("--decimal", "x", "point or comma"),
        ("--domain", "a=2..1", "lower end"),
        ("--domain", "a", "as in x=0..1"),
        ("--scale", "b=3", "as in flux=1e20"),
        ("--rows", "0", "0"),
    ] {
        let said = lgp(folder.path(), &["import", "lab.csv", "-o", "x.bin", option, value]);
        assert_eq!(said.status.code(), Some(2), "{option} {value}");
        assert!(text(&said.stderr).contains(part), "{option} {value}: {}", text(&said.stderr));
    }
}

#[test]
fn standard_input_is_a_table() {
    let folder = folder();
    let said = from_input(folder.path(), &["import", "-", "-o", "piped.bin"], LAB);
    assert!(said.status.success(), "{}", text(&said.stderr));
    let info = text(&lgp(folder.path(), &["info", "piped.bin"]).stdout);
    assert!(info.contains("imported from standard input"), "{info}");
    let said = from_input(folder.path(), &["import", "-", "-o", "x.bin"], "a,b\n1,2\n3,red\n");
    assert_eq!(said.status.code(), Some(3));
    assert!(text(&said.stderr).contains("standard input, line 3"), "{}", text(&said.stderr));
    let log = "n_dot_v;roughness\n0,5;0,25\n0,75;0,25\n";
    let said = from_input(folder.path(), &["scene", "from", "-", "-o", "s.ron"], log);
    assert!(said.status.success(), "{}", text(&said.stderr));
    let scene = std::fs::read_to_string(folder.path().join("s.ron")).unwrap();
    assert!(scene.contains("\"roughness\": 0.25"), "{scene}");
}

#[test]
fn what_is_no_table_by_its_name_is_not_read_as_one() {
    let folder = folder();
    for name in ["curve.spi1d", "warm.cube", "table.inc", "map.exr", "lab.bin"] {
        std::fs::write(folder.path().join(name), "0 0 0\n1 1 1\n").unwrap();
        let said = lgp(folder.path(), &["import", name, "-o", "x.bin"]);
        assert_eq!(said.status.code(), Some(3), "{name}");
        assert!(text(&said.stderr).contains(name), "{}", text(&said.stderr));
        assert!(!folder.path().join("x.bin").exists());
    }
}

#[test]
fn a_dataset_goes_to_a_table_and_back() {
    let folder = folder();
    let here = folder.path();
    let rows: String = (0..40).map(|i| format!("{i},{},{}\n", 0.1 * f64::from(i), i % 3)).collect();
    std::fs::write(here.join("d.csv"), format!("x,y,weight\n{rows}")).unwrap();
    assert!(lgp(here, &["import", "d.csv", "-o", "d.bin"]).status.success());
    let said = lgp(here, &["export", "d.bin", "-o", "back.csv"]);
    assert!(text(&said.stdout).contains("back.csv: 40 rows of d"), "{}", text(&said.stdout));
    let mut lines: Vec<String> = [here.join("back.csv"), here.join("d.csv")]
        .map(|path| std::fs::read_to_string(path).unwrap())
        .map(|text| {
            let mut lines: Vec<&str> = text.lines().collect();
            assert_eq!(lines.remove(0), "x,y,weight");
            let number = |cell: &str| cell.parse::<f32>().unwrap().to_string();
            let row = |line: &str| line.split(',').map(number).collect::<Vec<_>>().join(",");
            let mut rows: Vec<String> = lines.into_iter().map(row).collect();
            rows.sort();
            rows.join("\n")
        })
        .into();
    assert_eq!(lines.pop(), lines.pop());
    let part = lgp(here, &["export", "d.bin", "-o", "part.csv", "--split", "validation", "--json"]);
    let part: Value = serde_json::from_slice(&part.stdout).unwrap();
    assert!((5..15).contains(&part["rows"].as_u64().unwrap()), "{part}");
    std::fs::write(here.join("kept.txt"), "kept").unwrap();
    let said = lgp(here, &["export", "d.bin", "-o", "kept.txt"]);
    assert_eq!(said.status.code(), Some(2));
    assert!(text(&said.stderr).contains("write a .csv"), "{}", text(&said.stderr));
    assert_eq!(std::fs::read_to_string(here.join("kept.txt")).unwrap(), "kept");
    assert_eq!(lgp(here, &["export", "none.bin", "-o", "x.csv"]).status.code(), Some(3));
}
