//! The simulated world and its picture on a Vulkan device, as the loop drives
//! them.

mod sampled;
mod switched;

use std::sync::Arc;

use vitriol_gpu::{Gpu, QueueKind};
use vitriol_lesson as lesson;
use vitriol_lesson::procedure::Progress;
use vitriol_render::PassPicture;
use vitriol_shaders::{Library, ShaderId};
use vitriol_sim::measure::{Departures, Ledger};
use vitriol_sim::scene::{PictureFilter, PictureRoom, PictureTint, Preset, Scene};
use vitriol_sim::solver::Held;
use vitriol_sim::world::{World, WorldError};
use vitriol_sound::Event;
use vitriol_xr::{Pose, PoseFrame};

use crate::audible::Audible;
use crate::camera::{Camera, Colour, Look, Shot};
use crate::clock::SimulatedTime;
use crate::device;
use crate::experiment::{Counters, Experiment, Glimpse, Heard, Outcome, Taken};
use crate::failure::{Blame, Failure};
use crate::instruction::Instruction;
use crate::judging::Judging;
use crate::looks::{Looked, Looks};
use crate::sample::{MassByPlace, Sample};
use crate::scenery::drawn_liquid;
use crate::scenes::Scenes;
use crate::stage;

use sampled::{by_flask, of_heat};

/// What an experiment is made of.
#[derive(Debug)]
pub struct Setup<'a> {
    /// The scene, its preset applied.
    pub scene: &'a Scene,
    /// Its name, for messages.
    pub scene_name: &'a str,
    /// Where scenes that the track switches to are looked up.
    pub scenes: &'a Scenes,
    /// That preset, for scenes that the track switches to.
    pub preset: Preset,
    /// Seed of the initial jitter.
    pub seed: u64,
    /// Number or part of the name of the device; the best one without.
    pub device: Option<&'a str>,
    /// Width and height of the pictures, pixels; `None` where none is asked for.
    pub picture: Option<[u32; 2]>,
    /// What each film's colours stand for, in the films' order.
    pub colours: Vec<Colour>,
    /// Views side by side: 1, or 2 for both eyes.
    pub eyes: u32,
    /// Filter of the liquid's surface; `None` for the scene's.
    pub filter: Option<PictureFilter>,
    /// What tells the liquids apart; `None` for the scene's.
    pub tint: Option<PictureTint>,
    /// How bright the room is; `None` for the scene's.
    pub room: Option<PictureRoom>,
    /// The head at the start (stage_from_view), where the pictures are what it
    /// sees; `None` for a fixed camera.
    pub head: Option<Pose>,
    /// Where a fixed camera is; `None` for the tripod.
    pub look: Option<Look>,
    /// The shaders; where it watches a folder, what changes there is reloaded
    /// between two steps.
    pub shaders: Arc<Library>,
}

/// The experiment of a scene on the device that was asked for.
///
/// # Errors
/// [`Failure::NoDevice`]; [`Failure::Input`] for a device that is not there or
/// a liquid that does not fit.
pub fn prepare(setup: &Setup<'_>) -> Result<Box<dyn Experiment>, Failure> {
    on_device(&device::open(setup.device)?, setup)
}

/// The same on a device that is open already.
///
/// # Errors
/// [`Failure::Input`] for a liquid that does not fit.
pub fn on_device(gpu: &Gpu, setup: &Setup<'_>) -> Result<Box<dyn Experiment>, Failure> {
    Ok(Box::new(Laboratory::new(gpu, setup)?))
}

/// Looks that may be under way: the device does its work meanwhile, as with what pushes on the flasks.
const MOST_LOOKS: usize = 2;

/// The camera for the pictures that were asked for.
fn camera(
    world: &World,
    library: &Library,
    shot: Option<Shot>,
    colours: &[Colour],
) -> Result<Option<Camera>, Failure> {
    let liquid = colours.contains(&Colour::Liquid);
    let of_world = |shot: Shot| {
        let shot = Shot {
            liquid: liquid.then(|| drawn_liquid(world)),
            ..shot
        };
        Camera::new(world.gpu(), library, world.scene(), &shot)
    };
    shot.map(of_world).transpose()
}

