//! The plan of a search, from the command line, and the folder it is written to.

use super::resume::resumed;
use super::search::Args;
use super::truth::truth_of;
use super::{Common, Failure};
use crate::cost::Profile;
use crate::dataset::{Dataset, Split};
use crate::fit::Measure;
use crate::grammar::Grammar;
use crate::op::Op;
use crate::program::{Claim, Draft, Hole, Template};
use crate::run::{
    Budget, Folder, Holding, RecordError, Session, Subject, guess, in_the_way, noted,
};
use crate::scene::Scene;
use crate::search::{Goal, Method, Problem, Requirement, Transform, USUAL_GPU, USUAL_GRAMMAR};
use crate::suggest::{did_you_mean, nearest};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A search that is ready to begin or to go on, and owns its folder.
pub struct Plan {
    pub subject: Subject,
    pub session: Session,
}

impl Plan {
    pub fn of(args: &Args, common: &Common) -> Result<Plan, Failure> {
        match args.resume {
            true => resumed(args, common),
            false => Plan::new(args, common),
        }
    }

    fn new(args: &Args, common: &Common) -> Result<Plan, Failure> {
        let subject = subject(args, common)?;
        let dataset = &subject.dataset;
        let grammar = Grammar::find(args.grammar.as_deref().unwrap_or(USUAL_GRAMMAR))?;
        let gpu = args.gpu.as_deref().unwrap_or(USUAL_GPU);
        let profile = Profile::find(gpu)?;
        let usual = Goal::default();
        let template = template(args, dataset)?;
        if let Some(template) = &template {
            common.note(&described(template));
        }
        let tiers_spend = subject.scene.as_ref().and_then(|scene| scene.max_cost());
        let goal = Goal {
            measure: measure(args.loss, &dataset.name, &dataset.search)?,
            requirements: requirements(args, dataset, template.as_ref())?,
            transforms: transforms(&args.transform, dataset)?,
            template: args.template.clone(),
            cost_of: args.cost_of.unwrap_or_default(),
            max_cost: args.max_cost.or(tiers_spend).unwrap_or(usual.max_cost),
        };
        let usual = Method::default();
        let method = Method {
            seed: common.seed(),
            islands: args.islands.map_or(usual.islands, usize::from),
            immigrants: args.immigrants.unwrap_or(usual.immigrants),
            ..usual
        };
        let guesses = guesses(&args.guess, dataset, template.as_ref())?;
        check_operations(&goal.requirements, &guesses, &grammar, common)?;
        let (folder, replaces) = match &args.out {
            Some(out) => (asked_for(out, args.force)?, Holding::of(out) != Holding::NoRun),
            None => (free(&dataset.name, common)?, false),
        };
        // A function's samples are kept with the run, which can then be read without it.
        let file = match &args.dataset {
            Some(path) if subject.whole.origin.function().is_none() => noted(path, folder.path()),
            _ => folder.keep_data(&subject.whole)?,
        };
        let problem = Problem::of(Arc::clone(dataset)).grammar(grammar).profile(profile).goal(goal);
        let session = Session::new(problem.build()?, method)?
            .budget(budget(args))
            .guesses(&args.guess)?
            .exhaustive(args.exhaustive)
            .fixed_samples(args.fixed_samples)
            .derived(&args.derive)
            .of_file(file, subject.whole.hash(), subject.scene.clone())
            .asked_by(gpu, command())
            .kept_in(folder, replaces);
        let session = following(session, &subject)?;
        Ok(Plan { subject, session })
    }
}

/// Lets a session's samples follow it, if they are a function's.
pub(super) fn following(session: Session, subject: &Subject) -> Result<Session, Failure> {
    match truth_of(&subject.dataset) {
        Some(truth) => Ok(session.following(truth)?),
        None => Ok(session),
    }
}

/// Returns the data to search formulas for: a dataset, or the samples of a function.
fn subject(args: &Args, common: &Common) -> Result<Subject, Failure> {
    let assigned = |data: &Dataset| {
        let text = args.template.as_ref().filter(|_| args.columns.outputs_asked().is_none())?;
        // What cannot be read is told of later.
        Template::assigned(text, &data.names()).ok().filter(|outputs| !outputs.is_empty())
    };
    let choose = |data: &Dataset| {
        let data = args.columns.of(data)?;
        match assigned(&data) {
            Some(outputs) => data.select(None, Some(&outputs)),
            None => Ok(data),
        }
    };
    let (file, scene) = (args.dataset.as_deref(), args.scene.as_deref());
    match (args.sampled.truth(file, args.columns.outputs_asked())?, file) {
        (Some(truth), _) => {
            let whole = args.sampled.dataset(&truth, common)?;
            let scene = scene.map(|name| Scene::find(name, file.unwrap_or(Path::new(""))));
            Ok(Subject::new(whole, scene.transpose()?, &args.derive, choose)?)
        }
        (None, Some(path)) => {
            args.sampled.refuse_functions()?;
            Ok(Subject::load_with(path, scene, &args.derive, choose)?)
        }
        (None, None) => Err(Failure::usage("give a dataset, a shader, or a function by --formula")),
    }
}

