//! Vulkan instance and device, made by the runtime (XR_KHR_vulkan_enable2).

use openxr as xr;
use vitriol_gpu::ash;
use vitriol_gpu::ash::vk::Handle;
use vitriol_gpu::{Candidate, DeviceRequest, GpuError, InstanceRequest, Provider, vk};

use super::options::OpenXrOptions;

/// The runtime of `instance`, for the headset `system`.
pub(super) struct Runtime<'a> {
    instance: &'a xr::Instance,
    system: xr::SystemId,
    options: &'a OpenXrOptions,
    /// The loader's entry point, once the loader is loaded.
    loader: Option<vk::PFN_vkGetInstanceProcAddr>,
}

impl<'a> Runtime<'a> {
    pub(super) fn new(
        instance: &'a xr::Instance,
        system: xr::SystemId,
        options: &'a OpenXrOptions,
    ) -> Self {
        Self {
            instance,
            system,
            options,
            loader: None,
        }
    }

    fn loader(&self) -> Result<xr::sys::platform::VkGetInstanceProcAddr, GpuError> {
        let loader = self
            .loader
            .ok_or_else(|| refused("find the Vulkan loader")("it was not loaded"))?;
        // SAFETY: both are vkGetInstanceProcAddr's type, as `ash` and as `openxr` declare it: a
        // pointer to the instance and one to the name, and a function pointer or null back.
        Ok(unsafe {
            std::mem::transmute::<
                vk::PFN_vkGetInstanceProcAddr,
                xr::sys::platform::VkGetInstanceProcAddr,
            >(loader)
        })
    }
}

/// For `map_err`: the runtime's refusal of a step of making the device.
fn refused<E: std::fmt::Display>(step: &'static str) -> impl Fn(E) -> GpuError {
    move |cause| GpuError::Provider {
        provider: "the OpenXR runtime".to_owned(),
        step,
        cause: format!("{cause}; update the runtime and the graphics driver"),
    }
}

// SAFETY: XR_KHR_vulkan_enable2 has the runtime call vkCreateInstance and vkCreateDevice with the
// given create info, hands the objects to the caller, and names a device of that instance.
unsafe impl Provider for Runtime<'_> {
    fn amend_instance(&self, request: &mut InstanceRequest) {
        request
            .extensions
            .extend_from_slice(&self.options.instance_extensions);
    }

    fn amend_device(&self, request: &mut DeviceRequest) {
        request
            .extensions
            .extend_from_slice(&self.options.device_extensions);
    }

    fn create_instance(
        &mut self,
        entry: &ash::Entry,
        info: &vk::InstanceCreateInfo<'_>,
    ) -> Result<vk::Instance, GpuError> {
        self.loader = Some(entry.static_fn().get_instance_proc_addr);
        let info: *const vk::InstanceCreateInfo<'_> = info;
        // SAFETY: the graphics requirements were asked for (`Live::start`), the entry point is the
        // loader's, and `info` is a VkInstanceCreateInfo that lives through the call.
        let made = unsafe {
            self.instance
                .create_vulkan_instance(self.system, self.loader()?, info.cast())
        };
        let handle = made
            .map_err(refused("create a Vulkan instance"))?
            .map_err(|result| GpuError::NoInstance {
                result: vk::Result::from_raw(result),
            })?;
        Ok(vk::Instance::from_raw(handle as u64))
    }

    fn choose(
        &mut self,
        instance: &ash::Instance,
        candidates: &[Candidate],
        wanted: Option<&str>,
    ) -> Result<vk::PhysicalDevice, GpuError> {
        // SAFETY: the instance was made by this runtime, above.
        let chosen = unsafe {
            self.instance
                .vulkan_graphics_device(self.system, instance.handle().as_raw() as _)
        }
        .map_err(refused("name the headset's Vulkan device"))?;
        let chosen = vk::PhysicalDevice::from_raw(chosen as u64);
        if let (Some(wanted), Some(device)) =
            (wanted, candidates.iter().find(|c| c.handle == chosen))
        {
            tracing::info!(
                wanted,
                device = device.name,
                "the headset is on this device, whatever was asked for"
            );
        }
        Ok(chosen)
    }

    fn create_device(
        &mut self,
        _instance: &ash::Instance,
        physical: vk::PhysicalDevice,
        info: &vk::DeviceCreateInfo<'_>,
    ) -> Result<vk::Device, GpuError> {
        let info: *const vk::DeviceCreateInfo<'_> = info;
        // SAFETY: `physical` is the device that the runtime named, the entry point is the
        // loader's, and `info` is a VkDeviceCreateInfo that lives through the call.
        let made = unsafe {
            self.instance.create_vulkan_device(
                self.system,
                self.loader()?,
                physical.as_raw() as _,
                info.cast(),
            )
        };
        let handle = made
            .map_err(refused("create a Vulkan device"))?
            .map_err(|result| GpuError::Vulkan {
                call: "vkCreateDevice",
                result: vk::Result::from_raw(result),
            })?;
        Ok(vk::Device::from_raw(handle as u64))
    }
}