/// The simulated world and its picture on a device.
pub struct Laboratory {
    world: World,
    film: Option<Camera>,
    /// What the film's pictures are like, whatever the scene.
    shot: Option<Shot>,
    preset: Preset,
    scenes: Scenes,
    /// The scene's name at the start, and that of the scene that a switch brought up.
    begun_with: String,
    switched: Option<String>,
    follows_head: bool,
    /// Whether glass breaks.
    breakable: bool,
    seed: u64,
    shaders: Arc<Library>,
    /// Most particles on the wrong side of a wall in any measurement.
    lost: u64,
    /// Substeps done.
    substeps: u64,
    /// Times that a switch changed substeps or iterations.
    solver_changes: u64,
    flasks_broken: u64,
    departures: Departures,
    /// The ledger at the first sample.
    start: Option<Ledger>,
    colours: Vec<Colour>,
    picture: Vec<u8>,
    audible: Audible,
    time: SimulatedTime,
    looks: Looks,
    /// What could be heard since it was asked for last.
    heard: Vec<Event>,
    /// What was found so far.
    found: Vec<lesson::Event>,
    /// The lesson that is judged, if one is.
    judging: Option<Judging>,
    /// What was said of it.
    progress: Vec<Progress>,
    /// What an instructor did, and when, s.
    instructions: Vec<(f64, Instruction)>,
    /// Whether boiling is not heard.
    muted: bool,
    /// By flask, at the last look, and what lay on bench and floor, real m³.
    seen: (Vec<Held>, [f64; 2]),
}

impl Laboratory {
    /// One of the scene that was asked for.
    ///
    /// # Errors
    /// [`Failure::Input`] for a liquid that does not fit.
    pub fn new(gpu: &Gpu, setup: &Setup<'_>) -> Result<Self, Failure> {
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
        let shot = setup.picture.map(|extent| Shot {
            extent,
            eyes: setup.eyes,
            liquid: None,
            filter: setup.filter,
            tint: setup.tint,
            room: setup.room,
            look: setup.look,
            foveation: None,
        });
        let mut film = camera(&world, library, shot, &setup.colours)?;
        if let (Some(camera), Some(head)) = (&mut film, &setup.head) {
            camera.follow(head);
        }
        Ok(Self {
            world,
            film,
            shot,
            preset: setup.preset,
            scenes: setup.scenes.clone(),
            begun_with: setup.scene_name.to_owned(),
            switched: None,
            follows_head: setup.head.is_some(),
            breakable: false,
            seed: setup.seed,
            shaders: setup.shaders.clone(),
            lost: 0,
            substeps: 0,
            solver_changes: 0,
            flasks_broken: 0,
            departures: Departures::default(),
            start: None,
            colours: setup.colours.clone(),
            picture: Vec::new(),
            audible: Audible::of(setup.scene),
            time: SimulatedTime::default(),
            looks: Looks::of(setup.scene_name, setup.scene),
            heard: Vec::new(),
            found: Vec::new(),
            judging: None,
            progress: Vec::new(),
            instructions: Vec::new(),
            muted: false,
            seen: (Vec::new(), [0.0; 2]),
        })
    }

    /// The simulated world now.
    pub fn world(&self) -> &World {
        &self.world
    }

