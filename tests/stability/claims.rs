//! Claims: what a text asks, and what becomes of it.

use lgp::dataset::{Column, Dataset};
use lgp::program::{Claim, Names, parse};
use lgp::run::Run;
use lgp::stability::{Questions, Status, Verdict, VerdictRecord};
use std::path::Path;

fn names() -> Names {
    Names::new(["x"], ["scale", "bias"])
}

/// The verdict on a formula over x in [0, 1] with outputs that may be anything.
fn judged(formula: &str, claims: &[&str]) -> Verdict {
    let inputs = [Column::new("x", [0.0, 1.0])];
    let outputs = ["scale", "bias"].map(|name| Column::new(name, [-9.0, 9.0]));
    let claims: Vec<String> = claims.iter().map(|&text| text.to_owned()).collect();
    let questions = Questions::of(&inputs, &outputs, &claims);
    assert_eq!(questions.claims.len(), claims.len());
    Verdict::of(&parse(formula, &names()).unwrap(), &questions)
}

fn refuted(verdict: &Verdict, claim: &str) -> Vec<(String, f32)> {
    let finding = verdict.worst(claim).unwrap();
    let Status::Refuted { input, value } = &finding.exact else { panic!("{finding:?}") };
    assert!(finding.property.excess(*value, 1e-5) > 0.0);
    finding.named(&names(), input)
}

fn is_proved(verdict: &Verdict, claim: &str) -> bool {
    let finding = verdict.worst(claim).unwrap();
    (&finding.exact, &finding.gpu) == (&Status::Proved, &Status::Proved)
}

/// What outputs are called does not matter, where the claim is over their names.
#[test]
fn outputs_by_another_name_have_the_same_verdict() {
    let formulas = [
        "scale = 0.5; bias = 0.25",
        "scale = saturate(1 - roughness*n_dot_v); bias = exp2(-(7*n_dot_v + 4*roughness^2))",
        "scale = 1.02 - roughness; bias = 0.01",
        "scale = n_dot_v/(n_dot_v + 0.3*roughness^2 + 0.0001); bias = 0.1*n_dot_v*roughness",
    ];
    let dfg = Dataset::load(Path::new("datasets/dfg.bin")).unwrap();
    let mut renamed = dfg.clone();
    renamed.claims.clear();
    for (column, name) in renamed.outputs.iter_mut().zip(["a", "b"]) {
        column.name = name.to_owned();
    }
    renamed.claim("energy: f0*a + b <= 1 for f0 in 0..1").unwrap();
    let judged = |data: &Dataset, text: &str| {
        let questions = Questions::of(&data.inputs, &data.outputs, &data.claims);
        let verdict = Verdict::of(&parse(text, &data.names()).unwrap(), &questions);
        (VerdictRecord::new(&verdict, &data.names()), verdict)
    };
    let mut energies = Vec::new();
    for formula in formulas {
        let other = formula.replace("scale", "a").replace("bias", "b");
        let ((record, verdict), (again, other)) = (judged(&dfg, formula), judged(&renamed, &other));
        let statuses = |verdict: &Verdict| -> Vec<_> {
            let each = verdict.findings.iter();
            each.map(|finding| (finding.exact.clone(), finding.gpu.clone())).collect()
        };
        assert_eq!(statuses(&verdict), statuses(&other), "{formula}");
        let (energy, again) = (&record.claims["energy"], &again.claims["energy"]);
        assert_eq!((&energy.exact, &energy.gpu), (&again.exact, &again.gpu), "{formula}");
        energies.push(energy.exact.status.clone());
    }
    assert_eq!(energies, ["proved", "refuted", "refuted", "refuted"]);
}

#[test]
fn a_variable_is_looked_at_at_its_ends_where_the_claim_is_linear_in_it() {
    let claim = "energy: f0*scale + bias <= 1 for f0 in 0..1";
    let verdict = judged("scale = 0.9 - x; bias = x*0.5", &[claim]);
    assert!(is_proved(&verdict, "energy"));
    let given: Vec<String> = verdict.findings.iter().map(|finding| finding.given()).collect();
    assert_eq!(given[given.len() - 2..], [" (f0 = 0)", " (f0 = 1)"]);
    let verdict = judged("scale = 1.5 - x; bias = 0.1*x", &[claim]);
    let at = refuted(&verdict, "energy");
    assert!(at.contains(&("f0".to_owned(), 1.0)), "{at:?}");
    let two = "both: f*scale + g*bias - f*g*bias/2 <= 1 for f in 0..1, g in -1..1";
    let verdict = judged("scale = 0.5; bias = 0.2", &[two]);
    assert_eq!(verdict.findings.iter().filter(|finding| finding.topic == "both").count(), 4);
    assert!(is_proved(&verdict, "both"));
}

