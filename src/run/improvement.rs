//! The stopping rule of a search without a budget.

use super::TracePoint;

/// The last improvement of a search.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Improvement {
    hypervolume: f64,
    seconds: f64,
}

impl Improvement {
    /// The relative growth of the hypervolume that counts as an improvement. By hand, unmeasured.
    const ENOUGH: f64 = 1e-3;

    /// Compares from now on with what other samples have left of the hypervolume.
    pub fn compare_with(&mut self, hypervolume: f64) {
        self.hypervolume = hypervolume;
    }

    /// Returns true if nothing has improved for long: ten seconds, and a third of the time. Both by
    /// hand, unmeasured.
    pub fn stalled(&mut self, point: &TracePoint) -> bool {
        if point.hypervolume > self.hypervolume * (1.0 + Improvement::ENOUGH) {
            *self = Improvement { hypervolume: point.hypervolume, seconds: point.seconds };
        }
        point.seconds - self.seconds > (point.seconds / 3.0).max(10.0)
    }
}
