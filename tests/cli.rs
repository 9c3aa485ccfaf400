//! The command line as a user meets it: exit codes, messages, and files left as they were.

#![cfg(feature = "cli")]

use assert_cmd::Command;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

const USAGE: i32 = 2;
const INPUT: i32 = 3;

/// What a command said.
struct Said {
    code: i32,
    stdout: String,
    stderr: String,
}

impl Said {
    fn json(&self) -> serde_json::Value {
        serde_json::from_str(&self.stdout).unwrap()
    }
}

fn lgp(folder: &Path, arguments: &[&str]) -> Said {
    let mut command = Command::new(env!("CARGO_BIN_EXE_lgp"));
    let output = command.current_dir(folder).args(arguments).output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    let said = Said {
        code: output.status.code().unwrap(),
        stdout: text(output.stdout),
        stderr: text(output.stderr),
    };
    assert!(!said.stderr.contains("panicked"), "{arguments:?}: {}", said.stderr);
    said
}

/// Every file of a folder with its content.
fn files(folder: &Path) -> Vec<(PathBuf, Vec<u8>)> {
    let entries = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let mut files: Vec<_> = entries
        .filter(|path| path.is_file())
        .map(|path| (path.clone(), std::fs::read(&path).unwrap()))
        .collect();
    files.sort();
    files
}

/// Asserts that a command is refused, says all of `expected`, and leaves the folder as it was.
fn assert_refused(folder: &Path, arguments: &[&str], code: i32, expected: &[&str]) {
    let before = files(folder);
    let said = lgp(folder, arguments);
    assert_eq!(said.code, code, "{arguments:?}: {}", said.stderr);
    assert!(said.stderr.starts_with("error: "), "{arguments:?}: {}", said.stderr);
    assert_eq!(said.stdout, "", "{arguments:?}");
    for expected in expected {
        assert!(said.stderr.contains(expected), "{arguments:?}: {}", said.stderr);
    }
    assert!(files(folder) == before, "{arguments:?} changed the folder");
}

fn folder_with(files: &[(&str, &[u8])]) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, content) in files {
        std::fs::write(folder.path().join(name), content).unwrap();
    }
    folder
}

fn committed(file: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("datasets").join(file)
}

#[test]
fn unusable_tables_are_refused() {
    let cases: [(&str, &str, &[&str]); 7] = [
        ("", "2", &["the file is empty"]),
        ("a,b\n1,2\n1,two\n", "1", &["line 3", "column `b`", "`two` is not a number"]),
        ("a,b\n1,2\n1,NaN\n", "1", &["line 3", "column `b`", "not finite"]),
        ("a,b\n1,2\n1,2,3\n", "1", &["line 3"]),
        ("a,b\n1,2\n", "2", &["ask for fewer"]),
        ("alpha,b\n1,2\n", "alhpa", &["no column is called `alhpa`", "did you mean `alpha`?"]),
        ("a,b\n", "1", &["table.csv"]),
    ];
    for (table, inputs, expected) in cases {
        let folder = folder_with(&[("table.csv", table.as_bytes()), ("old.bin", b"kept")]);
        let arguments = ["import", "table.csv", "-o", "old.bin", "--inputs", inputs];
        assert_refused(folder.path(), &arguments, INPUT, &["table.csv"]);
        assert_refused(folder.path(), &arguments, INPUT, expected);
    }
}

#[test]
fn unusable_datasets_are_refused() {
    let whole = std::fs::read(committed("dfg.bin")).unwrap();
    let mut flipped = whole.clone();
    flipped[whole.len() / 2] ^= 4;
    let mut other = whole.clone();
    other[0] = b'X';
    let folder = folder_with(&[
        ("empty.bin", b""),
        ("short.bin", &whole[..whole.len() - 1000]),
        ("flipped.bin", &flipped),
        ("other.bin", &other),
    ]);
    let cases = [
        ("missing.bin", "no such file"),
        ("empty.bin", "the file is empty"),
        ("short.bin", "truncated"),
        ("flipped.bin", "damaged"),
        ("other.bin", "not an lgp dataset"),
        (".", "cannot be read"),
    ];
    for (file, expected) in cases {
        assert_refused(folder.path(), &["info", file], INPUT, &[file, expected]);
        assert_refused(folder.path(), &["info", file, "--json"], INPUT, &[file, expected]);
    }
}

