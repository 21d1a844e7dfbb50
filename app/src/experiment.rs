//! The simulated world and its picture on a Vulkan device, as the loop drives
//! them.

use std::collections::BTreeMap;
use std::sync::Arc;

use vitriol_gpu::Gpu;
use vitriol_shaders::{Library, ShaderId};
use vitriol_sim::bodies;
use vitriol_sim::measure::Measurement;
use vitriol_sim::pose::Pose;
use vitriol_sim::scene::Scene;
use vitriol_sim::world::{StepInput, World, WorldError};
use vitriol_xr::{Hand, PoseFrame};

use crate::camera::Camera;
use crate::command::replay::Setup;
use crate::device;
use crate::failure::{Blame, Failure};
use crate::replay::{Experiment, Outcome};
use crate::report::{Counters, MassByPlace, Sample};

/// The experiment of a scene on the device that was asked for.
///
/// # Errors
/// [`Failure::NoDevice`]; [`Failure::Input`] for a device that is not there or
/// a liquid that does not fit.
pub fn prepare(setup: &Setup<'_>) -> Result<Box<dyn Experiment>, Failure> {
    on_device(&device::open(setup.device, false)?, setup)
}

/// The same on a device that is open already.
///
/// # Errors
/// [`Failure::Input`] for a liquid that does not fit.
pub fn on_device(gpu: &Gpu, setup: &Setup<'_>) -> Result<Box<dyn Experiment>, Failure> {
    let library = &setup.shaders;
    let world = World::new(gpu, library, setup.scene, setup.seed).map_err(|error| {
        match blame_world(error) {
            // What is wrong with a scene is said with its file.
            Failure::Input(cause) => {
                Failure::Input(format!("{}: {cause}", setup.scene_name).into())
            }
            failure => failure,
        }
    })?;
    let mut film = match setup.picture {
        Some((width, height)) => Some(Camera::new(gpu, library, setup.scene, [width, height])?),
        None => None,
    };
    if let (Some(camera), Some(head)) = (&mut film, &setup.head) {
        camera.follow(head);
    }
    Ok(Box::new(Laboratory {
        world,
        film,
        follows_head: setup.head.is_some(),
        seed: setup.seed,
        shaders: setup.shaders.clone(),
        lost: 0,
        picture: Vec::new(),
    }))
}

struct Laboratory {
    world: World,
    film: Option<Camera>,
    follows_head: bool,
    seed: u64,
    shaders: Arc<Library>,
    /// Most particles on the wrong side of a wall in any measurement.
    lost: u64,
    picture: Vec<u8>,
}

impl Laboratory {
    /// Takes up shaders that were changed on disk. What does not compile, or
    /// what the device refuses, leaves the old ones in use: who is writing a
    /// shader mends it and goes on.
    fn take_up_shaders(&mut self) {
        let changed = self.shaders.changed();
        if changed.is_empty() {
            return;
        }
        let names: Vec<_> = changed.iter().map(ShaderId::path).collect();
        let names = names.join(", ");
        match self.rebuild(&changed) {
            Ok(()) => tracing::warn!(
                "taken up: {names}; the report's command line no longer gives this run"
            ),
            Err(failure) => tracing::warn!("the old {names} stay in use: {failure}"),
        }
    }

    fn rebuild(&mut self, changed: &[ShaderId]) -> Result<(), Failure> {
        let solves = changed.iter().any(|id| id.path().starts_with("sim/"));
        let renewed = solves.then(|| self.renewed_world()).transpose()?;
        if let Some(camera) = &mut self.film {
            camera.reload(&self.shaders, changed).other()?;
        }
        if let Some(world) = renewed {
            self.world = world;
        }
        Ok(())
    }

    /// A new world with the old one's state: shaders change seldom, and a
    /// state that survives a change of device survives this too.
    fn renewed_world(&self) -> Result<World, Failure> {
        let state = self.world.snapshot().map_err(blame_world)?;
        let (gpu, scene) = (self.world.gpu(), self.world.scene());
        let mut world = World::new(gpu, &self.shaders, scene, self.seed).map_err(blame_world)?;
        world.restore(&state).map_err(blame_world)?;
        Ok(world)
    }
}

impl Experiment for Laboratory {
    fn step(&mut self, frame: &PoseFrame) -> Result<(), Failure> {
        self.take_up_shaders();

        if let Some(camera) = &mut self.film
            && self.follows_head
        {
            camera.follow(&frame.stage_from_view);
        }
        let length_scale = self.world.scene().scale.length_scale;
        let hands = frame.hands.each_ref().map(|hand| grip(hand, length_scale));
        self.world.step(&StepInput { hands }).map_err(blame_world)
    }

    fn sample(&mut self, t: f64) -> Result<Sample, Failure> {
        let measured = self.world.measure().map_err(blame_world)?;
        self.lost = self.lost.max(measured.lost_particles);
        Ok(Sample {
            t_s: t,
            density_error_mean: measured.density_error_mean,
            density_error_p99: measured.density_error_p99,
            kinetic_energy_j: measured.kinetic_energy,
            mass_kg: by_place(self.world.scene(), &measured),
            neighbour_rebuilds: measured.list_rebuilds.into(),
        })
    }

    fn picture(&mut self) -> Result<&[u8], Failure> {
        if let Some(camera) = &self.film {
            self.picture = camera.shoot(&self.world)?;
        }
        Ok(&self.picture)
    }

    fn outcome(&mut self) -> Result<Outcome, Failure> {
        let measured = self.world.measure().map_err(blame_world)?;
        let counted = self.world.counters().map_err(blame_world)?;
        let state = self.world.snapshot().map_err(blame_world)?;
        let substeps = u64::from(self.world.scene().solver.substeps);
        let limiters = [
            ("neighbour list full", counted.list_overflows),
            (
                "correction cut to the neighbour list's margin",
                counted.list_limited,
            ),
            ("speed cut to v_max", counted.speed_limited),
        ];
        Ok(Outcome {
            fluid_particles: self.world.solver().count().into(),
            lost_particles: self.lost.max(measured.lost_particles),
            nan_particles: measured.nan_particles,
            state_hash: state.solver.hash(),
            device: device::statement(self.world.gpu()),
            counters: Counters {
                substeps: self.world.steps() * substeps,
                neighbour_rebuilds: counted.list_rebuilds.into(),
                limiters: limiters
                    .map(|(name, times)| (name.to_owned(), times.into()))
                    .into_iter()
                    .collect(),
            },
        })
    }
}

/// A recorded hand in the simulation's terms. Hands move in real metres, the
/// scene in its own.
fn grip(hand: &Hand, length_scale: f64) -> bodies::Hand {
    bodies::Hand {
        stage_from_grip: Pose {
            position: hand.stage_from_grip.position / length_scale as f32,
            orientation: hand.stage_from_grip.orientation,
        },
        squeeze: hand.squeeze.max(hand.trigger),
        present: hand.active && hand.valid,
    }
}

fn by_place(scene: &Scene, measured: &Measurement) -> MassByPlace {
    let names = scene.flasks.iter().map(|flask| flask.name.clone());
    let flasks: BTreeMap<_, _> = names.zip(measured.in_flasks.iter().copied()).collect();
    MassByPlace {
        flasks,
        table: measured.on_table,
        floor: measured.on_floor,
        air: measured.in_air,
    }
}

fn blame_world(error: WorldError) -> Failure {
    match error {
        WorldError::Fill(_) => Failure::Input(error.into()),
        _ => Failure::Other(error.into()),
    }
}
