//! A flask that leaps takes its contents with it, and nothing else.

use crate::chemistry::bubbles::{of, quick};
use crate::chemistry::setup::bubbly;
use crate::chemistry::spray::spraying;
use crate::common::*;
use glam::{DQuat, DVec3, Quat, Vec3};
use vitriol_gpu::QueueKind;
use vitriol_shaders::Library;
use vitriol_shaders::layout::Drops;
use vitriol_sim::bodies::{Hand, Leap};
use vitriol_sim::flask::Profile;
use vitriol_sim::pose::Pose;
use vitriol_sim::solver::SolverState;
use vitriol_sim::world::{StepInput, World};
use vitriol_tests::gpu;

/// Across a room and most of a turn, as a user who is recentred.
fn across() -> Pose {
    Pose::new(Vec3::new(1.3, -0.2, 0.7), Quat::from_rotation_y(2.4))
}

/// `v` by a rotation in f64, not by the shader's formula.
fn moved(pose: Pose, v: [f32; 3]) -> (DVec3, DVec3) {
    let turned = DQuat::from_array(pose.orientation.to_array().map(f64::from)).normalize()
        * DVec3::from(v.map(f64::from));
    (turned + pose.position.as_dvec3(), turned)
}

fn xyz(v: [f32; 4]) -> [f32; 3] {
    [v[0], v[1], v[2]]
}

fn near(found: [f32; 3], expected: DVec3, what: &str) {
    let found = DVec3::from(found.map(f64::from));
    // f32 about 2.
    assert!(
        found.distance(expected) < 1e-6,
        "{what}: {found} {expected}"
    );
}

/// Liquid, bubbles and drops of the second of three glasses; those of the first, of none, and empty places stay, bit for bit.
#[test]
fn all_that_is_in_the_flask_moves_and_nothing_else() {
    let device = gpu::device();
    let profile = Profile::new(&[[0.0, 0.025], [0.06, 0.025]], 0.002).unwrap();
    let poses = [at(0.0, 0.0, 0.0), at(0.2, 0.0, 0.0), at(0.4, 0.0, 0.0)];
    let mut particles = water(&profile, 0, poses[0], 300);
    particles.extend(water(&profile, 1, poses[1], 300));
    particles.push(drop_at(DVec3::new(0.2, 0.2, 0.0), DVec3::X));
    for (n, particle) in particles.iter_mut().enumerate() {
        particle.velocity = DVec3::new(0.1, 0.2, -0.3) * (0.01 * n as f64);
    }
    let mut setup = Setup::new(of(spraying(bubbly()), quick()), vec![profile; 3], particles);
    setup.loads = true;
    let solver = setup.solver(&device);
    let mut state = solver.snapshot().unwrap();
    let place = DVec3::new(0.21, 0.01, 0.003);
    for (slot, tag) in [(3, 2), (4, 1), (5, 0)] {
        let motion = [place, DVec3::new(0.0, 0.2, 0.1)];
        state.put_bubble(&setup.parameters, slot, tag, motion, [1e-3, 100.0]);
    }
    // From the first flask's liquid, in the second; the other way round; and a record of none.
    for (slot, memberships, mass) in [
        (8, 1 | (2 << 16), 0.01),
        (9, 2 | (1 << 16), 0.01),
        (10, 1 | (2 << 16), 0.0),
    ] {
        state.drops_mut()[slot] = Drops {
            position: place.as_vec3().to_array(),
            velocity: [0.5, 1.0, 0.0],
            mass,
            memberships,
            ..Drops::default()
        };
    }
    solver.restore(&state).unwrap();
    let before = solver.snapshot().unwrap();
    let leap = Leap {
        flask: 1,
        after_from_before: across(),
    };
    let mut rec = device.recorder(QueueKind::Main).unwrap();
    solver.carry(&mut rec, &leap).unwrap();
    device.submit(rec).unwrap().wait().unwrap();
    let after = solver.snapshot().unwrap();

    let mut count = 0;
    for slot in 0..before.tags.len() {
        assert_eq!(before.tags[slot], after.tags[slot]);
        if before.tags[slot][0] == 2 {
            count += 1;
            let ([x, y], [u, v]) = (
                [&before, &after].map(|state: &SolverState| state.positions[slot]),
                [&before, &after].map(|state: &SolverState| state.velocities[slot]),
            );
            near(xyz(y), moved(across(), xyz(x)).0, "position");
            near(xyz(v), moved(across(), xyz(u)).1, "velocity");
            // Vapour and multiplier.
            assert_eq!((x[3], u[3]), (y[3], v[3]));
        } else {
            assert_eq!(before.positions[slot], after.positions[slot]);
            assert_eq!(before.velocities[slot], after.velocities[slot]);
        }
    }
    assert_eq!(count, 300);
    for (slot, (x, y)) in before.bubbles().iter().zip(after.bubbles()).enumerate() {
        if slot == 3 {
            near(y.position, moved(across(), x.position).0, "bubble");
            near(
                y.velocity,
                moved(across(), x.velocity).1,
                "bubble's velocity",
            );
        } else {
            assert_eq!((x.position, x.velocity), (y.position, y.velocity), "{slot}");
        }
    }
    for (slot, (x, y)) in before.drops().iter().zip(after.drops()).enumerate() {
        if slot == 8 {
            near(y.position, moved(across(), x.position).0, "drops");
            near(y.velocity, moved(across(), x.velocity).1, "drops' velocity");
        } else {
            assert_eq!((x.position, x.velocity), (y.position, y.velocity), "{slot}");
        }
    }

    // Where that flask breaks, its contents belong to no flask and stay where they are, and nothing else changes.
    let mut rec = device.recorder(QueueKind::Main).unwrap();
    solver.release(&mut rec, 1).unwrap();
    device.submit(rec).unwrap().wait().unwrap();
    let free = solver.snapshot().unwrap();
    assert_eq!(free.positions, after.positions);
    assert_eq!(free.velocities, after.velocities);
    let is_free = |tag: u32| if tag == 2 { 0 } else { tag };
    for (was, is) in after.tags.iter().zip(&free.tags) {
        assert_eq!(*is, [is_free(was[0]), was[1]]);
    }
    for (slot, (was, is)) in after.bubbles().iter().zip(free.bubbles()).enumerate() {
        let expected = if slot == 3 { 0 } else { was.membership };
        assert_eq!(
            (is.membership, is.position),
            (expected, was.position),
            "{slot}"
        );
    }
    let slots = after.drops().iter().zip(free.drops()).enumerate();
    for (slot, (was, is)) in slots {
        // From the first flask's liquid, in none.
        let expected = if slot == 8 { 1 } else { was.memberships };
        assert_eq!(
            (is.memberships, is.position),
            (expected, was.position),
            "{slot}"
        );
    }
}

