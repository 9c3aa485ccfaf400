//! The division of a run's time between the search and what follows it. The shares were chosen by
//! hand; no other values were measured unless a line says so.

use crate::deadline::{Deadline, Stop};
use crate::search::{Rehearsal, Search};
use std::time::{Duration, Instant};

/// Seconds since a run began at which its phases end. At first nothing is known of how long
/// polishing and verdicts take; rehearsals tell.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Shares {
    total: f64,
    rehearsal: Rehearsal,
    /// Seconds to integrate errors over the domain.
    integration: f64,
    /// Seconds for files and pictures.
    writing: f64,
}

/// The share of the time for the first formulas.
const STARTING: f64 = 0.25;

/// The largest shares of the time for all that follows the search, for verdicts, for
/// the integration of errors, and for files.
const MAX_FINISHING: f64 = 0.5;
const MAX_JUDGING: f64 = 0.15;
const MAX_INTEGRATING: f64 = 0.08;
const MAX_WRITING: f64 = 0.25;

/// The share of the time for the front in maximum error; at most a second and so many times what
/// polishing takes, if that is known (8 on the DFG, 24 on a small table of nine inputs).
const SECOND_FRONT: f64 = 0.08;
const SECOND_TO_FIRST: f64 = 25.0;

/// Seconds for files and pictures: a second, and what a million rows take.
const WRITING: f64 = 1.0;
const WRITING_A_MILLION_ROWS: f64 = 1.0;

/// The shares of the time at which rehearsals are due, and the share that one may take.
const REHEARSALS: [f64; 3] = [0.1, 0.3, 0.6];
const A_REHEARSAL: f64 = 0.05;

impl Shares {
    fn judging_ends(&self) -> f64 {
        self.total - self.writing.min(MAX_WRITING * self.total)
    }

    /// Returns when verdicts of both fronts begin.
    fn integrating_ends(&self) -> f64 {
        self.judging_ends() - (2.0 * self.rehearsal.judge).min(MAX_JUDGING * self.total)
    }

    fn polishing_ends(&self) -> f64 {
        self.integrating_ends() - self.integration.min(MAX_INTEGRATING * self.total)
    }

    fn search_ends(&self) -> f64 {
        let known = Some(self.rehearsal.polish).filter(|polish| *polish > 0.0);
        let most = known.map_or(f64::INFINITY, |polish| 1.0 + SECOND_TO_FIRST * polish);
        let polishing = self.rehearsal.polish + (SECOND_FRONT * self.total).min(most);
        (self.polishing_ends() - polishing).max((1.0 - MAX_FINISHING) * self.total)
    }
}

/// The time that a run may take, if it is limited, and requests to stop.
#[derive(Clone, Debug)]
pub struct Timetable {
    start: Instant,
    shares: Option<Shares>,
    /// The number of rehearsals made.
    rehearsals: usize,
    stop: Stop,
    /// A request during the search ends the search; a later one ends the phase it meets.
    search: Deadline,
    finishing: Deadline,
}

impl Timetable {
    /// Plans a run that began at `start`, on a dataset of so many rows.
    pub fn new(start: Instant, total: Option<Duration>, rows: usize, stop: &Stop) -> Timetable {
        let shares = |total: Duration| Shares {
            total: total.as_secs_f64(),
            rehearsal: Rehearsal::default(),
            integration: 0.0,
            writing: WRITING + WRITING_A_MILLION_ROWS * rows as f64 * 1e-6,
        };
        Timetable {
            start,
            shares: total.map(shares),
            rehearsals: 0,
            stop: stop.clone(),
            search: Deadline::NEVER.or_request(stop),
            finishing: Deadline::NEVER.or_request(stop),
        }
    }

    /// Returns the seconds since the run began.
    pub fn seconds(&self) -> f64 {
        self.start.elapsed().as_secs_f64()
    }

    /// Keeps so many seconds for integrating errors over the domain.
    pub fn integrating_takes(&mut self, seconds: f64) {
        if let Some(shares) = &mut self.shares {
            shares.integration = seconds;
        }
    }

    /// Returns the deadline of the first formulas.
    pub fn starting(&self) -> Deadline {
        self.until(&self.search, |shares| STARTING * shares.total)
    }

    /// Returns the deadline of the search.
    pub fn search(&self) -> Deadline {
        self.until(&self.search, Shares::search_ends)
    }

