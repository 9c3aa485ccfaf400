//! `lgp report`: the page and the pictures of a run.

use super::{Common, Failure, output};
use crate::deadline::Deadline;
use crate::file::replace_file;
use crate::report::{PAGE, Report, comparison};
use crate::run::Folder;
use serde::Serialize;
use std::path::PathBuf;

/// Make a page of a run: its front to click through, code to copy, error maps
///
/// Writes report.html into the run's folder, one file that needs no network, and pictures beside
/// it. The same run and dataset give the same bytes.
///
/// For example: lgp report runs/dfg
#[derive(clap::Args)]
pub struct Args {
    /// Runs: folders that `lgp search` or `lgp merge` wrote; several are compared, and those that
    /// differ only in their seeds are taken together
    #[arg(required = true)]
    runs: Vec<PathBuf>,
    /// The page of a comparison to write [default: comparison.html]
    #[arg(long, short, value_name = "FILE")]
    output: Option<PathBuf>,
    /// The dataset, if it is no longer where the run found it
    #[arg(long, value_name = "FILE")]
    dataset: Option<PathBuf>,
    /// First measure how long an evaluation takes on this processor, and keep that in the folder
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
                    "{problem}\nthe page has no maps; give its path with --dataset"
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
