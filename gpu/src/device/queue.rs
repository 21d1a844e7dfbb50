//! Queues: which ones are taken, submission, and the recycling of what the
//! device has finished with.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex};

use ash::vk;

use super::core::{Core, lock};
use super::open::{Gpu, Inner};
use super::provider::QueueRequest;
use super::ticket::Ticket;
use crate::GpuError;
use crate::recorder::{Recorder, Storage};

/// Which queue a recorder goes to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum QueueKind {
    /// Graphics and compute.
    Main,
    /// Compute beside it, where the device has a second queue
    /// (`DeviceInfo::second_queue`); else the main queue itself. No raster.
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

#[derive(Clone, Copy)]
struct Place {
    family: u32,
    index: u32,
    timestamp_mask: u64,
}

/// Which queues are taken.
pub(crate) struct QueuePlan {
    main: Place,
    /// `None`: the main queue serves as both.
    second: Option<Place>,
}

impl QueuePlan {
    pub(crate) fn is_double(&self) -> bool {
        self.second.is_some()
    }

    pub(crate) fn timestamps(&self) -> bool {
        self.places().all(|place| place.timestamp_mask != 0)
    }

    fn places(&self) -> impl Iterator<Item = Place> {
        std::iter::once(self.main).chain(self.second)
    }

    pub(crate) fn families(&self) -> Vec<u32> {
        let mut families: Vec<u32> = self.places().map(|place| place.family).collect();
        families.dedup();
        families
    }

    pub(crate) fn requests(&self) -> Vec<QueueRequest> {
        self.families()
            .into_iter()
            .map(|family| QueueRequest {
                family,
                count: self.places().filter(|p| p.family == family).count() as u32,
            })
            .collect()
    }
}

/// The main queue and, where there is one, a second.
pub(crate) struct Queues(Vec<Queue>);

impl Queues {
    /// A family with compute and without graphics is the best second queue: it
    /// is scheduled beside the main one. `None` where no family has both
    /// graphics and compute.
    pub(crate) fn plan(
        instance: &ash::Instance,
        physical: vk::PhysicalDevice,
    ) -> Option<QueuePlan> {
        // SAFETY: `physical` is a device of `instance`.
        let families = unsafe { instance.get_physical_device_queue_family_properties(physical) };
        let place = |family: usize, index: u32| Place {
            family: family as u32,
            index,
            timestamp_mask: match families[family].timestamp_valid_bits {
                0 => 0,
                bits => u64::MAX >> (64 - bits.min(64)),
            },
        };
        let both = vk::QueueFlags::GRAPHICS | vk::QueueFlags::COMPUTE;
        let main = families
            .iter()
            .position(|family| family.queue_flags.contains(both))?;
        let compute_only = families.iter().position(|family| {
            family.queue_flags.contains(vk::QueueFlags::COMPUTE)
                && !family.queue_flags.contains(vk::QueueFlags::GRAPHICS)
        });
        let second = match compute_only {
            Some(family) => Some(place(family, 0)),
            None if families[main].queue_count > 1 => Some(place(main, 1)),
            None => None,
        };
        Some(QueuePlan {
            main: place(main, 0),
            second,
        })
    }

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

    /// The device is idle: lets everything go.
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
}

impl Gpu {
    /// A recorder for one submission.
    ///
    /// # Errors
    /// Out of memory, or device loss.
    pub fn recorder(&self, kind: QueueKind) -> Result<Recorder, GpuError> {
        let index = self.inner.queues.index(kind);
        self.inner.collect(index)?;
        let recycled = lock(&self.inner.queues.at(index).state).free.pop();
        Recorder::begin(self, kind, recycled)
    }

