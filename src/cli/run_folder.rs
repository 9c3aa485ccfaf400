//! How a command reads a run's folder.

use super::Failure;
use crate::run::{Run, load_front, load_run};
use crate::search::Front;
use std::path::Path;

/// Which of a run's fronts.
#[derive(Clone, Copy, Debug, Default, clap::Args)]
pub struct Which {
    /// The front in maximum error, its constants fitted for that, in place of the one searched for
    #[arg(long)]
    pub minimax: bool,
}

/// The run and a front of a folder that `lgp search` wrote.
pub fn load(folder: &Path, which: Which) -> Result<(Run, Front), Failure> {
    let run = load_run(folder)?;
    let front = load_front(folder, &run, which.minimax)?;
    Ok((run, front))
}