/// Returns the command line, its arguments as given.
fn command() -> Vec<String> {
    std::env::args_os().map(|word| word.to_string_lossy().into_owned()).collect()
}

/// Claims the folder that was asked for, unless it holds what would be lost.
fn asked_for(out: &Path, force: bool) -> Result<Folder, Failure> {
    let shown = out.display();
    let check = || match Holding::of(out) {
        Holding::NoRun => match in_the_way(out) {
            Some(file) => Err(Failure::usage(format!(
                "{shown}: holds `{file}`, which is no run's and would be overwritten; choose another --out"
            ))),
            None => Ok(()),
        },
        _ if force => Ok(()),
        Holding::Unfinished => Err(Failure::usage(format!(
            "{shown}: holds a search that has not ended; go on with it by --resume, replace it by --force, or choose another --out"
        ))),
        Holding::Finished => Err(Failure::usage(format!(
            "{shown}: holds a run already; go on with it by --resume, replace it by --force, or choose another --out"
        ))),
    };
    check()?;
    let folder = Folder::claim(out)?;
    // It may have changed hands in between.
    check()?;
    Ok(folder)
}

/// Claims the first of `runs/NAME`, `runs/NAME-2` and so on that is empty.
fn free(name: &str, common: &Common) -> Result<Folder, Failure> {
    for (number, path) in default_folders(name).enumerate() {
        if !is_empty(&path) {
            continue;
        }
        match Folder::claim(&path) {
            Ok(folder) if Holding::of(&path) == Holding::NoRun => {
                if number > 0 {
                    let first = default_folders(name).next().unwrap_or_default();
                    let [first, path] = [first.display(), path.display()];
                    common.note(&format!("{first} is taken; this run goes to {path}"));
                }
                return Ok(folder);
            }
            Ok(_) | Err(RecordError::Busy { .. }) => {}
            Err(error) => return Err(error.into()),
        }
    }
    Err(Failure::usage("runs: there are too many runs of that name; say where by --out"))
}

/// Returns true for a folder that does not exist, or holds only a lock, perhaps of a killed
/// process.
fn is_empty(folder: &Path) -> bool {
    match folder.read_dir() {
        Ok(mut files) => files.all(|file| file.is_ok_and(|file| file.file_name() == "lock")),
        Err(error) => error.kind() == std::io::ErrorKind::NotFound,
    }
}

/// Returns the default folders of runs; a dataset's name is one path component, whatever its
/// characters.
pub(super) fn default_folders(name: &str) -> impl Iterator<Item = PathBuf> {
    let plain = |c: char| c.is_alphanumeric() || matches!(c, '_' | '-' | '.' | ' ');
    let name: String = name.chars().map(|c| if plain(c) { c } else { '_' }).collect();
    let name = name.trim_start_matches('.').trim().to_owned();
    let name = if name.is_empty() { "run".to_owned() } else { name };
    let first = Path::new("runs").join(&name);
    let next = (2..10_000).map(move |n| Path::new("runs").join(format!("{name}-{n}")));
    std::iter::once(first).chain(next)
}

pub(super) fn budget(args: &Args) -> Budget {
    Budget { seconds: args.time.map(|time| time.as_secs_f64()), generations: args.generations }
}

fn guesses(
    texts: &[String],
    dataset: &Dataset,
    template: Option<&Template>,
) -> Result<Vec<Draft>, Failure> {
    let names = dataset.names();
    let read = |text: &String| {
        let read = guess(text, &names, template);
        read.map_err(|error| Failure::input(format!("--guess: {error}")))
    };
    texts.iter().map(read).collect()
}

/// Returns the template that is asked for.
fn template(args: &Args, dataset: &Dataset) -> Result<Option<Template>, Failure> {
    let Some(text) = &args.template else { return Ok(None) };
    let parsed = Template::parse(text, &dataset.names());
    Ok(Some(parsed.map_err(|error| Failure::input(format!("--template: {error}")))?))
}

