//! `lgp verify` on the real command line: snippets as they are, and with what can go wrong in them.

#![cfg(feature = "cli")]

mod command;

use command::{command, succeed, text};
use lgp::dataset::Dataset;
use lgp::emit::{Language, language_of, read_back};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::Output;

fn repository() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn data() -> PathBuf {
    repository().join("datasets/dfg.bin")
}

fn verify(snippet: &Path, max_error: &str, more: &[&str]) -> Output {
    let mut command = command(repository(), &["verify"]);
    command.args([snippet, &data()]).args(["--max-error", max_error]).args(more);
    command.output().expect("it runs")
}

/// Some members of a front in each language that can be read back, each in a file of the folder.
fn snippets(folder: &Path) -> Vec<(PathBuf, String)> {
    let mut found = Vec::new();
    for (i, language) in Language::ALL.iter().enumerate() {
        for pick in (2 + i % 9..=30).step_by(4) {
            let picked = ["--pick", &pick.to_string()];
            let code = emitted("tests/fixtures/dfg", language.name(), &picked);
            let path = folder.join(format!("{pick}.{}", language.extension()));
            std::fs::write(&path, &code).unwrap();
            found.push((path, code));
        }
    }
    found
}

/// What its header says of its RMSE.
fn stated_rmse(snippet: &str) -> f64 {
    let (_, rest) = snippet.split_once("error: RMSE ").unwrap();
    rest.split(',').next().unwrap().parse().unwrap()
}

#[test]
fn snippets_keep_their_word() {
    let folder = tempfile::tempdir().unwrap();
    for (path, snippet) in &snippets(folder.path()) {
        let stated = stated_rmse(snippet);
        let output = verify(path, &(stated + 6e-6).to_string(), &["--json"]);
        assert_eq!(output.status.code(), Some(0), "{path:?}: {}", text(&output.stderr));
        let verified: Value = serde_json::from_slice(&output.stdout).unwrap();
        assert_eq!(verified["met"], true);
        assert_eq!(verified["as_commented"], true);
        assert!((verified["rmse"].as_f64().unwrap() - stated).abs() < 6e-6, "{path:?}");
        if stated > 2e-5 {
            let output = verify(path, &(stated - 1e-5).to_string(), &["--quiet"]);
            assert_eq!(output.status.code(), Some(4), "{path:?}");
            assert!(text(&output.stderr).contains("RMSE"), "{}", text(&output.stderr));
        }
    }
}

/// Where the digits of each constant of the code stand. Numbers in names are none, nor are the bounds of
/// GLSL's and WGSL's saturation, `clamp(x, 0.0, 1.0)`: where it only ever clamps at one, the other is
/// without effect.
fn constants(code: &str) -> Vec<std::ops::Range<usize>> {
    let bytes = code.as_bytes();
    let belongs = |b: u8| b.is_ascii_alphanumeric() || b == b'_' || b == b'.';
    let mut found = Vec::new();
    let bounds = ", 0.0, 1.0)";
    let saturations: Vec<usize> = code.match_indices(bounds).map(|(start, _)| start).collect();
    let is_bound =
        |at: usize| saturations.iter().any(|&start| (start..start + bounds.len()).contains(&at));
    let mut at = 0;
    while at < bytes.len() {
        let end = at + bytes[at..].iter().take_while(|&&b| belongs(b)).count();
        if end > at && bytes[at].is_ascii_digit() && code[at..end].contains('.') && !is_bound(at) {
            found.push(at..end);
        }
        at = end.max(at + 1);
    }
    found
}

/// The constant with its third significant digit changed, or one appended where it has fewer.
fn mutated(constant: &str) -> String {
    let mut digits = 0;
    let mut changed = constant.to_owned();
    for (i, c) in constant.char_indices().filter(|(_, c)| *c != '.') {
        if digits == 0 && c == '0' {
            continue;
        }
        digits += 1;
        if digits == 3 {
            let digit = if c == '9' { '8' } else { char::from(c as u8 + 1) };
            changed.replace_range(i..=i, &digit.to_string());
            return changed;
        }
    }
    // 1.0 → 1.01, 0.5 → 0.501
    changed.push_str(if digits == 2 { "1" } else { "01" });
    changed
}

