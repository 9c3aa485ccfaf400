//! The page of a run in a real browser. Skipped, and said so, where there is no Chromium.

#![cfg(feature = "cli")]

mod hostile;

use assert_cmd::Command;
use base64::{Engine, prelude::BASE64_STANDARD};
use serde_json::Value;
use sha2::{Digest, Sha256};
use std::path::Path;

/// Put first in the page: what goes wrong later is noted.
const WATCH: &str = "<script>
window.problems = [];
addEventListener('error', (event) => problems.push(event.message));
addEventListener('securitypolicyviolation', (event) => problems.push(event.violatedDirective));
addEventListener('unhandledrejection', (event) => problems.push(String(event.reason)));
const report = console.error;
console.error = (...all) => { problems.push(all.join(' ')); report(...all); };
</script>";

/// What `lgp render` and the page are compared on: a member, an environment and its place in the
/// page's list, roughness, F0, exposure.
const SPHERES: [(u32, &str, u32, &str, &str, &str); 4] = [
    (13, "sky", 1, "0.3", "0.04", "1"),
    (5, "studio", 2, "0.15", "0.5", "0"),
    (29, "uniform", 0, "0.8", "1", "0"),
    (20, "sky", 1, "0.05", "0.9", "-1"),
];

const SIZE: usize = 64;

/// Put last: uses the page as a reader would, and leaves what it saw in an attribute.
const USE: &str = include_str!("use.js");

fn chromium() -> Option<&'static str> {
    let names = ["chromium", "chromium-browser", "google-chrome"];
    let there = |name: &&str| {
        std::process::Command::new(name).arg("--version").output().is_ok_and(|o| o.status.success())
    };
    names.into_iter().find(there)
}

/// A page that is watched from its first line on, before its policy holds, and used by a script at its end,
/// which its policy is made to allow.
fn used(page: &str, script: &str) -> String {
    let hash = BASE64_STANDARD.encode(Sha256::digest(script));
    let used = page
        .replacen("<head>", &format!("<head>{WATCH}"), 1)
        .replacen("script-src ", &format!("script-src 'sha256-{hash}' "), 1)
        .replacen("</body>", &format!("<script>{script}</script></body>"), 1);
    assert!(used.contains(&hash), "the page has a policy");
    used
}

/// The DOM of a page after its scripts ran, and what Chromium said on its console.
fn dom(browser: &str, page: &Path, width: u32) -> (String, Vec<String>) {
    let profile = tempfile::tempdir().unwrap();
    let output = std::process::Command::new(browser)
        .args(["--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--hide-scrollbars"])
        .args(["--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--enable-logging=stderr"])
        .args(["--virtual-time-budget=20000", "--dump-dom"])
        .arg(format!("--window-size={width},1600"))
        .arg(format!("--user-data-dir={}", profile.path().display()))
        .arg(format!("file://{}", page.display()))
        .output()
        .expect("the browser starts");
    let log = String::from_utf8_lossy(&output.stderr).into_owned();
    let console = log
        .lines()
        .filter(|line| line.contains(":CONSOLE") && !line.contains("GL Driver Message"))
        .map(str::to_owned);
    (String::from_utf8_lossy(&output.stdout).into_owned(), console.collect())
}

/// What the script put last left behind.
fn seen(dom: &str) -> Value {
    let start = dom.find("data-seen=\"").expect("the script at the end ran") + 11;
    let encoded = &dom[start..start + dom[start..].find('"').unwrap()];
    let mut bytes = Vec::new();
    let mut rest = encoded.bytes();
    while let Some(byte) = rest.next() {
        bytes.push(match byte {
            b'%' => {
                let digits = [rest.next().unwrap(), rest.next().unwrap()];
                u8::from_str_radix(std::str::from_utf8(&digits).unwrap(), 16).unwrap()
            }
            other => other,
        });
    }
    serde_json::from_slice(&bytes).unwrap()
}

