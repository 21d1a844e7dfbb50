//! Finds what happens in an attempt, look by look.
//!
//! It sees no particle, but the sums of a census: how much came where, of which flask it was, and how warm it is. Each thing that
//! happens begins with the first look that shows it and is over once a while has passed without more of it; it is said then. What is
//! said depends on the looks alone, so a replay that looks at the same steps says the same.

mod amount;
mod flows;
mod glass;
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
use crate::limits::Limits;
use flows::Flows;
use glass::GlassFalls;
use heat::Heat;
use leaving::Leavings;
use skin::Touches;
use spills::Spills;
use thrown::Thrown;

/// A while without more of it, after which something is over, s: longer than a stream that gurgles pauses, shorter than who pours
/// twice takes between. Our choice.
pub(crate) const PAUSE: f64 = 1.0;

/// Of a real laboratory, m/s².
const GRAVITY: f64 = 9.81;

/// What a look shows, and what was done in the step before it.
#[derive(Clone, Copy, Debug)]
pub struct Seen<'a> {
    /// Simulated time of the run, s.
    pub t: f64,
    /// Since the look before, s.
    pub elapsed: f64,
    /// Where the liquid is, and what went where.
    pub census: &'a Census,
    /// stage_from_flask, in the world.
    pub poses: &'a [Pose],
    /// By flask, whether a hand holds it.
    pub held: &'a [bool],
    /// Blows of the glass.
    pub strikes: &'a [Strike],
    /// Flasks that broke.
    pub breaks: &'a [Break],
    /// What the user wears.
    pub worn: Worn,
    /// How far the hood's sash is open, m at real size.
    pub sash_open: Option<f64>,
    /// What is dipped.
    pub dipped: &'a [Dipped],
}

/// A rod or a thermometer after the step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dipped {
    /// What it is.
    pub kind: ToolKind,
    /// Where its lower end is, in the world.
    pub tip: glam::Vec3,
    /// How fast that moves, m/s of the scene.
    pub speed: f32,
}

/// What of a scene matters here.
#[derive(Clone, Debug)]
pub(crate) struct Bench {
    pub names: Vec<String>,
    /// Whether a hand can lift it.
    pub lifted: Vec<bool>,
    /// Whether it is heated.
    pub heated: Vec<bool>,
    /// Height of the rim over the flask's origin, m of the scene.
    pub rims: Vec<f64>,
    /// The flasks' shapes, m of the scene.
    pub profiles: Vec<Profile>,
    /// Whether steam is in bubbles.
    pub bubbles: bool,
    /// Real metres for one of the scene.
    pub scale: f64,
    /// Gravity, m of the scene/s².
    gravity: f64,
    /// Of the scene's file, in the world, m of the scene.
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

    /// Real m³ of a volume of the scene.
    pub fn volume(&self, of_scene: f64) -> f64 {
        self.scale.powi(3) * of_scene
    }

    /// A speed of the scene as it would be at real size, m/s: that of a fall from the same height of it.
    pub fn speed(&self, of_scene: f64) -> f64 {
        of_scene * (GRAVITY * self.scale / self.gravity).sqrt()
    }

    /// A place in the world in the frame of the scene's file, real m.
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

/// See the module.
#[derive(Clone, Debug)]
pub struct Finder {
    bench: Bench,
    scene: String,
    begun: bool,
    leavings: Leavings,
    flows: Flows,
    thrown: Thrown,
    spills: Spills,
    touches: Touches,
    heat: Heat,
    falls: GlassFalls,
    /// The last look's, for the end.
    contents: Contents,
    /// What lies on bench and floor, real m³.
    lying: [f64; 2],
    /// Water that came to the left and the right hand since the start, real m³.
    rinsed: [f64; 2],
    /// Whether hands can be rinsed.
    rinsing: bool,
    t: f64,
}

impl Finder {
    /// For a scene at its start, which is called `name`.
    pub fn new(name: &str, scene: &Scene, limits: Limits) -> Self {
        Self {
            bench: Bench::of(scene, limits),
            scene: name.to_owned(),
            begun: false,
            leavings: Leavings::default(),
            flows: Flows::default(),
            thrown: Thrown::default(),
            spills: Spills::default(),
            touches: Touches::default(),
            heat: Heat::default(),
            falls: GlassFalls::default(),
            contents: Contents::default(),
            lying: [0.0; 2],
            rinsed: [0.0; 2],
            rinsing: scene.tool(ToolKind::Gloves).is_some(),
            t: 0.0,
        }
    }

    /// Takes in a look; what is over with it, in the order in which it ended.
    pub fn looked(&mut self, seen: &Seen<'_>) -> Vec<Event> {
        let mut said = Vec::new();
        let bench = &self.bench;
        let contents = bench.contents(seen.census);
        if !std::mem::replace(&mut self.begun, true) {
            said.push(Event::Begun {
                t_s: seen.t - seen.elapsed,
                scene: self.scene.clone(),
                contents: contents.clone(),
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

    /// The attempt is over, at the time of the last look: what goes on is said, and how it ended. Nothing where it never began.
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
