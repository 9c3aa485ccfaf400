//! Verdicts of whole fronts.

use lgp::dataset::Dataset;
use lgp::program::parse;
use lgp::stability::{Questions, Status, Topic, Verdict};
use std::path::Path;

/// The committed front: everything finite is proved, and hardly anything is left open.
#[test]
fn of_the_committed_front_all_but_little_is_decided() {
    let dataset = Dataset::load(Path::new("datasets/dfg.bin")).unwrap();
    let questions = Questions::of(&dataset.inputs, &dataset.outputs);
    assert_eq!(questions.ranges, [[0.0, 1.0]; 2]);
    let text = std::fs::read_to_string("results/dfg/front.json").unwrap();
    let members: serde_json::Value = serde_json::from_str(&text).unwrap();
    let members = members.as_array().unwrap();
    let mut open = 0;
    for member in members {
        let program = parse(member["formula"].as_str().unwrap(), &dataset.names()).unwrap();
        let verdict = Verdict::of(&program, &questions);
        let finite = verdict.worst(Topic::Finite).unwrap();
        assert_eq!((&finite.exact, &finite.gpu), (&Status::Proved, &Status::Proved));
        let is_open = |status: &Status| matches!(status, Status::Open { .. });
        open += verdict.findings.iter().filter(|f| is_open(&f.exact) || is_open(&f.gpu)).count();
        for finding in &verdict.findings {
            let Status::Refuted { input, value } = &finding.exact else { continue };
            assert_eq!(input.len(), 2);
            assert!(finding.claim.excess(*value, questions.slack) > 0.0);
        }
    }
    assert!(open * 10 <= members.len(), "{open} claims open on {} formulas", members.len());
}

/// What is at most 1 is not refuted for the rounding of a sum that nobody has to make.
#[test]
fn an_energy_of_exactly_one_is_not_refuted() {
    let dataset = Dataset::load(Path::new("datasets/dfg.bin")).unwrap();
    let program = parse("bias = n_dot_v; scale = 1 - n_dot_v", &dataset.names()).unwrap();
    let questions = Questions { slack: 0.0, ..Questions::of(&dataset.inputs, &dataset.outputs) };
    let energy = Verdict::of(&program, &questions).worst(Topic::Energy).unwrap().clone();
    assert!(!matches!(energy.exact, Status::Refuted { .. }), "{energy:?}");
    let usual = Questions { slack: 1e-5, ..questions };
    let energy = Verdict::of(&program, &usual).worst(Topic::Energy).unwrap().clone();
    assert_eq!((energy.exact, energy.gpu), (Status::Proved, Status::Proved));
}
