//! Providers, which make the Vulkan instance and device.
//!
//! `Gpu::open` decides what it needs (requests, as data), asks the provider to
//! add its own needs, and has it create instance and device from the finished
//! create infos. That is the shape of XR_KHR_vulkan_enable2, where the OpenXR
//! runtime wraps `vkCreateInstance` and `vkCreateDevice` and names the physical
//! device; the plain loader fits it too.

use std::ffi::CString;

use ash::vk;

use super::info::EnabledFeatures;
use super::select::{self, Candidate};
use crate::GpuError;

/// Requirements of the instance.
#[derive(Clone, Debug)]
pub struct InstanceRequest {
    /// Highest API version that the program uses, `vk::make_api_version` coded.
    pub api_version: u32,
    /// Instance extensions.
    pub extensions: Vec<CString>,
    /// Layers.
    pub layers: Vec<CString>,
}

/// One queue family to take queues from.
#[derive(Clone, Debug, PartialEq)]
pub struct QueueRequest {
    /// Index of the family.
    pub family: u32,
    /// Priority of each queue of it, 0 to 1.
    pub priorities: Vec<f32>,
}

/// Requirements of the device.
#[derive(Clone, Debug)]
pub struct DeviceRequest {
    /// Device extensions.
    pub extensions: Vec<CString>,
    /// Optional features to switch on; the required ones always are.
    pub features: EnabledFeatures,
    /// Queues.
    pub queues: Vec<QueueRequest>,
}

/// Creates instance and device, and chooses the physical device.
///
/// # Safety
/// Handles that the `create` functions return must be valid, made from the
/// given create info and owned by the caller, who destroys them with
/// `vkDestroyInstance` and `vkDestroyDevice`. The chosen device must be one of
/// the instance.
pub unsafe trait Provider {
    /// The loader's entry points.
    ///
    /// # Errors
    /// [`GpuError::NoLoader`] where there is no loader.
    fn entry(&mut self) -> Result<ash::Entry, GpuError> {
        load_entry()
    }

    /// Adds what the provider itself needs, such as window-surface extensions.
    fn amend_instance(&self, request: &mut InstanceRequest) {
        let _ = request;
    }

    /// Calls `vkCreateInstance`, or has a runtime do it.
    ///
    /// # Errors
    /// The refusal, as [`GpuError::NoInstance`] or [`GpuError::Provider`].
    fn create_instance(
        &mut self,
        entry: &ash::Entry,
        info: &vk::InstanceCreateInfo<'_>,
    ) -> Result<vk::Instance, GpuError>;

    /// Chooses among the devices, best first; `wanted` is
    /// `Options::device`. A runtime that is tied to one device returns that.
    ///
    /// # Errors
    /// [`GpuError::NoDevice`], [`GpuError::NoSuchDevice`] or
    /// [`GpuError::Unsuitable`].
    fn choose(
        &mut self,
        instance: &ash::Instance,
        candidates: &[Candidate],
        wanted: Option<&str>,
    ) -> Result<vk::PhysicalDevice, GpuError> {
        let _ = instance;
        select::choose(candidates, wanted)
    }

    /// Adds what the provider itself needs, such as `VK_KHR_swapchain`.
    fn amend_device(&self, request: &mut DeviceRequest) {
        let _ = request;
    }

    /// Calls `vkCreateDevice`, or has a runtime do it.
    ///
    /// # Errors
    /// The refusal, as [`GpuError::Vulkan`] or [`GpuError::Provider`].
    fn create_device(
        &mut self,
        instance: &ash::Instance,
        physical: vk::PhysicalDevice,
        info: &vk::DeviceCreateInfo<'_>,
    ) -> Result<vk::Device, GpuError>;
}

/// The system's Vulkan loader, loaded at run time.
#[derive(Clone, Debug, Default)]
pub struct PlainLoader {
    /// Further instance extensions, such as those of a window's surface.
    pub instance_extensions: Vec<CString>,
    /// Further device extensions, such as `VK_KHR_swapchain`.
    pub device_extensions: Vec<CString>,
}

// SAFETY: both handles come straight from the loader, and the default `choose`
// picks one of the candidates.
unsafe impl Provider for PlainLoader {
    fn amend_instance(&self, request: &mut InstanceRequest) {
        add_missing(&mut request.extensions, &self.instance_extensions);
    }

    fn create_instance(
        &mut self,
        entry: &ash::Entry,
        info: &vk::InstanceCreateInfo<'_>,
    ) -> Result<vk::Instance, GpuError> {
        // SAFETY: `info` and what it points to live through the call; the
        // caller takes over the handle.
        unsafe { entry.create_instance(info, None) }
            .map(|instance| instance.handle())
            .map_err(|result| GpuError::NoInstance { result })
    }

    fn amend_device(&self, request: &mut DeviceRequest) {
        add_missing(&mut request.extensions, &self.device_extensions);
    }

    fn create_device(
        &mut self,
        instance: &ash::Instance,
        physical: vk::PhysicalDevice,
        info: &vk::DeviceCreateInfo<'_>,
    ) -> Result<vk::Device, GpuError> {
        // SAFETY: `physical` is a device of `instance`, and `info` lives
        // through the call; the caller takes over the handle.
        unsafe { instance.create_device(physical, info, None) }
            .map(|device| device.handle())
            .map_err(GpuError::vulkan("vkCreateDevice"))
    }
}

/// Loads libvulkan.
pub(crate) fn load_entry() -> Result<ash::Entry, GpuError> {
    // SAFETY: the system's loader is trusted like any library that is linked.
    unsafe { ash::Entry::load() }.map_err(|error| GpuError::NoLoader {
        cause: error.to_string(),
    })
}

fn add_missing(list: &mut Vec<CString>, more: &[CString]) {
    for name in more {
        if !list.contains(name) {
            list.push(name.clone());
        }
    }
}
