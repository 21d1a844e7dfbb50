//! Finds the events of an attempt, one observation at a time.
//!
//! It reads no particles but their sums, a census: how much liquid arrived where, from which flask, and how warm it is. An event begins
//! with the first observation that shows it, is over after a pause without more of it, and is emitted then. Events depend on the
//! observations alone, so a replay that observes the same steps emits the same events.

mod amount;
mod broken;
mod flows;
mod heat;
mod leaving;
mod sight;
mod skin;
mod spills;
#[cfg(test)]
mod tests;
mod thrown;

use vitriol_sim::bodies::{Break, Strike, Worn};
use vitriol_sim::flask::Profile;
use vitriol_sim::pose::Pose;
use vitriol_sim::scene::{Feature, Scene, TableTop, ToolKind};
use vitriol_sim::solver::{Census, Held};

use crate::event::{Content, Contents, Ending, Event};
use crate::glass::{Glass, Glassware};
use crate::limits::Limits;
use crate::mixing::layered;
use broken::GlassFalls;
use flows::Flows;
pub use flows::Stream;
use heat::HeatFinder;
use leaving::Leavings;
use skin::Touches;
use spills::Spills;
use thrown::Thrown;

/// Pause after which an event is over, s: longer than a stream that gurgles pauses, shorter than a user who pours twice takes between. Our
/// choice.
pub(crate) const PAUSE: f64 = 1.0;

/// Gravity in a real laboratory, m/s².
const GRAVITY: f64 = 9.81;

/// An observation: the state after a step, and what happened in that step.
#[derive(Clone, Copy, Debug)]
pub struct Seen<'a> {
    /// Simulated time of the run, s.
    pub t: f64,
    /// Simulated time of the run before the step, s. Where times are rounded, `t` less a step may be another one.
    pub before: f64,
    /// Simulated time since the previous observation, s.
    pub elapsed: f64,
    /// Census of the liquid: where it is, and what moved where.
    pub census: &'a Census,
    /// Pose of each flask in the world, stage_from_flask.
    pub poses: &'a [Pose],
    /// By flask, whether a hand holds it.
    pub held: &'a [bool],
    /// Impacts of glass in the step.
    pub strikes: &'a [Strike],
    /// Flasks that broke in the step.
    pub breaks: &'a [Break],
    /// What the user wears.
    pub worn: Worn,
    /// How far the hood's sash is open, m at real size; `None` without a hood.
    pub sash_open: Option<f64>,
    /// Rod and thermometer.
    pub dipped: &'a [Dipped],
}

/// A rod or a thermometer after the step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dipped {
    /// Rod or thermometer.
    pub kind: ToolKind,
    /// Position of its lower end in the world.
    pub tip: glam::Vec3,
    /// Speed of that end, m/s of the scene.
    pub speed: f32,
}

/// Properties of a scene that the finder needs.
#[derive(Clone, Debug)]
pub(crate) struct Bench {
    pub names: Vec<String>,
    /// By flask, whether a hand can lift it.
    pub lifted: Vec<bool>,
    /// By flask, whether it is heated.
    pub heated: Vec<bool>,
    /// The flask in which acid and water lie on one another at the start.
    pub layered: Option<usize>,
    /// By flask, height of the rim over its origin, m of the scene.
    pub rims: Vec<f64>,
    /// The flasks' shapes, m of the scene.
    pub profiles: Vec<Profile>,
    /// Whether steam is modelled as bubbles.
    pub bubbles: bool,
    /// Real metres per metre of the scene.
    pub scale: f64,
    /// Gravity, in m of the scene per s².
    gravity: f64,
    /// [`Scene::origin`], m of the scene.
    pub origin: glam::DVec3,
    /// The bench's top.
    pub table: Option<TableTop>,
    pub limits: Limits,
}

impl Bench {
    fn of(scene: &Scene, limits: Limits) -> Self {
        let flasks = &scene.flasks;
        Self {
            names: flasks.iter().map(|flask| flask.name.clone()).collect(),
            lifted: flasks.iter().map(|flask| !flask.fixed).collect(),
            heated: flasks.iter().map(|flask| flask.heater > 0.0).collect(),
            layered: layered(scene)
                .and_then(|name| flasks.iter().position(|flask| flask.name == name)),
            rims: flasks.iter().map(|it| it.profile.rim_height()).collect(),
            profiles: flasks.iter().map(|it| it.profile.clone()).collect(),
            bubbles: scene.models(Feature::Bubbles),
            scale: scene.scale.length_scale,
            gravity: scene.scale.gravity,
            origin: scene.origin,
            table: scene.table,
            limits,
        }
    }

    pub fn name(&self, flask: usize) -> String {
        self.names.get(flask).cloned().unwrap_or_default()
    }

    /// Converts a volume of the scene, m³ of the scene, to real size, m³.
    pub fn volume(&self, of_scene: f64) -> f64 {
        self.scale.powi(3) * of_scene
    }

    /// Converts a speed of the scene to real size, m/s: falls from corresponding heights have corresponding speeds.
    pub fn speed(&self, of_scene: f64) -> f64 {
        of_scene * (GRAVITY * self.scale / self.gravity).sqrt()
    }

