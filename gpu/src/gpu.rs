//! An open device with its queues.

use std::ops::Deref;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use ash::vk;

use crate::GpuError;
use crate::device::{self, Core, DeviceInfo, Options, Provider};
use crate::queue::{QueueKind, Queues};
use crate::submission::Submission;

/// An open device; cheap to clone.
#[derive(Clone)]
pub struct Gpu {
    pub(crate) inner: Arc<Inner>,
}

pub(crate) struct Inner {
    pub(crate) queues: Queues,
    pub(crate) options: Options,
    pub(crate) core: Arc<Core>,
    /// Whether a call has returned that the device is lost.
    lost: AtomicBool,
}

/// Raw handles for a library that shares the device, such as the OpenXR
/// session or a panel's renderer. They live as long as the [`Gpu`].
#[derive(Clone, Copy, Debug)]
pub struct DeviceHandles {
    /// Instance.
    pub instance: vk::Instance,
    /// Physical device.
    pub physical: vk::PhysicalDevice,
    /// Device.
    pub device: vk::Device,
    /// Main queue; hold [`Gpu::with_queue`] while using it.
    pub queue: vk::Queue,
    /// Family of the main queue.
    pub family: u32,
    /// Index of the main queue in its family.
    pub queue_index: u32,
}

impl Deref for Gpu {
    type Target = Arc<Core>;

    fn deref(&self) -> &Arc<Core> {
        &self.inner.core
    }
}

impl Gpu {
    /// Opens a device through `provider`.
    ///
    /// # Errors
    /// A [`GpuError`] that names what is missing (loader, driver, device, feature, layer), with remedy.
    pub fn open(provider: &mut dyn Provider, options: &Options) -> Result<Self, GpuError> {
        let (core, plan) = device::open(provider, options)?;
        Ok(Self {
            inner: Arc::new(Inner {
                queues: Queues::new(&core, &plan)?,
                options: options.clone(),
                core,
                lost: AtomicBool::new(false),
            }),
        })
    }

    /// Properties of the device.
    pub fn info(&self) -> &DeviceInfo {
        &self.inner.core.info
    }

    /// Options with which it was opened.
    pub fn options(&self) -> &Options {
        &self.inner.options
    }

    /// Warnings and errors of the validation layer since the device was opened
    /// or they were last taken; always empty without `Options::validation`.
    pub fn validation_messages(&self) -> Vec<String> {
        self.inner.core.messages.list()
    }

    /// Returns the messages of [`Gpu::validation_messages`], and clears them.
    pub fn take_validation_messages(&self) -> Vec<String> {
        self.inner.core.messages.take()
    }

    /// Raw handles for a library that shares the device.
    pub fn handles(&self) -> DeviceHandles {
        let core = &self.inner.core;
        let main = self.inner.queues.get(QueueKind::Main);
        DeviceHandles {
            instance: core.instance.handle(),
            physical: core.physical,
            device: core.device.handle(),
            queue: main.handle,
            family: main.family,
            queue_index: main.index,
        }
    }

    /// Runs `f` while no one else uses the queue, for a library that submits
    /// to it on its own (an OpenXR runtime, a window's swapchain).
    pub fn with_queue<T>(&self, kind: QueueKind, f: impl FnOnce(vk::Queue) -> T) -> T {
        self.inner.queues.get(kind).with(f)
    }

    /// Label of the last pass that the device has reached in a submission whose
    /// end has not been seen yet; `None` without `Options::markers`.
    pub fn last_pass(&self) -> Option<String> {
        self.inner.last_pass()
    }

    /// Whether the device is lost: submitted work will not complete, and its resources are gone. Another device may be opened in its
    /// place.
    pub fn is_lost(&self) -> bool {
        self.inner.lost.load(Ordering::Relaxed)
    }

    /// From now on every submission and every wait fails as on a lost device. For tests: no driver loses a device on demand.
    ///
    /// A lost device executes nothing more, so this waits for submitted work: callers that get the error may destroy what the device used.
    pub fn lose(&self) {
        // A device that is lost already has no work in flight.
        let _ = self.wait_idle();
        self.inner.lost.store(true, Ordering::Relaxed);
    }

    /// Waits until every queue has finished.
    ///
    /// # Errors
    /// Device loss with the last pass reached.
    pub fn wait_idle(&self) -> Result<(), GpuError> {
        for (index, queue) in self.inner.queues.iter().enumerate() {
            self.inner.wait(index, queue.submitted())?;
        }
        Ok(())
    }
}

impl Inner {
    /// The last value that the queue's timeline has reached.
    fn reached(&self, index: usize) -> Result<u64, GpuError> {
        self.check()?;
        let timeline = self.queues.at(index).timeline;
        // SAFETY: the semaphore lives as long as the queues.
        unsafe { self.core.device.get_semaphore_counter_value(timeline) }
            .map_err(|result| self.error("vkGetSemaphoreCounterValue", result))
    }

    pub(crate) fn wait(&self, index: usize, value: u64) -> Result<(), GpuError> {
        self.check()?;
        let semaphores = [self.queues.at(index).timeline];
        let values = [value];
        let wait = vk::SemaphoreWaitInfo::default()
            .semaphores(&semaphores)
            .values(&values);
        // Traces each wait; a test checks by it that the frame loop never waits here.
        tracing::trace!(target: "vitriol_gpu::wait", queue = index, value, "waits for the device");
        // SAFETY: the semaphore lives as long as the queues. Without a limit:
        // a driver reports a device that hangs as lost.
        unsafe { self.core.device.wait_semaphores(&wait, u64::MAX) }
            .map_err(|result| self.error("vkWaitSemaphores", result))?;
        self.collect(index)
    }

    /// Whether the device has finished a submission.
    pub(crate) fn has_finished(&self, submission: &Submission) -> Result<bool, GpuError> {
        let value = submission.value();
        Ok(value != 0 && self.reached(submission.queue)? >= value)
    }

    /// Recycles finished submissions of a queue.
    pub(crate) fn collect(&self, index: usize) -> Result<(), GpuError> {
        let reached = self.reached(index)?;
        self.queues.at(index).recycle(reached)
    }

    /// Fails if the device is lost: once lost, it stays lost.
    pub(crate) fn check(&self) -> Result<(), GpuError> {
        if self.lost.load(Ordering::Relaxed) {
            return Err(self.error("", vk::Result::ERROR_DEVICE_LOST));
        }
        Ok(())
    }

    /// Turns a failed call into an error; a lost device names the last pass.
    pub(crate) fn error(&self, call: &'static str, result: vk::Result) -> GpuError {
        match result {
            vk::Result::ERROR_DEVICE_LOST => {
                self.lost.store(true, Ordering::Relaxed);
                GpuError::DeviceLost {
                    last_pass: self.last_pass(),
                }
            }
            vk::Result::ERROR_OUT_OF_DEVICE_MEMORY | vk::Result::ERROR_OUT_OF_HOST_MEMORY => {
                GpuError::OutOfMemory {
                    label: call.to_owned(),
                    bytes: None,
                    cause: result.to_string(),
                }
            }
            _ => GpuError::Vulkan { call, result },
        }
    }

    /// Label of the last pass that was reached, of the main queue first: the user sees what hangs there.
    fn last_pass(&self) -> Option<String> {
        self.queues.iter().find_map(|queue| queue.last_pass())
    }
}

impl Drop for Inner {
    fn drop(&mut self) {
        // SAFETY: no one else submits any more: the last `Gpu` is going. On a
        // lost device the call fails at once and everything counts as done.
        let _ = unsafe { self.core.device.device_wait_idle() };
        self.queues.destroy(&self.core);
    }
}
