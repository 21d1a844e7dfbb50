//! Same start, same bits, without and with each chemistry.

use crate::chemistry::setup::*;
use crate::common::*;
use glam::{DVec3, Quat, Vec3};
use vitriol_gpu::Gpu;
use vitriol_sim::chemistry::Chemistry;
use vitriol_sim::chemistry::paper::Boiling;
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
        carry_rate: 5.4,
        substeps: 8,
        ..parameters()
    };
    Setup::new(p, vec![narrow_glass()], particles)
}

/// Liquid with each chemistry, all of which has something to do, in a glass that stands.
fn with_chemistries() -> [Setup; 2] {
    let boils = anti_viscosity(Boiling::Power);
    let both = paper(Some(dilution()), Some(boils));
    [both, Chemistry::Physical(everything())].map(|chemistry| {
        let particles = glass_of(500, |height| (40.0 + 90.0 * height, 0.9 * (1.0 - height)));
        let p = with(chemistry, parameters());
        Setup::new(p, vec![narrow_glass()], particles)
    })
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

#[test]
fn each_chemistry_gives_the_same_bits() {
    let device = gpu::device();
    for setup in with_chemistries() {
        for lanes in [Some(1), None] {
            let setup = Setup {
                lanes,
                ..setup.clone()
            };
            let run = |setup: &Setup| {
                let solver = setup.solver(&device);
                frames(&device, &solver, &[Pose::IDENTITY], 4);
                solver.snapshot().unwrap()
            };
            let states = [0, 1].map(|_| run(&setup));
            assert_eq!(states[0].hash(), states[1].hash());
            // The ledger, rounding remainders and counters, too.
            assert!(states[0] == states[1]);
            // A hundredth of a kelvin of one particle is another run; its last
            // bit need not be, as diffusion evens it out.
            let mut other = setup;
            other.particles[300].temperature += 0.01;
            assert_ne!(states[0].hash(), run(&other).hash());
        }
    }
}

/// A rebuild has room for some of a cell's particles. Which those are is chance where more are in a cell, and where others are not.
#[test]
fn a_crowd_in_a_cloud_gives_the_same_bits() {
    let device = gpu::device();
    let mut random = Random(5);
    let all: Vec<_> = (0..400)
        .map(|i| {
            let place = random.point(if i < 150 { 0.004 } else { 0.02 });
            drop_at(place, DVec3::ZERO)
        })
        .collect();
    let setup = Setup::new(parameters(), Vec::new(), all);
    let run = || {
        let solver = setup.solver(&device);
        frames(&device, &solver, &[], 3);
        solver.snapshot().unwrap()
    };
    let first = run();
    let mut known: Vec<_> = first.tags.iter().map(|tag| tag[1]).collect();
    known.sort_unstable();
    assert!(known.into_iter().eq(0..400), "a particle is gone");
    for _ in 0..3 {
        assert!(run() == first);
    }
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

/// Interrupted while a list serves that was built some substeps before: built
/// anew it would have the same pairs in another order.
#[test]
fn state_on_a_new_device_goes_on_with_the_same_bits() {
    let device = gpu::device();
    let mut setup = scene();
    setup.particles.truncate(700);
    setup.parameters.viscosity = 0.3;
    let solver = setup.solver(&device);
    let still = [pose_at(0)];
    let (middle, built) = (0..150)
        .find_map(|_| {
            let state = solver.snapshot().unwrap();
            let built = solver.counters().unwrap().list_rebuilds;
            frames(&device, &solver, &still, 1);
            let serves = solver.counters().unwrap().list_rebuilds == built;
            serves.then_some((state, built))
        })
        .expect("the water comes to rest");
    let end = run(&device, &solver, 0..8);
    drop(solver);

    let (device, solver) = resumed(&setup, &middle);
    frames(&device, &solver, &still, 1);
    assert_eq!(solver.counters().unwrap().list_rebuilds, built);
    let resumed = run(&device, &solver, 0..8);
    assert_eq!(resumed.hash(), end.hash());
    // The list and the counters go on, too.
    assert!(resumed == end);
    assert!(middle.hash() != end.hash());
}

/// Another device, and a solver there that goes on from a state that was stored.
fn resumed(setup: &Setup, state: &SolverState) -> (gpu::Watched, Solver) {
    let bytes = postcard::to_allocvec(state).unwrap();
    let device = gpu::another_device(|_| {});
    let solver = setup.solver(&device);
    let stored: SolverState = postcard::from_bytes(&bytes).unwrap();
    solver.restore(&stored).unwrap();
    assert_eq!(solver.snapshot().unwrap().hash(), state.hash());
    (device, solver)
}

#[test]
fn each_chemistry_goes_on_with_the_same_bits_on_a_new_device() {
    for setup in with_chemistries() {
        let device = gpu::device();
        let solver = setup.solver(&device);
        frames(&device, &solver, &[Pose::IDENTITY], 2);
        let middle = solver.snapshot().unwrap();
        frames(&device, &solver, &[Pose::IDENTITY], 3);
        let end = solver.snapshot().unwrap();
        drop(solver);
        let (device, solver) = resumed(&setup, &middle);
        frames(&device, &solver, &[Pose::IDENTITY], 3);
        let resumed = solver.snapshot().unwrap();
        assert_eq!(resumed.hash(), end.hash());
        assert!(resumed == end);
    }
}

fn hash_of_changed(state: &SolverState, change: &dyn Fn(&mut SolverState)) -> u64 {
    let mut other = state.clone();
    change(&mut other);
    other.hash()
}

#[test]
fn hash_is_of_every_particle_and_not_of_its_slot() {
    let device = gpu::device();
    let state = scene().solver(&device).snapshot().unwrap();
    let changed = |change: &dyn Fn(&mut SolverState)| hash_of_changed(&state, change);
    assert_eq!(changed(&|_| ()), state.hash());
    assert_ne!(changed(&|s| s.positions[700][1] += 1e-6), state.hash());
    assert_ne!(changed(&|s| s.velocities[7][2] = -0.0), state.hash());
    assert_ne!(changed(&|s| s.velocities[7][3] = -1e-9), state.hash());
    assert_ne!(changed(&|s| s.tags[7][0] = 0), state.hash());
    let swapped = changed(&|s| {
        s.positions.swap(3, 70);
        s.velocities.swap(3, 70);
        s.tags.swap(3, 70);
    });
    assert_eq!(swapped, state.hash());
}

/// A replay must repeat temperature and contents too.
#[test]
fn hash_is_of_heat_and_contents() {
    let device = gpu::device();
    for setup in with_chemistries() {
        let physical = matches!(setup.parameters.chemistry, Some(Chemistry::Physical(_)));
        let state = setup.solver(&device).snapshot().unwrap();
        let changed = |change: &dyn Fn(&mut SolverState)| hash_of_changed(&state, change);
        assert_eq!(changed(&|_| ()), state.hash());
        assert_ne!(changed(&|s| s.heat[7][0] += 1e-5), state.hash());
        assert_ne!(changed(&|s| s.heat[7][1] += 1e-6), state.hash());
        if physical {
            assert_ne!(changed(&|s| s.matter[7][1] += 0.1), state.hash());
        }
    }
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
