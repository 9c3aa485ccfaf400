//! The data that is worked on: a dataset, cut to a scene and a choice of columns.

use super::Run;
use crate::cost::Profile;
use crate::dataset::{self, Dataset, ParsedIncumbent, incumbents_for, load_incumbents};
use crate::scene::{self, Scene};
use crate::search::{FrontMember, ScoredIncumbent};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A dataset that cannot be worked on.
#[derive(Debug, thiserror::Error)]
#[allow(missing_docs, reason = "each message names its fields")]
pub enum SubjectError {
    #[error(transparent)]
    Dataset(#[from] dataset::Error),
    #[error(transparent)]
    Scene(#[from] scene::Error),
    #[error("{path}: not the data that the run was made with, by its hash", path = path.display())]
    OtherData { path: PathBuf },
    #[error(
        "`{text}`: a derived output is NAME = EXPRESSION over the data's columns, as in `back = srgb`"
    )]
    Derived { text: String },
    #[error("`{name}`: a derived output needs a name that no column has")]
    DerivedTwice { name: String },
}

/// A dataset as it is worked on.
#[derive(Clone, Debug)]
pub struct Subject {
    /// The dataset of the file.
    pub whole: Dataset,
    /// The scene that it is cut to.
    pub scene: Option<Scene>,
    /// The dataset that is left.
    pub dataset: Arc<Dataset>,
}

impl Subject {
    /// Loads a dataset, and cuts it to a scene, given by name, and columns.
    ///
    /// # Errors
    /// [`SubjectError`].
    pub fn load(
        path: &Path,
        scene: Option<&str>,
        choose: impl FnOnce(&Dataset) -> Result<Dataset, dataset::Error>,
    ) -> Result<Subject, SubjectError> {
        Subject::load_with(path, scene, &[], choose)
    }

    /// As [`Subject::load`], with derived outputs as for [`Subject::new`].
    ///
    /// # Errors
    /// [`SubjectError`].
    pub fn load_with(
        path: &Path,
        scene: Option<&str>,
        derived: &[String],
        choose: impl FnOnce(&Dataset) -> Result<Dataset, dataset::Error>,
    ) -> Result<Subject, SubjectError> {
        let whole = Dataset::load(path)?;
        let scene = scene.map(|name| Scene::find(name, path)).transpose()?;
        Subject::new(whole, scene, derived, choose)
    }

    /// Cuts a dataset to a scene, if any, adds outputs that are computed of its columns, each as
    /// `name = expression`, and cuts it to a choice.
    ///
    /// # Errors
    /// [`SubjectError`].
    pub fn new(
        whole: Dataset,
        scene: Option<Scene>,
        derived: &[String],
        choose: impl FnOnce(&Dataset) -> Result<Dataset, dataset::Error>,
    ) -> Result<Subject, SubjectError> {
        let mut dataset = match &scene {
            Some(scene) => scene.over(&whole)?.dataset()?,
            None => whole.clone(),
        };
        if !derived.is_empty() {
            dataset = with_derived(&dataset, derived)?;
        }
        let dataset = choose(&dataset)?;
        Ok(Subject { whole, scene, dataset: Arc::new(dataset) })
    }

    /// Loads a run's data from where the run found it, or from as far from the run's folder as it
    /// was. The run's path is updated.
    ///
    /// # Errors
    /// [`SubjectError`], also if the data is not what the run was made with.
    pub fn of_run(run: &mut Run, folder: &Path) -> Result<Subject, SubjectError> {
        if let Some(path) = found(&run.dataset, folder) {
            run.dataset = path;
        }
        Subject::of_run_at(run, &run.dataset)
    }

    /// Loads a run's data from a path.
    ///
    /// # Errors
    /// As [`Subject::of_run`].
    pub fn of_run_at(run: &Run, path: &Path) -> Result<Subject, SubjectError> {
        let whole = Dataset::load(path)?;
        if !whole.has_hash(&run.dataset_hash) {
            return Err(SubjectError::OtherData { path: path.into() });
        }
        let names = run.names();
        Subject::new(whole, run.scene.clone(), &run.derived, |dataset| {
            dataset.select(Some(&names.inputs), Some(&names.outputs))
        })
    }

