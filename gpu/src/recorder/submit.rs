//! Creation and submission of recorders.

use ash::vk;

use super::Recorder;
use crate::submission::{Storage, Submission};
use crate::{Gpu, GpuError, QueueKind, Ticket};

impl Gpu {
    /// A recorder for one submission.
    ///
    /// # Errors
    /// Out of memory, or device loss.
    pub fn recorder(&self, kind: QueueKind) -> Result<Recorder, GpuError> {
        let inner = &self.inner;
        let index = inner.queues.index(kind);
        let queue = inner.queues.at(index);
        let mut storage = match queue.recycled() {
            Some(storage) => storage,
            // Only then: a frame that has recycled storage does not spend time on destroying others' resources.
            None => {
                inner.collect(index)?;
                let finished = queue.recycled();
                finished.map_or_else(
                    || Storage::new(&inner.core, queue.family, &inner.options).map(Box::new),
                    Ok,
                )?
            }
        };
        storage.begin(Submission::new(index))?;
        Ok(Recorder {
            gpu: self.clone(),
            queue: index,
            graphics: kind == QueueKind::Main,
            storage,
        })
    }

    /// Submits the recorded commands, after all that were submitted to its queue.
    ///
    /// # Errors
    /// Out of memory, or device loss with the last pass reached.
    pub fn submit(&self, rec: Recorder) -> Result<Ticket, GpuError> {
        self.submit_after(rec, &[])
    }

    /// As [`Gpu::submit`], and not before the submissions of `after`, which may
    /// be of the other queue.
    ///
    /// # Errors
    /// As [`Gpu::submit`].
    pub fn submit_after(&self, rec: Recorder, after: &[&Ticket]) -> Result<Ticket, GpuError> {
        self.inner.check()?;
        let (index, mut storage) = (rec.queue, rec.storage);
        storage.end()?;
        let queues = &self.inner.queues;
        let waits: Vec<_> = after
            .iter()
            // The queue's own order is kept by the opening barrier.
            .filter(|ticket| ticket.submission.queue != index)
            .map(|ticket| {
                vk::SemaphoreSubmitInfo::default()
                    .semaphore(queues.at(ticket.submission.queue).timeline)
                    .value(ticket.submission.value())
                    .stage_mask(vk::PipelineStageFlags2::ALL_COMMANDS)
            })
            .collect();
        let submission = storage.submission.clone();
        queues
            .at(index)
            .submit(storage, &waits)
            .map_err(|result| self.inner.error("vkQueueSubmit2", result))?;
        Ok(Ticket {
            gpu: self.clone(),
            submission,
        })
    }
}
