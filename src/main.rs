//! The `lgp` program: [`lgp::cli`], with the process's arguments.

use std::process::ExitCode;

fn main() -> ExitCode {
    lgp::cli::run()
}
