//! Passes that are left out while they would change nothing: the same bits as with them, through rest, contact, mixing, boiling and spray.

use super::bubbles::of;
use super::setup::*;
use crate::census::look;
use crate::common::*;
use vitriol_sim::parameters::Parameters;
use vitriol_sim::pose::Pose;
use vitriol_sim::solver::{Dormant, SolverState};
use vitriol_tests::gpu;

/// How far the water falls, m, and frames that end before it is there: it takes 78 ms.
const FALL: f64 = 0.03;
const QUIET: usize = 6;
const FRAMES: usize = 60;

/// Frame after which a state is taken up again, in the midst of boiling.
const RESTORED: usize = 20;

/// Acid of 180 °C in a glass, and cold water that falls into it. All of the built-in scene's chemistry, but more nuclei, so that little
/// liquid boils soon.
fn scene(dormant: bool, lanes: u32) -> Setup {
    let law = bubbling(with_bubbles(), |it| {
        (it.nuclei_spacing, it.most) = (0.005, 1024);
    });
    let p = Parameters {
        dormant,
        ..of(law, parameters())
    };
    let mut particles = glass_of(500, |_| (180.0, 0.98));
    let top = particles.iter().fold(0.0, |a: f64, p| a.max(p.position.y));
    for mut particle in glass_of(100, |_| (20.0, 0.0)) {
        particle.position.y += top + FALL;
        particles.push(particle);
    }
    Setup {
        lanes: Some(lanes),
        ..Setup::new(p, vec![narrow_glass()], particles)
    }
}

fn has_bubbles(state: &SolverState) -> bool {
    let mut bubbles = state.bubbles().iter();
    bubbles.any(|bubble| bubble.mass > 0.0 || bubble.air > 0.0)
}

fn has_spray(state: &SolverState) -> bool {
    let mut drops = state.drops().iter();
    drops.any(|drops| drops.mass > 0.0 || drops.fallen[0] > 0.0)
}

#[test]
fn same_bits_as_with_all_passes() {
    let device = gpu::device();
    for lanes in lanes(&device) {
        let [with, without] = [true, false].map(|dormant| scene(dormant, lanes).solver(&device));
        let mut seen = Vec::new();
        let (mut bubbled, mut sprayed) = (false, false);
        for n in 0..FRAMES {
            let [state, same] = [&with, &without].map(|solver| {
                frames(&device, solver, &[Pose::IDENTITY], 1);
                solver.snapshot().unwrap()
            });
            // All of it, and not its hash alone.
            assert!(state == same, "{lanes} lanes, frame {n}");
            let [look, same] = [&with, &without].map(|solver| look(&device, solver, &[]));
            assert_eq!(look, same, "{lanes} lanes, frame {n}");
            assert_eq!(without.dormant().unwrap(), Dormant::default());
            let dormant = with.dormant().unwrap();
            assert!(!dormant.bubbles || !has_bubbles(&state), "frame {n}");
            assert!(dormant.bubbles || !dormant.looks, "frame {n}");
            bubbled |= has_bubbles(&state);
            sprayed |= has_spray(&state);
            seen.push(dormant);
            if n == RESTORED {
                let memory = with.looks_memory().unwrap();
                with.restore(&state).unwrap();
                with.remember_looks(&memory).unwrap();
                assert_eq!(with.dormant().unwrap(), Dormant::default());
            }
        }
        assert!(bubbled && sprayed, "{bubbled} {sprayed}");
        let (quiet, violent) = seen.split_at(QUIET);
        // Before anything meets, no pass looks for bubbles.
        assert!(quiet.iter().all(|it| it.bubbles && it.looks), "{quiet:?}");
        // The restored state wakes both for a frame; that is not counted.
        let awake =
            |(n, it): (usize, &Dormant)| n + QUIET != RESTORED + 1 && !it.turnover && !it.bubbles;
        assert!(violent.iter().enumerate().any(awake));
    }
}

/// Liquid that has come to rest swaps too little for a limit.
#[test]
fn turnovers_of_calm_liquid_are_dormant() {
    let device = gpu::device();
    let p = of(with_bubbles(), parameters());
    let setup = Setup::new(p, vec![narrow_glass()], glass_of(500, |_| (20.0, 0.98)));
    let solver = setup.solver(&device);
    let calm = (0..FRAMES).position(|_| {
        frames(&device, &solver, &[Pose::IDENTITY], 1);
        let dormant = solver.dormant().unwrap();
        assert!(dormant.bubbles);
        dormant.turnover
    });
    assert!(calm.is_some());
}
