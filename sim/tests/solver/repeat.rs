//! Same start, same bits.

use crate::common::*;
use glam::{DVec3, Quat, Vec3};
use vitriol_gpu::Gpu;
use vitriol_sim::parameters::Parameters;
use vitriol_sim::pose::Pose;
use vitriol_sim::solver::{Solver, SolverError, SolverState};
use vitriol_tests::gpu;

/// Water in a glass that is tilted and shaken, with drops around it.
fn scene() -> Setup {
    let mut particles = water(&narrow_glass(), 0, pose_at(0), 700);
    particles.extend((0..100).map(|i| {
        let site = DVec3::new((i % 5).into(), (i / 25).into(), (i / 5 % 5).into());
        drop_at(DVec3::new(0.03, 0.05, 0.0) + site * D, DVec3::ZERO)
    }));
    let p = Parameters {
        carry: 0.005,
        substeps: 8,
        ..parameters()
    };
    Setup::new(p, vec![narrow_glass()], particles)
}

fn pose_at(frame: u32) -> Pose {
    let t = frame as f32 / 90.0;
    let position = Vec3::new(0.02 * (40.0 * t).sin(), 0.01, 0.0);
    Pose::new(position, Quat::from_rotation_z(2.0 * t))
}

fn run(gpu: &Gpu, solver: &Solver, frames: std::ops::Range<u32>) -> SolverState {
    for n in frames {
        frame(gpu, solver, &[pose_at(n)], &[pose_at(n + 1)]);
    }
    solver.snapshot().unwrap()
}

#[test]
fn same_scene_twice_gives_the_same_bits() {
    let device = gpu::device();
    let states: Vec<_> = [Some(1), Some(1), None, None]
        .into_iter()
        .map(|lanes| {
            let solver = Setup { lanes, ..scene() }.solver(&device);
            run(&device, &solver, 0..20)
        })
        .collect();
    assert_eq!(states[0].hash(), states[1].hash());
    assert!(states[0] == states[1], "the list differs");
    assert_eq!(states[2].hash(), states[3].hash());
    // One bit of one particle is another run.
    let mut other = scene();
    let moved = &mut other.particles[300].position;
    moved.x = f64::from((moved.x as f32).next_up());
    let other = run(&device, &other.solver(&device), 0..20);
    assert_ne!(states[0].hash(), other.hash());
}

/// Lanes part a particle's neighbours among invocations: other sums, the
/// same liquid.
#[test]
fn lanes_change_nothing_but_rounding() {
    let device = gpu::device();
    if !device.info().features.subgroups {
        eprintln!("this device has no subgroup operations: it has one lane only");
        return;
    }
    let of = |lanes: u32| {
        let solver = Setup {
            lanes: Some(lanes),
            ..scene()
        }
        .solver(&device);
        particles(&run(&device, &solver, 0..1))
    };
    let one = of(1);
    for lanes in [2, 4, 8] {
        let several = of(lanes);
        let error = one.iter().zip(&several);
        let error = error.map(|(a, b)| a.position.distance(b.position));
        let error = error.fold(0.0, f64::max);
        // 8 substeps of rounding, see `against_reference`.
        assert!(error < 5e-7, "{lanes}: {error} m");
    }
}

#[test]
fn state_on_a_new_device_goes_on_with_the_same_bits() {
    let device = gpu::device();
    let setup = scene();
    let solver = setup.solver(&device);
    let middle = run(&device, &solver, 0..9);
    let end = run(&device, &solver, 9..20);
    let bytes = postcard::to_allocvec(&middle).unwrap();
    drop(solver);

    let device = gpu::another_device(|_| {});
    let solver = setup.solver(&device);
    let stored: SolverState = postcard::from_bytes(&bytes).unwrap();
    solver.restore(&stored).unwrap();
    assert_eq!(solver.snapshot().unwrap().hash(), middle.hash());
    let resumed = run(&device, &solver, 9..20);
    assert_eq!(resumed.hash(), end.hash());
    // The list and what was counted go on, too.
    assert!(resumed == end);
    assert!(middle.hash() != end.hash());
}

#[test]
fn state_of_another_scene_is_refused() {
    let device = gpu::device();
    let state = scene().solver(&device).snapshot().unwrap();
    let mut fewer = scene();
    fewer.particles.pop();
    let refused = fewer.solver(&device).restore(&state);
    assert!(
        matches!(
            refused,
            Err(SolverError::OtherState {
                found: 800,
                expected: 799,
                ..
            })
        ),
        "{refused:?}"
    );
}
