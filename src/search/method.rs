//! The method: the settings of a search.

use serde::{Deserialize, Serialize};

/// The most that [`Method::islands`] may be.
pub const MAX_ISLANDS: usize = 256;

/// The settings of a search: with its problem, all that decides its course. The default is
/// the benchmarked one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Method {
    /// The seed of the random streams.
    pub seed: u64,
    /// The number of populations that evolve apart, 1 to [`MAX_ISLANDS`]; not that of threads.
    pub islands: usize,
    /// The candidates in a generation of an island with the whole cost budget, 1 to 1 000 000; an
    /// island with less has more, up to a hundred times as many.
    pub candidates: usize,
    /// The share of candidates that are random drafts rather than children, 0 to 1. At 1 the search
    /// is one by random restarts and fitting, for comparison.
    pub immigrants: f64,
    /// The most individuals in a bucket of an island with the whole cost budget, 1 to 1000.
    pub bucket_size: usize,
    /// The number of generations between migrations, at least 1.
    pub migration_interval: u64,
    /// The number of samples on which candidates race, at least 1; all samples if there are fewer.
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
    /// Checks the settings.
    ///
    /// # Errors
    /// The first field that is out of range.
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
