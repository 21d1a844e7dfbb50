//! What the judge sees, and what a scene has that can be seen.

use vitriol_sim::scene::{Feature, Scene, ToolKind};

/// Liquid in a flask, and where the flask is.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FlaskSight {
    /// Its name.
    pub name: String,
    /// What it holds, m³, real size.
    pub volume_m3: f64,
    /// Acid mass fraction of that.
    pub acid: f64,
    /// Mean temperature of that, °C; `None` of an empty flask, and where no heat is modelled.
    pub temperature_c: Option<f64>,
    /// Whether a hand holds it.
    pub held: bool,
    /// Whether it stands upright on the bench.
    pub standing: bool,
}

/// A rod or a thermometer.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Dip {
    /// In whose liquid its tip is: a flask's name.
    pub flask: Option<String>,
    /// How fast its tip moves, m/s, as at real size.
    pub speed_m_s: f64,
}

/// What is seen at an instant. What a scene does not have is `None`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sight {
    /// Simulated time of the run, s.
    pub t_s: f64,
    /// The flasks.
    pub flasks: Vec<FlaskSight>,
    /// What lies on the bench, m³, real size.
    pub bench_m3: f64,
    /// What lies on the floor, m³, real size.
    pub floor_m3: f64,
    /// Whether goggles are worn.
    pub goggles: Option<bool>,
    /// Whether a glove is on the left and on the right hand.
    pub gloves: Option<[bool; 2]>,
    /// How far the hood's sash is open: its lower edge over the bench, m.
    pub sash_m: Option<f64>,
    /// The stirring rod.
    pub rod: Option<Dip>,
    /// The thermometer.
    pub thermometer: Option<Dip>,
    /// Water, below 5 % acid, that has come to the left and the right hand since the scene's start, m³, real size.
    pub rinsed_m3: Option<[f64; 2]>,
}

impl Sight {
    /// The flask of that name.
    pub fn flask(&self, name: &str) -> Option<&FlaskSight> {
        self.flasks.iter().find(|flask| flask.name == name)
    }
}

/// What a scene has of a flask.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FlaskFacts {
    /// Its name.
    pub name: String,
    /// Whether a hand can lift it.
    pub lifted: bool,
}

/// What a scene has, against which a lesson is checked: [`Lesson::check`](super::Lesson::check).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SceneFacts {
    /// The scene's name.
    pub name: String,
    /// Its flasks.
    pub flasks: Vec<FlaskFacts>,
    /// How much liquid it has in all, m³, real size.
    pub liquid_m3: f64,
    /// Whether it models heat.
    pub heat: bool,
    /// Goggles that can be put on and taken off.
    pub goggles: bool,
    /// Gloves, likewise.
    pub gloves: bool,
    /// A hood with a sash.
    pub sash: bool,
    /// A stirring rod.
    pub rod: bool,
    /// A thermometer.
    pub thermometer: bool,
    /// A cloth that takes up what is spilt.
    pub cloth: bool,
    /// Whether water that comes to a hand is seen, as of a wash bottle.
    pub rinsing: bool,
}

impl SceneFacts {
    /// Those of a scene that is called `name`.
    pub fn of(name: &str, scene: &Scene) -> Self {
        let flasks = scene.flasks.iter().map(|flask| FlaskFacts {
            name: flask.name.clone(),
            lifted: !flask.fixed,
        });
        let has = |kind| scene.tool(kind).is_some();
        let of_scene: f64 = scene.liquids.iter().map(|liquid| liquid.volume).sum();
        Self {
            name: name.to_owned(),
            flasks: flasks.collect(),
            liquid_m3: scene.scale.length_scale.powi(3) * of_scene,
            heat: scene.models(Feature::Heat),
            goggles: has(ToolKind::Goggles),
            gloves: has(ToolKind::Gloves),
            sash: has(ToolKind::Sash),
            rod: has(ToolKind::Rod),
            thermometer: has(ToolKind::Thermometer),
            cloth: has(ToolKind::Cloth),
            // Bare hands are rinsed as gloves are; where there are none to take off, nobody looks.
            rinsing: has(ToolKind::Gloves),
        }
    }
}