    /// Submits what was recorded, after all that was submitted to its queue.
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
        let (index, storage) = rec.finish()?;
        let queue = self.inner.queues.at(index);
        let waits: Vec<_> = after
            .iter()
            // The queue's own order is kept by the opening barrier.
            .filter(|ticket| ticket.submission.queue != index)
            .map(|ticket| {
                vk::SemaphoreSubmitInfo::default()
                    .semaphore(self.inner.queues.at(ticket.submission.queue).timeline)
                    .value(ticket.submission.value())
                    .stage_mask(vk::PipelineStageFlags2::ALL_COMMANDS)
            })
            .collect();
        let mut state = lock(&queue.state);
        let value = state.submitted + 1;
        let signals = [vk::SemaphoreSubmitInfo::default()
            .semaphore(queue.timeline)
            .value(value)
            .stage_mask(vk::PipelineStageFlags2::ALL_COMMANDS)];
        let buffers = [vk::CommandBufferSubmitInfo::default().command_buffer(storage.cmd)];
        let submit = vk::SubmitInfo2::default()
            .wait_semaphore_infos(&waits)
            .command_buffer_infos(&buffers)
            .signal_semaphore_infos(&signals);
        let submission = storage.submission.clone();
        // SAFETY: the command buffer is complete, what it uses is held by
        // `storage` until the signal, and the queue is locked.
        let result = unsafe {
            self.inner
                .core
                .device
                .queue_submit2(queue.handle, &[submit], vk::Fence::null())
        };
        if let Err(result) = result {
            drop(state);
            return Err(self.inner.error("vkQueueSubmit2", result));
        }
        state.submitted = value;
        submission.submitted(value);
        state.in_flight.push_back((value, storage));
        drop(state);
        Ok(Ticket {
            gpu: self.clone(),
            submission,
        })
    }

    /// Runs `f` while no one else uses the queue, for a library that submits
    /// to it on its own (an OpenXR runtime, a window's swapchain).
    pub fn with_queue<T>(&self, kind: QueueKind, f: impl FnOnce(vk::Queue) -> T) -> T {
        let queue = self.inner.queues.get(kind);
        let _held = lock(&queue.state);
        f(queue.handle)
    }

    /// Label of the last pass that the device has reached in a submission whose
    /// end has not been seen yet; `None` without `Options::markers`.
    pub fn last_pass(&self) -> Option<String> {
        self.inner.last_pass()
    }

    /// Waits until every queue has finished.
    ///
    /// # Errors
    /// Device loss with the last pass reached.
    pub fn wait_idle(&self) -> Result<(), GpuError> {
        for index in 0..self.inner.queues.0.len() {
            let value = lock(&self.inner.queues.at(index).state).submitted;
            self.inner.wait(index, value)?;
        }
        Ok(())
    }
}

impl Inner {
    /// Last value that the queue's timeline has reached.
    pub(crate) fn reached(&self, index: usize) -> Result<u64, GpuError> {
        let timeline = self.queues.at(index).timeline;
        // SAFETY: the semaphore lives as long as the queues.
        unsafe { self.core.device.get_semaphore_counter_value(timeline) }
            .map_err(|result| self.error("vkGetSemaphoreCounterValue", result))
    }

    pub(crate) fn wait(&self, index: usize, value: u64) -> Result<(), GpuError> {
        let semaphores = [self.queues.at(index).timeline];
        let values = [value];
        let wait = vk::SemaphoreWaitInfo::default()
            .semaphores(&semaphores)
            .values(&values);
        // For who asks what holds a thread up; a test asks whether a frame loop is.
        tracing::trace!(target: "vitriol_gpu::wait", queue = index, value, "waits for the device");
        // SAFETY: the semaphore lives as long as the queues. Without a limit:
        // a driver reports a device that hangs as lost.
        unsafe { self.core.device.wait_semaphores(&wait, u64::MAX) }
            .map_err(|result| self.error("vkWaitSemaphores", result))?;
        self.collect(index)
    }

    /// Lets go of what finished submissions used, and keeps their memory for
    /// the next recorders.
    pub(crate) fn collect(&self, index: usize) -> Result<(), GpuError> {
        let reached = self.reached(index)?;
        let queue = self.queues.at(index);
        let mut state = lock(&queue.state);
        while let Some((value, mut storage)) = state.in_flight.pop_front() {
            if value > reached {
                state.in_flight.push_front((value, storage));
                break;
            }
            storage.recycle(queue.timestamp_mask)?;
            state.free.push(storage);
        }
        Ok(())
    }

    /// Turns a failed call into an error; a lost device names the last pass.
    pub(crate) fn error(&self, call: &'static str, result: vk::Result) -> GpuError {
        match result {
            vk::Result::ERROR_DEVICE_LOST => GpuError::DeviceLost {
                last_pass: self.last_pass(),
            },
            vk::Result::ERROR_OUT_OF_DEVICE_MEMORY | vk::Result::ERROR_OUT_OF_HOST_MEMORY => {
                GpuError::OutOfMemory {
                    label: call.to_owned(),
                    bytes: 0,
                    cause: result.to_string(),
                }
            }
            _ => GpuError::Vulkan { call, result },
        }
    }

    /// The main queue's first: what hangs there is what the user sees.
    fn last_pass(&self) -> Option<String> {
        self.queues.0.iter().find_map(|queue| {
            lock(&queue.state)
                .in_flight
                .iter()
                .rev()
                .find_map(|(_, storage)| storage.last_marked())
        })
    }
}
