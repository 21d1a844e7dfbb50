//! Drops that came to rest: where a look lists them.

use crate::census::{look, with_a_drop};
use crate::common::*;
use glam::Vec3;
use vitriol_shaders::layout::Drops;
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

/// A drop that flies against the outside of a glass is listed once, where it lies in the glass's frame: on one that stands, and on one that
/// comes to meet it by 2 mm a frame.
#[test]
fn drops_that_fly_against_glass_are_listed_on_it() {
    let device = gpu::device();
    for step in [0.0_f32, 0.002] {
        let (setup, solver) = with_a_drop(&device, [0.06, 0.03, 0.0], [-3.0, 0.0, 0.0]);
        look(&device, &solver, &[]);
        let pose = |n: u32| [Pose::from_position(step * n as f32 * Vec3::X)];
        let mut landed = Vec::new();
        for n in 0..12 {
            frame(&device, &solver, &pose(n), &pose(n + 1));
            landed.extend(look(&device, &solver, &[]).landed);
        }
        assert_eq!(landed.len(), 1, "{landed:?}");
        let drop = landed[0];
        assert_eq!(drop.onto, Onto::Flask(0));
        let radius = setup.flasks[0].outer_radius() as f32;
        let out = drop.position.with_y(0.0).length();
        assert!((out - radius).abs() < 1e-4, "{drop:?}");
        // Without the air it falls by 0.5 to 0.6 mm on the way, with it by up to 0.3 mm more.
        let time = (0.06 - radius) / (3.0 + 90.0 * step);
        let place = Vec3::new(radius, 0.03 - 0.5 * 9.81 * time * time, 0.0);
        assert!(drop.position.distance(place) < 5e-4, "{drop:?}, {place}");
        let volume = drop.volume / setup.parameters.particle_volume();
        assert!((volume - 0.01 / 1.5).abs() < 1e-4, "{volume}");
        assert!((drop.acid - 0.8).abs() < 1e-4, "{drop:?}");
    }
}

/// A drop that falls into a glass and flies against its inside is on no flask's outside.
#[test]
fn drops_that_fly_against_the_inside_of_glass_are_not_listed() {
    let device = gpu::device();
    let (_, solver) = with_a_drop(&device, [0.0, 0.066, 0.0], [1.0, -1.0, 0.0]);
    look(&device, &solver, &[]);
    for _ in 0..12 {
        frames(&device, &solver, &[Pose::IDENTITY], 1);
        assert_eq!(look(&device, &solver, &[]).landed, []);
    }
    let drops = solver.snapshot().unwrap().drops()[4];
    assert!(drops.mass == 0.0 && drops.fallen[0] > 0.0, "{drops:?}");
    assert_eq!(drops.memberships >> 16, 1);
}

/// Of 80 drops on glass in one look 32 are listed, and the one that falls on the table at the same time is too.
#[test]
fn drops_on_glass_take_no_place_from_others() {
    let device = gpu::device();
    let (_, solver) = with_a_drop(&device, [0.06, 0.03, 0.0], [-3.0, 0.0, 0.0]);
    let mut state = solver.snapshot().unwrap();
    let thrown = state.drops()[4];
    state.drops_mut()[..80].fill(thrown);
    state.drops_mut()[80] = Drops {
        position: [0.045, 0.03, 0.02],
        velocity: [0.0, -3.0, 0.0],
        ..thrown
    };
    solver.restore(&state).unwrap();
    look(&device, &solver, &[]);
    let mut landed = Vec::new();
    for _ in 0..4 {
        frames(&device, &solver, &[Pose::IDENTITY], 1);
        landed.extend(look(&device, &solver, &[]).landed);
    }
    let count = |onto: Onto| landed.iter().filter(|it| it.onto == onto).count();
    assert_eq!([count(Onto::Flask(0)), count(Onto::Table)], [32, 1]);
}
