//! Several at a time.

use std::iter;
use std::panic::resume_unwind;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};
use std::thread;

use crate::failure::Failure;

/// What `work` makes of each item, in their order, on `jobs` threads. Once one has
/// failed, none is begun.
///
/// # Errors
/// The first failure in that order.
pub fn at_a_time<T: Sync, R: Send>(
    jobs: usize,
    items: &[T],
    work: impl Fn(&T) -> Result<R, Failure> + Sync,
) -> Result<Vec<R>, Failure> {
    let next = AtomicUsize::new(0);
    let take = || {
        let index = next.fetch_add(1, Relaxed);
        Some((index, items.get(index)?))
    };
    let on_thread = || -> Vec<(usize, Result<R, Failure>)> {
        let taken = iter::from_fn(take).map(|(index, item)| {
            let done = work(item);
            if done.is_err() {
                next.store(items.len(), Relaxed);
            }
            (index, done)
        });
        taken.collect()
    };
    let mut done: Vec<_> = thread::scope(|scope| {
        // More would find no item.
        let jobs = jobs.min(items.len());
        let threads: Vec<_> = (0..jobs.max(1)).map(|_| scope.spawn(on_thread)).collect();
        let done = threads.into_iter().map(thread::ScopedJoinHandle::join);
        done.flat_map(|done| done.unwrap_or_else(|panic| resume_unwind(panic)))
            .collect()
    });
    done.sort_by_key(|(index, _)| *index);
    done.into_iter().map(|(_, result)| result).collect()
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    /// A thread for each of the jobs that are asked for would be more than a machine has.
    #[test]
    fn no_more_threads_than_items() {
        let doubled = |items: &[u32]| at_a_time(usize::MAX, items, |item| Ok(2 * item)).unwrap();
        assert_eq!(doubled(&[1, 2, 3]), [2, 4, 6]);
        assert!(doubled(&[]).is_empty());
    }
}
