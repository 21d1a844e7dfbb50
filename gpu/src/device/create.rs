//! Requests for instance and device, and their creation from these.

use std::ffi::{CStr, CString, c_char};

use ash::vk;

use super::info::{Properties, has};
use super::options::Options;
use super::provider::{DeviceRequest, InstanceRequest, Provider, QueueRequest};
use super::validation::{self, Messages};
use crate::GpuError;

pub(crate) fn instance_extensions(entry: &ash::Entry, layer: Option<&CStr>) -> Vec<CString> {
    // SAFETY: the loader is alive.
    unsafe { entry.enumerate_instance_extension_properties(layer) }
        .unwrap_or_default()
        .iter()
        .filter_map(|extension| extension.extension_name_as_c_str().ok())
        .map(CStr::to_owned)
        .collect()
}

/// Version of Vulkan that the validation layer supports; `None` without one.
pub(crate) fn validation_layer(entry: &ash::Entry) -> Option<u32> {
    // SAFETY: the loader is alive.
    let layers = unsafe { entry.enumerate_instance_layer_properties() }.unwrap_or_default();
    let mut layers = layers.iter();
    let ours = layers.find(|layer| layer.layer_name_as_c_str() == Ok(validation::LAYER));
    ours.map(|layer| layer.spec_version)
}

pub(crate) fn instance_request(
    entry: &ash::Entry,
    provider: &dyn Provider,
    options: &Options,
) -> Result<InstanceRequest, GpuError> {
    let mut offered = instance_extensions(entry, None);
    let mut request = InstanceRequest {
        api_version: vk::API_VERSION_1_3,
        extensions: Vec::new(),
        layers: Vec::new(),
    };
    if has(&offered, ash::ext::debug_utils::NAME) {
        request
            .extensions
            .push(ash::ext::debug_utils::NAME.to_owned());
    }
    if options.validation {
        if validation_layer(entry).is_none() {
            return Err(GpuError::NoValidationLayer);
        }
        request.layers.push(validation::LAYER.to_owned());
        request
            .extensions
            .push(ash::ext::validation_features::NAME.to_owned());
        offered.extend(instance_extensions(entry, Some(validation::LAYER)));
    }
    provider.amend_instance(&mut request);
    for extension in &request.extensions {
        if !has(&offered, extension) {
            return Err(GpuError::MissingInstanceExtension {
                missing: extension.to_string_lossy().into_owned(),
            });
        }
    }
    Ok(request)
}

pub(crate) fn create_instance(
    entry: &ash::Entry,
    provider: &mut dyn Provider,
    request: &InstanceRequest,
    messages: &Messages,
    options: &Options,
) -> Result<ash::Instance, GpuError> {
    let application = vk::ApplicationInfo::default()
        .application_name(c"vitriol")
        .engine_name(c"vitriol")
        .api_version(request.api_version);
    let extensions = pointers(&request.extensions);
    let layers = pointers(&request.layers);
    let enabled = [vk::ValidationFeatureEnableEXT::SYNCHRONIZATION_VALIDATION];
    let mut features = vk::ValidationFeaturesEXT::default().enabled_validation_features(&enabled);
    // Catches the layer's messages while the instance itself is created and destroyed.
    let mut messenger = messages.create_info();
    let mut create = vk::InstanceCreateInfo::default()
        .application_info(&application)
        .enabled_extension_names(&extensions)
        .enabled_layer_names(&layers);
    if options.validation {
        create = create.push_next(&mut features).push_next(&mut messenger);
    }
    let handle = provider.create_instance(entry, &create)?;
    // SAFETY: the provider promises a valid instance of this loader.
    Ok(unsafe { ash::Instance::load(entry.static_fn(), handle) })
}

pub(crate) fn create_messenger(
    entry: &ash::Entry,
    instance: &ash::Instance,
    messages: &Messages,
) -> Result<(ash::ext::debug_utils::Instance, vk::DebugUtilsMessengerEXT), GpuError> {
    let utils = ash::ext::debug_utils::Instance::new(entry, instance);
    // SAFETY: the extension is on wherever validation is, and `Core` keeps
    // `messages` longer than the messenger.
    let messenger = unsafe { utils.create_debug_utils_messenger(&messages.create_info(), None) }
        .map_err(GpuError::vulkan("vkCreateDebugUtilsMessengerEXT"))?;
    Ok((utils, messenger))
}

pub(crate) fn device_request(
    provider: &dyn Provider,
    properties: &Properties,
    queues: Vec<QueueRequest>,
) -> DeviceRequest {
    let mut extensions = vec![ash::khr::push_descriptor::NAME.to_owned()];
    if properties.info.features.maximal_reconvergence {
        extensions.push(ash::khr::shader_maximal_reconvergence::NAME.to_owned());
    }
    let mut request = DeviceRequest {
        extensions,
        features: properties.info.features,
        queues,
    };
    provider.amend_device(&mut request);
    request
}

pub(crate) fn create_device(
    instance: &ash::Instance,
    provider: &mut dyn Provider,
    physical: vk::PhysicalDevice,
    request: &DeviceRequest,
) -> Result<vk::Device, GpuError> {
    let on = request.features;
    let queues: Vec<_> = request
        .queues
        .iter()
        .map(|queue| {
            vk::DeviceQueueCreateInfo::default()
                .queue_family_index(queue.family)
                .queue_priorities(&queue.priorities)
        })
        .collect();
    let extensions = pointers(&request.extensions);
    let mut v11 =
        vk::PhysicalDeviceVulkan11Features::default().storage_buffer16_bit_access(on.float16);
    let mut v12 = vk::PhysicalDeviceVulkan12Features::default()
        .timeline_semaphore(true)
        .shader_float16(on.float16)
        .vulkan_memory_model(on.memory_model)
        .vulkan_memory_model_device_scope(on.memory_model);
    let mut v13 = vk::PhysicalDeviceVulkan13Features::default()
        .dynamic_rendering(true)
        .synchronization2(true);
    let mut reconvergence = vk::PhysicalDeviceShaderMaximalReconvergenceFeaturesKHR::default()
        .shader_maximal_reconvergence(true);
    let core = vk::PhysicalDeviceFeatures::default()
        .shader_storage_image_extended_formats(on.storage_formats);
    let mut create = vk::DeviceCreateInfo::default()
        .queue_create_infos(&queues)
        .enabled_extension_names(&extensions)
        .enabled_features(&core)
        .push_next(&mut v11)
        .push_next(&mut v12)
        .push_next(&mut v13);
    if on.maximal_reconvergence {
        create = create.push_next(&mut reconvergence);
    }
    provider.create_device(instance, physical, &create)
}

/// Null-terminated pointers to `names`, which must outlive them.
fn pointers(names: &[CString]) -> Vec<*const c_char> {
    names.iter().map(|name| name.as_ptr()).collect()
}