    /// Converts a position in the world, m of the scene, to the frame of the scene's file, m at real size.
    pub fn place(&self, in_world: glam::DVec3) -> [f64; 3] {
        (self.scale * (in_world + self.origin)).to_array()
    }

    /// The middle of a flask's rim, in the world.
    pub fn rim(&self, pose: &Pose, flask: usize) -> glam::DVec3 {
        let height = self.rims.get(flask).copied().unwrap_or_default();
        pose.transform_point(glam::Vec3::new(0.0, height as f32, 0.0))
            .as_dvec3()
    }

    pub fn content(&self, held: &Held) -> Content {
        Content {
            volume_m3: self.volume(held.volume),
            acid: f64::from(held.acid),
            temperature_c: held.temperature.map(f64::from),
        }
    }

    fn contents(&self, census: &Census) -> Contents {
        let held = census.flasks.iter().enumerate();
        held.filter(|(_, held)| held.particles > 0)
            .map(|(flask, held)| (self.name(flask), self.content(held)))
            .collect()
    }
}

/// Finds the [`Event`]s of an attempt from successive observations ([`Seen`]) of a simulation.
#[derive(Clone, Debug)]
pub struct Finder {
    bench: Bench,
    scene: String,
    glass: Glassware,
    begun: bool,
    leavings: Leavings,
    flows: Flows,
    thrown: Thrown,
    spills: Spills,
    touches: Touches,
    heat: HeatFinder,
    falls: GlassFalls,
    /// Contents of the flasks at the last observation.
    contents: Contents,
    /// Volume on bench and floor at the last observation, m³ at real size.
    lying: [f64; 2],
    /// Water that came to the left and the right hand since the start, m³ at real size.
    rinsed: [f64; 2],
    /// Whether hands can be rinsed.
    rinsing: bool,
    t: f64,
}

impl Finder {
    /// A finder for `scene` at its start; `name` is the scene's name in events.
    pub fn new(name: &str, scene: &Scene, limits: Limits) -> Self {
        Self {
            bench: Bench::of(scene, limits),
            scene: name.to_owned(),
            glass: Glass::all(scene),
            begun: false,
            leavings: Leavings::default(),
            flows: Flows::default(),
            thrown: Thrown::default(),
            spills: Spills::default(),
            touches: Touches::default(),
            heat: HeatFinder::default(),
            falls: GlassFalls::default(),
            contents: Contents::default(),
            lying: [0.0; 2],
            rinsed: [0.0; 2],
            rinsing: scene.tool(ToolKind::Gloves).is_some(),
            t: 0.0,
        }
    }

    /// Takes in an observation. Returns the events that are over with it, and [`Event::Begun`] at the first.
    pub fn looked(&mut self, seen: &Seen<'_>) -> Vec<Event> {
        let mut said = Vec::new();
        let bench = &self.bench;
        let contents = bench.contents(seen.census);
        if !std::mem::replace(&mut self.begun, true) {
            said.push(Event::Begun {
                t_s: seen.before,
                scene: self.scene.clone(),
                contents: contents.clone(),
                glass: self.glass.clone(),
            });
        }
        self.leavings.looked(bench, seen);
        self.flows.looked(bench, seen, &self.leavings, &mut said);
        let why = (&self.leavings, &self.flows);
        self.thrown.looked(bench, seen, why, &mut said);
        self.spills.looked(bench, seen, &self.leavings, &mut said);
        self.touches.looked(bench, seen, &self.leavings, &mut said);
        self.heat.looked(bench, seen, &self.flows, &mut said);
        self.falls.looked(bench, seen, &mut said);
        self.contents = contents;
        self.lying = [&seen.census.table, &seen.census.floor].map(|it| bench.volume(it.volume));
        for (rinsed, touching) in self.rinsed.iter_mut().zip(&seen.census.skin) {
            *rinsed += bench.volume(touching.rinsed);
        }
        self.t = seen.t;
        said
    }

    /// The pour that was under way in the last observation.
    pub fn pouring(&self) -> Option<Stream> {
        self.flows.under_way(&self.bench, self.t)
    }

    /// Ends the attempt at the time of the last observation. Returns the events under way and [`Event::Ended`]; nothing if no attempt has
    /// begun.
    pub fn end(&mut self) -> Vec<Event> {
        let mut said = Vec::new();
        if !std::mem::replace(&mut self.begun, false) {
            return said;
        }
        let bench = &self.bench;
        self.flows.close(bench, f64::INFINITY, &mut said);
        self.thrown.close(bench, f64::INFINITY, &mut said);
        self.spills.close(bench, f64::INFINITY, &mut said);
        self.touches.close(bench, f64::INFINITY, &mut said);
        self.heat.close(bench, &mut said);
        self.falls.close(&mut said);
        let [bench_m3, floor_m3] = self.lying;
        said.push(Event::Ended(Ending {
            t_s: self.t,
            contents: std::mem::take(&mut self.contents),
            hottest: self.heat.hottest.take(),
            bench_m3,
            floor_m3,
        }));
        said
    }
}
