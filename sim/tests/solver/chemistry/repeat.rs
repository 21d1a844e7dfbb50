//! Same start, same bits, with each chemistry.

use super::setup::*;
use crate::common::*;
use vitriol_sim::chemistry::Chemistry;
use vitriol_sim::chemistry::paper::Boiling;
use vitriol_sim::pose::Pose;
use vitriol_sim::solver::SolverState;
use vitriol_tests::gpu;

fn scene(chemistry: Chemistry, lanes: Option<u32>) -> Setup {
    let particles = glass_of(500, |height| (40.0 + 90.0 * height, 0.9 * (1.0 - height)));
    let p = with(chemistry, parameters());
    Setup {
        lanes,
        ..Setup::new(p, vec![narrow_glass()], particles)
    }
}

fn chemistries() -> [Chemistry; 2] {
    let boils = anti_viscosity(Boiling::Power);
    [
        paper(Some(dilution()), Some(boils)),
        Chemistry::Physical(everything()),
    ]
}

#[test]
fn same_scene_twice_gives_the_same_bits() {
    let device = gpu::device();
    for chemistry in chemistries() {
        for lanes in [Some(1), None] {
            let states = [0, 1].map(|_| {
                let solver = scene(chemistry.clone(), lanes).solver(&device);
                frames(&device, &solver, &[Pose::IDENTITY], 4);
                solver.snapshot().unwrap()
            });
            assert_eq!(states[0].hash(), states[1].hash());
            // The ledger, rounding remainders and counters, too.
            assert!(states[0] == states[1]);
            // A hundredth of a kelvin of one particle is another run; its last
            // bit need not be, as diffusion evens it out.
            let mut other = scene(chemistry.clone(), lanes);
            other.particles[300].temperature += 0.01;
            let solver = other.solver(&device);
            frames(&device, &solver, &[Pose::IDENTITY], 4);
            assert_ne!(states[0].hash(), solver.snapshot().unwrap().hash());
        }
    }
}

#[test]
fn state_on_a_new_device_goes_on_with_the_same_bits() {
    for chemistry in chemistries() {
        let device = gpu::device();
        let setup = scene(chemistry, Some(1));
        let solver = setup.solver(&device);
        frames(&device, &solver, &[Pose::IDENTITY], 2);
        let middle = solver.snapshot().unwrap();
        frames(&device, &solver, &[Pose::IDENTITY], 3);
        let end = solver.snapshot().unwrap();
        let bytes = postcard::to_allocvec(&middle).unwrap();
        drop(solver);
        let device = gpu::another_device(|_| {});
        let solver = setup.solver(&device);
        let stored: SolverState = postcard::from_bytes(&bytes).unwrap();
        solver.restore(&stored).unwrap();
        assert_eq!(solver.snapshot().unwrap().hash(), middle.hash());
        frames(&device, &solver, &[Pose::IDENTITY], 3);
        let resumed = solver.snapshot().unwrap();
        assert_eq!(resumed.hash(), end.hash());
        assert!(resumed == end);
    }
}

/// A replay must repeat temperature and contents too.
#[test]
fn hash_is_of_heat_and_contents() {
    let device = gpu::device();
    for chemistry in chemistries() {
        let physical = matches!(chemistry, Chemistry::Physical(_));
        let state = scene(chemistry, Some(1))
            .solver(&device)
            .snapshot()
            .unwrap();
        let changed = |change: &dyn Fn(&mut SolverState)| {
            let mut other = state.clone();
            change(&mut other);
            other.hash()
        };
        assert_eq!(changed(&|_| ()), state.hash());
        assert_ne!(changed(&|s| s.heat[7][0] += 1e-5), state.hash());
        assert_ne!(changed(&|s| s.heat[7][1] += 1e-6), state.hash());
        if physical {
            assert_ne!(changed(&|s| s.matter[7][1] += 0.1), state.hash());
        }
    }
}
