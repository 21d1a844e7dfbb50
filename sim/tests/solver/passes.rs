//! A scene runs the passes of the features that it names, and no others.

use crate::common::*;
use vitriol_gpu::{GpuError, QueueKind, Timestamps};
use vitriol_shaders::{Library, ShaderId, sim};
use vitriol_sim::parameters::Parameters;
use vitriol_sim::pose::Pose;
use vitriol_sim::solver::SolverError;
use vitriol_sim::surface_tension::SurfaceTension;
use vitriol_tests::gpu;

pub const PASSES: [ShaderId; 11] = [
    sim::PREDICT,
    sim::CELL_COUNT,
    sim::CELL_SCAN,
    sim::REORDER,
    sim::LIST,
    sim::MULTIPLIER,
    sim::DISPLACEMENT,
    sim::VORTICITY,
    sim::FORCES,
    sim::DENSITY,
    sim::LOAD,
];

/// Names of the buffers that a pass binds under these constants.
pub fn bindings(shader: ShaderId, constants: &[(&str, f64)]) -> Vec<String> {
    let library = Library::watching();
    let declared = library.constants(&shader).unwrap();
    let own: Vec<_> = constants
        .iter()
        .copied()
        .filter(|(name, _)| declared.iter().any(|known| known == name))
        .collect();
    let compiled = library.compile(&shader, "main", &own).unwrap();
    compiled.bindings.into_iter().map(|b| b.name).collect()
}

#[test]
fn shaders_bind_what_the_scene_has() {
    let of_flasks = ["flasks", "poses", "radii", "maps"];
    let of_loads = ["wall_push", "sorted_push"];
    let of_table = ["plane"];
    let (mut seen_flasks, mut seen_loads) = (0, 0);
    for shader in PASSES {
        let last = [("COMMIT", 1.0), ("PREDICT", 1.0)];
        let with = |flasks: f64, loads: f64| {
            let constants = [("FLASKS", flasks), ("LOADS", loads)];
            bindings(shader, &[&constants[..], &last].concat())
        };
        let holds =
            |names: &[String], any: &[&str]| names.iter().any(|n| any.contains(&n.as_str()));
        if shader.path() != sim::LOAD.path() {
            let bare = with(0.0, 0.0);
            assert!(!holds(&bare, &of_flasks), "{shader}: {bare:?}");
            assert!(!holds(&bare, &of_loads), "{shader}: {bare:?}");
        }
        let full = with(2.0, 1.0);
        seen_flasks += usize::from(holds(&full, &of_flasks));
        seen_loads += usize::from(holds(&full, &of_loads));
        // The floor is always there, for those that ask for walls at all.
        let of_walls = [sim::MULTIPLIER, sim::FORCES, sim::DENSITY].map(|s| s.path());
        assert_eq!(holds(&full, &of_table), of_walls.contains(&shader.path()));
    }
    // Names that are in none would have proved nothing.
    assert_eq!((seen_flasks, seen_loads), (7, 6));
    let forces = |constants: &[(&str, f64)]| {
        let bound = bindings(sim::FORCES, constants);
        bound.contains(&"vorticity".to_owned())
    };
    assert!(!forces(&[]) && forces(&[("CONFINEMENT", 1.0)]));
    // A wall is of maps or of solids, never of both.
    for (shader, solids) in [sim::MULTIPLIER, sim::FORCES, sim::DENSITY]
        .into_iter()
        .flat_map(|shader| [(shader, 0.0), (shader, 1.0)])
    {
        let bound = bindings(shader, &[("FLASKS", 1.0), ("SOLIDS", solids)]);
        let walls = ["maps", "solids", "solid_starts", "solid_cells"];
        let bound = walls.map(|name| bound.contains(&name.to_owned()));
        let of_solids = solids > 0.0;
        assert_eq!(
            bound,
            [!of_solids, of_solids, of_solids, of_solids],
            "{shader}"
        );
    }
    // Without viscosity and forces, no neighbour is looked at and no wall.
    let idle = bindings(sim::FORCES, &[("VISCOUS", 0.0), ("FLASKS", 1.0)]);
    let looks_at = |name: &&str| idle.contains(&(*name).to_owned());
    let any = ["list", "list_counts", "long_lists", "maps", "plane"];
    assert_eq!(any.iter().find(|name| looks_at(name)), None, "{idle:?}");
    let carried = bindings(sim::MULTIPLIER, &[("FIRST", 1.0)]);
    assert!(!carried.contains(&"velocity".to_owned()), "{carried:?}");
}

