//! Line 28: vorticity confinement, cohesion and adhesion.

use crate::common::*;
use crate::leaning_glass::{PLACE, both, glass_pose, scene, worst};
use glam::{DVec3, Quat, Vec3};
use std::f64::consts::PI;
use vitriol_gpu::{Buffer, ComputePipeline, Gpu, QueueKind};
use vitriol_shaders::{Library, sim};
use vitriol_sim::bodies::Hand;
use vitriol_sim::kernel::Kernel;
use vitriol_sim::parameters::Parameters;
use vitriol_sim::pose::Pose;
use vitriol_sim::reference::forces::vorticity;
use vitriol_sim::reference::neighbours::find;
use vitriol_sim::scene::{Feature, Scene};
use vitriol_sim::solver::Particle;
use vitriol_sim::surface_tension::adhesion_kernel;
use vitriol_sim::world::{StepInput, World};
use vitriol_tests::gpu;

/// ω by the pass alone, of `positions` with `velocities`.
fn vorticity_by_gpu(gpu: &Gpu, positions: &[DVec3], velocities: &[DVec3]) -> Vec<DVec3> {
    let n = positions.len();
    let neighbours = find(positions, H, |_, _| true);
    let capacity = 64;
    let (mut counts, mut list) = (vec![0u32; n], vec![0u32; n * capacity]);
    for i in 0..n {
        // In fours, filled up with the particle itself.
        list.chunks_exact_mut(4 * n)
            .for_each(|fours| fours[4 * i..4 * i + 4].fill(i as u32));
        for j in neighbours.of(i) {
            let k = counts[i] as usize;
            list[(k / 4 * n + i) * 4 + k % 4] = j as u32;
            counts[i] += 1;
        }
    }
    let words = |v: &DVec3| [v.x as f32, v.y as f32, v.z as f32, 0.0];
    let buffer = |label, bytes: &[u8]| {
        let buffer = Buffer::storage(gpu, label, bytes.len() as u64).unwrap();
        gpu.write(&buffer, bytes).unwrap();
        buffer
    };
    let vectors = |label, of: &[DVec3]| {
        let words: Vec<_> = of.iter().map(words).collect();
        buffer(label, bytemuck::cast_slice(&words))
    };
    let constants = [
        ("COUNT", n as f64),
        ("SUPPORT", H),
        ("VOLUME", D.powi(3)),
        ("LANES", 1.0),
    ];
    let compiled = Library::watching()
        .compile(&sim::VORTICITY, "main", &constants)
        .unwrap();
    let pipeline = ComputePipeline::new(gpu, &compiled).unwrap();
    let out = vectors("vorticity", &vec![DVec3::ZERO; n]);
    let mut rec = gpu.recorder(QueueKind::Main).unwrap();
    rec.pass(&pipeline)
        .read("position", &vectors("position", positions))
        .read("new_velocity", &vectors("new_velocity", velocities))
        .read(
            "list_counts",
            &buffer("counts", bytemuck::cast_slice(&counts)),
        )
        .read("list", &buffer("list", bytemuck::cast_slice(&list)))
        .write("vorticity", &out)
        .invocations(n as u32)
        .unwrap();
    gpu.submit(rec).unwrap().wait().unwrap();
    let found: Vec<[f32; 4]> = gpu.read(&out).unwrap();
    found[..n]
        .iter()
        .map(|&[x, y, z, length]| {
            let omega = DVec3::new(x.into(), y.into(), z.into());
            assert!((omega.length() - f64::from(length)).abs() < 1e-5 * omega.length());
            omega
        })
        .collect()
}

#[test]
fn vorticity_of_a_rigid_rotation_is_twice_its_rate() {
    let device = gpu::device();
    let positions: Vec<_> = (0..1000)
        .map(|i| DVec3::new((i % 10).into(), (i / 10 % 10).into(), (i / 100).into()) * D)
        .collect();
    let spin = DVec3::new(1.0, -2.0, 0.5);
    let velocities: Vec<_> = positions.iter().map(|x| spin.cross(*x)).collect();
    let own = vorticity_by_gpu(&device, &positions, &velocities);
    // Σ V₀∇W⊗x over the lattice is −1 to within its second-order error.
    assert!(
        (own[555] - 2.0 * spin).length() < 0.05 * spin.length(),
        "{}",
        own[555]
    );
    let neighbours = find(&positions, H, |_, _| true);
    let truth = vorticity(
        &Kernel::new(H),
        D.powi(3),
        &positions,
        &velocities,
        &neighbours,
    );
    // Sums of 32 floats.
    let (error, i) = worst(0..1000, |i| own[i].distance(truth[i]));
    assert!(error < 5e-6 * spin.length(), "{i} is off by {error}");
}

