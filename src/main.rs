use std::process::ExitCode;

fn main() -> ExitCode {
    lgp::cli::run()
}
