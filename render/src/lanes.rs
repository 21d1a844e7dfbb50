//! How many invocations share a particle, and the dispatches of such passes.

use vitriol_gpu::{DeviceInfo, vk};

use crate::RenderError;

/// Invocations that share a particle's neighbours on a GPU: for a few ten thousand particles the latency of fetching the list dominates
/// there.
const SHARED_BY: u32 = 4;

/// Most lanes that the shader adds up, see `common/liquid/lane_sums.wgsl`.
const MOST_OF_NEIGHBOURS: u32 = 32;

/// Invocations that share an ellipsoid's pixels: a warp on a GPU, eight lanes of a vector on a CPU.
const SPLATTED_BY: [u32; 2] = [32, 8];

/// Invocations that share a sphere: on a CPU eight lanes of a vector; on a GPU at least a warp, and for few spheres so many more that all
/// of them together fill it.
const LEAST_OF_SPHERE: [u32; 2] = [32, 8];
const MOST_OF_SPHERE: [u32; 2] = [1024, 8];
const FILLS: u32 = 1 << 17;

/// Rows of pixels are shared eight by eight.
const LEAST_OF_PIXELS: u32 = 8;
const MOST_OF_PIXELS: u32 = 1024;

/// Lanes for a particle's neighbours: `asked`, or as many as suit the device.
pub(crate) fn of_neighbours(info: &DeviceInfo, asked: Option<u32>) -> Result<u32, RenderError> {
    let most = most_of_neighbours(info);
    match asked {
        Some(asked) => refuse("neighbours", asked, 1, most),
        None if is_cpu(info) => Ok(1),
        None => Ok(SHARED_BY.min(most)),
    }
}

/// Lanes for an ellipsoid's pixels: `asked`, or as many as suit the device.
pub(crate) fn of_splats(info: &DeviceInfo, asked: Option<u32>) -> Result<u32, RenderError> {
    match asked {
        Some(asked) => refuse("pixels", asked, LEAST_OF_PIXELS, MOST_OF_PIXELS),
        None => Ok(SPLATTED_BY[usize::from(is_cpu(info))]),
    }
}

/// Lanes for the pixels of each of `count` spheres: `asked`, which [`of_splats`] must have accepted, or as many as suit the device.
pub(crate) fn of_spheres(info: &DeviceInfo, asked: Option<u32>, count: u32) -> u32 {
    let of_device = |lanes: [u32; 2]| lanes[usize::from(is_cpu(info))];
    let share = (FILLS / count.max(1)).next_power_of_two();
    let chosen = share.clamp(of_device(LEAST_OF_SPHERE), of_device(MOST_OF_SPHERE));
    asked.unwrap_or(chosen)
}

fn is_cpu(info: &DeviceInfo) -> bool {
    info.kind == vk::PhysicalDeviceType::CPU
}

/// Most lanes whose shuffles stay within a subgroup, of which the driver may choose the smallest.
fn most_of_neighbours(info: &DeviceInfo) -> u32 {
    if !info.features.subgroups {
        return 1;
    }
    let least = info.least_subgroup_size.clamp(1, MOST_OF_NEIGHBOURS);
    1 << least.ilog2()
}

fn refuse(of: &'static str, asked: u32, least: u32, most: u32) -> Result<u32, RenderError> {
    if asked.is_power_of_two() && (least..=most).contains(&asked) {
        return Ok(asked);
    }
    Err(RenderError::Lanes {
        of,
        asked,
        least,
        most,
    })
}

/// Workgroups in a row along x, which every device takes; as in `common/picture/lanes.wgsl`.
const ROW: u32 = 65_535;

/// Workgroups of 64 for `count` particles of `lanes` invocations each, for every view.
pub(crate) fn workgroups(count: u32, lanes: u32, views: u32) -> [u32; 3] {
    let groups = (u64::from(count) * u64::from(lanes)).div_ceil(64);
    let rows = groups.div_ceil(ROW.into()) as u32;
    [groups.min(ROW.into()) as u32, views, rows]
}

#[cfg(test)]
mod tests {
    use super::workgroups;

    #[test]
    fn every_particle_has_its_lanes_and_no_row_is_too_long() {
        for (count, lanes) in [(0, 32), (1, 8), (13_894, 8), (131_070, 32), (1_000_000, 32)] {
            let [x, _, z] = workgroups(count, lanes, 2);
            assert!(x <= 65_535, "{count}");
            let held = u64::from(x) * u64::from(z) * 64;
            assert!(held >= u64::from(count) * u64::from(lanes), "{count}");
        }
        assert_eq!(workgroups(13_894, 32, 2), [6947, 2, 1]);
    }
}
