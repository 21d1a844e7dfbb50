//! Action of tools on the liquid: a rod's drag against that of a cylinder in a stream, and the liquid that a cloth takes up against what
//! lay there.

use crate::common::*;
use glam::{DVec2, DVec3, Vec3};
use vitriol_gpu::{Gpu, QueueKind};
use vitriol_shaders::Library;
use vitriol_sim::bodies::Hand;
use vitriol_sim::pose::Pose;
use vitriol_sim::scene::{Scene, ToolKind};
use vitriol_sim::solver::{Ground, Particle, Skin, SkinPart, Solver, Touch};
use vitriol_sim::world::{StepInput, World};
use vitriol_tests::gpu;

const FRAME: f64 = 1.0 / 90.0;

fn handle(gpu: &Gpu, solver: &Solver, touch: &Touch) {
    let mut rec = gpu.recorder(QueueKind::Main).unwrap();
    solver.handle(&mut rec, touch, FRAME).unwrap();
    gpu.submit(rec).unwrap().wait().unwrap();
}

/// A block of resting drops from −`half` to `half` steps about the origin.
fn block(half: [i32; 3]) -> Vec<Particle> {
    let [x, y, z] = half.map(|half| -half..=half);
    let all = x.flat_map(move |x| {
        let (y, z) = (y.clone(), z.clone());
        y.flat_map(move |y| z.clone().map(move |z| [x, y, z]))
    });
    all.map(|at| drop_at(D * DVec3::from_array(at.map(f64::from)), DVec3::ZERO))
        .collect()
}

fn with_tools(particles: Vec<Particle>) -> Setup {
    Setup {
        tools: true,
        ..Setup::new(parameters(), Vec::new(), particles)
    }
}

/// In resting water the impulse of a step is ½ ρ C D u² L Δt across the rod, C = 1.2 (White), and none along it. A lattice has as many
/// particles in a slanted cylinder as its volume gives, to 3 %; that slower particles are dragged less takes some per cent more.
#[test]
fn a_rod_drags_as_a_cylinder_in_a_stream() {
    let gpu = gpu::device();
    let setup = with_tools(block([10, 40, 10]));
    let axis = Vec3::new(0.11, 1.0, 0.07).normalize();
    let long = 60.0 * D as f32;
    let radius = 0.0035;
    let mut found = Vec::new();
    for speed in [0.02_f32, 0.2] {
        let solver = setup.solver(&gpu);
        let velocity = speed * axis.any_orthonormal_vector() + 0.3 * axis;
        let touch = Touch {
            ends: [-0.5 * long * axis, 0.5 * long * axis],
            velocities: [velocity; 2],
            radius,
            wipes: false,
        };
        handle(&gpu, &solver, &touch);
        let state = solver.snapshot().unwrap();
        let mass = solver.parameters().particle_mass();
        let sum: DVec3 = particles(&state).iter().map(|it| mass * it.velocity).sum();
        let impulse = sum.as_vec3();
        let area = 2.0 * radius * long;
        let expected = 0.5 * 1000.0 * 1.2 * area * speed * speed * FRAME as f32;
        let across = impulse.dot(velocity - 0.3 * axis) / speed;
        found.push(f64::from(across / expected));
        assert!(
            impulse.dot(axis).abs() < 1e-3 * across,
            "along it: {impulse}"
        );
    }
    assert!((found[0] - 1.0).abs() < 0.05, "{found:?}");
    assert!((0.85..1.0).contains(&found[1]), "{found:?}");
}

/// However fast it is, no particle becomes faster than the rod.
#[test]
fn a_rod_throws_nothing() {
    let gpu = gpu::device();
    let solver = with_tools(block([4, 10, 4])).solver(&gpu);
    let touch = Touch {
        ends: [-Vec3::Y, Vec3::Y],
        velocities: [5.0 * Vec3::X; 2],
        radius: 0.0035,
        wipes: false,
    };
    for _ in 0..5 {
        handle(&gpu, &solver, &touch);
    }
    let state = solver.snapshot().unwrap();
    let found = particles(&state);
    let fastest = found.iter().map(|it| it.velocity.length());
    let fastest = fastest.fold(0.0, f64::max);
    assert!((1.0..=5.0).contains(&fastest), "{fastest} m/s");
}

/// Two layers on a table, half of them under a cloth.
#[test]
fn a_cloth_takes_up_what_it_lies_on() {
    let gpu = gpu::device();
    let radius = 0.02_f32;
    let mut setup = with_tools(block([16, 0, 16]));
    setup.ground = Ground {
        floor: -1.0,
        table: Some((-0.5 * D, DVec2::ZERO, DVec2::splat(0.5))),
        scale: 1.0,
    };
    let solver = setup.solver(&gpu);
    let touch = Touch {
        ends: [Vec3::Y * D as f32, Vec3::Y * (D as f32 + 0.02)],
        velocities: [Vec3::ZERO; 2],
        radius,
        wipes: true,
    };
    let under = |it: &&Particle| it.position.x.hypot(it.position.z) < f64::from(radius);
    let expected = setup.particles.iter().filter(under).count();
    // Of a disc of 16 particles in radius: π 16² of them, to a few at its edge.
    assert!((expected as f64 / 201.0 - 1.0).abs() < 0.1, "{expected}");
    handle(&gpu, &solver, &touch);
    let count = |solver: &Solver| {
        let state = solver.snapshot().unwrap();
        particles(&state).iter().filter(|it| it.present).count()
    };
    let left = setup.particles.len() - expected;
    assert_eq!(count(&solver), left);
    assert_eq!(solver.counters().unwrap().wiped, expected as u32);
    // The rest goes on, and those that are gone stay gone; again there is nothing more.
    frames(&gpu, &solver, &[], 5);
    assert_eq!(count(&solver), left);
    assert!(solver.counters().unwrap().nan_particles == 0);
}

