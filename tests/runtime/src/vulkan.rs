//! XR_KHR_vulkan_enable2: Vulkan's instance and device, made for the application.

use ash::vk::{self, Handle as _};
use openxr::sys;
use serde_json::json;
use sys::Result as R;

use crate::abi::{given, place};
use crate::state::{call, told};

/// A Vulkan instance that was made here.
#[derive(Clone)]
pub(crate) struct Maker {
    instance: ash::Instance,
    /// The device that xrGetVulkanGraphicsDevice2KHR returned.
    physical: Option<vk::PhysicalDevice>,
    /// Devices that were made with it.
    devices: Vec<u64>,
}

/// The device of a session.
#[derive(Clone)]
pub(crate) struct Device {
    pub instance: ash::Instance,
    pub physical: vk::PhysicalDevice,
    pub device: ash::Device,
    pub family: u32,
    pub queue: vk::Queue,
}

/// The application's Vulkan functions.
fn entry(loader: Option<sys::platform::VkGetInstanceProcAddr>) -> Result<ash::StaticFn, R> {
    let loader = loader.ok_or(R::ERROR_VALIDATION_FAILURE)?;
    Ok(ash::StaticFn {
        // SAFETY: both are vkGetInstanceProcAddr's type, as `openxr` and as `ash` declare it: a pointer to
        // the instance and one to the name, and a function pointer or null back.
        get_instance_proc_addr: unsafe {
            std::mem::transmute::<sys::platform::VkGetInstanceProcAddr, vk::PFN_vkGetInstanceProcAddr>(
                loader,
            )
        },
    })
}

pub(crate) extern "system" fn get_graphics_requirements(
    instance: sys::Instance,
    system: sys::SystemId,
    requirements: Option<&mut sys::GraphicsRequirementsVulkanKHR>,
) -> R {
    call("xrGetVulkanGraphicsRequirements2KHR", |state| {
        let held = state.system(instance, system)?;
        let requirements = given!(requirements, sys::GraphicsRequirementsVulkanKHR);
        held.requirements_read = true;
        requirements.min_api_version_supported = sys::Version::new(1, 0, 0);
        requirements.max_api_version_supported = sys::Version::new(1, 4, 0);
        Ok(R::SUCCESS)
    })
}

pub(crate) extern "system" fn create_vulkan_instance(
    instance: sys::Instance,
    info: Option<&sys::VulkanInstanceCreateInfoKHR>,
    made: Option<&mut sys::platform::VkInstance>,
    result: Option<&mut sys::platform::VkResult>,
) -> R {
    told("xrCreateVulkanInstanceKHR", json!({}), |state, _| {
        let info = given!(info, sys::VulkanInstanceCreateInfoKHR);
        let (made, result) = (place!(made), place!(result));
        let held = state.system(instance, info.system_id)?;
        let entry = entry(info.pfn_get_instance_proc_addr)?;
        // SAFETY: the application passes its loader's entry point, its own create info and allocator; the
        // function tables are of that loader.
        let answer = unsafe {
            let functions = ash::EntryFnV1_0::load(|name| {
                let function = (entry.get_instance_proc_addr)(vk::Instance::null(), name.as_ptr());
                std::mem::transmute::<vk::PFN_vkVoidFunction, *const std::ffi::c_void>(function)
            });
            let mut handle = vk::Instance::null();
            let answer = (functions.create_instance)(
                info.vulkan_create_info.cast(),
                info.vulkan_allocator.cast(),
                &mut handle,
            );
            if answer == vk::Result::SUCCESS {
                held.maker = Some(Maker {
                    instance: ash::Instance::load(&entry, handle),
                    physical: None,
                    devices: Vec::new(),
                });
                *made = handle.as_raw() as _;
            }
            answer
        };
        *result = answer.as_raw();
        Ok(R::SUCCESS)
    })
}

pub(crate) extern "system" fn get_vulkan_graphics_device(
    instance: sys::Instance,
    info: Option<&sys::VulkanGraphicsDeviceGetInfoKHR>,
    physical: Option<&mut sys::platform::VkPhysicalDevice>,
) -> R {
    call("xrGetVulkanGraphicsDevice2KHR", |state| {
        let info = given!(info, sys::VulkanGraphicsDeviceGetInfoKHR);
        let held = state.system(instance, info.system_id)?;
        let maker = held.maker.as_mut();
        let maker = maker.filter(|m| m.instance.handle().as_raw() == info.vulkan_instance as u64);
        let maker = maker.ok_or(R::ERROR_VALIDATION_FAILURE)?;
        // SAFETY: the instance is the application's, which lives.
        let devices = unsafe { maker.instance.enumerate_physical_devices() };
        let devices = devices.map_err(|_| R::ERROR_RUNTIME_FAILURE)?;
        let first = *devices.first().ok_or(R::ERROR_RUNTIME_FAILURE)?;
        maker.physical = Some(first);
        *place!(physical) = first.as_raw() as _;
        Ok(R::SUCCESS)
    })
}

pub(crate) extern "system" fn create_vulkan_device(
    instance: sys::Instance,
    info: Option<&sys::VulkanDeviceCreateInfoKHR>,
    made: Option<&mut sys::platform::VkDevice>,
    result: Option<&mut sys::platform::VkResult>,
) -> R {
    told("xrCreateVulkanDeviceKHR", json!({}), |state, _| {
        let info = given!(info, sys::VulkanDeviceCreateInfoKHR);
        let (made, result) = (place!(made), place!(result));
        let held = state.system(instance, info.system_id)?;
        let maker = held.maker.as_mut().ok_or(R::ERROR_VALIDATION_FAILURE)?;
        let named = maker.physical.ok_or(R::ERROR_VALIDATION_FAILURE)?;
        if named.as_raw() != info.vulkan_physical_device as u64 {
            return Err(R::ERROR_VALIDATION_FAILURE);
        }
        let mut handle = vk::Device::null();
        // SAFETY: the device is one of the instance; create info and allocator are the application's.
        let answer = unsafe {
            (maker.instance.fp_v1_0().create_device)(
                named,
                info.vulkan_create_info.cast(),
                info.vulkan_allocator.cast(),
                &mut handle,
            )
        };
        if answer == vk::Result::SUCCESS {
            maker.devices.push(handle.as_raw());
            *made = handle.as_raw() as _;
        }
        *result = answer.as_raw();
        Ok(R::SUCCESS)
    })
}

impl Maker {
    /// The device that the application binds to its session.
    pub(crate) fn bind(&self, binding: &sys::GraphicsBindingVulkanKHR) -> Result<Device, R> {
        let is_ours = binding.instance as u64 == self.instance.handle().as_raw()
            && self.devices.contains(&(binding.device as u64))
            && self.physical.map(vk::PhysicalDevice::as_raw)
                == Some(binding.physical_device as u64);
        if !is_ours {
            return Err(R::ERROR_GRAPHICS_DEVICE_INVALID);
        }
        let family = binding.queue_family_index;
        // SAFETY: the device was made of this instance, and has the queue that the application names.
        let (device, queue) = unsafe {
            let handle = vk::Device::from_raw(binding.device as u64);
            let device = ash::Device::load(self.instance.fp_v1_0(), handle);
            let queue = device.get_device_queue(family, binding.queue_index);
            (device, queue)
        };
        Ok(Device {
            instance: self.instance.clone(),
            physical: vk::PhysicalDevice::from_raw(binding.physical_device as u64),
            device,
            family,
            queue,
        })
    }
}
