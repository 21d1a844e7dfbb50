//! The simulated world and its picture on a Vulkan device, as the loop drives
//! them.

mod directed;
mod sampled;

use std::sync::Arc;

use vitriol_gpu::{Gpu, QueueKind};
use vitriol_lesson::Language;
use vitriol_render::PassPicture;
use vitriol_shaders::{Library, ShaderId};
use vitriol_sim::measure::{Departures, Ledger};
use vitriol_sim::scene::{PictureFilter, PictureRoom, PictureTint, Preset, Scene};
use vitriol_sim::world::World;
use vitriol_xr::{Pose, PoseFrame, Switch};

use crate::action::Action;
use crate::camera::{Camera, Colour, Look, Shot};
use crate::close_up::CloseUp;
use crate::device;
use crate::director::Director;
use crate::experiment::{Counters, Experiment, Glimpse, Heard, Outcome, Taken, Worth};
use crate::failure::{Blame, Failure, blame_world};
use crate::inset::Inset;
use crate::judging::Judging;
use crate::run::Run;
use crate::sample::{MassByPlace, Sample};
use crate::scenery::drawn_liquid;
use crate::scenes::Scenes;
use crate::stage;
use crate::track::key;

use directed::director;
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
    /// The preset that was applied, for scenes that the track switches to.
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
    /// Whether a director (`director.rs`) leads the camera, and leaves out what shows nothing.
    pub directed: bool,
    /// Where a fixed camera is; `None` for the tripod.
    pub look: Option<Look>,
    /// Language of the pictures' legends.
    pub language: Language,
    /// The shaders; where it watches a folder, what changes there is reloaded
    /// between two steps.
    pub shaders: Arc<Library>,
}

impl<'a> Setup<'a> {
    /// Of a scene on the best device, with the shaders of the program and without pictures. `scenes` are those that a
    /// track may bring up.
    pub fn without_pictures(
        scene: &'a Scene,
        (scene_name, scenes): (&'a str, &'a Scenes),
        preset: Preset,
        seed: u64,
    ) -> Self {
        Self {
            scene,
            scene_name,
            scenes,
            preset,
            seed,
            device: None,
            picture: None,
            colours: Vec::new(),
            eyes: 1,
            filter: None,
            tint: None,
            room: None,
            head: None,
            directed: false,
            look: None,
            language: Language::default(),
            shaders: Arc::new(Library::embedded()),
        }
    }
}

/// The experiment of a scene on the device that was asked for.
///
/// # Errors
/// [`Failure::NoDevice`]; [`Failure::Input`] for a device that is not there or
/// a liquid that does not fit.
pub fn prepare(setup: &Setup<'_>) -> Result<Box<dyn Experiment>, Failure> {
    on_device(&device::open(setup.device)?, setup)
}

/// The experiment of a scene on a device that is open already; [`prepare`] opens one.
///
/// # Errors
/// [`Failure::Input`] for a liquid that does not fit.
pub fn on_device(gpu: &Gpu, setup: &Setup<'_>) -> Result<Box<dyn Experiment>, Failure> {
    Ok(Box::new(Laboratory::new(gpu, setup)?))
}

/// Observations that may be under way: the device does its work meanwhile, as with what pushes on the flasks.
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

/// A run and its picture on a device.
pub struct Laboratory {
    run: Run,
    film: Option<Camera>,
    /// What the film's pictures are like, whatever the scene.
    shot: Option<Shot>,
    preset: Preset,
    scenes: Scenes,
    /// The scene's name where a switch brought it up.
    switched: Option<String>,
    follows_head: bool,
    directed: bool,
    director: Option<Director>,
    inset: Option<Inset>,
    close_up: CloseUp,
    seed: u64,
    shaders: Arc<Library>,
    /// Most particles on the wrong side of a wall in any measurement.
    lost: u64,
    departures: Departures,
    /// The ledger at the first sample.
    start: Option<Ledger>,
    colours: Vec<Colour>,
    picture: Vec<u8>,
}

