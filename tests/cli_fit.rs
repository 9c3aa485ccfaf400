//! `lgp fit` on the real command line, where local starts disagree and where they do not.

#![cfg(feature = "cli")]

mod command;

use command::{lgp, succeed, text};
use serde_json::Value;
use std::path::Path;
use tempfile::TempDir;

/// A folder with the samples of a wave.
fn wave() -> TempDir {
    let folder = TempDir::new().unwrap();
    let formula = "y = 1.5*sin(83*x) - 0.25";
    let generate = ["generate", "--formula", formula, "--domain", "x=0..1", "-o", "wave.bin"];
    succeed(folder.path(), &generate);
    folder
}

const WAVE: &str = "y = $b*sin($a*x) + $c";

/// What a fit prints on stdout, and what on stderr.
fn fit(folder: &Path, options: &[&str]) -> (String, String) {
    let output = lgp(folder, &[&["fit", WAVE, "wave.bin"], options].concat());
    assert!(output.status.success(), "{options:?}: {}", text(&output.stderr));
    (text(&output.stdout), text(&output.stderr))
}

#[test]
fn where_starts_disagree_the_whole_range_is_searched() {
    let folder = wave();
    let (found, said) = fit(folder.path(), &["--bounds", "a=0..150"]);
    assert!(found.contains("a = 83\n") && found.contains("b = 1.5\n"), "{found}");
    assert!(said.contains("of 24 starts reached the best fit; a global search found"), "{said}");
    assert!(said.contains("a better one"), "{said}");
    let (_, said) = fit(folder.path(), &["--bounds", "a=0..150", "--quiet"]);
    assert_eq!(said, "");
}

#[test]
fn where_starts_agree_it_is_searched_if_asked_for() {
    let folder = wave();
    // All these find the next lobe.
    let near = ["--bounds", "a=82..84", "--json"];
    let (found, said) = fit(folder.path(), &near);
    assert_eq!(said, "");
    let found: Value = serde_json::from_str(&found).unwrap();
    assert_eq!(found["constants"]["a"], 83.0);
    let (_, said) = fit(folder.path(), &[&near[..], &["--global"]].concat());
    assert!(said.contains("found none better"), "{said}");
}

#[test]
fn constants_on_a_bound_are_told() {
    let folder = wave();
    for options in
        [&["--bounds", "a=82..84,b=..1"][..], &["--bounds", "a=82..84,b=..1", "--global"]]
    {
        let (found, _) = fit(folder.path(), options);
        assert!(found.contains("b = 1 (at its upper bound)"), "{found}");
        assert_eq!(found.matches("bound").count(), 1, "{found}");
    }
    let (found, _) = fit(folder.path(), &["--bounds", "a=82..84,b=2..", "--json"]);
    let found: Value = serde_json::from_str(&found).unwrap();
    assert_eq!(found["at_bounds"], serde_json::json!({ "b": "lower" }));
}

#[test]
fn a_logarithmic_scale_is_searched_where_bounds_are_positive() {
    let folder = wave();
    let (found, _) = fit(folder.path(), &["--bounds", "a=1..1000", "--log", "a", "--global"]);
    assert!(found.contains("a = 83\n"), "{found}");
    for (bounds, refused) in [
        ("a=0..1", "--log: $a: 0 to 1 has no logarithmic scale"),
        ("a=1..", "--log: $a: 1 to inf has no logarithmic scale"),
        ("b=1..2", "--log: $a: -inf to inf has no logarithmic scale"),
    ] {
        let words = ["fit", WAVE, "wave.bin", "--log", "a", "--bounds", bounds];
        let output = lgp(folder.path(), &words);
        assert_eq!(output.status.code(), Some(2), "{bounds}");
        let said = text(&output.stderr);
        assert!(said.contains(refused) && said.contains("two positive bounds"), "{said}");
    }
    let output = lgp(folder.path(), &["fit", WAVE, "wave.bin", "--log", "d"]);
    assert_eq!(output.status.code(), Some(2));
    let said = text(&output.stderr);
    assert!(said.contains("--log: the template has no constant $d"), "{said}");
}

#[test]
fn a_global_fit_is_the_same_at_any_number_of_threads() {
    let folder = wave();
    let of = |threads: &str| {
        fit(folder.path(), &["--bounds", "a=0..150", "--global", "--json", "--threads", threads])
    };
    assert_eq!(of("1"), of("3"));
}
