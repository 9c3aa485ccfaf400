//! The rates at which the kinds of change are made, by their success.

use super::MOVES;
use crate::search::loaded::not_negative;
use serde::{Deserialize, Serialize};

/// The recent fits of each kind of change, and the admissions that came of them.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(in crate::search) struct Rates {
    fitted: [f64; MOVES.len()],
    admitted: [f64; MOVES.len()],
}

/// The share of the counts that outlasts a generation. By hand.
const MEMORY: f64 = 0.9;

/// The largest factor by which success raises a kind's rate, or failure lowers it: no kind may
/// crowd out the others. By hand.
const MAX_FAVOURED: f64 = 1.7;

/// The number of fits of average success presumed of each kind, lest a few decide. By hand.
const PRIOR: f64 = 50.0;

impl Rates {
    /// Counts a fitted child for each kind of change that made it, a bit each in `made_by`.
    pub fn note(&mut self, made_by: u16, admitted: bool) {
        for kind in (0..MOVES.len()).filter(|kind| made_by >> kind & 1 == 1) {
            self.fitted[kind] += 1.0;
            self.admitted[kind] += f64::from(u8::from(admitted));
        }
    }

    /// Checks that no count is negative or infinite.
    pub fn check(&self) -> Result<(), String> {
        self.fitted.iter().chain(&self.admitted).try_for_each(|count| not_negative("rate", *count))
    }

    /// Fades the counts, once in a generation.
    pub fn fade(&mut self) {
        self.fitted.iter_mut().chain(&mut self.admitted).for_each(|count| *count *= MEMORY);
    }

    /// Returns the relative rate of each kind.
    pub(super) fn weights(&self) -> [f64; MOVES.len()] {
        let sum = |counts: &[f64]| counts.iter().sum::<f64>();
        let usual = (sum(&self.admitted) + 1.0) / (sum(&self.fitted) + 1.0);
        std::array::from_fn(|kind| {
            let pays = (self.admitted[kind] + PRIOR * usual) / (self.fitted[kind] + PRIOR);
            MOVES[kind].1 * (pays / usual).clamp(1.0 / MAX_FAVOURED, MAX_FAVOURED)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_pays_is_made_more_often_within_bounds() {
        let mut rates = Rates::default();
        assert_eq!(rates.weights(), MOVES.map(|(_, rate)| rate));
        for _ in 0..10_000 {
            rates.note(1, true);
            rates.note(2, false);
        }
        let share = |rates: &Rates, kind: usize| rates.weights()[kind] / MOVES[kind].1;
        assert!((share(&rates, 0) - MAX_FAVOURED).abs() < 1e-9);
        assert!((share(&rates, 1) - 1.0 / MAX_FAVOURED).abs() < 1e-9);
        assert!((share(&rates, 2) - 1.0).abs() < 1e-3);
        (0..200).for_each(|_| rates.fade());
        assert!((share(&rates, 0) - 1.0).abs() < 1e-3);
    }
}
