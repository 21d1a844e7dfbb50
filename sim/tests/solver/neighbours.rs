//! The neighbour list, as sets, against brute force in f64.

use crate::common::*;
use glam::DVec3;
use std::collections::BTreeSet;
use vitriol_gpu::Gpu;
use vitriol_sim::flask::Profile;
use vitriol_sim::kernel::Kernel;
use vitriol_sim::pose::Pose;
use vitriol_sim::reference::neighbours::find_by_brute_force;
use vitriol_sim::reference::placement::Motion;
use vitriol_sim::reference::surroundings::{Surroundings, Vessel};
use vitriol_sim::reference::visibility::see_each_other;
use vitriol_sim::solver::Particle;
use vitriol_tests::gpu;

/// Reach of the list: support radius and margin, metres.
const REACH: f64 = 1.05 * H;

/// As [`compare_on`] one lane, and on several the same list, in the same order: sums over it repeat.
fn compare(
    particles: Vec<Particle>,
    flasks: Vec<Profile>,
    poses: &[Pose],
    slack: f64,
) -> (usize, List) {
    let device = gpu::device();
    let mut setup = Setup::new(weightless(), flasks, particles);
    let (pairs, alone) = compare_on(&device, &setup, poses, slack);
    if device.info().features.subgroups {
        for lanes in [2, 4, 8] {
            setup.lanes = Some(lanes);
            let (_, together) = compare_on(&device, &setup, poses, slack);
            let others = together.neighbours.iter().zip(&alone.neighbours);
            let differ = others.filter(|(a, b)| a != b).count();
            assert_eq!(differ, 0, "rows on {lanes} lanes");
        }
    }
    (pairs, alone)
}

/// Runs a substep and compares the list with all pairs of the places that it
/// was built for. Pairs within `slack` (a fraction) of the reach may be in it
/// or not. Returns the number of pairs.
fn compare_on(device: &Gpu, setup: &Setup, poses: &[Pose], slack: f64) -> (usize, List) {
    let solver = setup.solver(device);
    // Which flask a particle is in when the list is built: later it may leave.
    let member_of: Vec<_> = setup.particles.iter().map(|p| p.flask).collect();
    frame(device, &solver, poses, poses);
    let state = solver.snapshot().unwrap();
    let list = List::of(&state, setup.parameters.list_capacity());
    let member_of: Vec<_> = state
        .tags
        .iter()
        .map(|tag| member_of[tag[1] as usize])
        .collect();
    let vessels = setup.flasks.iter().cloned();
    let vessels = vessels.map(|profile| Vessel::with_maps(profile, H));
    let surroundings = Surroundings::new(vessels.collect(), None, None, H);
    let motion: Vec<_> = poses
        .iter()
        .map(|&pose| Motion::of_substep(pose, pose, 0, 1, SUBSTEP))
        .collect();
    let at = &list.origins;
    let visible = |i: usize, j: usize| {
        let (a, b) = ((at[i], member_of[i]), (at[j], member_of[j]));
        see_each_other(&surroundings, &motion, a, b)
    };
    let must = find_by_brute_force(at, REACH * (1.0 - slack), visible);
    let may = find_by_brute_force(at, REACH * (1.0 + slack), visible);
    let mut pairs = 0;
    for (i, own) in list.neighbours.iter().enumerate() {
        let own: BTreeSet<_> = own.iter().copied().collect();
        let must: BTreeSet<_> = must.of(i).collect();
        let may: BTreeSet<_> = may.of(i).collect();
        assert_eq!(own.len(), list.neighbours[i].len(), "{i} has one twice");
        let missed: Vec<_> = must.difference(&own).collect();
        let invented: Vec<_> = own.difference(&may).collect();
        assert!(
            missed.is_empty() && invented.is_empty(),
            "{i} at {}: missed {missed:?}, invented {invented:?}",
            at[i]
        );
        pairs += own.len();
    }
    assert_eq!(solver.counters().unwrap().list_overflows, 0);
    (pairs, list)
}

/// 701 particles, which leave lanes of the last subgroup without one: a dense cloud, one across the corner of eight cells, and
/// some so scattered that cells far apart share a place in the table.
fn cloud(origin: DVec3) -> Vec<Particle> {
    let mut random = Random(5);
    let mut at = |count: usize, size: f64, centre: DVec3| -> Vec<Particle> {
        (0..count)
            .map(|_| drop_at(origin + centre + random.point(size), DVec3::ZERO))
            .collect()
    };
    let mut all = at(400, 0.02, DVec3::ZERO);
    // The table has 16 × 8 × 8 cells of 5.25 mm: a lap away, and half of one.
    all.extend(at(100, 0.01, DVec3::new(16.0 * REACH, -8.0 * REACH, 0.0)));
    all.extend(at(201, 0.3, DVec3::ZERO));
    all
}

#[test]
fn list_is_brute_forces_around_zero_and_below() {
    for origin in [
        DVec3::ZERO,
        DVec3::splat(-0.4),
        DVec3::new(-2.0, 1.0, -0.003),
    ] {
        // A square in f32 is off by 1e-7, cells of coordinates up to 2 m by
        // 350 · 2⁻²³ of one.
        let (pairs, _) = compare(cloud(origin), Vec::new(), &[], 1e-4);
        assert!(pairs > 10_000, "{pairs}");
    }
}

