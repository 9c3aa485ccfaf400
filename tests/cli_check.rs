//! `lgp check` as a user runs it.

#![cfg(feature = "cli")]

use assert_cmd::Command;
use serde_json::Value;

fn check(args: &[&str]) -> (i32, String, String) {
    let mut command = Command::cargo_bin("lgp").unwrap();
    let output = command.arg("check").args(args).output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (output.status.code().unwrap(), text(output.stdout), text(output.stderr))
}

const BLENDER: &str = "f = exp2(-8.35*n_dot_v)*(1 - roughness); scale = 1 - f; bias = f";

#[test]
fn what_holds_is_proved() {
    let asked = ["--range", "0..1", "--claim", "energy"];
    let (code, shown, errors) = check(&[&[BLENDER, "datasets/dfg.bin"], &asked[..]].concat());
    assert_eq!(code, 0, "{errors}");
    for line in ["scale finite", "bias ≥ 0", "f0*scale + bias ≤ 1"] {
        let line = shown.lines().find(|shown| shown.starts_with(line)).unwrap();
        assert_eq!(line.matches("proved").count(), 2, "{line}");
    }
    for part in ["5 % outside", "f16 absolute", "a*b + c fused", "scale never falls with n_dot_v"] {
        assert!(shown.contains(part), "{part} is not in\n{shown}");
    }
}

#[test]
fn what_fails_comes_with_an_input_and_exit_code_4() {
    let formula = "y = (x - 0.25)*(x - 0.75)";
    let (code, shown, errors) = check(&[formula, "--domain", "x=0..1", "--range", "0..1"]);
    assert_eq!(code, 4);
    assert!(shown.contains("y ≥ 0") && shown.contains("-0.0625 at x = 0.5"), "{shown}");
    assert!(errors.contains("y ≥ 0 refuted: -0.0625 at x = 0.5"), "{errors}");
    // What was not asked for is shown, and no failure.
    let (code, _, errors) = check(&["y = 1/(1 + x)", "--domain", "x=0..1"]);
    assert_eq!((code, errors.as_str()), (0, ""));
    let (code, _, errors) = check(&["y = 1/x", "--domain", "x=0..1"]);
    assert_eq!(code, 4);
    assert!(errors.contains("y finite refuted: inf at x = 0.0"), "{errors}");
}

#[test]
fn json_has_everything() {
    let naive = "a2 = alpha*alpha; t = nh*nh*(a2 - 1) + 1; d = a2/(3.14159265*t*t)";
    let (code, shown, _) =
        check(&[naive, "--domain", "nh=0..1,alpha=1e-4..1", "--json", "--half", "1"]);
    assert_eq!(code, 4, "{shown}");
    let all: Value = serde_json::from_str(&shown).unwrap();
    assert_eq!(all["verdict"]["finite"]["status"], "refuted");
    assert!(all["verdict"]["finite"]["input"]["nh"].is_number());
    // t is 0 where it should be 1e-8: that the quotient is then infinite is not the quotient's fault.
    assert_eq!(all["f32"]["relative"]["cause"], "cancellation");
    assert!(all["f32"]["relative"]["operation"].is_string());
    for part in ["claims", "extremes", "liberties", "breaks"] {
        assert!(all[part].is_array(), "{part}");
    }
}

#[test]
fn a_front_is_checked_member_by_member() {
    let (code, shown, errors) = check(&["tests/fixtures/dfg"]);
    assert_eq!(code, 0, "{errors}");
    let line = shown.lines().find(|line| line.starts_with("finite  f32")).unwrap();
    let numbers: Vec<&str> = line.split_whitespace().skip(2).collect();
    assert_eq!(numbers[1..], ["0", "0"], "{line}");
    assert!(shown.lines().any(|line| line.starts_with("energy  GPUs")), "{shown}");
    assert_eq!(check(&["tests/fixtures/dfg", "--range", "0..1"]).0, 4);
    assert!(check(&["tests/fixtures/dfg", "--pick", "1"]).1.contains("scale finite"));
}

