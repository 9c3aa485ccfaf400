//! The progress of a search, on a terminal.

use super::Common;
use super::timings::Timings;
use crate::run::{Phase, Progress, TRACE_COSTS};
use crate::wording::title;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::sync::Mutex;

const LENGTH: u64 = 1000;

/// The front while it grows.
pub struct LiveFront(ProgressBar);

impl LiveFront {
    pub fn new(common: &Common) -> LiveFront {
        if common.quiet || !std::io::stderr().is_terminal() {
            return LiveFront(ProgressBar::with_draw_target(None, ProgressDrawTarget::hidden()));
        }
        let style = ProgressStyle::with_template("{msg}\n{wide_bar} {percent}%");
        let style = style.unwrap_or_else(|_| ProgressStyle::default_bar());
        LiveFront(ProgressBar::new(LENGTH).with_style(style))
    }

    pub fn show(&self, progress: &Progress) {
        if self.0.is_hidden() {
            return;
        }
        let row = |label: &str, cells: Vec<String>| {
            let cells: String = cells.iter().map(|cell| format!("{cell:>9}")).collect();
            format!("{label:<7}{cells}")
        };
        let Progress { point, measure, share } = progress;
        let costs = TRACE_COSTS.iter().map(|cost| format!("≤ {cost}")).collect();
        let errors = point.errors.iter().map(|error| format!("{error:.5}")).collect();
        self.0.set_message(format!(
            "{:.0} s, {} candidates considered, {} fitted\n{}\n{}",
            point.seconds,
            point.counts.considered,
            point.counts.fitted,
            row("cycles", costs),
            row(title(*measure), errors)
        ));
        self.0.set_position((share.min(1.0) * LENGTH as f64) as u64);
    }

    pub fn clear(&self) {
        self.0.finish_and_clear();
    }
}

/// The phases that follow a search: a progress bar for each, and its time.
pub struct Phases<'a> {
    common: &'a Common,
    current: Mutex<(Option<ProgressBar>, &'a mut Timings)>,
}

impl<'a> Phases<'a> {
    pub fn new(common: &'a Common, timings: &'a mut Timings) -> Phases<'a> {
        Phases { common, current: Mutex::new((None, timings)) }
    }

    /// Takes the progress that [`crate::run::Session::finish`] reports.
    pub fn hear(&self, phase: Phase, share: Option<f64>) {
        let mut current = self.current.lock().expect("no thread panics with it");
        let (bar, timings) = &mut *current;
        let begin = || {
            let bar = self.common.progress(verb(phase));
            bar.set_length(LENGTH);
            bar
        };
        match share {
            Some(share) => {
                bar.get_or_insert_with(begin).set_position((share * LENGTH as f64) as u64);
            }
            None => {
                bar.take().inspect(ProgressBar::finish_and_clear);
                timings.note(verb(phase));
            }
        }
    }
}

fn verb(phase: Phase) -> &'static str {
    match phase {
        Phase::Polish => "polishing",
        Phase::PolishForMaximum => "polishing for the maximum error",
        Phase::Integrate => "errors over the domain",
        Phase::Prove => "verdicts",
        Phase::ProveForMaximum => "verdicts for the maximum error",
    }
}
