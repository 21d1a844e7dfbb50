//! The device as its resources hold it: alive until the last of them is gone.

use std::mem::ManuallyDrop;
use std::sync::{Mutex, PoisonError};

use ash::vk;
use gpu_allocator::vulkan::Allocator;

use super::cache::Kept;
use super::info::DeviceInfo;
use super::validation::Messages;
use crate::memory::Spares;
use crate::pipeline::Shared;

/// The open device without its queues: what buffers, images, samplers and
/// pipelines are made from. A [`Gpu`](crate::Gpu) dereferences to it.
pub struct Core {
    /// Keeps the loader's library open.
    pub(crate) _entry: ash::Entry,
    pub(crate) instance: ash::Instance,
    pub(crate) physical: vk::PhysicalDevice,
    pub(crate) device: ash::Device,
    pub(crate) push: ash::khr::push_descriptor::Device,
    /// Set where the instance has VK_EXT_debug_utils.
    pub(crate) labels: Option<ash::ext::debug_utils::Device>,
    pub(crate) messenger: Option<(ash::ext::debug_utils::Instance, vk::DebugUtilsMessengerEXT)>,
    pub(crate) messages: Messages,
    pub(crate) allocator: Mutex<ManuallyDrop<Allocator>>,
    /// Readback buffers that are free for reuse.
    pub(crate) spares: Spares,
    pub(crate) pipeline_cache: vk::PipelineCache,
    /// Compute pipelines of the device.
    pub(crate) shared: Shared,
    /// The file in which its pipelines are kept; `None` without a folder.
    pub(super) kept: Option<Kept>,
    pub(crate) info: DeviceInfo,
    /// Queue families in use, each once.
    pub(crate) families: Vec<u32>,
}

impl Core {
    /// How resources are shared among the queues. Concurrent where there are
    /// two families: buffers lose nothing by it, and ownership transfers would
    /// have to be written at every crossing.
    pub(crate) fn sharing(&self) -> (vk::SharingMode, &[u32]) {
        if self.families.len() > 1 {
            (vk::SharingMode::CONCURRENT, &self.families)
        } else {
            (vk::SharingMode::EXCLUSIVE, &[])
        }
    }

    /// Names an object for the validation layer and for debuggers.
    pub(crate) fn name<H: vk::Handle>(&self, handle: H, label: &str) {
        let (Some(labels), Ok(label)) = (&self.labels, std::ffi::CString::new(label)) else {
            return;
        };
        let info = vk::DebugUtilsObjectNameInfoEXT::default()
            .object_handle(handle)
            .object_name(&label);
        // SAFETY: the handle is alive and of this device; a failure to name
        // it changes nothing.
        let _ = unsafe { labels.set_debug_utils_object_name(&info) };
    }
}

impl Drop for Core {
    fn drop(&mut self) {
        if let Some(kept) = &self.kept {
            // SAFETY: the cache is this device's; where the call fails, nothing is stored.
            let data = unsafe { self.device.get_pipeline_cache_data(self.pipeline_cache) };
            kept.write(&data.unwrap_or_default());
        }
        for spare in self.spares.take_all() {
            spare.destroy(self);
        }
        // SAFETY: every resource holds this core, so none is left; `Gpu` waited
        // for the device before it let go. The allocator frees its blocks
        // before the device goes, and is not touched again.
        unsafe {
            self.device
                .destroy_pipeline_cache(self.pipeline_cache, None);
            ManuallyDrop::drop(
                self.allocator
                    .get_mut()
                    .unwrap_or_else(PoisonError::into_inner),
            );
            self.device.destroy_device(None);
            if let Some((utils, messenger)) = self.messenger.take() {
                utils.destroy_debug_utils_messenger(messenger, None);
            }
            self.instance.destroy_instance(None);
        }
    }
}