#[test]
fn digits_are_counted_from_the_first_that_is_not_zero() {
    for (constant, expected) in [
        ("1.234", "1.244"),
        ("0.0199", "0.0198"),
        ("12.38", "12.48"),
        ("0.51", "0.511"),
        ("1.0", "1.01"),
        ("0.5", "0.501"),
        ("147.0", "148.0"),
    ] {
        assert_eq!(mutated(constant), expected);
    }
    assert_eq!(constants("const float t0 = 1.5*x2 - 0.25;"), [17..20, 26..30]);
}

/// Every constant of some snippets in each language: what is read back with its third digit changed must
/// be told from the original. In the library, since there are hundreds.
#[test]
fn a_constant_changed_in_its_third_digit_is_caught() {
    let (mut tried, mut on_the_command_line) = (0, 0);
    let dataset = Dataset::load(&data()).unwrap();
    let folder = tempfile::tempdir().unwrap();
    for (path, snippet) in snippets(folder.path()) {
        let language = language_of(&path).unwrap();
        // Others spell a saturation by numbers that need not matter.
        if !language.has_halves() || language == Language::Cuda {
            continue;
        }
        let original = read_back(language, &snippet).unwrap();
        let body = snippet.find("{\n").unwrap();
        for range in constants(&snippet[body..]) {
            let range = range.start + body..range.end + body;
            let mut changed = snippet.clone();
            changed.replace_range(range.clone(), &mutated(&snippet[range.clone()]));
            let program = read_back(language, &changed).unwrap();
            let columns = &dataset.search.columns;
            let differs = (0..dataset.search.rows()).any(|row| {
                let sample = [columns[0][row], columns[1][row]];
                let values = program.evaluate(&sample).into_iter().zip(original.evaluate(&sample));
                values.into_iter().any(|(a, b)| a != b)
            });
            assert!(differs, "{path:?}: {} makes no difference", &snippet[range]);
            tried += 1;
            if tried % 97 == 0 {
                let file = folder.path().join(path.file_name().unwrap());
                std::fs::write(&file, &changed).unwrap();
                let output = verify(&file, "1", &[]);
                assert_eq!(output.status.code(), Some(4), "{changed}");
                assert!(
                    text(&output.stderr).contains("does not compute the formula in its comment")
                );
                on_the_command_line += 1;
            }
        }
    }
    assert!(tried > 500 && on_the_command_line > 5, "{tried}, {on_the_command_line}");
}

/// A saturation that has become another clamp is read, and found wrong.
#[test]
fn a_clamp_may_have_any_bounds() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["a.glsl", "b.hlsl"] {
        let file = folder.path().join(name);
        let comment = "// bias = min(max(roughness, 0.25), 0.75)\n";
        let code = format!(
            "{comment}float f(float roughness) {{\n    float bias = clamp(roughness, 0.25, 0.75);\n    return bias;\n}}\n"
        );
        std::fs::write(&file, &code).unwrap();
        let output = verify(&file, "1", &[]);
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
        std::fs::write(&file, code.replace("0.25, 0.75);", "0.0, 0.75);")).unwrap();
        assert_eq!(verify(&file, "1", &[]).status.code(), Some(4));
    }
}

fn emitted(run: &str, language: &str, more: &[&str]) -> String {
    succeed(repository(), &[&["emit", run, "--lang", language][..], more].concat())
}

const LANGUAGES: [(&str, &str); 4] =
    [("hlsl", "hlsl"), ("wgsl", "wgsl"), ("glsl", "glsl"), ("msl", "metal")];

/// Whatever `emit` writes is read in its precision, and is its formula; in halves, too, a number
/// that is another half, or another single where it meets singles, is not.
#[test]
fn every_precision_is_verified() {
    let folder = tempfile::tempdir().unwrap();
    let mut caught = 0;
    for (language, extension) in LANGUAGES {
        for more in [&["--half"][..], &["--half-error", "0.004"], &[]] {
            let file = folder.path().join(format!("a.{extension}"));
            let code = emitted("tests/fixtures/dfg", language, &[&["--pick", "9"], more].concat());
            assert!(code.contains("// formula: "), "{code}");
            std::fs::write(&file, &code).unwrap();
            let output = verify(&file, "0.1", &["--json"]);
            assert_eq!(output.status.code(), Some(0), "{code}{}", text(&output.stderr));
            let verified: Value = serde_json::from_slice(&output.stdout).unwrap();
            assert_eq!(verified["as_commented"], true);
            assert_eq!(verified["half"], !more.is_empty());
            if !more.is_empty() {
                caught += numbers_of_halves_caught(language, &code);
            }
        }
    }
    assert!(caught > 40, "{caught}");
}

