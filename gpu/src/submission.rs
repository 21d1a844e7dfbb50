//! The host's data of one submission.

mod arena;
mod encode;
mod storage;
mod timing;

use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, OnceLock};

pub(crate) use storage::{DrawCommand, Storage};
pub use timing::PassTiming;

/// State of one submission that its recorder, ticket and readbacks share.
pub(crate) struct Submission {
    /// Index of the queue.
    pub(crate) queue: usize,
    /// Value on the queue's timeline; 0 before submission.
    value: AtomicU64,
    pub(crate) timings: OnceLock<Vec<PassTiming>>,
}

impl Submission {
    pub(crate) fn new(queue: usize) -> Arc<Self> {
        Arc::new(Self {
            queue,
            value: AtomicU64::new(0),
            timings: OnceLock::new(),
        })
    }

    pub(crate) fn value(&self) -> u64 {
        self.value.load(Ordering::Acquire)
    }

    pub(crate) fn submitted(&self, value: u64) {
        self.value.store(value, Ordering::Release);
    }
}
