//! `lgp check` as a user runs it.

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
    let asked = ["--range", "0..1", "--energy"];
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
    let (code, shown, errors) = check(&["results/dfg"]);
    assert_eq!(code, 0, "{errors}");
    let line = shown.lines().find(|line| line.starts_with("finite  f32")).unwrap();
    let numbers: Vec<&str> = line.split_whitespace().skip(2).collect();
    assert_eq!(numbers[1..], ["0", "0"], "{line}");
    assert_eq!(check(&["results/dfg", "--range", "0..1"]).0, 4);
    assert!(check(&["results/dfg", "--pick", "1"]).1.contains("scale finite"));
}

#[test]
fn what_cannot_be_understood_is_refused_with_advice() {
    for (args, code, expected) in [
        (&["y = 1/(x - $a)", "--domain", "x=2..3"][..], 3, "free constant"),
        (&["y = 1/x", "--domain", "x=1..1e39"], 2, "finite f32s"),
        (&["results/dfg", "--domain", "roughness=0.3..0.9"], 2, "the domain of its run"),
        (&["y = x*z", "--domain", "x=0..1"][..], 2, "--domain z=0..1"),
        (&["y = x", "--domain", "x=1..0"], 2, "LOW..HIGH"),
        (&["y = x", "--domain", "x=0..1,w=0..1"], 2, "no input `w`"),
        (&["y = x", "--domain", "x=0..1", "--range", "z=0..1"], 2, "no output `z`"),
        (&["y = x", "--domain", "x=0..1", "--energy"], 2, "scale"),
        (&["nowhere"], 3, "no such folder"),
        (&["results/dfg", "--pick", "999"], 2, "--pick 999"),
        (&["bias = $a*n_dot_v", "datasets/dfg.bin"], 3, "$a"),
    ] {
        let (found, shown, errors) = check(args);
        assert_eq!(found, code, "{args:?}: {errors}");
        assert!(errors.contains(expected), "{args:?}: {errors}");
        assert_eq!(shown, "");
    }
}
