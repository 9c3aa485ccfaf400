//! Functions as data on the real command line: formulas, and functions of shaders.

#![cfg(feature = "cli")]

mod command;

use command::{lgp, succeed, text};
use lgp::dataset::Dataset;
use serde_json::Value;
use std::path::Path;

/// A Bessel function by its series.
const SERIES: &str = "float bessel_j0(float x) {
    float term = 1.0;
    float sum = 1.0;
    for (int k = 1; k <= 12; ++k) {
        term *= -0.25*x*x/float(k*k);
        sum += term;
    }
    return sum;
}
";

fn folder_with(files: &[(&str, &str)]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, content) in files {
        std::fs::write(folder.path().join(name), content).unwrap();
    }
    folder
}

/// What a command that must fail with this code says.
fn refusal(folder: &Path, code: i32, args: &[&str]) -> String {
    let output = lgp(folder, args);
    let said = text(&output.stderr);
    assert_eq!(output.status.code(), Some(code), "{args:?}: {said}");
    said
}

fn kept_data(folder: &Path) -> Vec<std::path::PathBuf> {
    let files = folder.read_dir().unwrap().map(|file| file.unwrap().path());
    let is_data = |path: &std::path::PathBuf| {
        path.file_name().unwrap().to_string_lossy().starts_with("data-")
    };
    files.filter(is_data).collect()
}

#[test]
fn a_shader_is_approximated_and_stands_beside_the_front() {
    let folder = folder_with(&[("series.glsl", SERIES)]);
    let front = succeed(
        folder.path(),
        &["search", "series.glsl", "--domain", "x=0..3", "--generations", "3", "--out", "run"],
    );
    let lines: Vec<&str> = front.lines().collect();
    let place = lines.iter().position(|line| line.contains("original: not dominated"));
    let place = place.unwrap_or_else(|| panic!("{front}"));
    // −¼x² once, then two products and a sum for each term; rounding alone is its error.
    let numbers: Vec<&str> = lines[place - 1].split_whitespace().collect();
    let (cycles, rmse): (f64, f64) = (numbers[1].parse().unwrap(), numbers[2].parse().unwrap());
    assert!((30.0..=40.0).contains(&cycles) && rmse < 1e-6, "{front}");
    let members: Value =
        serde_json::from_str(&succeed(folder.path(), &["front", "run", "--json"])).unwrap();
    let is_cheaper = |member: &Value| {
        member["cost"].as_f64().unwrap() < cycles / 4.0 && member["rmse"].as_f64().unwrap() < 1e-3
    };
    assert!(members.as_array().unwrap().iter().any(is_cheaper), "{front}");
    // All is in the folder: neither the shader nor the path to it is needed.
    std::fs::remove_file(folder.path().join("series.glsl")).unwrap();
    std::fs::rename(folder.path().join("run"), folder.path().join("moved")).unwrap();
    succeed(folder.path(), &["report", "moved"]);
    let page = std::fs::read_to_string(folder.path().join("moved/report.html")).unwrap();
    assert!(page.contains("original"), "the original is on the page");
    let more = ["search", "--resume", "--out", "moved", "--generations", "4"];
    succeed(folder.path(), &more);
}

#[test]
fn a_formula_is_sampled_in_double_precision() {
    let folder = folder_with(&[]);
    // In f32 the difference is 0 or 2^-24 for small x.
    let formula = "y = (1 - cos(x))/(x*x); z = 2*y + 0.1";
    let domain = "x=1e-4..1:log";
    let made = ["generate", "--formula", formula, "--domain", domain, "--points", "64", "-o"];
    succeed(folder.path(), &[&made[..], &["z.bin"]].concat());
    let data = Dataset::load(&folder.path().join("z.bin")).unwrap();
    // Only what no other statement reads is an output.
    assert_eq!(data.names().outputs, ["z"]);
    // 64 centres, the ends, and points that come nearer to each by halves, from 2^-8 to 2^-24.
    assert_eq!(data.search.rows(), 64 + 2 + 2 * 17);
    let [x, z] = [0, 1].map(|column| &data.search.columns[column]);
    for (&x, &z) in x.iter().zip(z) {
        let half = f64::from(x) * 0.5;
        let exact = 0.1 + (half.sin() / half).powi(2);
        assert!((f64::from(z) - exact).abs() < 1e-7, "{x}: {z} {exact}");
    }
    let centres = &x[18..82];
    let ratio = centres[1] / centres[0];
    assert!(centres.windows(2).all(|pair| (pair[1] / pair[0] / ratio - 1.0).abs() < 1e-4));
    let info = succeed(folder.path(), &["info", "z.bin"]);
    assert!(info.contains("over x=0.0001..1.0:log"), "{info}");
}

