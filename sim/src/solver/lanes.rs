//! How many invocations share a particle, or a bubble.

use vitriol_gpu::{Gpu, vk};

/// On a GPU with more units than a small scene has particles, several
/// invocations share a particle's neighbours and the latency of fetching
/// them.
pub(super) fn of_particles(gpu: &Gpu, count: u32) -> u32 {
    wanted(count).min(most(gpu))
}

/// Invocations of a workgroup of a pass over neighbours, where `lanes` share a particle. Particles of a workgroup are close together
/// and read the same neighbours from the first cache. Of a million particles on an H200, groups of 64 took 2.61 ms a frame, of 256 2.43;
/// of 37,225 with several lanes, 128 took 1 % less than 64, and 256 4 to 5 % more.
pub(super) fn group(gpu: &Gpu, lanes: u32) -> u32 {
    match (gpu.info().kind, lanes) {
        (vk::PhysicalDeviceType::CPU, _) => 64,
        (_, 1) => 256,
        _ => 128,
    }
}

/// A software driver has no idle units.
fn most(gpu: &Gpu) -> u32 {
    let info = gpu.info();
    match info.kind == vk::PhysicalDeviceType::CPU || !info.features.subgroups {
        true => 1,
        false => within(info.least_subgroup_size),
    }
}

/// Most invocations of a pass over neighbours while a particle has more than one: with fewer a large GPU waits for fetches, with more
/// for what each invocation does beside its neighbours. Of 8,000 to 180,000 particles on an H100 the fastest number of lanes is found so,
/// to within 1 % of a frame (`docs/measurements/performance.md`).
const MOST_SHARING: u32 = 98_000;

fn wanted(count: u32) -> u32 {
    within((MOST_SHARING / count.max(1)).clamp(1, 8))
}

/// Invocations that search one particle's neighbours: 8 on a GPU, fewer where a dispatch would be too large. More candidates are
/// tested than neighbours found, so that it gains by more than its sums do: of 39,888 particles on an H100, 4 took 0.226 ms a frame,
/// 8 0.210 and 16 0.219.
pub(super) fn of_list(gpu: &Gpu, count: u32) -> u32 {
    searching(count).min(most(gpu))
}

/// At most [`MOST_GROUPS`] workgroups of 64.
fn searching(count: u32) -> u32 {
    within((MOST_GROUPS * 64 / count.max(1)).min(8))
}

/// Workgroups that every device takes in a dispatch.
const MOST_GROUPS: u32 = 65_535;

/// Most lanes whose shuffles stay within a subgroup, of which the smallest has so many invocations: a driver may choose any size
/// that it has.
fn within(least_subgroup: u32) -> u32 {
    1 << least_subgroup.max(1).ilog2()
}

/// Most invocations that share a bubble, as it looks into 27 cells or more.
const MOST_LANES: u32 = 32;

/// Invocations that share a bubble where `lanes` share a particle: more, as bubbles are few.
pub(super) fn of_bubbles(gpu: &Gpu, lanes: u32) -> u32 {
    if lanes == 1 {
        return 1;
    }
    within(gpu.info().least_subgroup_size.min(MOST_LANES)).max(lanes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_are_searched_by_as_many_as_a_dispatch_has() {
        assert_eq!([0, 1000, 500_000, 1 << 20].map(searching), [8, 8, 8, 2]);
        for count in [524_280, 524_281, 1_000_000, 4_000_000, 10_000_000] {
            let lanes = searching(count);
            assert!(lanes == 1 || (count * lanes).div_ceil(64) <= MOST_GROUPS);
        }
    }

    #[test]
    fn lanes_do_not_reach_beyond_a_subgroup() {
        let lanes = |count: u32, least: u32| wanted(count).min(within(least));
        assert_eq!(
            [0, 10_000, 24_000, 40_000, 97_336, 1 << 20].map(|count| lanes(count, 32)),
            [8, 8, 4, 2, 1, 1]
        );
        // Some drivers have subgroups of 4, and some report no size.
        assert_eq!(
            [lanes(10_000, 4), lanes(10_000, 1), lanes(10_000, 0)],
            [4, 1, 1]
        );
        assert_eq!(lanes(10_000, 6), 4);
    }
}