    /// Measures, now and then, how long finishing will take.
    pub fn rehearse(&mut self, search: &Search) {
        let seconds = self.seconds();
        let Some(shares) = &mut self.shares else { return };
        let due = REHEARSALS.get(self.rehearsals).is_some_and(|due| seconds >= due * shares.total);
        if due {
            let most = Duration::from_secs_f64(A_REHEARSAL * shares.total);
            shares.rehearsal = Rehearsal::of(search, &self.search.within(most));
            self.rehearsals += 1;
        }
    }

    /// Ends the search: requests count anew, and if one was made, the rest takes no longer than was
    /// kept for it.
    pub fn begin_finishing(&mut self) {
        self.finishing = Deadline::NEVER.or_request(&self.stop);
        let seconds = self.seconds();
        if let Some(shares) = self.shares.as_mut().filter(|_| self.stop.requests() > 0) {
            shares.total = shares.total.min(seconds + shares.total - shares.search_ends());
        }
    }

    /// Returns the deadline of polishing, for either front.
    pub fn polishing(&self) -> Deadline {
        self.until(&self.finishing, Shares::polishing_ends)
    }

    /// Returns the deadline of the integration of errors.
    pub fn integrating(&self) -> Deadline {
        self.until(&self.finishing, Shares::integrating_ends)
    }

    /// Returns the deadline of verdicts.
    pub fn judging(&self) -> Deadline {
        self.until(&self.finishing, Shares::judging_ends)
    }

    /// Returns the deadline of pictures.
    pub fn writing(&self) -> Deadline {
        self.until(&self.finishing, |shares| shares.total)
    }

    fn until(&self, requests: &Deadline, seconds: impl Fn(&Shares) -> f64) -> Deadline {
        match &self.shares {
            Some(shares) => {
                let end = self.start + Duration::from_secs_f64(seconds(shares).max(0.0));
                requests.no_later_than(end)
            }
            None => requests.clone(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shares(total: f64, polish: f64, judge: f64) -> Shares {
        Shares { total, rehearsal: Rehearsal { polish, judge }, integration: 1.0, writing: 1.0 }
    }

    #[test]
    fn phases_follow_each_other_within_the_whole() {
        for total in [0.0, 0.1, 1.0, 10.0, 60.0, 3600.0] {
            for (polish, judge) in [(0.0, 0.0), (0.5, 2.0), (100.0, 0.0), (0.0, 1e6), (1e6, 1e6)] {
                let shares = shares(total, polish, judge);
                let ends = [
                    shares.search_ends(),
                    shares.polishing_ends(),
                    shares.integrating_ends(),
                    shares.judging_ends(),
                    total,
                ];
                assert!(ends.is_sorted(), "{shares:?}: {ends:?}");
                assert!(ends[0] >= 0.5 * total, "half of the time is the search's");
            }
        }
    }

    #[test]
    fn what_finishing_takes_is_kept_for_it() {
        let shares = shares(60.0, 3.0, 1.0);
        assert_eq!(shares.judging_ends(), 59.0);
        assert_eq!(shares.integrating_ends(), 57.0);
        assert_eq!(shares.polishing_ends(), 56.0);
        assert!((shares.search_ends() - (53.0 - SECOND_FRONT * 60.0)).abs() < 1e-9);
        let hour = super::tests::shares(3600.0, 1.0, 1.0);
        assert!(hour.search_ends() > 3560.0, "{}", hour.search_ends());
    }

    #[test]
    fn without_a_limit_requests_alone_end_a_phase() {
        let stop = Stop::default();
        let mut times = Timetable::new(Instant::now(), None, 1000, &stop);
        assert!(!times.search().is_past() && times.search().left().is_none());
        stop.request();
        assert!(times.search().is_past() && times.starting().is_past());
        times.begin_finishing();
        assert!(!times.polishing().is_past() && !times.judging().is_past());
        stop.request();
        assert!(times.polishing().is_past() && times.writing().is_past());
    }

    #[test]
    fn a_search_that_is_stopped_leaves_no_more_time_than_was_kept() {
        let stop = Stop::default();
        let mut times =
            Timetable::new(Instant::now(), Some(Duration::from_secs(1000)), 1000, &stop);
        assert!(times.search().left().is_some_and(|left| left > Duration::from_secs(800)));
        stop.request();
        times.begin_finishing();
        assert!(times.judging().left().is_some_and(|left| left < Duration::from_secs(100)));
    }
}