/// A cloth does not take up liquid in a flask, though it is near.
#[test]
fn a_cloth_takes_nothing_out_of_a_flask() {
    let gpu = gpu::device();
    let mut setup = with_tools(block([3, 3, 3]));
    for (index, particle) in setup.particles.iter_mut().enumerate() {
        particle.flask = (index % 2 == 0).then_some(0);
    }
    setup.flasks = vec![narrow_glass()];
    let in_flask = setup
        .particles
        .iter()
        .filter(|it| it.flask.is_some())
        .count();
    let solver = setup.solver(&gpu);
    let touch = Touch {
        ends: [-0.05 * Vec3::Y, 0.05 * Vec3::Y],
        velocities: [Vec3::ZERO; 2],
        radius: 0.05,
        wipes: true,
    };
    handle(&gpu, &solver, &touch);
    let state = solver.snapshot().unwrap();
    let left = particles(&state);
    let left: Vec<_> = left.iter().filter(|it| it.present).collect();
    assert_eq!(left.len(), in_flask);
    assert!(left.iter().all(|it| it.flask == Some(0)));
}

/// Water over a hand is counted once, and the hand that it misses has none.
#[test]
fn water_that_comes_to_a_hand_rinses_it() {
    let gpu = gpu::device();
    let mut particles = block([3, 3, 3]);
    for particle in &mut particles {
        particle.position += DVec3::Y * 0.05;
        particle.velocity = DVec3::new(0.0, -1.0, 0.0);
    }
    for tools in [true, false] {
        let setup = Setup {
            tools,
            ..with_tools(particles.clone())
        };
        let solver = setup.solver(&gpu);
        let part = |whose, x: f32| SkinPart {
            whose,
            ends: [Vec3::new(x, 0.0, -0.05), Vec3::new(x, 0.0, 0.05)],
            radii: [0.03; 2],
        };
        let skin = [part(Skin::Left, 0.0), part(Skin::Right, 1.0)];
        let mut rinsed = [0.0; 2];
        for _ in 0..12 {
            frames(&gpu, &solver, &[] as &[Pose], 1);
            let mut rec = gpu.recorder(QueueKind::Main).unwrap();
            let record = solver.record_census(&mut rec, &skin, FRAME).unwrap();
            gpu.submit(rec).unwrap().wait().unwrap();
            let census = record.get().unwrap();
            for (sum, touching) in rinsed.iter_mut().zip(&census.skin) {
                *sum += touching.rinsed;
                assert_eq!(touching.particles, 0, "water harms nobody");
            }
        }
        let all = particles.len() as f64 * D.powi(3);
        let expected = if tools { all } else { 0.0 };
        // A share of a word of each particle is lost, a thousandth.
        assert!(
            (rinsed[0] - expected).abs() < 2e-3 * all,
            "{rinsed:?} of {all}"
        );
        assert_eq!(rinsed[1], 0.0);
    }
}

/// A hand that has a cloth is as full as one that has a flask; what is within 5 cm of it would be taken.
#[test]
fn a_tool_fills_a_hand() {
    let gpu = gpu::device();
    let mut scene = Scene::builtin("acid-on-glove").unwrap();
    scene.liquids.clear();
    let mut world = World::new(&gpu, &Library::watching(), &scene, 1).unwrap();
    let of_kind = |kind| scene.tools.iter().position(|it| it.kind == kind).unwrap();
    let cloth = of_kind(ToolKind::Cloth);
    let at = world.tools()[cloth].position + Vec3::Y * 0.02;
    assert!(world.is_in_reach(at) && world.is_in_reach(at + Vec3::Y * 0.04));
    assert!(!world.is_in_reach(at + Vec3::Y * 0.06));
    // Nobody takes the box of gloves away.
    let gloves = world.tools()[of_kind(ToolKind::Gloves)].position;
    assert!(!world.is_in_reach(gloves + Vec3::Y * 0.1));
    for (squeeze, holds) in [(0.0, false), (1.0, true), (1.0, true), (0.0, false)] {
        let hands = [Hand::ABSENT, tracked_hand(Pose::from_position(at), squeeze)];
        world.step(&StepInput::of_hands(hands)).unwrap();
        assert_eq!([0, 1].map(|hand| world.holds(hand)), [false, holds]);
        assert_eq!(world.tool_holder(cloth), holds.then_some(1));
        assert!((0..3).all(|flask| world.holder(flask).is_none()));
    }
}
