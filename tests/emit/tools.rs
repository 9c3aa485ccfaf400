//! Compilers and interpreters that may be missing.

use std::io::Write;
use std::path::Path;
use std::process::Command;

/// Whether the command works. If not, says what was not tested; with `LGP_REQUIRE_TOOLS=1` it is
/// a failure.
pub fn found(command: &[&str], untested: &str) -> bool {
    let works = runs(command);
    if !works {
        skipped(&format!("{} does not run; {untested}", command.join(" ")));
    }
    works
}

pub fn runs(command: &[&str]) -> bool {
    let ran = Command::new(command[0]).args(&command[1..]).output();
    ran.is_ok_and(|output| output.status.success())
}

/// Says that a test could not be made, or fails with `LGP_REQUIRE_TOOLS=1`.
pub fn skipped(reason: &str) {
    let line = format!("SKIPPED: {reason}");
    assert!(std::env::var("LGP_REQUIRE_TOOLS").as_deref() != Ok("1"), "{line}");
    // The test harness captures what the print macros write, but not this.
    // In one piece, lest another test's line stands in it.
    let _ = std::io::stderr().write_all(format!("\n{line}\n").as_bytes());
}

/// Runs the command in the folder.
///
/// # Panics
/// If it fails, with what it said.
pub fn run(folder: &Path, command: &[&str]) {
    let output = Command::new(command[0]).args(&command[1..]).current_dir(folder).output().unwrap();
    let said =
        [output.stdout, output.stderr].map(|text| String::from_utf8_lossy(&text).into_owned());
    assert!(output.status.success(), "{}: {}", command.join(" "), said.concat());
}
