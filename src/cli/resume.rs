//! Resumed searches, which take their options from their run.

use super::plan::{Plan, budget, default_folders, following, requirements, transforms};
use super::search::Args;
use super::{Common, Failure};
use crate::cost::Profile;
use crate::dataset::Dataset;
use crate::grammar::Grammar;
use crate::run::Subject;
use crate::run::{Budget, Checkpoint, Folder, Holding, RecordError, Run, Session, load_run};
use crate::scene::Scene;
use crate::search::{Goal, Problem, Transform};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Returns the plan of the run in the output folder; options that are given again must be as they
/// were.
pub fn resumed(args: &Args, common: &Common) -> Result<Plan, Failure> {
    let path = match (&args.out, &args.dataset) {
        (Some(out), _) => out.clone(),
        (None, Some(dataset)) => {
            let subject =
                Subject::load_with(dataset, args.scene.as_deref(), &args.derive, |data| {
                    args.columns.of(data)
                })?;
            the_one_of(&subject.dataset.name)?
        }
        (None, None) => {
            let message = "--resume: say which run to go on with, by --out DIR or its dataset";
            return Err(Failure::usage(message));
        }
    };
    check_resumable(&path)?;
    let folder = Folder::claim(&path)?;
    let mut checkpoint = Checkpoint::load(&path)?;
    let run = &mut checkpoint.run;
    let subject = match &args.dataset {
        Some(given) => Subject::of_run_at(run, given)?,
        None => Subject::of_run(run, &path).map_err(|problem| {
            let advice = format!("lgp search DATASET --resume --out {}", path.display());
            let message = format!("{problem}; give the dataset where it is now: {advice}");
            Failure::input(message)
        })?,
    };
    if let Some(difference) = difference(args, common, run, &subject.dataset)? {
        let message = format!(
            "{}: the run there has {difference}; leave that option out to go on with it, or search anew in another --out",
            path.display()
        );
        return Err(Failure::input(message));
    }
    let budget = budget_left(args, run, &path)?;
    let profile = run.profile().ok_or_else(|| {
        let message = format!("{}: its record lacks the GPU profile", path.display());
        Failure::input(message)
    })?;
    let problem = Problem::of(Arc::clone(&subject.dataset))
        .grammar(run.grammar()?)
        .profile(profile)
        .goal(run.goal.clone())
        .build()?;
    let guesses = run.guesses.clone();
    let session = Session::resume(problem, checkpoint)?
        .budget(budget)
        .guesses(&guesses)?
        .kept_in(folder, false);
    let session = following(session, &subject)?;
    Ok(Plan { subject, session })
}

/// Returns the only one of `runs/NAME`, `runs/NAME-2` and so on that can be resumed.
fn the_one_of(name: &str) -> Result<PathBuf, Failure> {
    let there = default_folders(name).take_while(|path| path.exists());
    let held = there.filter(|path| Holding::of(path) != Holding::NoRun).collect::<Vec<_>>();
    match held.as_slice() {
        [] => {
            let first = default_folders(name).next().unwrap_or_default();
            Err(RecordError::NoFolder { path: first }.into())
        }
        [only] => Ok(only.clone()),
        several => {
            let several: Vec<_> = several.iter().map(|path| path.display().to_string()).collect();
            let several = several.join(", ");
            Err(Failure::usage(format!("--resume: there are {several}; say which by --out")))
        }
    }
}

fn check_resumable(folder: &Path) -> Result<(), Failure> {
    if Holding::of(folder) == Holding::Unfinished {
        return Ok(());
    }
    if !load_run(folder)?.sources.is_empty() {
        let message = format!(
            "{}: a union of runs cannot be resumed; start a search with its formulas as --guess",
            folder.display()
        );
        return Err(Failure::input(message));
    }
    Ok(())
}