/// Each force and all of them, with the glass on its way, on any number of
/// lanes.
#[test]
fn forces_are_the_references() {
    let device = gpu::device();
    let without = Parameters {
        viscosity: 0.3,
        ..single_substeps()
    };
    let vorticity = Parameters {
        vorticity: 1.0,
        ..without.clone()
    };
    let cohesion = Parameters {
        cohesion: 0.072,
        ..without.clone()
    };
    let adhesion = Parameters {
        adhesion: 0.072,
        ..without.clone()
    };
    let all = Parameters {
        vorticity: 1.0,
        cohesion: 0.05,
        adhesion: 0.1,
        ..without.clone()
    };
    let start = glass_pose();
    let after = Pose::new(
        start.position + Vec3::new(0.5, 0.1, 0.0) * SUBSTEP as f32,
        Quat::from_rotation_y(2.0 * SUBSTEP as f32) * start.orientation,
    );
    let lanes = if device.info().features.subgroups {
        8
    } else {
        1
    };
    let (bare, _) = both(&device, &scene(without), after);
    for (parameters, lanes) in [
        (vorticity, 1),
        (cohesion, 1),
        (adhesion, 1),
        (all.clone(), 1),
        (all, lanes),
    ] {
        let name = format!(
            "{:?}",
            (
                parameters.vorticity,
                parameters.cohesion,
                parameters.adhesion
            )
        );
        let setup = Setup {
            lanes: Some(lanes),
            ..scene(parameters)
        };
        let (found, truth) = both(&device, &setup, after);
        let count = found.len();
        let (effect, _) = worst(0..count, |i| found[i].velocity.distance(bare[i].velocity));
        let (error, i) = worst(0..count, |i| {
            found[i].velocity.distance(truth.velocities[i])
        });
        assert!(effect > 0.015, "{name}: {effect}");
        assert!(error < PLACE / SUBSTEP, "{name}: {i} is off by {error} m/s");
    }
}

/// G(s) of a flat wall: ∫ A(r)·cos over what lies beyond the distance s, of
/// which the sphere of radius r has ∫ cos dΩ = π(1 − s²/r²).
fn pull_of_a_wall(s: f64) -> f64 {
    let steps = 20_000;
    let (from, to) = (s.max(0.5 * H), H);
    let dr = (to - from) / f64::from(steps);
    (0..steps)
        .map(|i| from + (f64::from(i) + 0.5) * dr)
        .map(|r| PI * adhesion_kernel(r, H) * (r * r - s * s) * dr)
        .sum()
}

/// A lone particle near glass, inside and outside, near the floor and far
/// from all: Δv = Δt·β·ρ₀·G(s) towards the wall, with β from the tension
/// by the moment of the kernel.
#[test]
fn adhesion_pulls_towards_walls() {
    let device = gpu::device();
    let tension = 0.072;
    let p = Parameters {
        gravity: [0.0; 3],
        viscosity: 0.0,
        adhesion: tension,
        ..single_substeps()
    };
    let steps = 20_000;
    let dr = 0.5 * H / f64::from(steps);
    let moment: f64 = (0..steps)
        .map(|i| 0.5 * H + (f64::from(i) + 0.5) * dr)
        .map(|r| r.powi(4) * adhesion_kernel(r, H) * dr)
        .sum();
    // Fowler: tension = (π/8)·n²·∫ r⁴ f dr, with f = βm²A and nm = ρ₀.
    let beta = tension * 8.0 / (PI * 1e6 * moment);
    let s = 0.6 * H;
    let cases = [
        // In the glass 26 mm wide, half-way up; above its floor of 2 mm.
        (DVec3::new(0.013 - s, 0.03, 0.0), Some(0), DVec3::X, 1.0),
        (DVec3::new(0.0, 0.03, s - 0.013), Some(0), -DVec3::Z, 1.0),
        (DVec3::new(0.0, 0.002 + s, 0.0), Some(0), -DVec3::Y, 1.0),
        (DVec3::new(0.0, 0.03, 0.0), Some(0), DVec3::X, 0.0),
        // On the outside; above the table, and beside it above the floor.
        (DVec3::new(0.015 + s, 0.03, 0.0), None, -DVec3::X, 1.0),
        (DVec3::new(0.05, -0.01 + s, 0.0), None, -DVec3::Y, 1.0),
        (DVec3::new(0.2, -0.05 + s, 0.0), None, -DVec3::Y, 1.0),
        (DVec3::new(0.2, 0.05, 0.0), None, DVec3::X, 0.0),
    ];
    let particles_at_start = cases.iter().map(|&(position, flask, ..)| Particle {
        flask,
        ..drop_at(position, DVec3::ZERO)
    });
    let setup = Setup {
        ground: crate::leaning_glass::GROUND,
        ..Setup::new(p, vec![narrow_glass()], particles_at_start.collect())
    };
    let solver = setup.solver(&device);
    frame(&device, &solver, &[Pose::IDENTITY], &[Pose::IDENTITY]);
    let expected = SUBSTEP * beta * 1000.0 * pull_of_a_wall(s);
    assert!(expected > 1e-3, "{expected}");
    for (found, (position, _, towards, part)) in
        particles(&solver.snapshot().unwrap()).iter().zip(cases)
    {
        // G is tabulated at h/64, the distance at h/6, the latter exact for
        // a straight wall; the direction is that of the map's gradient.
        let error = found.velocity.distance(towards * expected * part);
        assert!(
            error < 1e-3 * expected,
            "{position}: {} for {expected}",
            found.velocity
        );
    }
}

