//! Loads of the liquid on a flask, against statics.

use crate::common::*;
use glam::{DVec3, Quat, Vec3};
use vitriol_sim::parameters::Parameters;
use vitriol_sim::pose::Pose;
use vitriol_sim::solver::Particle;
use vitriol_sim::surface_tension::SurfaceTension;
use vitriol_tests::gpu;

fn vector(v: [f32; 4]) -> DVec3 {
    DVec3::new(v[0].into(), v[1].into(), v[2].into())
}

/// A leaning glass of water at rest bears the water's weight, at its centre
/// of mass; an empty one beside it bears nothing.
#[test]
fn a_glass_bears_the_weight_of_its_water() {
    let device = gpu::device();
    let lean = Quat::from_rotation_z(0.2);
    let poses = [
        Pose::new(Vec3::new(0.1, 0.05, 0.02), lean),
        at(0.5, 0.0, 0.0),
    ];
    let p = Parameters {
        substeps: 8,
        carry_rate: 5.4,
        viscosity: 0.3,
        ..parameters()
    };
    let mass = p.particle_mass();
    let time = p.frame_time;
    let setup = Setup {
        loads: true,
        ..Setup::new(
            p,
            vec![narrow_glass(); 2],
            water(&narrow_glass(), 0, poses[0], 600),
        )
    };
    let solver = setup.solver(&device);
    frames(&device, &solver, &poses, 60);
    let count = 30.0;
    let (mut impulse, mut angular) = (DVec3::ZERO, DVec3::ZERO);
    for _ in 0..30 {
        let loads = frame(&device, &solver, &poses, &poses);
        assert_eq!((loads[0].impulse[3], loads[1].impulse), (600.0, [0.0; 4]));
        impulse += vector(loads[0].impulse) / count;
        angular += vector(loads[0].angular) / count;
        let found = particles(&solver.snapshot().unwrap());
        let origin = poses[0].position.as_dvec3();
        let offsets: DVec3 = found.iter().map(|p| p.position - origin).sum();
        // 600 sums of floats below 0.06.
        assert!(offsets.distance(vector(loads[0].offsets)) < 1e-4);
    }
    let found = particles(&solver.snapshot().unwrap());
    let centre = found.iter().map(|p| p.position).sum::<DVec3>() / 600.0;
    let weight = DVec3::Y * (-9.81 * mass * 600.0 * time);
    // At rest apart from residual sloshing.
    let off = impulse.distance(weight) / weight.length();
    assert!(off < 0.02, "{impulse} for {weight}");
    let torque = (centre - poses[0].position.as_dvec3()).cross(weight);
    let off = angular.distance(torque) / (weight.length() * 0.013);
    assert!(off < 0.03, "{angular} for {torque}");
}

