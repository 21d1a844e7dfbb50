//! Line 28: vorticity confinement; with surface tension, against the reference.

use crate::common::*;
use crate::leaning_glass::{PLACE, both, glass_pose, moved_glass, scene, velocity_error, worst};
use glam::{DVec3, Quat, Vec3};
use vitriol_gpu::{Buffer, ComputePipeline, Gpu, QueueKind};
use vitriol_shaders::{Library, sim};
use vitriol_sim::kernel::Kernel;
use vitriol_sim::parameters::Parameters;
use vitriol_sim::pose::Pose;
use vitriol_sim::reference::forces::vorticity;
use vitriol_sim::reference::neighbours::find;
use vitriol_sim::scene::{Feature, Scene};
use vitriol_sim::solver::{Ground, Particle};
use vitriol_sim::surface_tension::SurfaceTension;
use vitriol_sim::world::World;
use vitriol_tests::{gpu, list};

/// ω by the pass alone, of `positions` with `velocities`.
fn vorticity_by_gpu(gpu: &Gpu, positions: &[DVec3], velocities: &[DVec3]) -> Vec<DVec3> {
    let n = positions.len();
    let neighbours = find(positions, H, |_, _| true);
    let capacity = 64;
    let (mut counts, mut list) = (vec![0u32; n], vec![0u32; list::words(n, capacity)]);
    for i in 0..n {
        // In fours, filled up with the particle itself.
        for k in 0..capacity {
            list[list::place(i, k, capacity)] = i as u32;
        }
        for j in neighbours.of(i) {
            let k = counts[i] as usize;
            list[list::place(i, k, capacity)] = j as u32;
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
        ("LIST_CAPACITY", capacity as f64),
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
        .read("long_lists", &buffer("long_lists", &[0; 4]))
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
    let surface = Some(SurfaceTension {
        glass: vec![1.2],
        ..SurfaceTension::new(0.072)
    });
    let tension = Parameters {
        surface: surface.clone(),
        ..without.clone()
    };
    let all = Parameters {
        vorticity: 1.0,
        surface,
        ..without.clone()
    };
    let after = moved_glass();
    let lanes = if device.info().features.subgroups {
        8
    } else {
        1
    };
    let (bare, _) = both(&device, &scene(without), after);
    for (parameters, lanes) in [(vorticity, 1), (tension, 1), (all.clone(), 1), (all, lanes)] {
        let name = format!("{} {:?}", parameters.vorticity, parameters.surface);
        let setup = Setup {
            lanes: Some(lanes),
            ..scene(parameters)
        };
        let (found, truth) = both(&device, &setup, after);
        let count = found.len();
        let (effect, _) = worst(0..count, |i| found[i].velocity.distance(bare[i].velocity));
        let off = |i: usize| found[i].velocity.distance(truth.velocities[i]);
        let (error, i) = worst(0..count, off);
        assert!(effect > 0.005, "{name}: {effect}");
        if setup.parameters.surface.is_none() {
            assert!(error < PLACE / SUBSTEP, "{name}: {i} is off by {error} m/s");
        }
        // Cores are looked for at nearest nodes, and rounding may choose another: the 64 particles around that cell
        // then differ, by less than a tenth of what tension does.
        let others = (0..count).filter(|&i| off(i) >= PLACE / SUBSTEP).count();
        assert!(others <= 64, "{name}: {others} are off");
        assert!(error < 0.1 * effect, "{name}: {i} is off by {error} m/s");
    }
}

/// Height of the rim of `narrow_glass` over its base, m.
const RIM: f64 = 0.062;

/// A column that stands over the rim: liquid in the glass and liquid above it are in each other's grid.
#[test]
fn tension_through_a_mouth_is_the_references() {
    let device = gpu::device();
    let p = Parameters {
        surface: Some(SurfaceTension::new(0.072)),
        viscosity: 0.0,
        ..single_substeps()
    };
    let column = (0..6 * 6 * 12).map(|i| {
        let site = DVec3::new((i % 6).into(), (i / 36).into(), (i / 6 % 6).into());
        let local = (site - DVec3::new(2.5, 5.3, 2.5)) * D + DVec3::Y * RIM;
        let at = glass_pose().transform_point(local.as_vec3()).as_dvec3();
        Particle {
            flask: (local.y < RIM).then_some(0),
            ..drop_at(at, DVec3::ZERO)
        }
    });
    let setup = Setup {
        particles: column.collect(),
        ..scene(p)
    };
    let mut lanes = lanes(&device);
    lanes.extend(lanes.contains(&8).then_some(4));
    for lanes in lanes {
        let setup = Setup {
            lanes: Some(lanes),
            ..setup.clone()
        };
        let (found, truth) = both(&device, &setup, glass_pose());
        let inside = truth.membership.iter().filter(|of| of.is_some()).count();
        assert!((150..280).contains(&inside), "{inside}");
        let (error, i) = velocity_error(&found, &truth);
        assert!(
            error < PLACE / SUBSTEP,
            "{lanes} lanes: {i} is off by {error} m/s"
        );
    }
}

/// The walls' holding acts in the substep after it was found, on liquid in a glass that moves and on liquid on the floor.
#[test]
fn lines_are_held_as_the_references() {
    let device = gpu::device();
    let of = |hysteresis: f64| Parameters {
        surface: Some(SurfaceTension {
            hysteresis,
            ..SurfaceTension::new(0.072)
        }),
        frame_time: 2.0 * SUBSTEP,
        substeps: 2,
        ..single_substeps()
    };
    let start = glass_pose();
    let after = Pose::new(
        start.position + Vec3::new(0.3, 0.1, 0.0) * (2.0 * SUBSTEP) as f32,
        Quat::from_rotation_y(2.0 * SUBSTEP as f32) * start.orientation,
    );
    let floor = f64::from(start.position.y) - 0.2;
    let mut random = Random(11);
    let slab: Vec<_> = (0..8 * 8 * 2)
        .map(|i| {
            let site = DVec3::new((i % 8).into(), (i / 64).into(), (i / 8 % 8).into());
            let at = site * D + DVec3::new(0.2, floor + 0.5 * D, 0.2);
            drop_at(at + random.point(0.1 * D), DVec3::new(0.05, 0.0, 0.02))
        })
        .collect();
    let setup = |hysteresis: f64| {
        let setup = scene(of(hysteresis));
        let mut particles = setup.particles.clone();
        particles.extend(slab.clone());
        Setup {
            particles,
            ground: Ground {
                floor,
                ..setup.ground
            },
            ..setup
        }
    };
    let (free, _) = both(&device, &setup(0.0), after);
    let (found, truth) = both(&device, &setup(0.5), after);
    let glass = found.len() - 128;
    for of in [0..glass, glass..found.len()] {
        let (effect, _) = worst(of.clone(), |i| found[i].velocity.distance(free[i].velocity));
        let off = |i: usize| found[i].velocity.distance(truth.velocities[i]);
        let (error, i) = worst(of.clone(), off);
        // Of two substeps; around a cell whose core is another by rounding, as above.
        let others = of.filter(|&i| off(i) >= 2.0 * PLACE / SUBSTEP).count();
        assert!(others <= 64, "{others} are off");
        assert!(error < 0.1 * effect, "{i} is off by {error} m/s");
    }
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
        (solver.vorticity, solver.surface_tension) = (strength, strength);
        let mut world = World::new(&device, &Library::watching(), &scene, 1).unwrap();
        steps(&mut world, 2);
        let hash = world.snapshot().unwrap().solver.hash();
        (hash, world.solver().bytes_per_particle())
    };
    let both = [Feature::Tension, Feature::Vorticity];
    let off = run(&[], None);
    assert_eq!(run(&both, Some(0.0)), off);
    let (hash, bytes) = run(&both, Some(0.05));
    assert_ne!(hash, off.0);
    assert!(bytes > off.1 + 16);
}
