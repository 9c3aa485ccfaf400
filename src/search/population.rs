//! An island's population: the best few individuals at each cost.

use crate::program::Draft;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use serde::{Deserialize, Serialize};

/// A fitted draft, its loss on the racing subset.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Individual {
    pub draft: Draft,
    pub cost: f64,
    pub loss: f64,
    /// Structural, constants ignored.
    pub hash: u64,
}

/// A bucket for each whole number of cycles, sorted by loss, structures distinct.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Population {
    /// Cycles that an individual may cost at most.
    pub max_cost: f64,
    buckets: Vec<Vec<Individual>>,
    bucket_size: usize,
}

/// How much worse than a cheaper individual one may be and still be let in.
const SLACK: f64 = 1.5;

impl Population {
    pub fn new(max_cost: f64, bucket_size: usize) -> Population {
        Population { max_cost, buckets: vec![Vec::new(); max_cost as usize + 1], bucket_size }
    }

    fn bucket_of(&self, cost: f64) -> usize {
        (cost as usize).min(self.buckets.len() - 1)
    }

    /// The loss that a newcomer at this cost must beat; none does that costs too much.
    pub fn admission(&self, cost: f64) -> f64 {
        if cost > self.max_cost {
            return 0.0;
        }
        let bucket = self.bucket_of(cost);
        let cheaper = self.buckets[..bucket].iter().filter_map(|b| b.first());
        let best = cheaper.map(|individual| individual.loss).fold(f64::INFINITY, f64::min);
        let worst = match self.buckets[bucket].get(self.bucket_size - 1) {
            Some(last) => last.loss,
            None => f64::INFINITY,
        };
        worst.min(best * SLACK)
    }

    /// Takes an individual in if it beats the admission, in place of one of the same structure if
    /// there is one, else of the worst. Says whether it is in.
    pub fn offer(&mut self, newcomer: Individual) -> bool {
        if newcomer.loss.is_nan() || newcomer.loss >= self.admission(newcomer.cost) {
            return false;
        }
        let at = self.bucket_of(newcomer.cost);
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

    /// A bucket that is not empty, each as likely; of its individuals the better ones more.
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

    /// By rising cost.
    pub fn individuals(&self) -> impl Iterator<Item = &Individual> {
        self.buckets.iter().flatten()
    }

    /// The best of each bucket.
    pub fn elites(&self) -> impl Iterator<Item = &Individual> {
        self.buckets.iter().filter_map(|bucket| bucket.first())
    }
}
