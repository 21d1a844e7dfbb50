//! Limits that the shaders need of a device, beyond those that Vulkan guarantees.

use ash::vk;

/// Limits that a device must have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Needs {
    /// Invocations of a workgroup, in all and along x.
    pub invocations: u32,
    /// Storage buffers of a stage.
    pub storage_buffers: u32,
    /// Bindings of a pipeline, pushed.
    pub bindings: u32,
    /// Bytes of a workgroup's shared memory.
    pub shared_bytes: u32,
    /// Bytes of immediates (push constants).
    pub immediate_bytes: u32,
}

/// Limits that this project's shaders need. Vulkan guarantees 128 invocations, 4 storage buffers, 32 pushed bindings, 16 KiB and 128
/// bytes.
pub const NEEDS: Needs = Needs {
    invocations: 256,
    storage_buffers: 32,
    bindings: 32,
    shared_bytes: 16_384,
    immediate_bytes: 128,
};

/// Limits of [`NEEDS`] that a device lacks, in words.
pub(super) fn lacks(limits: &vk::PhysicalDeviceLimits, bindings: u32) -> Vec<String> {
    let invocations = limits
        .max_compute_work_group_invocations
        .min(limits.max_compute_work_group_size[0]);
    [
        (invocations, NEEDS.invocations, "invocations of a workgroup"),
        (
            limits.max_per_stage_descriptor_storage_buffers,
            NEEDS.storage_buffers,
            "storage buffers of a stage",
        ),
        (bindings, NEEDS.bindings, "pushed bindings of a pipeline"),
        (
            limits.max_compute_shared_memory_size,
            NEEDS.shared_bytes,
            "bytes of shared memory",
        ),
        (
            limits.max_push_constants_size,
            NEEDS.immediate_bytes,
            "bytes of push constants",
        ),
    ]
    .into_iter()
    .filter(|(has, needs, _)| has < needs)
    .map(|(has, needs, what)| format!("{needs} {what} (it has {has})"))
    .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_small_device_lacks_is_said() {
        // Limits that Vulkan guarantees.
        let least = vk::PhysicalDeviceLimits {
            max_compute_work_group_invocations: 128,
            max_compute_work_group_size: [128, 128, 64],
            max_per_stage_descriptor_storage_buffers: 4,
            max_compute_shared_memory_size: 16_384,
            max_push_constants_size: 128,
            ..vk::PhysicalDeviceLimits::default()
        };
        let said = lacks(&least, 32);
        assert_eq!(said.len(), 2, "{said:?}");
        assert_eq!(said[0], "256 invocations of a workgroup (it has 128)");
        let enough = vk::PhysicalDeviceLimits {
            max_compute_work_group_invocations: 256,
            max_compute_work_group_size: [256, 128, 64],
            max_per_stage_descriptor_storage_buffers: 32,
            ..least
        };
        assert!(lacks(&enough, 32).is_empty());
    }
}
