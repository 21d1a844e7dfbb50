//! Drops that came to rest: where a look lists them.

use crate::census::{look, with_a_drop};
use crate::common::*;
use glam::Vec3;
use vitriol_sim::pose::Pose;
use vitriol_sim::solver::Onto;
use vitriol_tests::gpu;

/// Drops of a bubble that fall on the table are listed once, where they lie.
#[test]
fn drops_that_fall_on_the_table_are_listed_where_they_lie() {
    let device = gpu::device();
    let (setup, solver) = with_a_drop(&device, [0.045, 0.03, 0.02], [0.0, -1.0, 0.0]);
    look(&device, &solver, &[]);
    let mut landed = Vec::new();
    for _ in 0..12 {
        frames(&device, &solver, &[Pose::IDENTITY], 1);
        landed.extend(look(&device, &solver, &[]).landed);
    }
    assert_eq!(landed.len(), 1, "{landed:?}");
    let drop = landed[0];
    assert_eq!(drop.onto, Onto::Table);
    let place = Vec3::new(0.045, -0.004, 0.02);
    assert!(drop.position.distance(place) < 1e-4, "{drop:?}");
    let volume = drop.volume / setup.parameters.particle_volume();
    assert!((volume - 0.01 / 1.5).abs() < 1e-4, "{volume}");
    assert!((drop.acid - 0.8).abs() < 1e-4, "{drop:?}");
}
