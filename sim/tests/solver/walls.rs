//! Nothing acts or passes through glass, table and floor.

use crate::common::*;
use glam::{DVec2, DVec3};
use vitriol_sim::flask::particles::sample;
use vitriol_sim::flask::{PlaneMap, Profile, Side, VolumeMap};
use vitriol_sim::parameters::{Parameters, Relaxation};
use vitriol_sim::pose::Pose;
use vitriol_sim::scene::TableTop;
use vitriol_sim::solver::{Ground, Particle};
use vitriol_tests::gpu;

/// Glass of half a millimetre, so that what is on its two sides is well
/// within h.
fn thin_glass() -> Profile {
    Profile::new(&[[0.0, 0.010], [0.025, 0.010]], 0.0005).unwrap()
}

/// Two of them that touch.
const POSES: [Pose; 2] = [
    Pose::from_position(glam::Vec3::new(0.0, 0.0, 0.0)),
    Pose::from_position(glam::Vec3::new(0.021, 0.0, 0.0)),
];

/// Water that reaches up to the wall.
fn full(flask: usize) -> Vec<Particle> {
    let mut particles = water(&thin_glass(), flask, POSES[flask], 200);
    let axis = f64::from(POSES[flask].position.x);
    for p in &mut particles {
        let out = DVec2::new(p.position.x - axis, p.position.z);
        let scale = (0.0092 / out.length()).min(1.22);
        p.position.x = axis + scale * out.x;
        p.position.z = scale * out.y;
    }
    particles
}

/// The first glass alone, beside a full one, and with drops on its outside:
/// the same liquid. Not the same bits: what else there is changes when the
/// list is rebuilt, and with it the order of the sums.
#[test]
fn glasses_that_touch_do_not_feel_each_other() {
    let device = gpu::device();
    let p = Parameters {
        viscosity: 0.5,
        carry_rate: 5.4,
        ..parameters()
    };
    let first = full(0);
    let second = full(1);
    let outside: Vec<_> = (0..12)
        .map(|i| {
            let angle = 1.0 + f64::from(i) * 0.37;
            let out = DVec3::new(angle.cos(), 0.0, angle.sin());
            drop_at(
                out * 0.0108 + DVec3::Y * (0.003 + 0.5 * D * f64::from(i)),
                DVec3::ZERO,
            )
        })
        .collect();
    let solids = vec![sample(&thin_glass(), 0.5 * D, H); 2];
    // Solids throw back particles as near to them as this, further than lists
    // reach: relaxed less, they take their time.
    let gently = Parameters {
        relaxation: Relaxation::Jacobi { omega: 0.01 },
        carry_rate: 0.0,
        ..p.clone()
    };
    let run = |groups: &[&[Particle]], solids: Option<&[Vec<_>]>, glasses: usize| {
        let p = if solids.is_some() { &gently } else { &p };
        let setup = Setup {
            solids: solids.map(|solids| solids[..glasses].to_vec()),
            ..Setup::new(p.clone(), vec![thin_glass(); glasses], groups.concat())
        };
        let solver = setup.solver(&device);
        frames(&device, &solver, &POSES[..glasses], 2);
        let state = solver.snapshot().unwrap();
        assert_eq!(solver.counters().unwrap().list_limited, 0);
        let density = densities(&device, &solver);
        let mut by_identity = vec![0.0; density.len()];
        for (slot, tag) in state.tags.iter().enumerate() {
            by_identity[tag[1] as usize] = density[slot];
        }
        (particles(&state), by_identity)
    };
    let near = |a: &[Particle], b: &[Particle]| {
        let pairs = a.iter().flat_map(|a| b.iter().map(move |b| (a, b)));
        pairs
            .filter(|(a, b)| a.position.distance(b.position) < 0.8 * H)
            .count()
    };
    let facing = [near(&first, &second), near(&first, &outside)];
    assert!(facing[0] > 5 && facing[1] > 5, "{facing:?}");
    for solids in [None, Some(&solids[..])] {
        let (alone, alone_density) = run(&[&first], solids, 1);
        for others in [[&second[..], &[]], [&[], &outside], [&second, &outside]] {
            let (beside, beside_density) = run(&[&first, others[0], others[1]], solids, 2);
            for i in 0..first.len() {
                // 24 substeps' growth of rounding; a neighbour through the glass
                // would be felt by a hundredth of d at once.
                let error = alone[i].position.distance(beside[i].position);
                assert!(error < 1e-5, "{i} is off by {error} m");
                let error = (alone_density[i] - beside_density[i]).abs();
                assert!(error < 1e-3, "{i}'s density is off by {error}");
                assert_eq!(beside[i].flask, Some(0));
            }
        }
    }
}