/// Floats around 100 m are 8 µm apart, a three-hundredth of the spacing. The
/// places themselves are rounded to that, once, so the pairs are exact; which
/// cell one is in is not: 17,391 · 2⁻²² of a cell, twice, which only a pair
/// at the end of the margin can notice.
#[test]
fn list_is_brute_forces_100_metres_out() {
    for origin in [DVec3::splat(100.0), DVec3::new(-100.0, 90.0, -100.0)] {
        let (pairs, _) = compare(cloud(origin), Vec::new(), &[], 0.01);
        assert!(pairs > 10_000, "{pairs}");
    }
}

/// Two glasses with thin walls side by side, one of them leaning, full to the
/// rim, with drops around them: which pairs see each other past the glass.
#[test]
fn glass_parts_the_pairs_that_it_stands_between() {
    let thin = Profile::new(&[[0.0, 0.012], [0.02, 0.010]], 0.0005).unwrap();
    let lean = glam::Quat::from_rotation_z(0.2);
    let poses = [
        at(0.0, 0.0, 0.0),
        Pose::new(glam::Vec3::new(0.0262, 0.003, 0.0), lean),
    ];
    let mut random = Random(3);
    let mut particles = Vec::new();
    let placements = poses.map(vitriol_sim::reference::placement::Placement::from);
    while particles.len() < 1050 {
        // A third of them where the first one's rim is.
        let (centre, size) = if random.number() < 0.3 {
            (
                DVec3::new(0.0, 0.0205, 0.0),
                DVec3::new(0.028, 0.006, 0.028),
            )
        } else {
            (
                DVec3::new(0.0131, 0.012, 0.0),
                DVec3::new(0.06, 0.04, 0.035),
            )
        };
        let position = centre + size * random.point(1.0);
        let local = placements.map(|placement| placement.to_flask(position));
        let clear =
            |local: DVec3| thin.signed_distance_glass(local.x.hypot(local.z), local.y) > 1e-4;
        if local.into_iter().all(clear) {
            let inside = |local: DVec3| thin.is_inside(local.x.hypot(local.z), local.y);
            let flask = local.into_iter().position(inside);
            // Some of those below the rim are above it in the prediction,
            // members still.
            let up = if random.number() < 0.3 { 4.0 } else { 0.0 };
            particles.push(Particle {
                position,
                velocity: DVec3::Y * up,
                flask,
                temperature: 20.0,
                acid: 0.0,
                carried: 0.0,
            });
        }
    }
    let members: Vec<_> = particles.iter().map(|p| p.flask).collect();
    let (pairs, list) = compare(particles, vec![thin.clone(), thin], &poses, 1e-4);
    assert!(pairs > 5000, "{pairs}");
    assert!(members.iter().filter(|m| m.is_none()).count() > 200);
    // Glass has parted some: all pairs, blind to it, are more.
    let blind = find_by_brute_force(&list.origins, REACH, |_, _| true);
    let blind: usize = (0..members.len()).map(|i| blind.of(i).count()).sum();
    assert!(blind > pairs + 500, "{blind} {pairs}");
}

/// Two balls of liquid that meet head on, of some 500 particles each.
fn meeting(speed: f64) -> Vec<Particle> {
    let mut all = Vec::new();
    for side in [-1.0, 1.0] {
        for n in 0..1000 {
            let cell = DVec3::new((n % 10) as f64, (n / 10 % 10) as f64, (n / 100) as f64);
            let local = D * (cell - DVec3::splat(4.5));
            if local.length() < 5.0 * D {
                let centre = DVec3::X * (side * 5.6 * D);
                all.push(drop_at(centre + local, DVec3::X * (-side * speed)));
            }
        }
    }
    all
}

/// A list that outlives its substep lacks pairs that have come together since: its margin is less than they may move. What
/// counts is how much of a particle's density they are. A pair is at 0.9 h then at the nearest, where it is 6e-4 of it.
#[test]
fn lists_lack_little_of_the_density() {
    let device = gpu::device();
    let kernel = Kernel::new(H);
    // Lists serve for four to five substeps at the slowest, and for one at the fastest.
    for speed in [0.05, 0.1, 0.3, 1.0] {
        let solver = Setup::new(weightless(), Vec::new(), meeting(speed)).solver(&device);
        let mut lacking = Vec::new();
        for _ in 0..120 {
            frame(&device, &solver, &[], &[]);
            let state = solver.snapshot().unwrap();
            let at: Vec<_> = state
                .positions
                .iter()
                .map(|&[x, y, z, _]| DVec3::new(x.into(), y.into(), z.into()))
                .collect();
            let all = find_by_brute_force(&at, H, |_, _| true);
            lacking.extend(
                List::of(&state, weightless().list_capacity())
                    .neighbours
                    .iter()
                    .enumerate()
                    .map(|(i, own)| {
                        let own: BTreeSet<_> = own.iter().copied().collect();
                        let unknown = all.of(i).filter(|j| !own.contains(j));
                        unknown
                            .map(|j| D.powi(3) * kernel.w(at[i].distance(at[j])))
                            .sum::<f64>()
                    }),
            );
        }
        let most = lacking.iter().fold(0.0, |a: f64, &b| a.max(b));
        let mean = lacking.iter().sum::<f64>() / lacking.len() as f64;
        // 1.3e-4 and 1e-7 at most; with a reach of 0.1 h, 4e-4 and 1.7e-7.
        assert!(
            most < 3e-4 && mean < 1.5e-7,
            "at {speed} m/s {most}, mean {mean}"
        );
    }
}
