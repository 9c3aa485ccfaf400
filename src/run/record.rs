//! `run.ron`: the record of a run.

use super::RecordError;
use super::folder::{RUN, read};
use crate::cost::Profile;
use crate::dataset::Column;
use crate::eval::Isa;
use crate::grammar::{FileError, Grammar};
use crate::program::Names;
use crate::scene::Scene;
use crate::search::{Counts, Enumeration, Goal, Method, Problem};
use crate::stability::Questions;
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
    /// The dataset's claims.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub claims: Vec<String>,
    /// The grammar's name, and what it was when the run was made; records of an older version lack that.
    pub grammar: String,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rules: Option<Grammar>,
    /// The same of the GPU profile.
    pub gpu: String,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub profile: Option<Profile>,
    /// What was asked of formulas, and how they were searched.
    pub goal: Goal,
    pub method: Method,
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

/// The seconds that a search without a budget may take.
const USUAL_SECONDS: f64 = 60.0;

impl Budget {
    /// The seconds that a run may take, if they are limited.
    pub fn time(&self) -> Option<f64> {
        self.seconds.or(self.generations.is_none().then_some(USUAL_SECONDS))
    }

    /// The share of it that is spent.
    pub(super) fn share(&self, seconds: f64, generation: u64) -> f64 {
        match (self.time(), self.generations) {
            (_, Some(n)) => generation as f64 / n.max(1) as f64,
            (Some(time), None) => seconds / time.max(1e-3),
            (None, None) => 0.0,
        }
    }
}

/// The machine that a search runs on.
pub(super) fn machine() -> String {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let [arch, os] = [std::env::consts::ARCH, std::env::consts::OS];
    format!("{arch} {os}, {cores} cores, {}", Isa::best())
}

/// A path as text; one that is none is not found again.
fn readable<S: Serializer>(path: &Path, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(&path.to_string_lossy())
}

impl Run {
    /// The record of a search that has not begun.
    pub fn of(problem: &Problem, method: &Method) -> Run {
        let (data, grammar) = (problem.dataset(), problem.grammar());
        Run {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            dataset_hash: data.hash(),
            name: data.name.clone(),
            inputs: data.inputs.clone(),
            outputs: data.outputs.clone(),
            claims: data.claims.clone(),
            grammar: grammar.name.clone(),
            rules: Some(Grammar::clone(grammar)),
            gpu: problem.profile().name.clone(),
            profile: Some(Profile::clone(problem.profile())),
            goal: problem.goal().clone(),
            method: method.clone(),
            machine: machine(),
            threads: rayon::current_num_threads(),
            ..Run::default()
        }
    }

    /// What its formulas must be, as `--require` takes it, whatever their order was; or `none`.
    pub fn requirements(&self) -> String {
        let names = self.names();
        let texts = self.goal.requirements.iter().map(|one| one.text(&names));
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

    /// What is asked of its formulas.
    pub fn questions(&self) -> Questions {
        Questions::of(&self.inputs, &self.outputs, &self.claims)
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
