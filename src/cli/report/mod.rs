//! `lgp report`: the page and the pictures of a run.

mod compare;
mod content;
mod pictures;
mod timing;

pub(super) use pictures::write_plots;

use super::run_folder::{self, Which};
use super::{Common, Failure};
use crate::dataset::{Dataset, replace_file};
use crate::deadline::Deadline;
use crate::report::page;
use crate::run::{Folder, Outcome, Run, Subject, Trace, load_trace};
use crate::search::{Front, Published};
use crate::stability::Questions;
use serde::Serialize;
use std::path::{Path, PathBuf};

const FILE: &str = "report.html";

/// Make the page of a run: its front to click through, code to copy, error maps
///
/// Writes report.html into the folder, one file that needs no network, and pictures beside it. The same
/// folder and dataset give the same bytes.
#[derive(clap::Args)]
pub struct Args {
    /// A folder that `lgp search` or `lgp merge` wrote; several are compared, those that differ only in
    /// their seeds as one
    #[arg(required = true)]
    runs: Vec<PathBuf>,
    /// Where a comparison is written [default: comparison.html]
    #[arg(long, short, value_name = "FILE")]
    output: Option<PathBuf>,
    /// The dataset, if it is not where the run found it
    #[arg(long, value_name = "FILE")]
    dataset: Option<PathBuf>,
    /// Measure first what an evaluation takes on this processor, and keep it in the folder
    #[arg(long)]
    measure: bool,
}

#[derive(Serialize)]
struct Written {
    #[serde(serialize_with = "crate::cli::output::readable")]
    page: PathBuf,
    bytes: usize,
}

/// What a report is made of: a search that has just ended, or a run's folder, read.
pub(super) struct Gathered {
    run: Run,
    front: Front,
    minimax: Front,
    /// The run's columns, if the data are still what they were.
    dataset: Option<Dataset>,
    published: Vec<Published>,
    /// How the search went on, if that was recorded.
    trace: Option<Trace>,
}

pub fn run(args: &Args, common: &Common) -> Result<(), Failure> {
    let (page, bytes) = match args.runs.as_slice() {
        [folder] if args.output.is_some() => {
            let folder = folder.display();
            return Err(Failure::usage(format!(
                "--output is for comparisons; the page of one run is {folder}/{FILE}"
            )));
        }
        [folder] => {
            let mut gathered = gather(folder, args.dataset.as_deref(), common)?;
            gathered.judge();
            let _owned = Folder::claim(folder)?;
            if args.measure {
                timing::measure(&gathered, folder)?;
            }
            (folder.join(FILE), write_all(&gathered, folder, &Deadline::NEVER)?.0)
        }
        _ if args.measure || args.dataset.is_some() => {
            return Err(Failure::usage("--measure and --dataset are for the page of one run"));
        }
        folders => {
            let page = args.output.clone().unwrap_or_else(|| PathBuf::from("comparison.html"));
            let bytes = compare::write(folders, &page)?;
            (page, bytes)
        }
    };
    let text = format!("{}: {:.1} MB", page.display(), bytes as f64 / 1e6);
    common.summary(&Written { page, bytes }, &text)
}

/// Writes the page and the pictures of a run into its folder, its verdicts as they are; past the deadline no
/// more pictures.
pub(super) fn write(
    gathered: &Gathered,
    folder: &Path,
    common: &Common,
    deadline: &Deadline,
) -> Result<(), Failure> {
    let (_, whole) = write_all(gathered, folder, deadline)?;
    if !whole && !common.quiet {
        let folder = folder.display();
        eprintln!("there was no time for all pictures; `lgp report {folder}` makes them");
    }
    Ok(())
}

impl Gathered {
    pub(super) fn of(outcome: &Outcome, dataset: Dataset, published: Vec<Published>) -> Gathered {
        let Outcome { run, front, minimax, trace, .. } = outcome.clone();
        let trace = Some(Trace::parse(&trace).expect("as it was just written"));
        Gathered { run, front, minimax, dataset: Some(dataset), published, trace }
    }

    /// As `lgp emit` does, so that its code and the page's are the same.
    fn judge(&mut self) {
        let questions = Questions::of(&self.run.inputs, &self.run.outputs);
        for front in [&mut self.front, &mut self.minimax] {
            front.judge(&questions, &self.run.names());
        }
    }
}

/// Gives the bytes of the page, and whether there was time for all pictures.
fn write_all(
    gathered: &Gathered,
    folder: &Path,
    deadline: &Deadline,
) -> Result<(usize, bool), Failure> {
    let html = page::html(&content::page(gathered, folder)?);
    let whole = pictures::write(gathered, folder, deadline)?;
    write_file(folder, FILE, html.as_bytes())?;
    Ok((html.len(), whole))
}

fn write_file(folder: &Path, name: &str, bytes: &[u8]) -> Result<(), Failure> {
    let path = folder.join(name);
    replace_file(&path, bytes).map_err(|error| Failure::unwritable(&path, error))
}

fn gather(folder: &Path, elsewhere: Option<&Path>, common: &Common) -> Result<Gathered, Failure> {
    let (mut run, front) = run_folder::load(folder, Which { minimax: false })?;
    let (_, minimax) = run_folder::load(folder, Which { minimax: true })?;
    let found = match elsewhere {
        Some(path) => {
            run.dataset = path.to_owned();
            Subject::of_run_at(&run, path)
        }
        None => Subject::of_run(&mut run, folder),
    };
    let subject = match found {
        Ok(subject) => Some(subject),
        Err(problem) if elsewhere.is_some() => {
            return Err(problem.into());
        }
        Err(problem) => {
            common.note(&format!(
                "{problem}\nthe page has no maps; --dataset says where the data are"
            ));
            None
        }
    };
    let published = subject.as_ref().and_then(|subject| subject.published_for(&run));
    let dataset = subject.map(|subject| subject.dataset);
    let trace = load_trace(folder, &run)?;
    Ok(Gathered { run, front, minimax, dataset, published: published.unwrap_or_default(), trace })
}
