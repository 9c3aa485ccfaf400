//! Pages of names that would be script, and pages into which script has come all the same.

use crate::{chromium, dom, seen, used};
use lgp::dataset::{Column, Split};
use lgp::emit::{self, Language, Snippet};
use lgp::program::{Names, Program, parse};
use lgp::report::page::{
    self, Code, ComparedRun, Comparison, CostAxis, Formula, Group, Page, PageFront, SampleTable,
};

/// Each would set `window.ran` where it is taken for what it is not.
const HOSTILE: [&str; 7] = [
    "</script><script>window.ran = 1</script>",
    "<img src=x onerror='window.ran = 2'>",
    "\"'><svg onload=\"window.ran = 3\">",
    "*/ window.ran = 4; /*\nwindow.ran = 5 //\u{2028}window.ran = 6",
    "`${window.ran = 7}` {{ 7*7 }} {% raw %} \\",
    "<!-- <script> \u{1b}[31m \u{202e}\u{0}",
    "javascript:window.ran=8",
];

/// What was seen of a page, once its own script ran.
const LOOK: &str = "
const count = (what) => document.querySelectorAll(what).length;
document.body.dataset.seen = encodeURIComponent(JSON.stringify({
  ran: window.ran ?? null, problems: window.problems, scripts: count('script'), images: count('img'),
  members: count('circle[data-member]'), rows: count('#table tbody tr'), maps: count('#maps canvas[data-map]'),
  code: document.getElementById('code')?.textContent, heading: document.querySelector('h1').textContent,
  lines: count('#fronts svg path'),
}));";

fn page(text: &str) -> Page {
    let column = |name: &str| Column { name: name.into(), unit: text.into(), domain: [0.0, 1.0] };
    let names = Names::new([text, "b"], ["y"]);
    let over = Names::new(["a", "b"], ["y"]);
    let program = parse("y = select(a < b, a, b*0.5)", &over).unwrap();
    let formula = |name: Option<&str>| formula(&program, &names, text, name);
    let points: Vec<f32> = (0..16).map(|i| (i / 4) as f32 / 3.0).collect();
    let columns = vec![points.clone(), (0..16).map(|i| (i % 4) as f32 / 3.0).collect(), points];
    let split = Split { columns, grid: vec![4, 4], ..Split::default() };
    let front = PageFront {
        measure: "rmse".into(),
        title: text.into(),
        cut: text.into(),
        option: "",
        members: vec![formula(None), formula(None)],
        knee: 0,
    };
    Page {
        title: text.into(),
        facts: vec![(text.into(), text.into())],
        command: text.into(),
        inputs: vec![column(text), column("b")],
        outputs: vec![column("y")],
        profiles: vec![CostAxis { name: text.into(), description: text.into(), unit: "cycles" }],
        profile: 0,
        fronts: vec![front],
        published: vec![formula(Some(text))],
        lookup_tables: Vec::new(),
        samples: Some(SampleTable::of(&split, 2)),
        trace: None,
        spheres: None,
        languages: Language::OF_RUNS.iter().map(|language| language.name()).collect(),
    }
}

fn formula(program: &Program, names: &Names, text: &str, name: Option<&str>) -> Formula {
    let header = [text.to_owned()];
    let snippet = Snippet::new(program, names, text).header(&header);
    let code = |&language: &Language| Code {
        comment: language.comment(),
        body: emit::emit(language, &snippet),
    };
    Formula {
        name: name.map(str::to_owned),
        costs: vec![Some(3.0)],
        registers: vec![Some(1)],
        errors: vec![[0.1, 0.2, 0.1]],
        error: [0.1, 0.2, 0.1],
        bars: Some([1e-4, 1e-3]),
        search: [0.1, 0.2, 0.1],
        validation: [0.1, 0.2, 0.1],
        verdict: serde_json::Value::Null,
        formula: text.to_owned(),
        template: vec![text.to_owned()],
        header: header.to_vec(),
        code: Language::OF_RUNS.iter().map(code).collect(),
        mathml: emit::mathml(&snippet),
        script: emit::javascript(program),
    }
}

