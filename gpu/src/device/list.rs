//! All devices, for `vitriol doctor`.

use ash::vk;

use super::info::{DeviceInfo, Properties};
use super::provider::load_entry;
use super::select::ranked;
use crate::GpuError;

/// One device as `vitriol doctor` shows it.
#[derive(Clone, Debug)]
pub struct DeviceSummary {
    /// Its properties, with all optional features that it has.
    pub info: DeviceInfo,
    /// Names of its extensions.
    pub extensions: Vec<String>,
    /// Required things that it lacks; empty when it can be used.
    pub missing: Vec<String>,
    /// Optional things that it lacks, with the substitute for each.
    pub missing_optional: Vec<String>,
}

/// All devices, best first, without opening one; `Options::device` takes the index.
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
            .map(|(_, properties)| summary(properties))
            .collect()
    });
    // SAFETY: nothing made from the instance is left.
    unsafe { instance.destroy_instance(None) };
    list
}

fn summary(properties: Properties) -> DeviceSummary {
    let info = properties.info;
    let mut missing_optional = Vec::new();
    if info.timestamp_period == 0.0 {
        missing_optional.push("timestamps (no times per pass)".to_owned());
    }
    if !info.features.subgroups {
        missing_optional.push("subgroup operations in compute".to_owned());
    } else if !info.features.maximal_reconvergence {
        let what =
            "maximal reconvergence (lanes that part in a loop meet again as the driver likes)";
        missing_optional.push(what.to_owned());
    }
    DeviceSummary {
        info,
        extensions: properties
            .extensions
            .iter()
            .map(|name| name.to_string_lossy().into_owned())
            .collect(),
        missing: properties.missing,
        missing_optional,
    }
}
