//! `lgp project` on the real command line: data in, parameters and pictures out, what is refused.

#![cfg(feature = "cli")]

mod command;

use command::{command, lgp, succeed, text};
use serde_json::Value;
use std::path::Path;
use std::process::Stdio;
use std::time::{Duration, Instant};
use tempfile::TempDir;

const MODEL: &str = "y = $p*exp2(-$q*x^2)";

/// A folder with the samples of a lobe.
fn lobe(points: &str) -> TempDir {
    let folder = TempDir::new().unwrap();
    let formula = "y = (0.5 + alpha*size)*exp2(-(1 + 8*alpha^2)*x^2)";
    let domain = "x=0..1,alpha=0.1..1,size=0..1";
    let generate = ["generate", "--formula", formula, "--domain", domain, "--points", points];
    succeed(folder.path(), &[&generate[..], &["-o", "lobe.bin"]].concat());
    folder
}

fn project(folder: &Path, options: &[&str]) -> (Option<i32>, String, String) {
    let output = lgp(folder, &[&["project"], options].concat());
    (output.status.code(), text(&output.stdout), text(&output.stderr))
}

/// The words of a command line, as a shell takes them apart.
fn words(line: &str) -> Vec<String> {
    let (mut words, mut word, mut quoted) = (Vec::new(), String::new(), false);
    let mut characters = line.chars();
    while let Some(c) = characters.next() {
        match c {
            '\'' => quoted = !quoted,
            '\\' if !quoted => word.extend(characters.next()),
            ' ' if !quoted => words.push(std::mem::take(&mut word)),
            c => word.push(c),
        }
    }
    assert!(!quoted, "{line}");
    words.push(word);
    words
}

/// Searches for a moment with a command line that was printed.
fn search(folder: &Path, line: &str, generations: &str) -> String {
    let words = words(line);
    assert_eq!(words[0], "lgp");
    let own: Vec<&str> = words[1..].iter().map(String::as_str).collect();
    let brief = ["--generations", generations, "--islands", "2", "--fixed-samples", "--quiet"];
    succeed(folder, &[&own[..], &brief].concat())
}

/// A parameter that matters only far below its start and most of its range is no idle one.
#[test]
fn influence_is_looked_for_on_a_logarithmic_scale() {
    let folder = lobe("8");
    let bounds = ["--bounds", "p=0.1..10,cap=1e-4..1e4", "--log", "cap"];
    let words = ["y = min($p*x, $cap)", "lobe.bin", "--over", "alpha,size", "-o", "params.bin"];
    let (code, _, said) = project(folder.path(), &[&words[..], &bounds].concat());
    assert_eq!(code, Some(0), "{said}");
}

/// A parameter that matters in one column of a grid is no idle one.
#[test]
fn influence_is_looked_for_all_over_a_grid() {
    let folder = lobe("16");
    let model = "y = $p*x + $q*max(size - 0.6, 0)";
    let words = [model, "lobe.bin", "--over", "alpha,size", "-o", "params.bin"];
    let (code, _, said) = project(folder.path(), &words);
    assert_eq!(code, Some(0), "{said}");
}

/// The least RMSE of a front's table.
fn least_rmse(front: &str) -> f64 {
    let member = |line: &str| {
        let mut columns = line.split_whitespace();
        columns.next()?.parse::<usize>().ok()?;
        columns.nth(1)?.parse::<f64>().ok()
    };
    front.lines().filter_map(member).fold(f64::INFINITY, f64::min)
}

