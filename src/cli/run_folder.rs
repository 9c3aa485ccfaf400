//! Reading of a run's folder by commands.

use super::Failure;
use crate::run::{Run, load_front, load_run};
use crate::search::Front;
use std::path::Path;

/// The choice of one of a run's fronts.
#[derive(Clone, Copy, Debug, Default, clap::Args)]
pub struct Which {
    /// Use the front in maximum error, its constants fitted for that, not the front that was
    /// searched for
    #[arg(long)]
    pub minimax: bool,
}

/// Loads the run and a front of a folder that `lgp search` wrote.
pub fn load(folder: &Path, which: Which) -> Result<(Run, Front), Failure> {
    let run = load_run(folder)?;
    let front = load_front(folder, &run, which.minimax)?;
    Ok((run, front))
}
