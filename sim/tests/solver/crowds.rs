//! Crowds: more neighbours than a particle has places in the list.

use crate::chemistry::setup::mixing_alone;
use crate::common::*;
use glam::DVec3;
use std::collections::BTreeSet;
use vitriol_sim::chemistry::{Chemistry, Paper, PaperDilution};
use vitriol_sim::kernel::Kernel;
use vitriol_sim::parameters::{Parameters, Relaxation};
use vitriol_sim::pose::Pose;
use vitriol_sim::solver::{Particle, SolverState};
use vitriol_tests::gpu;

/// `count` at rest in a ball of `radius`, m, at random.
fn ball(random: &mut Random, count: usize, centre: DVec3, radius: f64) -> Vec<Particle> {
    (0..count)
        .map(|_| drop_at(centre + random.point(radius), DVec3::ZERO))
        .collect()
}

/// The list after a frame, and the state, by each number of lanes; so many particles have more neighbours than places.
fn lists(mut setup: Setup, poses: &[Pose], longer: u32) -> Vec<(List, SolverState)> {
    let device = gpu::device();
    let list_by = |lanes: u32| {
        setup.lanes = Some(lanes);
        let solver = setup.solver(&device);
        frames(&device, &solver, poses, 1);
        assert_eq!(solver.counters().unwrap().list_overflows, longer);
        let state = solver.snapshot().unwrap();
        (List::of(&state, setup.parameters.list_capacity()), state)
    };
    lanes(&device).into_iter().map(list_by).collect()
}

/// Balls in which each particle has all others as neighbours; 56 neighbours have a place in the list.
#[test]
fn a_list_that_is_longer_than_its_place_is_whole_and_counted() {
    let mut random = Random(2);
    let sizes = [31, 57, 58, 300];
    let centre = |of: usize| DVec3::X * of as f64;
    let all = sizes.iter().enumerate();
    let all = all.flat_map(|(of, &size)| ball(&mut random, size, centre(of), 0.003));
    let setup = Setup::new(weightless(), Vec::new(), all.collect());
    for (list, _) in lists(setup, &[], 358) {
        for (slot, own) in list.origins.iter().enumerate() {
            let mate = |other: &DVec3| own.distance(*other) < 0.5;
            let near = list.origins.iter().enumerate();
            let near = near.filter(|&(other, at)| other != slot && mate(at));
            let near: BTreeSet<_> = near.map(|(other, _)| other).collect();
            let listed: BTreeSet<_> = list.neighbours[slot].iter().copied().collect();
            assert_eq!(list.neighbours[slot].len(), near.len());
            assert_eq!(listed, near);
        }
    }
}

/// 600 particles that are all neighbours need more room than there is for long lists: none has a long list, and each list ends with its
/// places.
#[test]
fn where_long_lists_have_no_room_all_end_with_their_places() {
    let all = ball(&mut Random(4), 600, DVec3::ZERO, 0.003);
    let setup = Setup::new(weightless(), Vec::new(), all);
    for (list, _) in lists(setup, &[], 600) {
        for (slot, own) in list.neighbours.iter().enumerate() {
            let others: BTreeSet<_> = own.iter().filter(|&&other| other != slot).collect();
            assert_eq!((own.len(), others.len()), (56, 56));
        }
    }
}

/// A crowd behind more particles than Mesa's software driver (22.3) gives an invocation turns of its loops. Each particle of the crowd asks
/// about all before it for its place in the order; where that ends early, several get one place, and all but one of them are gone.
#[test]
fn a_crowd_behind_a_large_cloud_loses_no_particle() {
    let (across, crowd) = (41, 150);
    let cloud = (0..across * across * across).map(|n| {
        let site = [n % across, n / across % across, n / (across * across)];
        DVec3::from_array(site.map(f64::from)) * 2.0 * H
    });
    // In the middle of a cell.
    let centre = DVec3::splat(-19.5 * 1.05 * H);
    let mut all: Vec<_> = cloud.map(|site| drop_at(site, DVec3::ZERO)).collect();
    assert!(all.len() > 65_535);
    all.extend(ball(&mut Random(6), crowd, centre, 0.4 * H));
    let count = all.len() as u32;
    let device = gpu::device();
    let solver = Setup::new(weightless(), Vec::new(), all).solver(&device);
    frames(&device, &solver, &[], 1);
    let state = solver.snapshot().unwrap();
    let mut known: Vec<_> = state.tags.iter().map(|tag| tag[1]).collect();
    known.sort_unstable();
    assert!(known.into_iter().eq(0..count), "a particle is gone");
}