fn numbers_of_halves_caught(language: &str, code: &str) -> usize {
    let language = Language::from_name(language).unwrap();
    let original = read_back(language, code).unwrap();
    let formula = original.stated(&original.names.outputs).unwrap().expect("a formula").program;
    assert!(original.is(&formula));
    let body = code.find("{\n").unwrap();
    let mut caught = 0;
    for range in constants(&code[body..]) {
        let range = range.start + body..range.end + body;
        let digits = code[range.clone()].trim_end_matches(['h', 'f']);
        let suffix = &code[range.clone()][digits.len()..];
        let mut changed = code.to_owned();
        changed.replace_range(range.clone(), &(mutated(digits) + suffix));
        let half = |digits: &str| half::f16::from_f32(digits.parse().unwrap());
        let seen = suffix.is_empty() || half(&mutated(digits)) != half(digits);
        let is = read_back(language, &changed).unwrap().is(&formula);
        assert_eq!(!is, seen, "{changed}");
        caught += usize::from(seen);
    }
    caught
}

/// No change of the line with the formula makes it a line like any other.
#[test]
fn a_formula_in_a_comment_is_never_passed_over() {
    let code = emitted("tests/fixtures/dfg", "hlsl", &["--pick", "9"]);
    let read = |code: &str| read_back(Language::Hlsl, code).unwrap();
    let outputs = read(&code).names.outputs;
    let start = code.find("formula:").unwrap();
    let end = start + code[start..].find('\n').unwrap();
    let (mut refused, mut told) = (0, 0);
    let original = read(&code).stated(&outputs).unwrap().unwrap().program;
    for at in start..end {
        for other in ["", "q", "1", " ", "=", "*", ")"] {
            let mut changed = code.clone();
            changed.replace_range(at..=at, other);
            match read(&changed).stated(&outputs) {
                Err(_) => refused += 1,
                Ok(None) => panic!("passed over: {}", &changed[start..end]),
                Ok(Some(stated)) => told += usize::from(stated.program != original),
            }
        }
    }
    assert!(refused > 100 && told > 100, "{refused} {told}");
}

#[test]
fn comments_are_held_to_what_they_say() {
    let folder = tempfile::tempdir().unwrap();
    let formula = "bias = exp2(-(7*n_dot_v + 4*roughness^2))";
    for (comment, code, expected) in [
        (format!("// formula: {formula}"), 0, ""),
        (format!("// {formula}"), 0, ""),
        (format!("/* {formula} */"), 0, ""),
        (format!("/*\n * formula: {formula}\n */"), 0, ""),
        ("// for bias = high roughness".to_owned(), 3, "line 1: a comment gives `bias` a value"),
        (format!("// {formula} (paper)"), 3, "line 1: a comment gives `bias` a value"),
        (format!("// {formula}\n// was: bias = 1"), 3, "line 2: a comment gives `bias` a value"),
        (format!("// {formula}\n// bias = 1"), 3, "lines 1 and 2 are both the formula"),
        (format!("// formula: {formula}\n// bias = 1"), 0, ""),
        (format!("// formula: {formula}\n// formula: {formula}"), 3, "lines 1 and 2 are both"),
        (format!("// formula: {formula})"), 3, "line 1: the formula in the comment cannot be read"),
        ("// formula:".to_owned(), 3, "line 1: the formula in the comment cannot be read"),
        (format!("// formula: {}", formula.replace('7', "7.5")), 4, "(line 1)"),
        (format!("// {}", formula.replace('7', "7.5")), 4, "(line 1)"),
    ] {
        let file = folder.path().join("bias.glsl");
        std::fs::write(&file, format!("{comment}\n{BIAS}")).unwrap();
        let output = verify(&file, "0.07", &[]);
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(code), "{comment}: {message}");
        assert!(message.contains(expected), "{comment}: {message}");
    }
}

