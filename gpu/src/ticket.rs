//! A submission's receipt: has the device finished, and how long did it take?

use std::sync::Arc;

use crate::submission::Submission;
use crate::{Gpu, GpuError, PassTiming};

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
        self.gpu.inner.has_finished(&self.submission)
    }

    /// Time of each pass in order, where passes are timed, and last the whole submission under the label "total". Empty without
    /// `Options::timestamps`, or where the device has no timestamps.
    ///
    /// # Errors
    /// [`GpuError::NotDone`] before the device has finished.
    pub fn timings(&self) -> Result<Vec<PassTiming>, GpuError> {
        if !self.is_done()? {
            return Err(GpuError::NotDone);
        }
        self.gpu.inner.collect(self.submission.queue)?;
        // Another thread may be storing them now.
        Ok(self.submission.timings.wait().clone())
    }
}
