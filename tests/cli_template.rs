//! Searches with a template on the real command line: their folders, and all that is made of them.

#![cfg(feature = "cli")]

mod command;

use command::{lgp, succeed, text};
use serde_json::Value;
use std::path::Path;
use tempfile::TempDir;

const TEMPLATE: &str = "y = f(x, r)*$a + g(r)";

const GENERATIONS: &str = "4";

/// A table of `2 x / (1 + r) + r²`, and a short search on it with the seed 1 in `run1`.
fn searched() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let value = |i: usize| (i as f32 + 0.5) / 16.0;
    let row = |i: usize| {
        let (x, r) = (value(i % 16), value(i / 16));
        format!("{x},{r},{}\n", 2.0 * x / (1.0 + r) + r * r)
    };
    let rows: String = (0..256).map(row).collect();
    std::fs::write(folder.path().join("d.csv"), format!("x,r,y\n{rows}")).unwrap();
    succeed(folder.path(), &["import", "d.csv", "-o", "d.bin", "--inputs", "2", "--quiet"]);
    search(folder.path(), "run1", &["--seed", "1"]);
    folder
}

fn search(folder: &Path, out: &str, more: &[&str]) -> String {
    let search = ["search", "d.bin", "--template", TEMPLATE, "--max-cost", "16", "--islands", "2"];
    let rest = ["--generations", GENERATIONS, "--out", out, "--quiet"];
    succeed(folder, &[&search[..], &rest, more].concat())
}

fn front(folder: &Path, run: &str) -> String {
    std::fs::read_to_string(folder.join(run).join("front.json")).unwrap()
}

#[test]
fn a_seed_gives_the_same_front_on_one_thread_on_two_and_resumed() {
    let folder = searched();
    let here = folder.path();
    let once = front(here, "run1");
    search(here, "two", &["--threads", "2"]);
    assert_eq!(front(here, "two"), once);
    search(here, "other", &["--threads", "2", "--seed", "2"]);
    assert_ne!(front(here, "other"), once);
    let begin = ["search", "d.bin", "--template", TEMPLATE, "--generations", "1", "--out", "begun"];
    succeed(here, &[&begin[..], &["--islands", "2", "--max-cost", "16", "--quiet"]].concat());
    let resume = ["search", "--resume", "--out", "begun", "--generations", "4", "--quiet"];
    succeed(here, &resume);
    assert_eq!(front(here, "begun"), once);
}

#[test]
fn members_show_their_holes_and_the_whole() {
    let folder = searched();
    let here = folder.path();
    let members: Value = serde_json::from_str(&front(here, "run1")).unwrap();
    let last = members.as_array().unwrap().last().unwrap();
    let holes: Vec<&str> =
        last["holes"].as_array().unwrap().iter().map(|hole| hole.as_str().unwrap()).collect();
    assert_eq!(holes.len(), 3, "{holes:?}");
    for (hole, begins) in holes.iter().zip(["f(x, r) = ", "g(r) = ", "$a = "]) {
        assert!(hole.starts_with(begins), "{hole}");
    }
    assert!(last["rmse"].as_f64().unwrap() < 0.02, "{last}");
    let shown = succeed(here, &["front", "run1"]);
    assert!(shown.contains(&format!("with {}", holes[0])), "{shown}");
    let page = std::fs::read_to_string(here.join("run1/report.html")).unwrap();
    assert!(page.contains("f(x, r) = "));
}

/// What each hole was found to be makes a guess that begins with the member itself.
#[test]
fn a_member_is_a_guess() {
    let folder = searched();
    let here = folder.path();
    let members: Value = serde_json::from_str(&front(here, "run1")).unwrap();
    let last = members.as_array().unwrap().last().unwrap();
    let holes = last["holes"].as_array().unwrap().iter().map(|hole| hole.as_str().unwrap());
    let guess = holes.collect::<Vec<_>>().join("; ");
    search(here, "again", &["--guess", &guess, "--exhaustive", "0"]);
    let again: Value = serde_json::from_str(&front(here, "again")).unwrap();
    let error = |member: &Value| member["rmse"].as_f64().unwrap();
    let best = again.as_array().unwrap().iter().map(error).fold(f64::INFINITY, f64::min);
    assert!(best <= error(last) * 1.001, "{best} from {}", error(last));
}

#[test]
fn snippets_are_verified_and_checked() {
    let folder = searched();
    let here = folder.path();
    for language in lgp::emit::Language::ALL {
        let code = succeed(here, &["emit", "run1", "--lang", language.name()]);
        assert!(code.contains(&format!("template: {TEMPLATE}")), "{code}");
        assert!(code.contains("with f(x, r) = "), "{code}");
        let snippet = format!("s.{}", language.extension());
        std::fs::write(here.join(&snippet), &code).unwrap();
        let verify = ["verify", &snippet, "d.bin", "--max-error", "0.5", "--json"];
        let verified: Value = serde_json::from_str(&succeed(here, &verify)).unwrap();
        assert_eq!(verified["as_commented"], true, "{verified}");
    }
    let members: Value = serde_json::from_str(&front(here, "run1")).unwrap();
    let formula = members.as_array().unwrap().last().unwrap()["formula"].as_str().unwrap();
    let checked = succeed(here, &["check", formula, "d.bin"]);
    assert!(checked.contains("finite"), "{checked}");
}

#[test]
fn runs_are_merged_with_their_template_or_across_templates_without() {
    let folder = searched();
    let here = folder.path();
    search(here, "run2", &["--seed", "2"]);
    let merged = |other: &str, out: &str| -> Vec<Value> {
        succeed(here, &["merge", "run1", other, "--out", out, "--quiet"]);
        succeed(here, &["report", out]);
        let members: Value = serde_json::from_str(&front(here, out)).unwrap();
        members.as_array().unwrap().clone()
    };
    assert!(merged("run2", "both").iter().all(|member| member["holes"].is_array()));
    let other = ["search", "d.bin", "--template", "y = h(x, r)", "--generations", "1"];
    succeed(here, &[&other[..], &["--islands", "1", "--out", "other", "--quiet"]].concat());
    assert!(merged("other", "all").iter().all(|member| member["holes"].is_null()));
}

#[test]
fn what_is_no_template_is_refused_with_its_place_and_nothing_is_written() {
    let folder = searched();
    let here = folder.path();
    let before = front(here, "run1");
    for (template, reason) in [
        ("y = f(x) + q", "unknown name `q`"),
        ("y = f(x) + f(x, r)", "`f` is called with 2 arguments here, but with 1 before"),
        ("D(t) = D(t)*t; y = D(x) + $a", "`D` is defined by itself"),
        ("y = f(f(x))", "`f` is called in an argument of itself"),
        ("y = x", "nothing is to be found"),
        ("z = f(x)", "output `y` is never assigned"),
    ] {
        let words = ["search", "d.bin", "--template", template, "--out", "run1", "--force"];
        let refused = lgp(here, &words);
        assert_eq!(refused.status.code(), Some(3), "{template}");
        let message = text(&refused.stderr);
        assert!(message.contains(reason) && message.contains("--template"), "{message}");
        assert_eq!(front(here, "run1"), before);
    }
    let to = ["search", "d.bin", "--template", TEMPLATE, "--guess", "h(x) = 1", "--out", "run1"];
    let refused = lgp(here, &[&to[..], &["--force"]].concat());
    let message = text(&refused.stderr);
    assert!(message.contains("--guess: formula, line 1, column 1: the template has no hole `h`"));
    assert_eq!(front(here, "run1"), before);
}