/// Returns the first option that is given and differs from the run's, with both values.
fn difference(
    args: &Args,
    common: &Common,
    run: &Run,
    dataset: &Dataset,
) -> Result<Option<String>, Failure> {
    let (names, goal, method) = (run.names(), &run.goal, &run.method);
    let mut found = None;
    let mut compare = |option: &str, given: Option<String>, has: String| {
        if let Some(given) = given.filter(|given| *given != has && found.is_none()) {
            let has =
                if has.is_empty() { format!("no {option}") } else { format!("{option} {has}") };
            found = Some(format!("{has}, not {given}"));
        }
    };
    let text = |value: Option<f64>| value.map(|value| value.to_string());
    compare("--seed", common.seed.map(|seed| seed.to_string()), method.seed.to_string());
    compare("--islands", args.islands.map(|n| n.to_string()), method.islands.to_string());
    compare("--max-cost", text(args.max_cost), goal.max_cost.to_string());
    compare("--immigrants", text(args.immigrants), method.immigrants.to_string());
    compare("--exhaustive", text(args.exhaustive), text(run.exhaustive).unwrap_or_default());
    compare("--loss", args.loss.map(|loss| loss.to_string()), goal.measure.to_string());
    compare("--inputs", args.columns.inputs(), names.inputs.join(","));
    compare("--outputs", args.columns.outputs(), names.outputs.join(","));
    compare("--template", args.template.clone(), goal.template.clone().unwrap_or_default());
    compare("--cost-of", args.cost_of.map(|of| of.to_string()), goal.cost_of.to_string());
    if args.fixed_samples && !run.fixed_samples {
        compare("--fixed-samples", Some("given".into()), String::new());
    }
    let some = |list: &[String]| (!list.is_empty()).then(|| list.join(","));
    compare("--guess", some(&args.guess), run.guesses.join(","));
    compare("--derive", some(&args.derive), run.derived.join(","));
    if !args.require.is_empty() {
        let template = goal.template(&names).map_err(Failure::input)?;
        let requirements = requirements(args, dataset, template.as_ref())?;
        let given = Run { goal: Goal { requirements, ..Goal::default() }, ..run.clone() };
        compare("--require", Some(given.requirements()), run.requirements());
    }
    if !args.transform.is_empty() {
        let given = transforms(&args.transform, dataset)?;
        compare(
            "--transform",
            Some(described(&given, dataset)),
            described(&goal.transforms, dataset),
        );
    }
    if let Some(name) = &args.scene {
        let scene = Scene::find(name, &run.dataset)?;
        let own = run.scene.as_ref().map(|scene| scene.name.clone()).unwrap_or_default();
        let changed = if own == *name { format!("{name} as it is now") } else { name.clone() };
        let given = if run.scene.as_ref() == Some(&scene) { own.clone() } else { changed };
        compare("--scene", Some(given), own);
    }
    let mut given = run.clone();
    if let Some(name) = &args.grammar {
        let grammar = Grammar::find(name)?;
        given.grammar.clone_from(name);
        given.rules = Some(grammar);
        let [has, given] = run.grammars_beside(&given);
        compare("--grammar", Some(given), has);
    }
    if let Some(name) = &args.gpu {
        let profile = Profile::find(name)?;
        given.gpu.clone_from(name);
        given.profile = Some(profile);
        let [has, given] = run.profiles_beside(&given);
        compare("--gpu", Some(given), has);
    }
    Ok(found)
}

fn described(transforms: &[Option<Transform>], dataset: &Dataset) -> String {
    let named = dataset.outputs.iter().zip(transforms);
    let given = named.filter_map(|(output, transform)| Some((&output.name, (*transform)?)));
    given.map(|(name, transform)| format!("{name}={transform}")).collect::<Vec<_>>().join(",")
}

/// Returns the whole budget of a run that is resumed, including what is spent.
fn budget_left(args: &Args, run: &Run, folder: &Path) -> Result<Budget, Failure> {
    let (seconds, generations) = (run.seconds, run.generations);
    let given = budget(args);
    if let Some(time) = given.seconds.filter(|time| *time < seconds) {
        return Err(Failure::usage(format!(
            "--time {time}s: the run has taken {seconds:.1} s already, and --time is for all of it; give more than that"
        )));
    }
    if let Some(most) = given.generations.filter(|most| *most < generations) {
        return Err(Failure::usage(format!(
            "--generations {most}: the run has done {generations} already, and --generations is for all of it; give more than that"
        )));
    }
    if given != Budget::default() {
        return Ok(given);
    }
    let Budget { seconds: time, generations: most } = run.budget;
    let spent = time.is_some_and(|time| seconds >= time) || most.is_some_and(|n| generations >= n);
    if spent && Holding::of(folder) == Holding::Finished {
        return Err(Failure::usage(format!(
            "{}: the run has ended, after {seconds:.1} s and {generations} generations; say how long it is to go on all in all, by --time or --generations",
            folder.display()
        )));
    }
    Ok(run.budget)
}
