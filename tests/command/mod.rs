//! The program, run as a user runs it.

// A test has no use for all of it.
#![allow(dead_code)]

use std::path::Path;
use std::process::{Command, Output};

pub fn command(folder: &Path, args: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_lgp"));
    command.current_dir(folder).args(args);
    command
}

pub fn lgp(folder: &Path, args: &[&str]) -> Output {
    command(folder, args).output().expect("it runs")
}

/// At the top of the repository, where committed runs have their datasets.
pub fn lgp_here(args: &[&str]) -> Output {
    lgp(Path::new(env!("CARGO_MANIFEST_DIR")), args)
}

pub fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// What a command prints, which has to succeed.
pub fn succeed(folder: &Path, args: &[&str]) -> String {
    let output = lgp(folder, args);
    assert!(output.status.success(), "{args:?}: {}", text(&output.stderr));
    text(&output.stdout)
}
