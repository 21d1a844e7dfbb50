//! The device's queues: submission, and the recycling of finished submissions.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex};

use ash::vk;

use crate::GpuError;
use crate::device::{Core, Place, QueuePlan, lock_queue};
use crate::submission::Storage;

/// Which queue a recorder goes to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum QueueKind {
    /// Graphics and compute.
    Main,
    /// Compute beside it, where the device has a second queue; else the main
    /// queue itself. No raster.
    Async,
}

/// One queue with its timeline.
pub(crate) struct Queue {
    pub(crate) handle: vk::Queue,
    pub(crate) family: u32,
    pub(crate) index: u32,
    /// Valid bits of a timestamp.
    pub(crate) timestamp_mask: u64,
    pub(crate) timeline: vk::Semaphore,
    /// Also the lock under which `handle` is used.
    state: Mutex<QueueState>,
}

#[derive(Default)]
struct QueueState {
    /// Value of the last submission.
    submitted: u64,
    in_flight: VecDeque<(u64, Box<Storage>)>,
    #[expect(
        clippy::vec_box,
        reason = "it goes to a recorder and comes back without a copy"
    )]
    free: Vec<Box<Storage>>,
}

/// The main queue and, where there is one, a second.
pub(crate) struct Queues(Vec<Queue>);

impl Queues {
    pub(crate) fn new(core: &Arc<Core>, plan: &QueuePlan) -> Result<Self, GpuError> {
        let mut queues = Self(Vec::new());
        for place in plan.places() {
            match Queue::new(core, place) {
                Ok(queue) => queues.0.push(queue),
                Err(error) => {
                    queues.destroy(core);
                    return Err(error);
                }
            }
        }
        Ok(queues)
    }

    /// Index of the queue that serves `kind`.
    pub(crate) fn index(&self, kind: QueueKind) -> usize {
        match kind {
            QueueKind::Main => 0,
            QueueKind::Async => self.0.len() - 1,
        }
    }

    pub(crate) fn get(&self, kind: QueueKind) -> &Queue {
        &self.0[self.index(kind)]
    }

    pub(crate) fn at(&self, index: usize) -> &Queue {
        &self.0[index]
    }

    pub(crate) fn iter(&self) -> impl Iterator<Item = &Queue> {
        self.0.iter()
    }

    /// Frees everything; the device must be idle.
    pub(crate) fn destroy(&mut self, core: &Core) {
        for queue in self.0.drain(..) {
            drop(queue.state);
            // SAFETY: nothing is pending on the semaphore any more.
            unsafe { core.device.destroy_semaphore(queue.timeline, None) };
        }
    }
}

impl Queue {
    fn new(core: &Core, place: Place) -> Result<Self, GpuError> {
        let mut kind = vk::SemaphoreTypeCreateInfo::default()
            .semaphore_type(vk::SemaphoreType::TIMELINE)
            .initial_value(0);
        let create = vk::SemaphoreCreateInfo::default().push_next(&mut kind);
        // SAFETY: the device is alive and has timeline semaphores.
        let timeline = unsafe { core.device.create_semaphore(&create, None) }
            .map_err(GpuError::vulkan("vkCreateSemaphore"))?;
        Ok(Self {
            // SAFETY: the device was made with this queue.
            handle: unsafe { core.device.get_device_queue(place.family, place.index) },
            family: place.family,
            index: place.index,
            timestamp_mask: place.timestamp_mask,
            timeline,
            state: Mutex::default(),
        })
    }

    /// Storage of a finished submission, for the next one.
    pub(crate) fn recycled(&self) -> Option<Box<Storage>> {
        lock_queue(&self.state).free.pop()
    }

    /// Submits the recorded commands, after `waits`, and holds what they use until the device has finished.
    pub(crate) fn submit(
        &self,
        storage: Box<Storage>,
        waits: &[vk::SemaphoreSubmitInfo<'_>],
    ) -> Result<(), vk::Result> {
        let mut state = lock_queue(&self.state);
        let value = state.submitted + 1;
        let signals = [vk::SemaphoreSubmitInfo::default()
            .semaphore(self.timeline)
            .value(value)
            .stage_mask(vk::PipelineStageFlags2::ALL_COMMANDS)];
        let buffers = [vk::CommandBufferSubmitInfo::default().command_buffer(storage.cmd)];
        let submit = vk::SubmitInfo2::default()
            .wait_semaphore_infos(waits)
            .command_buffer_infos(&buffers)
            .signal_semaphore_infos(&signals);
        // SAFETY: the command buffer is complete, what it uses is held by
        // `storage` until the signal, and the queue is locked.
        unsafe {
            let device = &storage.core.device;
            device.queue_submit2(self.handle, &[submit], vk::Fence::null())?;
        }
        state.submitted = value;
        storage.submission.submitted(value);
        state.in_flight.push_back((value, storage));
        Ok(())
    }

    /// Value of the last submission.
    pub(crate) fn submitted(&self) -> u64 {
        lock_queue(&self.state).submitted
    }

    /// Releases the resources of submissions up to the timeline's value `reached`, and keeps their storage for the next ones.
    pub(crate) fn recycle(&self, reached: u64) -> Result<(), GpuError> {
        // Each while the queue is free: other threads may wait for its times, and the resources may be the last of a scene's pipelines and
        // buffers, which a driver destroys in tens of milliseconds.
        let mut result = Ok(());
        for mut storage in self.finished(reached) {
            match storage.recycle(self.timestamp_mask) {
                Ok(()) => lock_queue(&self.state).free.push(storage),
                Err(error) => result = Err(error),
            }
        }
        result
    }

    /// Takes out the storages of submissions up to the timeline's value `reached`.
    #[expect(clippy::vec_box, reason = "as for those that are free")]
    fn finished(&self, reached: u64) -> Vec<Box<Storage>> {
        let mut state = lock_queue(&self.state);
        let of = state
            .in_flight
            .partition_point(|(value, _)| *value <= reached);
        let finished = state.in_flight.drain(..of);
        finished.map(|(_, storage)| storage).collect()
    }

    /// Label of the last pass that the device has reached in submissions in flight.
    pub(crate) fn last_pass(&self) -> Option<String> {
        let state = lock_queue(&self.state);
        let mut latest_first = state.in_flight.iter().rev();
        latest_first.find_map(|(_, storage)| storage.last_marked())
    }

    /// Runs `f` while no one else uses the queue.
    pub(crate) fn with<T>(&self, f: impl FnOnce(vk::Queue) -> T) -> T {
        let _held = lock_queue(&self.state);
        f(self.handle)
    }
}
