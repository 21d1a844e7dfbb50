//! Opening the device: instance, physical device, logical device.

use std::mem::ManuallyDrop;
use std::sync::{Arc, Mutex};

use ash::vk;
use gpu_allocator::vulkan::{Allocator, AllocatorCreateDesc};

use super::cache::Kept;
use super::core::Core;
use super::create::{
    create_device, create_instance, create_messenger, device_request, instance_extensions,
    instance_request, validation_layer,
};
use super::info::{self, has};
use super::options::Options;
use super::plan::QueuePlan;
use super::provider::Provider;
use super::select::{self, Candidate};
use super::validation::Messages;
use crate::GpuError;
use crate::memory::Spares;
use crate::pipeline::Shared;

/// Version from which on a validation layer certainly supports VK_KHR_shader_maximal_reconvergence; it came in January 2024.
const RECONVERGES: u32 = vk::make_api_version(0, 1, 3, 280);

/// Opens a device through `provider`, with the queues of the plan.
pub(crate) fn open(
    provider: &mut dyn Provider,
    options: &Options,
) -> Result<(Arc<Core>, QueuePlan), GpuError> {
    let entry = provider.entry()?;
    let messages = Messages::default();
    let request = instance_request(&entry, provider, options)?;
    let mut opening = Opening {
        instance: create_instance(&entry, provider, &request, &messages, options)?,
        device: None,
        messenger: None,
        finished: false,
    };
    let instance = &opening.instance;

    let devices = select::ranked(instance)?;
    let candidates: Vec<Candidate> = devices
        .iter()
        .map(|(handle, properties)| Candidate {
            handle: *handle,
            name: properties.info.name.clone(),
            kind: properties.info.kind,
            missing: properties.missing.clone(),
        })
        .collect();
    let physical = provider.choose(instance, &candidates, options.device.as_deref())?;
    let mut properties = info::query(instance, physical);
    if options.validation && validation_layer(&entry).is_some_and(|knows| knows < RECONVERGES) {
        // An older layer would take the extension for an error of ours.
        properties.info.features.maximal_reconvergence = false;
    }
    if !properties.missing.is_empty() {
        return Err(GpuError::Unsuitable {
            device: properties.info.name,
            missing: properties.missing.join(", "),
        });
    }
    let plan = QueuePlan::of(instance, physical).ok_or_else(|| GpuError::Unsuitable {
        device: properties.info.name.clone(),
        missing: "a queue for graphics and compute".to_owned(),
    })?;
    let request = device_request(provider, &properties, plan.requests());
    let handle = create_device(instance, provider, physical, &request)?;
    // SAFETY: the provider made `handle` from this instance.
    let device = unsafe { ash::Device::load(instance.fp_v1_0(), handle) };
    opening.device = Some(device.clone());

    let labels = has(
        &instance_extensions(&entry, None),
        ash::ext::debug_utils::NAME,
    )
    .then(|| ash::ext::debug_utils::Device::new(instance, &device));
    if options.validation {
        opening.messenger = Some(create_messenger(&entry, instance, &messages)?);
    }
    let allocator = Allocator::new(&AllocatorCreateDesc {
        instance: instance.clone(),
        device: device.clone(),
        physical_device: physical,
        debug_settings: gpu_allocator::AllocatorDebugSettings::default(),
        buffer_device_address: false,
        allocation_sizes: gpu_allocator::AllocationSizes::default(),
    })
    .map_err(|error| GpuError::OutOfMemory {
        label: "allocator".to_owned(),
        bytes: None,
        cause: error.to_string(),
    })?;
    let kept = options.pipelines.as_deref().map(|folder| {
        // SAFETY: `physical` is a device of `instance`.
        Kept::read(folder, &unsafe {
            instance.get_physical_device_properties(physical)
        })
    });
    let (kept, data) = kept.map_or((None, Vec::new()), |(kept, data)| (Some(kept), data));
    let initial = vk::PipelineCacheCreateInfo::default().initial_data(&data);
    // SAFETY: the device is alive; the data were another cache's of the same device and driver, bit by bit, and live through
    // the call.
    let pipeline_cache = unsafe { device.create_pipeline_cache(&initial, None) }
        .map_err(GpuError::vulkan("vkCreatePipelineCache"))?;

    let mut info = properties.info;
    info.features = request.features;
    if !plan.timestamps() {
        info.timestamp_period = 0.0;
    }
    let core = Arc::new(Core {
        push: ash::khr::push_descriptor::Device::new(instance, &device),
        labels,
        messenger: opening.messenger.take(),
        messages,
        allocator: Mutex::new(ManuallyDrop::new(allocator)),
        spares: Spares::default(),
        pipeline_cache,
        shared: Shared::default(),
        kept,
        info,
        families: plan.families(),
        physical,
        device,
        instance: instance.clone(),
        _entry: entry,
    });
    opening.finished = true;
    tracing::info!(
        device = core.info.name,
        driver = core.info.driver,
        api = core.info.api,
        "opened"
    );
    Ok((core, plan))
}

/// Destroys the objects that exist when opening fails half-way.
struct Opening {
    instance: ash::Instance,
    device: Option<ash::Device>,
    messenger: Option<(ash::ext::debug_utils::Instance, vk::DebugUtilsMessengerEXT)>,
    finished: bool,
}

impl Drop for Opening {
    fn drop(&mut self) {
        if self.finished {
            return;
        }
        // SAFETY: opening failed before anything else held these.
        unsafe {
            if let Some(device) = &self.device {
                device.destroy_device(None);
            }
            if let Some((utils, messenger)) = &self.messenger {
                utils.destroy_debug_utils_messenger(*messenger, None);
            }
            self.instance.destroy_instance(None);
        }
    }
}
