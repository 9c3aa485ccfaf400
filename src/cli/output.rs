//! Output of all commands: results on stdout, everything else on stderr.

use super::{Exit, Failure};
use crate::dataset::Dataset;
use crate::file::check_replaceable;
use crate::printable::{printable_json, printable_lines};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use serde::{Serialize, Serializer};
use std::io::{ErrorKind, IsTerminal, Write};
use std::path::Path;

/// The options of every command.
#[derive(Clone, Debug, clap::Args)]
pub struct Common {
    /// Print results as JSON on stdout, and everything else on stderr
    #[arg(long, global = true)]
    pub json: bool,
    /// Print nothing but results and errors
    #[arg(long, short, global = true)]
    pub quiet: bool,
    /// The number of threads to use [default: one for each core]
    #[arg(long, global = true, value_name = "N")]
    #[arg(value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// The seed of random numbers: the same seed repeats a search [default: 1]
    #[arg(long, global = true, value_name = "S")]
    pub seed: Option<u64>,
}

impl Common {
    /// Returns the seed, or the usual one.
    pub fn seed(&self) -> u64 {
        self.seed.unwrap_or(1)
    }

    pub(super) fn start(&self) -> Result<(), Failure> {
        let Some(threads) = self.threads else { return Ok(()) };
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.into());
        pool.build_global().map_err(|error| {
            let error = anyhow::anyhow!("cannot start {threads} threads: {error}; ask for fewer");
            Failure::new(Exit::Failed, error)
        })
    }

    /// Prints a result: `text`, or with `--json` the value.
    pub fn result(&self, value: &impl Serialize, text: &str) -> Result<(), Failure> {
        if !self.json {
            return to_stdout(&printable_lines(text.trim_end()));
        }
        let json = serde_json::to_string_pretty(value)
            .map_err(|error| Failure::new(Exit::Failed, error))?;
        to_stdout(&printable_json(&json))
    }

    /// Prints a summary for a command that leaves a file behind.
    pub fn summary(&self, value: &impl Serialize, text: &str) -> Result<(), Failure> {
        if self.quiet && !self.json {
            return Ok(());
        }
        if self.json {
            self.note(text);
        }
        self.result(value, text)
    }

    /// Prints a remark on stderr, unless only results are wanted.
    pub fn note(&self, text: &str) {
        if !self.quiet {
            to_stderr(text);
        }
    }

    /// Returns a progress bar, hidden unless stderr is a terminal.
    pub fn progress(&self, verb: &'static str) -> ProgressBar {
        if self.quiet || !std::io::stderr().is_terminal() {
            return ProgressBar::with_draw_target(None, ProgressDrawTarget::hidden());
        }
        let style = ProgressStyle::with_template("{msg} {wide_bar} {percent}%, {eta} left");
        let style = style.unwrap_or_else(|_| ProgressStyle::default_bar());
        ProgressBar::new(0).with_style(style).with_message(verb)
    }
}

/// Serialises a path as text, for JSON.
pub(super) fn readable<S: Serializer>(path: &Path, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(&path.to_string_lossy())
}

/// Prints to stderr.
pub(super) fn to_stderr(text: &str) {
    // Nobody is left to tell if stderr is closed.
    let _ = writeln!(std::io::stderr(), "{}", printable_lines(text));
}

fn to_stdout(text: &str) -> Result<(), Failure> {
    let mut stdout = std::io::stdout().lock();
    match writeln!(stdout, "{text}").and_then(|()| stdout.flush()) {
        // Whoever reads has seen enough, as in `lgp list | head`.
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
        Err(error) => {
            let error = anyhow::anyhow!("standard output: cannot be written: {error}");
            Err(Failure::new(Exit::Failed, error))
        }
        Ok(()) => Ok(()),
    }
}

/// Refuses an output that could not be written, before anything is computed.
pub fn check_writable(path: &Path) -> Result<(), Failure> {
    let folder = match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    if path.file_name().is_none() {
        return Err(Failure::unwritable(path, ErrorKind::IsADirectory.into()));
    }
    check_replaceable(path).map_err(|error| Failure::unwritable(path, error))?;
    let attempt = tempfile::Builder::new().prefix(".lgp-").tempfile_in(folder);
    // The error would name the temporary, which means nothing to the user.
    attempt.map(drop).map_err(|error| Failure::unwritable(path, reason(error)))
}

fn reason(error: std::io::Error) -> std::io::Error {
    let reason = match error.kind() {
        ErrorKind::NotFound => "its folder does not exist",
        ErrorKind::NotADirectory => "its folder is a file",
        ErrorKind::PermissionDenied => "its folder does not let you write",
        kind => return kind.into(),
    };
    std::io::Error::new(error.kind(), reason)
}

/// Saves a dataset under the name of its file, as committed recipes expect.
pub fn save(mut dataset: Dataset, path: &Path) -> Result<Dataset, Failure> {
    dataset.name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    dataset.save(path)?;
    Ok(dataset)
}
