//! Drops that came to rest: where a look lists them.

use crate::census::{look, over_all};
use crate::chemistry::bubbles::of;
use crate::chemistry::setup::bubbly;
use crate::chemistry::spray::spraying;
use crate::common::*;
use glam::Vec3;
use vitriol_shaders::layout::Drops;
use vitriol_sim::flask::Profile;
use vitriol_sim::pose::Pose;
use vitriol_sim::solver::Onto;
use vitriol_tests::gpu;

/// Drops of a bubble that fall on the table are listed once, where they lie.
#[test]
fn drops_that_fall_on_the_table_are_listed_where_they_lie() {
    let device = gpu::device();
    let profile = Profile::new(&[[0.0, 0.025], [0.06, 0.025]], 0.002).unwrap();
    let liquid = water(&profile, 0, at(0.0, 0.0, 0.0), 300);
    let mut setup = Setup::new(of(spraying(bubbly()), parameters()), vec![profile], liquid);
    over_all(&mut setup);
    let solver = setup.solver(&device);
    let mut state = solver.snapshot().unwrap();
    state.drops_mut()[4] = Drops {
        position: [0.045, 0.03, 0.02],
        velocity: [0.0, -1.0, 0.0],
        mass: 0.01,
        acid: 0.008,
        radius: 1e-4,
        density: 1500.0,
        memberships: 1,
        ..Drops::default()
    };
    solver.restore(&state).unwrap();
    look(&device, &solver, &[]);
    let mut landed = Vec::new();
    for _ in 0..12 {
        frames(&device, &solver, &[Pose::IDENTITY], 1);
        landed.extend(look(&device, &solver, &[]).landed);
    }
    assert_eq!(landed.len(), 1, "{landed:?}");
    let drop = landed[0];
    assert_eq!((drop.onto, drop.temperature), (Onto::Table, None));
    let place = Vec3::new(0.045, -0.004, 0.02);
    assert!(drop.position.distance(place) < 1e-4, "{drop:?}");
    assert!((drop.acid - 0.8).abs() < 1e-3, "{drop:?}");
    let volume = drop.volume / setup.parameters.particle_volume();
    assert!((volume - 0.01 / 1.5).abs() < 1e-4, "{volume}");
}