#[test]
fn a_buffer_that_the_solver_lacks_is_named() {
    let library = Library::watching();
    let renamed = |shader: ShaderId| {
        let text = library.source(&shader).unwrap();
        (shader.path(), text.replace("list_origin", "elsewhere"))
    };
    let setup = Setup::new(parameters(), Vec::new(), Vec::new());
    let shaders = Library::from_sources(PASSES.map(renamed));
    let device = gpu::device();
    let made = setup.solver_of(&device, &shaders);
    let Err(SolverError::Gpu(GpuError::Binding { pass, binding, .. })) = made else {
        panic!("{:?}", made.err());
    };
    assert_eq!((&*pass, &*binding), ("sim/predict:main", "elsewhere"));
}

/// Labels of the passes of one frame, in their order.
pub fn passes(setup: &Setup, poses: &[Pose]) -> Vec<String> {
    let device = gpu::another_device(|options| options.timestamps = Timestamps::Passes);
    let solver = setup.solver(&device);
    let mut rec = device.recorder(QueueKind::Main).unwrap();
    solver.record(&mut rec, poses, poses).unwrap();
    let ticket = device.submit(rec).unwrap();
    ticket.wait().unwrap();
    let timings = ticket.timings().unwrap();
    timings.into_iter().map(|timing| timing.label).collect()
}

#[test]
fn frames_dispatch_what_the_scene_has() {
    let p = Parameters {
        substeps: 3,
        iterations: 2,
        ..parameters()
    };
    let particles = water(&narrow_glass(), 0, Pose::IDENTITY, 200);
    let full = Setup {
        loads: true,
        parameters: Parameters {
            carry_rate: 10.0,
            ..p.clone()
        },
        ..Setup::new(p.clone(), vec![narrow_glass()], particles.clone())
    };
    let falling = particles
        .into_iter()
        .map(|particle| drop_at(particle.position, particle.velocity));
    let bare = Setup::new(p, Vec::new(), falling.collect());
    let own = passes(&bare, &[]);
    let count = |labels: &[String], name: &str| labels.iter().filter(|l| l.contains(name)).count();
    assert_eq!(count(&own, "sim/load"), 0, "{own:?}");
    // Two over neighbours an iteration, one for the forces: 3 × (2 × 2 + 1).
    let over_neighbours = ["multiplier", "displacement", "forces"];
    let sum = |labels: &[String]| -> usize {
        over_neighbours.iter().map(|name| count(labels, name)).sum()
    };
    assert_eq!(sum(&own), 15, "{own:?}");
    let theirs = passes(&full, &[Pose::IDENTITY]);
    assert_eq!(count(&theirs, "sim/load"), 1, "{theirs:?}");
    // Carried multipliers take one more pass a substep.
    assert_eq!(sum(&theirs), 18, "{theirs:?}");
    let with_forces = |vorticity: f64, tension: f64| {
        let setup = Setup {
            parameters: Parameters {
                vorticity,
                surface: (tension > 0.0).then(|| SurfaceTension::new(tension)),
                ..bare.parameters.clone()
            },
            ..bare.clone()
        };
        passes(&setup, &[])
    };
    // Vorticity costs one a substep.
    let vorticity = with_forces(0.1, 0.0);
    assert_eq!(count(&vorticity, "sim/vorticity"), 3, "{vorticity:?}");
    assert_eq!(with_forces(0.0, 0.0), own);
    // Surface tension costs eight passes every 5 ms, and clears its table.
    let tension = with_forces(0.0, 0.072);
    let of_tension = [
        "sim/colour",
        "sim/smooth_colour",
        "sim/interface",
        "sim/unfiltered_curvature",
        "sim/curvature",
        "sim/tension",
    ];
    let impulses = of_tension.map(|name| count(&tension, name));
    assert_eq!(impulses, [6, 2, 2, 2, 2, 2], "{tension:?}");
}

#[test]
fn loads_cost_memory_where_they_are_asked_for() {
    let device = gpu::device();
    let particles = water(&narrow_glass(), 0, Pose::IDENTITY, 400);
    let without = Setup::new(parameters(), vec![narrow_glass()], particles);
    let with = Setup {
        loads: true,
        ..without.clone()
    };
    let bytes = |setup: &Setup| setup.solver(&device).bytes_per_particle();
    // The push on the walls and its sorted copy, four floats each.
    assert_eq!(bytes(&with) - bytes(&without), 32);
}
