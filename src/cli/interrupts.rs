//! Ctrl-C and the signals that end a process.

use super::Exit;
use crate::deadline::Stop;

/// One ends the search, one more what follows it; a third ends the process.
const REQUESTS: usize = 2;

/// Turns Ctrl-C, SIGTERM and SIGHUP into requests; SIGHUP not where it is ignored, as under
/// `nohup`, since the process is to outlive its terminal.
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
