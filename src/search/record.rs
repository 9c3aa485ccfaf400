//! What a run leaves on disk, and how it is read back: `run.ron`, `front.json`, `trace.csv`.

use super::folder::{RUN, read};
use super::{Counts, Enumeration, Front, FrontMember, Problem, Search, Settings};
use crate::cost::Profile;
use crate::dataset::{Column, output_units};
use crate::eval::{OutputError, Score};
use crate::fit::Measure;
use crate::grammar::{FileError, Grammar};
use crate::program::{Names, parse};
use crate::scene::Scene;
use crate::stability::VerdictRecord;
use serde::{Deserialize, Serialize, Serializer};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// Everything needed to repeat a run, and how far it came.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Run {
    /// The program's version.
    pub version: String,
    /// The command line, its arguments as given.
    pub command: Vec<String>,
    #[serde(serialize_with = "readable")]
    pub dataset: PathBuf,
    pub dataset_hash: String,
    /// What was needed of the dataset; none for all of it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scene: Option<Scene>,
    /// The dataset's name.
    pub name: String,
    /// The columns that were inputs and outputs.
    pub inputs: Vec<Column>,
    pub outputs: Vec<Column>,
    /// The grammar's name, and what it was when the run was made; records of an older version lack that.
    pub grammar: String,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rules: Option<Grammar>,
    /// The same of the GPU profile.
    pub gpu: String,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub profile: Option<Profile>,
    pub settings: Settings,
    /// The formulas that it started from, as given.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub guesses: Vec<String>,
    /// The cycles up to which all formulas were asked to be tried.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub exhaustive: Option<f64>,
    #[serde(default)]
    pub budget: Budget,
    pub machine: String,
    pub threads: usize,
    pub generations: u64,
    pub seconds: f64,
    pub counts: Counts,
    /// All programs of the lowest costs, where they are few enough.
    #[serde(default)]
    pub enumeration: Option<Enumeration>,
    /// The runs that this is the union of; none for a search.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub sources: Vec<Run>,
    /// Checksums of the files that go with it, by name.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub files: BTreeMap<String, String>,
}

/// What a search may spend, all in all; neither where it goes on until little improves.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Budget {
    pub seconds: Option<f64>,
    pub generations: Option<u64>,
}

/// A path as text; one that is none is not found again.
fn readable<S: Serializer>(path: &Path, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(&path.to_string_lossy())
}

/// A run's folder that cannot be read or written.
#[derive(Debug, thiserror::Error)]
pub enum RecordError {
    #[error("{path}: cannot be read: {reason}")]
    Unreadable { path: PathBuf, reason: std::io::Error },
    #[error("{path}: cannot be written: {reason}")]
    Unwritable { path: PathBuf, reason: std::io::Error },
    #[error(
        "{path}, line {line}: {reason}; the folder is not one that `lgp search` wrote, or was damaged"
    )]
    Damaged { path: PathBuf, line: usize, reason: String },
    #[error("{path}: {reason}")]
    Checkpoint { path: PathBuf, reason: String },
    #[error("{path}: no such folder; give one that `lgp search` wrote", path = path.display())]
    NoFolder { path: PathBuf },
    #[error(
        "{path}: holds no whole run (run.ron and front.json); give a folder that `lgp search` or `lgp merge` wrote (a search that was killed at once has left nothing: start it anew)",
        path = path.display()
    )]
    NoRun { path: PathBuf },
    #[error(
        "{path}: holds no whole run: the search in it was killed or has not ended; go on with it by `lgp search --resume --out {path}`",
        path = path.display()
    )]
    Unfinished { path: PathBuf },
    #[error(
        "{path}: not the file that run.ron was written with: it was changed, or a search has just ended and exchanged it; try again, or make it anew by `lgp search --resume`",
        path = path.display()
    )]
    OfAnotherRun { path: PathBuf },
    #[error(
        "{path}: in use by {owner}; wait until that is done, or choose another folder",
        path = path.display()
    )]
    Busy { path: PathBuf, owner: String },
}

