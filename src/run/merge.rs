//! The union of runs: associative, commutative and idempotent, so that any scheduler can spread
//! seeds over machines and merge what comes back, in any order.

use super::{Run, one_line};
use crate::cost::Profile;
use crate::fit::Measure;
use crate::grammar::Grammar;
use crate::search::{CostOf, Front};
use std::collections::BTreeMap;

/// Runs that have no union.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the runs differ in their {what}: {one} and {other}; merge runs of the same {what}")]
pub struct Incompatible {
    what: &'static str,
    one: String,
    other: String,
}

/// Merges runs: returns the members that none dominates, and a run whose sources are all searches
/// that they came from, each once. Returns none for no runs.
///
/// # Errors
/// Runs of other data, scenes, columns, claims, grammars, GPU profiles, error measures or
/// requirements, or of which one costs a template's holes alone. (Settings of where to look, such as
/// transforms or templates, may differ: their formulas are as good. Of several templates none is
/// the union's, whose members then show the whole alone.)
pub fn merge(runs: Vec<(Run, Front)>) -> Result<Option<(Run, Front)>, Incompatible> {
    let mut sources = Vec::new();
    let mut members = Vec::new();
    let measure = runs.first().map_or(Measure::Rmse, |(_, front)| front.measure);
    for (run, front) in runs {
        match run.sources.is_empty() {
            true => sources.push(Run { files: BTreeMap::new(), ..run }),
            false => sources.extend(run.sources),
        }
        members.extend(front.members);
    }
    let Some(first) = sources.first() else { return Ok(None) };
    for other in &sources[1..] {
        check(first, other)?;
    }
    let union = union(sources);
    if union.goal.template.is_none() {
        members.iter_mut().for_each(|member| member.holes.clear());
    }
    Ok(Some((union, Front::from_members(members, measure))))
}

fn check(one: &Run, other: &Run) -> Result<(), Incompatible> {
    let names = |run: &Run| {
        let names = run.names();
        format!("{} → {}", names.inputs.join(", "), names.outputs.join(", "))
    };
    let data = |run: &Run| format!("{} ({})", run.name, run.dataset_hash);
    let scene = |run: &Run| match &run.scene {
        Some(scene) => format!("{} ({})", scene.name, scene.summary()),
        None => "none".to_owned(),
    };
    let costed = |run: &Run| match (run.goal.cost_of, &run.goal.template) {
        (CostOf::Holes, Some(template)) => format!("of the holes of `{}`", one_line(template)),
        _ => "of the whole formula".to_owned(),
    };
    if one.scene != other.scene {
        return Err(Incompatible { what: "scene", one: scene(one), other: scene(other) });
    }
    let [grammars, profiles] = [one.grammars_beside(other), one.profiles_beside(other)];
    let differences = [
        ("dataset", data(one), data(other)),
        ("columns", names(one), names(other)),
        ("claims", one.claims.join("; "), other.claims.join("; ")),
        ("requirements", one.requirements(), other.requirements()),
        ("grammar", grammars[0].clone(), grammars[1].clone()),
        ("GPU profile", profiles[0].clone(), profiles[1].clone()),
        ("costs", costed(one), costed(other)),
        ("derived outputs", one.derived.join("; "), other.derived.join("; ")),
        ("error measure", one.goal.measure.to_string(), other.goal.measure.to_string()),
    ];
    match differences.into_iter().find(|(_, one, other)| one != other) {
        None => Ok(()),
        Some((what, one, other)) => Err(Incompatible { what, one, other }),
    }
}

impl Run {
    /// Returns what tells the grammars of two runs apart.
    pub fn grammars_beside(&self, other: &Run) -> [String; 2] {
        let content = |run: &Run| run.rules.as_ref().map(Grammar::fingerprint);
        contents((&self.grammar, content(self)), (&other.grammar, content(other)))
    }

    /// Returns what tells the GPU profiles of two runs apart.
    pub fn profiles_beside(&self, other: &Run) -> [String; 2] {
        let content = |run: &Run| run.profile.as_ref().map(Profile::fingerprint);
        contents((&self.gpu, content(self)), (&other.gpu, content(other)))
    }

    /// Returns true if everything costs the same in both runs.
    pub fn has_profile_of(&self, other: &Run) -> bool {
        let [own, others] = self.profiles_beside(other);
        own == others
    }
}

/// Returns what tells two files apart: their contents, or their names where a record of an older
/// version lacks contents.
fn contents(one: (&str, Option<String>), other: (&str, Option<String>)) -> [String; 2] {
    match (one, other) {
        ((_, Some(a)), (_, Some(b))) if a == b => [a, b],
        ((one, Some(a)), (other, Some(b))) => [(one, a), (other, b)]
            .map(|(name, content)| format!("{name} (content {})", &content[..8])),
        ((one, _), (other, _)) => [one.to_owned(), other.to_owned()],
    }
}

