//! Helpers of the GPU solver's tests.

use glam::{DVec3, Vec3};
use serde::Deserialize;
use vitriol_gpu::{Gpu, QueueKind};
use vitriol_shaders::Library;
use vitriol_shaders::layout::LiquidLoad;
use vitriol_sim::bodies::Hand;
use vitriol_sim::fill::{FillError, fill};
use vitriol_sim::flask::Profile;
use vitriol_sim::flask::particles::BoundaryParticle;
use vitriol_sim::parameters::Parameters;
use vitriol_sim::pose::Pose;
use vitriol_sim::scene::Scene;
use vitriol_sim::solver::{Ground, Particle, Solver, SolverError, SolverSpec, SolverState};
use vitriol_sim::world::{StepInput, World};
use vitriol_tests::list;
pub use vitriol_tests::random::Random;

/// Spacing of real glass, metres.
pub const D: f64 = 0.0025;
/// Support radius, metres.
pub const H: f64 = 2.0 * D;
/// A substep of 90 Hz × 12, seconds.
pub const SUBSTEP: f64 = 1.0 / 1080.0;

/// Real size at 90 Hz × 12 × 4.
pub fn parameters() -> Parameters {
    Parameters::of_water(D)
}

/// [`parameters`] with frames of one substep each, so that the state after every substep can be read.
pub fn single_substeps() -> Parameters {
    Parameters {
        frame_time: SUBSTEP,
        substeps: 1,
        ..parameters()
    }
}

/// [`single_substeps`] without gravity: a lone particle keeps its velocity.
pub fn weightless() -> Parameters {
    Parameters {
        gravity: [0.0; 3],
        ..single_substeps()
    }
}

/// A hand that is seen.
pub fn tracked_hand(stage_from_grip: Pose, squeeze: f32) -> Hand {
    Hand {
        stage_from_grip,
        squeeze,
        present: true,
    }
}

/// A step of a world in which no hand is seen.
pub const AWAY: StepInput = StepInput::of_hands([Hand::ABSENT; 2]);

/// So many steps without hands.
pub fn steps(world: &mut World, count: u32) {
    for _ in 0..count {
        world.step(&AWAY).unwrap();
    }
}

/// `beaker` with twice its spacing and half its substeps, at which the substep is as near to its limit, and so much water, m³.
pub fn coarse_beaker(volume: f64) -> Scene {
    let mut scene = Scene::builtin("beaker").unwrap();
    scene.scale.spacing *= 2.0;
    scene.solver.substeps = 5;
    for liquid in &mut scene.liquids {
        liquid.volume = volume;
    }
    scene
}

/// No table, and a floor out of reach.
pub const NOWHERE: Ground = Ground {
    floor: -1000.0,
    table: None,
    scale: 1.0,
};

/// A glass 26 mm wide, 60 mm deep, of which 800 particles fill 24 mm.
pub fn narrow_glass() -> Profile {
    Profile::new(&[[0.0, 0.013], [0.06, 0.013]], 0.002).unwrap()
}

/// `count` particles at rest in flask `flask` of shape `profile` at `pose`.
pub fn water(profile: &Profile, flask: usize, pose: Pose, count: usize) -> Vec<Particle> {
    inside(flask, fill(profile, pose, count, D, Some(1)))
}

/// The same `spacing` (m) apart, in the first flask.
pub fn water_of(profile: &Profile, pose: Pose, spacing: f64, count: usize) -> Vec<Particle> {
    inside(0, fill(profile, pose, count, spacing, Some(1)))
}

fn inside(flask: usize, positions: Result<Vec<DVec3>, FillError>) -> Vec<Particle> {
    let inside = |position| Particle {
        flask: Some(flask),
        ..drop_at(position, DVec3::ZERO)
    };
    positions.unwrap().into_iter().map(inside).collect()
}

/// A particle that is in no flask.
pub fn drop_at(position: DVec3, velocity: DVec3) -> Particle {
    Particle {
        position,
        velocity,
        flask: None,
        temperature: 20.0,
        acid: 0.0,
        carried: 0.0,
    }
}

/// A pose without rotation.
pub fn at(x: f32, y: f32, z: f32) -> Pose {
    Pose::from_position(Vec3::new(x, y, z))
}

/// An owned [`SolverSpec`]; lanes are 1 unless a test sets more.
#[derive(Clone, Debug)]
pub struct Setup {
    pub parameters: Parameters,
    pub flasks: Vec<Profile>,
    /// Boundary particles of each flask, instead of maps.
    pub solids: Option<Vec<Vec<BoundaryParticle>>>,
    pub ground: Ground,
    pub particles: Vec<Particle>,
    pub loads: bool,
    pub tools: bool,
    pub at_rest: bool,
    pub lanes: Option<u32>,
}

impl Setup {
    pub fn new(parameters: Parameters, flasks: Vec<Profile>, particles: Vec<Particle>) -> Self {
        Self {
            parameters,
            flasks,
            solids: None,
            ground: NOWHERE,
            particles,
            loads: false,
            tools: false,
            at_rest: false,
            lanes: Some(1),
        }
    }

    pub fn solver(&self, gpu: &Gpu) -> Solver {
        self.solver_of(gpu, &Library::watching()).unwrap()
    }

