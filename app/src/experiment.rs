//! The simulated world and its picture on a Vulkan device, as the loop drives
//! them.

use std::collections::BTreeMap;

use glam::Affine3A;
use vitriol_gpu::{Gpu, QueueKind};
use vitriol_render::{
    ColourBy, FrameDesc, ParticleSource, RenderDesc, RenderError, Renderer, SceneDesc, VesselDesc,
    View,
};
use vitriol_shaders::Library;
use vitriol_sim::bodies;
use vitriol_sim::measure::Measurement;
use vitriol_sim::pose::Pose;
use vitriol_sim::scene::Scene;
use vitriol_sim::world::{StepInput, World, WorldError};
use vitriol_xr::{Hand, PoseFrame};

use crate::command::replay::Setup;
use crate::device;
use crate::failure::{Blame, Failure};
use crate::replay::{Experiment, Outcome};
use crate::report::{Counters, MassByPlace, Sample};

/// Radius of a drawn particle over the particle spacing: closes the gaps
/// between neighbours, and a single drop still looks like one.
const DRAWN_RADIUS: f64 = 0.6;

/// A fall over this height (m, real) gives the speed at the end of the colour
/// map: about that from one flask's lip to another's floor.
const COLOURED_FALL: f64 = 0.075;

/// The experiment of a scene on the device that was asked for.
///
/// # Errors
/// [`Failure::NoDevice`]; [`Failure::Input`] for a device that is not there or
/// a liquid that does not fit.
pub fn prepare(setup: &Setup<'_>) -> Result<Box<dyn Experiment>, Failure> {
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

/// The film's camera on its tripod.
struct Camera {
    renderer: Renderer,
    view: View,
}

impl Camera {
    fn new(gpu: &Gpu, library: &Library, scene: &Scene, extent: [u32; 2]) -> Result<Self, Failure> {
        let vessels = scene.flasks.iter().map(|flask| VesselDesc {
            inner: flask.profile.inner_outline().to_vec(),
            outer: flask.profile.outer_outline().to_vec(),
        });
        let length_scale = scene.scale.length_scale as f32;
        let table_top = scene.table.map_or(0.0, |table| table.top as f32);
        let mut desc =
            SceneDesc::laboratory(vessels.collect(), table_top * length_scale, length_scale);
        if scene.table.is_none() {
            desc.table = None;
        }
        let film = RenderDesc::film(extent);
        let mut renderer = Renderer::new(gpu, library, &film).other()?;
        renderer.set_scene(&desc).other()?;
        Ok(Self {
            renderer,
            view: View::bench(extent[0] as f32 / extent[1] as f32),
        })
    }

    fn shoot(&self, world: &World) -> Result<Vec<u8>, Failure> {
        let scale = &world.scene().scale;
        let vessels: Vec<Affine3A> = world.poses().iter().map(affine).collect();
        let fastest = (2.0 * scale.gravity.abs() * COLOURED_FALL / scale.length_scale).sqrt();
        let solver = world.solver();
        let frame = FrameDesc {
            views: &[self.view],
            vessels: &vessels,
            particles: Some(ParticleSource {
                positions: solver.positions(),
                velocities: solver.velocities(),
                count: solver.count(),
                radius: (DRAWN_RADIUS * scale.spacing) as f32,
            }),
            colour_by: ColourBy::Speed(fastest as f32),
            length_scale: scale.length_scale as f32,
        };
        let draw = || -> Result<Vec<u8>, RenderError> {
            let gpu = world.gpu();
            let mut rec = gpu.recorder(QueueKind::Main)?;
            self.renderer.record(&mut rec, &frame)?;
            let picture = self.renderer.read_back(&mut rec)?;
            gpu.submit(rec)?.wait()?;
            picture.first_view()
        };
        draw().other()
    }
}

fn affine(pose: &Pose) -> Affine3A {
    Affine3A::from_rotation_translation(pose.orientation, pose.position)
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
