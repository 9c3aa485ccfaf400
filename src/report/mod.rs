//! Reports: the page of a run and the pictures beside it, maps, spheres.
//!
//! A [`Report`] is made of a search that has just ended, or of its folder, and written by one
//! function.
//!
//! ```no_run
//! use lgp::deadline::Deadline;
//! use lgp::report::Report;
//! use std::path::Path;
//! let folder = Path::new("runs/dfg");
//! let (mut report, problem) = Report::load(folder, None)?;
//! if let Some(problem) = problem {
//!     eprintln!("no maps: {problem}");
//! }
//! report.judge();
//! report.write(folder, &Deadline::default())?;
//! # Ok::<(), lgp::report::Error>(())
//! ```

mod comparison;
mod drawing;
mod error;
pub mod maps;
mod model;
pub mod page;
mod pictures;
pub mod plot;
mod projection;
mod raster;
pub mod spheres;
mod timing;

pub use comparison::comparison;
pub use drawing::{Drawing, ROUGHNESSES, SIZE};
pub use error::Error;
pub use pictures::write_plots;
pub use projection::{PICTURES, ProjectionReport, findings};
pub use timing::Timing;

use crate::dataset::Dataset;
use crate::deadline::Deadline;
use crate::file::replace_file;
use crate::run::{
    Outcome, RecordError, Run, Subject, SubjectError, Trace, load_front, load_run, load_trace,
};
use crate::search::{Front, ScoredIncumbent};
use std::path::Path;
use std::sync::Arc;

/// The file name of a run's page.
pub const PAGE: &str = "report.html";

/// The report of a run.
#[derive(Clone, Debug)]
pub struct Report {
    /// The record of the run.
    pub run: Run,
    /// The front in the measure that was minimised.
    pub front: Front,
    /// The front in maximum error.
    pub minimax: Front,
    /// The run's columns, if the data are still what they were.
    pub dataset: Option<Arc<Dataset>>,
    /// The incumbents, scored.
    pub published: Vec<ScoredIncumbent>,
    /// The progress of the search, if it was recorded.
    pub trace: Option<Trace>,
    /// The time of evaluations on some processors, if it was measured.
    pub timings: Vec<Timing>,
}

/// A report that was written.
#[derive(Clone, Copy, Debug)]
pub struct Written {
    /// The size of the page, in bytes.
    pub bytes: usize,
    /// True if there was time for all pictures.
    pub is_whole: bool,
}

impl Report {
    /// Returns the report of a search that has just ended.
    pub fn of(outcome: &Outcome, dataset: Arc<Dataset>, published: Vec<ScoredIncumbent>) -> Report {
        let Outcome { run, front, minimax, trace, .. } = outcome.clone();
        let trace = Some(Trace::parse(&trace).expect("as it was just written"));
        let dataset = Some(dataset);
        Report { run, front, minimax, dataset, published, trace, timings: Vec::new() }
    }

    /// Loads the report of a run's folder, with the dataset at `elsewhere` if that is given.
    /// Without its dataset a report has no maps: it is returned with what is wrong.
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

    /// Judges the formulas that have no verdict yet.
    pub fn judge(&mut self) {
        let questions = self.run.questions();
        for front in [&mut self.front, &mut self.minimax] {
            front.judge(&questions, &self.run.names());
        }
    }

    /// Writes the page and the pictures into a run's folder, verdicts as they are; no more pictures
    /// after the deadline.
    ///
    /// # Errors
    /// [`Error::Record`] if something cannot be written; [`Error::Plot`].
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