/// Two crowds at one wall, within and without, see nothing of each other.
#[test]
fn a_long_list_knows_nothing_behind_glass() {
    let mut random = Random(6);
    let beside = |r: f64| DVec3::new(r, 0.03, 0.0);
    let mut all = ball(&mut random, 80, beside(0.0125), 0.0003);
    for particle in &mut all {
        particle.flask = Some(0);
    }
    all.extend(ball(&mut random, 80, beside(0.0155), 0.0003));
    let setup = Setup::new(weightless(), vec![narrow_glass()], all);
    for (list, state) in lists(setup, &[Pose::IDENTITY], 160) {
        let is_within = |slot: usize| state.tags[slot][1] < 80;
        for (slot, own) in list.neighbours.iter().enumerate() {
            // One lane puts the particle itself where another is hidden.
            let others: BTreeSet<_> = own.iter().filter(|&&other| other != slot).collect();
            assert_eq!(others.len(), 79);
            let mut sides = others.iter().map(|&&other| is_within(other));
            assert!(sides.all(|side| side == is_within(slot)));
        }
    }
}

/// Pushes between particles of a crowd balance, because both of a pair know it. Where lists end with their places, 59 % of all momentum
/// is left over. The density is that of all.
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
        let state = solver.snapshot().unwrap();
        let found = particles(&state);
        let kernel = Kernel::new(H);
        let at = |slot: usize| found[state.tags[slot][1] as usize].position;
        let places: Vec<_> = (0..found.len()).map(at).collect();
        for (own, density) in places.iter().zip(densities(&device, &solver)) {
            let sum: f64 = places
                .iter()
                .map(|other| kernel.w(own.distance(*other)))
                .sum();
            // Sums of 500 floats; lists lack pairs at the kernel's edge.
            assert!((D.powi(3) * sum / density - 1.0).abs() < 1e-5, "{density}");
        }
        let momentum: DVec3 = found.iter().map(|p| p.velocity).sum();
        let pushed: f64 = found.iter().map(|p| p.velocity.length()).sum();
        assert!(pushed > 0.0);
        // Rounding: 3e-8.
        let share = momentum.length() / pushed;
        assert!(share < 1e-6, "{lanes} lanes: {share}");
    }
}

/// Long lists take their room in an order that varies from run to run. The state does not depend on it, even where they need more room
/// than there is and none has any.
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

/// In a crowd whose long lists have no room, some pairs are in one particle's list alone. The exchange of such a pair would not be
/// conserved. Where they have room, such particles exchange nothing either.
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
    for (crowd, radius) in [(150, 0.004), (600, 0.0015)] {
        no_acid_is_made(Chemistry::Paper(paper.clone()), crowd, radius);
        no_acid_is_made(Chemistry::Physical(physical), crowd, radius);
    }
}

fn no_acid_is_made(chemistry: Chemistry, crowd: usize, radius: f64) {
    let device = gpu::device();
    let p = Parameters {
        chemistry: Some(chemistry),
        ..weightless()
    };
    let mut random = Random(3);
    // A dense ball in a thin cloud: its edge has whole lists beside full ones.
    let all: Vec<_> = (0..crowd + 250)
        .map(|i| {
            let place = random.point(if i < crowd { radius } else { 0.02 });
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
    // Rounding of 400 to 850 sums in f32.
    let after = sums();
    let drift = (after[0] - before[0]).abs() / before[0];
    assert!(drift < 1e-6, "{drift}");
    // Particles with complete lists mix all the same.
    let mixed = (before[1] - after[1]) / before[1];
    assert!(mixed > 1e-5, "{mixed}");
}
