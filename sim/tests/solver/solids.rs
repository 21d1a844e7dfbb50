//! The paper's boundary: solid particles in place of volume maps.

use crate::common::*;
use crate::leaning_glass::{
    PLACE, PLANE, both, density_error, moved_glass, scene, velocity_error, worst,
};
use vitriol_gpu::{Gpu, QueueKind, Timestamps};
use vitriol_shaders::Library;
use vitriol_sim::flask::particles::{BoundaryParticle, sample};
use vitriol_sim::parameters::{Parameters, Relaxation};
use vitriol_sim::pose::Pose;
use vitriol_sim::reference::measure::DensityError;
use vitriol_sim::scene::{Boundary, Scene};
use vitriol_sim::world::World;
use vitriol_tests::gpu;

/// The narrow glass's solids, half a fluid particle's spacing apart.
fn solids() -> Vec<BoundaryParticle> {
    sample(&narrow_glass(), 0.5 * D, H)
}

fn scene_of_solids(parameters: Parameters) -> Setup {
    Setup {
        solids: Some(vec![solids()]),
        ..scene(parameters)
    }
}

/// The report's density, at the places where the GPU has its particles.
#[test]
fn density_is_the_references() {
    let device = gpu::device();
    let setup = scene_of_solids(parameters());
    for lanes in lanes(&device) {
        let setup = Setup {
            lanes: Some(lanes),
            ..setup.clone()
        };
        let (error, slot, _) = density_error(&device, &setup);
        assert!(error < PLANE, "{lanes}: {slot} is off by {error}");
    }
}

/// A substep with a glass on its way: density and drag by the solids.
#[test]
fn a_substep_is_the_references() {
    let device = gpu::device();
    let p = Parameters {
        viscosity: 0.6,
        // Solids press harder on a filling lattice than maps do: relaxed less,
        // the GPU would cut displacements to the list's reach.
        relaxation: Relaxation::Jacobi { omega: 0.05 },
        ..single_substeps()
    };
    let after = moved_glass();
    let (by_maps, _) = both(&device, &scene(p.clone()), after);
    let (found, truth) = both(&device, &scene_of_solids(p), after);
    let (other, _) = worst(0..found.len(), |i| {
        found[i].velocity.distance(by_maps[i].velocity)
    });
    let (error, i) = velocity_error(&found, &truth);
    assert!(other > 0.02, "{other}");
    assert!(error < PLACE / SUBSTEP, "{i} is off by {error} m/s");
}

/// What a boundary makes of water at rest.
struct AtRest {
    error: DensityError,
    /// Radius of the widest particle's place and height of the highest one, metres.
    widest: f64,
    highest: f64,
    /// Device time of the fastest multiplier pass, nanoseconds.
    time: f64,
}

/// Half a second by `setup`, which has the glass alone.
fn at_rest(gpu: &Gpu, setup: &Setup) -> AtRest {
    let solver = setup.solver(gpu);
    let mut time = f64::INFINITY;
    let mut widest = 0.0_f64;
    for frame in 0..45 {
        let mut rec = gpu.recorder(QueueKind::Main).unwrap();
        let poses = [Pose::IDENTITY];
        solver.record(&mut rec, &poses, &poses).unwrap();
        let ticket = gpu.submit(rec).unwrap();
        ticket.wait().unwrap();
        let timings = ticket.timings().unwrap();
        let multipliers = timings
            .iter()
            .filter(|t| t.label.contains("sim/multiplier"));
        time = multipliers.map(|t| t.nanoseconds).fold(time, f64::min);
        // The liquid stirs by a tenth of a spacing: what it reaches is seen over a tenth of a second.
        if frame >= 36 {
            let found = particles(&solver.snapshot().unwrap());
            let radii = found.iter().map(|p| p.position.x.hypot(p.position.z));
            widest = radii.fold(widest, f64::max);
        }
    }
    let found = particles(&solver.snapshot().unwrap());
    assert!(found.iter().all(|p| p.flask == Some(0)));
    let counters = solver.counters().unwrap();
    assert_eq!((counters.nan_particles, counters.speed_limited), (0, 0));
    AtRest {
        error: DensityError::of(&densities(gpu, &solver)),
        widest,
        highest: worst(0..found.len(), |i| found[i].position.y).0,
        time,
    }
}

/// Both boundaries hold water within the same density error. But solids make
/// up a full density at their own places, where a half-space is one half: the
/// liquid stands off from them, and the level is too high by as much; and a
/// sheet of them costs a second neighbourhood.
#[test]
fn maps_keep_the_volume_that_solids_do_not() {
    let device = gpu::another_device(|options| options.timestamps = Timestamps::Passes);
    let p = Parameters {
        substeps: 10,
        iterations: 3,
        carry_rate: 5.4,
        ..parameters()
    };
    let glass = narrow_glass();
    let start = water(&glass, 0, Pose::IDENTITY, 800);
    let maps = Setup::new(p, vec![glass.clone()], start);
    let of_solids = Setup {
        solids: Some(vec![solids()]),
        ..maps.clone()
    };
    let (maps, solids) = (at_rest(&device, &maps), at_rest(&device, &of_solids));
    for error in [maps.error, solids.error] {
        assert!(error.mean < 0.002 && error.p99 < 0.01, "{error:?}");
    }
    // The uppermost particles' places are up to half a spacing under the
    // level, and the surface is uneven by as much.
    let level = glass.level_for_volume(800.0 * D.powi(3)).unwrap();
    let off = (maps.highest + 0.5 * D - level).abs();
    assert!(off < 0.5 * D, "{} {level}", maps.highest);
    assert!(maps.widest > 0.013 - 0.1 * D, "{}", maps.widest);
    assert!(solids.highest > level + D, "{} {level}", solids.highest);
    assert!(solids.widest < 0.013 - 0.4 * D, "{}", solids.widest);
    // Six times on the software driver.
    assert!(maps.time < solids.time, "{} {}", maps.time, solids.time);
}

/// The world makes the solids that its scene names.
#[test]
fn a_scene_may_ask_for_solids() {
    let device = gpu::device();
    let run = |boundary: Boundary| {
        let mut scene = Scene::builtin("beaker").unwrap();
        scene.liquids[0].volume = 5e-6;
        scene.solver.boundary = boundary;
        let mut world = World::new(&device, &Library::watching(), &scene, 1).unwrap();
        steps(&mut world, 1);
        let state = world.snapshot().unwrap().solver;
        let found = particles(&state);
        assert!(found.iter().all(|p| p.flask == Some(0)));
        densities(&device, world.solver())
            .into_iter()
            .fold(0.0, f64::max)
    };
    // Wet through: the lattice was filled up to the glass.
    let (maps, solids) = (run(Boundary::Map), run(Boundary::Particles));
    assert!(solids > maps + 0.01, "{maps} {solids}");
}
