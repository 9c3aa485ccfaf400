//! How a search goes about its problem.

use serde::{Deserialize, Serialize};

/// The most that [`Method::islands`] may be.
pub const MAX_ISLANDS: usize = 256;

/// How a problem is searched: with the seed, all that decides the course of a search.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Method {
    /// Of the random streams.
    pub seed: u64,
    /// Populations that evolve apart; not the number of threads.
    pub islands: usize,
    /// Candidates that an island with the whole cost budget considers in a generation; one with less
    /// considers more, up to a hundred times as many.
    pub candidates: usize,
    /// The share of candidates that are random rather than children; all of them make it a search by
    /// random restarts and fitting, to compare with.
    pub immigrants: f64,
    /// Individuals that an island keeps at each cost.
    pub bucket_size: usize,
    /// Generations between migrations.
    pub migration_interval: u64,
    /// Samples on which candidates race; all of them where there are fewer.
    pub subset: usize,
}

impl Default for Method {
    fn default() -> Method {
        Method {
            seed: 1,
            islands: 8,
            candidates: 400,
            immigrants: 0.0,
            bucket_size: 3,
            migration_interval: 20,
            subset: 256,
        }
    }
}

impl Method {
    /// Whether a search can be made so.
    ///
    /// # Errors
    /// The first field that cannot be meant.
    pub fn check(&self) -> Result<(), String> {
        within("islands", self.islands, 1, MAX_ISLANDS)?;
        within("candidates", self.candidates, 1, 1_000_000)?;
        within("bucket_size", self.bucket_size, 1, 1000)?;
        within("subset", self.subset, 1, u32::MAX as usize)?;
        if self.migration_interval == 0 {
            return Err("`migration_interval` must be at least 1".into());
        }
        if !(0.0..=1.0).contains(&self.immigrants) {
            return Err(format!("`immigrants` is {}; it must be 0 to 1", self.immigrants));
        }
        Ok(())
    }
}

fn within(name: &str, number: usize, least: usize, most: usize) -> Result<(), String> {
    match (least..=most).contains(&number) {
        true => Ok(()),
        false => Err(format!("`{name}` is {number}; it must be {least} to {most}")),
    }
}