/// A beaker in the hand, recentred, and one that is not. Physics does not depend on place or direction on a level floor, so that
/// both have the same liquid in them, step by step, until rounding has grown.
#[test]
fn the_liquid_does_not_feel_a_leap() {
    let gpu = gpu::device();
    let mut scene = coarse_beaker(110e-6);
    // Surface tension is found on a grid, to which directions are not alike.
    scene.solver.surface_tension = None;
    let world = || World::new(&gpu, &Library::watching(), &scene, 1).unwrap();
    let (mut stays, mut leaps) = (world(), world());
    let stood = stays.poses()[0].position;
    let hand = |step: u32, moved: Pose| {
        // Without acceleration, after the jerk of the beginning: what is foreseen of the hand holds.
        let carried = Vec3::new(0.002, 0.004, 0.0) * step as f32;
        let grip = Pose::from_position(stood + Vec3::new(0.05, 0.05, 0.0) + carried);
        let held = tracked_hand(moved.compose(grip), if step > 0 { 1.0 } else { 0.0 });
        StepInput::of_hands([held, Hand::ABSENT])
    };
    for step in 0..30 {
        stays.step(&hand(step, Pose::IDENTITY)).unwrap();
        leaps.step(&hand(step, Pose::IDENTITY)).unwrap();
    }
    // 0.1 m to the side: slower than a leap that is found without a call.
    let aside = Pose::new(Vec3::new(0.1, 0.05, 0.02), Quat::from_rotation_y(0.3));
    leaps.hands_leap();
    for step in 30..36 {
        stays.step(&hand(step, Pose::IDENTITY)).unwrap();
        leaps.step(&hand(step, aside)).unwrap();
    }
    let [a, b] = [&stays, &leaps].map(|world| particles(&world.snapshot().unwrap().solver));
    assert!(a.iter().all(|p| p.present && p.flask == Some(0)));
    let mut most = 0.0_f64;
    for (a, b) in a.iter().zip(&b) {
        let expected = moved(aside, a.position.as_vec3().to_array()).0;
        most = most.max(b.position.distance(expected));
        assert_eq!(a.flask, b.flask);
    }
    // 1 % of the spacing of 5 mm: the growth of rounding over 35 substeps. Without the leap the liquid would lie 0.1 m aside.
    assert!(most < 5e-5, "{most} m");
}
