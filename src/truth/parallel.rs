//! Evaluations on all threads that end with the first failure.

use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Returns what `job` makes of every item, in order, on all of rayon's threads.
///
/// # Errors
/// The first failure in the items' order, whatever the number of threads. Items behind one that has
/// failed are left out: where every evaluation runs into a bound, that is seen once or twice, not
/// thousands of times.
pub(super) fn in_parallel<I: Sync, T: Send, E: Send>(
    items: &[I],
    job: impl Fn(&I) -> Result<T, E> + Sync,
) -> Result<Vec<T>, E> {
    let first_failure = AtomicUsize::new(usize::MAX);
    let done = |(place, item): (usize, &I)| {
        if place > first_failure.load(Ordering::Relaxed) {
            return None;
        }
        let result = job(item);
        if result.is_err() {
            first_failure.fetch_min(place, Ordering::Relaxed);
        }
        Some(result)
    };
    let results: Vec<Option<Result<T, E>>> =
        items.par_iter().enumerate().with_max_len(1).map(done).collect();
    // None is left out before the first failure.
    results.into_iter().flatten().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_follows_a_failure_is_left_out() {
        let items: Vec<usize> = (0..1000).collect();
        let tried = AtomicUsize::new(0);
        for threads in [1, 4] {
            tried.store(0, Ordering::Relaxed);
            let job = |&item: &usize| {
                tried.fetch_add(1, Ordering::Relaxed);
                if item >= 3 { Err(item) } else { Ok(item) }
            };
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            assert_eq!(pool.install(|| in_parallel(&items, job)), Err(3));
            assert!(tried.load(Ordering::Relaxed) < 200);
        }
        assert_eq!(in_parallel(&items, |&item| Ok::<_, ()>(item)), Ok(items.clone()));
    }
}
