use super::run_folder::{self, Which};
use super::{Common, Failure, front};
use crate::report::write_plots;
use crate::run::{
    CHECKPOINT, FRONT_TABLE, Folder, Holding, MemberRecord, Run, front_files, in_the_way, load_run,
    merge,
};
use crate::search::Front;
use crate::wording::front_table;
use std::path::{Path, PathBuf};

/// Put runs together: the front that none of their formulas dominates
///
/// The order does not matter, nor how often a run is given: seeds can be spread over any number of
/// machines, and unions merged again. The runs must be of the same dataset, columns, grammar and GPU
/// profile.
#[derive(clap::Args)]
pub struct Args {
    /// Folders that `lgp search` or `lgp merge` wrote
    #[arg(required = true)]
    runs: Vec<PathBuf>,
    /// Where the union is written; a union that is there already is replaced
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
}

pub fn run(args: &Args, common: &Common) -> Result<(), Failure> {
    let (run, mut union) = united(args, Which { minimax: false })?;
    let (_, mut minimax) = united(args, Which { minimax: true })?;
    let questions = run.questions();
    for front in [&mut union, &mut minimax] {
        front.judge(&questions, &run.names());
    }
    check_replaceable(&args.out)?;
    let folder = Folder::claim(&args.out)?;
    // It may have changed hands in between.
    check_replaceable(&args.out)?;
    let incumbents = front::incumbents(&mut run.clone(), &args.runs[0]).unwrap_or_default();
    let table = front_table(&union, &incumbents, &run.names().outputs);
    let mut files = front_files(&run, &union, &minimax);
    files.push((FRONT_TABLE.to_owned(), table.clone().into()));
    let written = folder
        .exchange(&run, &files)
        .map_err(Failure::from)
        .and_then(|()| Ok(write_plots(&args.out, &run, &union, &incumbents)?));
    let names = run.names();
    let records: Vec<_> = union.members.iter().map(|m| MemberRecord::new(m, &names)).collect();
    common.result(&records, &table)?;
    written?;
    common.note(&format!("{} searches; written to {}", run.sources.len(), args.out.display()));
    Ok(())
}

fn united(args: &Args, which: Which) -> Result<(Run, Front), Failure> {
    let runs: Result<Vec<_>, Failure> =
        args.runs.iter().map(|run| run_folder::load(run, which)).collect();
    merge(runs?)?.ok_or_else(|| Failure::usage("no runs to merge"))
}

/// A search's folder holds what cannot be had again; and other files may be called as a union's are.
fn check_replaceable(out: &Path) -> Result<(), Failure> {
    let refuse = |reason: &str| {
        let out = out.display();
        Err(Failure::usage(format!(
            "{out}: the union would replace {reason}; choose another --out"
        )))
    };
    match Holding::of(out) {
        Holding::Finished if load_run(out)?.sources.is_empty() => refuse("a search"),
        Holding::Unfinished if out.join(CHECKPOINT).exists() => refuse("a search"),
        Holding::NoRun => match in_the_way(out) {
            Some(file) => refuse(&format!("`{file}`, which is no run's")),
            None => Ok(()),
        },
        _ => Ok(()),
    }
}
