//! `lgp cost` on the real command line.

#![cfg(feature = "cli")]

mod command;

use command::{lgp_here, text};
use lgp::cost::Profile;
use serde_json::Value;
use std::process::Output;

fn cost(args: &[&str]) -> Output {
    lgp_here(&[&["cost"][..], args].concat())
}

fn json(args: &[&str]) -> Vec<Value> {
    let output = cost(&[args, &["--json"]].concat());
    assert!(output.status.success(), "{}", text(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

const IDENTITIES: &str = "s = rsqrt(2*l_dot_v + 2); n_dot_h = (n_dot_l + n_dot_v)*s; \
    l_dot_h = l_dot_v*s + s";

/// The figures are Hammon's, GDC 2017.
#[test]
fn every_gpu_has_its_figures() {
    let costs = json(&[IDENTITIES, "--outputs", "n_dot_h,l_dot_h", "--gpu", "all"]);
    let gpus: Vec<&str> = costs.iter().map(|cost| cost["gpu"].as_str().unwrap()).collect();
    assert_eq!(gpus, Profile::built_in().collect::<Vec<_>>());
    assert_eq!(costs[0]["cycles"], 8.0);
    assert_eq!(costs[0]["registers"], 2);
    assert_eq!(costs[0]["critical_path"], 6.0);
    assert_eq!(costs[0]["ops"]["add"]["count"], 3);
    assert_eq!(costs[0]["ops"]["rsqrt"]["slots"]["vector"], 4.0);
    // Statements that no later one reads are the default.
    assert_eq!(json(&[IDENTITIES, "--gpu", "gcn"])[0]["cycles"], 8.0);
    assert_eq!(json(&[IDENTITIES, "--outputs", "l_dot_h", "--gpu", "gcn"])[0]["cycles"], 6.0);
}

#[test]
fn the_breakdown_sums_to_the_cycles() {
    let formula = "d = saturate(x*3 - y)/sqrt(z); f = min(d^5, exp2(-9.28*z)) + .04*d";
    for cost in json(&[formula]) {
        let limit = cost["limit"].as_str().unwrap();
        let slots = cost["ops"].as_object().unwrap().values();
        let sum: f64 = slots.filter_map(|op| op["slots"][limit].as_f64()).sum();
        assert_eq!(sum, cost["cycles"].as_f64().unwrap(), "{cost}");
    }
    let shown = text(&cost(&[formula, "--gpu", "rdna2,ampere"]).stdout);
    for expected in ["limited by", "rdna2", "ampere", "critical path", "exp2", "issue"] {
        assert!(shown.contains(expected), "{expected} is not in\n{shown}");
    }
    assert!(!shown.contains("gcn"), "{shown}");
}

#[test]
fn bad_input_is_refused() {
    for (args, code, expected) in [
        (&["y = sqt(x)"][..], 3, "did you mean `sqrt`?"),
        (&["y = x", "--gpu", "gnc"], 3, "did you mean `gcn`?"),
        (&["y = x", "--gpu", "nowhere.ron"], 3, "nowhere.ron"),
        (&["y = x", "--outputs", "z"], 3, "z"),
        (&[""], 3, "formula"),
        (&[], 2, "FORMULA"),
    ] {
        let output = cost(args);
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(code), "{args:?}: {message}");
        assert!(message.contains(expected), "{args:?}: {message}");
        assert!(output.stdout.is_empty(), "{args:?}");
    }
}