#[test]
fn no_name_becomes_script() {
    let Some(browser) = chromium() else {
        eprintln!("skipped: there is no Chromium (Debian: apt-get install chromium)");
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    let plain = page::html(&page("x"));
    for text in HOSTILE.into_iter().chain([HOSTILE.concat().as_str()]) {
        let html = page::html(&page(text));
        let elements = |html: &str| html.matches("<script").count();
        assert_eq!(elements(&html), elements(&plain), "{text:?}");
        let path = folder.path().join("hostile.html");
        std::fs::write(&path, used(&html, LOOK)).unwrap();
        let (dom, console) = dom(browser, &path, 1400);
        let seen = seen(&dom);
        assert!(console.is_empty(), "{text:?}: {console:?}");
        assert_eq!(seen["ran"], serde_json::Value::Null, "{text:?}");
        assert_eq!(seen["problems"], serde_json::json!([]), "{text:?}");
        // Three of the page, and those that watch it.
        assert_eq!((&seen["scripts"], &seen["images"]), (&4.into(), &0.into()), "{text:?}");
        assert_eq!((&seen["members"], &seen["rows"]), (&2.into(), &3.into()), "{text:?}: {seen}");
        assert_eq!(seen["maps"], 4, "{text:?}");
        assert!(seen["code"].as_str().unwrap().contains("float"), "{text:?}");
        let heading = seen["heading"].as_str().unwrap();
        assert!(!heading.contains(['\u{1b}', '\u{202e}']), "{heading:?}");
    }
}

#[test]
fn no_name_of_a_comparison_becomes_script() {
    let Some(browser) = chromium() else {
        eprintln!("skipped: there is no Chromium (Debian: apt-get install chromium)");
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    let text = HOSTILE.concat();
    let front = vec![vec![1.0, 0.5, 0.6], vec![2.0, 0.25, 0.3]];
    let run = ComparedRun { seconds: 1.0, considered: 10, front, trace: None };
    let comparison = Comparison {
        title: text.clone(),
        subtitle: text.clone(),
        gpu: text.clone(),
        costs: vec![1.0, 2.0],
        measures: vec!["rmse", "max"],
        same_budget: true,
        groups: vec![Group { label: text, runs: vec![run.clone(), run] }],
    };
    let path = folder.path().join("comparison.html");
    std::fs::write(&path, used(&page::comparison(&comparison), LOOK)).unwrap();
    let (dom, console) = dom(browser, &path, 1400);
    let seen = seen(&dom);
    assert!(console.is_empty(), "{console:?}");
    assert_eq!(seen["ran"], serde_json::Value::Null);
    assert_eq!(seen["problems"], serde_json::json!([]));
    assert!(seen["lines"].as_u64().unwrap() >= 1, "{seen}");
}

#[test]
fn script_that_came_in_does_not_run_and_reaches_no_network() {
    let Some(browser) = chromium() else {
        eprintln!("skipped: there is no Chromium (Debian: apt-get install chromium)");
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("injected.html");
    let injected = "<script>window.ran = 1</script><img src='file:///x.png' onerror='window.ran = 2'>\
        <a id=link href='javascript:window.ran=3'></a><style>h1 { color: red }</style>\
        <link rel=stylesheet href='file:///x.css'><script src='file:///x.js'></script>\
        <iframe srcdoc='<script>parent.ran = 4</script>'></iframe><base href='http://localhost/'>";
    let look = format!("document.getElementById('link').click();\n{LOOK}");
    for html in [page::html(&page("x"))] {
        let html = html.replacen("<main>", &format!("<main>{injected}"), 1);
        std::fs::write(&path, used(&html, &look)).unwrap();
        let (dom, _) = dom(browser, &path, 1400);
        let seen = seen(&dom);
        assert_eq!(seen["ran"], serde_json::Value::Null);
        let problems = seen["problems"].as_array().unwrap();
        for directive in
            ["script-src-elem", "script-src-attr", "style-src-elem", "img-src", "base-uri"]
        {
            assert!(
                problems.iter().any(|problem| problem == directive),
                "{directive}: {problems:?}"
            );
        }
        assert_eq!(seen["members"], 2, "the page still works");
    }
}