    /// Returns the incumbents beside a run's dataset, costed as the run does, if they can be read.
    pub fn published_for(&self, run: &Run) -> Option<Vec<ScoredIncumbent>> {
        self.published(&run.dataset, &run.profile()?).ok()
    }

    /// Returns the incumbents that define every output, scored.
    pub fn published(
        &self,
        path: &Path,
        profile: &Profile,
    ) -> Result<Vec<ScoredIncumbent>, SubjectError> {
        let names = self.dataset.names();
        let comparable = match &self.scene {
            Some(scene) => self.incumbents_in(scene, path)?,
            None => incumbents_for(path, &self.dataset)?,
        };
        let whole = comparable.into_iter().filter(|known| known.outputs == names.outputs);
        let published = whole.map(|known| ScoredIncumbent {
            name: known.incumbent.name,
            member: FrontMember::new(known.program, &self.dataset, profile, &names),
        });
        // One that is no formula is left out; a command says why.
        let original = self.original(profile).ok().flatten();
        Ok(published.chain(original).collect())
    }

    /// Returns the dataset's incumbents cut to the scene, and those made for the scene:
    /// `incumbents/<dataset>_<scene>.ron` beside the dataset's file.
    fn incumbents_in(
        &self,
        scene: &Scene,
        path: &Path,
    ) -> Result<Vec<ParsedIncumbent>, SubjectError> {
        let view = scene.over(&self.whole)?;
        let names = self.dataset.names();
        let mut found = Vec::new();
        if view.inputs() == names.inputs {
            for known in incumbents_for(path, &self.whole)? {
                let combined = view.program(&known.program, &known.outputs, &names.outputs);
                let outputs = names.outputs.clone();
                found.extend(combined.map(|program| ParsedIncumbent { program, outputs, ..known }));
            }
        }
        let folder = path.parent().unwrap_or(Path::new("")).join("incumbents");
        let own = folder.join(format!("{}.ron", self.dataset.name));
        if own.is_file() {
            let own = load_incumbents(&own)?;
            found.extend(own.iter().filter_map(|known| known.compared_on(&self.dataset)));
        }
        Ok(found)
    }
}

/// Returns a dataset with further outputs that are computed of its columns.
fn with_derived(dataset: &Dataset, derived: &[String]) -> Result<Dataset, SubjectError> {
    let own = dataset.outputs.iter().map(|column| (column.name.clone(), column.name.clone()));
    let mut outputs: Vec<(String, String)> = own.collect();
    for text in derived {
        let (name, expression) = text
            .split_once('=')
            .map(|(name, expression)| (name.trim(), expression.trim()))
            .filter(|(name, expression)| !name.is_empty() && !expression.is_empty())
            .ok_or_else(|| SubjectError::Derived { text: text.clone() })?;
        let names = dataset.names();
        let known = names.inputs.iter().chain(outputs.iter().map(|(known, _)| known));
        if known.into_iter().any(|known| known == name) {
            return Err(SubjectError::DerivedTwice { name: name.to_owned() });
        }
        outputs.push((name.to_owned(), expression.to_owned()));
    }
    let scene = Scene { name: "derived".into(), outputs, ..Scene::default() };
    let with = scene.over(dataset)?.dataset()?;
    Ok(Dataset { name: dataset.name.clone(), ..with })
}

/// Finds a run's dataset: at its path seen from here, or from the run's folder or one around it, as
/// when the command is given elsewhere.
fn found(dataset: &Path, folder: &Path) -> Option<PathBuf> {
    if dataset.is_absolute() || dataset.is_file() {
        return Some(dataset.to_owned());
    }
    let folder = folder.canonicalize().ok()?;
    folder.ancestors().map(|around| around.join(dataset)).find(|path| path.is_file())
}

/// Returns a dataset's path as a run in a folder notes it: as given if it can be found again by
/// that, else in full.
pub fn noted(dataset: &Path, folder: &Path) -> PathBuf {
    let (Ok(full), Ok(folder)) = (dataset.canonicalize(), folder.canonicalize()) else {
        return dataset.to_owned();
    };
    let is_it = |around: &Path| around.join(dataset).canonicalize().is_ok_and(|path| path == full);
    match folder.ancestors().any(is_it) {
        true => dataset.to_owned(),
        false => full,
    }
}