impl Laboratory {
    /// A laboratory with the scene that was asked for.
    ///
    /// # Errors
    /// [`Failure::Input`] for a liquid that does not fit.
    pub fn new(gpu: &Gpu, setup: &Setup<'_>) -> Result<Self, Failure> {
        let library = &setup.shaders;
        let world = World::new(gpu, library, setup.scene, setup.seed).map_err(|error| {
            match blame_world(error) {
                // An error in a scene is reported with the scene's file.
                Failure::Input(cause) => {
                    Failure::Input(format!("{}: {cause}", setup.scene_name).into())
                }
                failure => failure,
            }
        })?;
        let shot = setup.picture.map(|extent| Shot {
            eyes: setup.eyes,
            filter: setup.filter,
            tint: setup.tint,
            room: setup.room,
            look: setup.look,
            language: setup.language,
            ..Shot::of(extent)
        });
        let mut film = camera(&world, library, shot, &setup.colours)?;
        if let (Some(camera), Some(head)) = (&mut film, &setup.head) {
            camera.follow(head);
        }
        Ok(Self {
            run: Run::new(setup.scene_name, world),
            director: director(setup.directed, setup.scene, film.as_ref()),
            film,
            shot,
            preset: setup.preset,
            scenes: setup.scenes.clone(),
            switched: None,
            follows_head: setup.head.is_some(),
            directed: setup.directed,
            inset: None,
            close_up: CloseUp::default(),
            seed: setup.seed,
            shaders: setup.shaders.clone(),
            lost: 0,
            departures: Departures::default(),
            start: None,
            colours: setup.colours.clone(),
            picture: Vec::new(),
        })
    }

    /// The simulated world now.
    pub fn world(&self) -> &World {
        &self.run.world
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
            self.run.world = world;
        }
        Ok(())
    }

    /// Carries out the frame's switches, in their order; returns whether that brought up a scene.
    fn switch(&mut self, switches: &[Switch]) -> Result<bool, Failure> {
        let mut anew = false;
        for switch in switches {
            let action = match Action::of(switch) {
                Ok(Some(action)) => action,
                Ok(None) => continue,
                // Where nothing is judged, what a student asks for in another version's words does no harm.
                Err(error) if error.key == key::LESSON && self.run.judging().is_none() => continue,
                Err(error) => return Err(Failure::Input(error.into())),
            };
            match action.brings_up().map(str::to_owned) {
                Some(name) => {
                    self.bring_up(&name, action)?;
                    anew = true;
                }
                None => _ = self.run.act(action)?,
            }
        }
        Ok(anew)
    }

    fn bring_up(&mut self, name: &str, action: Action) -> Result<(), Failure> {
        self.run.end_attempt()?;
        let scene = self.scenes.get(name)?.with_preset(self.preset);
        let gpu = self.run.world.gpu();
        let world = World::new(gpu, &self.shaders, &scene, self.seed).map_err(blame_world)?;
        self.run.bring_up(action, world);
        self.film = camera(&self.run.world, &self.shaders, self.shot, &self.colours)?;
        self.director = director(self.directed, &scene, self.film.as_ref());
        self.inset = None;
        self.close_up = CloseUp::default();
        (self.departures, self.start) = (Departures::default(), None);
        self.switched = Some(name.to_owned());
        Ok(())
    }

    /// Collects the observations that are older than the `newest` ones, so many of them; waits for the device.
    fn collect(&mut self, newest: usize) -> Result<(), Failure> {
        while self.run.wait(newest)?.is_some() {}
        if let Some(camera) = &mut self.film {
            camera.show_temperature(self.run.thermometer());
            camera.show_marks(self.run.marks());
        }
        Ok(())
    }

    /// A new world with the old one's state: shaders change seldom, and a
    /// state that survives a change of device survives this too.
    fn renewed_world(&self) -> Result<World, Failure> {
        let state = self.run.world.snapshot().map_err(blame_world)?;
        let (gpu, scene) = (self.run.world.gpu(), self.run.world.scene());
        let mut world = World::new(gpu, &self.shaders, scene, self.seed).map_err(blame_world)?;
        world.restore(&state).map_err(blame_world)?;
        Ok(world)
    }
}

impl Experiment for Laboratory {
    fn step(&mut self, frame: &PoseFrame) -> Result<Taken, Failure> {
        self.take_up_shaders();
        let anew = self.switch(&frame.scenario)?;

        let near = stage::near_from_stage(frame, self.run.world.scene());
        let hands = near.hands.each_ref();
        let hands = hands.map(|hand| hand.stage_from_grip.position);
        if let Some(camera) = &mut self.film {
            if self.follows_head {
                camera.follow(&near.stage_from_view);
            }
            if self.follows_head || self.director.is_some() {
                camera.show_hands(near.hands);
            }
        }
        let frame_time = self.run.world.scene().scale.frame_time;
        self.run.step(QueueKind::Main, frame)?;
        if self.film.is_none() {
            // They are not played.
            drop(self.run.sounds());
        }
        self.collect(MOST_LOOKS)?;
        self.direct(hands, frame_time)?;
        Ok(Taken { frame_time, anew })
    }

