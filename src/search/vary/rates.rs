//! How often each kind of change is made: by how often it has paid.

use super::MOVES;
use crate::search::loaded::not_negative;
use serde::{Deserialize, Serialize};

/// How often each kind of change has led to a fit lately, and how often to an admission.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(in crate::search) struct Rates {
    fitted: [f64; MOVES.len()],
    admitted: [f64; MOVES.len()],
}

/// The share of what was known a generation ago that still counts. By hand.
const MEMORY: f64 = 0.9;

/// A kind that pays more often than the others is made more often, up to so many times. By hand: no kind may
/// crowd out the others.
const MAX_FAVOURED: f64 = 1.7;

/// Fits that are made up for each kind, so that nothing is concluded from a few. By hand.
const PRIOR: f64 = 50.0;

impl Rates {
    /// Notes what became of a child, given the kinds of change that made it.
    pub fn note(&mut self, made_by: u16, admitted: bool) {
        for kind in (0..MOVES.len()).filter(|kind| made_by >> kind & 1 == 1) {
            self.fitted[kind] += 1.0;
            self.admitted[kind] += f64::from(u8::from(admitted));
        }
    }

    /// Whether the counts are counts.
    pub fn check(&self) -> Result<(), String> {
        self.fitted.iter().chain(&self.admitted).try_for_each(|count| not_negative("rate", *count))
    }

    /// To be called after each generation.
    pub fn fade(&mut self) {
        self.fitted.iter_mut().chain(&mut self.admitted).for_each(|count| *count *= MEMORY);
    }

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
