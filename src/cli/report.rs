//! `lgp report`: the page and the pictures of a run.

use super::{Common, Failure, output};
use crate::dataset::replace_file;
use crate::deadline::Deadline;
use crate::report::{PAGE, Report, comparison};
use crate::run::Folder;
use serde::Serialize;
use std::path::PathBuf;

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

pub fn run(args: &Args, common: &Common) -> Result<(), Failure> {
    let (page, bytes) = match args.runs.as_slice() {
        [folder] if args.output.is_some() => {
            let folder = folder.display();
            return Err(Failure::usage(format!(
                "--output is for comparisons; the page of one run is {folder}/{PAGE}"
            )));
        }
        [folder] => {
            let (mut report, problem) = Report::load(folder, args.dataset.as_deref())?;
            if let Some(problem) = problem {
                common.note(&format!(
                    "{problem}\nthe page has no maps; --dataset says where the data are"
                ));
            }
            // As `lgp emit` does, so that its code and the page's are the same.
            report.judge();
            let _owned = Folder::claim(folder)?;
            if args.measure {
                report.measure(folder)?;
            }
            (folder.join(PAGE), report.write(folder, &Deadline::NEVER)?.bytes)
        }
        _ if args.measure || args.dataset.is_some() => {
            return Err(Failure::usage("--measure and --dataset are for the page of one run"));
        }
        folders => {
            let page = args.output.clone().unwrap_or_else(|| PathBuf::from("comparison.html"));
            output::check_writable(&page)?;
            let html = comparison(folders)?;
            replace_file(&page, html.as_bytes())
                .map_err(|error| Failure::unwritable(&page, error))?;
            (page, html.len())
        }
    };
    let text = format!("{}: {:.1} MB", page.display(), bytes as f64 / 1e6);
    common.summary(&Written { page, bytes }, &text)
}