#[test]
fn a_variable_is_anything_in_its_range_where_the_claim_is_not() {
    let wave = "wave: scale*sin(t) + bias <= 1 for t in 0..3";
    assert!(is_proved(&judged("scale = 0.5*x; bias = 0.4", &[wave]), "wave"));
    // Neither end of the range fails.
    let at = refuted(&judged("scale = 0.5*x; bias = 0.6", &[wave]), "wave");
    let t = at.iter().find(|(name, _)| name == "t").unwrap().1;
    assert!((0.5..2.5).contains(&t), "{at:?}");
    // What else is asked is not looked at by it.
    let verdict = judged("scale = 1/(x - 0.5); bias = 0", &[wave]);
    assert_eq!(refuted(&verdict, "finite"), [("x".to_owned(), 0.5)]);
}

#[test]
fn either_side_may_be_a_number_or_neither() {
    let claims =
        ["a: 0 <= scale", "b: scale >= bias", "c: bias ≤ scale*x + 1/4", "d: 2^2 >= scale"];
    let verdict = judged("scale = x; bias = 0.5*x", &claims);
    assert_eq!(verdict.topics()[1..], ["a", "b", "c", "d"]);
    assert!(["a", "b", "d"].iter().all(|name| is_proved(&verdict, name)), "{verdict:?}");
    let texts: Vec<String> = verdict.findings[2..].iter().map(|f| f.text(&names())).collect();
    assert_eq!(
        texts,
        ["scale ≥ 0", "scale - (bias) ≥ 0", "bias - (scale*x + 1/4) ≤ 0", "scale ≤ 4"]
    );
    // 0.5 x - x² is 1/16 at most.
    assert!(is_proved(&verdict, "c"));
}

#[test]
fn what_is_no_claim_is_refused_where_it_is_wrong() {
    for (text, column, expected) in [
        ("scale <= 1", 1, "a claim is `name: expression <= expression`"),
        ("2: scale <= 1", 1, "cannot name a claim"),
        ("range: scale <= 1", 1, "cannot name a claim"),
        ("a: scale + 1", 13, "one `<=` or `>=`"),
        ("a: 0 <= scale <= 1", 15, "one `<=` or `>=`"),
        ("a: scale + bais <= 1", 12, "did you mean `bias`?"),
        ("a: scale <= 1 + k", 17, "unknown name `k`"),
        ("a: scale <= ", 13, "expected an expression"),
        ("a: <= scale", 4, "expected an expression"),
        ("a: scale <= $k", 13, "free constant"),
        ("a: scale <= 1/0", 10, "not a finite number"),
        ("a: x <= 1", 3, "it is about no output; the outputs are scale, bias"),
        ("a: scale*k <= 1 for k in 1..0", 21, "as in `f0 in 0..1`"),
        ("a: scale*k <= 1 for x in 0..1", 21, "`x` is already in use"),
        ("a: scale <= 1; b: bias <= 1", 14, "one comparison"),
    ] {
        let error = Claim::parse(text, &names()).unwrap_err();
        assert_eq!((error.line, error.column), (1, column), "{text}: {error}");
        assert!(error.message.contains(expected), "{text}: {error}");
        assert_eq!(error.source_line, text);
    }
}

#[test]
fn a_selection_keeps_the_claims_over_its_columns() {
    let mut data = Dataset::load(Path::new("datasets/dfg.bin")).unwrap();
    data.claim("small: bias <= 1 - n_dot_v").unwrap();
    assert_eq!(data.claims.len(), 2);
    let select = |inputs: &[&str]| {
        let inputs: Vec<String> = inputs.iter().map(|&name| name.to_owned()).collect();
        data.select(Some(&inputs), Some(&["bias".to_owned()])).unwrap().claims
    };
    assert_eq!(select(&["n_dot_v", "roughness"]), ["small: bias <= 1 - n_dot_v"]);
    assert!(select(&["roughness"]).is_empty());
    let error = data.claim("small: scale <= bais").unwrap_err().to_string();
    assert!(error.contains("column 17") && error.contains("did you mean `bias`?"), "{error}");
}

#[test]
fn a_record_of_a_claim_that_is_none_is_refused_at_its_line() {
    let text = std::fs::read_to_string("tests/fixtures/dfg/run.ron").unwrap();
    let run = Run::from_ron(&text).unwrap();
    assert_eq!(run.questions().claims[0].name, "energy");
    let none = Run { claims: Vec::new(), ..run.clone() };
    assert!(Run::from_ron(&none.to_ron()).unwrap().questions().claims.is_empty());
    let wrong = Run { claims: vec!["energy: scale <= bais".into()], ..run };
    let (line, reason) = Run::from_ron(&wrong.to_ron()).unwrap_err();
    assert!(wrong.to_ron().lines().nth(line - 1).unwrap().contains("claims"), "{line}: {reason}");
    assert!(reason.contains("did you mean `bias`?"), "{reason}");
}