    pub fn solver_of(&self, gpu: &Gpu, shaders: &Library) -> Result<Solver, SolverError> {
        let spec = SolverSpec {
            parameters: self.parameters.clone(),
            flasks: &self.flasks,
            solids: self.solids.as_deref(),
            ground: self.ground,
            particles: &self.particles,
            at_rest: self.at_rest,
            tools: self.tools,
            loads: self.loads,
            constraint: true,
            lanes: self.lanes,
        };
        Solver::new(gpu, shaders, &spec)
    }
}

/// Runs one frame; returns the liquid's load on each flask.
pub fn frame(gpu: &Gpu, solver: &Solver, before: &[Pose], after: &[Pose]) -> Vec<LiquidLoad> {
    let mut rec = gpu.recorder(QueueKind::Main).unwrap();
    let record = solver.record(&mut rec, before, after).unwrap();
    gpu.submit(rec).unwrap().wait().unwrap();
    record.loads().unwrap()
}

/// Runs frames with flasks that stand still.
pub fn frames(gpu: &Gpu, solver: &Solver, poses: &[Pose], count: usize) {
    for _ in 0..count {
        frame(gpu, solver, poses, poses);
    }
}

/// ρ/ρ₀ by slot.
pub fn densities(gpu: &Gpu, solver: &Solver) -> Vec<f64> {
    let mut rec = gpu.recorder(QueueKind::Main).unwrap();
    let copy = solver.record_density(&mut rec).unwrap();
    gpu.submit(rec).unwrap().wait().unwrap();
    let densities = copy.get::<f32>().unwrap();
    densities[..solver.count() as usize]
        .iter()
        .map(|&density| f64::from(density))
        .collect()
}

/// One particle as the GPU left it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Found {
    pub position: DVec3,
    pub velocity: DVec3,
    /// −p/ρ, m²/s².
    pub carried: f64,
    pub flask: Option<usize>,
    pub present: bool,
}

/// The particles in the order in which the solver was given them.
pub fn particles(state: &SolverState) -> Vec<Found> {
    let mut found: Vec<_> = (0..state.tags.len())
        .map(|slot| {
            let [x, y, z, _] = state.positions[slot].map(f64::from);
            let [u, v, w, carried] = state.velocities[slot].map(f64::from);
            let found = Found {
                position: DVec3::new(x, y, z),
                velocity: DVec3::new(u, v, w),
                carried,
                flask: state.flask_of(slot),
                present: state.is_present(slot),
            };
            (state.tags[slot][1], found)
        })
        .collect();
    found.sort_by_key(|&(identity, _)| identity);
    for (index, &(identity, _)) in found.iter().enumerate() {
        assert_eq!(index, identity as usize, "a particle was lost or doubled");
    }
    found.into_iter().map(|(_, found)| found).collect()
}

/// 1, and as many lanes as a GPU takes for a small scene, if the device can.
pub fn lanes(gpu: &Gpu) -> Vec<u32> {
    if gpu.info().features.subgroups {
        vec![1, 8]
    } else {
        vec![1]
    }
}

/// The neighbour list out of a state, by slot. The state keeps it to itself,
/// but not from a serialiser.
pub struct List {
    /// Predicted positions when the list was built.
    pub origins: Vec<DVec3>,
    /// Slots of each particle's neighbours, in the list's order.
    pub neighbours: Vec<Vec<usize>>,
}

impl List {
    /// The list of a state whose particles have `capacity` places each.
    pub fn of(state: &SolverState, capacity: u32) -> Self {
        #[derive(Deserialize)]
        struct Fields {
            positions: Vec<[f32; 4]>,
            _velocities: Vec<[f32; 4]>,
            _tags: Vec<[u32; 2]>,
            list_origin: Vec<[f32; 4]>,
            list_counts: Vec<u32>,
            list: Vec<u32>,
            _counters: Vec<u32>,
        }
        let bytes = postcard::to_allocvec(state).unwrap();
        // Postcard stores fields in their order and no names.
        let fields: Fields = postcard::from_bytes(&bytes).unwrap();
        let n = fields.positions.len();
        let capacity = capacity as usize;
        // Behind the places lie the lists that are longer, if they have room.
        let mut behind = list::words(n, capacity);
        let has_room = fields.list.len() > behind;
        let mut row = |slot: usize| -> Vec<usize> {
            let count = fields.list_counts[slot] as usize;
            if has_room && count > capacity {
                let row = &fields.list[behind..behind + count];
                behind += count.next_multiple_of(4);
                return row.iter().map(|&other| other as usize).collect();
            }
            let place = |k| list::place(slot, k, capacity);
            let listed = 0..count.min(capacity);
            listed.map(|k| fields.list[place(k)] as usize).collect()
        };
        let origin = |v: &[f32; 4]| DVec3::new(v[0].into(), v[1].into(), v[2].into());
        Self {
            origins: fields.list_origin.iter().map(origin).collect(),
            neighbours: (0..n).map(&mut row).collect(),
        }
    }
}

/// Closest two of all particles, metres.
pub fn closest_pair(found: &[Found]) -> f64 {
    let mut closest = f64::INFINITY;
    for (i, a) in found.iter().enumerate() {
        for b in &found[..i] {
            closest = closest.min(a.position.distance(b.position));
        }
    }
    closest
}