/// A member as `front.json` has it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MemberRecord {
    pub cost: f64,
    /// Null in records of a version that did not count them.
    pub registers: Option<u32>,
    /// Over all outputs, on the search split.
    pub rmse: f64,
    pub max_error: f64,
    pub validation: OutputError,
    /// By output, on the search split.
    pub errors: BTreeMap<String, OutputError>,
    /// By output, on the validation split.
    pub validation_errors: BTreeMap<String, OutputError>,
    #[serde(default)]
    pub verdict: VerdictRecord,
    pub formula: String,
}

impl MemberRecord {
    pub fn new(member: &FrontMember, names: &Names) -> MemberRecord {
        let by_output = |errors: &[OutputError]| {
            names.outputs.iter().cloned().zip(errors.iter().copied()).collect()
        };
        MemberRecord {
            cost: member.cost,
            registers: member.registers,
            rmse: member.search_error().rmse,
            max_error: member.search_error().max,
            validation: member.validation_error(),
            errors: by_output(&member.score.search),
            validation_errors: by_output(&member.score.validation),
            verdict: member.verdict.clone(),
            formula: member.formula.clone(),
        }
    }

    fn into_member(self, run: &Run) -> Result<FrontMember, String> {
        let names = &run.names();
        let program = parse(&self.formula, names).map_err(|error| error.to_string())?;
        let errors = |map: &BTreeMap<String, OutputError>| {
            let of = |name: &String| map.get(name).copied();
            let errors: Option<Vec<_>> = names.outputs.iter().map(of).collect();
            errors.ok_or_else(|| "an output's errors are missing".to_owned())
        };
        let score = Score {
            search: errors(&self.errors)?,
            validation: errors(&self.validation_errors)?,
            units: output_units(&run.outputs),
        };
        let member = FrontMember {
            program,
            cost: self.cost,
            registers: self.registers,
            score,
            verdict: self.verdict,
            formula: self.formula,
        };
        member.check()?;
        Ok(member)
    }
}

impl Front {
    /// The text of `front.json`.
    pub fn to_json(&self, names: &Names) -> String {
        let members: Vec<_> = self.members.iter().map(|m| MemberRecord::new(m, names)).collect();
        serde_json::to_string_pretty(&members).expect("plain data") + "\n"
    }

    /// Reads `front.json` or `front-max.json` of a run's folder, in the measure that it was made in.
    pub fn load(path: &Path, run: &Run, measure: Measure) -> Result<Front, RecordError> {
        Front::parse(path, &read(path)?, run, measure)
    }

    /// The same of the file's text.
    pub fn parse(
        path: &Path,
        text: &str,
        run: &Run,
        measure: Measure,
    ) -> Result<Front, RecordError> {
        let damaged = |line, reason| RecordError::Damaged { path: path.to_owned(), line, reason };
        let records: Vec<MemberRecord> =
            serde_json::from_str(text).map_err(|error| damaged(error.line(), error.to_string()))?;
        let mut members = Vec::with_capacity(records.len());
        for (number, record) in (1..).zip(records) {
            let member = record.into_member(run).map_err(|reason| {
                damaged(line_of_member(text, number), format!("formula {number}: {reason}"))
            })?;
            members.push(member);
        }
        if !members.is_sorted_by(|a, b| a.cost <= b.cost) {
            return Err(damaged(1, "the formulas are not by rising cost".into()));
        }
        Ok(Front { measure, members })
    }
}

/// The line on which a member's cost, its first field, stands; the first where that is not to be seen.
fn line_of_member(text: &str, number: usize) -> usize {
    let mut lines = (1..).zip(text.lines());
    let costs = lines.by_ref().filter(|(_, line)| line.trim_start().starts_with("\"cost\""));
    costs.map(|(line, _)| line).nth(number - 1).unwrap_or(1)
}

