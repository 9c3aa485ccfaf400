//! Failures of commands: exit codes and messages.

use super::output::to_stderr;
use crate::grammar::FileError;
use crate::import::array;
use crate::run::{FollowError, Incompatible, RecordError, SubjectError};
use crate::search::SetupError;
use crate::{dataset, import, program, project, report, scene, targets};
use std::io::ErrorKind;
use std::path::Path;
use std::process::ExitCode;

/// Exit code of a command that was not done.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Exit {
    /// The request is fine, but could not be carried out.
    Failed = 1,
    /// The command line itself is wrong.
    Usage = 2,
    /// Something that the command line refers to is unusable.
    Input = 3,
    /// A target that was asked for was not met.
    Unmet = 4,
    /// Stopped by the user.
    Interrupted = 130,
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> ExitCode {
        ExitCode::from(exit as u8)
    }
}

/// The reason why a command was not done, for the person who called it.
#[derive(Debug)]
pub struct Failure {
    /// The exit code.
    pub exit: Exit,
    /// The error to show, with its causes.
    pub error: anyhow::Error,
}

impl Failure {
    /// Returns a failure that ends the process with `exit`.
    pub fn new(exit: Exit, error: impl Into<anyhow::Error>) -> Failure {
        Failure { exit, error: error.into() }
    }

    /// Reports a command line that is wrong whatever the files hold.
    pub fn usage(message: impl Into<String>) -> Failure {
        Failure::new(Exit::Usage, anyhow::Error::msg(message.into()))
    }

    /// Reports something unusable that the command line refers to.
    pub fn input(message: impl Into<String>) -> Failure {
        Failure::new(Exit::Input, anyhow::Error::msg(message.into()))
    }

    /// Reports that a target that was asked for was not met.
    pub fn unmet(message: impl Into<String>) -> Failure {
        Failure::new(Exit::Unmet, anyhow::Error::msg(message.into()))
    }

    /// Reports a request that is fine, but could not be carried out.
    pub fn failed(message: impl Into<String>) -> Failure {
        Failure::new(Exit::Failed, anyhow::Error::msg(message.into()))
    }

    /// Reports that the user stopped the command.
    pub fn interrupted(message: impl Into<String>) -> Failure {
        Failure::new(Exit::Interrupted, anyhow::Error::msg(message.into()))
    }

    /// Reports an output that cannot be written.
    pub fn unwritable(path: &Path, reason: std::io::Error) -> Failure {
        let path = path.display();
        let advice = match reason.kind() {
            ErrorKind::StorageFull | ErrorKind::QuotaExceeded => {
                "free some space, or choose an output on another disk"
            }
            _ => "choose an output in a folder that exists and that you may write to",
        };
        Failure::failed(format!("{path}: cannot be written: {reason}; {advice}"))
    }

    /// Prints the error on stderr, and its causes as far as it does not name them itself.
    pub(super) fn report(&self) {
        let mut text = self.error.to_string();
        for cause in self.error.chain().skip(1).map(ToString::to_string) {
            if !text.contains(&cause) {
                text = format!("{text}\n  because: {cause}");
            }
        }
        to_stderr(&format!("error: {text}"));
    }
}

impl From<dataset::Error> for Failure {
    fn from(error: dataset::Error) -> Failure {
        match error {
            dataset::Error::Io { path, action: "written", source } => {
                Failure::unwritable(&path, source)
            }
            error => Failure::new(Exit::Input, error),
        }
    }
}

impl From<import::Error> for Failure {
    fn from(error: import::Error) -> Failure {
        match error {
            import::Error::Dataset(error) => error.into(),
            error => Failure::new(Exit::Input, error),
        }
    }
}

impl From<array::Error> for Failure {
    fn from(error: array::Error) -> Failure {
        Failure::new(Exit::Input, error)
    }
}

impl From<scene::Error> for Failure {
    fn from(error: scene::Error) -> Failure {
        Failure::new(Exit::Input, error)
    }
}

impl From<targets::Error> for Failure {
    fn from(error: targets::Error) -> Failure {
        match error {
            targets::Error::Dataset(error) => error.into(),
            error @ targets::Error::Accuracy { .. } => Failure::new(Exit::Failed, error),
            error => Failure::new(Exit::Input, error),
        }
    }
}

impl From<FileError> for Failure {
    fn from(error: FileError) -> Failure {
        Failure::new(Exit::Input, error)
    }
}

impl From<RecordError> for Failure {
    fn from(error: RecordError) -> Failure {
        match error {
            RecordError::Unwritable { path, reason } => Failure::unwritable(&path, reason),
            error @ RecordError::Busy { .. } => Failure::new(Exit::Failed, error),
            error => Failure::new(Exit::Input, error),
        }
    }
}

impl From<SubjectError> for Failure {
    fn from(error: SubjectError) -> Failure {
        match error {
            SubjectError::Dataset(error) => error.into(),
            SubjectError::Scene(error) => error.into(),
            error @ SubjectError::OtherData { .. } => Failure::new(Exit::Input, error),
            error @ (SubjectError::Derived { .. } | SubjectError::DerivedTwice { .. }) => {
                Failure::usage(format!("--derive {error}"))
            }
        }
    }
}

impl From<report::Error> for Failure {
    fn from(error: report::Error) -> Failure {
        match error {
            report::Error::Record(error) => error.into(),
            report::Error::Subject(error) => error.into(),
            report::Error::File(error) => error.into(),
            report::Error::NoData => {
                Failure::input(format!("--measure: {error}; --dataset says where it is"))
            }
            report::Error::Plot(error) => Failure::new(Exit::Failed, error),
            error => Failure::new(Exit::Input, error),
        }
    }
}

impl From<FollowError> for Failure {
    fn from(error: FollowError) -> Failure {
        Failure::new(Exit::Input, error)
    }
}

impl From<SetupError> for Failure {
    fn from(error: SetupError) -> Failure {
        match error {
            SetupError::Dataset(error) => error.into(),
            SetupError::File(error) => error.into(),
            error => Failure::new(Exit::Input, error),
        }
    }
}

impl From<program::ParseError> for Failure {
    fn from(error: program::ParseError) -> Failure {
        Failure::new(Exit::Input, error)
    }
}

impl From<project::Error> for Failure {
    fn from(error: project::Error) -> Failure {
        match error {
            project::Error::Formula(error) => error.into(),
            project::Error::Dataset(error) => error.into(),
            error if error.is_usage() => Failure::new(Exit::Usage, error),
            error => Failure::new(Exit::Input, error),
        }
    }
}

impl From<Incompatible> for Failure {
    fn from(error: Incompatible) -> Failure {
        Failure::new(Exit::Input, error)
    }
}
