//! `lgp merge`: the union of runs.

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

/// Merge runs: keep the formulas that no other dominates
///
/// Neither the order of the runs nor giving one twice changes the result, so seeds can be spread
/// over any number of machines, and unions merged again. The runs must have the same dataset,
/// columns, grammar and GPU profile.
///
/// For example: lgp merge runs/dfg runs/dfg-2 --out runs/union
#[derive(clap::Args)]
pub struct Args {
    /// Runs: folders that `lgp search` or `lgp merge` wrote
    #[arg(required = true)]
    runs: Vec<PathBuf>,
    /// The folder to write the union to; a union that is already there is replaced
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

/// Refuses a folder with a search, which cannot be made again from other runs, or with files that
/// are no run's but are called as a union's.
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
