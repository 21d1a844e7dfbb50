//! Choice of the physical device.

use ash::vk;

use super::info::{self, Properties};
use crate::GpuError;

/// A physical device and whether it can be used.
#[derive(Clone, Debug)]
pub struct Candidate {
    /// Handle.
    pub handle: vk::PhysicalDevice,
    /// Device name.
    pub name: String,
    /// Discrete, integrated, CPU and so on.
    pub kind: vk::PhysicalDeviceType,
    /// Required things that it lacks; empty when it can be used.
    pub missing: Vec<String>,
}

/// Devices of an instance: usable before unusable, discrete first, CPU last,
/// else in the loader's order, so that the choice is the same every time.
pub(crate) fn ranked(
    instance: &ash::Instance,
) -> Result<Vec<(vk::PhysicalDevice, Properties)>, GpuError> {
    // SAFETY: the instance is alive.
    let handles = unsafe { instance.enumerate_physical_devices() }
        .map_err(|result| GpuError::NoInstance { result })?;
    let mut devices: Vec<_> = handles
        .into_iter()
        .map(|handle| (handle, info::query(instance, handle)))
        .collect();
    if devices.is_empty() {
        return Err(GpuError::NoDevice);
    }
    devices.sort_by_key(|(_, properties)| {
        (!properties.missing.is_empty(), rank(properties.info.kind))
    });
    Ok(devices)
}

fn rank(kind: vk::PhysicalDeviceType) -> u32 {
    match kind {
        vk::PhysicalDeviceType::DISCRETE_GPU => 0,
        vk::PhysicalDeviceType::INTEGRATED_GPU => 1,
        vk::PhysicalDeviceType::VIRTUAL_GPU => 2,
        vk::PhysicalDeviceType::OTHER => 3,
        _ => 4,
    }
}

/// The wanted candidate (by index, or by part of the name, case ignored), or
/// the first.
pub(crate) fn choose(
    candidates: &[Candidate],
    wanted: Option<&str>,
) -> Result<vk::PhysicalDevice, GpuError> {
    let chosen = match wanted {
        None => candidates.first().ok_or(GpuError::NoDevice)?,
        Some(wanted) => {
            let by_index = wanted.parse::<usize>().ok().and_then(|i| candidates.get(i));
            let lower = wanted.to_lowercase();
            by_index
                .or_else(|| {
                    candidates
                        .iter()
                        .find(|candidate| candidate.name.to_lowercase().contains(&lower))
                })
                .ok_or_else(|| GpuError::NoSuchDevice {
                    wanted: wanted.to_owned(),
                    offered: offered(candidates),
                })?
        }
    };
    if chosen.missing.is_empty() {
        Ok(chosen.handle)
    } else {
        Err(GpuError::Unsuitable {
            device: chosen.name.clone(),
            missing: chosen.missing.join(", "),
        })
    }
}

fn offered(candidates: &[Candidate]) -> String {
    candidates
        .iter()
        .enumerate()
        .map(|(index, candidate)| format!("{index} \"{}\"", candidate.name))
        .collect::<Vec<_>>()
        .join(", ")
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
    use super::*;
    use ash::vk::Handle;

    fn candidates() -> Vec<Candidate> {
        ["Big Card", "Old Card", "llvmpipe"]
            .into_iter()
            .enumerate()
            .map(|(i, name)| Candidate {
                handle: vk::PhysicalDevice::from_raw(i as u64 + 1),
                name: name.to_owned(),
                kind: vk::PhysicalDeviceType::OTHER,
                missing: if i == 1 {
                    vec!["Vulkan 1.3".to_owned()]
                } else {
                    Vec::new()
                },
            })
            .collect()
    }

    #[test]
    fn device_by_index_part_of_name_or_first() {
        let all = candidates();
        assert_eq!(choose(&all, None).unwrap().as_raw(), 1);
        assert_eq!(choose(&all, Some("2")).unwrap().as_raw(), 3);
        assert_eq!(choose(&all, Some("LLVM")).unwrap().as_raw(), 3);
    }

    #[test]
    fn refusals_name_the_remedy() {
        let all = candidates();
        let message = choose(&all, Some("Radeon")).unwrap_err().to_string();
        assert!(
            message.contains("Radeon") && message.contains("2 \"llvmpipe\""),
            "{message}"
        );
        let message = choose(&all, Some("old")).unwrap_err().to_string();
        assert!(
            message.contains("Vulkan 1.3") && message.contains("update"),
            "{message}"
        );
        let message = choose(&[], None).unwrap_err().to_string();
        assert!(message.contains("mesa-vulkan-drivers"), "{message}");
    }
}
