//! An island's population: the best few individuals at each cost, or of each family at each cost.

use super::loaded::{check_draft, not_negative};
use crate::op::Family;
use crate::program::{Draft, Shape};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use serde::{Deserialize, Serialize};
use std::ops::Range;

/// A fitted child, with the cost and the loss, on the racing subset, of the formula that it
/// becomes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Individual {
    pub draft: Draft,
    pub cost: f64,
    pub loss: f64,
    /// The formula's structural hash, constants ignored.
    pub hash: u64,
}

/// A bucket for each family and whole number of cycles, sorted by loss, structures distinct.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Population {
    /// The most cycles that an individual may cost.
    pub max_cost: f64,
    /// True if individuals compete within their family only.
    by_family: bool,
    /// The buckets, family after family, each by rising cost.
    buckets: Vec<Vec<Individual>>,
    bucket_size: usize,
}

/// The number of families.
const FAMILIES: usize = 8;

/// Returns a draft's family: a bit each for exponentials, roots and quotients. They are expensive:
/// at first `sqrt(1 - x)` errs more than a polynomial as cheap, and if both compete it is gone
/// before it has grown into anything better.
fn family(draft: &Draft) -> usize {
    draft.instrs.iter().fold(0, |family, instr| {
        family
            | match instr.op().family() {
                Family::Exponential => 1,
                Family::Root => 2,
                Family::Quotient => 4,
                Family::Arithmetic | Family::Trigonometric | Family::Choice => 0,
            }
    })
}

/// The largest ratio of a newcomer's loss to the least of cheaper individuals. By hand: a costlier
/// structure may become better when it is varied.
const SLACK: f64 = 1.5;

impl Population {
    pub fn new(max_cost: f64, by_family: bool, bucket_size: usize) -> Population {
        let families = if by_family { FAMILIES } else { 1 };
        let buckets = vec![Vec::new(); families * (max_cost as usize + 1)];
        Population { max_cost, by_family, buckets, bucket_size }
    }

    /// Checks that it can have evolved from a new one, by drafts of a shape.
    pub fn check(&self, new: &Population, shape: &Shape) -> Result<(), String> {
        let kind = |one: &Population| (one.max_cost, one.by_family, one.bucket_size);
        let full = self.buckets.iter().any(|bucket| bucket.len() > self.bucket_size);
        if kind(self) != kind(new) || self.buckets.len() != new.buckets.len() || full {
            return Err("its population does not match its settings".into());
        }
        for individual in self.individuals() {
            not_negative("cost", individual.cost)?;
            not_negative("loss", individual.loss)?;
            check_draft(&individual.draft, shape)?;
        }
        Ok(())
    }

    /// Returns the indices of the buckets of a draft's family up to its cost; its own is the last.
    fn up_to(&self, draft: &Draft, cost: f64) -> Range<usize> {
        let family = if self.by_family { family(draft) } else { 0 };
        let first = family * (self.max_cost as usize + 1);
        first..first + cost.min(self.max_cost) as usize + 1
    }

    /// Returns the loss that a newcomer at this cost must beat; 0, which none beats, if it costs
    /// too much.
    pub fn admission(&self, draft: &Draft, cost: f64) -> f64 {
        if cost > self.max_cost {
            return 0.0;
        }
        let Some((own, cheaper)) = self.buckets[self.up_to(draft, cost)].split_last() else {
            return 0.0;
        };
        let cheaper = cheaper.iter().filter_map(|bucket| bucket.first());
        let best = cheaper.map(|individual| individual.loss).fold(f64::INFINITY, f64::min);
        let worst = match own.get(self.bucket_size - 1) {
            Some(last) => last.loss,
            None => f64::INFINITY,
        };
        worst.min(best * SLACK)
    }

    /// Admits an individual that beats the admission, in place of one of the same structure unless
    /// that is better, else of the worst in a full bucket. Returns true if it was admitted.
    pub fn offer(&mut self, newcomer: Individual) -> bool {
        let admission = self.admission(&newcomer.draft, newcomer.cost);
        if newcomer.loss.is_nan() || newcomer.loss >= admission {
            return false;
        }
        let at = self.up_to(&newcomer.draft, newcomer.cost).end - 1;
        let bucket = &mut self.buckets[at];
        if let Some(same) = bucket.iter().position(|known| known.hash == newcomer.hash) {
            if bucket[same].loss <= newcomer.loss {
                return false;
            }
            bucket.remove(same);
        }
        let place = bucket.partition_point(|known| known.loss <= newcomer.loss);
        bucket.insert(place, newcomer);
        bucket.truncate(self.bucket_size);
        true
    }

    /// Changes losses, and drops those that are no longer finite. All others stay, also those that
    /// would not be admitted today: better ones may come of them.
    pub fn judge_anew(&mut self, mut judge: impl FnMut(&mut Individual)) {
        for bucket in &mut self.buckets {
            bucket.iter_mut().for_each(&mut judge);
            bucket.retain(|one| one.loss.is_finite());
            bucket.sort_by(|a, b| a.loss.total_cmp(&b.loss));
        }
    }

    /// Picks an individual: any occupied bucket with equal probability, and from it the better of
    /// two random individuals.
    pub fn pick(&self, rng: &mut ChaCha8Rng) -> Option<&Individual> {
        let occupied = self.buckets.iter().filter(|bucket| !bucket.is_empty()).count();
        if occupied == 0 {
            return None;
        }
        let chosen = rng.random_range(0..occupied);
        let bucket = self.buckets.iter().filter(|bucket| !bucket.is_empty()).nth(chosen)?;
        let [a, b] = [0; 2].map(|_: i32| rng.random_range(0..bucket.len()));
        bucket.get(a.min(b))
    }

    /// Returns all individuals, family after family, by rising cost.
    pub fn individuals(&self) -> impl Iterator<Item = &Individual> {
        self.buckets.iter().flatten()
    }

    /// Returns the best of each bucket.
    pub fn elites(&self) -> impl Iterator<Item = &Individual> {
        self.buckets.iter().filter_map(|bucket| bucket.first())
    }
}
