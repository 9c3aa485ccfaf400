//! What follows a search: both fronts, and what is proved of them.

use super::Common;
use super::timings::Timings;
use crate::deadline::Deadline;
use crate::fit::Measure;
use crate::search::{Front, Problem, Search, Timetable, Work};

/// The front in the measure that was searched for, and in maximum error, as good as there is time for.
pub fn fronts(
    search: &Search,
    problem: &Problem,
    times: &mut Timetable,
    timings: &mut Timings,
    common: &Common,
) -> (Front, Front) {
    times.begin_finishing();
    let mut front = with_progress(common, "polishing", times.polishing(), |work| {
        Front::polished(search, problem, work)
    });
    timings.note("polishing");
    let mut minimax =
        with_progress(common, "polishing for the maximum error", times.polishing(), |work| {
            Front::polished_in(search, problem, Measure::Max, &front, work)
        });
    timings.note("polishing for the maximum error");
    let (questions, names) = (problem.questions(), problem.dataset.names());
    let is_one = front.measure == minimax.measure;
    with_progress(common, "proving", times.judging(), |work| {
        front.judge_until(&questions, &names, &|| work.deadline.is_past());
    });
    if is_one {
        minimax.clone_from(&front);
    } else {
        with_progress(common, "proving for the maximum error", times.judging(), |work| {
            minimax.judge_until(&questions, &names, &|| work.deadline.is_past());
        });
    }
    timings.note("verdicts");
    (front, minimax)
}

fn with_progress<T>(
    common: &Common,
    verb: &'static str,
    deadline: Deadline,
    job: impl FnOnce(&Work) -> T,
) -> T {
    const LENGTH: u64 = 1000;
    let bar = common.progress(verb);
    bar.set_length(LENGTH);
    let progress = |share: f64| bar.set_position((share * LENGTH as f64) as u64);
    let done = job(&Work { deadline, progress: &progress });
    bar.finish_and_clear();
    done
}
