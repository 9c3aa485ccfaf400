//! What a person looks at: the page of a run and the pictures beside it, maps, spheres.
//!
//! A [`Report`] is made of a search that has just ended, or of its folder, and written by one function.

mod comparison;
mod drawing;
mod error;
pub mod maps;
mod model;
pub mod page;
mod pictures;
pub mod plot;
mod raster;
pub mod spheres;
mod timing;

pub use comparison::comparison;
pub use drawing::{Drawing, ROUGHNESSES, SIZE};
pub use error::Error;
pub use pictures::write_plots;
pub use timing::Timing;

use crate::dataset::{Dataset, replace_file};
use crate::deadline::Deadline;
use crate::run::{
    Outcome, RecordError, Run, Subject, SubjectError, Trace, load_front, load_run, load_trace,
};
use crate::search::{Front, ScoredIncumbent};
use std::path::Path;
use std::sync::Arc;

/// The page of a run.
pub const PAGE: &str = "report.html";

/// A run, and what is shown of it.
#[derive(Clone, Debug)]
pub struct Report {
    pub run: Run,
    pub front: Front,
    pub minimax: Front,
    /// The run's columns, if the data are still what they were.
    pub dataset: Option<Arc<Dataset>>,
    pub published: Vec<ScoredIncumbent>,
    /// How the search went on, if that was recorded.
    pub trace: Option<Trace>,
    /// What evaluations take on some processors, if that was measured.
    pub timings: Vec<Timing>,
}

/// What was written.
#[derive(Clone, Copy, Debug)]
pub struct Written {
    /// Bytes of the page.
    pub bytes: usize,
    /// Whether there was time for all pictures.
    pub is_whole: bool,
}

impl Report {
    /// Of a search that has just ended.
    pub fn of(outcome: &Outcome, dataset: Arc<Dataset>, published: Vec<ScoredIncumbent>) -> Report {
        let Outcome { run, front, minimax, trace, .. } = outcome.clone();
        let trace = Some(Trace::parse(&trace).expect("as it was just written"));
        let dataset = Some(dataset);
        Report { run, front, minimax, dataset, published, trace, timings: Vec::new() }
    }

    /// Of a run's folder, the dataset at `elsewhere` if that is given. Without its dataset a report has no maps:
    /// then it comes with what is wrong.
    ///
    /// # Errors
    /// [`Error`]: no run there; another dataset elsewhere.
    pub fn load(
        folder: &Path,
        elsewhere: Option<&Path>,
    ) -> Result<(Report, Option<SubjectError>), Error> {
        let mut run = load_run(folder)?;
        let [front, minimax] = [load_front(folder, &run, false)?, load_front(folder, &run, true)?];
        let (subject, problem) = match elsewhere {
            Some(path) => {
                run.dataset = path.to_owned();
                (Some(Subject::of_run_at(&run, path)?), None)
            }
            None => match Subject::of_run(&mut run, folder) {
                Ok(subject) => (Some(subject), None),
                Err(problem) => (None, Some(problem)),
            },
        };
        let published = subject.as_ref().and_then(|subject| subject.published_for(&run));
        let report = Report {
            trace: load_trace(folder, &run)?,
            timings: timing::load(folder)?,
            dataset: subject.map(|subject| subject.dataset),
            published: published.unwrap_or_default(),
            run,
            front,
            minimax,
        };
        Ok((report, problem))
    }

    /// Finds out what can be proved of its formulas, unless that is known.
    pub fn judge(&mut self) {
        let questions = self.run.questions();
        for front in [&mut self.front, &mut self.minimax] {
            front.judge(&questions, &self.run.names());
        }
    }

    /// Writes the page and the pictures into a run's folder, verdicts as they are; past the deadline no more
    /// pictures.
    ///
    /// # Errors
    /// [`Error::Record`] where something cannot be written; [`Error::Plot`].
    pub fn write(&self, folder: &Path, deadline: &Deadline) -> Result<Written, Error> {
        let html = page::html(&model::page(self)?);
        let is_whole = pictures::write(self, folder, deadline)?;
        write_file(folder, PAGE, html.as_bytes())?;
        Ok(Written { bytes: html.len(), is_whole })
    }
}

fn write_file(folder: &Path, name: &str, bytes: &[u8]) -> Result<(), Error> {
    let path = folder.join(name);
    let written = replace_file(&path, bytes);
    Ok(written.map_err(|reason| RecordError::Unwritable { path, reason })?)
}
