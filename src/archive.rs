//! The Pareto archive: for each cost the program of least error, none dominated.

use crate::program::{Constants, Draft, structural_hash};
use serde::{Deserialize, Serialize};
use std::cmp::Ordering;

/// A program on the archive's axes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Member {
    /// Cycles, and penalties if the grammar has any.
    pub cost: f64,
    /// The search's loss; finite.
    pub loss: f64,
    /// The formula, over the searched columns.
    pub draft: Draft,
}

impl Member {
    /// What decides between members of equal cost and loss, so that it does not matter which came
    /// first.
    fn tie_break(&self) -> (usize, u64) {
        let hash = structural_hash(&self.draft, Constants::Exact, &mut Vec::new());
        (self.draft.instrs.len(), hash)
    }

    fn dominates(&self, other: &Member) -> bool {
        self.cost <= other.cost
            && self.loss <= other.loss
            && (self.cost < other.cost
                || self.loss < other.loss
                || self.tie_break() <= other.tie_break())
    }
}

/// By rising cost, those that err less than every one that costs no more, of equals the first by `ties`; `place` gives
/// cost and error.
pub(crate) fn undominated<T>(
    all: Vec<T>,
    place: impl Fn(&T) -> (f64, f64),
    ties: impl Fn(&T, &T) -> Ordering,
) -> Vec<T> {
    near_the_least(all, 1.0, place, ties)
}

/// The same of those that err less than `within` times as much.
pub(crate) fn near_the_least<T>(
    mut all: Vec<T>,
    within: f64,
    place: impl Fn(&T) -> (f64, f64),
    ties: impl Fn(&T, &T) -> Ordering,
) -> Vec<T> {
    all.sort_by(|a, b| {
        let ((cost, error), (other_cost, other_error)) = (place(a), place(b));
        cost.total_cmp(&other_cost).then(error.total_cmp(&other_error)).then_with(|| ties(a, b))
    });
    let mut least = f64::INFINITY;
    all.retain(|one| {
        let (_, error) = place(one);
        let near = error < least * within;
        least = least.min(error);
        near
    });
    all
}

/// A loss smaller than the reference by more than this counts as zero.
const MAX_GAIN: f64 = 1e30;

/// Members by rising cost, their losses falling. What is offered may come in any order.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Archive {
    members: Vec<Member>,
}

impl Archive {
    /// Returns the members by rising cost.
    pub fn members(&self) -> &[Member] {
        &self.members
    }

    /// The least loss at no more than this cost; infinite where there is none.
    pub fn best_loss(&self, cost: f64) -> f64 {
        let affordable = self.members.partition_point(|member| member.cost <= cost);
        self.members[..affordable].last().map_or(f64::INFINITY, |member| member.loss)
    }

    /// Takes a member in unless one dominates it, and drops those that it dominates. Says whether
    /// it is in.
    pub fn offer(&mut self, member: Member) -> bool {
        if !member.loss.is_finite() || self.members.iter().any(|known| known.dominates(&member)) {
            return false;
        }
        self.members.retain(|known| !member.dominates(known));
        let at = self.members.partition_point(|known| known.cost < member.cost);
        self.members.insert(at, member);
        true
    }

    /// Takes in all that another archive holds.
    pub fn merge(&mut self, other: &Archive) {
        for member in &other.members {
            self.offer(member.clone());
        }
    }

    /// The area between the front and (`max_cost`, `reference`), a loss, errors on a logarithmic axis: a larger
    /// one is better. With the best constant's loss for `reference` it does not depend on any unit.
    pub fn hypervolume(&self, max_cost: f64, reference: f64) -> f64 {
        let ends = self.members.iter().skip(1).map(|member| member.cost).chain([max_cost]);
        self.members
            .iter()
            .zip(ends)
            .filter(|(member, _)| member.loss < reference && member.cost < max_cost)
            .map(|(member, end)| {
                (end.min(max_cost) - member.cost) * (reference / member.loss).min(MAX_GAIN).ln()
            })
            .sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::program::Arg;

    fn member(cost: f64, loss: f64) -> Member {
        let draft = Draft {
            inputs: 0,
            consts: vec![loss as f32],
            outputs: vec![Arg::Const(0)],
            instrs: vec![],
        };
        Member { cost, loss, draft }
    }

    #[test]
    fn holds_the_non_dominated_members_in_any_order_of_arrival() {
        let offered = [(3.0, 0.5), (1.0, 0.9), (2.0, 0.95), (3.0, 0.4), (2.5, 0.6), (9.0, 0.4)];
        let mut forwards = Archive::default();
        let mut backwards = Archive::default();
        for &(cost, loss) in &offered {
            forwards.offer(member(cost, loss));
        }
        for &(cost, loss) in offered.iter().rev() {
            backwards.offer(member(cost, loss));
        }
        let costs: Vec<f64> = forwards.members().iter().map(|m| m.cost).collect();
        assert_eq!(costs, [1.0, 2.5, 3.0]);
        assert_eq!(forwards, backwards);
        assert_eq!(forwards.best_loss(2.9), 0.6);
        assert_eq!(forwards.best_loss(0.5), f64::INFINITY);
        assert!(!forwards.offer(member(1.0, f64::NAN)));
    }

    #[test]
    fn merging_is_commutative_and_idempotent() {
        let [mut a, mut b] = [Archive::default(), Archive::default()];
        for (cost, loss) in [(1.0, 0.9), (4.0, 0.2)] {
            a.offer(member(cost, loss));
        }
        for (cost, loss) in [(1.0, 0.8), (5.0, 0.1), (6.0, 0.3)] {
            b.offer(member(cost, loss));
        }
        let (mut ab, mut ba) = (a.clone(), b.clone());
        ab.merge(&b);
        ba.merge(&a);
        assert_eq!(ab, ba);
        let once = ab.clone();
        ab.merge(&once);
        assert_eq!(ab, once);
    }

    #[test]
    fn hypervolume_grows_with_better_members() {
        let mut archive = Archive::default();
        archive.offer(member(2.0, 0.1));
        assert!((archive.hypervolume(10.0, 1.0) - 8.0 * 10f64.ln()).abs() < 1e-9);
        let before = archive.hypervolume(10.0, 1.0);
        archive.offer(member(5.0, 0.01));
        assert!(archive.hypervolume(10.0, 1.0) > before);
    }
}
