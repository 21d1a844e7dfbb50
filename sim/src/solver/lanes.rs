//! How many invocations share a particle, or a bubble.

use vitriol_gpu::{Gpu, vk};

/// On a GPU with more units than a small scene has particles, several
/// invocations share a particle's neighbours and the latency of fetching
/// them; a software driver has no idle units.
pub(super) fn of_particles(gpu: &Gpu, count: u32) -> u32 {
    let info = gpu.info();
    if info.kind == vk::PhysicalDeviceType::CPU || !info.features.subgroups {
        1
    } else if count <= 32_768 {
        8
    } else if count <= 131_072 {
        4
    } else {
        1
    }
}

/// Most invocations that share a bubble, as it looks into 27 cells or more.
const MOST_LANES: u32 = 32;

/// Invocations that share a bubble where `lanes` share a particle: more, as bubbles are few.
pub(super) fn of_bubbles(gpu: &Gpu, lanes: u32) -> u32 {
    if lanes == 1 {
        return 1;
    }
    let subgroup = gpu.info().least_subgroup_size.min(MOST_LANES);
    (1 << subgroup.max(1).ilog2()).max(lanes)
}