#[test]
fn every_command_that_is_printed_runs() {
    let folder = lobe("12");
    let folder = folder.path();
    let given = [MODEL, "lobe.bin", "--over", "alpha,size", "-o", "params.bin", "--json"];
    let (code, found, said) = project(folder, &given);
    assert_eq!(code, Some(0), "{said}");
    let found: Value = serde_json::from_str(&found).unwrap();
    assert_eq!((&found["groups"], &found["grid"]), (&196.into(), &serde_json::json!([14, 14])));
    assert!(!folder.join("params.bin.part").exists());
    let about = succeed(folder, &["info", "params.bin"]);
    assert!(about.contains("grid 14×14") && about.contains("residual"), "{about}");
    let page = std::fs::read_to_string(folder.join("params_report/report.html")).unwrap();
    let lines = found["commands"].as_array().unwrap();
    let lines: Vec<&str> = lines.iter().map(|line| line.as_str().unwrap()).collect();
    for line in &lines {
        assert!(page.contains(&line.replace('\'', "&#x27;")), "{line}");
    }
    let [p, q, both] = lines.as_slice() else { panic!("{lines:?}") };
    // What q hardly depends on is left out.
    assert_eq!(*q, "lgp search params.bin --outputs q --inputs alpha");
    let front = search(folder, &format!("{p} --max-cost 3"), "6");
    assert!(front.contains("p = alpha*size + 0.5"), "{front}");
    assert!(search(folder, q, "1").contains("q = "));
    assert!(both.contains("--template 'y = p(alpha, size)*exp2(-q(alpha)*x^2)'"), "{both}");
    let front = search(folder, both, "1");
    assert!(front.contains("with q(alpha) = "), "{front}");
    // A formula that was found takes the place of a guess.
    let (before, guess) = both.split_once(" --guess ").unwrap();
    assert!(guess.starts_with("'p(alpha, size) = 0."), "{guess}");
    let found = "p(alpha, size) = alpha*size + 0.5; q(alpha) = 8*alpha^2 + 1";
    let front = search(folder, &format!("{before} --guess '{found}'"), "1");
    assert!(least_rmse(&front) < 1e-5, "{front}");
}

#[test]
fn parameters_that_are_constants_stay_constants() {
    let folder = TempDir::new().unwrap();
    let folder = folder.path();
    let formula = "y = alpha*exp2(-3*x^2); z = alpha";
    let data = ["generate", "--formula", formula, "--domain", "x=0..1,alpha=0.1..1", "--points"];
    succeed(folder, &[&data[..], &["12", "-o", "it's.bin"]].concat());
    let given = [MODEL, "it's.bin", "--over", "alpha", "-o", "a b.bin", "--json"];
    let (code, found, said) = project(folder, &given);
    assert_eq!(code, Some(0), "{said}");
    let found: Value = serde_json::from_str(&found).unwrap();
    let said = found["findings"].to_string();
    assert!(said.contains("q may as well be a constant"), "{said}");
    let lines = found["commands"].as_array().unwrap();
    assert_eq!(lines.len(), 2, "{lines:?}");
    assert_eq!(lines[0], "lgp search 'a b.bin' --outputs p");
    let whole = lines[1].as_str().unwrap();
    let rest = "--outputs y --template 'y = p(alpha)*exp2(-$q*x^2)' --guess 'p(alpha) = ";
    assert!(whole.contains(rest) && whole.ends_with("; $q = 3'"), "{whole}");
    search(folder, lines[0].as_str().unwrap(), "1");
    let front = search(folder, whole, "1");
    assert!(front.contains("with $q = "), "{front}");
}

