//! Ends work before it is done: at a moment, or on request.
//!
//! Long computations ask [`Deadline::is_past`] between their steps, and return what they have.
//! Without a moment or a request nothing is cut, and results depend on no clock.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

/// Requests to stop, from a signal's handler or another thread. Clones share them.
#[derive(Clone, Debug, Default)]
pub struct Stop(Arc<AtomicUsize>);

impl Stop {
    /// Requests a stop, and returns how many requests there are now.
    pub fn request(&self) -> usize {
        self.0.fetch_add(1, Ordering::Relaxed) + 1
    }

    /// Returns the number of requests so far.
    pub fn requests(&self) -> usize {
        self.0.load(Ordering::Relaxed)
    }
}

/// The earlier of a moment and a request to stop, if either is set.
#[derive(Clone, Debug, Default)]
pub struct Deadline {
    moment: Option<Instant>,
    /// A counter, and its value when this was made: only later requests count.
    stop: Option<(Stop, usize)>,
    pause: Option<Instant>,
}

impl Deadline {
    /// Never past.
    pub const NEVER: Deadline = Deadline { moment: None, stop: None, pause: None };

    /// Also ends with the next request from now on.
    pub fn or_request(self, stop: &Stop) -> Deadline {
        Deadline { stop: Some((stop.clone(), stop.requests())), ..self }
    }

    /// Also ends `time` from now.
    pub fn within(&self, time: Duration) -> Deadline {
        self.no_later_than(Instant::now() + time)
    }

    /// Also ends at `moment`.
    pub fn no_later_than(&self, moment: Instant) -> Deadline {
        Deadline { moment: Some(self.moment.map_or(moment, |own| own.min(moment))), ..self.clone() }
    }

    /// Also pauses `time` from now: work that can be continued later stops then, as on a request.
    pub fn pausing_in(&self, time: Duration) -> Deadline {
        let pause = Instant::now() + time;
        Deadline { pause: Some(self.pause.map_or(pause, |own| own.min(pause))), ..self.clone() }
    }

    /// Returns the moment alone, for work that cannot be continued later: pauses and requests do
    /// not cut it.
    pub fn moment_alone(&self) -> Deadline {
        Deadline { moment: self.moment, ..Deadline::NEVER }
    }

    /// Returns true once the moment, the pause or a new request has come.
    pub fn is_past(&self) -> bool {
        self.stop.as_ref().is_some_and(|(stop, known)| stop.requests() > *known)
            || [self.moment, self.pause].iter().flatten().any(|moment| Instant::now() >= *moment)
    }

    /// Returns the time left until the moment, if there is one.
    pub fn left(&self) -> Option<Duration> {
        self.moment.map(|moment| moment.saturating_duration_since(Instant::now()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_moment_or_a_new_request_ends_it() {
        let hour = Duration::from_secs(3600);
        let stop = Stop::default();
        assert!(!Deadline::NEVER.is_past());
        assert!(Deadline::NEVER.within(Duration::ZERO).is_past());
        let later = Deadline::NEVER.within(hour).or_request(&stop);
        assert!(!later.is_past() && later.left().is_some_and(|left| left <= hour));
        stop.request();
        assert!(later.is_past() && !later.moment_alone().is_past());
        // Earlier requests no longer count.
        let next = Deadline::NEVER.or_request(&stop);
        assert!(!next.is_past() && next.left().is_none());
        stop.request();
        assert!(next.is_past() && next.within(hour).is_past());
        let pausing = Deadline::NEVER.pausing_in(Duration::ZERO);
        assert!(pausing.is_past() && !pausing.moment_alone().is_past());
    }
}