    fn sample(&mut self, t: f64) -> Result<Sample, Failure> {
        let state = self.run.world.solver().snapshot().other()?;
        let measured = self.run.world.measure_state(&state).map_err(blame_world)?;
        self.lost = self.lost.max(measured.lost_particles);
        let scene = self.run.world.scene();
        let mass = self.run.world.solver().parameters().particle_mass();
        let poses = self.run.world.poses();
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
            surface_m2: by_flask(scene, &measured.surfaces)
                .into_iter()
                .filter(|(_, area)| *area > 0.0)
                .collect(),
            highest_drop_m: departed.highest,
            heat: measured.heat.map(|heat| of_heat(scene, &heat, &start)),
        })
    }

    fn picture(&mut self, film: usize) -> Result<&[u8], Failure> {
        if let (Some(camera), Some(&colour)) = (&self.film, self.colours.get(film)) {
            self.picture = camera.shoot(&self.run.world, colour)?;
            if let (0, Some(inset), Some(director)) = (film, &self.inset, &self.director) {
                let width = camera.renderer.extent()[0] as usize;
                inset.lay(&mut self.picture, width, director.time());
            }
        }
        Ok(&self.picture)
    }

    fn close_up(&mut self, elapsed: f64) -> Result<Option<Vec<u8>>, Failure> {
        let (Some(camera), Some(&colour)) = (&mut self.film, self.colours.first()) else {
            return Ok(None);
        };
        let (world, [width, height]) = (&self.run.world, camera.renderer.extent());
        let aspect = width as f32 / height as f32;
        let view = (self.close_up).look(world, self.run.seen(), elapsed, aspect);
        camera.shoot_from(view, world, colour).map(Some)
    }

    fn worth(&self) -> Worth {
        let seen = self.run.seen();
        let real = self.run.world.scene().scale.length_scale.powi(3);
        let gas: f64 = seen.flasks.iter().map(|held| held.bubbles.volume).sum();
        Worth {
            shown: self.director.as_ref().is_none_or(Director::shows),
            interest: real * gas + seen.spilt.iter().sum::<f64>(),
        }
    }

    fn heard(&mut self) -> Result<Heard, Failure> {
        let Some(listener) = self.film.as_ref().map(Camera::listener) else {
            return Ok(Heard::default());
        };
        self.collect(0)?;
        let events = self.run.sounds();
        Ok(Heard { listener, events })
    }

    fn passes(&mut self) -> Result<Vec<PassPicture>, Failure> {
        let passes = self
            .film
            .as_ref()
            .map(|camera| camera.passes(&self.run.world));
        passes.unwrap_or_else(|| Ok(Vec::new()))
    }

    fn judge(&mut self, lesson: Judging) {
        self.run.judge(lesson);
    }

    fn glimpse(&self) -> Option<Glimpse<'_>> {
        Some(Glimpse {
            scene: (self.run.world.scene(), self.switched.as_deref()),
            flasks: &self.run.seen().flasks,
            spilt: self.run.seen().spilt,
            intensity: self.run.world.intensity(),
            events: self.run.events(),
            instructions: self.run.instructions(),
        })
    }

    fn so_far(&self) -> Vec<vitriol_lesson::Event> {
        self.run.so_far()
    }

    fn outcome(&mut self) -> Result<Outcome, Failure> {
        self.run.end_attempt()?;
        let measured = self.run.world.measure().map_err(blame_world)?;
        let counted = self.run.world.counters().map_err(blame_world)?;
        let state = self.run.world.snapshot().map_err(blame_world)?;
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
            ("drops of a jet or film left out", counted.spray_refused),
            (
                "bubble whose surroundings the driver cut",
                counted.bubbles_cut,
            ),
        ];
        Ok(Outcome {
            scene: self.switched.clone(),
            effort: self.run.world.effort(),
            fluid_particles: self.run.world.solver().count().into(),
            lost_particles: self.lost.max(measured.lost_particles),
            nan_particles: measured.nan_particles,
            state_hash: state.solver.hash(),
            device: device::statement(self.run.world.gpu()),
            events: self.run.events().to_vec(),
            progress: self.run.progress().to_vec(),
            instructions: self.run.instructions().to_vec(),
            counters: Counters {
                neighbour_rebuilds: counted.list_rebuilds.into(),
                limiters: limiters
                    .map(|(name, times)| (name.to_owned(), times.into()))
                    .into_iter()
                    .collect(),
                ..self.run.counts().clone()
            },
        })
    }
}