/// Two drops of 64 with a gap of 0.8 h: momentum is kept and the gap closes;
/// without cohesion it stays.
#[test]
fn cohesion_joins_two_drops() {
    let device = gpu::device();
    let gap = 0.8 * H;
    let drops: Vec<_> = (0..128)
        .map(|i| {
            let (drop, i) = (i / 64, i % 64);
            let site = DVec3::new((i % 4).into(), (i / 4 % 4).into(), (i / 16).into());
            drop_at(
                (site + DVec3::X * 3.0 * f64::from(drop)) * D + DVec3::X * gap * f64::from(drop),
                DVec3::ZERO,
            )
        })
        .collect();
    let centre = |found: &[Found], drop: usize| {
        let of = &found[64 * drop..64 * (drop + 1)];
        of.iter().map(|p| p.position).sum::<DVec3>() / 64.0
    };
    let run = |cohesion: f64| {
        let p = Parameters {
            gravity: [0.0; 3],
            cohesion,
            ..parameters()
        };
        let solver = Setup::new(p, Vec::new(), drops.clone()).solver(&device);
        frames(&device, &solver, &[], 6);
        let counters = solver.counters().unwrap();
        assert_eq!((counters.list_limited, counters.speed_limited), (0, 0));
        let found = particles(&solver.snapshot().unwrap());
        let momentum = found.iter().map(|p| p.velocity).sum::<DVec3>() / 128.0;
        let fastest = worst(0..128, |i| found[i].velocity.length()).0;
        (
            centre(&found, 1).x - centre(&found, 0).x,
            momentum.length(),
            fastest,
        )
    };
    let apart = 3.0 * D + gap;
    let (joined, momentum, fastest) = run(0.072);
    let (left, ..) = run(0.0);
    assert!((left - apart).abs() < 1e-6, "{left} {apart}");
    assert!(joined < apart - 0.2 * D, "{joined} {apart}");
    // Positions of 20 mm are rounded to 2 nm: 2e-6 m/s a substep and particle.
    assert!(fastest > 0.01 && momentum < 2e-6, "{momentum} of {fastest}");
}

/// A scene that names its forces at no strength has the bits of one that does
/// not name them, and their memory.
#[test]
fn no_strength_is_no_force() {
    let device = gpu::device();
    let run = |model: &[Feature], strength: Option<f64>| {
        let mut scene = Scene::builtin("beaker").unwrap();
        scene.liquids[0].volume = 5e-6;
        scene.model = model.to_vec();
        let solver = &mut scene.solver;
        (solver.vorticity, solver.cohesion, solver.adhesion) = (strength, strength, strength);
        let mut world = World::new(&device, &Library::watching(), &scene, 1).unwrap();
        for _ in 0..2 {
            let hands = [Hand::ABSENT; 2];
            world.step(&StepInput { hands }).unwrap();
        }
        let hash = world.snapshot().unwrap().solver.hash();
        (hash, world.solver().bytes_per_particle())
    };
    let both = [Feature::Cohesion, Feature::Vorticity];
    let off = run(&[], None);
    assert_eq!(run(&both, Some(0.0)), off);
    let (hash, bytes) = run(&both, Some(0.05));
    assert_ne!(hash, off.0);
    // ω and |ω|.
    assert_eq!(bytes, off.1 + 16);
}