/// Returns the record of a union; it depends on the set of all searches alone.
fn union(mut sources: Vec<Run>) -> Run {
    let key = |run: &Run| ron::to_string(run).expect("plain data");
    sources.sort_by_cached_key(key);
    sources.dedup();
    let mut union = Run { command: vec!["lgp".into(), "merge".into()], ..sources[0].clone() };
    if sources.iter().any(|source| source.goal.template != union.goal.template) {
        union.goal.template = None;
    }
    for source in &sources[1..] {
        union.generations += source.generations;
        union.seconds += source.seconds;
        union.counts.add(&source.counts);
    }
    union.sources = sources;
    union
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::eval::{OutputError, Score};
    use crate::program::{Names, parse};
    use crate::scene::Scene;
    use crate::search::{Counts, FrontMember, Method, Requirement};
    use crate::stability::VerdictRecord;

    fn run(seed: u64, members: &[(f64, f64, &str)]) -> (Run, Front) {
        let column = |name: &str| crate::dataset::Column {
            name: name.into(),
            unit: "1".into(),
            domain: [0.0, 1.0],
        };
        let run = Run {
            version: "1".into(),
            command: vec![format!("lgp search --seed {seed}")],
            dataset: "d.bin".into(),
            dataset_hash: "ab".into(),
            scene: None,
            name: "d".into(),
            inputs: vec![column("x")],
            outputs: vec![column("y")],
            grammar: "shader".into(),
            gpu: "gcn".into(),
            method: Method { seed, ..Method::default() },
            machine: "m".into(),
            threads: 1,
            generations: seed,
            seconds: 0.5,
            enumeration: None,
            counts: Counts { considered: 10, ..Counts::default() },
            ..Run::default()
        };
        let names = Names::new(["x"], ["y"]);
        let member = |&(cost, rmse, formula): &(f64, f64, &str)| {
            let (weighted, visible) = (None, None);
            let errors = vec![OutputError { rmse, max: rmse, relative: rmse, weighted, visible }];
            FrontMember {
                program: parse(formula, &names).unwrap(),
                cost,
                registers: None,
                score: Score { search: errors.clone(), validation: errors, units: vec![1.0] },
                domain: Vec::new(),
                verdict: VerdictRecord::default(),
                formula: formula.into(),
                holes: Vec::new(),
            }
        };
        (run, Front { measure: Measure::Rmse, members: members.iter().map(member).collect() })
    }

    fn union_of(runs: &[&(Run, Front)]) -> (Run, Front) {
        merge(runs.iter().map(|&run| run.clone()).collect()).unwrap().unwrap()
    }

    #[test]
    fn merging_is_associative_commutative_and_idempotent() {
        let a = run(1, &[(1.0, 0.5, "y = x"), (3.0, 0.2, "y = x*x + x")]);
        let b = run(2, &[(1.0, 0.5, "y = x + 0"), (2.0, 0.4, "y = x*x"), (4.0, 0.3, "y = 1/x")]);
        let c = run(3, &[(0.0, 0.6, "y = 0.5"), (2.5, 0.2, "y = x*x - x")]);
        let all = union_of(&[&a, &b, &c]);
        assert_eq!(all, union_of(&[&c, &a, &b]));
        assert_eq!(all, union_of(&[&union_of(&[&a, &b]), &c]));
        assert_eq!(all, union_of(&[&a, &union_of(&[&c, &b])]));
        assert_eq!(all, union_of(&[&all, &all, &b]));
        assert_eq!(union_of(&[&a]), union_of(&[&a, &a]));
        let formulas: Vec<&str> = all.1.members.iter().map(|m| m.formula.as_str()).collect();
        assert_eq!(formulas, ["y = 0.5", "y = x", "y = x*x", "y = x*x - x"]);
        assert_eq!((all.0.generations, all.0.counts.considered, all.0.sources.len()), (6, 30, 3));
    }

    #[test]
    fn runs_of_other_things_have_no_union() {
        let a = run(1, &[]);
        let mut b = run(2, &[]);
        b.0.gpu = "rdna2".into();
        let error = merge(vec![a.clone(), b]).unwrap_err().to_string();
        assert!(error.contains("GPU profile: gcn and rdna2"), "{error}");
        let mut b = run(2, &[]);
        let names = b.0.names();
        b.0.goal.requirements = vec![Requirement::parse("y.range=0..1", &names).unwrap()];
        let error = merge(vec![a.clone(), b]).unwrap_err().to_string();
        assert!(error.contains("requirements: none and y.range=0..1"), "{error}");
        let mut b = run(2, &[]);
        b.0.scene = Some(Scene { name: "half".into(), ..Scene::default() });
        assert!(
            merge(vec![a.clone(), b]).unwrap_err().to_string().contains("scene: none and half")
        );
        let mut b = run(2, &[]);
        b.0.goal.template = Some("y = f(x)".into());
        b.0.goal.cost_of = CostOf::Holes;
        let error = merge(vec![a.clone(), b]).unwrap_err().to_string();
        assert!(error.contains("of the whole formula and of the holes of `y = f(x)`"), "{error}");
        let mut c = run(2, &[]);
        c.0.dataset_hash = "cd".into();
        assert!(merge(vec![a, c]).unwrap_err().to_string().contains("dataset: d (ab) and d (cd)"));
        assert_eq!(merge(Vec::new()), Ok(None));
    }
}
