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
use crate::truth::{exact_formula, formula_of};
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
    /// The dataset's file.
    #[serde(serialize_with = "readable")]
    pub dataset: PathBuf,
    /// The hash of the dataset's rows.
    pub dataset_hash: String,
    /// The scene that the dataset was cut to, if any.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scene: Option<Scene>,
    /// The outputs that were computed of the dataset's columns, as `name = expression`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub derived: Vec<String>,
    /// The dataset's name.
    pub name: String,
    /// The input columns.
    pub inputs: Vec<Column>,
    /// The output columns.
    pub outputs: Vec<Column>,
    /// The dataset's claims.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub claims: Vec<String>,
    /// The formula that the data are samples of, if they are.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub truth: Option<String>,
    /// The grammar's name.
    pub grammar: String,
    /// The grammar as it was; records of an older version lack it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rules: Option<Grammar>,
    /// The GPU profile's name.
    pub gpu: String,
    /// The GPU profile as it was; records of an older version lack it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub profile: Option<Profile>,
    /// The measure and requirements that were asked for.
    pub goal: Goal,
    /// The settings of the search.
    pub method: Method,
    /// The formulas that it started from, as given.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub guesses: Vec<String>,
    /// The cycles up to which all formulas were to be tried.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub exhaustive: Option<f64>,
    /// True if the samples of a function were to stay as they were.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub fixed_samples: bool,
    /// The limits of its time and generations.
    #[serde(default)]
    pub budget: Budget,
    /// The machine that it ran on.
    pub machine: String,
    /// The threads that it used.
    pub threads: usize,
    /// The generations that it did.
    pub generations: u64,
    /// The seconds that it took.
    pub seconds: f64,
    /// The candidates that it considered, by what became of them.
    pub counts: Counts,
    /// The enumeration of all programs of the lowest costs, if they are few enough.
    #[serde(default)]
    pub enumeration: Option<Enumeration>,
    /// The searches of a union; none for a search.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub sources: Vec<Run>,
    /// The checksums of the files that go with it, by name.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub files: BTreeMap<String, String>,
}

/// The limits of a whole search; with neither, it goes on until little improves.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Budget {
    /// The most seconds.
    pub seconds: Option<f64>,
    /// The most generations.
    pub generations: Option<u64>,
}

/// The most seconds of a search without a budget. By hand, unmeasured.
const USUAL_SECONDS: f64 = 60.0;

impl Budget {
    /// Returns the seconds that a run may take, if they are limited.
    pub fn time(&self) -> Option<f64> {
        self.seconds.or(self.generations.is_none().then_some(USUAL_SECONDS))
    }

    /// Returns the share of the budget that is spent, in [0, 1].
    pub(super) fn share(&self, seconds: f64, generation: u64) -> f64 {
        match (self.time(), self.generations) {
            (_, Some(n)) => generation as f64 / n.max(1) as f64,
            (Some(time), None) => seconds / time.max(1e-3),
            (None, None) => 0.0,
        }
    }
}

/// Describes the machine that a search runs on.
pub(super) fn machine() -> String {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let [arch, os] = [std::env::consts::ARCH, std::env::consts::OS];
    format!("{arch} {os}, {cores} cores, {}", Isa::best())
}

/// Serialises a path as text; one that is not text is not found again.
fn readable<S: Serializer>(path: &Path, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(&path.to_string_lossy())
}

impl Run {
    /// Returns the record of a search that has not begun.
    pub fn of(problem: &Problem, method: &Method) -> Run {
        let (data, grammar) = (problem.dataset(), problem.grammar());
        Run {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            dataset_hash: data.hash(),
            name: data.name.clone(),
            inputs: data.inputs.clone(),
            outputs: data.outputs.clone(),
            claims: data.claims.clone(),
            truth: formula_of(data),
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

    /// Returns the requirements as `--require` takes them, in a fixed order; or `none`.
    pub fn requirements(&self) -> String {
        let names = self.names();
        let texts = self.goal.requirements.iter().map(|one| one.text(&names));
        let texts: BTreeSet<String> = texts.collect();
        match texts.is_empty() {
            true => "none".to_owned(),
            false => texts.into_iter().collect::<Vec<_>>().join(","),
        }
    }

    /// Returns the names of its inputs and outputs.
    pub fn names(&self) -> Names {
        let [inputs, outputs] = [&self.inputs, &self.outputs]
            .map(|columns| columns.iter().map(|column| column.name.clone()));
        Names::new(inputs, outputs)
    }

    /// Returns what is asked of its formulas.
    pub fn questions(&self) -> Questions {
        let truth = self.truth.as_ref().and_then(|text| exact_formula(text, &self.names()));
        Questions { truth, ..Questions::of(&self.inputs, &self.outputs, &self.claims) }
    }

    /// Returns the grammar as it was, or, if the record lacks it, the built-in one of its name.
    ///
    /// # Errors
    /// If there is neither.
    pub fn grammar(&self) -> Result<Grammar, FileError> {
        self.rules.clone().map_or_else(|| Grammar::find_built_in(&self.grammar), Ok)
    }

    /// Returns the GPU profile as it was, or, if the record lacks it, the built-in one of its name.
    pub fn profile(&self) -> Option<Profile> {
        self.profile.clone().or_else(|| Profile::find_built_in(&self.gpu))
    }

    /// Reads `run.ron` from a run's folder, and checks it.
    ///
    /// # Errors
    /// If it cannot be read, or fails [`Run::check`].
    pub fn load(folder: &Path) -> Result<Run, RecordError> {
        let path = folder.join(RUN);
        Run::from_ron(&read(&path)?).map_err(|(line, reason)| RecordError::Damaged {
            path,
            line,
            reason,
        })
    }

    /// Parses the text of `run.ron`, and checks it.
    ///
    /// # Errors
    /// The line, and what is wrong with it.
    pub fn from_ron(text: &str) -> Result<Run, (usize, String)> {
        let run: Run =
            ron::from_str(text).map_err(|error| (error.span.start.line, error.code.to_string()))?;
        run.check().map_err(|reason| (line_of_field(text, &reason), reason))?;
        Ok(run)
    }

    /// Returns the text of `run.ron`.
    pub fn to_ron(&self) -> String {
        let pretty = ron::ser::PrettyConfig::default();
        ron::ser::to_string_pretty(self, pretty).expect("plain data") + "\n"
    }
}

/// Returns the line of the first name in backquotes that a text has.
fn line_of_field(text: &str, reason: &str) -> usize {
    let has = |name: &str| text.lines().position(|line| line.contains(name));
    let named = reason.split('`').skip(1).step_by(2);
    named.filter_map(has).map(|line| line + 1).next().unwrap_or(1)
}
