//! Passes that are recorded once and executed in many submissions.

use std::sync::{Arc, Mutex};

use ash::vk;

use super::Recorder;
use crate::barrier::Scope;
use crate::submission::{Storage, Submission};
use crate::{Buffer, GpuError};

/// Compute passes, fills, copies and uploads in a secondary command buffer. A submission that executes it is the same to the device as one
/// that records them again, and the host spends next to nothing. Cheap to clone.
///
/// Its immediates and uploads stay as recorded; data that change go to buffers before it.
#[derive(Clone)]
pub struct Bundle {
    inner: Arc<BundleInner>,
}

struct BundleInner {
    queue: usize,
    commands: vk::CommandBuffer,
    label: String,
    /// Resources that it uses, each with every way in which it does.
    uses: Vec<(Buffer, Scope)>,
    host_reads: bool,
    /// Owns the commands and holds what they use. In a mutex, which nobody locks, because submissions on several threads
    /// hold it and it is not `Sync`.
    _storage: Mutex<Box<Storage>>,
}

impl Recorder {
    /// Records the commands of `f` as a bundle for this recorder's queue; does not execute it.
    ///
    /// # Errors
    /// Those of `f`; [`GpuError::Bundle`] where it uses an image or reads back.
    pub fn bundle<E: From<GpuError>>(
        &self,
        label: &str,
        f: impl FnOnce(&mut Self) -> Result<(), E>,
    ) -> Result<Bundle, E> {
        let family = self.gpu.inner.queues.at(self.queue).family;
        let mut storage = Storage::of_bundle(&self.gpu.inner.core, family)?;
        storage.begin(Submission::new(self.queue))?;
        let mut rec = Self {
            gpu: self.gpu.clone(),
            queue: self.queue,
            graphics: false,
            storage: Box::new(storage),
        };
        f(&mut rec)?;
        let mut storage = rec.storage;
        storage.end()?;
        let uses = storage.buffers.iter();
        Ok(Bundle {
            inner: Arc::new(BundleInner {
                queue: self.queue,
                commands: storage.cmd,
                label: label.to_owned(),
                uses: uses.map(|used| (used.buffer.clone(), used.scope)).collect(),
                host_reads: storage.host_reads,
                _storage: Mutex::new(storage),
            }),
        })
    }

    /// Whether `bundle` was recorded for this recorder's queue.
    pub fn takes(&self, bundle: &Bundle) -> bool {
        self.queue == bundle.inner.queue
    }

    /// Executes a bundle as one pass, after all before it that it depends on.
    ///
    /// # Errors
    /// [`GpuError::Bundle`] for one of another queue, or within a bundle.
    pub fn execute(&mut self, bundle: &Bundle) -> Result<(), GpuError> {
        let inner = &bundle.inner;
        if !self.takes(bundle) || self.storage.is_bundle {
            let cause = format!(
                "\"{}\" is a bundle of another queue, or within one",
                inner.label
            );
            return Err(GpuError::Bundle(cause));
        }
        let storage = &mut *self.storage;
        storage.clear_pass();
        for (buffer, scope) in &inner.uses {
            storage.use_buffer(buffer, *scope);
        }
        storage.host_reads |= inner.host_reads;
        storage.retain(inner.clone());
        storage.open_pass(inner.label.as_bytes())?;
        // SAFETY: both are of this queue's family, the bundle is complete and held, and it may be executed again before
        // the device has finished it.
        unsafe {
            let device = &storage.core.device;
            device.cmd_execute_commands(storage.cmd, &[inner.commands]);
        }
        // The bound pipeline is undefined after it.
        storage.bound = vk::Pipeline::null();
        storage.close_pass()
    }
}