    /// The camera of the pictures that were asked for.
    pub fn camera(&self) -> Option<&Camera> {
        self.film.as_ref()
    }

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
                "reloaded: {names}; the report's command line no longer gives this run"
            ),
            Err(failure) => tracing::warn!("the old {names} stay in use: {failure}"),
        }
    }

    fn rebuild(&mut self, changed: &[ShaderId]) -> Result<(), Failure> {
        let solves = changed.iter().any(|id| id.path().starts_with("sim/"));
        let renewed = solves.then(|| self.renewed_world()).transpose()?;
        if let Some(camera) = &mut self.film {
            let renderer = &mut camera.renderer;
            renderer.reload(&self.shaders, changed).other()?;
        }
        if let Some(world) = renewed {
            self.world = world;
        }
        Ok(())
    }

    /// Takes in the looks that are older than the newest ones, so many of them; waits for the device.
    fn collect_looks(&mut self, newest: usize) -> Result<(), Failure> {
        while self.looks.under_way() > newest {
            let Some(looked) = self.looks.wait()? else {
                break;
            };
            if let Some(judging) = &mut self.judging {
                let scene = self.switched.as_ref().unwrap_or(&self.begun_with);
                let said = judging.looked(scene, &looked, || self.looks.so_far());
                self.progress.extend(said);
            }
            let Looked {
                census,
                elapsed,
                poses,
                t,
                events,
                ..
            } = looked;
            self.found.extend(events);
            let real = self.world.scene().scale.length_scale.powi(3);
            self.seen.1 = [&census.table, &census.floor].map(|held| real * held.volume);
            self.seen.0.clone_from(&census.flasks);
            if self.film.is_some() {
                // From the look before on: the film's sound up to now is not made yet.
                let since = t - elapsed;
                let heard = self.audible.looked(&poses, &census, elapsed, since);
                self.heard.extend(heard);
            }
        }
        if let Some(camera) = &mut self.film {
            camera.show_temperature(self.looks.thermometer());
        }
        Ok(())
    }

    /// What went on in the attempt is over.
    fn end_attempt(&mut self) -> Result<(), Failure> {
        self.collect_looks(0)?;
        let events = self.looks.end();
        if let Some(judging) = &mut self.judging {
            let scene = self.switched.as_ref().unwrap_or(&self.begun_with);
            self.progress.extend(judging.ended(scene, &events));
        }
        self.found.extend(events);
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
    fn step(&mut self, frame: &PoseFrame) -> Result<Taken, Failure> {
        self.take_up_shaders();
        let anew = self.switch(&frame.scenario)?;

        if let Some(camera) = &mut self.film
            && self.follows_head
        {
            let scene = self.world.scene();
            let origin = scene.origin * scene.scale.length_scale;
            let mut view = frame.stage_from_view;
            view.position -= origin.as_vec3();
            camera.follow(&view);
            let mut hands = frame.hands.clone();
            for hand in &mut hands {
                hand.stage_from_grip.position -= origin.as_vec3();
            }
            camera.show_hands(hands);
        }
        let scale = self.world.scene().scale;
        let input = stage::input(frame, self.world.scene());
        self.world.step(&input).map_err(blame_world)?;
        self.substeps += u64::from(self.world.scene().solver.substeps);
        self.flasks_broken += self.world.breaks().len() as u64;
        self.time.advance(scale.frame_time);
        let t = self.time.seconds();
        self.looks
            .look(&mut self.world, QueueKind::Main, frame, t)?;
        if self.film.is_some() {
            let held = |flask| self.world.holder(flask).is_some();
            let blows = self.audible.struck(self.world.strikes(), held, t);
            self.heard.extend(blows);
            let broke = self.audible.broke(self.world.breaks(), t);
            self.heard.extend(broke);
        }
        self.collect_looks(MOST_LOOKS)?;
        Ok(Taken {
            frame_time: scale.frame_time,
            anew,
        })
    }

    fn sample(&mut self, t: f64) -> Result<Sample, Failure> {
        let state = self.world.solver().snapshot().other()?;
        let measured = self.world.measure_state(&state).map_err(blame_world)?;
        self.lost = self.lost.max(measured.lost_particles);
        let scene = self.world.scene();
        let mass = self.world.solver().parameters().particle_mass();
        let poses = self.world.poses();
        let departed = self.departures.observe(&state, &scene.flasks, poses, mass);
        let ledger = measured.heat.as_ref().and_then(|heat| heat.ledger);
        let start = *self.start.get_or_insert(ledger.unwrap_or_default());
        Ok(Sample {
            t_s: t,
            density_error_mean: measured.density_error_mean,
            density_error_p99: measured.density_error_p99,
            kinetic_energy_j: measured.kinetic_energy,
            mass_kg: MassByPlace {
                flasks: by_flask(scene, &measured.in_flasks),
                table: measured.on_table,
                floor: measured.on_floor,
                air: measured.in_air,
            },
            neighbour_rebuilds: measured.list_rebuilds.into(),
            left_kg: by_flask(scene, &departed.left),
            above_rim_kg: by_flask(scene, &departed.above_rim),
            heat: measured.heat.map(|heat| of_heat(scene, &heat, &start)),
        })
    }

    fn picture(&mut self, film: usize) -> Result<&[u8], Failure> {
        if let (Some(camera), Some(&colour)) = (&self.film, self.colours.get(film)) {
            self.picture = camera.shoot(&self.world, colour)?;
        }
        Ok(&self.picture)
    }

    fn heard(&mut self) -> Result<Heard, Failure> {
        let Some(listener) = self.film.as_ref().map(Camera::listener) else {
            return Ok(Heard::default());
        };
        self.collect_looks(0)?;
        let events = std::mem::take(&mut self.heard);
        Ok(Heard { listener, events })
    }

    fn passes(&mut self) -> Result<Vec<PassPicture>, Failure> {
        let passes = self.film.as_ref().map(|camera| camera.passes(&self.world));
        passes.unwrap_or_else(|| Ok(Vec::new()))
    }

    fn judge(&mut self, lesson: Judging) {
        self.judging = Some(lesson);
    }

    fn glimpse(&self) -> Option<Glimpse<'_>> {
        Some(Glimpse {
            scene: (self.world.scene(), self.switched.as_deref()),
            flasks: &self.seen.0,
            spilt: self.seen.1,
            intensity: self.world.intensity(),
            events: &self.found,
            instructions: &self.instructions,
        })
    }

    fn outcome(&mut self) -> Result<Outcome, Failure> {
        self.end_attempt()?;
        let measured = self.world.measure().map_err(blame_world)?;
        let counted = self.world.counters().map_err(blame_world)?;
        let state = self.world.snapshot().map_err(blame_world)?;
        let limiters = [
            ("more neighbours than places", counted.list_overflows),
            (
                "correction cut to the neighbour list's reach",
                counted.list_limited,
            ),
            ("speed cut to v_max", counted.speed_limited),
            ("diffusion cut to what there is", counted.diffusion_limited),
            (
                "boiling cut to 30 % of a relative velocity",
                counted.growth_limited,
            ),
            ("density taken at the end of its table", counted.table_ends),
            ("surface tension left out", counted.tension_skipped),
            ("bubble without a place", counted.bubbles_refused),
            ("gas cut to what a neighbourhood holds", counted.gas_limited),
            ("drops of a jet or film left out", counted.spray_refused),
        ];
        Ok(Outcome {
            scene: self.switched.clone(),
            effort: self.world.effort(),
            fluid_particles: self.world.solver().count().into(),
            lost_particles: self.lost.max(measured.lost_particles),
            nan_particles: measured.nan_particles,
            state_hash: state.solver.hash(),
            device: device::statement(self.world.gpu()),
            events: self.found.clone(),
            progress: self.progress.clone(),
            instructions: self.instructions.clone(),
            counters: Counters {
                substeps: self.substeps,
                solver_changes: self.solver_changes,
                flasks_broken: self.flasks_broken,
                neighbour_rebuilds: counted.list_rebuilds.into(),
                limiters: limiters
                    .map(|(name, times)| (name.to_owned(), times.into()))
                    .into_iter()
                    .collect(),
            },
        })
    }
}

fn blame_world(error: WorldError) -> Failure {
    match error {
        WorldError::Fill(_) => Failure::Input(error.into()),
        _ => Failure::Other(error.into()),
    }
}