/// Glass that moves along itself drags the liquid that touches it: by V of that glass
/// and its velocity, or v_max where that is less; from inside, from outside,
/// and between two that move against each other. Floors hold.
#[test]
fn moving_glass_drags_from_either_side_up_to_v_max() {
    let device = gpu::device();
    let profile = narrow_glass();
    let (time, max_speed) = (1e-4, 8.0);
    let p = Parameters {
        gravity: [0.0; 3],
        frame_time: time,
        max_speed,
        viscosity: 0.9,
        ..single_substeps()
    };
    // 1 mm of air between the two.
    let before = [at(0.0, 0.0, 0.0), at(0.031, 0.0, 0.0)];
    let lone = |x: f64, flask| Particle {
        flask,
        ..drop_at(DVec3::new(x, 0.03, 0.0), DVec3::ZERO)
    };
    let floored = drop_at(DVec3::new(0.2, -0.05 + 0.3 * H, 0.0), DVec3::X);
    let start = [
        lone(-0.013 + 0.3 * H, Some(0)),
        lone(-0.015 - 0.3 * H, None),
        lone(0.0155, None),
        floored,
    ];
    let share = p.substep_viscosity();
    let volume = |side, r| VolumeMap::new(&profile, side, H).sample(r, 0.03).volume;
    let inside = volume(Side::Inside, 0.013 - 0.3 * H);
    let outside = volume(Side::Outside, 0.015 + 0.3 * H);
    let between = volume(Side::Outside, 0.0155);
    let floor = PlaneMap::new(H).volume(0.3 * H);
    assert!(inside > 0.1 && outside > 0.1 && between > 0.1);
    for (speed, other) in [(2.0, -1.0), (40.0, -1.0)] {
        let setup = Setup {
            ground: Ground {
                floor: -0.05,
                ..NOWHERE
            },
            ..Setup::new(p.clone(), vec![profile.clone(); 2], start.to_vec())
        };
        let solver = setup.solver(&device);
        let moved = |pose: Pose, speed: f64| {
            Pose::from_position(pose.position + glam::Vec3::Y * (speed * time) as f32)
        };
        let after = [moved(before[0], speed), moved(before[1], other)];
        frame(&device, &solver, &before, &after);
        let found = particles(&solver.snapshot().unwrap());
        let dragged = f64::min(speed, max_speed);
        let expected = [
            DVec3::Y * (share * inside * dragged),
            DVec3::Y * (share * outside * dragged),
            DVec3::Y * (share * between * (dragged + other)),
            DVec3::X * (1.0 - share * floor),
        ];
        for (i, (found, expected)) in found.iter().zip(expected).enumerate() {
            // Places of 0.03 m, rounded to 2 nm, over 0.1 ms.
            let error = found.velocity.distance(expected);
            assert!(
                error < 2e-4,
                "{i} at {speed}: {} for {expected}",
                found.velocity
            );
        }
    }
}

const TABLE: Ground = Ground {
    floor: -0.03,
    table: Some((0.0, DVec2::new(-0.06, 0.0), DVec2::new(0.2, 0.2))),
    scale: 0.2,
};

/// The table's underside, 8 mm below its top.
const UNDER: f64 = -TableTop::THICKNESS * TABLE.scale;

/// A block of water falls half on the table, half past its edge to the floor,
/// 30 mm below.
#[test]
fn table_and_floor_hold() {
    let device = gpu::device();
    let block: Vec<_> = (0..600)
        .map(|i| {
            let site = DVec3::new((i % 10).into(), (i / 100).into(), (i / 10 % 10).into());
            let position = DVec3::new(0.025, 0.004, -0.0125) + site * D;
            drop_at(position, DVec3::NEG_Y)
        })
        .collect();
    let setup = Setup {
        ground: TABLE,
        ..Setup::new(parameters(), Vec::new(), block)
    };
    let solver = setup.solver(&device);
    let in_table = |p: &Found| {
        let aside = (DVec2::new(p.position.x, p.position.z) - DVec2::new(-0.06, 0.0)).abs();
        let over = aside.x < 0.1 - 1e-5 && aside.y < 0.1 - 1e-5;
        over && p.position.y < 0.0 && p.position.y > UNDER + 1e-5
    };
    for _ in 0..30 {
        frames(&device, &solver, &[], 1);
        let found = particles(&solver.snapshot().unwrap());
        for (i, p) in found.iter().enumerate() {
            assert!(p.present && p.position.is_finite());
            assert!(
                p.position.y > -0.03,
                "{i} is under the floor at {}",
                p.position
            );
            assert!(!in_table(p), "{i} is in the table at {}", p.position);
        }
    }
    let found = particles(&solver.snapshot().unwrap());
    let on_table = found.iter().filter(|p| p.position.y > 0.0).count();
    let on_floor = found.iter().filter(|p| p.position.y < UNDER).count();
    assert!(on_table > 100 && on_floor > 100, "{on_table} {on_floor}");
}

/// Drops that fly at the table's edge from the side, over its top, and up at
/// its underside.
#[test]
fn a_table_is_solid_from_all_sides() {
    let device = gpu::device();
    let flying = |y: f64, z: f64, velocity: DVec3| drop_at(DVec3::new(0.042, y, z), velocity);
    let rising = |x: f64| drop_at(DVec3::new(x, UNDER - 0.004, 0.0), DVec3::Y * 3.0);
    let drops = [
        flying(-0.003, 0.00, DVec3::NEG_X * 3.0),
        flying(-0.001, 0.02, DVec3::NEG_X * 3.0),
        flying(0.001, 0.04, DVec3::NEG_X * 3.0),
        rising(0.020),
        rising(-0.060),
    ];
    let p = Parameters {
        gravity: [0.0; 3],
        ..parameters()
    };
    let setup = Setup {
        ground: TABLE,
        ..Setup::new(p, Vec::new(), drops.to_vec())
    };
    let solver = setup.solver(&device);
    frames(&device, &solver, &[], 2);
    let found = particles(&solver.snapshot().unwrap());
    // The edge is at 40 mm; in two frames they would fly 67.
    assert!(found[0].position.x >= 0.04 - 1e-6, "{}", found[0].position);
    assert!(found[1].position.x >= 0.04 - 1e-6, "{}", found[1].position);
    assert!(found[2].position.x < 0.0, "{}", found[2].position);
    // They start 4 mm below the underside, and fly 2.8 mm a substep.
    for (drop, x) in found[3..].iter().zip([0.020, -0.060]) {
        let off = drop.position.distance(DVec3::new(x, UNDER, 0.0));
        assert!(drop.position.y <= UNDER && off < 1e-5, "{}", drop.position);
    }
}
