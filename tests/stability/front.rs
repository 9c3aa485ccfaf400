//! Verdicts of whole fronts.

use lgp::cost::Profile;
use lgp::dataset::Dataset;
use lgp::fit::Measure;
use lgp::program::{Names, parse};
use lgp::search::{Front, FrontMember};
use lgp::stability::{Questions, Status, StatusRecord, Verdict, VerdictRecord};
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};

/// A front of the fixtures: everything finite is proved, and hardly anything is left open.
#[test]
fn of_a_front_all_but_little_is_decided() {
    let dataset = Dataset::load(Path::new("datasets/dfg.bin")).unwrap();
    let questions = Questions::of(&dataset.inputs, &dataset.outputs, &dataset.claims);
    assert_eq!(questions.ranges, [[0.0, 1.0]; 2]);
    let text = std::fs::read_to_string("tests/fixtures/dfg/front.json").unwrap();
    let members: serde_json::Value = serde_json::from_str(&text).unwrap();
    let members = members.as_array().unwrap();
    let mut open = 0;
    for member in members {
        let program = parse(member["formula"].as_str().unwrap(), &dataset.names()).unwrap();
        let verdict = Verdict::of(&program, &questions);
        let finite = verdict.worst("finite").unwrap();
        assert_eq!((&finite.exact, &finite.gpu), (&Status::Proved, &Status::Proved));
        let is_open = |status: &Status| matches!(status, Status::Open { .. });
        open += verdict.findings.iter().filter(|f| is_open(&f.exact) || is_open(&f.gpu)).count();
        for finding in &verdict.findings {
            let Status::Refuted { input, value } = &finding.exact else { continue };
            assert_eq!(input.len(), 2);
            assert!(finding.property.excess(*value, questions.slack) > 0.0);
        }
    }
    assert!(open * 10 <= members.len(), "{open} claims open on {} formulas", members.len());
}

/// What is at most 1 is not refuted for the rounding of a sum that nobody has to make.
#[test]
fn an_energy_of_exactly_one_is_not_refuted() {
    let dataset = Dataset::load(Path::new("datasets/dfg.bin")).unwrap();
    let program = parse("bias = n_dot_v; scale = 1 - n_dot_v", &dataset.names()).unwrap();
    let questions = Questions {
        slack: 0.0,
        ..Questions::of(&dataset.inputs, &dataset.outputs, &dataset.claims)
    };
    let energy = Verdict::of(&program, &questions).worst("energy").unwrap().clone();
    assert!(!matches!(energy.exact, Status::Refuted { .. }), "{energy:?}");
    let usual = Questions { slack: 1e-5, ..questions };
    let energy = Verdict::of(&program, &usual).worst("energy").unwrap().clone();
    assert_eq!((energy.exact, energy.gpu), (Status::Proved, Status::Proved));
}

/// Some formulas for `dfg.bin`, as a front that nobody has judged: decided at once, with some work, not
/// at all, and refuted.
fn unjudged() -> (Front, Questions, Names) {
    let dataset = Dataset::load(Path::new("datasets/dfg.bin")).unwrap();
    let (names, profile) = (dataset.names(), Profile::find("gcn").unwrap());
    let formulas = [
        "scale = 0.5; bias = 0.25",
        "scale = saturate(1 - roughness*n_dot_v); bias = exp2(-(7*n_dot_v + 4*roughness^2))",
        "scale = 1 - 0.9*roughness^3*sin(40*n_dot_v)^2; bias = 0.01",
        "scale = n_dot_v/(n_dot_v + 0.3*roughness^2 + 0.0001); bias = 0.1*n_dot_v*roughness",
        "scale = 1.02 - roughness; bias = 0.01",
    ];
    let member =
        |text: &&str| FrontMember::new(parse(text, &names).unwrap(), &dataset, &profile, &names);
    let members = formulas.iter().map(member).collect();
    let questions = Questions::of(&dataset.inputs, &dataset.outputs, &dataset.claims);
    (Front { measure: Measure::default(), members }, questions, names)
}

fn statuses(verdict: &VerdictRecord) -> Vec<&StatusRecord> {
    let claims = verdict.topics().into_iter().map(|(_, claim)| claim);
    claims.flat_map(|claim| claim.gpu.iter().chain([&claim.exact])).collect()
}

#[test]
fn a_front_is_judged_as_each_of_its_members() {
    let (mut front, questions, names) = unjudged();
    front.judge(&questions, &names);
    for member in &front.members {
        let alone = VerdictRecord::new(&Verdict::of(&member.program, &questions), &names);
        assert_eq!(member.verdict, alone, "{}", member.formula);
    }
    let all = front.members.iter().flat_map(|member| statuses(&member.verdict));
    let all: Vec<&str> = all.map(|status| status.status.as_str()).collect();
    assert!(["proved", "refuted", "open"].iter().all(|word| all.contains(word)), "{all:?}");
}

#[test]
fn a_judgement_cut_short_claims_nothing_that_the_whole_does_not() {
    let (unjudged, questions, names) = unjudged();
    let mut whole = unjudged.clone();
    whole.judge(&questions, &names);
    let mut before = 0;
    for asked in [0, 1, 10, 100, 1000, 4000, 10_000, 40_000] {
        let left = AtomicUsize::new(asked);
        let stopped = || {
            left.fetch_update(Ordering::Relaxed, Ordering::Relaxed, |n| n.checked_sub(1)).is_err()
        };
        let mut short = unjudged.clone();
        short.judge_until(&questions, &names, &stopped);
        let pairs = short.members.iter().zip(&whole.members);
        let mut decided = 0;
        for (short, whole) in pairs.filter(|(short, _)| short.verdict.is_judged()) {
            for (short, whole) in statuses(&short.verdict).into_iter().zip(statuses(&whole.verdict))
            {
                if short.status == "proved" {
                    assert_eq!(whole.status, "proved");
                }
                if short.status == "refuted" {
                    assert_eq!(whole.status, "refuted");
                }
                decided += usize::from(short.status != "open");
            }
        }
        assert!(asked > 0 || decided == 0);
        before = decided;
    }
    assert!(before > 0);
}
