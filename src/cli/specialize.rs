//! `lgp specialize`: formulas cut to a scene.

use super::eval::{assigned_outputs, settled};
use super::run_folder::{self, Which};
use super::{Common, Failure, columns::Columns};
use crate::cost::Profile;
use crate::fit::Measure;
use crate::program::{Names, Program};
use crate::run::MemberRecord;
use crate::run::Subject;
use crate::scene::{Change, Specialization, Step, specialize};
use crate::search::{Front, FrontMember};
use crate::wording::{cycles_text, error_text, front_table, title};
use serde::Serialize;
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// Simplify a formula, or a run's front, for a scene
///
/// Folds fixed inputs, drops operations that never act, then removes terms one after the other and
/// fits the constants again. Prints every step, cycles saved against error added, and the front of
/// all formulas that were tried.
///
/// For example: lgp specialize "bias = saturate(1 - roughness - n_dot_v)^2" datasets/dfg.bin
/// --scene satin
#[derive(clap::Args)]
pub struct Args {
    /// Statements `name = expression`, separated by `;`, over the dataset's columns, the name of a
    /// published formula, or a folder that `lgp search` wrote
    formula: String,
    /// The dataset: a file from `lgp generate` or `lgp import`
    dataset: PathBuf,
    /// The scene: one beside the dataset, or a .ron file
    #[arg(long, value_name = "S")]
    scene: String,
    #[command(flatten)]
    columns: Columns,
    /// The GPU to count cycles for: a built-in profile, a .ron file, or a mix such as
    /// gcn:2,turing:1
    #[arg(long, value_name = "P", default_value = "gcn")]
    gpu: String,
    /// The error to minimise: rmse, max, weighted (by the scene's weights) or relative [default:
    /// rmse, or weighted if the scene or the dataset has weights]
    #[arg(long, value_name = "MEASURE")]
    loss: Option<Measure>,
    /// The largest error allowed on the search split [default: what the scene's tiers allow, or
    /// any]
    #[arg(long, value_name = "E")]
    max_error: Option<f64>,
}

#[derive(Serialize)]
struct Specialized {
    /// Empty for a run's front.
    steps: Vec<StepRecord>,
    front: Vec<MemberRecord>,
}

#[derive(Serialize)]
struct StepRecord {
    change: String,
    /// Cycles saved by this step.
    saved: f64,
    /// Error added by this step, in the measure that is minimised, on the search split.
    added: Option<f64>,
    #[serde(flatten)]
    member: MemberRecord,
}

pub fn run(args: &Args, common: &Common) -> Result<(), Failure> {
    let subject = Subject::load(&args.dataset, Some(&args.scene), |data| args.columns.of(data))?;
    let profile = Profile::find(&args.gpu)?;
    let measure = args.loss.unwrap_or(Measure::usual(&subject.dataset.search));
    let limit = args.max_error.or(tiers_allow(&subject)).unwrap_or(f64::INFINITY);
    let task = Task { subject: &subject, profile: &profile, measure, limit };
    let folder = Path::new(&args.formula);
    let (steps, front, text) = if folder.is_dir() {
        let (front, before) = task.of_run(folder)?;
        (Vec::new(), front, before)
    } else {
        let (program, defined) = formula(args, &subject)?;
        let done = task.of_formula(&program, &defined)?;
        let (steps, text) = task.steps(&done);
        (steps, task.front(vec![done]), text)
    };
    let names = subject.dataset.names();
    let records = front.members.iter().map(|member| MemberRecord::new(member, &names)).collect();
    let text = format!("{text}\n{}", front_table(&front, &[], &names.outputs));
    common.result(&Specialized { steps, front: records }, &text)
}

/// Returns the largest error that a tier allows, if every tier has a limit.
fn tiers_allow(subject: &Subject) -> Option<f64> {
    let tiers = subject.scene.as_ref().map_or(&[][..], |scene| &scene.tiers);
    let errors: Option<Vec<f64>> = tiers.iter().map(|(_, tier)| tier.max_error).collect();
    errors?.into_iter().reduce(f64::max)
}

/// Returns the formula that was given, or the published one of that name, and the outputs that it
/// defines.
fn formula(args: &Args, subject: &Subject) -> Result<(Program, Vec<String>), Failure> {
    let is_name = args.formula.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
    if is_name {
        let known = crate::dataset::incumbents_for(&args.dataset, &subject.whole)?;
        let found = known.iter().find(|known| known.incumbent.name == args.formula);
        return found.map(|known| (known.program.clone(), known.outputs.clone())).ok_or_else(|| {
            let names: Vec<&str> = known.iter().map(|k| k.incumbent.name.as_str()).collect();
            let meant = crate::suggest::did_you_mean(&args.formula, names.iter().copied());
            let message = format!(
                "no published formula for {} is called `{}`{meant} (there are: {}), and it is no folder; a formula is written as in \"bias = 1 - n_dot_v\"",
                subject.whole.name, args.formula, names.join(", ")
            );
            Failure::input(message)
        });
    }
    let (program, names) = settled(assigned_outputs(&args.formula, &subject.whole.names())?)?;
    Ok((program, names.outputs))
}

