//! A submission's receipt: has the device finished, and how long did it take?

use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, OnceLock};

use super::open::Gpu;
use crate::GpuError;
use crate::recorder::PassTiming;

/// What a recorder, its ticket and its readbacks know of one submission.
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

/// A submission's receipt.
#[derive(Clone)]
pub struct Ticket {
    pub(crate) gpu: Gpu,
    pub(crate) submission: Arc<Submission>,
}

impl Ticket {
    /// Waits until the device has finished.
    ///
    /// # Errors
    /// Device loss with the last pass reached.
    pub fn wait(&self) -> Result<(), GpuError> {
        self.gpu
            .inner
            .wait(self.submission.queue, self.submission.value())
    }

    /// Whether the device has finished; does not wait.
    ///
    /// # Errors
    /// Device loss with the last pass reached.
    pub fn is_done(&self) -> Result<bool, GpuError> {
        self.submission.is_done(&self.gpu)
    }

    /// Time of each pass in order, where they are timed, and last the whole submission under the
    /// label "total". Empty without `Options::timestamps`, or where the device
    /// has none.
    ///
    /// # Errors
    /// [`GpuError::NotDone`] before the device has finished.
    pub fn timings(&self) -> Result<Vec<PassTiming>, GpuError> {
        if !self.is_done()? {
            return Err(GpuError::NotDone);
        }
        self.gpu.inner.collect(self.submission.queue)?;
        Ok(self.submission.timings.get().cloned().unwrap_or_default())
    }
}

impl Submission {
    pub(crate) fn is_done(&self, gpu: &Gpu) -> Result<bool, GpuError> {
        let value = self.value();
        Ok(value != 0 && gpu.inner.reached(self.queue)? >= value)
    }
}
