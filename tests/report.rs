//! `lgp report`: what it writes, and what it refuses.

#![cfg(feature = "cli")]

mod command;

use command::{lgp_here, text};
use lgp::cost::Profile;
use serde_json::Value;
use std::path::Path;
use std::process::Output;
use tempfile::TempDir;

/// A copy of a run that `tests/fixtures/refresh` makes.
fn copy_of(run: &str) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let from = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures").join(run);
    for file in ["run.ron", "front.json", "front-max.json", "trace.csv"] {
        if from.join(file).exists() {
            std::fs::copy(from.join(file), folder.path().join(file)).unwrap();
        }
    }
    folder
}

/// So that what is changed is read, not told by the checksums that the run's record has of its files.
fn without_checksums(folder: &TempDir) {
    let path = folder.path().join("run.ron");
    let record = std::fs::read_to_string(&path).unwrap();
    let (rest, _) = record.split_once("    files: {").unwrap();
    std::fs::write(&path, format!("{rest})\n")).unwrap();
}

fn report(folder: &TempDir, extra: &[&str]) -> Output {
    lgp_here(&[&["report", folder.path().to_str().unwrap()], extra].concat())
}

fn page(folder: &TempDir) -> String {
    std::fs::read_to_string(folder.path().join("report.html")).unwrap()
}

/// The data in a page.
fn data(page: &str) -> Value {
    let start = page.find("id=\"data\">").unwrap() + "id=\"data\">".len();
    let end = start + page[start..].find("</script>").unwrap();
    serde_json::from_str(&page[start..end]).unwrap()
}

#[test]
fn a_page_is_the_same_bytes_each_time_and_needs_nothing_else() {
    let folder = copy_of("dfg");
    assert!(report(&folder, &[]).status.success());
    let first = page(&folder);
    assert!(report(&folder, &["--threads", "1"]).status.success());
    assert!(first == page(&folder), "the same folder gave another page");
    for outside in ["http://", "https://", "src=", "@import", "fetch("] {
        for (at, _) in first.match_indices(outside) {
            // The names of vocabularies, not addresses that are asked.
            let allowed = ["http://www.w3.org/2000/svg", "http://www.w3.org/1998/Math/MathML"];
            let found = &first[at..];
            let near: String = found.chars().take(60).collect();
            assert!(allowed.iter().any(|name| found.starts_with(name)), "{near}");
        }
    }
    assert!(first.contains("--generations 40 --seed 1 --out"));
}

#[test]
fn a_page_holds_each_member_on_every_profile_and_the_published_formulas() {
    let folder = copy_of("dfg");
    assert!(report(&folder, &[]).status.success());
    let data = data(&page(&folder));
    let front: Vec<Value> = serde_json::from_slice(
        &lgp_here(&["front", folder.path().to_str().unwrap(), "--json"]).stdout,
    )
    .unwrap();
    let members = data["fronts"][0]["members"].as_array().unwrap();
    assert_eq!(members.len(), front.len());
    for (member, known) in members.iter().zip(&front) {
        assert_eq!(member["formula"], known["formula"]);
        assert!(member["verdict"]["finite"]["status"].is_string(), "{}", member["verdict"]);
        assert_eq!(member["costs"][0], known["cost"]);
        assert_eq!(member["costs"].as_array().unwrap().len(), Profile::built_in().count());
    }
    let names: Vec<&str> =
        data["published"].as_array().unwrap().iter().map(|f| f["name"].as_str().unwrap()).collect();
    assert!(names.contains(&"karis_2014") && names.contains(&"materialx_rational"));
    let tables = data["lookup_tables"].as_array().unwrap();
    let rmse = |i: usize| tables[i]["error"][0].as_f64().unwrap();
    assert!(tables.len() == 4 && rmse(0) > rmse(1) && rmse(1) > rmse(2) && rmse(2) > rmse(3));
    assert_eq!(data["samples"]["outputs"][0].as_array().unwrap().len(), 4096);
    assert_eq!(data["trace"]["costs"][0], 5.0);
}