#[test]
fn wrong_command_lines_are_refused() {
    let folder = folder_with(&[("table.csv", b"a,b\n1,2\n"), ("dfg.bin", b"kept")]);
    let cases: [(&[&str], &str); 11] = [
        (&["generate", "dgf"], "did you mean `dfg`?"),
        (&["generate", "dfg", "--set", "point=8"], "did you mean `points`?"),
        (&["generate", "dfg", "--set", "points=one"], "a whole number from 2 to 1024"),
        (&["generate", "dfg", "--set", "masking=seperable"], "did you mean `separable`?"),
        (&["generate", "dfg", "--set", "points"], "as in points=32"),
        (&["generate", "dfg", "--threads", "0"], "1..=1024"),
        (&["import", "table.csv", "-o", "x.bin", "--inputs", "0"], "at least one input"),
        (&["import", "table.csv", "-o", "x.bin", "--inputs", "a,,b"], "a name is empty"),
        (&["import", "table.csv", "-o", "table.csv", "--inputs", "1"], "replace the table"),
        (&["info"], "<DATASET>"),
        (&["lisst"], "'list'"),
    ];
    for (arguments, expected) in cases {
        assert_refused(folder.path(), arguments, USAGE, &[expected]);
    }
}

#[test]
fn unusable_recipes_are_refused() {
    let folder = folder_with(&[("r.ron", b"(target: \"dfg\",\n points: )"), ("r.bin", b"kept")]);
    assert_refused(folder.path(), &["generate", "r.ron"], INPUT, &["r.ron", "line 2"]);
    assert_refused(folder.path(), &["generate", "no.ron"], INPUT, &["no.ron", "cannot be read"]);
}

#[test]
fn outputs_that_cannot_be_written_are_refused_before_anything_is_computed() {
    let folder = folder_with(&[("table.csv", b"a,b\n1,2\n"), ("file", b"kept")]);
    std::fs::create_dir(folder.path().join("taken")).unwrap();
    for output in ["file/x.bin", "nowhere/x.bin", "taken"] {
        let start = std::time::Instant::now();
        let generate = ["generate", "dfg", "--set", "points=1024", "-o", output];
        assert_refused(folder.path(), &generate, 1, &[output, "cannot be written"]);
        assert!(start.elapsed().as_secs() < 5, "computed first");
        let import = ["import", "table.csv", "-o", output, "--inputs", "1"];
        assert_refused(folder.path(), &import, 1, &[output, "cannot be written"]);
    }
}

#[test]
fn a_table_with_columns_called_like_operations_is_imported() {
    let folder = folder_with(&[("table.csv", b"cos,lambda,half\n1,2,-3\n4,5,6.5\n")]);
    let import = ["import", "table.csv", "-o", "made.bin", "--inputs", "cos,lambda"];
    let said = lgp(folder.path(), &import);
    assert_eq!((said.code, said.stderr.as_str()), (0, ""));
    assert_eq!(said.stdout.lines().count(), 1);
    let said = lgp(folder.path(), &["info", "made.bin"]);
    assert_eq!(said.code, 0);
    for expected in ["made.bin", "cos", "lambda", "half", "2 rows", "-3 … 6.5", "1.75", "table.csv"]
    {
        assert!(said.stdout.contains(expected), "{expected}: {}", said.stdout);
    }
    let info = lgp(folder.path(), &["info", "made.bin", "--json"]).json();
    assert_eq!(info["name"], "made");
    assert_eq!(info["inputs"][1]["name"], "lambda");
    assert_eq!(info["outputs"][0]["search"]["mean"], 1.75);
    assert_eq!(info["search"]["rows"], 2);
    let json = lgp(folder.path(), &[&import[..], &["--json"]].concat());
    assert_eq!(json.json()["outputs"][0], "half");
    assert_eq!(lgp(folder.path(), &[&import[..], &["--quiet"]].concat()).stdout, "");
}

#[test]
fn a_target_is_generated() {
    let folder = folder_with(&[("small.ron", b"(target: \"dfg\", points: 64)")]);
    let generate = ["generate", "dfg", "--set", "points=8", "-o", "x.bin"];
    let said = lgp(folder.path(), &generate);
    assert_eq!((said.code, said.stderr.as_str()), (0, ""));
    assert!(said.stdout.starts_with("x.bin: 64 search"), "{}", said.stdout);
    assert!(said.stdout.contains("estimated error below"), "{}", said.stdout);
    let info = lgp(folder.path(), &["info", "x.bin", "--json"]).json();
    assert_eq!((&info["name"], &info["search"]["grid"][1]), (&"x".into(), &8.into()));
    // A recipe's dataset is called like the recipe; options change its parameters.
    let recipe = lgp(folder.path(), &["generate", "small.ron", "--set", "points=8", "--json"]);
    assert_eq!(recipe.code, 0, "{}", recipe.stderr);
    let made = recipe.json();
    assert_eq!((&made["dataset"], &made["path"]), (&"small".into(), &"small.bin".into()));
    assert_eq!(made["recipe"], info["recipe"]);
    assert_eq!(files(folder.path()).len(), 3, "temporaries are left");
}