#[test]
fn the_error_against_a_formula_is_proved() {
    let folder = folder_with(&[]);
    let search = ["search", "--formula", "y = exp2(x)", "--domain", "x=0..1", "--loss", "max"];
    let front =
        succeed(folder.path(), &[&search[..], &["--generations", "3", "--out", "run"]].concat());
    assert!(front.contains("|y - truth| <= "), "{front}");
    let members: Value =
        serde_json::from_str(&succeed(folder.path(), &["front", "run", "--json"])).unwrap();
    for member in members.as_array().unwrap() {
        let error = &member["verdict"]["truth"][0];
        let [proved, seen] = ["most", "seen"].map(|key| error[key].as_f64().unwrap());
        let shown = member["max_error"].as_f64().unwrap();
        assert!(seen <= proved && shown <= proved * 1.0001, "{member}");
        // Rounding is a part of the bound.
        assert!(proved < 1.05 * seen.max(shown) + 3e-7, "{member}");
    }
    let checked = succeed(folder.path(), &["check", "run"]);
    assert!(checked.contains("|y − truth| ≤ "), "{checked}");
    // Hastings' polynomial errs by 6.75e-5.
    let hastings = "y = sqrt(1 - x)*(1.5707288 + x*(-0.2121144 + x*(0.0742610 - 0.0187293*x)))";
    let check = |error: &str| {
        let args =
            ["check", hastings, "--truth", "acos(x)", "--domain", "x=0..1", "--max-error", error];
        lgp(folder.path(), &args)
    };
    assert_eq!(check("7e-5").status.code(), Some(0));
    assert_eq!(check("6.7e-5").status.code(), Some(4));
    assert!(text(&check("6.7e-5").stderr).contains("|y − truth| ≤ 6.7"));
}

#[test]
fn functions_are_compared_with_each_other() {
    let square = "fn square(x: f32) -> f32 { return x*x; }";
    let sum = "fn by_odd_numbers(x: f32) -> f32 {
    var sum = 0.0;
    for (var i = 0; i < 4; i++) { sum += (2.0*f32(i) + 1.0)*x*x/16.0; }
    return sum;
}";
    let folder = folder_with(&[("a.wgsl", square), ("b.wgsl", sum)]);
    let against = ["verify", "b.wgsl", "--against", "a.wgsl", "--domain", "x=0..4"];
    succeed(folder.path(), &[&against[..], &["--max-error", "1e-5"]].concat());
    let formula = ["verify", "b.wgsl", "--formula", "y = 1.01*x*x", "--domain", "x=0..4"];
    let said = refusal(folder.path(), 4, &[&formula[..], &["--max-error", "1e-3"]].concat());
    assert!(said.contains("RMSE"), "{said}");
}

#[test]
fn what_is_missing_is_said_with_what_to_do() {
    let uniform = "uniform float exposure;
uniform sampler2D ramp;
float shaded(float x) { return exposure*x; }
float looked_up(float x) { return texture(ramp, vec2(x)).r; }
";
    let folder = folder_with(&[("s.glsl", SERIES), ("u.frag", uniform)]);
    let refusal = |code, args: &[&str]| refusal(folder.path(), code, args);
    for (code, args, reason) in [
        (2, &["search", "s.glsl"][..], "--domain x=0..1"),
        (2, &["search", "s.glsl", "--domain", "t=0..1"], "the inputs are x"),
        (2, &["search", "s.glsl", "--domain", "x=1..0"], "lower end first"),
        (2, &["search", "--formula", "y = x", "--domain", "x=0..1", "--set", "a=1"], "--set"),
        (2, &["search", "s.glsl", "--formula", "y = x", "--domain", "x=0..1"], "not both"),
        (3, &["search", "--formula", "y = log(x)", "--domain", "x=0..1"], "choose a --domain"),
        (3, &["search", "--formula", "y = log(x", "--domain", "x=0..1"], "column 10"),
        (3, &["search", "--formula", "y = $a*x", "--domain", "x=0..1"], "free constant"),
        (3, &["search", "u.frag", "--domain", "x=0..1"], "sampler2D"),
        (3, &["search", "s.glsl", "--entry", "bessel", "--domain", "x=0..1"], "bessel_j0"),
    ] {
        let said = refusal(code, args);
        assert!(said.contains(reason), "{args:?}: {said}");
    }
    assert!(!folder.path().join("runs").exists(), "what is refused leaves nothing");
}

#[test]
fn a_run_that_replaces_another_leaves_none_of_its_data() {
    let folder = folder_with(&[]);
    let search = |domain: &str, more: &[&str]| {
        let args = ["search", "--formula", "y = x*x", "--domain", domain, "--out", "run"];
        succeed(folder.path(), &[&args[..], &["--generations", "1"], more].concat());
    };
    search("x=0..1", &[]);
    let first = kept_data(&folder.path().join("run"));
    search("x=0..2", &["--force"]);
    let second = kept_data(&folder.path().join("run"));
    assert_eq!((first.len(), second.len()), (1, 1));
    assert_ne!(first, second);
    succeed(folder.path(), &["check", "run"]);
}