/// Integer division, a type of integers, a line that continues a comment.
#[test]
fn what_a_compiler_would_read_otherwise_is_refused_with_its_line() {
    let folder = tempfile::tempdir().unwrap();
    let code = BIAS.replace("return", "float bias =").replace("}", "    return bias;\n}");
    for (changed, expected) in [
        (code.replace("4.0", "(19/5)"), "line 2, column"),
        (code.replace("float bias", "int bias"), "line 2, column 5: `int` cannot be"),
        (code.replace("    float bias", "    // note \\\n    float bias"), "line 2, column"),
        (format!("#define bias other\n{code}"), "line 1, column 1"),
        (code.replace("    return", "    float bias = 1.0;\n    return"), "line 3, column 11"),
    ] {
        let file = folder.path().join("bias.hlsl");
        std::fs::write(&file, &changed).unwrap();
        let output = verify(&file, "9", &[]);
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(3), "{changed}: {message}");
        assert!(message.contains("bias.hlsl") && message.contains(expected), "{message}");
        assert!(output.stdout.is_empty());
    }
    let endless = folder.path().join("zero.hlsl");
    std::os::unix::fs::symlink("/dev/zero", &endless).unwrap();
    let output = verify(&endless, "1", &[]);
    assert_eq!(output.status.code(), Some(3));
    assert!(text(&output.stderr).contains("1 MiB"), "{}", text(&output.stderr));
}

const BIAS: &str = "float dfg_bias(float n_dot_v, float roughness) {
    return exp2(-(7.0*n_dot_v + 4.0*(roughness*roughness)));
}
";

#[test]
fn a_function_of_ones_own_is_verified() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| {
        let file = folder.path().join(name);
        std::fs::write(&file, text).unwrap();
        file
    };
    let glsl = write("bias.glsl", BIAS);
    let output = verify(&glsl, "0.07", &["--json"]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let verified: Value = serde_json::from_slice(&output.stdout).unwrap();
    // The reference page's figures for this formula.
    assert!((verified["rmse"].as_f64().unwrap() - 0.065).abs() < 5e-4);
    assert!((verified["max_error"].as_f64().unwrap() - 0.346).abs() < 5e-4);
    assert!(verified["as_commented"].is_null());
    let called_f = write("f.hlsl", &BIAS.replace("dfg_bias", "f"));
    let output = verify(&called_f, "0.07", &[]);
    assert_eq!(output.status.code(), Some(3));
    assert!(text(&output.stderr).contains("--outputs"), "{}", text(&output.stderr));
    assert_eq!(verify(&called_f, "0.07", &["--outputs", "bias"]).status.code(), Some(0));
    assert_eq!(verify(&called_f, "0.07", &["--outputs", "scale"]).status.code(), Some(4));
    assert_eq!(verify(&called_f, "0.07", &["--outputs", "scale,bias"]).status.code(), Some(2));
    let infinite = write("infinite.glsl", &BIAS.replace("exp2(", "log2(0.0*"));
    let output = verify(&infinite, "1e9", &[]);
    assert_eq!(output.status.code(), Some(4));
    assert!(text(&output.stderr).contains("not finite"), "{}", text(&output.stderr));
}

#[test]
fn what_cannot_be_read_is_refused_with_its_place() {
    let folder = tempfile::tempdir().unwrap();
    for (name, snippet, expected) in [
        ("a.glsl", BIAS.replace("exp2", "exp3"), "a.glsl: snippet, line 2, column 12"),
        ("a.glsl", BIAS.replace("exp2", "exp3"), "did you mean `exp2`?"),
        ("b.glsl", BIAS.replace("7.0*n_dot_v", "7.0*n_dot_w"), "line 2, column 23"),
        ("c.glsl", BIAS.replace(";\n}", "\n}"), "line 3, column 1"),
        (
            "d.glsl",
            BIAS.replace("float n_dot_v", "float n_dot_w").replace("7.0*n_dot_v", "n_dot_w"),
            "takes `n_dot_w`",
        ),
        ("e.txt", BIAS.to_owned(), ".hlsl, .wgsl, .glsl, .es.glsl, .metal"),
        ("f.hlsl", String::new(), "line 1, column 1"),
        ("g.wgsl", "fn f(x: f32) -> f32 { for (;;) {} }".to_owned(), "line 1, column"),
    ] {
        let file = folder.path().join(name);
        std::fs::write(&file, snippet).unwrap();
        let output = verify(&file, "1", &[]);
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(3), "{name}: {message}");
        assert!(message.contains(expected), "{name}: {message}");
        assert!(output.stdout.is_empty() && !message.contains("panicked"), "{name}");
    }
    let missing = verify(&folder.path().join("no.hlsl"), "1", &[]);
    assert_eq!(missing.status.code(), Some(3));
    assert!(text(&missing.stderr).contains("no.hlsl"));
    assert_eq!(verify(&folder.path().join("no.hlsl"), "-1", &[]).status.code(), Some(2));
}