#[test]
fn list_shows_what_there_is() {
    let empty = tempfile::tempdir().unwrap();
    let said = lgp(empty.path(), &["list"]);
    assert_eq!(said.code, 0);
    assert!(said.stdout.contains("dfg  split-integral"), "{}", said.stdout);
    assert!(said.stdout.contains("none in ./datasets"), "{}", said.stdout);
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let list = lgp(here, &["list", "--json"]).json();
    assert_eq!(list["targets"][0]["parameters"][2]["name"], "points");
    let datasets = list["datasets"].as_array().unwrap();
    assert!(datasets.iter().any(|dataset| dataset["path"] == "datasets/dfg.bin"));
    assert_eq!(list["incumbents"][0]["usable"], true);
}

#[test]
fn flat_regions_are_pruned_where_asked_for() {
    let table: String = (0..256)
        .map(|k| {
            let x = f64::from(k) / 256.0;
            format!("{x},{}\n", (x - 0.75).max(0.0))
        })
        .collect();
    let folder = folder_with(&[("ramp.csv", format!("x,y\n{table}").as_bytes())]);
    let arguments = |more: &[&'static str]| {
        let mut all = vec!["import", "ramp.csv", "-o", "ramp.bin", "--inputs", "1", "--json"];
        all.extend(more);
        all
    };
    let all = lgp(folder.path(), &arguments(&[])).json();
    let pruned = lgp(folder.path(), &arguments(&["--prune", "0.05"])).json();
    let rows = |made: &serde_json::Value, split: &str| made[split].as_u64().unwrap();
    assert!(4 * rows(&pruned, "search_rows") < rows(&all, "search_rows"), "{pruned}");
    assert_eq!(rows(&pruned, "validation_rows"), rows(&all, "validation_rows"));
    let info = lgp(folder.path(), &["info", "ramp.bin"]);
    assert!(info.stdout.contains("pruned at 0.05"), "{}", info.stdout);
    let made = ["generate", "disney_zh", "--set", "points=8", "--prune", "0.1", "--json"];
    assert!(rows(&lgp(folder.path(), &made).json(), "search_rows") < 64);
    for share in ["1", "-0.1", "a", "nan"] {
        let prune = format!("--prune={share}");
        let arguments = ["import", "ramp.csv", "-o", "no.bin", "--inputs", "1", &prune];
        assert_refused(folder.path(), &arguments, USAGE, &["as in 0.01"]);
    }
}

#[test]
fn a_broken_dataset_is_listed_as_such() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("datasets")).unwrap();
    std::fs::write(folder.path().join("datasets/bad.bin"), "LGPDATA1").unwrap();
    let said = lgp(folder.path(), &["list"]);
    assert_eq!(said.code, 0);
    assert!(said.stdout.contains("unusable: datasets/bad.bin: truncated"), "{}", said.stdout);
}

#[test]
fn help_can_be_acted_on() {
    let folder = tempfile::tempdir().unwrap();
    let help = lgp(folder.path(), &["--help"]);
    assert_eq!(help.code, 0);
    for expected in ["lgp list", "lgp generate dfg", "lgp import", "Exit codes"] {
        assert!(help.stdout.contains(expected), "{}", help.stdout);
    }
    assert!(help.stdout.lines().all(|line| line.chars().count() <= 100), "{}", help.stdout);
    assert_eq!(lgp(folder.path(), &[]).code, USAGE);
}

/// The reader of a pipe may go away at any time.
#[cfg(unix)]
#[test]
fn a_closed_pipe_is_no_failure() {
    use std::process::{Command, Stdio};
    for arguments in [&["list"][..], &["list", "--json"], &["--help"]] {
        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        let mut command = Command::new(env!("CARGO_BIN_EXE_lgp"));
        let output = command.args(arguments).stdout(writer).stderr(Stdio::piped()).output();
        let output = output.unwrap();
        assert_eq!(output.status.code(), Some(0), "{arguments:?}");
        assert!(output.stderr.is_empty(), "{arguments:?}");
    }
}
