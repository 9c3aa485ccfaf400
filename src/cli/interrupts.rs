//! Ctrl-C, and what asks a process to end.

use super::Exit;
use crate::deadline::Stop;

/// Once for the search, once for what follows it; then nothing is waited for.
const REQUESTS: usize = 2;

/// Makes requests of Ctrl-C, SIGTERM and SIGHUP, the last unless it is ignored, as under `nohup`: then the process is
/// to outlive its terminal.
pub fn watch() -> Stop {
    let stop = Stop::default();
    let seen = stop.clone();
    on_each(move || {
        if seen.request() > REQUESTS {
            std::process::exit(Exit::Interrupted as i32);
        }
    });
    stop
}

// Without a handler a signal ends the process, and the last checkpoint stands.
#[cfg(unix)]
fn on_each(act: impl Fn() + Send + 'static) {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    let hangup = (!hangups_are_ignored()).then_some(SIGHUP);
    let watched = [SIGINT, SIGTERM].into_iter().chain(hangup);
    let Ok(mut signals) = signal_hook::iterator::Signals::new(watched) else { return };
    std::thread::spawn(move || signals.forever().for_each(|_| act()));
}

#[cfg(not(unix))]
fn on_each(act: impl Fn() + Send + 'static) {
    let _ = ctrlc::set_handler(act);
}

#[cfg(unix)]
fn hangups_are_ignored() -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let ignored = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let mask = ignored.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
    mask.is_some_and(|mask| mask & 1 == 1)
}
