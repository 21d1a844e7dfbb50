//! Work on all cores, in order.

use std::num::NonZero;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc;

/// Items that a thread takes at once: rays cost very different times.
const BATCH: usize = 64;

/// `make(0), …, make(count − 1)`, made on all cores.
pub fn map<T: Send>(count: usize, make: impl Fn(usize) -> T + Sync) -> Vec<T> {
    let threads = std::thread::available_parallelism().map_or(1, NonZero::get);
    let batches = count.div_ceil(BATCH);
    let next = AtomicUsize::new(0);
    let (sender, receiver) = mpsc::channel();
    let mut done: Vec<(usize, Vec<T>)> = std::thread::scope(|scope| {
        for _ in 0..threads.min(batches) {
            let (sender, next, make) = (sender.clone(), &next, &make);
            scope.spawn(move || {
                loop {
                    let batch = next.fetch_add(1, Ordering::Relaxed);
                    if batch >= batches {
                        break;
                    }
                    let range = batch * BATCH..((batch + 1) * BATCH).min(count);
                    if sender.send((batch, range.map(make).collect())).is_err() {
                        break;
                    }
                }
            });
        }
        drop(sender);
        receiver.iter().collect()
    });
    done.sort_by_key(|(batch, _)| *batch);
    done.into_iter().flat_map(|(_, items)| items).collect()
}