/// Particles that fly apart in two glasses that move, each too far from the next to feel it, so that
/// a wall pushes those alone that would be past it after the step. Their kinetic energy relative to
/// their glass, by a loop over the state.
#[test]
fn what_a_wall_pushes_stirs() {
    let device = gpu::device();
    let p = Parameters {
        viscosity: 0.0,
        ..single_substeps()
    };
    let (mass, time) = (p.particle_mass(), p.frame_time);
    let turned = |angle| Quat::from_rotation_x(0.3) * Quat::from_rotation_z(angle);
    let before = [
        Pose::new(Vec3::new(0.1, 0.05, 0.02), turned(0.1)),
        Pose::new(Vec3::new(0.3, 0.0, 0.0), Quat::IDENTITY),
    ];
    let after = [
        Pose::new(Vec3::new(0.1008, 0.0505, 0.02), turned(0.11)),
        Pose::new(Vec3::new(0.3, 0.0, -0.0009), Quat::IDENTITY),
    ];
    let inside = |k: usize, stage: DVec3| {
        let to_flask = after[k].inverse();
        to_flask.transform_point(stage.as_vec3()).as_dvec3()
    };
    // How far past the wall or the bottom a place is, m.
    let past = |k: usize, stage: DVec3| {
        let at = inside(k, stage);
        (at.x.hypot(at.z) - 0.013).max(-at.y)
    };
    let fall = DVec3::Y * (-9.81 * time);
    let mut random = Random(5);
    let (mut given, mut pushed) = (Vec::new(), Vec::new());
    for (k, pose) in before.iter().enumerate() {
        for (layer, corner) in
            (0..6).flat_map(|l| (0..4).map(move |c| (f64::from(l), f64::from(c))))
        {
            let angle = corner * std::f64::consts::FRAC_PI_2;
            let out = DVec3::new(angle.cos(), 0.0, angle.sin());
            let start = out * 0.009 + DVec3::Y * (0.008 + 0.008 * layer);
            let position = pose.transform_point(start.as_vec3()).as_dvec3();
            // Outwards, and not so that rounding decides whether it gets past.
            let velocity = loop {
                let along = out * (7.0 * random.number()) + random.point(2.0);
                let velocity = pose.orientation.as_dquat() * along;
                if past(k, position + (velocity + fall) * time).abs() > 1e-4 {
                    break velocity;
                }
            };
            given.push(Particle {
                flask: Some(k),
                ..drop_at(position, velocity)
            });
            pushed.push(past(k, position + (velocity + fall) * time) > 0.0);
        }
    }
    // Nobody's, which no wall pushes.
    given.push(drop_at(DVec3::new(0.2, 0.3, 0.0), DVec3::X * 3.0));
    pushed.push(false);
    let count = pushed.iter().filter(|pushed| **pushed).count();
    assert!((12..36).contains(&count), "{count} are pushed");

    let setup = Setup {
        loads: true,
        ..Setup::new(p, vec![narrow_glass(); 2], given)
    };
    let solver = setup.solver(&device);
    let loads = frame(&device, &solver, &before, &after);
    let mut energies = [0.0; 2];
    let found = particles(&solver.snapshot().unwrap());
    for (particle, _) in found.iter().zip(&pushed).filter(|(_, pushed)| **pushed) {
        let k = particle.flask.unwrap();
        let was = before[k].transform_point(inside(k, particle.position).as_vec3());
        let wall = (particle.position - was.as_dvec3()) / time;
        energies[k] += 0.5 * mass * (particle.velocity - wall).length_squared();
    }
    for (load, energy) in loads.iter().zip(energies) {
        // A float's place at 0.3 m, 3e-8 m, is 3e-5 m/s in a step, of some m/s.
        let off = (f64::from(load.angular[3]) / energy - 1.0).abs();
        assert!(
            energy > 0.0 && off < 1e-3,
            "{} for {energy}",
            load.angular[3]
        );
    }
}

/// Newton's third law for what walls drag and wet: a glass is drawn down its own axis from under its water, without
/// weight, so that its side gives the water momentum along the axis by drag and wetting alone. The glass gets the opposite.
#[test]
fn what_walls_drag_and_wet_drags_and_pulls_the_glass() {
    let device = gpu::device();
    for (viscosity, tension) in [(0.3, 0.0), (0.0, 0.072), (0.3, 0.072)] {
        let p = Parameters {
            gravity: [0.0; 3],
            viscosity,
            surface: (tension > 0.0).then(|| SurfaceTension::new(tension)),
            ..parameters()
        };
        let mass = p.particle_mass();
        let start = at(0.0, 0.0, 0.0);
        let setup = Setup {
            loads: true,
            ..Setup::new(
                p,
                vec![narrow_glass()],
                water(&narrow_glass(), 0, start, 400),
            )
        };
        let solver = setup.solver(&device);
        let momentum = || -> DVec3 {
            let found = particles(&solver.snapshot().unwrap());
            found.iter().map(|particle| particle.velocity * mass).sum()
        };
        // 5 cm/s: the bottom leaves the water, which stays by its inertia.
        let (begin, mut given, mut pose) = (momentum(), DVec3::ZERO, start);
        for frame_number in 1..=12 {
            let next = at(0.0, -0.05 / 90.0 * frame_number as f32, 0.0);
            let loads = frame(&device, &solver, &[pose], &[next]);
            given += vector(loads[0].impulse);
            pose = next;
        }
        let gained = momentum() - begin;
        // What the water would have if it moved with the glass is 400 m · 5 cm/s; some of it is gained.
        let whole = 400.0 * mass * 0.05;
        if viscosity > 0.0 {
            assert!(gained.y < -0.05 * whole, "{gained}");
        }
        if tension > 0.0 {
            assert!(gained.length() > 0.01 * whole, "{gained} of {whole}");
        }
        // Where a way is cut to the neighbour list's, or to v_max, its momentum is lost.
        let counters = solver.counters().unwrap();
        assert_eq!((counters.list_limited, counters.speed_limited), (0, 0));
        // Sums of floats, and velocities that each step rounds: 2e-5 was seen.
        let off = (gained + given).length() / whole;
        eprintln!("μ {viscosity}, σ {tension}: off by {off:.1e}");
        assert!(
            off < 1e-3,
            "μ {viscosity}, σ {tension}: water {gained}, glass {given}"
        );
    }
}
