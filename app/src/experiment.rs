//! The simulated world and its picture on a Vulkan device, as the loop drives
//! them.

use std::collections::BTreeMap;

use vitriol_shaders::Library;
use vitriol_sim::bodies;
use vitriol_sim::measure::Measurement;
use vitriol_sim::pose::Pose;
use vitriol_sim::scene::{Feature, Scene};
use vitriol_sim::world::{StepInput, World, WorldError};
use vitriol_xr::{Hand, PoseFrame};

use crate::camera::Camera;
use crate::command::replay::Setup;
use crate::device;
use crate::failure::Failure;
use crate::replay::{Experiment, Outcome};
use crate::report::{Counters, MassByPlace, Sample};

/// The experiment of a scene on the device that was asked for.
///
/// # Errors
/// [`Failure::NoDevice`]; [`Failure::Input`] for a device that is not there or
/// a liquid that does not fit.
pub fn prepare(setup: &Setup<'_>) -> Result<Box<dyn Experiment>, Failure> {
    if setup.scene.models(Feature::Heat) {
        tracing::warn!("heat, dilution and boiling are not simulated yet: the scene runs without");
    }
    let gpu = device::open(setup.device, false)?;
    let library = Library::embedded();
    let world = World::new(&gpu, &library, setup.scene, setup.seed).map_err(blame_world)?;
    let film = match setup.picture {
        Some((width, height)) => Some(Camera::new(&gpu, &library, setup.scene, [width, height])?),
        None => None,
    };
    Ok(Box::new(Laboratory {
        world,
        film,
        picture: Vec::new(),
    }))
}

struct Laboratory {
    world: World,
    film: Option<Camera>,
    picture: Vec<u8>,
}

impl Experiment for Laboratory {
    fn step(&mut self, frame: &PoseFrame) -> Result<(), Failure> {
        let length_scale = self.world.scene().scale.length_scale;
        let hands = frame.hands.each_ref().map(|hand| grip(hand, length_scale));
        self.world.step(&StepInput { hands }).map_err(blame_world)
    }

    fn sample(&mut self, t: f64) -> Result<Sample, Failure> {
        let measured = self.world.measure().map_err(blame_world)?;
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
            lost_particles: measured.lost_particles,
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
