//! The observation that the judge of a lesson takes in, and the properties of a scene that a lesson is checked against.

use vitriol_sim::scene::{Feature, Scene, ToolKind};

/// A flask and its liquid.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FlaskSight {
    /// Its name.
    pub name: String,
    /// Volume of its liquid, m³, real size.
    pub volume_m3: f64,
    /// Acid mass fraction of its liquid.
    pub acid: f64,
    /// Mean temperature of its liquid, °C; `None` of an empty flask, and where no heat is modelled.
    pub temperature_c: Option<f64>,
    /// Whether a hand holds it.
    pub held: bool,
    /// Whether it stands upright on the bench.
    pub standing: bool,
}

/// A rod or a thermometer.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Dip {
    /// Name of the flask in whose liquid its tip is; `None` in none.
    pub flask: Option<String>,
    /// Speed of its tip at real size, m/s.
    pub speed_m_s: f64,
}

/// An observation of the bench. Equipment that the scene does not have is `None`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sight {
    /// Simulated time of the run, s.
    pub t_s: f64,
    /// The flasks.
    pub flasks: Vec<FlaskSight>,
    /// Volume on the bench, m³, real size.
    pub bench_m3: f64,
    /// Volume on the floor, m³, real size.
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

/// Properties of a flask in a scene.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FlaskFacts {
    /// Its name.
    pub name: String,
    /// Whether a hand can lift it.
    pub lifted: bool,
}

/// Properties of a scene, against which a lesson is checked: [`Lesson::parse_for`](super::Lesson::parse_for).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SceneFacts {
    /// The scene's name.
    pub name: String,
    /// Its flasks.
    pub flasks: Vec<FlaskFacts>,
    /// Volume of its liquid in all, m³, real size.
    pub liquid_m3: f64,
    /// Whether it models heat.
    pub heat: bool,
    /// Its tools.
    pub tools: Vec<ToolKind>,
}

impl SceneFacts {
    /// Properties of `scene`, which is called `name`.
    pub fn of(name: &str, scene: &Scene) -> Self {
        let flasks = scene.flasks.iter().map(|flask| FlaskFacts {
            name: flask.name.clone(),
            lifted: !flask.fixed,
        });
        let of_scene: f64 = scene.liquids.iter().map(|liquid| liquid.volume).sum();
        Self {
            name: name.to_owned(),
            flasks: flasks.collect(),
            liquid_m3: scene.scale.length_scale.powi(3) * of_scene,
            heat: scene.models(Feature::Heat),
            tools: scene.tools.iter().map(|tool| tool.kind).collect(),
        }
    }

    /// Whether there is that tool.
    pub(super) fn has(&self, kind: ToolKind) -> bool {
        self.tools.contains(&kind)
    }
}