#[test]
fn sixty_members_on_a_grid_of_64_by_64_are_less_than_3_mb() {
    let folder = copy_of("dfg");
    without_checksums(&folder);
    for file in ["front.json", "front-max.json"] {
        let path = folder.path().join(file);
        let members: Vec<Value> =
            serde_json::from_str(&std::fs::read_to_string(&path).unwrap()).unwrap();
        let mut sixty: Vec<&Value> = members.iter().rev().cycle().take(60).collect();
        let cost = |member: &Value| member["cost"].as_f64().unwrap();
        sixty.sort_by(|a, b| cost(a).total_cmp(&cost(b)));
        std::fs::write(&path, serde_json::to_string(&sixty).unwrap()).unwrap();
    }
    assert!(report(&folder, &[]).status.success());
    let page = page(&folder);
    assert_eq!(data(&page)["fronts"][0]["members"].as_array().unwrap().len(), 60);
    assert!(page.len() < 3_000_000, "{} bytes", page.len());
}

#[test]
fn datasets_of_other_shapes_have_pages() {
    for run in ["beckmann_g1", "smith_g2", "hammon_single", "disney_zh0", "area_norm"] {
        let folder = copy_of(run);
        let done = report(&folder, &[]);
        assert!(done.status.success(), "{run}: {}", text(&done.stderr));
        let data = data(&page(&folder));
        let inputs = data["inputs"].as_array().unwrap().len();
        assert_eq!(data["samples"]["inputs"].as_array().unwrap().len(), inputs, "{run}");
    }
}

#[test]
fn without_its_dataset_a_page_has_no_maps_and_says_so() {
    let folder = copy_of("fresnel");
    let run = folder.path().join("run.ron");
    let moved = std::fs::read_to_string(&run).unwrap().replace("datasets/fresnel.bin", "gone.bin");
    std::fs::write(&run, moved).unwrap();
    let done = report(&folder, &[]);
    assert!(done.status.success());
    assert!(text(&done.stderr).contains("--dataset"), "{}", text(&done.stderr));
    assert!(data(&page(&folder))["samples"].is_null());
    assert!(report(&folder, &["--dataset", "datasets/fresnel.bin"]).status.success());
    assert!(data(&page(&folder))["samples"].is_object());
    let other = report(&folder, &["--dataset", "datasets/smith_g1.bin"]);
    assert_eq!(other.status.code(), Some(3));
    assert!(text(&other.stderr).contains("not the data"), "{}", text(&other.stderr));
}

#[test]
fn a_damaged_or_half_written_folder_is_refused_and_left_as_it_was() {
    for file in ["run.ron", "front.json", "front-max.json", "trace.csv"] {
        let folder = copy_of("dfg");
        without_checksums(&folder);
        std::fs::write(folder.path().join("report.html"), "as it was").unwrap();
        let path = folder.path().join(file);
        let whole = std::fs::read_to_string(&path).unwrap();
        // In the middle of a line.
        std::fs::write(&path, &whole[..whole.len() / 2]).unwrap();
        refused(&folder, &format!("{file}, line"));
    }
    for (missing, expected) in [
        ("run.ron", "no whole run"),
        ("front.json", "no whole run"),
        ("front-max.json", "front-max.json"),
    ] {
        let folder = copy_of("dfg");
        std::fs::write(folder.path().join("report.html"), "as it was").unwrap();
        std::fs::remove_file(folder.path().join(missing)).unwrap();
        refused(&folder, expected);
    }
    let nothing = lgp_here(&["report", "no/such/folder"]);
    assert_eq!(nothing.status.code(), Some(3));
    assert!(text(&nothing.stderr).contains("no such folder"));
}

fn refused(folder: &TempDir, expected: &str) {
    let output = report(folder, &[]);
    let message = text(&output.stderr);
    assert_eq!(output.status.code(), Some(3), "{message}");
    assert!(message.contains(expected), "{expected} is not in {message}");
    assert_eq!(page(folder), "as it was");
}

