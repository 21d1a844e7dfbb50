//! Dispatches of passes in which some invocations share a particle.

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
