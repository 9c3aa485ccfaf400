//! The Pareto archive: the program of least loss at each cost, none dominated.

use crate::program::{Constants, Draft, structural_hash};
use serde::{Deserialize, Serialize};
use std::cmp::Ordering;

/// A program on the archive's axes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Member {
    /// Cycles, plus the grammar's penalties.
    pub cost: f64,
    /// The search's loss, finite in an archive.
    pub loss: f64,
    /// The formula, over the searched columns.
    pub draft: Draft,
}

impl Member {
    /// Returns the key that orders members of equal cost and loss, whichever came first.
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

/// Returns those that err less than all that cost no more, by rising cost. `place` gives cost and
/// error; of equals the first by `ties` stays.
pub(crate) fn undominated<T>(
    all: Vec<T>,
    place: impl Fn(&T) -> (f64, f64),
    ties: impl Fn(&T, &T) -> Ordering,
) -> Vec<T> {
    near_the_least(all, 1.0, place, ties)
}

/// As [`undominated`], but returns those that err less than `within` times the least error so far.
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

/// The largest ratio of the reference to a loss that counts, since losses may be zero. Chosen by
/// hand, unmeasured.
const MAX_GAIN: f64 = 1e30;

/// Members by rising cost and falling loss, whatever the order in which they were offered.
///
/// ```
/// use lgp::archive::{Archive, Member};
/// use lgp::program::{Names, parse};
///
/// let program = parse("y = x*x", &Names::new(["x"], ["y"]))?;
/// let member = |cost, loss| Member { cost, loss, draft: program.clone().into_draft() };
/// let mut archive = Archive::default();
/// assert!(archive.offer(member(2.0, 0.1)));
/// assert!(!archive.offer(member(3.0, 0.4)));
/// assert_eq!((archive.best_loss(4.0), archive.members().len()), (0.1, 1));
/// # Ok::<(), lgp::program::ParseError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Archive {
    members: Vec<Member>,
}

impl Archive {
    /// Returns the members by rising cost.
    pub fn members(&self) -> &[Member] {
        &self.members
    }

    /// Returns the least loss at no more than this cost; infinite if no member is that cheap.
    pub fn best_loss(&self, cost: f64) -> f64 {
        let affordable = self.members.partition_point(|member| member.cost <= cost);
        self.members[..affordable].last().map_or(f64::INFINITY, |member| member.loss)
    }

    /// Adds a member and removes those that it dominates, unless one dominates it or its loss is
    /// not finite. Returns true if it was added.
    pub fn offer(&mut self, member: Member) -> bool {
        if !member.loss.is_finite() || self.members.iter().any(|known| known.dominates(&member)) {
            return false;
        }
        self.members.retain(|known| !member.dominates(known));
        let at = self.members.partition_point(|known| known.cost < member.cost);
        self.members.insert(at, member);
        true
    }

    /// Offers all members of another archive.
    pub fn merge(&mut self, other: &Archive) {
        for member in &other.members {
            self.offer(member.clone());
        }
    }

    /// Returns the area between the front and the corner at `max_cost` and the loss `reference`,
    /// with losses on a natural logarithmic axis: larger is better. With the best constant's loss
    /// as `reference` it does not depend on the outputs' unit.
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
