//! The comparison of several runs.

use super::Error;
use super::page::{self, ComparedRun, Comparison, Group};
use crate::fit::Measure;
use crate::run::{Run, TRACE_COSTS, load_front, load_run, load_trace};
use crate::wording::axis_title;
use std::path::PathBuf;

/// Returns the page that compares the runs of several folders.
///
/// # Errors
/// [`Error::Record`]; [`Error::Incomparable`]; [`Error::NothingToCompare`] without a folder.
pub fn comparison(folders: &[PathBuf]) -> Result<String, Error> {
    let mut runs = Vec::new();
    for folder in folders {
        let run = load_run(folder)?;
        let front = load_front(folder, &run, false)?;
        let members = front.members.iter().map(|member| {
            let errors = measures(&run).into_iter().map(|measure| member.error().of(measure));
            [member.cost].into_iter().chain(errors).collect()
        });
        let compared = ComparedRun {
            seconds: run.seconds,
            considered: run.counts.considered,
            front: members.collect(),
            trace: load_trace(folder, &run)?.filter(|trace| !trace.seconds.is_empty()),
        };
        runs.push((run, compared));
    }
    let first = runs.first().ok_or(Error::NothingToCompare)?.0.clone();
    check_comparable(folders, &runs, &first)?;
    let comparison = Comparison {
        title: format!("{}: {} runs compared", first.name, runs.len()),
        subtitle: format!(
            "{}; dataset {}, on {}",
            first.names().outputs.join(", "),
            first.dataset_hash,
            first.machine
        ),
        gpu: first.gpu.clone(),
        costs: TRACE_COSTS.to_vec(),
        measures: measures(&first).into_iter().map(axis_title).collect(),
        same_budget: runs.iter().all(|(run, _)| run.goal.max_cost == first.goal.max_cost),
        groups: groups(runs),
    };
    Ok(page::comparison(&comparison))
}

/// Returns the measure that the run minimised, and the usual ones.
fn measures(run: &Run) -> Vec<Measure> {
    let own = run.goal.measure;
    let usual = [Measure::Rmse, Measure::Max].into_iter().filter(|one| *one != own);
    [own].into_iter().chain(usual).collect()
}

/// Checks that errors and cycles are of the same data and GPU.
fn check_comparable(
    folders: &[PathBuf],
    runs: &[(Run, ComparedRun)],
    first: &Run,
) -> Result<(), Error> {
    for (folder, (run, _)) in folders.iter().zip(runs) {
        let what = [
            ("data", run.dataset_hash == first.dataset_hash),
            ("scene", run.scene == first.scene),
            ("outputs", run.outputs == first.outputs),
            ("GPU profile", run.has_profile_of(first)),
            ("error measure", run.goal.measure == first.goal.measure),
        ];
        if let Some((what, _)) = what.iter().find(|(_, same)| !same) {
            let [one, other] = [folder, &folders[0]].map(|folder| folder.display().to_string());
            return Err(Error::Incomparable { one, other, what });
        }
    }
    Ok(())
}

/// Groups runs that differ only in their seeds, each group named by what tells it from the others.
fn groups(runs: Vec<(Run, ComparedRun)>) -> Vec<Group> {
    let kinds: Vec<Vec<(&str, String)>> = runs.iter().map(|(run, _)| traits(run)).collect();
    let told_apart: Vec<usize> =
        (0..kinds[0].len()).filter(|&i| kinds.iter().any(|kind| kind[i] != kinds[0][i])).collect();
    let mut groups: Vec<(Vec<(&str, String)>, Group)> = Vec::new();
    for ((_, compared), kind) in runs.into_iter().zip(kinds) {
        match groups.iter_mut().find(|(known, _)| *known == kind) {
            Some((_, group)) => group.runs.push(compared),
            None => {
                let parts = told_apart.iter().map(|&i| format!("{} {}", kind[i].0, kind[i].1));
                let label = parts.collect::<Vec<_>>().join(", ");
                let label = if label.is_empty() { "all".to_owned() } else { label };
                groups.push((kind, Group { label, runs: vec![compared] }));
            }
        }
    }
    groups.into_iter().map(|(_, group)| group).collect()
}

/// Returns what decides how a run goes, without its seed.
fn traits(run: &Run) -> Vec<(&'static str, String)> {
    let (goal, method) = (&run.goal, &run.method);
    let inputs: Vec<&str> = run.inputs.iter().map(|input| input.name.as_str()).collect();
    let enumerated = run.enumeration.map_or(0.0, |enumeration| enumeration.cost);
    vec![
        ("grammar", run.grammar.clone()),
        ("inputs", inputs.join(" ")),
        ("max. cycles", goal.max_cost.to_string()),
        ("islands", method.islands.to_string()),
        ("candidates", method.candidates.to_string()),
        ("bucket", method.bucket_size.to_string()),
        ("exhaustive", enumerated.to_string()),
        ("random share", method.immigrants.to_string()),
        ("requirements", run.requirements()),
        ("transforms", format!("{:?}", goal.transforms)),
        ("searches merged", run.sources.len().to_string()),
        ("lgp", run.version.clone()),
    ]
}