#[test]
fn what_cannot_be_projected_is_refused_with_the_reason() {
    let folder = lobe("6");
    let folder = folder.path();
    let kept = b"nobody writes over this";
    std::fs::write(folder.join("params.bin"), kept).unwrap();
    let data = std::fs::read(folder.join("lobe.bin")).unwrap();
    let refused = |model: &str, options: &[&str], code: i32, reason: &str| {
        let words = [&[model, "lobe.bin", "-o", "params.bin"], options].concat();
        let (found, _, said) = project(folder, &words);
        assert_eq!(found, Some(code), "{words:?}: {said}");
        assert!(said.contains(reason), "{words:?}: {said}");
        assert!(std::fs::read(folder.join("params.bin")).unwrap() == kept, "{words:?}");
        assert!(!folder.join("params_report").exists(), "{words:?}");
    };
    let over = ["--over", "alpha,size"];
    refused(MODEL, &["--over", "alhpa"], 2, "did you mean `alpha`?");
    refused(MODEL, &["--over", "y"], 2, "no input is called so");
    refused(MODEL, &["--over", "x,alpha,size"], 2, "names every input");
    refused(MODEL, &["--over", "alpha,alpha"], 2, "given twice");
    refused(MODEL, &[], 2, "--over");
    refused("y = $p*z", &over, 3, "unknown name `z`");
    refused("w = $p*x", &over, 3, "w");
    refused("y = x^2", &over, 2, "no parameter");
    refused("y = $p*x; z = $q", &over, 2, "");
    refused("t = $q*x; y = $p*x", &over, 2, "no output depends on $q");
    refused("y = $p*x + 0*$q", &over, 3, "no output changes with $q in any group");
    refused("y = $p*f(x, alpha)", &over, 2, "calls f(x, alpha), which it does not define");
    refused("y = $alpha*x", &over, 2, "cannot be called `alpha`");
    refused("y = $residual*x", &over, 2, "cannot be called `residual`");
    refused(MODEL, &["--over", "alpha", "--bounds", "r=0..1"], 2, "no parameter $r");
    refused(MODEL, &["--over", "alpha", "--log", "p"], 2, "$p: -inf to inf has no logarithmic");
    refused(MODEL, &["--over", "alpha", "--smooth", "-1"], 2, "--smooth -1");
    refused(MODEL, &["--over", "alpha", "--loss", "max"], 2, "minimises squares; max is none");
    refused("y = log2(-$p^2 - 1)*x", &over, 3, "finite in too few of the");
    refused("y = $p*f(x); f(a) = f(a)*2", &over, 3, "");
    refused("f(a) = f(a)*2; y = $p*f(x)", &over, 3, "a definition cannot be recursive");
    // What is left of `"y = $p*x"` in a shell.
    refused("y = *x", &over, 2, "in single quotes");
    refused(MODEL, &["--over", "alpha", "--surface", "size=0.5"], 2, "--surface size");
    refused(MODEL, &["--over", "alpha", "--surface", "size"], 2, "");
    refused(MODEL, &["--over", "alpha", "--report", "lobe.bin"], 1, "lobe.bin: cannot be written");
    for (output, code, reason) in [
        ("nowhere/p.bin", 1, "its folder does not exist"),
        ("lobe.bin", 2, "the output would replace the dataset"),
        (".", 1, "cannot be written"),
    ] {
        let (found, _, said) =
            project(folder, &[MODEL, "lobe.bin", "--over", "alpha", "-o", output]);
        assert_eq!(found, Some(code), "{output}: {said}");
        assert!(said.contains(reason), "{output}: {said}");
    }
    assert!(std::fs::read(folder.join("lobe.bin")).unwrap() == data);
    let table: String = (0..40).map(|i| format!("{i},{},{}\n", i * i, 3 * i)).collect();
    std::fs::write(folder.join("t.csv"), format!("a,x,y\n{table}")).unwrap();
    succeed(folder, &["import", "t.csv", "-o", "t.bin", "--inputs", "2"]);
    let words = ["y = $p*x + $q", "t.bin", "--over", "a", "-o", "params.bin"];
    let (code, _, said) = project(folder, &words);
    assert_eq!(code, Some(3), "{said}");
    assert!(
        said.contains(
            "groups have fewer values than the model has parameters (1 at most, 2 needed)"
        )
    );
}

#[cfg(unix)]
#[test]
fn an_interrupted_projection_goes_on_to_the_same_bytes() {
    let folder = lobe("40");
    let folder = folder.path();
    // Enough for a second or so.
    let model = "y = $p*exp2(-$q*x^2) + $r*sin($s*x)";
    let words = [
        "project",
        model,
        "lobe.bin",
        "--over",
        "alpha,size",
        "--bounds",
        "s=0..40",
        "--threads",
        "1",
    ];
    succeed(folder, &[&words[..], &["-o", "whole.bin"]].concat());
    let begun = [&words[..], &["-o", "cut.bin"]].concat();
    let part = folder.join("cut.bin.part");
    let mut process = command(folder, &begun).stderr(Stdio::piped()).spawn().unwrap();
    std::thread::sleep(Duration::from_millis(300));
    let kill =
        std::process::Command::new("kill").args(["-INT", &process.id().to_string()]).status();
    assert!(kill.unwrap().success());
    let waited = Instant::now();
    let status = process.wait().unwrap();
    assert!(waited.elapsed() < Duration::from_secs(20));
    assert_eq!(status.code(), Some(130), "it was too fast to be interrupted");
    assert!(part.is_file() && !folder.join("cut.bin").exists());
    let output = lgp(folder, &begun);
    assert_eq!(output.status.code(), Some(2));
    assert!(text(&output.stderr).contains("--resume goes on with it"), "{}", text(&output.stderr));
    let other = [&begun[..], &["--resume", "--smooth", "1"]].concat();
    let output = lgp(folder, &other);
    assert_eq!(output.status.code(), Some(3), "{}", text(&output.stderr));
    assert!(text(&output.stderr).contains("of another projection"), "{}", text(&output.stderr));
    succeed(folder, &[&begun[..], &["--resume"]].concat());
    assert!(!part.exists());
    let csv = |name: &str| succeed(folder, &["export", name, "-o", &format!("{name}.csv")]);
    csv("whole.bin");
    csv("cut.bin");
    let read = |name: &str| std::fs::read(folder.join(name)).unwrap();
    assert!(read("whole.bin.csv") == read("cut.bin.csv"));
}
