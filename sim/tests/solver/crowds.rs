//! Crowds: more neighbours than a particle has places in the list.

use crate::chemistry::setup::mixing_alone;
use crate::common::*;
use glam::DVec3;
use std::collections::BTreeSet;
use vitriol_sim::chemistry::{Chemistry, Paper, PaperDilution};
use vitriol_sim::parameters::{Parameters, Relaxation};
use vitriol_sim::solver::{Particle, SolverState};
use vitriol_tests::gpu;

/// Without gravity, each substep a frame.
fn weightless() -> Parameters {
    Parameters {
        gravity: [0.0; 3],
        ..single_substeps()
    }
}

/// `count` at rest in a ball of `radius`, m, at random.
fn ball(random: &mut Random, count: usize, centre: DVec3, radius: f64) -> Vec<Particle> {
    (0..count)
        .map(|_| drop_at(centre + random.point(radius), DVec3::ZERO))
        .collect()
}

/// Balls in which each sees all others. 56 neighbours have a place.
#[test]
fn a_list_that_is_longer_than_its_place_is_whole_and_counted() {
    let device = gpu::device();
    let mut random = Random(2);
    let sizes = [31, 57, 58, 300];
    let centre = |of: usize| DVec3::X * of as f64;
    let all = sizes.iter().enumerate();
    let all = all.flat_map(|(of, &size)| ball(&mut random, size, centre(of), 0.003));
    let mut setup = Setup::new(weightless(), Vec::new(), all.collect());
    for lanes in lanes(&device) {
        setup.lanes = Some(lanes);
        let solver = setup.solver(&device);
        frames(&device, &solver, &[], 1);
        let list = List::of(&solver.snapshot().unwrap());
        for (slot, own) in list.origins.iter().enumerate() {
            let mate = |other: &DVec3| own.distance(*other) < 0.5;
            let near = list.origins.iter().enumerate();
            let near = near.filter(|&(other, at)| other != slot && mate(at));
            let near: BTreeSet<_> = near.map(|(other, _)| other).collect();
            let listed: BTreeSet<_> = list.neighbours[slot].iter().copied().collect();
            assert_eq!(list.neighbours[slot].len(), near.len());
            assert_eq!(listed, near);
        }
        assert_eq!(solver.counters().unwrap().list_overflows, 358);
    }
}

/// Pushes between particles of a crowd balance, because both of a pair know it. Where lists end with their places, 59 % of all momentum is left over.
#[test]
fn a_crowd_keeps_its_momentum() {
    let device = gpu::device();
    let p = Parameters {
        // Corrections so small that none is cut.
        relaxation: Relaxation::Jacobi { omega: 2e-7 },
        ..weightless()
    };
    let mut random = Random(5);
    let mut all = ball(&mut random, 400, DVec3::ZERO, 0.3 * H);
    all.extend(ball(&mut random, 100, DVec3::X * 0.5 * H, H));
    let mut setup = Setup::new(p, Vec::new(), all);
    for lanes in lanes(&device) {
        setup.lanes = Some(lanes);
        let solver = setup.solver(&device);
        frames(&device, &solver, &[], 3);
        let counters = solver.counters().unwrap();
        assert!(counters.list_overflows >= 400, "{counters:?}");
        assert_eq!((counters.list_limited, counters.speed_limited), (0, 0));
        let found = particles(&solver.snapshot().unwrap());
        let momentum: DVec3 = found.iter().map(|p| p.velocity).sum();
        let pushed: f64 = found.iter().map(|p| p.velocity.length()).sum();
        assert!(pushed > 0.0);
        // Rounding: 3e-8.
        let share = momentum.length() / pushed;
        assert!(share < 1e-6, "{lanes} lanes: {share}");
    }
}

/// Long lists take their room in an order of chance; nothing of the state shows it, also where they are too many and none has room.
#[test]
fn crowds_repeat_and_go_on_where_they_were_kept() {
    let device = gpu::device();
    for count in [300, 700] {
        let all = ball(&mut Random(7), count, DVec3::ZERO, 0.1 * H);
        let setup = Setup::new(weightless(), Vec::new(), all);
        let run = |kept: Option<&SolverState>, n: usize| {
            let solver = setup.solver(&device);
            if let Some(state) = kept {
                solver.restore(state).unwrap();
            }
            frames(&device, &solver, &[], n);
            solver.snapshot().unwrap()
        };
        let (half, whole) = (run(None, 2), run(None, 4));
        assert!(whole == run(None, 4), "{count}");
        assert!(whole == run(Some(&half), 2), "{count}");
    }
}

/// In a crowd that no list holds, some pairs are known to one side alone. What such
/// a pair exchanged would come from nowhere.
#[test]
fn full_lists_make_no_acid() {
    let paper = Paper {
        dilution: Some(PaperDilution {
            ambient: 20.0,
            heat_diffusivity: 1e-5,
            acid_diffusivity: 1e-5,
            heat_generation: 0.0,
        }),
        boiling: None,
    };
    let mut physical = mixing_alone();
    physical.mixing.turbulence *= 100.0;
    no_acid_is_made(Chemistry::Paper(paper));
    no_acid_is_made(Chemistry::Physical(physical));
}

fn no_acid_is_made(chemistry: Chemistry) {
    let device = gpu::device();
    let p = Parameters {
        chemistry: Some(chemistry),
        ..weightless()
    };
    let mut random = Random(3);
    // A dense ball in a thin cloud: its edge has whole lists beside full ones.
    let all: Vec<_> = (0..400)
        .map(|i| {
            let place = random.point(if i < 150 { 0.004 } else { 0.02 });
            Particle {
                acid: 0.45 * (1.0 + random.number()),
                ..drop_at(place, DVec3::ZERO)
            }
        })
        .collect();
    let solver = Setup::new(p, Vec::new(), all).solver(&device);
    // Σ mc and Σ mc².
    let sums = || {
        let state = solver.snapshot().unwrap();
        let heat = state.heat.iter().enumerate();
        heat.fold([0.0, 0.0], |[first, second], (slot, heat)| {
            // Of the paper's chemistry all have the same mass.
            let mass = state.matter.get(slot).map_or(1.0, |content| content[3]);
            let (mass, acid) = (f64::from(mass), f64::from(heat[1]));
            [first + mass * acid, second + mass * acid * acid]
        })
    };
    let before = sums();
    frames(&device, &solver, &[], 4);
    let counters = solver.counters().unwrap();
    assert!(counters.list_overflows > 100, "{counters:?}");
    // Rounding of 400 sums in f32.
    let after = sums();
    let drift = (after[0] - before[0]).abs() / before[0];
    assert!(drift < 1e-6, "{drift}");
    // What has whole lists mixes all the same.
    let mixed = (before[1] - after[1]) / before[1];
    assert!(mixed > 1e-5, "{mixed}");
}
