//! All devices, for `vitriol doctor`.

use ash::vk;

use super::info::{EnabledFeatures, Properties, version_text};
use super::provider::load_entry;
use super::select::ranked;
use crate::GpuError;

/// One device as `vitriol doctor` shows it.
#[derive(Clone, Debug)]
pub struct DeviceSummary {
    /// Index for `Options::device`.
    pub index: usize,
    /// Device name.
    pub name: String,
    /// Driver name and version.
    pub driver: String,
    /// Vulkan version.
    pub api: String,
    /// Discrete, integrated, CPU and so on.
    pub kind: vk::PhysicalDeviceType,
    /// Invocations of the smallest subgroup that the driver may choose, and per subgroup as a rule.
    pub subgroup_sizes: [u32; 2],
    /// Optional features that it has.
    pub features: EnabledFeatures,
    /// Names of its extensions.
    pub extensions: Vec<String>,
    /// Required things that it lacks; empty when it can be used.
    pub missing: Vec<String>,
    /// Optional things that it lacks, with the substitute for each.
    pub missing_optional: Vec<String>,
}

/// All devices, best first, without opening one.
///
/// # Errors
/// [`GpuError::NoLoader`], [`GpuError::NoInstance`] or [`GpuError::NoDevice`],
/// each with its remedy.
pub fn list_devices() -> Result<Vec<DeviceSummary>, GpuError> {
    let entry = load_entry()?;
    let application = vk::ApplicationInfo::default().api_version(vk::API_VERSION_1_3);
    let create = vk::InstanceCreateInfo::default().application_info(&application);
    // SAFETY: `create` lives through the call; the instance is destroyed below.
    let instance = unsafe { entry.create_instance(&create, None) }
        .map_err(|result| GpuError::NoInstance { result })?;
    let list = ranked(&instance).map(|devices| {
        devices
            .into_iter()
            .enumerate()
            .map(|(index, (_, properties))| summary(index, properties))
            .collect()
    });
    // SAFETY: nothing made from the instance is left.
    unsafe { instance.destroy_instance(None) };
    list
}

fn summary(index: usize, properties: Properties) -> DeviceSummary {
    let mut missing_optional = Vec::new();
    if properties.timestamp_period == 0.0 {
        missing_optional.push("timestamps (no times per pass)".to_owned());
    }
    if !properties.features.subgroups {
        missing_optional.push("subgroup operations in compute".to_owned());
    } else if !properties.features.maximal_reconvergence {
        let what =
            "maximal reconvergence (lanes that part in a loop meet again as the driver likes)";
        missing_optional.push(what.to_owned());
    }
    DeviceSummary {
        index,
        name: properties.name,
        driver: properties.driver,
        api: version_text(properties.api_version),
        kind: properties.kind,
        subgroup_sizes: [properties.least_subgroup_size, properties.subgroup_size],
        features: properties.features,
        extensions: properties
            .extensions
            .iter()
            .map(|name| name.to_string_lossy().into_owned())
            .collect(),
        missing: properties.missing,
        missing_optional,
    }
}