impl Run {
    /// What its formulas must be, as `--require` takes it, whatever their order was; or `none`.
    pub fn requirements(&self) -> String {
        let names = self.names();
        let texts = self.settings.requirements.iter().map(|one| one.text(&names));
        let texts: BTreeSet<String> = texts.collect();
        match texts.is_empty() {
            true => "none".to_owned(),
            false => texts.into_iter().collect::<Vec<_>>().join(","),
        }
    }

    /// The names of its inputs and outputs.
    pub fn names(&self) -> Names {
        let [inputs, outputs] = [&self.inputs, &self.outputs]
            .map(|columns| columns.iter().map(|column| column.name.clone()));
        Names::new(inputs, outputs)
    }

    /// The grammar as it was; that of its name, if it is built in, where the record lacks it.
    ///
    /// # Errors
    /// If it is neither.
    pub fn grammar(&self) -> Result<Grammar, FileError> {
        self.rules.clone().map_or_else(|| Grammar::find_built_in(&self.grammar), Ok)
    }

    /// The GPU profile as it was; that of its name, if it is built in, where the record lacks it.
    pub fn profile(&self) -> Option<Profile> {
        self.profile.clone().or_else(|| Profile::find_built_in(&self.gpu))
    }

    /// Reads `run.ron` of a run's folder, and checks it.
    pub fn load(folder: &Path) -> Result<Run, RecordError> {
        let path = folder.join(RUN);
        Run::from_ron(&read(&path)?).map_err(|(line, reason)| RecordError::Damaged {
            path,
            line,
            reason,
        })
    }

    /// Reads the text of `run.ron`, and checks it; or says on which line it is wrong.
    pub fn from_ron(text: &str) -> Result<Run, (usize, String)> {
        let run: Run =
            ron::from_str(text).map_err(|error| (error.span.start.line, error.code.to_string()))?;
        run.check().map_err(|reason| (line_of_field(text, &reason), reason))?;
        Ok(run)
    }

    /// The text of `run.ron`.
    pub fn to_ron(&self) -> String {
        let pretty = ron::ser::PrettyConfig::default();
        ron::ser::to_string_pretty(self, pretty).expect("plain data") + "\n"
    }
}

/// The line of the first name in backquotes that a text has.
fn line_of_field(text: &str, reason: &str) -> usize {
    let has = |name: &str| text.lines().position(|line| line.contains(name));
    let named = reason.split('`').skip(1).step_by(2);
    named.filter_map(has).map(|line| line + 1).next().unwrap_or(1)
}

/// A line of `trace.csv`.
#[derive(Clone, Debug, PartialEq)]
pub struct TracePoint {
    pub seconds: f64,
    pub counts: Counts,
    pub hypervolume: f64,
    /// The least error that the search makes small, on the search split, at each of [`TRACE_COSTS`] or below.
    pub errors: [f64; TRACE_COSTS.len()],
}

/// The costs whose best error is traced.
pub const TRACE_COSTS: [f64; 9] = [5.0, 8.0, 10.0, 12.0, 16.0, 20.0, 25.0, 30.0, 40.0];

impl Search {
    /// Where the search stands after some seconds.
    pub fn trace_point(&self, problem: &Problem, seconds: f64) -> TracePoint {
        TracePoint {
            seconds,
            counts: self.counts(),
            hypervolume: self
                .archive()
                .hypervolume(self.settings().max_cost, problem.constant_loss),
            errors: TRACE_COSTS.map(|cost| problem.error(self.archive().best_loss(cost))),
        }
    }
}

/// The text of `trace.csv`, its errors in a measure that names their columns.
pub fn trace_csv(points: &[TracePoint], measure: Measure) -> String {
    let costs = TRACE_COSTS.map(|cost| format!("{measure}_{cost}")).join(",");
    let mut text = format!("seconds,considered,fitted,fitted_on_all,hypervolume,{costs}\n");
    for point in points {
        let TracePoint { seconds, counts, hypervolume, errors } = point;
        let errors = errors.map(|error| format!("{error:.6}")).join(",");
        text += &format!(
            "{seconds:.3},{},{},{},{hypervolume:.4},{errors}\n",
            counts.considered, counts.fitted, counts.fitted_on_all
        );
    }
    text
}
