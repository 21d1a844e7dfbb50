//! Opening the device: instance, physical device, logical device, queues.

use std::mem::ManuallyDrop;
use std::sync::{Arc, Mutex};

use ash::vk;
use gpu_allocator::vulkan::{Allocator, AllocatorCreateDesc};

use super::core::Core;
use super::create::{
    create_device, create_instance, create_messenger, device_request, instance_extensions,
    instance_request,
};
use super::info::{self, DeviceInfo, EnabledFeatures, Properties, version_text};
use super::provider::{Provider, has};
use super::queue::{QueueKind, Queues};
use super::select::{self, Candidate};
use super::validation::Messages;
use crate::GpuError;

/// What the device's clock is read for; see [`Ticket::timings`](crate::Ticket::timings).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Timestamps {
    /// Nothing.
    #[default]
    None,
    /// Each submission as a whole: two stamps, which cost 0.04 of 13 ms on the software driver.
    Whole,
    /// Every pass; costs 2 to 5 ms a frame there.
    Passes,
}

/// How to open the device.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// Index or part of the name of the device; the best one when absent:
    /// discrete before integrated before virtual before CPU.
    pub device: Option<String>,
    /// Loads the Khronos validation layer with synchronisation validation;
    /// see [`Gpu::validation_messages`].
    pub validation: bool,
    /// What is measured by the device's clock.
    pub timestamps: Timestamps,
    /// Marks each pass as the device reaches it, so that
    /// [`GpuError::DeviceLost`] can name the last one.
    pub markers: bool,
}

/// An open device; cheap to clone.
#[derive(Clone)]
pub struct Gpu {
    pub(crate) inner: Arc<Inner>,
}

pub(crate) struct Inner {
    pub(crate) queues: Queues,
    pub(crate) options: Options,
    pub(crate) core: Arc<Core>,
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

impl Gpu {
    /// Opens a device through `provider`.
    ///
    /// # Errors
    /// What is missing (loader, driver, device, feature, layer), with remedy.
    pub fn open(provider: &mut dyn Provider, options: &Options) -> Result<Self, GpuError> {
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
                name: properties.name.clone(),
                kind: properties.kind,
                missing: properties.missing.clone(),
            })
            .collect();
        let physical = provider.choose(instance, &candidates, options.device.as_deref())?;
        let properties = info::query(instance, physical);
        if !properties.missing.is_empty() {
            return Err(GpuError::Unsuitable {
                device: properties.name,
                missing: properties.missing.join(", "),
            });
        }
        let plan = Queues::plan(instance, physical).ok_or_else(|| GpuError::Unsuitable {
            device: properties.name.clone(),
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
            bytes: 0,
            cause: error.to_string(),
        })?;
        // SAFETY: the device is alive; no initial data.
        let pipeline_cache =
            unsafe { device.create_pipeline_cache(&vk::PipelineCacheCreateInfo::default(), None) }
                .map_err(GpuError::vulkan("vkCreatePipelineCache"))?;

        let core = Arc::new(Core {
            push: ash::khr::push_descriptor::Device::new(instance, &device),
            conditional: request
                .features
                .conditional
                .then(|| ash::ext::conditional_rendering::Device::new(instance, &device)),
            labels,
            messenger: opening.messenger.take(),
            messages,
            allocator: Mutex::new(ManuallyDrop::new(allocator)),
            pipeline_cache,
            info: device_info(properties, request.features, &plan),
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
        let queues = Queues::new(&core, &plan)?;
        Ok(Self {
            inner: Arc::new(Inner {
                queues,
                options: options.clone(),
                core,
            }),
        })
    }

    /// What the device is and offers.
    pub fn info(&self) -> &DeviceInfo {
        &self.inner.core.info
    }

    /// How it was opened.
    pub fn options(&self) -> &Options {
        &self.inner.options
    }

    /// Warnings and errors of the validation layer since the device was opened
    /// or they were last taken; always empty without `Options::validation`.
    pub fn validation_messages(&self) -> Vec<String> {
        self.inner.core.messages.list()
    }

    /// As [`Gpu::validation_messages`], and forgets them.
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
}

impl Drop for Inner {
    fn drop(&mut self) {
        // SAFETY: no one else submits any more: the last `Gpu` is going. On a
        // lost device the call fails at once and everything counts as done.
        let _ = unsafe { self.core.device.device_wait_idle() };
        self.queues.destroy(&self.core);
    }
}

/// Destroys what there is when opening fails half-way.
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

fn device_info(
    properties: Properties,
    features: EnabledFeatures,
    plan: &super::queue::QueuePlan,
) -> DeviceInfo {
    DeviceInfo {
        name: properties.name,
        driver: properties.driver,
        api: version_text(properties.api_version),
        kind: properties.kind,
        limits: properties.limits,
        subgroup_size: properties.subgroup_size,
        timestamp_period: if plan.timestamps() {
            properties.timestamp_period
        } else {
            0.0
        },
        max_views: properties.max_views,
        features,
        second_queue: plan.is_double(),
        // Vulkan promises 65,536 texels, of which a list soon has more.
        fetches_texels: properties.kind == vk::PhysicalDeviceType::CPU
            && properties.limits.texels >= 1 << 27,
    }
}