#[test]
fn runs_are_compared_those_that_differ_only_in_their_seeds_as_one() {
    let [first, second, third] = [(), (), ()].map(|()| copy_of("dfg"));
    let changed = |folder: &TempDir, from: &str, to: &str| {
        let path = folder.path().join("run.ron");
        let text = std::fs::read_to_string(&path).unwrap();
        assert!(text.contains(from));
        std::fs::write(&path, text.replace(from, to)).unwrap();
    };
    changed(&second, "seed: 1", "seed: 2");
    changed(&third, "grammar: \"shader\"", "grammar: \"exp2\"");
    let out = first.path().join("compared.html");
    let path = |folder: &TempDir| folder.path().to_str().unwrap().to_owned();
    let compare = |runs: &[&TempDir]| {
        let runs: Vec<String> = runs.iter().map(|run| path(run)).collect();
        let runs = runs.iter().map(String::as_str);
        let args: Vec<&str> =
            ["report"].into_iter().chain(runs).chain(["--output", out.to_str().unwrap()]).collect();
        lgp_here(&args)
    };
    let done = compare(&[&first, &second, &third]);
    assert!(done.status.success(), "{}", text(&done.stderr));
    let page = std::fs::read_to_string(&out).unwrap();
    let data = data(&page);
    let groups = data["groups"].as_array().unwrap();
    let labels: Vec<&str> = groups.iter().map(|group| group["label"].as_str().unwrap()).collect();
    assert_eq!(labels, ["grammar shader", "grammar exp2"]);
    assert_eq!(groups[0]["runs"].as_array().unwrap().len(), 2);
    assert!(compare(&[&first, &second, &third]).status.success());
    assert!(page == std::fs::read_to_string(&out).unwrap());

    let other = compare(&[&first, &copy_of("fresnel")]);
    assert_eq!(other.status.code(), Some(3));
    assert!(text(&other.stderr).contains("of another data"), "{}", text(&other.stderr));
    let alone = compare(&[&first]);
    assert_eq!(alone.status.code(), Some(2), "{}", text(&alone.stderr));
}

#[test]
fn what_was_measured_is_kept_and_is_an_axis_of_the_page() {
    let folder = copy_of("beckmann_g1");
    assert!(report(&folder, &["--measure"]).status.success());
    let first = page(&folder);
    let data = data(&first);
    let axes = data["profiles"].as_array().unwrap();
    assert_eq!(axes.last().unwrap()["unit"], "ns an evaluation");
    let costs = data["fronts"][0]["members"][3]["costs"].as_array().unwrap();
    assert_eq!(costs.len(), axes.len());
    assert!(costs.last().unwrap().as_f64().unwrap() > 0.0);
    assert!(report(&folder, &[]).status.success());
    assert!(first == page(&folder));
    std::fs::write(folder.path().join("timing.json"), "[{").unwrap();
    let damaged = report(&folder, &[]);
    assert_eq!(damaged.status.code(), Some(3));
    assert!(text(&damaged.stderr).contains("timing.json, line 1"), "{}", text(&damaged.stderr));
}

#[test]
fn pictures_are_made_of_what_has_them() {
    let folder = copy_of("dfg");
    assert!(report(&folder, &[]).status.success());
    for file in ["front.svg", "maps.png", "spheres.png", "convergence.png", "convergence.svg"] {
        assert!(folder.path().join(file).is_file(), "{file}");
    }
    let here = folder.path().to_str().unwrap();
    let other = lgp_here(&["render", "tests/fixtures/hammon_single"]);
    assert_eq!(other.status.code(), Some(3));
    assert!(text(&other.stderr).contains("no sphere is known"), "{}", text(&other.stderr));
    let outside = lgp_here(&["render", here, "--roughness", "1.5"]);
    assert_eq!(outside.status.code(), Some(2));
    let picture = folder.path().join("p.png");
    let picture = picture.to_str().unwrap();
    let drawn =
        lgp_here(&["render", here, "--pick", "1", "--roughness", "0.5", "-o", picture, "--json"]);
    let json: Value = serde_json::from_slice(&drawn.stdout).unwrap();
    assert!(json["displayed_rmse"].as_f64().unwrap() > 0.0);
}