struct Task<'a> {
    subject: &'a Subject,
    profile: &'a Profile,
    measure: Measure,
    limit: f64,
}

impl Task<'_> {
    fn of_formula(&self, program: &Program, defined: &[String]) -> Result<Specialization, Failure> {
        let Subject { whole, scene, dataset } = self.subject;
        let scene = scene.as_ref().expect("a scene is required");
        let view = scene.over(whole)?;
        if view.inputs() != dataset.names().inputs {
            return Err(Failure::usage(
                "--inputs goes with no scene here; fix inputs in the scene",
            ));
        }
        let (profile, measure, limit) = (self.profile, self.measure, self.limit);
        specialize(&view, program, defined, dataset, profile, measure, limit).ok_or_else(|| {
            let message = format!(
                "the formula defines {}, which is not all that {} needs; define the others, or choose --outputs",
                defined.join(", "),
                dataset.names().outputs.join(", ")
            );
            Failure::input(message)
        })
    }

    /// Returns the front of all specialised members of a run's front, and a description of the run.
    fn of_run(&self, folder: &Path) -> Result<(Front, String), Failure> {
        let (run, front) = run_folder::load(folder, Which { minimax: false })?;
        let Names { inputs, outputs } = run.names();
        if run.scene.is_some() || inputs != self.subject.whole.names().inputs {
            let message = format!(
                "{}: its formulas are not over the inputs of {}; give a run on the whole dataset",
                folder.display(),
                self.subject.whole.name
            );
            return Err(Failure::input(message));
        }
        let done: Result<Vec<Specialization>, Failure> =
            front.members.iter().map(|one| self.of_formula(&one.program, &outputs)).collect();
        let text = format!("{} formulas of {}\n", front.members.len(), folder.display());
        Ok((self.front(done?), text))
    }

    fn member(&self, program: &Program) -> FrontMember {
        let dataset = &self.subject.dataset;
        FrontMember::new(program.clone(), dataset, self.profile, &dataset.names())
    }

    fn front(&self, done: Vec<Specialization>) -> Front {
        let programs = done
            .iter()
            .flat_map(|done| done.steps.iter().map(|step| &step.program).chain(&done.others));
        let members: Vec<FrontMember> = programs.map(|program| self.member(program)).collect();
        let usable = |member: &FrontMember| {
            member.score.is_finite() && member.search_error().of(self.measure) <= self.limit
        };
        Front::from_members(members.into_iter().filter(usable).collect(), self.measure)
    }

    /// Returns the steps, as records and as a table.
    fn steps(&self, done: &Specialization) -> (Vec<StepRecord>, String) {
        let names = self.subject.dataset.names();
        let mut text = format!(
            "{:>6} {:>6}  {:>9} {:>9} {:>9}\n",
            "cycles",
            "saved",
            title(self.measure),
            "added",
            "max"
        );
        let mut records: Vec<StepRecord> = Vec::new();
        let mut before: Option<(f64, f64)> = None;
        for step in &done.steps {
            let member = self.member(&step.program);
            let error = member.search_error();
            let (now, then) = (
                (step.cost, error.of(self.measure)),
                before.unwrap_or((step.cost, error.of(self.measure))),
            );
            let (saved, added) = (then.0 - now.0, now.1 - then.1);
            let change = described(step);
            let _ = writeln!(
                text,
                "{:>6} {:>6}  {:>9} {:>9} {:>9}  {change}",
                cycles_text(now.0),
                cycles_text(saved),
                error_text(now.1),
                signed(added),
                error_text(error.max)
            );
            before = Some(now);
            let added = added.is_finite().then_some(added);
            let member = MemberRecord::new(&member, &names);
            records.push(StepRecord { change, saved, added, member });
        }
        (records, text)
    }
}

fn signed(difference: f64) -> String {
    match difference {
        d if !d.is_finite() => "".to_owned(),
        0.0 => "0".to_owned(),
        d if d < 0.0 => format!("-{}", error_text(-d)),
        d => format!("+{}", error_text(d)),
    }
}

fn described(step: &Step) -> String {
    use crate::scene::Evidence::{Proved, Sampled};
    match &step.change {
        Change::Given => "as given".to_owned(),
        Change::Folded => "fixed inputs folded".to_owned(),
        Change::Idle(op, Proved) => format!("{op} dropped: it never acts (proved)"),
        Change::Idle(op, Sampled) => {
            format!("{op} dropped: it never acts on any sample (not proved)")
        }
        Change::Refitted => "constants fitted to the scene".to_owned(),
        Change::Removed(what) => what.clone(),
    }
}