/// Says what is to be found, lest a misspelt operation pass for a hole.
fn described(template: &Template) -> String {
    let hole = |hole: &Hole| {
        let meant = match hole.is_constant() {
            true => String::new(),
            false => misspelt(&hole.name)
                .map(|name| format!(" (not the operation `{name}`)"))
                .unwrap_or_default(),
        };
        let calls =
            if hole.calls > 1 { format!(", called {} times", hole.calls) } else { "".into() };
        format!("{}{calls}{meant}", hole.signature())
    };
    let holes: Vec<String> = template.holes().iter().map(hole).collect();
    format!("to be found: {}", holes.join("; "))
}

/// The fewest letters of a name that may be a misspelt operation: shorter ones are near everything.
const LETTERS: usize = 3;

fn misspelt(name: &str) -> Option<&'static str> {
    let operations = Op::ALL.iter().map(|op| op.name());
    nearest(name, operations).filter(|_| name.len() >= LETTERS)
}

/// Returns the measure to minimise; weights that are asked for must be there.
fn measure(loss: Option<Measure>, name: &str, split: &Split) -> Result<Measure, Failure> {
    if loss == Some(Measure::Weighted) && split.weights.is_empty() {
        let message = format!(
            "--loss weighted: {name} has no weights; import a table with a column `weight`, or use --loss rmse"
        );
        return Err(Failure::usage(message));
    }
    Ok(loss.unwrap_or(Measure::usual(split)))
}

pub(super) fn requirements(
    args: &Args,
    dataset: &Dataset,
    template: Option<&Template>,
) -> Result<Vec<Requirement>, Failure> {
    let names = dataset.names();
    let holes = template.map_or(&[][..], Template::holes);
    let read = |text: &String| {
        // A claim that comes with the data, by its name.
        let known = dataset.claims.iter().find(|claim| Claim::name_of(claim) == text);
        Requirement::parse_of(known.unwrap_or(text), &names, holes)
            .map_err(|reason| Failure::usage(format!("--require {reason}")))
    };
    let requirements: Vec<Requirement> = args.require.iter().map(read).collect::<Result<_, _>>()?;
    let ends = requirements.iter().any(|one| matches!(one, Requirement::Ends { .. }));
    if ends && args.loss == Some(Measure::Relative) {
        let message = "--require ends=… goes with --loss rmse, max or weighted, not relative";
        return Err(Failure::usage(message));
    }
    Ok(requirements)
}

/// Checks that operations that must be used are in the grammar: otherwise nothing could be found. A
/// guess may go beyond the grammar, since its user wrote it out; a warning says so.
fn check_operations(
    requirements: &[Requirement],
    guesses: &[Draft],
    grammar: &Grammar,
    common: &Common,
) -> Result<(), Failure> {
    let used: Vec<_> = guesses.iter().flat_map(|guess| &guess.instrs).map(|i| i.op()).collect();
    for requirement in requirements {
        let Requirement::Operation(op) = requirement else { continue };
        if !grammar.has(*op) && !used.contains(op) {
            let has: Vec<_> = grammar.operations.iter().map(|(op, _)| op.name()).collect();
            return Err(Failure::usage(format!(
                "--require uses={op}: the grammar {} has no `{op}` (it has {}); give a --grammar that has it",
                grammar.name,
                has.join(", ")
            )));
        }
    }
    let is_beyond = |op: &crate::op::Op| *op != crate::op::Op::Neg && !grammar.has(*op);
    if let Some(op) = used.iter().find(|op| is_beyond(op)) {
        common.note(&format!(
            "warning: --guess: the grammar {} has no `{op}`; the guess is taken as it is, and only what comes of it may have `{op}`",
            grammar.name
        ));
    }
    Ok(())
}

pub(super) fn transforms(
    texts: &[String],
    dataset: &Dataset,
) -> Result<Vec<Option<Transform>>, Failure> {
    let outputs = dataset.names().outputs;
    let mut transforms = vec![None; outputs.len()];
    for text in texts {
        let usage = |reason: String| Failure::usage(format!("--transform {reason}"));
        let (name, function) = text
            .split_once('=')
            .ok_or_else(|| usage(format!("{text}: give OUTPUT=F, as in norm=rcp")))?;
        let place = outputs.iter().position(|output| output == name).ok_or_else(|| {
            let meant = did_you_mean(name, outputs.iter().map(String::as_str));
            usage(format!("{text}: there is no output `{name}`{meant}"))
        })?;
        transforms[place] = Some(function.parse().map_err(usage)?);
    }
    Ok(transforms)
}
