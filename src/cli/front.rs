//! `lgp front`: a run's front as a table.

use super::run_folder::{self, Which};
use super::{Common, Failure, tiers};
use crate::run::Subject;
use crate::run::{MemberRecord, Run};
use crate::search::Front;
use crate::search::ScoredIncumbent;
use crate::wording::front_table;
use std::path::{Path, PathBuf};

/// Show the front of a run as a table, with published formulas beside it
///
/// Each formula has a number, which `lgp emit`, `lgp check` and `lgp render` take with --pick.
///
/// For example: lgp front runs/dfg
#[derive(clap::Args)]
pub struct Args {
    /// A run: a folder that `lgp search` wrote
    run: PathBuf,
    #[command(flatten)]
    which: Which,
}

pub fn run(args: &Args, common: &Common) -> Result<(), Failure> {
    let (mut run, mut front) = run_folder::load(&args.run, args.which)?;
    count_registers(&run, &mut front);
    let names = run.names();
    front.judge(&run.questions(), &names);
    let records: Vec<_> = front.members.iter().map(|m| MemberRecord::new(m, &names)).collect();
    let table =
        front_table(&front, &incumbents(&mut run, &args.run).unwrap_or_default(), &names.outputs)
            + &tiers::table(&run, &front);
    common.result(&records, &table)
}

/// Counts the registers that records of an older version lack, if the profile is still there.
fn count_registers(run: &Run, front: &mut Front) {
    let Some(profile) = run.profile() else { return };
    for member in front.members.iter_mut().filter(|member| member.registers.is_none()) {
        member.registers = Some(profile.cost(&member.program).registers);
    }
}

/// Returns the incumbents, if the dataset is still where the run found it.
pub(super) fn incumbents(run: &mut Run, folder: &Path) -> Option<Vec<ScoredIncumbent>> {
    Subject::of_run(run, folder).ok()?.published_for(run)
}