fn lgp(args: &[&str]) -> String {
    let mut command = Command::cargo_bin("lgp").expect("the program is built");
    let output = command.current_dir(env!("CARGO_MANIFEST_DIR")).args(args).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

#[test]
fn a_reader_can_choose_look_and_copy() {
    let Some(browser) = chromium() else {
        eprintln!("skipped: there is no Chromium (Debian: apt-get install chromium)");
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    let run = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures/dfg");
    for file in ["run.ron", "front.json", "front-max.json", "trace.csv"] {
        std::fs::copy(run.join(file), folder.path().join(file)).unwrap();
    }
    let here = folder.path().to_str().unwrap();
    lgp(&["report", here]);
    let page = std::fs::read_to_string(folder.path().join("report.html")).unwrap();
    let used = used(&page, &(settings() + USE));
    let path = folder.path().join("used.html");
    std::fs::write(&path, used).unwrap();
    for width in [1400, 420] {
        let (dom, console) = dom(browser, &path, width);
        let seen = seen(&dom);
        assert!(console.is_empty(), "{console:?}");
        assert_eq!(seen["failed"], Value::Null, "{}", seen["failed"]);
        assert_eq!(seen["problems"], serde_json::json!([]));
        let members = seen["members"].as_array().unwrap();
        for one in members {
            let (member, language) = (one["member"].as_u64().unwrap(), &one["language"]);
            let number = (member + 1).to_string();
            let emitted =
                lgp(&["emit", here, "--lang", language.as_str().unwrap(), "--pick", &number]);
            assert_eq!(one["copied"], emitted, "formula {number} in {language}");
            assert_eq!(one["code"], emitted, "formula {number} in {language}");
            assert_eq!(one["heading"], format!("Formula {number} of 30"));
        }
        for part in ["math", "maps"] {
            assert_eq!(members[1][part], members[2][part], "another language, the same {part}");
            assert_ne!(members[0][part], members[1][part], "another formula, another {part}");
        }
        assert_eq!(seen["published"], "blender_workbench");
        assert_eq!((&seen["profile"], &seen["maximum"]), (&Value::Bool(true), &Value::Bool(true)));
        assert_eq!(seen["sorted"], "max ↑");
        assert!(seen["rows"].as_u64().unwrap() > 20);
        assert_eq!(seen["wide"], 0, "wider than the window by so many pixels");
        errors_agree(&seen["check"]);
        if seen["spheres"][0].is_null() {
            eprintln!("skipped: this Chromium has no WebGL 2, not even in software");
        } else {
            spheres_agree(&seen["spheres"], folder.path());
        }
    }
}

#[test]
fn a_comparison_draws_fronts_and_traces() {
    let Some(browser) = chromium() else {
        eprintln!("skipped: there is no Chromium (Debian: apt-get install chromium)");
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("comparison.html");
    let runs = ["tests/fixtures/dfg", "tests/fixtures/dfg"];
    let front = std::fs::read_to_string("tests/fixtures/dfg/front.json").unwrap();
    let front: Vec<Value> = serde_json::from_str(&front).unwrap();
    let best = format!("{:.5}", front.last().unwrap()["rmse"].as_f64().unwrap());
    lgp(&["report", runs[0], runs[1], "--output", path.to_str().unwrap()]);
    let page = std::fs::read_to_string(&path).unwrap();
    let used = used(&page, COMPARED);
    std::fs::write(&path, used).unwrap();
    for width in [1400, 420] {
        let (dom, console) = dom(browser, &path, width);
        let seen = seen(&dom);
        assert!(console.is_empty(), "{console:?}");
        assert_eq!(seen["problems"], serde_json::json!([]));
        for plot in ["fronts", "volume", "error"] {
            assert!(seen[plot].as_u64().unwrap() >= 1, "{plot}: {seen}");
        }
        assert!(seen["medians"].as_str().unwrap().contains(&best), "{seen}");
        assert_ne!(seen["before"], seen["after"], "another cost, the same plot");
    }
}

/// What a comparison shows.
const COMPARED: &str = "
const paths = (id) => document.querySelectorAll(`#${id} svg path`);
const seen = Object.fromEntries(['fronts', 'volume', 'error'].map((id) => [id, paths(id).length]));
seen.medians = document.getElementById('comparison').textContent;
seen.before = document.getElementById('error').innerHTML;
const cost = document.querySelectorAll('#controls select')[2];
cost.value = 0; cost.dispatchEvent(new Event('change'));
seen.after = document.getElementById('error').innerHTML;
seen.problems = window.problems;
document.body.dataset.seen = encodeURIComponent(JSON.stringify(seen));
";

/// The errors that the page computes of its samples by JavaScript are those that were quoted.
fn errors_agree(check: &Value) {
    let formulas = check.as_array().unwrap();
    assert!(formulas.len() > 60);
    for formula in formulas {
        let pair = |field: &str, o: usize, i: usize| formula[field][o][i].as_f64().unwrap();
        for output in 0..2 {
            for measure in 0..2 {
                let [quoted, computed] =
                    ["quoted", "computed"].map(|field| pair(field, output, measure));
                assert!((quoted - computed).abs() <= 1e-5 * quoted + 1e-6, "{formula}");
            }
        }
    }
}

/// The spheres to draw, for the page.
fn settings() -> String {
    let one = |(member, _, environment, roughness, f0, exposure): &(u32, _, u32, _, _, _)| {
        format!(
            "{{member: {member}, settings: {{environment: {environment}, roughness: {roughness}, f0: {f0}, exposure: {exposure}}}}}"
        )
    };
    let all: Vec<String> = SPHERES.iter().map(one).collect();
    format!("const SIZE = {SIZE}; const SPHERES = [{}];\n", all.join(", "))
}

/// Within 2/255 on average, of truth, formula and difference each.
fn spheres_agree(seen: &Value, folder: &Path) {
    for (rows, (member, environment, _, roughness, f0, exposure)) in
        seen.as_array().unwrap().iter().zip(SPHERES)
    {
        let picture = folder.join("bare.png");
        let (number, size) = ((member + 1).to_string(), SIZE.to_string());
        lgp(&[
            "render",
            folder.to_str().unwrap(),
            "--pick",
            &number,
            "--environment",
            environment,
            "--roughness",
            roughness,
            "--f0",
            f0,
            "--exposure",
            exposure,
            "--size",
            &size,
            "--bare",
            "--output",
            picture.to_str().unwrap(),
        ]);
        let drawn = decode(&picture);
        for which in 0..3 {
            let (mut apart, mut count, mut brightest) = (0.0, 0.0f64, 0);
            for (y, row) in rows.as_array().unwrap().iter().enumerate() {
                for x in 0..SIZE {
                    let centre = |i: usize| i as f64 + 0.5 - SIZE as f64 / 2.0;
                    if centre(x).hypot(centre(y)) > 0.9 * SIZE as f64 / 2.0 {
                        continue;
                    }
                    for channel in 0..3 {
                        let live = row[4 * (which * SIZE + x) + channel].as_i64().unwrap();
                        let written =
                            i64::from(drawn[3 * ((which * SIZE + y) * SIZE + x) + channel]);
                        apart += (live - written).abs() as f64;
                        brightest = brightest.max(written);
                        count += 1.0;
                    }
                }
            }
            let mean = apart / count;
            eprintln!("{environment}, roughness {roughness}, row {which}: {mean:.3}/255 apart");
            assert!(mean < 2.0, "formula {number} in {environment}, row {which}: {mean}/255");
            assert!(which == 2 || brightest > 60, "{environment}: row {which} is black");
        }
        let [truth, formula] =
            [0, 1].map(|which| &drawn[3 * which * SIZE * SIZE..][..3 * SIZE * SIZE]);
        assert_ne!(truth, formula, "{environment}: nothing could differ");
    }
}

/// The bytes of an RGB picture.
fn decode(path: &Path) -> Vec<u8> {
    let file = std::io::BufReader::new(std::fs::File::open(path).unwrap());
    let mut reader = png::Decoder::new(file).read_info().unwrap();
    let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut bytes).unwrap();
    assert_eq!((info.width, info.height), (SIZE as u32, 3 * SIZE as u32));
    bytes
}