#[test]
fn what_cannot_be_understood_is_refused_with_advice() {
    for (args, code, expected) in [
        (&["y = 1/(x - $a)", "--domain", "x=2..3"][..], 3, "free constant"),
        (&["y = 1/x", "--domain", "x=1..1e39"], 2, "finite f32s"),
        (&["tests/fixtures/dfg", "--domain", "roughness=0.3..0.9"], 2, "the domain of its run"),
        (&["y = x*z", "--domain", "x=0..1"][..], 2, "--domain z=0..1"),
        (&["y = x", "--domain", "x=1..0"], 2, "LOW..HIGH"),
        (&["y = x", "--domain", "x=0..1,w=0..1"], 2, "no input `w`"),
        (&["y = x", "--domain", "x=0..1", "--range", "z=0..1"], 2, "no output `z`"),
        (&["y = x", "--domain", "x=0..1", "--claim", "energy"], 2, "as in \"energy: y <= 1\""),
        (
            &["y = x", "--domain", "x=0..1", "--claim", "top: y*w <= 1"],
            2,
            "line 1, column 8: unknown name `w`",
        ),
        (&[BLENDER, "datasets/dfg.bin", "--claim", "energie"], 2, "did you mean `energy`?"),
        (&["nowhere"], 3, "no such folder"),
        (&["tests/fixtures/dfg", "--pick", "999"], 2, "--pick 999"),
        (&["bias = $a*n_dot_v", "datasets/dfg.bin"], 3, "$a"),
    ] {
        let (found, shown, errors) = check(args);
        assert_eq!(found, code, "{args:?}: {errors}");
        assert!(errors.contains(expected), "{args:?}: {errors}");
        assert_eq!(shown, "");
    }
}

/// The nearest numbers inside are the domain; what lies an ulp outside is told among the edges.
#[test]
fn what_is_refuted_is_refuted_within_the_domain_as_given() {
    for (formula, domain) in [
        ("y = sqrt(0.7 - x)", "x=0.1..0.7"),
        ("y = log2(x - 0.09999999)", "x=0.1..0.7"),
        ("y = sqrt(1.6 - x)", "x=0.3..1.6"),
    ] {
        let (code, shown, errors) = check(&[formula, "--domain", domain]);
        assert_eq!(code, 0, "{formula}: {errors}");
        let line = shown.lines().find(|line| line.starts_with("y finite")).unwrap();
        assert!(line.contains("proved"), "{line}");
    }
    let (_, shown, _) = check(&["y = sqrt(0.7 - x)", "--domain", "x=0.1..0.7"]);
    assert!(shown.contains("1 ulp or 1e-7 outside  y 0.7746 … 0.7746; NaN at x = 0.70000005"));
    // What fails inside is refuted there, whatever the end.
    for high in ["0.7", "0.3", "1.6", "0.99999999"] {
        let domain = format!("x=0.1..{high}");
        let (_, shown, _) = check(&["y = -x", "--domain", &domain, "--range", "0..1", "--json"]);
        let all: Value = serde_json::from_str(&shown).unwrap();
        let found = all["verdict"]["range"]["input"]["x"].as_f64().unwrap();
        // JSON has the shortest text of an f32.
        let found = f64::from(found as f32);
        assert!((0.1..=high.parse().unwrap()).contains(&found), "{found} of {domain}");
    }
}

#[test]
fn places_have_no_more_digits_than_single_precision() {
    let (_, shown, _) = check(&["y = max(x, 0.3)", "--domain", "x=0.01..0.7"]);
    assert!(shown.starts_with("domain: x in [0.01, 0.7]; "), "{shown}");
    let bend = shown.lines().find(|line| line.contains("bends")).unwrap();
    let place = bend.split("x = ").nth(1).unwrap().split(',').next().unwrap();
    assert!(place.len() <= 10, "{bend}");
}

#[test]
fn waves_beyond_half_a_turn_are_open_on_gpus() {
    let statuses = |formula: &str, domain: &str| {
        let (_, shown, _) = check(&[formula, "--domain", domain, "--range=-1..1"]);
        let lines = shown.lines().filter(|line| line.starts_with("y "));
        lines
            .map(|line| line.split_whitespace().skip(1).collect::<Vec<_>>().join(" "))
            .collect::<Vec<_>>()
    };
    for formula in ["y = sin(2*x)", "y = cos(2*x)", "y = 0.1*tan(sin(2*x))"] {
        let near = statuses(formula, "x=-1.5..1.5");
        assert!(near[0].starts_with("finite proved proved"), "{near:?}");
        let far = statuses(formula, "x=-2..2");
        assert!(far[0].starts_with("finite proved open"), "{far:?}");
    }
}

