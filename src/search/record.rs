//! What a run leaves on disk, and how it is read back: `run.ron`, `front.json`, `trace.csv`,
//! `checkpoint.bin`.

use super::{Counts, Enumeration, Front, FrontMember, Problem, Search, Settings};
use crate::dataset::{Column, Dataset, output_units, replace_file};
use crate::eval::{OutputError, Score};
use crate::fit::Measure;
use crate::program::{Names, parse};
use crate::scene::Scene;
use crate::stability::VerdictRecord;
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// Everything needed to repeat a run, and how far it came.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Run {
    /// The program's version.
    pub version: String,
    /// The command line, its arguments as given.
    pub command: Vec<String>,
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
    pub grammar: String,
    pub gpu: String,
    pub settings: Settings,
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
        Ok(FrontMember {
            program,
            cost: self.cost,
            registers: self.registers,
            score,
            verdict: self.verdict,
            formula: self.formula,
        })
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
        let damaged = |line, reason| RecordError::Damaged { path: path.to_owned(), line, reason };
        let text = read(path)?;
        let records: Vec<MemberRecord> = serde_json::from_str(&text)
            .map_err(|error| damaged(error.line(), error.to_string()))?;
        let members: Result<Vec<_>, String> =
            records.into_iter().map(|record| record.into_member(run)).collect();
        Ok(Front { measure, members: members.map_err(|reason| damaged(1, reason))? })
    }
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

    /// Reads `run.ron` of a run's folder.
    pub fn load(folder: &Path) -> Result<Run, RecordError> {
        let path = folder.join("run.ron");
        ron::from_str(&read(&path)?).map_err(|error| RecordError::Damaged {
            line: error.span.start.line,
            reason: error.code.to_string(),
            path,
        })
    }

    /// Writes `run.ron` to a run's folder.
    pub fn save(&self, folder: &Path) -> Result<(), RecordError> {
        let pretty = ron::ser::PrettyConfig::default();
        let text = ron::ser::to_string_pretty(self, pretty).expect("plain data") + "\n";
        write(&folder.join("run.ron"), text.as_bytes())
    }
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

    /// Writes `checkpoint.bin`: this search, for this dataset, with a checksum.
    pub fn save(&self, folder: &Path, dataset: &Dataset) -> Result<(), RecordError> {
        let path = folder.join("checkpoint.bin");
        let mut bytes = CHECKPOINT_MAGIC.to_vec();
        bytes.extend(dataset.hash().as_bytes());
        let body = postcard::to_allocvec(self).expect("plain data");
        bytes.extend(body);
        let checksum = blake3::hash(&bytes);
        bytes.extend(checksum.as_bytes());
        write(&path, &bytes)
    }

    /// Reads `checkpoint.bin` of a run's folder.
    ///
    /// # Errors
    /// If it is not whole, not of this version, or of other data.
    pub fn load(folder: &Path, dataset: &Dataset) -> Result<Search, RecordError> {
        let path = folder.join("checkpoint.bin");
        let bytes = std::fs::read(&path)
            .map_err(|reason| RecordError::Unreadable { path: path.clone(), reason })?;
        let refuse = |reason: &str| RecordError::Checkpoint {
            path: path.clone(),
            reason: reason.to_owned(),
        };
        let hash = dataset.hash();
        let Some((content, checksum)) = bytes.split_last_chunk::<32>() else {
            return Err(refuse("too short for a checkpoint"));
        };
        if blake3::hash(content).as_bytes() != checksum {
            return Err(refuse("damaged (its checksum does not match); start the search anew"));
        }
        let body = content
            .strip_prefix(CHECKPOINT_MAGIC)
            .ok_or_else(|| refuse("a checkpoint of another version; start the search anew"))?;
        let body = body.strip_prefix(hash.as_bytes()).ok_or_else(|| {
            refuse(
                "a checkpoint of other data; give the dataset, scene and columns it was made with",
            )
        })?;
        postcard::from_bytes(body).map_err(|error| refuse(&error.to_string()))
    }
}

const CHECKPOINT_MAGIC: &[u8] = b"LGPSTATE3";

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

pub(super) fn read(path: &Path) -> Result<String, RecordError> {
    std::fs::read_to_string(path)
        .map_err(|reason| RecordError::Unreadable { path: path.into(), reason })
}

pub(super) fn write(path: &Path, bytes: &[u8]) -> Result<(), RecordError> {
    replace_file(path, bytes)
        .map_err(|reason| RecordError::Unwritable { path: path.into(), reason })
}
