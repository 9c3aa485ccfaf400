//! The search itself, as long as it may go on, and how it goes on a terminal.

use super::Common;
use crate::fit::Measure;
use crate::report::table::title;
use crate::search::{Budget, Problem, Search, Timetable, TracePoint};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::time::Duration;

/// At most, where nothing was said.
const USUAL_SECONDS: f64 = 60.0;

/// Between two looks at a generation that lasts long.
const PAUSE: Duration = Duration::from_secs(1);

/// The seconds that a run may take, if they are limited.
pub fn time_of(budget: &Budget) -> Option<f64> {
    budget.seconds.or(budget.generations.is_none().then_some(USUAL_SECONDS))
}

/// The share of the budget that is spent.
fn share(budget: &Budget, seconds: f64, generation: u64) -> f64 {
    match (time_of(budget), budget.generations) {
        (_, Some(n)) => generation as f64 / n.max(1) as f64,
        (Some(time), None) => seconds / time.max(1e-3),
        (None, None) => 0.0,
    }
}

/// Goes on with the search until its time is over, or its generations are done, or it is asked to stop; gives
/// the seconds of the whole run, `before` of which were spent before it was resumed.
pub fn evolve(
    budget: &Budget,
    common: &Common,
    search: &mut Search,
    problem: &Problem,
    before: f64,
    times: &mut Timetable,
    mut record: impl FnMut(TracePoint, &Search),
) -> f64 {
    let mut progress_made = (*budget == Budget::default()).then(Improvement::default);
    let bar = live_front(common);
    loop {
        let done = budget.generations.is_some_and(|n| search.generation() >= n);
        let deadline = times.search();
        if done || deadline.is_past() {
            break;
        }
        search.advance_until(problem, &deadline.pausing_in(PAUSE));
        let point = search.trace_point(problem, before + times.seconds());
        let share = share(budget, point.seconds, search.generation());
        show_progress(&bar, &point, search.settings().measure, share);
        let stalled = progress_made.as_mut().is_some_and(|improvement| improvement.stalled(&point));
        record(point, search);
        if stalled {
            break;
        }
        times.rehearse(search, problem);
    }
    bar.finish_and_clear();
    before + times.seconds()
}

/// When a search without a budget last became better.
#[derive(Default)]
struct Improvement {
    hypervolume: f64,
    seconds: f64,
}

impl Improvement {
    /// A hypervolume larger by this share is an improvement.
    const ENOUGH: f64 = 1e-3;

    /// Whether nothing has improved for long: ten seconds, and a third of the time.
    fn stalled(&mut self, point: &TracePoint) -> bool {
        if point.hypervolume > self.hypervolume * (1.0 + Improvement::ENOUGH) {
            *self = Improvement { hypervolume: point.hypervolume, seconds: point.seconds };
        }
        point.seconds - self.seconds > (point.seconds / 3.0).max(10.0)
    }
}

fn live_front(common: &Common) -> ProgressBar {
    if common.quiet || !std::io::stderr().is_terminal() {
        return ProgressBar::with_draw_target(None, ProgressDrawTarget::hidden());
    }
    let style = ProgressStyle::with_template("{msg}\n{wide_bar} {percent}%");
    ProgressBar::new(1000).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}

fn show_progress(bar: &ProgressBar, point: &TracePoint, measure: Measure, progress: f64) {
    if bar.is_hidden() {
        return;
    }
    let row = |label: &str, cells: Vec<String>| {
        let cells: String = cells.iter().map(|cell| format!("{cell:>9}")).collect();
        format!("{label:<7}{cells}")
    };
    let costs = crate::search::TRACE_COSTS.iter().map(|cost| format!("≤ {cost}")).collect();
    let errors = point.errors.iter().map(|error| format!("{error:.5}")).collect();
    bar.set_message(format!(
        "{:.0} s, {} candidates considered, {} fitted\n{}\n{}",
        point.seconds,
        point.counts.considered,
        point.counts.fitted,
        row("cycles", costs),
        row(title(measure), errors)
    ));
    bar.set_position((progress.min(1.0) * 1000.0) as u64);
}