#[test]
fn half_precision_is_bounded_by_what_was_tried() {
    let beckmann = "g1 = saturate(a*(a*(1.3134*a - 3.4018) + 3.0365) + 0.0155)";
    let run = |formula: &str, of: &[&str]| check(&[&[formula], of].concat()).1;
    let shown = run(beckmann, &["datasets/beckmann_g1.bin", "--half", "2e-3"]);
    assert!(!shown.contains("f16 throughout"), "{shown}");
    assert!(shown.contains("at a = 1.0546875"), "{shown}");
    let shown = run(beckmann, &["datasets/beckmann_g1.bin", "--half", "3e-3"]);
    assert!(shown.contains("f16 throughout errs by 0.003 at most (all 15976 inputs"), "{shown}");
    let shown = run("y = 0.5*b/max(b, 0.00001)", &["--domain", "b=0..1"]);
    assert!(shown.contains("f16 no number") && !shown.contains("f16 throughout"), "{shown}");
    let shown = run("y = a*b", &["--domain", "a=0..1,b=0..1"]);
    assert!(shown.contains("no more than 0.01 at the worst of"), "{shown}");
}

#[test]
fn a_sum_of_thirty_inputs_is_checked() {
    let names: Vec<String> = (0..30).map(|i| format!("x{i}")).collect();
    let domain: Vec<String> = names.iter().map(|name| format!("{name}=0..1")).collect();
    let formula = format!("y = {}", names.join(" + "));
    let (code, shown, errors) = check(&[&formula, "--domain", &domain.join(",")]);
    assert_eq!(code, 0, "{errors}");
    assert!(shown.lines().any(|line| line.starts_with("y finite  proved    proved")), "{shown}");
}

#[test]
fn what_is_claimed_on_the_command_line_is_proved_or_refuted_by_its_name() {
    let of = ["y = x*x", "--domain", "x=0..1"];
    let claims = ["--claim", "top: y <= 1", "--claim", "line: y <= k*x for k in 0.5..1"];
    let (code, shown, errors) = check(&[&of[..], &claims].concat());
    assert_eq!(code, 4);
    assert!(errors.contains("y - (k*x) ≤ 0 refuted: 0.5 at k = 0.5, x = 1.0"), "{errors}");
    let line = |start: &str| shown.lines().find(|line| line.starts_with(start)).unwrap();
    assert_eq!(line("y ≤ 1").matches("proved").count(), 2, "{shown}");
    assert_eq!(line("y - (k*x) ≤ 0 (k = 1)").matches("proved").count(), 2, "{shown}");
    let (code, shown, _) = check(&[&of[..], &claims[..2], &["--json"]].concat());
    let all: Value = serde_json::from_str(&shown).unwrap();
    assert_eq!((code, all["verdict"]["top"]["status"].as_str()), (0, Some("proved")));
    // In place of what comes with the data.
    let dfg = ["scale = 0.6; bias = 0.6", "datasets/dfg.bin", "--claim"];
    assert_eq!(check(&[&dfg[..], &["energy"]].concat()).0, 4);
    assert_eq!(check(&[&dfg[..], &["energy: scale + bias <= 1.25"]].concat()).0, 0);
}

#[test]
fn what_is_claimed_of_a_table_stands_in_all_that_is_made_of_it() {
    let folder = tempfile::tempdir().unwrap();
    let lgp = |args: &[&str]| {
        let mut command = Command::cargo_bin("lgp").unwrap();
        let output = command.current_dir(folder.path()).args(args).output().unwrap();
        let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
        assert!(output.status.success(), "{args:?}: {}", text(&output.stderr));
        text(&output.stdout)
    };
    let rows = (0..20).map(|i| format!("{0},{0}\n", f64::from(i) / 19.0));
    let table = folder.path().join("table.csv");
    std::fs::write(&table, format!("x,y\n{}", rows.collect::<String>())).unwrap();
    let claim = ["--claim", "top: y <= 1.5"];
    lgp(&[&["import", "table.csv", "--inputs", "x", "-o", "table.bin"][..], &claim].concat());
    assert!(lgp(&["info", "table.bin"]).contains("claims      top: y <= 1.5"));
    lgp(&["search", "table.bin", "--generations", "1", "--islands", "1", "--out", "run"]);
    let front: Value = serde_json::from_str(&lgp(&["front", "run", "--json"])).unwrap();
    let verdicts: Vec<&Value> =
        front.as_array().unwrap().iter().map(|one| &one["verdict"]["top"]["status"]).collect();
    assert!(!verdicts.is_empty() && verdicts.iter().all(|status| *status == "proved"));
    assert!(lgp(&["emit", "run", "--lang", "hlsl"]).contains("// top: proved"));
    let page = std::fs::read_to_string(folder.path().join("run/report.html")).unwrap();
    assert!(page.contains("<dt>claims</dt><dd>top: y &lt;= 1.5</dd>"));
}
